//! Functions of several variables that hold data, in formulas: how often they are evaluated, where they may
//! come from, and what happens where they are not known.

use approx::assert_abs_diff_eq;
use dvi_tests::{Outcome, failing};
use std::cell::Cell;

use dvi_core::error::OutsideError;
use dvi_core::field::{Expansion, ScalarField};
use dvi_core::prelude::*;
use dvi_core::{Scalar, Space, Weights};

/// a sin(kx) e^(−y²) + x²y, with derivatives by hand; it counts its evaluations.
#[derive(Debug, Default)]
struct Hill {
    a: f64,
    k: f64,
    evaluations: Cell<usize>,
}

impl Hill {
    fn new(a: f64, k: f64) -> Self {
        Self { a, k, ..Self::default() }
    }
}

impl ScalarField<2> for Hill {
    fn expansion<T: Scalar>(&self, [x, y]: [T; 2]) -> Expansion<2, T> {
        self.evaluations.set(self.evaluations.get() + 1);
        let (a, k, two) = (T::lift(self.a), T::lift(self.k), T::lift(2.0));
        let (s, c, e) = ((k * x).sin(), (k * x).cos(), (-y * y).exp());
        let mixed = -two * a * k * c * e * y + two * x;
        let bend = two * a * s * e * (two * y * y - T::lift(1.0));
        Expansion {
            value: a * s * e + x * x * y,
            gradient: [a * k * c * e + two * x * y, -two * a * s * e * y + x * x],
            hessian: [[-a * k * k * s * e + two * y, mixed], [mixed, bend]],
        }
    }
}

#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = psi(x, y) * y * d(x),
    hamiltonian = psi(x, y).powi(2) + psi(x - y, 2.0 * y) + x * psi(x, y),
)]
struct Drift<P> {
    psi: P,
}

fn assert_close(found: f64, expected: f64) {
    assert_abs_diff_eq!(found, expected, epsilon = 1e-12 * (1.0 + expected.abs()));
}

/// ψ stands at two points, (x, y) and (x − y, 2y), in five places of L.
#[test]
fn terms_at_the_same_arguments_share_an_evaluation() -> Outcome {
    let system = Drift { psi: Hill::new(0.3, 1.7) };
    let count = |call: &dyn Fn()| {
        system.psi.evaluations.set(0);
        call();
        system.psi.evaluations.get()
    };
    let ([q, v], w) = ([[0.4, -0.7], [0.3, 1.1]], Weights { qq: 1.0, qv: 1.0, vq: 1.0, vv: 1.0 });
    assert_eq!(count(&|| _ = system.hamiltonian(&q, 0.0)), 2);
    assert_eq!(count(&|| system.one_form(&q, 0.0, &mut [0.0; 2])), 1);
    assert_eq!(count(&|| system.gradient(&q, &v, 0.0, &mut [0.0; 2], &mut [0.0; 2])), 2);
    let linearize = || {
        let mut matrix = system.space().matrix();
        system.linearize(&q, &v, 0.0, w, &mut [0.0; 2], &mut [0.0; 2], &mut matrix);
    };
    assert_eq!(count(&linearize), 2);
    Ok(())
}

/// One function for all particles of an array, borrowed, and one whose place is a path.
#[degenerate_lagrangian(
    coordinates(x[N], y[N]),
    one_form = sum(0..N, |j| (x[j] + well(x[j])) * d(y[j])),
    hamiltonian = sum(0..N, |j| psi(x[j], y[j])) + sum_pairs(0..N, |j, k| well(x[j] - x[k])),
    functions(well = self::WELL),
)]
struct Particles<'a, const N: usize> {
    psi: &'a Hill,
}

/// x⁴/4
#[derive(Debug)]
struct Well;

const WELL: Well = Well;

impl ScalarField<1> for Well {
    fn expansion<T: Scalar>(&self, [x]: [T; 1]) -> Expansion<1, T> {
        let square = x * x;
        Expansion {
            value: square * square / T::lift(4.0),
            gradient: [square * x],
            hessian: [[T::lift(3.0) * square]],
        }
    }
}

