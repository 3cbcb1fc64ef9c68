//! What runs with impacts preserve: the symplectic form, momenta, energy at impacts, the way back.

use approx::{abs_diff_eq, assert_abs_diff_eq};
use dvi_core::prelude::*;
use dvi_tests::zoo::impacts::*;
use dvi_tests::{apart, larger};
use nalgebra::Matrix4;
use num_dual::Dual64;

use super::Outcome;

/// The derivatives of (q, p) by each entry of a state.
type Columns = [[f64; 4]; 4];

/// The derivative of (q, p) after one step of length `h`, by the positions and velocities at its beginning,
/// and the impacts in the step.
fn jacobian<S: UnilateralLagrangian<Dual64>>(
    system: &S,
    collision: Collision,
    start: [f64; 4],
    h: f64,
) -> Outcome<(Columns, usize)> {
    let mut columns = [[0.0; 4]; 4];
    let mut impacts = 0;
    for (column, derivatives) in columns.iter_mut().enumerate() {
        let start: [Dual64; 4] =
            core::array::from_fn(|i| Dual64::new(start[i], if i == column { 1.0 } else { 0.0 }));
        let method = Impacts { collision, ..Impacts::new(Variational::trapezoid()) };
        let state = State::read(&|block| system.block_len(block), &start[..2], &start[2..]);
        let mut run = Integrator::new(system, method, Dual64::from(h), state)?;
        run.advance()?;
        impacts = run.memory().impacts().len();
        let p = run.memory().inner().p();
        *derivatives = [run.q()[0].eps, run.q()[1].eps, p[0].eps, p[1].eps];
    }
    Ok((columns, impacts))
}

/// By how much dq ∧ dp changes. The mass matrix is the identity, so p = v at the start.
fn change_of_form(columns: &Columns) -> f64 {
    let map = Matrix4::from_fn(|row, column| columns[column][row]);
    let form = Matrix4::from_fn(|i, j| f64::from(i8::from(j == i + 2) - i8::from(i == j + 2)));
    (map.transpose() * form * map - form).iter().fold(0.0, |largest, entry| larger(largest, entry.abs()))
}

/// States whose next step has impacts: just above the floor, on the way down.
fn starts() -> impl Iterator<Item = [f64; 4]> {
    (0..40).map(|k| {
        let s = f64::from(k);
        let (x, height) = ((1.7 * s).sin(), 0.002 + 0.001 * s);
        [x, 0.5 * x.cos() + height, (0.9 * s).cos(), -1.0 - 0.5 * (0.3 * s).sin()]
    })
}

#[test]
fn the_steps_with_the_discrete_energy_are_symplectic() -> Outcome {
    let (mut largest, mut of_reflection): (f64, f64) = (0.0, 0.0);
    for start in starts() {
        let (columns, impacts) = jacobian(&Wavy { a: 0.5 }, Collision::Variational, start, 0.1)?;
        assert_eq!(impacts, 1);
        largest = larger(largest, change_of_form(&columns));
        let (columns, _) = jacobian(&Wavy { a: 0.5 }, Collision::Reflection, start, 0.1)?;
        of_reflection = larger(of_reflection, change_of_form(&columns));
    }
    assert!(largest < 1e-11, "{largest:e}");
    assert!(of_reflection > 1e-4, "{of_reflection:e}");
    Ok(())
}

#[test]
fn so_are_steps_with_several_impacts() -> Outcome {
    for (speed, expected) in [(-5.0, 2), (7.0, 2), (-9.0, 3), (-14.0, 4)] {
        let (columns, impacts) = jacobian(&Slot, Collision::Variational, [0.1, 0.4, speed, 0.7], 0.1)?;
        assert_eq!(impacts, expected);
        let change = change_of_form(&columns);
        assert!(change < 1e-11, "{change:e}");
        let (columns, _) = jacobian(&Slot, Collision::Reflection, [0.1, 0.4, speed, 0.7], 0.1)?;
        assert!(change_of_form(&columns) > 1e-6, "{:e}", change_of_form(&columns));
    }
    Ok(())
}

