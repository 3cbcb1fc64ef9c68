//! The top of Lagrange, by rotation matrices: against its integrals, and how long the matrices stay
//! orthogonal.
//!
//! The axis goes up and down between the roots of a cubic polynomial (Goldstein 1980, section 5.7). The
//! steps go along geodesics of SO(3) (Marsden, Pekarsky & Shkoller 1999; Lee, Leok & McClamroch 2007), so
//! that nothing is projected. RK4 on the nine entries of the matrix leaves the group.

use super::geodesics::*;
use super::turnings::*;
use crate::vocabulary::*;

const TOP: Top = Top { across: 1.0, along: 0.5, weight: 1.0 };
/// The angle of the axis from the vertical at the start of all runs.
const LEANING: f64 = 0.6;
/// The rates of that angle and of the precession at the start, and ω along the axis.
const RATES: [f64; 3] = [0.3, 0.2, SPINNING];
const SPINNING: f64 = 5.0;
/// The step of the long runs, and so many steps from one look at the integrals to the next.
const H: f64 = 0.02;
const EVERY: u64 = 10;
/// The steps with which turnings are compared and the order is measured, the longest first.
const STEPS: [f64; 3] = [0.04, 0.02, 0.01];
/// The time at which the order is measured, and the step of the reference.
const ORDER_TIME: f64 = 2.0;
const FINE: f64 = 1e-3;
/// The precession at the start of the curves that are drawn, from the upper turning.
const CURVES: [(f64, &str); 3] = [(-0.4, "Loops"), (0.0, "Cusps"), (0.2, "Waves")];
const DRAWN: f64 = 30.0;

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let long = Long { job, steps: job.choose(10_000_000, 6_000), every: EVERY, h: H };
    job.expect(2 * long.steps / EVERY);
    let before = TOP.heights(&begin());
    let energy = |state: &TopState| TOP.energy(&state.R, &velocities(state.omega_R), 0.0);
    // E − E(0), max |RᵀR − 1|, and the angular momenta about the axis and about the vertical, relative.
    let kept = |state: &TopState| {
        let now = TOP.heights(state);
        let momenta = [now.spin / before.spin - 1.0, now.vertical / before.vertical - 1.0];
        [energy(state) - energy(&begin()), rotations::defect(&state.R), momenta[0], momenta[1]]
    };
    let all = long.both("geodesics", TOP, &begin(), kept)?;
    let (motion, end) = (Problem::new(&TOP, begin()), job.choose(400.0, 20.0));
    let nutations = each(STEPS, |h| {
        up_and_down(motion.run(Geodesic::trapezoid(), h)?, end, &before, |run| {
            let (state, energy) = (run.state(), run.energy());
            let ([.., x, y, height], [a, b, _]) = (state.R, state.omega_R);
            Sample { height, rate: x * b - y * a, energy, shift: TOP.shift(&state) }
        })
    })?;
    job.publish(figure(&all, long)?, magnitude_table("method,t,largest_energy_error,largest_defect", &all))?;
    let [rk4, geodesics] = all.each_ref().map(|series| &series.kept);
    let text = "the energy error of a heavy top has no trend, and is that of the closed form all the time";
    // The largest that h²g makes of it, by the run with the same step.
    let predicted = nutations[1].1.predicted;
    claims([
        turning_claim("the axis of a heavy top", nutations.each_ref().map(|(extremes, _)| extremes)),
        rounding(long, geodesics),
        long.flat_energy(beyond(text), "geodesics", &geodesics[0], predicted),
        shadow_claim("top", &nutations.map(|(_, energy)| energy)),
        shrinks(long, rk4, geodesics[0].largest),
        order_claim("a heavy top", (TOP, begin()), STEPS, [ORDER_TIME, FINE])?,
    ])
}

fn begin() -> TopState {
    Top::leaning(LEANING, RATES)
}

fn rounding(long: Long<'_>, [_, defect, spin, vertical]: &[Envelope; 4]) -> Claim {
    let text = "the matrices of a heavy top are orthogonal to a few units of rounding for the whole run; \
                its momenta are kept up to errors no larger than a unit of rounding times the square root \
                of the number of steps";
    let about_vertical = "largest relative change of the momentum about the vertical";
    beyond(text)
        .at_least("steps", long.job.only_full(long.steps as f64), 1e7)
        .at_most("largest relative change of the spin", spin.largest, long.random_walk())
        .at_most(about_vertical, vertical.largest, long.random_walk())
        .at_most("geodesics: max|RᵀR − 1|", defect.largest, FEW_UNITS)
}

fn shrinks(long: Long<'_>, [energy, defect, ..]: &[Envelope; 4], by_geodesics: f64) -> Claim {
    // ω at the start; the precession makes the entries of the matrix a little slower or faster than that.
    let [dot_theta, dot_phi, spinning] = RATES;
    let square = dot_theta.powi(2) + (dot_phi * LEANING.sin()).powi(2) + spinning.powi(2);
    let shrunk = 1.0 - (-(long.steps as f64) * H.powi(6) * square.powi(3) / 72.0).exp();
    let [largest, trend] = [energy.largest, energy.trend()].map(|value| long.job.only_full(value));
    beyond(format!(
        "RK4 on the entries of the matrix, h = {H}, shrinks it at right angles to ω: each step takes some \
         (h|ω|)⁶/72 of the squares, and the energy drifts in proportion to the time"
    ))
    .near("RK4: max|RᵀR − 1|", defect.largest, [shrunk, 0.2 * shrunk])
    .at_least("RK4: max|ΔE|", largest, 100.0 * by_geodesics)
    .near("RK4: max|ΔE|, last tenth of the time over the first", trend, [10.0, 1.0])
}

/// The axis from above, and the circles of the heights between which it moves.
fn curve((precession, name): (f64, &str)) -> Result<Panel> {
    let start = Top::leaning(LEANING, [0.0, precession, SPINNING]);
    let mut run = Problem::new(&TOP, start).run(Geodesic::trapezoid(), 2.0 * H)?;
    let path = course(&mut run, (DRAWN / (2.0 * H)) as u64, |run| [run.q()[2], run.q()[5]])?;
    let empty = Panel::window(name, ("*x*", [-0.9, 0.9]), ("*y*", [-0.9, 0.9]));
    Ok(between_heights(empty, &TOP.heights(&start)).line(path, solid(BLUE).width(1.4)))
}

fn figure(all: &[Series<4>; 2], long: Long<'_>) -> Result<Figure> {
    let quantities = [
        (0, ["Energy", "largest |*E* − *E*(0)|"], [1e-11, 10.0]),
        (1, ["Orthogonality", "max |*R*ᵀ*R* − 1|"], [1e-17, 10.0]),
    ];
    let [first, second, third] = CURVES.map(|(precession, _)| precession.to_string().replace('-', "−"));
    let subtitle = format!(
        "The axis from above, up to *t* = {DRAWN}, from {LEANING} off the vertical with the precession \
         {first}, {second} and {third}; circles: the roots of the cubic"
    );
    Ok(Figure::of(subtitle)
        .row(380.0, each(CURVES, curve)?.into())
        .row(300.0, long.panels(all, &quantities))
        .footer(format!("Moments of inertia 1 and 0.5, weight 1, *ω*₃ = {SPINNING}; below *h* = {H}.")))
}