/// The same particles, with the formulas written out.
#[degenerate_lagrangian(
    coordinates(x[N], y[N]),
    one_form = sum(0..N, |j| (x[j] + x[j].powi(4) / 4.0) * d(y[j])),
    hamiltonian = sum(0..N, |j| a * (k * x[j]).sin() * (-y[j] * y[j]).exp() + x[j] * x[j] * y[j])
        + sum_pairs(0..N, |j, k| (x[j] - x[k]).powi(4) / 4.0),
)]
struct WrittenOut<const N: usize> {
    a: f64,
    k: f64,
}

#[test]
fn derivatives_are_those_of_the_formulas_written_out() {
    let hill = Hill::new(0.3, 1.7);
    fn seen<S: DegenerateLagrangian>(system: &S) -> [f64; 18] {
        let (q, v) = ([0.6, 0.9, 1.2, 0.1, -0.4, 0.3], [0.2, -0.5, 0.7, 0.3, 0.4, -0.1]);
        let [mut l_q, mut l_v, mut gradient] = [[0.0; 6]; 3];
        system.gradient(&q, &v, 0.0, &mut l_q, &mut l_v);
        system.hamiltonian_gradient(&q, 0.0, &mut gradient);
        core::array::from_fn(|k| [l_q, l_v, gradient].as_flattened()[k])
    }
    let (called, written) = (Particles::<3> { psi: &hill }, WrittenOut::<3> { a: 0.3, k: 1.7 });
    for (found, expected) in seen(&called).into_iter().zip(seen(&written)) {
        assert_close(found, expected);
    }
}

/// x², known for 0 ≤ x ≤ 2 only.
#[derive(Debug)]
struct Table;

impl ScalarField<1> for Table {
    fn expansion<T: Scalar>(&self, [x]: [T; 1]) -> Expansion<1, T> {
        let inside = x.piecewise(|x| if (0.0..=2.0).contains(&x) { 0.0 } else { f64::NAN });
        let two = T::lift(2.0) + inside;
        Expansion { value: x * x + inside, gradient: [two * x], hessian: [[two]] }
    }

    fn domain(&self) -> [(f64, f64); 1] {
        [(0.0, 2.0)]
    }
}

/// x decreases at the rate 1.
#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = y + slope(x) / 10.0)]
struct Drifting {
    slope: Table,
}

#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - slope(x))]
struct Falling {
    slope: Table,
}

/// Runs until the table ends: the last good state lies in it but for rounding, and the error has the
/// argument and the bounds.
fn ends_at_the_edge<R: Run<Scalar = f64>>(method: &str, mut run: R) -> Outcome {
    let error = run.take_steps(1000).err().ok_or("an error")?;
    let StepFailure::Outside(OutsideError { argument, value, bound }) = error.failure else {
        panic!("{method}: {error}")
    };
    assert_eq!((argument.function, argument.number, bound), ("slope", 1, 0.0), "{method}");
    assert!((-0.5..0.0).contains(&value), "{method}: {error}");
    assert!((-1e-15..0.2).contains(&run.q()[0]), "{method}: {:?}", run.q());
    assert_eq!(error.step, run.steps(), "{method}");
    Ok(())
}

macro_rules! end_at_the_edge {
    ($system:expr, $start:expr, [$($method:expr),* $(,)?]) => {
        $(ends_at_the_edge(
            stringify!($method),
            Integrator::new(&$system, $method, 0.1, $start)?,
        )?;)*
    };
}

#[test]
fn a_run_that_leaves_the_table_ends_with_the_argument_that_did() -> Outcome {
    end_at_the_edge!(
        Drifting { slope: Table },
        DriftingState { x: 1.0, y: 0.2 },
        [
            OneStep::midpoint(),
            OneStep::trapezoid(),
            OneStepGauss::<2>::new(),
            Projected::symmetric(),
            Sigma::midpoint(),
            Gauss::<2>::new(),
            RungeKutta::classical(),
        ]
    );
    end_at_the_edge!(
        Falling { slope: Table },
        FallingState { x: 1.0, dot_x: 0.2 },
        [
            Variational::trapezoid(),
            Variational::midpoint(),
            Galerkin::<3>::new(),
            Newmark::new(0.25),
            Gauss::<2>::new(),
            RungeKutta::classical(),
        ]
    );
    Ok(())
}

