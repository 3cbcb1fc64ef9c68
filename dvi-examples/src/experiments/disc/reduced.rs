//! The equations of motion without constraints, which are eliminated by hand, for RK4.

use crate::models::RollingDiscState;

/// (x, y, θ, φ, θ', φ') of a disc.
pub(super) fn start(state: &RollingDiscState) -> [f64; 6] {
    let &RollingDiscState { x, y, theta, phi, dot_theta, dot_phi, .. } = state;
    [x, y, theta, phi, dot_theta, dot_phi]
}

#[cfg(test)]
mod tests {
    use dvi_core::prelude::*;

    use super::super::{MAGNET, begin};
    use super::*;
    use crate::experiments::rk4::rk4;
    use crate::models::{ChaplyginSleigh, ChaplyginSleighState, RollingDisc};

    #[test]
    fn the_equations_by_hand_are_those_of_the_constraints() {
        let disc = RollingDisc { radius: 0.7, ..MAGNET };
        let state = RollingDiscState { phi: 1.1, ..disc.rolling([0.4, -0.3], 1.1, [0.9, -0.6]) };
        let rates = disc.vector_field(&state).expect("rates");
        let by_hand = disc.reduced(&start(&state));
        let generated = [rates.x, rates.y, rates.theta, rates.phi, rates.dot_theta, rates.dot_phi];
        for (a, b) in by_hand.into_iter().zip(generated) {
            assert!((a - b).abs() < 1e-14, "{by_hand:?} {generated:?}");
        }
        let (sleigh, theta, v, omega) = (ChaplyginSleigh { inertia: 1.0, a: 0.5 }, 0.8_f64, -1.2, 0.7);
        let (dot_x, dot_y) = (v * theta.cos(), v * theta.sin());
        let state = ChaplyginSleighState { x: 0.0, y: 0.0, theta, dot_x, dot_y, dot_theta: omega };
        let rates = sleigh.vector_field(&state).expect("rates");
        let by_hand = sleigh.reduced(&[0.0, 0.0, theta, v, omega]);
        let along = rates.dot_x * theta.cos() + rates.dot_y * theta.sin();
        assert!((along - by_hand[3]).abs() < 1e-14 && (rates.dot_theta - by_hand[4]).abs() < 1e-14);
    }

    #[test]
    fn rk4_is_of_fourth_order_on_a_disc() {
        let run = |steps: u32| {
            let h = 2.0 / f64::from(steps);
            (0..steps).fold(start(&begin(&MAGNET)), |y, _| rk4(&y, h, |y| MAGNET.reduced(y)))
        };
        let fine = run(2560);
        let error = |steps| {
            run(steps).iter().zip(&fine).map(|(a, b): (&f64, &f64)| (a - b).abs()).fold(0.0, f64::max)
        };
        let order = (error(160) / error(320)).log2();
        assert!((order - 4.0).abs() < 0.05, "{order}");
    }
}
