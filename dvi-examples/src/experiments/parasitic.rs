//! The parasitic mode of the two-step map: the part of an orbit that alternates from step to step.
//!
//! It decides whether a run can be used. The energy of Fig. 2 does not show it, because that motion is
//! protected by its mirror symmetry. Beyond the paper.

use crate::vocabulary::*;

const COLOURS: [Colour; 4] = [BLUE, GREEN, VERMILLION, INK];
/// Energy errors above this mean that the motion is lost.
const LOST: f64 = 0.1;

struct Motion {
    motion: &'static str,
    sigma: f64,
    h: f64,
    /// [t, amplitude of the alternating component, |H − H(0)| so far].
    points: Vec<[f64; 3]>,
    /// When the run ended, and the error that ended it early.
    end: f64,
    failure: Option<StepError>,
}

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let runs = [(0.25, 0.5), (0.25, 0.25), (0.25, 0.125), (0.5, 0.5)];
    let leapfrogging = each(runs, |run| Motion::new(job, "leapfrogging", leapfrogging(), run, 3000.0))?;
    let runs = [(0.0, 0.1), (0.0, 0.05), (0.0, 0.02), (0.5, 0.1)];
    let chaotic = each(runs, |run| Motion::new(job, "chaotic", models::chaotic(), run, 300.0))?;
    let all = || leapfrogging.iter().chain(&chaotic);
    let curves = all().map(|run| ([run.motion], [run.sigma, run.h], thin(&run.points, 1000)));
    let table = curve_table("motion,sigma,h,t,amplitude,largest_energy_error", curves);
    job.publish(figure(&leapfrogging, &chaotic), table)?;
    let notes = all().filter_map(|run| {
        let Motion { motion, end, failure, .. } = run;
        failure.map(|error| format!("{motion}, {}: ended at t = {end}, {error}.", run.name()))
    });
    // The rate that independent programs have found.
    let references = leapfrogging[..3].iter().map(|run| {
        let quantity = format!("rate on the leapfrogging pairs, {}", run.name());
        Check::new(quantity, run.rate(), Bound::Near(7e-3, 7e-4))
    });
    let (notes, references) = (notes.collect(), references.collect());
    let [quarter, explicit] = [&leapfrogging, &chaotic].map(|all| &all[..3]);
    let (half, first) = ([&leapfrogging[3], &chaotic[3]], quarter[0].rate());
    let energy = chaotic[3].points.last().map_or(f64::NAN, |point| point[2]);
    let until = format!("time of |ΔH| > {LOST} or of an error that ends the run");
    let rate =
        |run: &Motion| format!("rate on the leapfrogging pairs, {}, over that of the largest h", run.name());
    let rates = |run: &Motion| run.rate().zip(first).map(|(rate, first)| rate / first);
    let claims = vec![
        beyond("with σ = 0 the chaotic motion of Fig. 5 is lost at each of the steps tried, with σ = ½ not")
            .each(explicit, |all, run| all.at_most(format!("{until}, {}", run.name()), run.lost(), 300.0))
            .at_most(format!("max|ΔH| to t = 300, {}", chaotic[3].name()), energy, 1e-4),
        beyond("for σ = ¼ the parasitic mode grows at a rate that does not depend on h")
            .each(&quarter[1..], |claim, run| claim.near(rate(run), rates(run), [1.0, 0.1])),
        beyond("for σ = ½ it neither grows nor decays").each(half, |claim, run| {
            let quantity = format!("late over early amplitude, {}, {}", run.motion, run.name());
            claim.near(quantity, run.growth(), [1.0, 0.2])
        }),
    ];
    Ok(Outcome { claims, references, notes })
}

impl Motion {
    fn new(
        job: &Job<'_>,
        motion: &'static str,
        Case { vortices, start }: Case,
        (sigma, h): (f64, f64),
        end: f64,
    ) -> Result<Self> {
        // The Runge–Kutta start leaves a parasitic mode of size h³, which then does what it does.
        let mut run = Integrator::new(&vortices, unwatched(begun_by_rk2(sigma)), h, start)?;
        let (initial, mut largest) = (run.energy(), 0.0f64);
        let (mut filter, mut points) = (AlternatingComponent::default(), Vec::new());
        let ended = job.follow(&mut run, (end / h) as u64, |run| {
            largest = larger(largest, (run.energy() - initial).abs());
            points.extend(filter.amplitude(run.q()).map(|amplitude| [run.time(), amplitude, largest]));
        });
        Ok(Self { motion, sigma, h, points, end: run.time(), failure: ended.err() })
    }

    fn name(&self) -> String {
        format!("σ = {}, h = {}", self.sigma, self.h)
    }

    fn first_above(&self, column: usize, level: f64) -> Option<[f64; 3]> {
        self.points.iter().find(|point| point[column] > level).copied()
    }

    fn rate(&self) -> Option<f64> {
        let [t0, a0, _] = self.first_above(1, 1e-4)?;
        let [t1, a1, _] = self.first_above(1, 1e-2)?;
        Some((a1 / a0).ln() / (t1 - t0))
    }

    /// When the energy error says that the motion is lost, or the run itself; infinite if neither does.
    fn lost(&self) -> f64 {
        let ended = if self.failure.is_some() { self.end } else { f64::INFINITY };
        self.first_above(2, LOST).map_or(ended, |point| point[0].min(ended))
    }

    /// The largest amplitude of the last tenth, over that of the first.
    fn growth(&self) -> f64 {
        let part = self.points.len() / 10;
        let largest = |points: &[[f64; 3]]| largest(points.iter().map(|point| point[1]));
        largest(&self.points[self.points.len() - part..]) / largest(&self.points[..part])
    }
}

fn figure(leapfrogging: &[Motion; 4], chaotic: &[Motion; 4]) -> Figure {
    let panel = |title: &str, label: &str, all: &[Motion; 4], column: usize| {
        let axis = Axis::logarithmic(label).within([1e-9, 30.0]);
        let empty = Panel::new(title, Axis::linear("time *t*   [*L*²/Γ]"), axis);
        empty.legend_at(Corner::BottomRight).each(all.iter().zip(COLOURS), |panel, (run, colour)| {
            let points: Points = run.points.iter().map(|point| [point[0], point[column]]).collect();
            let end = points.last().filter(|_| run.failure.is_some()).copied();
            let panel = panel.line(points, solid(colour).width(1.4));
            let panel = panel.labelled(format!("σ = {}, *h* = {}", run.sigma, run.h));
            panel.rings(end.into_iter().collect(), colour)
        })
    };
    let amplitude = "amplitude of the alternating component   [*L*]";
    let left = panel("Leapfrogging pairs", amplitude, leapfrogging, 1);
    let right = panel("Chaotic motion: energy", "largest |*H* − *H*(0)| so far   [Γ²]", chaotic, 2);
    Figure::of("A first step of RK2 leaves a parasitic mode of size *h*³; a circle: the run ended there")
        .row(460.0, vec![left, panel("Chaotic motion", amplitude, chaotic, 1), right.without_legend()])
        .footer("Data of Rowley & Marsden 2002, Figs. 2 and 5. Γ and *L*: units of circulation and length.")
}
