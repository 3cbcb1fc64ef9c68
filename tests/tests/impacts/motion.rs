//! The motion, against closed forms and a reference by hand.

use approx::{abs_diff_eq, assert_abs_diff_eq};
use dvi_core::prelude::*;
use dvi_tests::apart;
use dvi_tests::zoo::impacts::*;

use super::Outcome;
use super::reference::{ByHand, motion};

const TIME: f64 = 4.0;

/// The largest error after the time, with `steps` steps.
fn error<S: Lagrangian, M: Method<S, f64>>(
    system: &S,
    method: M,
    start: S::State<f64>,
    expected: &[f64],
    steps: u64,
) -> Outcome<f64> {
    let mut run = Integrator::new(system, method, TIME / steps as f64, start)?;
    run.take_steps(steps)?;
    let state: Vec<f64> = system.values(&run.state())?.collect();
    Ok(apart(&state, expected))
}

/// Where the motion ends.
fn end<S: Lagrangian + ByHand<N>, const N: usize>(system: &S, start: &S::State<f64>) -> Outcome<Vec<f64>> {
    let values: Vec<f64> = system.values(start)?.collect();
    let (q, v) = values.split_at(N);
    let begin = [q, v].map(|part| core::array::from_fn(|i| part[i]));
    let ([q, v], impacts) = motion(system, begin, [0.0, TIME], 20_000);
    assert!(impacts >= 2, "{impacts} impacts say little");
    Ok([q, v].concat())
}

/// The order over 24 runs, the coarsest of which has `steps` steps.
///
/// The error of a run with impacts is no smooth function of the step, because it depends on where in a step
/// the impacts are; so there are many runs.
fn order<S: Lagrangian, M: Method<S, f64> + Clone>(
    system: &S,
    method: &M,
    start: &S::State<f64>,
    expected: &[f64],
    steps: u64,
) -> Outcome<f64> {
    let mut errors = Vec::new();
    for k in 0..24_u32 {
        let steps = (steps as f64 * 2.0_f64.powf(f64::from(k) / 6.0)) as u64;
        errors.push((TIME / steps as f64, error(system, method.clone(), start.clone(), expected, steps)?));
    }
    convergence_order(&errors).ok_or_else(|| "no slope".into())
}

/// `of_order!(system, start => method, expected order, steps of the coarsest run; …)`
macro_rules! of_order {
    ($system:expr, $start:expr => $($method:expr, $expected:literal, $steps:literal;)*) => {
        let (system, start) = ($system, $start);
        let end = end(&system, &start)?;
        $(
            let found = order(&system, &$method, &start, &end, $steps)?;
            assert!(abs_diff_eq!(found, $expected, epsilon = 0.25), "{}: {found}", stringify!($method));
        )*
    };
}

#[test]
fn on_a_wavy_floor() -> Outcome {
    let start = WavyState { x: 0.3, y: 1.0, dot_x: 0.4, dot_y: 0.0 };
    of_order! { Wavy { a: 0.5 }, start =>
        Impacts::new(Variational::trapezoid()), 2.0, 100;
        Impacts::new(Variational::midpoint()), 2.0, 100;
        Impacts::new(Variational::sigma(0.3)), 1.0, 400;
        Impacts::reflecting(Variational::trapezoid()), 2.0, 100;
        Impacts::reflecting(Variational::sigma(0.0)), 1.0, 400;
        Impacts::reflecting(Galerkin::<3>::new()), 4.0, 40;
    }
    Ok(())
}

#[test]
fn in_a_bowl_with_a_mass_matrix_that_varies() -> Outcome {
    let start = BowlState { x: 0.1, y: 0.2, dot_x: 1.1, dot_y: 0.9 };
    of_order! { Bowl { b: 0.7 }, start =>
        Impacts::new(Variational::midpoint()), 2.0, 100;
        Impacts::new(Variational::trapezoid()), 2.0, 100;
        Impacts::reflecting(Galerkin::<3>::new()), 4.0, 40;
    }
    Ok(())
}

#[test]
fn with_a_momentum_that_is_no_affine_function_of_the_velocity() -> Outcome {
    let start = FastState { x: 0.2, y: 0.2, dot_x: 0.3, dot_y: -0.4 };
    of_order! { Fast, start =>
        Impacts::new(Variational::midpoint()), 2.0, 60;
        Impacts::reflecting(Variational::trapezoid()), 2.0, 60;
    }
    Ok(())
}

#[test]
fn with_forces_on_a_table_that_moves() -> Outcome {
    let start = TableState { y: 0.5, dot_y: 0.2 };
    of_order! { Table { a: 0.1 }, start =>
        Impacts::reflecting(Variational::trapezoid()), 2.0, 60;
        Impacts::reflecting(Galerkin::<3>::new()), 4.0, 40;
    }
    Ok(())
}

/// A parabola is the motion of the trapezoidal and of the midpoint rule too.
#[test]
fn a_ball_above_the_floor_bounces_at_the_right_times() -> Outcome {
    let ball = Ball { m: 3.0 };
    let method = Impacts::reflecting(Variational::new(Midpoint));
    let mut run = Integrator::new(&ball, method, 0.037, BallState { y: 1.0, dot_y: 0.0 })?;
    let mut impacts = 0;
    for _ in 0..1000 {
        run.advance()?;
        for impact in run.memory().impacts() {
            let expected = 2.0_f64.sqrt() * (1.0 + 2.0 * f64::from(impacts));
            assert_abs_diff_eq!(impact.time, expected, epsilon = 1e-12);
            assert_abs_diff_eq!(impact.impulse, 6.0 * 2.0_f64.sqrt(), epsilon = 1e-12);
            impacts += 1;
        }
        let since = (run.time() + 2.0_f64.sqrt()) % 8.0_f64.sqrt() - 2.0_f64.sqrt();
        let height = 1.0 - since * since / 2.0;
        assert_abs_diff_eq!(run.state().y, height, epsilon = 1e-12);
    }
    assert_eq!((impacts, run.memory().total()), (13, 13));
    Ok(())
}

#[test]
fn without_an_impact_a_run_is_that_of_the_method_bit_by_bit() -> Outcome {
    #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - x * x / 2.0 - x.powi(4) / 4.0)]
    struct Free;
    #[lagrangian(
        coordinates(x),
        lagrangian = dot(x).powi(2) / 2.0 - x * x / 2.0 - x.powi(4) / 4.0,
        impact = x + 2.0,
    )]
    struct Far;
    let start = FreeState { x: 0.7, dot_x: 0.4 };
    let mut free = Integrator::new(&Free, Galerkin::<4>::new(), 0.1, start)?;
    let method = Impacts::reflecting(Galerkin::<4>::new());
    let mut far = Integrator::new(&Far, method, 0.1_f64, FarState { x: 0.7_f64, dot_x: 0.4 })?;
    for _ in 0..1000 {
        free.advance()?;
        far.advance()?;
        let (FreeState { x, dot_x }, FarState { x: y, dot_x: dot_y }) = (free.state(), far.state());
        assert_eq!([x.to_bits(), dot_x.to_bits()], [y.to_bits(), dot_y.to_bits()]);
    }
    assert_eq!(free.statistics(), far.statistics());
    Ok(())
}
