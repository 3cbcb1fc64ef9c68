//! Forces and Hamiltonians that are switched on, with jumps, corners and pulses: errors fall with the
//! tolerance all the same.

use dvi_core::methods::VariableStep;
use dvi_core::prelude::*;

use super::{Outcome, apart};

/// An oscillator, whose force jumps at a place and in time.
#[lagrangian(
    coordinates(x),
    lagrangian = dot(x).powi(2) / 2.0 - kink * x.abs() - x * x / 2.0,
    force(x) = if t > on { if t < off { 1.0 } else { 0.0 } } else { 0.0 },
)]
#[derive(Clone, Copy, Debug)]
struct Rough {
    kink: f64,
    on: f64,
    off: f64,
}

const SMOOTH: Rough = Rough { kink: 0.0, on: 0.0, off: 0.0 };

/// y' = ∂H/∂x, x' = −∂H/∂y, with corners on the axes.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = x * d(y),
    hamiltonian = x.abs() + y.abs(),
)]
pub(super) struct Corners;

/// The error at time `end`, in units of each tolerance, for two and eight stages.
fn check_rough<S: Lagrangian>(
    system: &S,
    start: &S::State<f64>,
    [end, longest_step]: [f64; 2],
    exact: &[f64],
    [most_of_two, most_of_eight]: [f64; 2],
) -> Outcome
where
    Gauss<2>: VariableStep<S, f64>,
    Gauss<8>: VariableStep<S, f64>,
{
    fn error<S: Lagrangian, M: VariableStep<S, f64>>(
        (system, method, control): (&S, M, ErrorControl<'_>),
        start: &S::State<f64>,
        end: f64,
        exact: &[f64],
    ) -> Outcome<f64> {
        let mut run = Integrator::controlled(system, method, control, start.clone())?;
        while run.time() + control.longest_step < end {
            run.advance()?;
            assert!(run.step_size() <= control.longest_step);
        }
        run.advance_to(end)?;
        Ok(apart(run.q(), exact) / control.tolerance.relative)
    }
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let control = ErrorControl { longest_step, ..ErrorControl::new(tolerance, 0.01) };
        let of_eight = error((system, Gauss::<8>::new(), control), start, end, exact)?;
        let name = S::REPORT.system;
        if tolerance > 1e-12 {
            let of_two = error((system, Gauss::<2>::new(), control), start, end, exact)?;
            assert!(of_two < most_of_two, "{name}, two stages at {tolerance:e}: {of_two}");
        }
        assert!(of_eight < most_of_eight, "{name}, eight stages at {tolerance:e}: {of_eight}");
    }
    Ok(())
}

const ANY: f64 = f64::INFINITY;

#[test]
fn errors_fall_with_the_tolerance_where_forces_jump() -> Outcome {
    let at_rest = |x| RoughState { x, dot_x: 0.0 };
    // A pulse on an oscillator. Points in a step of 0.6 are nearer to one another than it lasts.
    let pulse = Rough { on: 50.0, off: 50.2, ..SMOOTH };
    let x = 100_f64.cos() + 49.8_f64.cos() - 50_f64.cos();
    check_rough(&pulse, &at_rest(1.0), [100.0, 0.6], &[x], [3000.0, 30.0])?;
    // Oscillators around −ε and ε, from where that at ε crosses zero: a jump of a part 2ε of the force.
    for kink in [1e-4_f64, 1e-2, 3.0] {
        let quarter = (kink / (1.0 + kink)).acos();
        let turns = (20.0 / (2.0 * quarter)).round();
        let x = (1.0 + kink) * (20.0 - 2.0 * quarter * turns).cos() - kink;
        let x = if turns % 2.0 == 0.0 { x } else { -x };
        check_rough(&Rough { kink, ..SMOOTH }, &at_rest(1.0), [20.0, ANY], &[x], [1000.0, 30.0])?;
    }
    Ok(())
}

#[test]
fn errors_fall_with_the_tolerance_around_corners() -> Outcome {
    // |x| + |y| = 1.3 at the velocity √2.
    let exact = |mut x: f64, mut y: f64, mut left: f64| {
        while left > 0.0 {
            let [dx, dy] = [-y.signum(), x.signum()];
            let until = if dx * x < 0.0 { x.abs() } else { y.abs() };
            let h = f64::min(until, left);
            (x, y, left) = (x + h * dx, y + h * dy, left - h);
            // On to the next side.
            let [next_x, next_y] = [dx * 1e-300, dy * 1e-300];
            (x, y) = (if x == 0.0 { next_x } else { x }, if y == 0.0 { next_y } else { y });
        }
        [x, y]
    };
    let start = CornersState { x: 1.0, y: 0.3 };
    check_rough(&Corners, &start, [9.3, ANY], &exact(1.0, 0.3, 9.3), [100.0, 100.0])
}
