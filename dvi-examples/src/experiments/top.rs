//! The top of Lagrange, by rotation matrices: against its integrals, and how long the matrices stay
//! orthogonal.
//!
//! The axis goes up and down between the roots of a cubic polynomial (Goldstein 1980, section 5.7). The
//! steps go along geodesics of SO(3) (Marsden, Pekarsky & Shkoller 1999; Lee, Leok & McClamroch 2007), so
//! that nothing is projected. RK4 on the nine entries of the matrix leaves the group.

mod claims;
mod picture;
mod series;

use anyhow::Result;
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use crate::claim::larger;
use crate::experiments::rk4::rk4;
use crate::experiments::shadow::Shadow;
use crate::experiments::turnings::{Extreme, Sample, Turnings};
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{Heights, Top, TopState};
use series::Series;

pub const EXPERIMENT: Experiment = Experiment {
    name: "top",
    title: "The top of Lagrange against its integrals, by rotation matrices",
    share: 41.0,
    run,
};

const TOP: Top = Top { across: 1.0, along: 0.5, weight: 1.0 };
/// The angle of the axis from the vertical at the start of all runs.
const LEANING: f64 = 0.6;
/// The rates of that angle and of the precession at the start, and ω along the axis.
const RATES: [f64; 3] = [0.3, 0.2, SPINNING];
const SPINNING: f64 = 5.0;
/// The step of the long runs.
const H: f64 = 0.02;
/// The steps with which turnings are compared, the longest first.
const NUTATION_STEPS: [f64; 3] = [0.04, 0.02, 0.01];
/// The time at which the order is measured, the steps, and that of the reference.
const ORDER_TIME: f64 = 2.0;
const ORDER_STEPS: [f64; 3] = [0.04, 0.02, 0.01];
const FINE: f64 = 1e-3;
/// The precession at the start of the curves that are drawn, from the upper turning, and what they are
/// called.
const CURVES: [(f64, &str); 3] = [(-0.4, "loops"), (0.0, "cusps"), (0.2, "waves")];
const DRAWN: f64 = 30.0;
const DRAWN_STEP: f64 = 2.0 * H;

/// Up and down with steps of one length.
struct Nutation {
    extremes: [Extreme; 2],
    energy: Shadow,
}

/// The axis from above, and the heights between which it moves.
struct Curve {
    name: &'static str,
    path: Vec<[f64; 2]>,
    extremes: [f64; 2],
}

/// All that is measured.
struct Measured {
    steps: u64,
    geodesic: Series,
    rk4: Series,
    /// For each of [`NUTATION_STEPS`].
    nutation: [Nutation; 3],
    /// The largest differences of an entry of R or ω from the reference at [`ORDER_TIME`], for each of
    /// [`ORDER_STEPS`]: by geodesics, and by their composition of order 4.
    errors: [[f64; 3]; 2],
    between_references: f64,
    curves: [Curve; 3],
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps: u64 = job.choose(10_000_000, 6_000);
    job.expect(2 * steps / series::EVERY);
    let fine = reference(FINE);
    let errors =
        [errors(Geodesic::trapezoid(), &fine)?, errors(Composition::suzuki(Geodesic::trapezoid()), &fine)?];
    let measured = Measured {
        steps,
        geodesic: Series::geodesic(job, steps)?,
        rk4: Series::rk4(job, steps)?,
        nutation: nutation(job.choose(400.0, 20.0))?,
        errors,
        between_references: difference(&fine, &reference(2.0 * FINE)),
        curves: curves()?,
    };
    job.publish(EXPERIMENT.name, picture::figure(&measured), picture::table(&measured)?)?;
    Ok(Outcome { claims: claims::claims(job, &measured), references: vec![], notes: vec![] })
}

fn begin() -> TopState {
    Top::leaning(LEANING, RATES)
}

/// The energy, with that of the spin.
fn energy(heights: &Heights) -> f64 {
    heights.energy + heights.spin * heights.spin / (2.0 * TOP.along)
}

