//! Compositions of the implicit midpoint rule: the times of their parts, and compositions of compositions.

use approx::abs_diff_eq;
use dvi_core::methods::Composition;
use dvi_core::prelude::*;
use dvi_tests::Outcome;
use dvi_tests::larger;
use dvi_tests::systems::{PointVortices, PointVorticesState};

fn compositions<const S: usize>() -> [Composition<Gauss<S>>; 6]
where
    Gauss<S>: Tabulated,
{
    let method = Gauss::<S>::new();
    [
        Composition::triple_jump(method),
        Composition::suzuki(method),
        Composition::yoshida(method),
        Composition::kahan_li_6(method),
        Composition::suzuki_umeno(method),
        Composition::kahan_li_8(method),
    ]
}

/// Time enters: H = −½ (x² + y²) cos t turns the plane by the angle sin t.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = y * d(x),
    hamiltonian = 0.5 * (x * x + y * y) * t.cos(),
)]
#[derive(Debug)]
pub(crate) struct Swing {}

#[test]
fn every_part_of_a_step_begins_at_its_own_time() -> Outcome {
    let (system, angle) = (Swing {}, 2.0_f64.sin());
    for method in compositions::<1>() {
        let start = SwingState { x: 1.0, y: 0.0 };
        let mut run = Integrator::new(&system, method, 0.02, start)?;
        run.take_steps(100)?;
        let end: SwingState = run.state();
        let error = larger((end.x - angle.cos()).abs(), (end.y.abs() - angle.sin().abs()).abs());
        assert!(error < 1e-5, "{}: {error:e}", method.name());
    }
    Ok(())
}

#[test]
fn compositions_nest() -> Outcome {
    let (system, start): (PointVortices<4>, PointVorticesState<4>) = dvi_tests::configurations::chaotic();
    let nested = Composition::suzuki(Composition::triple_jump(Gauss::<1>::new()));
    let flat = Composition::kahan_li_8(Gauss::<1>::new());
    let mut fine = Integrator::new(&system, nested, 0.002, start)?;
    let mut coarse = Integrator::new(&system, flat, 0.01, start)?;
    fine.take_steps(500)?;
    coarse.take_steps(100)?;
    for (a, b) in fine.q().iter().zip(coarse.q()) {
        assert!(abs_diff_eq!(a, b, epsilon = 1e-7), "{a} {b}");
    }
    Ok(())
}
