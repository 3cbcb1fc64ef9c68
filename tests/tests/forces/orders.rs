//! All methods have their orders with forces, against the motion by another program.

use approx::abs_diff_eq;
use dvi_core::discrete::Constant;
use dvi_core::mechanics::Rates;
use dvi_core::methods::Method;
use dvi_core::prelude::*;
use dvi_tests::larger;

use super::Outcome;
use super::systems::{ByHand, Damped, Driven, Harvested, Pendulum, Swirl, motion};

const TIME: f64 = 2.0;

fn order<const N: usize, S, M>(
    system: &S,
    method: &M,
    steps: u64,
) -> Result<f64, Box<dyn core::error::Error>>
where
    S: ByHand<N> + Lagrangian + System<Kind: Rates<S, f64>>,
    M: Method<S, f64> + Clone,
{
    let expected = motion(S::start(), TIME, |y, t| system.rate(y, t));
    let mut errors = Vec::new();
    for steps in [steps, steps * 5 / 4, steps * 3 / 2, 2 * steps] {
        let h = TIME / steps as f64;
        let mut run = Integrator::new(system, method.clone(), h, S::state(S::start()))?;
        run.take_steps(steps)?;
        let state = run.state();
        let found = system.values(&state)?;
        let error = found.zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, larger);
        errors.push((h, error));
    }
    convergence_order(&errors).ok_or_else(|| "no slope".into())
}

/// `of_order!(system => method, expected order, steps of the coarsest run; …)`
macro_rules! of_order {
    ($system:expr => $($method:expr, $expected:literal, $steps:literal;)*) => {$(
        let found = order(&$system, &$method, $steps)?;
        assert!(abs_diff_eq!(found, $expected, epsilon = 0.12), "{}: {found}", stringify!($method));
    )*};
}

#[test]
fn the_equations_of_motion_are_those_derived_by_hand() -> Outcome {
    fn at_start<const N: usize, S>(system: &S) -> Outcome
    where
        S: ByHand<N> + Lagrangian + System<Kind: Rates<S, f64>>,
    {
        for t in [0.0, 0.7] {
            let rates = system.at_time(t).vector_field(&S::state(S::start()))?;
            for (found, expected) in system.values(&rates)?.zip(system.rate(&S::start(), t)) {
                assert!(abs_diff_eq!(found, expected, epsilon = 1e-14), "{found} {expected}");
            }
        }
        Ok(())
    }
    at_start(&Damped { gamma: 0.3 })?;
    at_start(&Driven { drag: [0.5, 0.8] })?;
    at_start(&Swirl { swirl: 0.6 })?;
    at_start(&Pendulum { gamma: 0.2 })?;
    at_start(&Harvested { harvest: 0.1 })
}

#[test]
fn methods_have_their_orders_on_a_particle_with_friction() -> Outcome {
    of_order! { Damped { gamma: 0.3 } =>
        Variational::sigma(0.0), 1.0, 1024;
        Variational::sigma(0.3), 1.0, 4096;
        Variational::midpoint(), 2.0, 128;
        Variational::trapezoid(), 2.0, 128;
        Variational::simpson(), 2.0, 128;
        Variational::new(Quadrature::gauss(3)?), 2.0, 128;
        Variational::midpoint().phase_fitted(Constant(1.5)), 2.0, 128;
        Galerkin::<3>::new(), 4.0, 32;
        Galerkin::<4>::new(), 6.0, 24;
        Galerkin::<5>::new(), 8.0, 24;
        Composition::suzuki(Variational::midpoint()), 4.0, 32;
        Gauss::<2>::new(), 4.0, 48;
        Gauss::<3>::new(), 6.0, 24;
        RungeKutta::classical(), 4.0, 128;
    }
    Ok(())
}

#[test]
fn methods_have_their_orders_with_forces_of_all_kinds() -> Outcome {
    of_order! { Driven { drag: [0.5, 0.8] } =>
        Variational::sigma(1.0), 1.0, 1024;
        Variational::midpoint(), 2.0, 64;
        Variational::trapezoid(), 2.0, 64;
        Variational::simpson().phase_fitted(Constant(1.0)), 2.0, 64;
        Galerkin::<3>::new(), 4.0, 16;
        Galerkin::<4>::new(), 6.0, 12;
        Gauss::<2>::new(), 4.0, 16;
        RungeKutta::classical(), 4.0, 64;
    }
    Ok(())
}

#[test]
fn methods_have_their_orders_where_forces_leave_steps_explicit() -> Outcome {
    let solver = Solver::FixedPoint;
    of_order! { Swirl { swirl: 0.6 } =>
        Variational::sigma(0.0), 1.0, 256;
        Variational::trapezoid(), 2.0, 32;
        Variational { summation: Summation::Compensated, ..Variational::trapezoid() }, 2.0, 32;
        Variational { solver, ..Variational::midpoint() }, 2.0, 32;
        Variational::trapezoid().phase_fitted(Constant(1.0)), 2.0, 32;
        Variational::simpson().phase_fitted(Curvature(Reading::Averaged)), 2.0, 32;
        Newmark::new(0.25), 2.0, 32;
        Newmark::new(0.0), 2.0, 32;
        Galerkin::<3>::new(), 4.0, 8;
        Galerkin::<4>::new(), 6.0, 6;
        Gauss::<2>::new(), 4.0, 12;
        RungeKutta::classical(), 4.0, 32;
    }
    Ok(())
}

#[test]
fn one_step_schemes_have_their_orders_on_a_driven_pendulum_in_phase_space() -> Outcome {
    of_order! { Pendulum { gamma: 0.2 } =>
        OneStep::scheme_a(), 1.0, 512;
        OneStep::scheme_b(), 1.0, 512;
        OneStep::midpoint(), 2.0, 32;
        OneStep::trapezoid(), 2.0, 32;
        OneStepGauss::<1>::new(), 2.0, 32;
        OneStepGauss::<2>::new(), 4.0, 12;
        OneStepGauss::<3>::new(), 6.0, 6;
        OneStepGauss::<4>::new(), 8.0, 5;
        Composition::suzuki(OneStep::midpoint()), 4.0, 16;
        Projected::symmetric(), 2.0, 32;
        Projected::standard(), 2.0, 32;
        Sigma::midpoint(), 2.0, 32;
        Gauss::<3>::new(), 6.0, 6;
        RungeKutta::classical(), 4.0, 32;
    }
    Ok(())
}

#[test]
fn one_step_schemes_have_their_orders_where_the_form_is_not_affine() -> Outcome {
    of_order! { Harvested { harvest: 0.1 } =>
        OneStep::scheme_a(), 1.0, 512;
        OneStep::scheme_b(), 1.0, 512;
        OneStep::midpoint(), 2.0, 32;
        OneStep::trapezoid(), 2.0, 32;
        OneStepGauss::<2>::new(), 4.0, 12;
        OneStepGauss::<3>::new(), 6.0, 6;
        Projected::symmetric(), 2.0, 32;
        Projected::standard(), 2.0, 32;
        Sigma::midpoint(), 2.0, 64;
        Gauss::<2>::new(), 4.0, 12;
    }
    Ok(())
}
