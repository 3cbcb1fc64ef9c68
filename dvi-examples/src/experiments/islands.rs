//! Where the islands of a perturbed tokamak are.

use super::carried_flux::{STEPS, turned};
use super::field_lines::{TOKAMAK, UNPERTURBED};
use crate::models::PerturbedTokamak;
use crate::vocabulary::*;

/// 2/1 islands are around lines that close after two turns; without perturbation all lines with q = 2 do.
pub fn where_islands_are() -> Result<Claim> {
    let gauss = OneStepGauss::<3>::new();
    let twice = |field: &PerturbedTokamak, place| {
        turned(field, gauss, 2 * STEPS, turned(field, gauss, 2 * STEPS, place)?)
    };
    let rho = TOKAMAK.resonance(0.5);
    let gaps = each([0.0f64, 1.0, 2.0, 3.0, 4.0, 5.0], |angle| {
        let place = [1.0 + rho * angle.cos(), rho * angle.sin()];
        Ok(distance(twice(&UNPERTURBED, place)?, place))
    })?;
    let mut trace = 0.0;
    let order = order_of([1.0 / 8.0, 1.0 / 16.0, 1.0 / 32.0, 1.0 / 64.0], |part| {
        let field = PerturbedTokamak { epsilon: TOKAMAK.epsilon.map(|epsilon| part * epsilon), ..TOKAMAK };
        // R − Z is reversed with φ, so that a line that closes in the plane φ = 0 has Z = 0.
        let height = |x: f64| -> Result<f64> { Ok(twice(&field, [1.0 + x, 0.0])?[1]) };
        let [mut a, mut b] = [rho - 1e-3, rho + 1e-3];
        for _ in 0..8 {
            let [at_a, at_b] = [height(a)?, height(b)?];
            if at_a != at_b {
                (a, b) = (b, b - at_b * (b - a) / (at_b - at_a));
            }
        }
        let d = 1e-5;
        let [right, left] = each([d, -d], |d| twice(&field, [1.0 + b + d, 0.0]))?;
        let [above, below] = each([d, -d], |d| twice(&field, [1.0 + b, d]))?;
        trace = larger(trace, ((right[0] - left[0] + above[1] - below[1]) / (2.0 * d)).abs());
        Ok((part, (b - rho).abs()))
    })?;
    Ok(beyond("lines with q = 2 close after two turns, and with weak perturbations islands are around them")
        .at_most("unperturbed: largest distance from the start after two turns", largest(gaps), 1e-7)
        .near("order in ε of the distance of the O-point from q = 2", order, [1.0, 0.1])
        .at_most("largest |trace| of the map around it, four ε", trace, 2.0 - 1e-5))
}
