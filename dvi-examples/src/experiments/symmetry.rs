//! How long the run of Rowley & Marsden's Fig. 2 lasts, and what carries it.
//!
//! Two leapfrogging pairs are mirror images of each other, and so is each step of VE2, up to rounding. While
//! the symmetry lasts, the parasitic mode of σ = 0 has nothing to grow from; rounding breaks it slowly. With
//! one vortex displaced there is no symmetry, and the motion is lost within the paper's time.

use crate::vocabulary::*;

const H: f64 = 2.0;
const PAPER: f64 = 2e5;
const DISPLACEMENT: [f64; 2] = [0.05, 0.035];
/// An energy error that says that the motion is lost, some fifteen times that of the paper's run.
const LOST: f64 = 0.05;
/// States are read every so many steps; an odd number, so that no phase of the motion is preferred.
const STRIDE: u64 = 37;

struct Motion {
    name: String,
    colour: Colour,
    /// The largest asymmetry and |H − H(0)|.
    errors: Decades<2>,
    /// When |H − H(0)| exceeds `LOST`, or the run ends with an error; infinite if neither happens.
    lost: f64,
    end: f64,
    failure: Option<StepError>,
}

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(1.2e8, PAPER);
    let [x, y] = DISPLACEMENT;
    let all = [
        Motion::new(job, "as in the paper".into(), BLUE, [0.0; 2], end)?,
        Motion::new(job, format!("vortex 1 displaced by ({x}, {y})"), VERMILLION, DISPLACEMENT, PAPER)?,
    ];
    let curves = all.iter().map(|Motion { name, errors, .. }| {
        ([name], [], errors.rows.iter().map(|&(t, [asymmetry, error])| [t, asymmetry, error]))
    });
    job.publish(figure(&all), curve_table("run,t,asymmetry,energy_error", curves))?;
    let rounding = "How rounding breaks the symmetry differs from program to program, and so does the time \
                    at which the symmetric run breaks up.";
    let notes = all.iter().map(Motion::ending).chain([rounding.to_owned()]).collect();
    let [symmetric, displaced] = &all;
    let lost = format!("time at which |ΔH| exceeds {LOST}");
    let carried = "it does for the paper's time, carried by the mirror symmetry of its initial data; \
                   rounding breaks the symmetry, and later the motion breaks up";
    let all_time = job.only_full(symmetric.lost);
    let growth = symmetric.asymmetry(PAPER) / symmetric.asymmetry(0.1 * PAPER);
    let claims = vec![
        says("Fig. 2", "with VE2 the Hamiltonian remains close to its initial value for all time")
            .at_least(&lost, all_time, symmetric.end)
            .instead(carried)
            .within(&lost, all_time, [PAPER, symmetric.end])
            .at_least("asymmetry up to t = 2·10⁵ / up to t = 2·10⁴", growth, 10.0)
            .at_least("asymmetry when it is lost", job.only_full(symmetric.asymmetry(f64::INFINITY)), 0.1),
        beyond("with vortex 1 displaced by (0.05, 0.035) the motion is lost within the paper's time")
            .at_most(format!("displaced: {lost}"), displaced.lost, PAPER),
    ];
    Ok(Outcome { claims, references: vec![], notes })
}

/// The largest difference between a vortex and the mirror image of its partner.
fn asymmetry(q: &[f64]) -> f64 {
    let (x, y) = q.split_at(4);
    let pair = |i: usize, j: usize| larger((x[i] - x[j]).abs(), (y[i] + y[j]).abs());
    larger(pair(0, 2), pair(1, 3))
}

impl Motion {
    fn new(job: &Job<'_>, name: String, colour: Colour, [dx, dy]: [f64; 2], end: f64) -> Result<Self> {
        let Case { vortices, mut start } = models::leapfrogging();
        start.x[0] += dx;
        start.y[0] += dy;
        // The run is to go on until its energy is lost.
        let mut run = Integrator::new(&vortices, unwatched(begun_by_rk2(0.0)), H, start)?;
        let (initial, mut errors) = (run.energy(), Decades::new(40.0));
        let (mut lost, mut failure) = (f64::INFINITY, None);
        job.repeat((end / H) as u64 / STRIDE, || {
            // A run that is lost tells nothing more.
            if lost.is_infinite() {
                failure = run.take_steps(STRIDE).err();
                let (t, error) = (run.time(), (run.energy() - initial).abs());
                if failure.is_none() {
                    errors.push(t, [asymmetry(run.q()), error]);
                }
                if failure.is_some() || error.is_nan() || error > LOST {
                    lost = t;
                }
            }
            anyhow::Ok(())
        })?;
        Ok(Self { name, colour, errors, lost, end, failure })
    }

    fn asymmetry(&self, t: f64) -> f64 {
        largest(self.errors.rows.iter().filter(|row| row.0 <= t).map(|row| row.1[0]))
    }

    fn ending(&self) -> String {
        let (name, at) = (&self.name, scientific(self.lost.min(self.end)));
        match &self.failure {
            Some(error) => format!("{name}: ended at t = {at}, {error}."),
            None if self.lost.is_finite() => format!("{name}: |ΔH| exceeds {LOST} at t = {at}."),
            None => format!("{name}: |ΔH| stays below {LOST} up to t = {at}."),
        }
    }
}

fn figure(all: &[Motion; 2]) -> Figure {
    let panel = |title: &str, label: &str, [low, high]: [f64; 2], column: usize| {
        let points = |run: &Motion| run.errors.rows.iter().map(|(t, row)| [*t, row[column]]).collect();
        Panel::loglog(title, ("time *t*   [*L*²/Γ]", [10.0, all[0].end]), (label, [low, high]))
            .lines(all.iter().map(|run| (&run.name, solid(run.colour), points(run))))
            .guide([[PAPER, low], [PAPER, high]], "the paper's time")
            .legend_at(Corner::BottomRight)
    };
    let mirror = panel("Distance from mirror symmetry", "largest in each interval   [*L*]", [1e-16, 1e4], 0);
    let energy = panel("Energy", "largest |*H* − *H*(0)| in each interval   [Γ²]", [1e-4, 0.2], 1);
    Figure::of(format!("A run is drawn until |Δ*H*| exceeds {LOST} or it ends by itself"))
        .row(450.0, vec![mirror, energy.without_legend()])
        .footer("The run of Rowley & Marsden 2002, Fig. 2.")
}
