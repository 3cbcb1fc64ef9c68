//! Dissipation functions R: the force is −∂R/∂v.

use dvi_core::Weights;
use dvi_core::prelude::*;

use super::Outcome;

/// Drag of the square of the speed, as a function and as a force.
#[lagrangian(
    coordinates(r[3]),
    lagrangian = dot(r).norm_squared() / 2.0,
    dissipation = c * dot(r).norm().powi(3) / 3.0,
)]
#[derive(Clone, Debug)]
struct Dragged {
    c: f64,
}

#[lagrangian(
    coordinates(r[3]),
    lagrangian = dot(r).norm_squared() / 2.0,
    force(r) = |i| -c * dot(r[i]) * dot(r).norm(),
)]
#[derive(Clone, Debug)]
struct Braked {
    c: f64,
}

/// |v| v has the derivative 0 at v = 0, though that of |v| does not exist there.
#[test]
fn drag_begins_at_rest() -> Outcome {
    fn check<S: RegularLagrangian>(system: &S, start: S::State<f64>) -> Outcome {
        let ([mut l_q, mut l_v], mut matrix) = ([[0.0; 3]; 2], [0.0; 9]);
        let weights = Weights { qq: 1.0, qv: 1.0, vq: 1.0, vv: 0.0 };
        let sink = &mut |i: usize, j: usize, entry: f64| matrix[3 * i + j] += entry;
        system.linearize(&[0.0; 3], &[0.0; 3], 0.0, weights, &mut l_q, &mut l_v, sink);
        assert_eq!(matrix, [0.0; 9]);
        let mut run = Integrator::new(system, Variational::midpoint(), 0.1, start)?;
        run.take_steps(10)?;
        assert!(run.v().iter().all(|v| *v == 0.0));
        Ok(())
    }
    check(&Dragged { c: 0.5 }, DraggedState { r: [1.0; 3], dot_r: [0.0; 3] })?;
    check(&Braked { c: 0.5 }, BrakedState { r: [1.0; 3], dot_r: [0.0; 3] })
}