/// The entries of R row by row, and ω.
fn entries(state: &TopState) -> [f64; 12] {
    std::array::from_fn(|i| if i < 9 { state.R[i] } else { state.omega_R[i - 9] })
}

fn state(y: &[f64; 12]) -> TopState {
    TopState { R: std::array::from_fn(|i| y[i]), omega_R: std::array::from_fn(|i| y[9 + i]) }
}

fn difference(one: &[f64; 12], other: &[f64; 12]) -> f64 {
    one.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, larger)
}

/// R and ω at [`ORDER_TIME`], by RK4.
fn reference(h: f64) -> [f64; 12] {
    let steps = (ORDER_TIME / h).round() as u64;
    (0..steps).fold(entries(&begin()), |y, _| rk4(&y, h, |y| TOP.motion(y)))
}

fn errors<M: Method<Top, f64> + Clone>(method: M, expected: &[f64; 12]) -> Result<[f64; 3]> {
    let mut errors = [f64::NAN; 3];
    for (error, h) in errors.iter_mut().zip(ORDER_STEPS) {
        let mut run = Integrator::new(&TOP, method.clone(), h, begin())?;
        run.take_steps((ORDER_TIME / h).round() as u64)?;
        *error = difference(&entries(&run.state()), expected);
    }
    Ok(errors)
}

fn nutation(end: f64) -> Result<[Nutation; 3]> {
    let one = |h: f64| -> Result<Nutation> {
        let (heights, shift) = (TOP.heights(&begin()), TOP.shift(&begin()));
        let (mut turnings, mut shadow) = (Turnings::new(h), Shadow::new(h, energy(&heights), shift));
        let mut run = Integrator::new(&TOP, Geodesic::trapezoid(), h, begin())?;
        for _ in 0..(end / h).round() as u64 {
            run.advance()?;
            let state = run.state();
            let ([height, rate], shift) = (Top::height(&state), TOP.shift(&state));
            shadow.push(run.energy(), shift);
            turnings.push(Sample { height, rate, shift });
        }
        Ok(Nutation { extremes: turnings.against(&heights, shift), energy: shadow })
    };
    let [coarse, middle, fine] = NUTATION_STEPS;
    Ok([one(coarse)?, one(middle)?, one(fine)?])
}

fn curves() -> Result<[Curve; 3]> {
    let one = |(precession, name): (f64, &'static str)| -> Result<Curve> {
        let start = Top::leaning(LEANING, [0.0, precession, SPINNING]);
        let mut run = Integrator::new(&TOP, Geodesic::trapezoid(), DRAWN_STEP, start)?;
        let mut path = vec![above(&start)];
        for _ in 0..(DRAWN / DRAWN_STEP) as u64 {
            run.advance()?;
            path.push(above(&run.state()));
        }
        Ok(Curve { name, path, extremes: TOP.heights(&start).extremes() })
    };
    let [first, second, third] = CURVES;
    Ok([one(first)?, one(second)?, one(third)?])
}

/// Where the axis points, seen from above.
fn above(state: &TopState) -> [f64; 2] {
    [state.R[2], state.R[5]]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_integrals_by_hand_are_those_of_the_declaration() {
        let (start, system) = (begin(), TOP);
        let heights = system.heights(&start);
        let run = Integrator::new(&system, Geodesic::trapezoid(), H, start).expect("a run");
        assert!((energy(&heights) - run.energy()).abs() < 1e-14);
        assert_eq!(run.momentum(0), Some(heights.spin));
        let vertical = run.momentum(1).expect("two momenta");
        assert!((heights.vertical - vertical).abs() < 1e-15);
    }

    #[test]
    fn the_motion_by_hand_keeps_the_integrals() {
        let (before, after) = (TOP.heights(&begin()), TOP.heights(&state(&reference(FINE))));
        let pairs =
            [(before.energy, after.energy), (before.spin, after.spin), (before.vertical, after.vertical)];
        assert!(pairs.into_iter().all(|(before, after)| (before - after).abs() < 1e-11), "{pairs:?}");
    }
}
