//! What the general step of a discrete Lagrangian refuses.

use dvi_core::methods::General;
use dvi_core::prelude::*;
use dvi_tests::configurations::quasi_periodic;

/// L = ẋ²/2 + kẏ²/2 − (x² + y²)/2.
#[lagrangian(
    coordinates(x, y),
    lagrangian = dot(x).powi(2) / 2.0 + k * dot(y).powi(2) / 2.0 - (x * x + y * y) / 2.0,
)]
struct TwoSprings {
    k: f64,
}

#[test]
fn what_no_step_can_take_is_refused_at_the_start() {
    let start = TwoSpringsState { x: 1.0, y: 0.5, dot_x: 0.0, dot_y: 0.0 };
    for alpha in [-1.0, 2.0, f64::NAN] {
        let inner = General::new(Variational::sigma(alpha));
        let refused = Integrator::new(&TwoSprings { k: 1.0 }, inner, 0.1, start).err();
        assert!(matches!(refused, Some(StartError::Parameter { .. })), "{refused:?}");
        let (vortices, start) = quasi_periodic();
        let refused = Integrator::new(&vortices, General::new(Sigma::new(alpha)), 0.1, start).err();
        assert!(matches!(refused, Some(StartError::Parameter { name: "sigma", .. })), "{refused:?}");
    }
    let (vortices, begin) = quasi_periodic();
    let by_newton = Sigma { solver: Solver::Newton, ..Sigma::midpoint() };
    let refused = Integrator::new(&vortices, General::new(by_newton), 0.1, begin).map(drop);
    assert!(matches!(refused, Err(StartError::Unsupported { .. })), "{refused:?}");
    let singular =
        Integrator::new(&TwoSprings { k: 0.0 }, General::new(Variational::sigma(0.3)), 0.1, start).err();
    assert!(
        matches!(singular, Some(StartError::Singular { matrix: "the mass matrix", entry, .. })
            if entry.to_string() == "y"),
        "{singular:?}"
    );
}
