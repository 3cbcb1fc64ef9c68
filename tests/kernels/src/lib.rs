//! The steps that are measured: generated, and beside each the same scheme by hand.

mod kepler_by_hand;
mod predators_by_hand;
mod rattle_by_hand;
mod systems;
mod top_by_hand;
pub mod vortices_by_hand;
pub mod wide;

use dvi_core::discrete::{Frequency, Interval, OneNode, Rule, Span};
use dvi_core::prelude::*;
use dvi_core::rotations;
use dvi_core::{Real, Scalar, Space, Vector};
use std::hint::black_box;
use systems::{
    Kepler, KeplerState, Neumann, NeumannState, OneSided, OneSidedState, PointVortices, PointVorticesState,
    Top, TopState,
};

/// The names, pairwise: generated, by hand.
pub const KERNELS: [[&str; 2]; 12] = [
    ["explicit/generated", "explicit/by hand"],
    ["explicit, each state read/generated", "explicit, each state read/by hand"],
    ["explicit, parasitic mode limited/generated", "explicit, parasitic mode limited/by hand"],
    ["fixed point/generated", "fixed point/by hand"],
    ["newton/generated", "newton/by hand"],
    ["residual and matrix/generated", "residual and matrix/by hand"],
    ["Kepler, Verlet/generated", "Kepler, Verlet/by hand"],
    ["Kepler, Simpson fitted to √(|a|÷|q|)/generated", "Kepler, Simpson fitted to √(|a|÷|q|)/by hand"],
    ["Kepler, Simpson fitted to r^(−3÷2)/generated", "Kepler, Simpson fitted to r^(−3÷2)/by hand"],
    ["predators, one step/generated", "predators, one step/by hand"],
    ["sphere, RATTLE/generated", "sphere, RATTLE/by hand"],
    ["top, geodesic/generated", "top, geodesic/by hand"],
];

const H: f64 = 0.1;
/// The step on two leapfrogging pairs.
const LONG: f64 = 1.0;
const GAMMA: [f64; 4] = [1.0; 4];

fn start() -> vortices_by_hand::State {
    let (_, state) = systems::quasi_periodic();
    std::array::from_fn(|i| if i < 4 { state.x[i] } else { state.y[i - 4] })
}

/// Runs a kernel from its start for a number of steps and returns its first coordinate.
///
/// Each call begins anew: the explicit scheme does not stay on an orbit for ever.
pub fn run(name: &str, steps: u64) -> f64 {
    let field = vortices_by_hand::Field::new(GAMMA);
    match name {
        "explicit/generated" => generated(explicit(), |run| run.take_steps(steps)),
        "explicit, each state read/generated" => generated(explicit(), |run| {
            (0..steps).try_for_each(|_| {
                run.advance()?;
                black_box(run.q());
                Ok(())
            })
        }),
        "fixed point/generated" => generated(implicit(Solver::FixedPoint), |run| run.take_steps(steps)),
        "newton/generated" => generated(implicit(Solver::Newton), |run| run.take_steps(steps)),
        "explicit, parasitic mode limited/generated" => limited(steps),
        "explicit, parasitic mode limited/by hand" => limited_by_hand(steps),
        "residual and matrix/generated" => residual_and_matrix(steps),
        "residual and matrix/by hand" => residual_and_matrix_by_hand(field, steps),
        "explicit/by hand" => {
            let mut leapfrog = vortices_by_hand::Leapfrog::new(field, H, start());
            (0..steps).for_each(|_| leapfrog.step());
            leapfrog.z[0]
        }
        "explicit, each state read/by hand" => {
            let mut leapfrog = vortices_by_hand::Leapfrog::new(field, H, start());
            (0..steps).for_each(|_| {
                leapfrog.step();
                black_box(&leapfrog.z);
            });
            leapfrog.z[0]
        }
        "fixed point/by hand" => {
            let mut midpoint = vortices_by_hand::Midpoint::new(field, H, start());
            (0..steps).for_each(|_| midpoint.step_by_fixed_point());
            midpoint.z[0]
        }
        "Kepler, Verlet/generated" => verlet(steps),
        "predators, one step/generated" => one_step(steps),
        "predators, one step/by hand" => {
            let mut scheme = predators_by_hand::OneStepMidpoint::new(H, black_box([2.0, 1.0]));
            (0..steps).for_each(|_| scheme.step());
            scheme.q[0]
        }
        "top, geodesic/generated" => top(steps),
        "top, geodesic/by hand" => {
            let (attitude, omega) = black_box(([0.3_f64.cos(), 0.3_f64.sin(), 0.0, 0.0], TOP_START));
            let mut scheme = top_by_hand::Top::new(TOP_H, black_box(TOP), attitude, omega);
            (0..steps).for_each(|_| scheme.step());
            scheme.height()
        }
        "sphere, RATTLE/generated" => rattle(steps),
        "sphere, RATTLE/by hand" => {
            let NeumannState { r, dot_r } = black_box(ON_SPHERE);
            let mut scheme = rattle_by_hand::Rattle::new(H, black_box(NEUMANN), r, dot_r);
            (0..steps).for_each(|_| scheme.step());
            scheme.r[0]
        }
        "Kepler, Simpson fitted to √(|a|÷|q|)/generated" => {
            fitted_simpson(Radial(Reading::Averaged), steps)
        }
        "Kepler, Simpson fitted to r^(−3÷2)/generated" => fitted_simpson(Power, steps),
        "Kepler, Simpson fitted to √(|a|÷|q|)/by hand" => {
            fitted_simpson_by_hand(kepler_by_hand::Frequency::Radial, steps)
        }
        "Kepler, Simpson fitted to r^(−3÷2)/by hand" => {
            fitted_simpson_by_hand(kepler_by_hand::Frequency::Power, steps)
        }
        "Kepler, Verlet/by hand" => {
            let mut verlet = kepler_by_hand::Verlet::new(KEPLER_H, [0.8, 0.0], [0.0, 1.5_f64.sqrt()]);
            (0..steps).for_each(|_| verlet.step());
            verlet.q[0]
        }
        "newton/by hand" => {
            let mut midpoint = vortices_by_hand::Midpoint::new(field, H, start());
            (0..steps).for_each(|_| midpoint.step_by_newton());
            midpoint.z[0]
        }
        _ => f64::NAN,
    }
}

