//! Gauss collocation and explicit Runge–Kutta methods on Hamilton's equations of regular systems.

use approx::{abs_diff_eq, assert_abs_diff_eq};
use dvi_core::methods::Method;
use dvi_core::prelude::*;
use dvi_examples::models::Orbit;
use dvi_tests::Outcome;
use dvi_tests::zoo::regular::*;
use dvi_tests::{apart, larger, run};

use crate::galerkin::many_nodes::energy_error;

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
    check(Gauss::<8>::new().in_lanes(), 10, 1e-12)?;
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
    check(|| Galerkin { solver, ..Galerkin::<5>::new() }.in_lanes())?;
    check(|| Variational { solver, ..Variational::midpoint() })
}

/// x'' = sin t.
#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 + x * t.sin())]
struct Pushed;

/// From rest at the origin without a force: all that the first guess of a step knows is zero.
#[test]
fn steps_from_rest_at_the_origin() -> Outcome {
    let start = PushedState { x: 0.0, dot_x: 0.0 };
    let gauss = run(&Pushed, Gauss::<3>::new(), start, 2.0, 40)?;
    let explicit = run(&Pushed, RungeKutta::classical(), start, 2.0, 400)?;
    let exact = 2.0 - 2.0_f64.sin();
    assert!(abs_diff_eq!(gauss[0], exact, epsilon = 1e-12), "{gauss:?}");
    assert!(abs_diff_eq!(explicit[0], exact, epsilon = 1e-10), "{explicit:?}");
    Ok(())
}

/// a x x' is the derivative of a function of x: the motion is cos t, and the momentum is v + a x.
#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - x * x / 2.0 + a * x * dot(x))]
struct Gauge {
    a: f64,
}

/// Stages are consistent where forces depend on velocities, and velocities that cancel in the momentum have
/// their rounding.
#[test]
fn terms_linear_in_the_velocity_do_not_matter() -> Outcome {
    let start = GaugeState { x: 1.0, dot_x: 0.0 };
    // The energy does not drift, however small a drift per step.
    let system = Gauge { a: 1.0 };
    let mut run = Integrator::new(&system, Gauss::<2>::new(), 0.01, start)?;
    run.take_steps(200_000)?;
    let off = run.energy() - 0.5;
    assert!(off.abs() < 1e-12, "{off:e}");
    for (a, h, bound) in [(1.0, 0.01, 1e-13), (100.0, 0.01, 1e-11), (1e3, 0.1, 1e-9), (1e4, 0.01, 1e-9)] {
        let system = Gauge { a };
        let mut run = Integrator::new(&system, Gauss::<3>::new(), h, start)?;
        run.take_steps((1.0 / h) as u64)?;
        let off = run.state().x - run.time().cos();
        assert!(off.abs() < bound, "a = {a}, h = {h}: {off:e}");
    }
    // With a tolerance, the midpoint rule on the oscillator turns by 2 atan(h/2) a step.
    let mut method = Gauss::<1>::new();
    method.stopping.tolerance = 1e-10;
    let system = Gauge { a: 1e6 };
    let mut run = Integrator::new(&system, method, 0.1, start)?;
    run.take_steps(20)?;
    let off = run.state().x - (40.0 * 0.05_f64.atan()).cos();
    assert!(off.abs() < 1e-7, "{off:e}");
    Ok(())
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
    ends(Gauss::<1>::new(), 0.1, 2.0, 0.2)?;
    ends(Gauss::<2>::new(), 0.1, 2.0, 0.2)?;
    ends(RungeKutta::classical(), 0.1, 2.0, 0.2)
}

/// Most of one period of Kepler's orbit in 16 steps, against its closed form.
#[test]
fn each_stage_of_gauss_gains_digits() -> Outcome {
    fn error<const S: usize>() -> Outcome<f64>
    where
        Gauss<S>: Tabulated,
    {
        let found = run(&KEPLER, Gauss::<S>::new().in_lanes(), pericentre(0.3), 6.0, 16)?;
        Ok(apart(&found, &Orbit { e: 0.3 }.position(6.0)))
    }
    let errors = [error::<3>()?, error::<4>()?, error::<5>()?, error::<6>()?, error::<7>()?, error::<8>()?];
    for (errors, bound) in errors.windows(2).zip([0.1, 0.1, 0.1, 0.1, 0.2]) {
        assert!(errors[1] < bound * errors[0], "{errors:?}");
    }
    assert!(errors[5] < 2e-14, "{errors:?}");
    Ok(())
}

/// The energy error of the method with eight stages is that of rounding.
#[test]
fn eight_stages_keep_the_energy_to_rounding() -> Outcome {
    let [worst, _] = energy_error(Gauss::<8>::new().in_lanes(), 300)?;
    assert!(worst < 1e-14, "{worst:e}");
    Ok(())
}

/// A planet of any mass, so that momenta are much larger or smaller than coordinates.
#[lagrangian(
    coordinates(x, y),
    lagrangian = m * (dot(x).powi(2) + dot(y).powi(2)) / 2.0 + m * mu / (x * x + y * y).sqrt(),
)]
struct Planet {
    m: f64,
    mu: f64,
}

/// Stages are judged in units of the coordinates: the earth in SI units goes where the unit orbit goes.
#[test]
fn units_do_not_matter() -> Outcome {
    let start = PlanetState { x: 0.7, y: 0.0, dot_x: 0.0, dot_y: 1.3 };
    let unit = run(&Planet { m: 1.0, mu: 1.0 }, Gauss::<2>::new(), start, 6.0, 120)?;
    for (length, velocity, m) in
        [(1.5e11, 3e4, 6e24), (1e-9, 1e-3, 1e-27), (1e6, 1e-6, 1e-12), (1.0, 1.0, 1e30)]
    {
        let planet = Planet { m, mu: length * velocity * velocity };
        let start = PlanetState { x: 0.7 * length, y: 0.0, dot_x: 0.0, dot_y: 1.3 * velocity };
        let found = run(&planet, Gauss::<2>::new(), start, 6.0 * length / velocity, 120)?;
        let off = found.iter().zip(&unit).map(|(a, b)| (a / length - b).abs()).fold(0.0, larger);
        assert!(off < 1e-12, "{length:e}, {velocity:e}, {m:e}: {off:e}");
    }
    Ok(())
}

/// Velocities that a run gives are those that belong to its momenta.
#[test]
fn velocities_are_those_of_the_momenta() -> Outcome {
    let start = RelativisticState { x: 0.3, y: -1.1, dot_x: 0.6, dot_y: -0.5 };
    let system = Relativistic { m: 1.5 };
    let mut run = Integrator::new(&system, Gauss::<3>::new(), 0.01, start)?;
    assert_abs_diff_eq!(run.state().dot_x, 0.6, epsilon = 1e-14);
    let energy = run.energy();
    run.take_steps(1000)?;
    assert!(abs_diff_eq!(run.energy(), energy, epsilon = 1e-11), "{:e}", run.energy() - energy);
    let speed = run.state().dot_x.hypot(run.state().dot_y);
    assert!(speed < 1.0 && speed > 0.1);
    Ok(())
}
