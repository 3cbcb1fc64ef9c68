//! A free body that turns about its middle axis and flips, by rotation matrices: against elliptic functions,
//! and its angular momentum.
//!
//! Rotation about the axis of the middle moment of inertia is unstable (Landau & Lifshitz 1976, section 37):
//! the body turns over and back, in a period that grows with the logarithm of the nearness to the axis.
//! Steps along geodesics keep the angular momentum in space, as the motion does.

mod claims;
mod flips;
mod picture;
mod series;

use anyhow::Result;
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use crate::claim::larger;
use crate::experiments::rk4::rk4;
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{RigidBody, RigidBodyState};
use flips::{Flips, Wave};
use series::Series;

pub const EXPERIMENT: Experiment = Experiment {
    name: "rigid-body",
    title: "A free body that flips, against elliptic functions",
    share: 5.0,
    run,
};

const BODY: RigidBody = RigidBody { inertia: [1.0, 2.0, 3.0] };
/// Close to the middle axis; the first component is zero where the second is largest.
const OMEGA: [f64; 3] = [0.0, 1.0, 0.02];
/// The step of the long runs, and of what is drawn.
const H: f64 = 0.05;
/// The steps with which flips are timed.
const FLIP_STEPS: [f64; 3] = [0.1, 0.05, 0.025];
/// The time at which the order is measured, the steps, and that of the reference.
const ORDER_TIME: f64 = 4.0;
const ORDER_STEPS: [f64; 3] = [0.1, 0.05, 0.025];
const FINE: f64 = 2e-3;
/// How long ω₂ is drawn.
const DRAWN: f64 = 80.0;
/// Angular velocities of the curves that are drawn: around the first and the third axis, and through the
/// neighbourhood of the second.
const AROUND: [[f64; 3]; 6] = [
    [2.0, 0.4, 0.0],
    [1.8, 0.65, 0.0],
    [1.3, 0.85, 0.0],
    [0.0, 0.4, 0.6],
    [0.0, 0.65, 0.5],
    [0.0, 0.85, 0.3],
];

/// All that is measured.
struct Measured {
    steps: u64,
    geodesic: Series,
    rk4: Series,
    wave: Wave,
    /// For each of [`FLIP_STEPS`].
    flips: [Flips; 3],
    /// The largest differences of an entry of R or ω from the reference at [`ORDER_TIME`], for each of
    /// [`ORDER_STEPS`]: by geodesics, and by their composition of order 4.
    errors: [[f64; 3]; 2],
    between_references: f64,
    /// For each of [`AROUND`] with both signs, once around.
    polhodes: Vec<Vec<RigidBodyState>>,
    /// The states at each step of the run that flips.
    flipping: Vec<RigidBodyState>,
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps: u64 = job.choose(1_000_000, 5_000);
    job.expect(2 * steps / series::EVERY);
    let wave = Wave::new(&BODY, OMEGA);
    let periods = job.choose(20.0, 1.5);
    let [coarse, middle, fine] = FLIP_STEPS.map(|h| Flips::new(&wave, h, periods));
    let exact = reference(FINE);
    let errors = [
        errors(Geodesic::trapezoid(), &exact)?,
        errors(Composition::suzuki(Geodesic::trapezoid()), &exact)?,
    ];
    let measured = Measured {
        steps,
        geodesic: Series::geodesic(job, steps)?,
        rk4: Series::rk4(job, steps)?,
        wave,
        flips: [coarse?, middle?, fine?],
        errors,
        between_references: difference(&exact, &reference(2.0 * FINE)),
        polhodes: polhodes()?,
        flipping: states(OMEGA, H, DRAWN)?,
    };
    job.publish(EXPERIMENT.name, picture::figure(&measured), picture::table(&measured)?)?;
    Ok(Outcome { claims: claims::claims(job, &measured), references: vec![], notes: vec![] })
}

fn begin() -> RigidBodyState {
    RigidBody::turning(OMEGA)
}

/// The entries of R row by row, and ω.
fn entries(state: &RigidBodyState) -> [f64; 12] {
    std::array::from_fn(|i| if i < 9 { state.R[i] } else { state.omega_R[i - 9] })
}

fn state(y: &[f64; 12]) -> RigidBodyState {
    RigidBodyState { R: std::array::from_fn(|i| y[i]), omega_R: std::array::from_fn(|i| y[9 + i]) }
}

fn difference(one: &[f64; 12], other: &[f64; 12]) -> f64 {
    one.iter().zip(other).map(|(a, b)| (a - b).abs()).fold(0.0, larger)
}

/// R and ω at [`ORDER_TIME`], by RK4.
fn reference(h: f64) -> [f64; 12] {
    let steps = (ORDER_TIME / h).round() as u64;
    (0..steps).fold(entries(&begin()), |y, _| rk4(&y, h, |y| BODY.motion(y)))
}

fn errors<M: Method<RigidBody, f64> + Clone>(method: M, expected: &[f64; 12]) -> Result<[f64; 3]> {
    let mut errors = [f64::NAN; 3];
    for (error, h) in errors.iter_mut().zip(ORDER_STEPS) {
        let mut run = Integrator::new(&BODY, method.clone(), h, begin())?;
        run.take_steps((ORDER_TIME / h).round() as u64)?;
        *error = difference(&entries(&run.state()), expected);
    }
    Ok(errors)
}

fn length(v: [f64; 3]) -> f64 {
    v.into_iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The states at each step.
fn states(omega: [f64; 3], h: f64, end: f64) -> Result<Vec<RigidBodyState>> {
    let start = RigidBody::turning(omega);
    let mut run = Integrator::new(&BODY, Geodesic::trapezoid(), h, start)?;
    let mut states = vec![start];
    for _ in 0..(end / h).round() as u64 {
        run.advance()?;
        states.push(run.state());
    }
    Ok(states)
}

fn polhodes() -> Result<Vec<Vec<RigidBodyState>>> {
    let both = AROUND.into_iter().flat_map(|omega| [omega, omega.map(|x| -x)]);
    // Each for once around, or a little more.
    both.map(|omega| states(omega, 2.0 * H, 22.0 / length(omega))).collect()
}