#[test]
fn a_run_does_not_begin_outside_of_the_table() -> Outcome {
    let start = DriftingState { x: 2.5, y: 0.2 };
    let error = Integrator::new(&Drifting { slope: Table }, OneStep::midpoint(), 0.1, start)
        .err()
        .ok_or("an error")?;
    assert_eq!(
        error.to_string(),
        "`slope` is not known there: its argument 1 is 2.5, and must be at most 2"
    );
    let error = Drifting { slope: Table }.vector_field(0.0, &start).err().ok_or("an error")?;
    assert!(matches!(error, StartError::Outside(_)), "{error}");
    Ok(())
}

/// A table that a formula keeps away from: it is not to blame where it is not asked, and does not keep a run
/// from beginning.
#[lagrangian(
    coordinates(x),
    lagrangian = dot(x).powi(2) / 2.0 - if x < 1.5 { slope(x) } else { 0.0 } + (3.0 - x).sqrt() / 1e3,
)]
struct Guarded {
    slope: Table,
}

#[test]
fn a_table_that_is_not_asked_is_not_to_blame() -> Outcome {
    let system = Guarded { slope: Table };
    let start = GuardedState { x: 2.2, dot_x: 2.0 };
    assert!(system.energy_at(0.0, &start).is_ok());
    let (_, error) = failing(&system, Variational::trapezoid(), 0.1, start)?;
    assert!(matches!(error.failure, StepFailure::NotFinite { .. }), "{error}");
    // From where it is asked.
    let start = GuardedState { x: 0.2, dot_x: -1.0 };
    let (_, error) = failing(&system, Variational::trapezoid(), 0.1, start)?;
    assert!(matches!(error.failure, StepFailure::Outside(_)), "{error}");
    let start = GuardedState { x: -0.2, dot_x: -1.0 };
    let error = Integrator::new(&system, Variational::trapezoid(), 0.1, start).err().ok_or("an error")?;
    assert!(matches!(error, StartError::Outside(_)), "{error}");
    Ok(())
}

/// Driven out of the table by a form that depends on time, and in a velocity.
#[degenerate_lagrangian(coordinates(x, y), one_form = (y - 3.0 * t) * d(x), hamiltonian = slope(y))]
struct Driven {
    slope: Table,
}

#[lagrangian(coordinates(x), lagrangian = slope(dot(x)) + 5.0 * x)]
struct Fast {
    slope: Table,
}

#[test]
fn whatever_drives_a_run_out_of_the_table_is_seen() -> Outcome {
    macro_rules! ends_outside {
        ($system:expr, $start:expr, $h:expr, [$($method:expr),* $(,)?]) => {$(
            let (_, error) = failing(&$system, $method, $h, $start)?;
            assert!(matches!(error.failure, StepFailure::Outside(_)), "{}: {error}", stringify!($method));
        )*};
    }
    let driven = Driven { slope: Table };
    let start = DrivenState { x: 0.0, y: 0.5 };
    ends_outside!(driven, start, 0.1, [Gauss::<2>::new(), OneStep::midpoint()]);
    let fast = Fast { slope: Table };
    let start = FastState { x: 0.0, dot_x: 1.0 };
    ends_outside!(fast, start, 0.1, [Variational::midpoint(), RungeKutta::classical()]);
    let limited = EnergyLimit { method: RungeKutta::midpoint(), limit: 1.0 };
    ends_outside!(Falling { slope: Table }, FallingState { x: 1.0, dot_x: 0.2 }, 0.1, [limited]);
    Ok(())
}

/// A failure that has another reason keeps it, even if there are tables.
#[test]
fn other_failures_are_not_laid_on_the_table() -> Outcome {
    let system = Falling { slope: Table };
    let start = FallingState { x: 1.0, dot_x: 0.0 };
    let limited = EnergyLimit { method: Variational::trapezoid(), limit: 1e-9 };
    let (_, error) = failing(&system, limited, 0.1, start)?;
    assert!(matches!(error.failure, StepFailure::Energy { .. }), "{error}");
    Ok(())
}
