//! A guiding centre in a tokamak: a one-step scheme where the one-form is in class, a projected one where it
//! is not.
//!
//! A particle that has little velocity along the field is reflected where the field is strong, and its orbit
//! in the poloidal plane is a banana; one with more goes around. Energy and toroidal momentum are conserved.

use crate::vocabulary::*;

const Q: f64 = 2.0;
const MU: f64 = 6e-5;
/// The start, on the outer side: the distance from the magnetic axis.
const RADIUS: f64 = 0.2;
/// The velocities along the field at the start, of the banana and of the passing orbit.
const ORBITS: [(&str, f64); 2] = [("banana", 4e-3), ("passing orbit", 1.2e-2)];
const H: f64 = 60.0;
const EARLY: u64 = 2000;

/// Runs in class, out of class, and by RK4: the relative changes of the energy and of the toroidal momentum.
type Orbit = [Series<2>; 3];

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(1_000_000, 10_000);
    job.expect(6 * steps);
    let orbits = each(ORBITS, |(_, u)| orbit(job, u, steps))?;
    let named = || ORBITS.iter().map(|(name, _)| *name).zip(&orbits);
    let rows = named().flat_map(|(orbit, runs)| {
        runs.iter().map(move |series| ([orbit, &series.name], [], series.kept[0].rows()))
    });
    job.publish(figure(&orbits, steps as f64 * H), curve_table("orbit,method,t,lowest,mean,highest", rows))?;
    let reach = |series: &Series<2>| largest(series.path.iter().map(|[_, z]| z.abs()));
    let growth = format!("max|ΔH| over all / over {EARLY} steps");
    let flat = "energy errors are no larger in the whole run than in its beginning";
    claims([
        beyond(flat).each(named(), |claim, (orbit, [one_step, projected, rk4])| {
            let claim = claim.each([one_step, projected], |claim, run| {
                claim.of(format!("{orbit}, {}", run.name)).at_most(&growth, run.kept[0].growth(), 1.02)
            });
            claim.of(format!("{orbit}, RK4")).at_least(&growth, rk4.kept[0].growth(), 2.0)
        }),
        beyond("the toroidal momentum is kept to rounding errors").each(named(), |claim, (orbit, runs)| {
            claim.each(&runs[..2], |claim, run| {
                let claim = claim.of(format!("{orbit}, {}", run.name));
                claim.at_most("max|Δp_φ/p_φ|", run.kept[1].largest, 1e-9)
            })
        }),
        beyond("both sets of coordinates give one orbit").each(named(), |claim, (orbit, runs)| {
            let ratio = reach(&runs[1]) / reach(&runs[0]);
            claim.of(orbit).near("largest |Z| out of class, in units of that in class", ratio, [1.0, 2e-3])
        }),
    ])
}

fn orbit(job: &Job<'_>, u: f64, steps: u64) -> Result<Orbit> {
    let system = TokamakInClass { q: Q, mu: MU };
    let in_class = Problem::new(&system, TokamakInClassState { r: RADIUS, theta: 0.0, phi: 0.0, u });
    let system = TokamakOutOfClass { q: Q, mu: MU };
    let out_of_class = Problem::new(&system, TokamakOutOfClassState { x: RADIUS, z: 0.0, phi: 0.0, u });
    let toroidal = |q: &[f64]| [1.0 + q[0] * q[1].cos(), q[0] * q[1].sin()];
    let plane = |q: &[f64]| [1.0 + q[0], q[1]];
    let [one_step, projected, rk4] = [
        ("in class, one step", solid(BLUE)),
        ("out of class, projected", solid(VERMILLION)),
        ("RK4", dashed(SLATE)),
    ];
    Ok([
        follow(job, one_step, in_class.run(OneStep::midpoint(), H)?, toroidal, steps)?,
        follow(job, projected, out_of_class.run(Projected::symmetric(), H)?, plane, steps)?,
        follow(job, rk4, out_of_class.run(RungeKutta::classical(), H)?, plane, steps)?,
    ])
}

fn follow(
    job: &Job<'_>,
    named: Named<'_>,
    mut run: impl Run<Scalar = f64>,
    place: impl Fn(&[f64]) -> [f64; 2],
    steps: u64,
) -> Result<Series<2>> {
    let (energy, [toroidal]) = (run.energy(), momenta(&run));
    job.series(named, &mut run, Span::of(steps, H, EARLY), |run, path| {
        if run.steps() <= EARLY / 8 {
            path.push(place(run.q()));
        }
        let [momentum] = momenta(run);
        [(run.energy() - energy) / energy, momentum / toroidal - 1.0]
    })
    .whole()
}

fn figure([banana, passing]: &[Orbit; 2], end: f64) -> Figure {
    let in_class = |colour| solid(colour).width(2.5);
    let out_of_class = |colour| dashed(colour).width(1.2);
    let paths = Panel::window("Poloidal plane", ("*R*", [0.7, 1.3]), ("*Z*", [-0.22, 0.38])).lines([
        ("banana, in class", in_class(BLUE), banana[0].path.clone()),
        ("banana, out of class", out_of_class(VERMILLION), banana[1].path.clone()),
        ("passing, in class", in_class(GREEN), passing[0].path.clone()),
        ("passing, out of class", out_of_class(SLATE), passing[1].path.clone()),
    ]);
    let labels = ["Relative error of the energy, banana", "largest |Δ*H*/*H*| of each interval"];
    Figure::of(format!("*q* = {Q}, *μ* = {MU}, from *R* = {}, *h* = {H}", 1.0 + RADIUS))
        .row(470.0, vec![paths, over_time(labels, end, [1e-7, 1e-1], banana, 0).weight(1.35)])
}
