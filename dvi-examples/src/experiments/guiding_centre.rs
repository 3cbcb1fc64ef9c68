//! A guiding centre in a tokamak: a one-step scheme where the one-form is in class, a projected one where it
//! is not.
//!
//! A particle that has little velocity along the field is reflected where the field is strong, and its orbit
//! in the poloidal plane is a banana; one with more goes around. Energy and toroidal momentum are conserved.

use crate::models::{TokamakInClass, TokamakInClassState, TokamakOutOfClass, TokamakOutOfClassState};
use crate::vocabulary::*;

const Q: f64 = 2.0;
const MU: f64 = 6e-5;
/// The start, on the outer side: the distance from the magnetic axis.
const RADIUS: f64 = 0.2;
/// The velocities along the field at the start, of the banana and of the passing orbit.
const ORBITS: [(&str, f64); 2] = [("banana", 4e-3), ("passing orbit", 1.2e-2)];
const H: f64 = 60.0;
/// Steps of the beginning, with which the whole is compared; several bounces.
const EARLY: u64 = 2000;

/// The relative changes of the energy and of the toroidal momentum, and R and Z of the beginning.
type Motion = (Series<2>, Vec<[f64; 2]>);

/// The runs of one orbit: in class, out of class, and RK4.
type Orbit = [Motion; 3];

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(1_000_000, 10_000);
    job.expect(6 * steps);
    let orbits = each(ORBITS, |(_, u)| orbit(job, u, steps))?;
    let rows = ORBITS.iter().zip(&orbits).flat_map(|((orbit, _), runs)| {
        runs.iter().flat_map(|(series, _)| ranges([*orbit, &series.name], &series.kept[0].envelope))
    });
    let table = Table::of(&["orbit", "method", "t", "lowest", "mean", "highest"], rows)?;
    job.publish(figure(&orbits, steps as f64 * H), table)?;
    Ok(claims(&orbits).into())
}

fn orbit(job: &Job<'_>, u: f64, steps: u64) -> Result<Orbit> {
    let system = TokamakInClass { q: Q, mu: MU };
    let start = TokamakInClassState { r: RADIUS, theta: 0.0, phi: 0.0, u };
    let toroidal = |q: &[f64]| [1.0 + q[0] * q[1].cos(), q[0] * q[1].sin()];
    let name = ("in class, one step", Stroke::solid(BLUE));
    let in_class = follow(job, name, &system, OneStep::midpoint(), start, toroidal, steps)?;
    let system = TokamakOutOfClass { q: Q, mu: MU };
    let start = TokamakOutOfClassState { x: RADIUS, z: 0.0, phi: 0.0, u };
    let plane = |q: &[f64]| [1.0 + q[0], q[1]];
    let name = ("out of class, projected", Stroke::solid(VERMILLION));
    let projected = follow(job, name, &system, Projected::symmetric(), start, plane, steps)?;
    let name = ("RK4", Stroke::dashed(SLATE));
    let runge_kutta = follow(job, name, &system, RungeKutta::classical(), start, plane, steps)?;
    Ok([in_class, projected, runge_kutta])
}

fn follow<S: DegenerateLagrangian>(
    job: &Job<'_>,
    (name, stroke): (&str, Stroke),
    system: &S,
    method: impl Method<S, f64>,
    start: S::State<f64>,
    place: impl Fn(&[f64]) -> [f64; 2],
    steps: u64,
) -> Result<Motion> {
    let mut run = Integrator::new(system, method, H, start)?;
    let energy = run.energy();
    let toroidal = run.momenta().map(|(_, value)| value).sum::<f64>();
    let mut path = vec![place(run.q())];
    let span = Span { end: steps as f64 * H, early: EARLY as f64 * H, intervals: 400 };
    let kept = job.keep(&mut run, steps, span, |run| {
        if run.steps() <= EARLY / 8 {
            path.push(place(run.q()));
        }
        let momentum = run.momenta().map(|(_, value)| value).sum::<f64>();
        [(run.energy() - energy) / energy, momentum / toroidal - 1.0]
    })?;
    Ok((Series::new(name, stroke, kept), path))
}

fn claims(orbits: &[Orbit; 2]) -> Vec<Claim> {
    let named = || ORBITS.iter().map(|(name, _)| *name).zip(orbits);
    let reach = |(_, path): &Motion| largest(path.iter().map(|[_, z]| z.abs()));
    let growth = |orbit: &str, name: &str| format!("{orbit}, {name}: max|ΔH| over all / over {EARLY} steps");
    vec![
        beyond("energy errors are no larger in the whole run than in its beginning").each(
            named(),
            |claim, (orbit, [in_class, projected, (rk4, _)])| {
                let of_both = claim.each([in_class, projected], |claim, (series, _)| {
                    claim.at_most(growth(orbit, &series.name), series.kept[0].growth(), 1.02)
                });
                of_both.at_least(growth(orbit, &rk4.name), rk4.kept[0].growth(), 2.0)
            },
        ),
        beyond("the toroidal momentum is kept to rounding errors").each(named(), |claim, (orbit, runs)| {
            claim.each(&runs[..2], |claim, (series, _)| {
                claim.at_most(
                    format!("{orbit}, {}: max|Δp_φ/p_φ|", series.name),
                    series.kept[1].largest,
                    1e-9,
                )
            })
        }),
        beyond("both sets of coordinates give one orbit").each(
            named(),
            |claim, (orbit, [in_class, projected, _])| {
                let quantity = format!("{orbit}: largest |Z| out of class, in units of that in class");
                claim.near(quantity, reach(projected) / reach(in_class), [1.0, 2e-3])
            },
        ),
    ]
}

fn figure([banana, passing]: &[Orbit; 2], end: f64) -> Figure {
    let (r, z) = (Axis::linear("*R*").within(0.7, 1.3), Axis::linear("*Z*").within(-0.22, 0.38));
    let (solid, dashed) =
        (|colour| Stroke::solid(colour).width(2.5), |colour| Stroke::dashed(colour).width(1.2));
    let paths = Panel::new("Poloidal plane", r, z).equal().lines([
        ("banana, in class", solid(BLUE), banana[0].1.clone()),
        ("banana, out of class", dashed(VERMILLION), banana[1].1.clone()),
        ("passing, in class", solid(GREEN), passing[0].1.clone()),
        ("passing, out of class", dashed(SLATE), passing[1].1.clone()),
    ]);
    let labels = ["Relative error of the energy, banana", "largest |Δ*H*/*H*| of each interval"];
    let energy = over_time(labels, end, [1e-7, 1e-1], banana.iter().map(|(series, _)| series), 0);
    let [in_class, projected, rk4] = banana.each_ref().map(|(series, _)| series.kept[0].largest);
    Figure::new(
        "A guiding centre in a tokamak: two orbits in two sets of coordinates",
        format!("*q* = {Q}, *μ* = {MU}, from *R* = {}, *h* = {H}", 1.0 + RADIUS),
    )
    .row(470.0, vec![paths, energy.weight(1.35)])
    .footer(format!(
        "Largest |Δ*H*/*H*| of the banana: one step {}, projected {}. RK4 at the end: {}.",
        at_most(in_class),
        at_most(projected),
        scientific(rk4)
    ))
}
