//! Gauss collocation and explicit Runge–Kutta methods on Hamilton's equations of regular systems.

use dvi_core::prelude::*;
use dvi_tests::{Outcome, apart};

/// Two oscillators of frequency 1 whose velocities are coupled, and beside them dF/dt of F = t x y + x³ y:
/// the motion is that without it, and p = M v + ∂F/∂q.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2) - x * x - y * y) / 2.0 + 0.3 * (dot(x) * dot(y) - x * y)
        + x * y + (t * y + 3.0 * x * x * y) * dot(x) + (t * x + x.powi(3)) * dot(y),
)]
struct Gauged;

#[test]
fn momenta_beside_those_of_a_constant_mass_matrix_are_taken_off() -> Outcome {
    const { assert!(<Gauged as NondegenerateLagrangian>::UNIFORM_MASS) };
    const { assert!(!<Gauged as NondegenerateLagrangian>::CONSTANT_MASS) };
    fn check<M: Method<Gauged, f64>>(method: M, steps: u64, tolerance: f64) -> Outcome {
        let start = GaugedState { x: 0.8, y: -0.3, dot_x: 0.5, dot_y: 1.1 };
        let mut run = Integrator::new(&Gauged, method, 2.0 / steps as f64, start)?;
        run.take_steps(steps)?;
        let ((sin, cos), end) = (2.0_f64.sin_cos(), run.state());
        let found = [end.x, end.y, end.dot_x, end.dot_y];
        let exact =
            [0.8 * cos + 0.5 * sin, -0.3 * cos + 1.1 * sin, 0.5 * cos - 0.8 * sin, 1.1 * cos + 0.3 * sin];
        assert!(apart(&found, &exact) < tolerance, "{found:?}, not {exact:?}");
        Ok(())
    }
    check(Gauss::<4>::new(), 40, 1e-12)?;
    check(Gauss { summation: Summation::Compensated, ..Gauss::<4>::new() }, 40, 1e-12)?;
    check(RungeKutta::classical(), 400, 1e-9)
}

/// A pendulum as an arc of the circle of radius r.
#[lagrangian(coordinates(arc), lagrangian = dot(arc).powi(2) / 2.0 + r * r * (arc / r).cos())]
struct Arc {
    r: f64,
}

/// The square of a correction is 0 long before the correction is. In units of any power of two a fixed point
/// comes to the same numbers, and takes no fewer iterations.
#[test]
fn a_fixed_point_of_tiny_numbers_ends_no_sooner() -> Outcome {
    fn check<M: Method<Arc, f64>>(method: impl Fn() -> M) -> Outcome {
        let run = |power: i32| -> Outcome<(f64, u64)> {
            let unit = 2.0_f64.powi(power);
            let start = ArcState { arc: unit, dot_arc: -0.2 * unit };
            let system = Arc { r: unit };
            let mut run = Integrator::new(&system, method(), 0.3, start)?;
            run.take_steps(20)?;
            Ok((run.state().arc / unit, run.statistics().iterations))
        };
        let (arc, iterations) = run(0)?;
        for power in [-510, -500, -480, 480, 500] {
            let found = run(power)?;
            assert!(found.0 == arc && found.1 >= iterations, "{power}: {found:?} {arc} {iterations}");
        }
        Ok(())
    }
    let solver = Solver::FixedPoint;
    check(Gauss::<3>::new)?;
    check(|| Galerkin { solver, ..Galerkin::<5>::new() })?;
    check(|| Variational { solver, ..Variational::midpoint() })
}

/// ∂L/∂v = v³ − v has three branches, and the motion ends where one of them does.
#[lagrangian(coordinates(x), lagrangian = dot(x).powi(4) / 4.0 - dot(x).powi(2) / 2.0 - k * x * x / 2.0)]
struct Branches {
    k: f64,
}

#[test]
fn no_step_changes_the_branch_of_the_velocity() -> Outcome {
    fn ends<M: Method<Branches, f64>>(method: M, k: f64, v: f64, h: f64) -> Outcome {
        let start = BranchesState { x: 0.1, dot_x: v };
        let system = Branches { k };
        let mut run = Integrator::new(&system, method, h, start)?;
        let energy = run.energy();
        let error = run.take_steps(400).err().ok_or("no error")?;
        let off = (run.energy() - energy).abs();
        assert!(off < 0.02 && run.state().dot_x > 0.57, "{error}: {off}");
        Ok(())
    }
    ends(Gauss::<2>::new(), 1.0, 0.62, 0.05)?;
    ends(Gauss::<2>::new(), 0.1, 2.0, 0.2)?;
    ends(RungeKutta::classical(), 0.1, 2.0, 0.2)
}