/// The residual and the matrix of Newton's method for an increment of zero, of which the entry (x₁, y₂)
/// moves the first vortex.
#[inline(never)]
fn residual_and_matrix(steps: u64) -> f64 {
    let system = black_box(systems::quasi_periodic().0);
    let space = system.space();
    let (mut z, delta) = (start(), [0.0; 8]);
    let mut l_d = OneNode::new(&system, 0.5);
    let (mut residual, mut matrix): (Vector<PointVortices<4>, f64>, _) = (space.vector(), space.matrix());
    for _ in 0..steps {
        residual.fill(0.0);
        matrix.fill(0.0);
        let interval = Interval { t: 0.0, h: H };
        let span = Span { system: &system, interval, q0: &z, delta: &delta };
        l_d.linearize(span, &mut residual, &mut matrix);
        black_box((&residual, &matrix));
        z[0] += 2.0 * matrix[5];
    }
    z[0]
}

#[inline(never)]
fn residual_and_matrix_by_hand(field: vortices_by_hand::Field, steps: u64) -> f64 {
    let (mut z, field) = (start(), black_box(field));
    for _ in 0..steps {
        let (v, matrix) = field.newton_matrix(&z, 0.5 * H);
        black_box((&v.map(|v| -H * v), &matrix));
        z[0] += matrix[4][5];
    }
    z[0]
}

fn implicit(solver: Solver) -> Sigma {
    Sigma { solver, stopping: stopping(), ..Sigma::midpoint() }
}

fn stopping() -> Stopping {
    Stopping { tolerance: 1e-12, ..Stopping::default() }
}

#[inline(never)]
fn one_step(steps: u64) -> f64 {
    let system = black_box(OneSided { a: [1.0, 1.0], b: [-1.0, -2.0] });
    let mut method = OneStep::midpoint();
    method.stopping = stopping();
    let Ok(mut run) = Integrator::new(&system, method, H, OneSidedState { x: 2.0, y: 1.0 }) else {
        return f64::NAN;
    };
    match run.take_steps(steps) {
        Ok(()) => run.q()[0],
        Err(_) => f64::NAN,
    }
}

const NEUMANN: (f64, [f64; 3]) = (1.0, [1.0, 2.0, 3.5]);
const ON_SPHERE: NeumannState = NeumannState { r: [0.6, 0.0, -0.8], dot_r: [0.4, 1.0, 0.3] };

#[inline(never)]
fn rattle(steps: u64) -> f64 {
    let (m, k) = NEUMANN;
    let system = black_box(Neumann { m, k });
    let method = Rattle { stopping: stopping(), ..Rattle::default() };
    let Ok(mut run) = Integrator::new(&system, method, H, ON_SPHERE) else { return f64::NAN };
    match run.take_steps(steps) {
        Ok(()) => run.q()[0],
        Err(_) => f64::NAN,
    }
}

