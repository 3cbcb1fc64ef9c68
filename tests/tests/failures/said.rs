//! What users read of a failure: `Debug`, which `main` prints of an error that it returns, is its sentence.

use core::error::Error;
use core::fmt::{Debug, Display};

use dvi_core::error::{CheckpointError, IndexError, LengthError};
use dvi_core::prelude::*;
use dvi_tests::failing;

/// Masses that are driven away.
#[lagrangian(
    coordinates(y, x[4]),
    lagrangian = dot(y).powi(2) / 2.0 + sum(0..4, |j| dot(x[j]).powi(2) / 2.0 + x[j].exp()),
)]
struct Driven {}

fn are_one<E: Debug + Display>(error: &E) {
    assert_eq!(format!("{error:?}"), error.to_string());
}

#[test]
fn errors_of_a_step_are_their_sentences() -> Result<(), Box<dyn Error>> {
    let start = DrivenState { y: 0.0, dot_y: 0.0, x: [0.0, 0.1, 600.0, 0.2], dot_x: [0.0; 4] };
    let (_, error) = failing(&Driven {}, Variational::trapezoid(), 0.1, start)?;
    assert!(matches!(error.failure, StepFailure::NotFinite { coordinate: 3, .. }), "{error}");
    let message = error.to_string();
    assert!(
        message.starts_with(&format!("step {} from t = {}: `x[2]` became ", error.step, error.time)),
        "{message}"
    );
    are_one(&error);
    are_one(&error.failure);
    let boxed: Box<dyn Error> = error.into();
    assert_eq!(format!("{boxed:?}"), message);
    Ok(())
}

/// How the first step fails, without the step and the time.
fn first_failure<S, M>(system: S, method: M, h: f64, start: S::State<f64>) -> Result<String, Box<dyn Error>>
where
    S: Lagrangian,
    M: Method<S, f64>,
{
    let error = Integrator::new(system, method, h, start)?.advance().err().ok_or("no error")?;
    are_one(&error);
    Ok(error.to_string().strip_prefix("step 0 from t = 0: ").ok_or("a step")?.to_string())
}

/// The mass of x[1] is zero at the midpoint of the first step.
#[lagrangian(coordinates(y, x[2]), lagrangian = (dot(y).powi(2) + dot(x[0]).powi(2) + x[1] * dot(x[1]).powi(2)) / 2.0)]
struct Masses;

/// The midpoint rule does not determine a step of length 1 along x[1].
#[lagrangian(
    coordinates(x[3]),
    lagrangian = sum(0..3, |j| dot(x[j]).powi(2)) / 2.0 + 2.0 * x[1] * x[1] - x[0] * x[0] - x[2].powi(4),
)]
struct Discrete;

#[test]
fn a_singular_matrix_has_its_name_and_that_of_a_coordinate() -> Result<(), Box<dyn Error>> {
    let masses = MassesState { y: 0.0, x: [0.0, 1.0], dot_y: 0.0, dot_x: [0.0, -2.0] };
    let said = first_failure(Masses, RungeKutta::midpoint(), 1.0, masses)?;
    assert!(said.starts_with("the mass matrix is singular: its pivot for `x[1]` is "), "{said}");

    let discrete = DiscreteState { x: [0.3, 0.2, 0.1], dot_x: [0.1, 0.2, 0.3] };
    let method = Variational { solver: Solver::Newton, ..Variational::midpoint() };
    let said = first_failure(Discrete, method, 1.0, discrete)?;
    let expected = "the matrix D₁D₂L_d of the discrete Lagrangian is singular: its pivot for `x[1]` is ";
    assert!(said.starts_with(expected), "{said}");
    Ok(())
}

/// Bodies with a neighbour each, of which the second derivative of the potential of the last is infinite
/// where they begin.
#[lagrangian(
    coordinates(x[n]),
    lagrangian = sum(0..n, |i| dot(x[i]).powi(2) / 2.0 + x[i] - (x[i] - x[(i + 1) % n]).powi(2) / 4.0)
        - x[n - 1].abs().powf(1.5),
)]
struct Cusp {
    n: usize,
}

#[test]
fn a_matrix_that_is_infinite_ends_a_step_of_newton() -> Result<(), Box<dyn Error>> {
    // Of no coupling at all, of two equations, dense, and in a band.
    for n in [1, 2, 5, 60] {
        let method = Variational { solver: Solver::Newton, ..Variational::midpoint() };
        let start = || CuspState { x: vec![0.0; n], dot_x: vec![0.0; n] };
        let said = first_failure(Cusp { n }, method, 0.01, start())?;
        let matrix = "the matrix D₁D₂L_d of the discrete Lagrangian is not finite: its pivot for ";
        let expected = format!("{matrix}`x[{}]` is inf", n - 1);
        assert!(said == expected || said.contains("became NaN"), "n = {n}: {said}");
        // The fixed point asks for no matrix.
        let mut run = Integrator::new(Cusp { n }, Variational::midpoint(), 0.01, start())?;
        run.take_steps(10)?;
        assert!(run.state().x[n - 1] > 0.0);
    }
    Ok(())
}

#[test]
fn errors_of_a_start_are_their_sentences() {
    let start = DrivenState { y: f64::NAN, dot_y: 0.0, x: [0.0; 4], dot_x: [0.0; 4] };
    let error = Integrator::new(&Driven {}, Variational::trapezoid(), 0.1, start).err();
    let error = error.expect("a state that is no number");
    assert_eq!(format!("{error:?}"), "y = NaN in the state");
    are_one(&error);
    are_one(&LengthError { array: "x", row: None, expected: 3, found: 2 });
    are_one(&IndexError { array: "x", index: 3, len: 2 });
    are_one(&CheckpointError::Short);
}