#[test]
fn the_discrete_equations_by_hand() -> Outcome {
    // Of the trapezoidal rule: p0 = Δ/h − (h/2)F0, p1 = Δ/h + (h/2)F1, E_d = Δ²/2h² + (V0 + V1)/2.
    let force = |[x, y]: [f64; 2]| [-0.3 * x - 0.4 * x.powi(3) - 0.3 * x * y * y, -1.0 - 0.3 * x * x * y];
    let potential = |[x, y]: [f64; 2]| y + 0.15 * x * x + 0.1 * x.powi(4) + 0.15 * x * x * y * y;
    let ends = |q0: [f64; 2], q1: [f64; 2], h: f64| {
        let (f0, f1) = (force(q0), force(q1));
        let rate: [f64; 2] = core::array::from_fn(|i| (q1[i] - q0[i]) / h);
        let p0: [f64; 2] = core::array::from_fn(|i| rate[i] - h / 2.0 * f0[i]);
        let p1: [f64; 2] = core::array::from_fn(|i| rate[i] + h / 2.0 * f1[i]);
        (p0, p1, (rate[0].powi(2) + rate[1].powi(2)) / 2.0 + (potential(q0) + potential(q1)) / 2.0)
    };
    let (a, h) = (0.5, 0.1);
    let system = Wavy { a };
    for [x, y, dot_x, dot_y] in starts() {
        let method = Impacts::new(Variational::trapezoid());
        let start = WavyState { x, y, dot_x, dot_y };
        let mut run = Integrator::new(&system, method, h, start)?;
        run.advance()?;
        let [impact] = run.memory().impacts() else { return Err("one impact".into()) };
        let at = [impact.q[0], impact.q[1]];
        assert!(abs_diff_eq!(at[1], a * at[0].cos(), epsilon = 1e-15), "{at:?} is on the floor");
        let (before, after) = (impact.time, h - impact.time);
        let (p0, into, energy_before) = ends([x, y], at, before);
        let (out_of, p1, energy_after) = ends(at, [run.q()[0], run.q()[1]], after);
        // Δ/s has the rounding of the coordinates over s.
        let rounding = 1e-15 * (1.0 / before + 1.0 / after);
        let normal = [a * at[0].sin(), 1.0];
        for i in 0..2 {
            let jump = out_of[i] - into[i] - impact.impulse * normal[i];
            assert_abs_diff_eq!(p0[i], [dot_x, dot_y][i], epsilon = rounding);
            assert!(jump.abs() < 2.0 * rounding, "{jump:e} for {rounding:e}");
            assert_abs_diff_eq!(p1[i], run.memory().inner().p()[i], epsilon = rounding);
        }
        let difference = energy_after - energy_before;
        assert!(difference.abs() < 4.0 * rounding, "{difference:e} for {rounding:e}");
    }
    Ok(())
}

#[test]
fn a_run_goes_back_the_way_it_came() -> Outcome {
    macro_rules! goes_back {
        ($system:expr, $start:expr, $h:expr => $($method:expr),+ $(,)?) => {$(
            let (system, method, start) = ($system, $method, $start);
            let mut run = Integrator::new(&system, method, $h, start.clone())?;
            run.take_steps(200)?;
            let forth = run.memory().total();
            assert!(forth >= 5, "{forth} impacts say little");
            let mut back = Integrator::resume(&system, method, &run.checkpoint().with_step_size(-$h))?;
            back.take_steps(200)?;
            assert_eq!(back.memory().total(), 2 * forth, "{}", stringify!($method));
            let (found, begun): (Vec<f64>, Vec<f64>) =
                (system.values(&back.state())?.collect(), system.values(&start)?.collect());
            let distance = apart(&found, &begun);
            assert!(distance < 1e-9, "{}: {distance:e}", stringify!($method));
        )+};
    }
    goes_back! { Wavy { a: 0.2 }, WavyState { x: 0.3, y: 0.7, dot_x: 0.4, dot_y: 0.0 }, 0.06 =>
        Impacts::new(Variational::trapezoid()),
        Impacts::new(Variational::midpoint()),
        Impacts::reflecting(Galerkin::<3>::new()),
    }
    goes_back! { Bowl { b: 0.7 }, BowlState { x: 0.1, y: 0.2, dot_x: 1.1, dot_y: 0.9 }, 0.05 =>
        Impacts::new(Variational::midpoint()),
    }
    goes_back! { Ball { m: 2.0 }, BallState { y: 1.0, dot_y: 0.0 }, 0.07 =>
        Impacts { restitution: 0.95, ..Impacts::reflecting(Variational::midpoint()) },
    }
    Ok(())
}