const TOP: ([f64; 3], f64) = ([1.0, 1.0, 0.5], 1.2);
const TOP_START: [f64; 3] = [0.2, 0.1, 6.0];
const TOP_H: f64 = 0.05;

#[inline(never)]
fn top(steps: u64) -> f64 {
    let (inertia, weight) = TOP;
    let system = black_box(Top { inertia, weight });
    let method = Geodesic { stopping: stopping(), ..Geodesic::trapezoid() };
    let start = TopState { R: rotations::exp([0.6, 0.0, 0.0]), omega_R: TOP_START };
    let Ok(mut run) = Integrator::new(&system, method, TOP_H, start) else { return f64::NAN };
    match run.take_steps(steps) {
        Ok(()) => run.q()[8],
        Err(_) => f64::NAN,
    }
}

/// e = 0.2, 200 steps a period.
const KEPLER_H: f64 = core::f64::consts::TAU / 200.0;

#[inline(never)]
fn verlet(steps: u64) -> f64 {
    kepler(Variational::trapezoid(), steps)
}

#[inline(always)]
fn kepler<F: Frequency, R: Rule>(method: Variational<F, R>, steps: u64) -> f64 {
    let system = black_box(Kepler { mu: 1.0 });
    let start = KeplerState { x: 0.8, y: 0.0, dot_x: 0.0, dot_y: 1.5_f64.sqrt() };
    let Ok(mut run) = Integrator::new(&system, method, KEPLER_H, start) else { return f64::NAN };
    match run.take_steps(steps) {
        Ok(()) => run.q()[0],
        Err(_) => f64::NAN,
    }
}

fn explicit() -> Sigma {
    // The parasitic mode takes over within the steps that are counted.
    Sigma { start: Start::RungeKutta(RungeKutta::midpoint()), parasitic_limit: None, ..Sigma::leapfrog() }
}

/// On pairs that keep their motion.
#[inline(never)]
fn limited(steps: u64) -> f64 {
    let limited = Sigma { start: Start::RungeKutta(RungeKutta::midpoint()), ..Sigma::leapfrog() };
    generated_from(systems::leapfrogging(), limited, LONG, |run| run.take_steps(steps))
}

#[inline(never)]
fn limited_by_hand(steps: u64) -> f64 {
    let (PointVortices { gamma }, PointVorticesState { x, y }) = systems::leapfrogging();
    let field = vortices_by_hand::Field::new(black_box(gamma));
    let start = std::array::from_fn(|i| if i < 4 { x[i] } else { y[i - 4] });
    let mut leapfrog = vortices_by_hand::Leapfrog::new(field, LONG, start);
    (0..steps).for_each(|_| leapfrog.step());
    leapfrog.z[0]
}

type SigmaRun<'a> = Integrator<&'a PointVortices<4>, Sigma>;

#[inline(always)]
fn generated(method: Sigma, take: impl FnOnce(&mut SigmaRun<'_>) -> Result<(), StepError>) -> f64 {
    generated_from(systems::quasi_periodic(), method, H, take)
}

#[inline(always)]
fn generated_from(
    (system, state): (PointVortices<4>, PointVorticesState<4>),
    method: Sigma,
    h: f64,
    take: impl FnOnce(&mut SigmaRun<'_>) -> Result<(), StepError>,
) -> f64 {
    let system = black_box(system);
    let Ok(mut run) = Integrator::new(&system, method, h, state) else { return f64::NAN };
    match take(&mut run) {
        Ok(()) => run.q()[0],
        Err(_) => f64::NAN,
    }
}

fn fitted_simpson<F: Frequency>(frequency: F, steps: u64) -> f64 {
    let rule = Variational { solver: Solver::FixedPoint, stopping: stopping(), ..Variational::simpson() };
    kepler(rule.phase_fitted(frequency), steps)
}

#[inline(always)]
fn fitted_simpson_by_hand(frequency: kepler_by_hand::Frequency, steps: u64) -> f64 {
    let (q, p) = ([0.8, 0.0], [0.0, 1.5_f64.sqrt()]);
    let mut simpson = kepler_by_hand::FittedSimpson::new(frequency, KEPLER_H, 1e-12, q, p);
    (0..steps).for_each(|_| simpson.step());
    simpson.q[0]
}

/// r^(−3/2), a frequency of the user's own.
#[derive(Debug)]
struct Power;

impl Frequency for Power {
    fn reading(&self) -> Option<Reading> {
        Some(Reading::Averaged)
    }

    #[inline(always)]
    fn at<T: Real>(&self, q: &[T], _v: &[T], _a: &[T]) -> T {
        let square = q[0] * q[0] + q[1] * q[1];
        Scalar::sqrt(T::lift(1.0) / (square * Scalar::sqrt(square)))
    }
}
