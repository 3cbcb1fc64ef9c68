//! Rowley & Marsden 2002, Fig. 3: trajectories of two leapfrogging pairs, and what becomes of them under
//! RK2 at the step that VE2 can take.

use crate::vocabulary::*;

const SHOWN: f64 = 200.0;

struct Motion {
    /// The first points of each vortex.
    trajectories: [Points; 4],
    distance: Envelope,
    /// Times at which one of vortices 1 and 2 overtakes the other.
    overtakings: Vec<f64>,
    extent: f64,
    asymmetry: f64,
    failure: Option<StepError>,
}

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(2e5, 2e4);
    let ve2 = Motion::new(job, begun_by_rk2(0.0), 2.0, end)?;
    let rk2 = Motion::new(job, RungeKutta::midpoint(), 2.0, end)?;
    let exact = Motion::new(job, Gauss::<3>::new(), 0.5, SHOWN)?;
    let rows = (0..ve2.trajectories[0].len()).map(|k| {
        let places = ve2.trajectories.iter().flat_map(move |trajectory| trajectory[k]);
        ([""; 0], [k as f64].into_iter().chain(places))
    });
    job.publish(figure([&ve2, &rk2, &exact], end), Table::of("step,x1,y1,x2,y2,x3,y3,x4,y4", rows))?;
    let note = format!(
        "RK2 at h = 2: the last overtaking is at t = {}. The mirror symmetry breaks by rounding, so this \
         time is not reproducible from machine to machine; that the pairs come apart is.",
        rk2.overtakings.last().copied().unwrap_or(0.0)
    );
    let ended = |(name, motion): (&str, &Motion)| {
        motion.failure.map(|error| format!("{name} at h = 2 ended early: {error}."))
    };
    let notes = [note].into_iter().chain([("VE2", &ve2), ("RK2", &rk2)].into_iter().filter_map(ended));
    let infinite = job.only_full(f64::from(!rk2.extent.is_finite()));
    let claims = vec![
        says("Fig. 3", "the two pairs leapfrog past each other")
            .at_most("longest time between overtakings, VE2 at h = 2", ve2.longest_interval(), 36.0)
            .at_most("largest deviation from mirror symmetry, VE2", ve2.asymmetry, 1e-3),
        says("section 5", "RK2 blows up at h = 2")
            .at_least("infinite or undefined coordinates", infinite, 1.0)
            .instead("the numbers stay finite, but the pairs come apart")
            .at_least("longest time between overtakings, RK2 at h = 2", rk2.longest_interval(), 200.0)
            .at_most("largest coordinate at the end", rk2.extent, 1e6),
    ];
    Ok(Outcome { claims, references: vec![], notes: notes.collect() })
}

impl Motion {
    fn new(job: &Job<'_>, method: impl Method<FourVortices, f64>, h: f64, end: f64) -> Result<Self> {
        let Case { vortices, start } = models::leapfrogging();
        let mut run = Integrator::new(&vortices, method, h, start)?;
        let (mut trajectories, mut distance) = ([const { Vec::new() }; 4], Envelope::new(end, 500, 0.0));
        let (mut overtakings, mut lead, mut asymmetry) = (vec![0.0], 0.0, 0.0);
        let mut look = |t: f64, q: &[f64]| {
            let (x, y) = q.split_at(4);
            if t <= SHOWN {
                (0..4).for_each(|j| trajectories[j].push([x[j], y[j]]));
            }
            distance.push(t, (x[0] - x[1]).hypot(y[0] - y[1]));
            asymmetry = largest([asymmetry, (x[0] - x[2]).abs(), (y[0] + y[2]).abs()]);
            let now = (x[0] - x[1]).signum();
            if now * lead < 0.0 {
                overtakings.push(t);
            }
            lead = now;
        };
        look(0.0, run.q());
        let failure = job.follow(&mut run, (end / h) as u64, |run| look(run.time(), run.q())).err();
        let extent = largest(run.q().iter().map(|q| q.abs()));
        Ok(Self { trajectories, distance, overtakings, extent, asymmetry, failure })
    }

    fn longest_interval(&self) -> f64 {
        // A run that ended early has not overtaken since.
        let reached = self.distance.end();
        let times = self.overtakings.iter().chain([&reached]);
        largest(times.clone().zip(times.skip(1)).map(|(before, after)| after - before))
    }
}

fn figure([ve2, rk2, exact]: [&Motion; 3], end: f64) -> Figure {
    // Mirror partners have one colour: 1 and 3, 2 and 4.
    let colours = [BLUE, VERMILLION, BLUE, VERMILLION].into_iter().enumerate();
    let title = "Trajectories: VE2 with *h* = 2 (dots) on accurate ones (lines)";
    let paths = Panel::plane(title, "*x*   [*L*]", "*y*   [*L*]").each(colours, |panel, (j, colour)| {
        let path = panel.line(exact.trajectories[j].clone(), solid(colour).opacity(0.55));
        let name = || format!("vortex {} and its image {}", j + 1, j + 3);
        let path = if j < 2 { path.labelled(name()) } else { path };
        let points = &ve2.trajectories[j];
        let start = points.iter().take(1).copied().collect();
        path.dots(points.clone(), 1.9, colour).rings(start, colour)
    });
    let time = Axis::linear("time *t*   [*L*²/Γ]").within([0.0, end]);
    let axis = Axis::logarithmic("|*z*₁ − *z*₂|   [*L*]");
    let distance = Panel::new("Distance of vortices 1 and 2 (range and mean)", time, axis).ranges([
        ("RK2, *h* = 2", SLATE, rk2.distance.rows()),
        ("VE2, *h* = 2", GREEN, ve2.distance.rows()),
    ]);
    Figure::of("Γ = 1 above, Γ = −1 below; Γ and *L*: units of circulation and length")
        .row(400.0, vec![paths.legend_at(Corner::Beside)])
        .row(300.0, vec![distance.legend_at(Corner::Beside)])
        .footer("After Rowley & Marsden 2002, Fig. 3.")
}
