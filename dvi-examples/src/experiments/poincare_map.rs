//! The Poincaré map of magnetic fields: loops that it carries along with their flux, and where its islands
//! are.

use super::field_lines::{TOKAMAK, UNPERTURBED};
use crate::vocabulary::*;

/// Steps for each turn, after which the field is the same.
pub const STEPS: u64 = 24;
const POINTS: usize = 256;

pub type Place = [f64; 2];

pub trait Field: ProperlyDegenerate<State<f64>: From<(f64, f64)>> {}

impl<F: ProperlyDegenerate<State<f64>: From<(f64, f64)>>> Field for F {}

/// The Poincaré map: where the line through a place is after one turn of `steps` steps.
pub fn turned<F: Field>(field: &F, method: impl Method<F, f64>, steps: u64, [x, y]: Place) -> Result<Place> {
    let mut run = Integrator::new(field, method, TAU / steps as f64, (x, y).into())?;
    run.take_steps(steps)?;
    Ok(place(&run))
}

pub fn flux_changes(field: &impl Field, place: Place, radius: f64) -> Result<[f64; 2]> {
    let midpoint = flux_change(field, OneStep::midpoint(), place, radius)?;
    Ok([midpoint, flux_change(field, RungeKutta::classical(), place, radius)?])
}

/// The largest relative change of the flux ∮A·dx through a loop that is carried along for eight turns.
fn flux_change<F: Field>(field: &F, by: impl Method<F, f64> + Copy, [x, y]: Place, r: f64) -> Result<f64> {
    let at = |k: usize| TAU * k as f64 / POINTS as f64;
    let mut circle: Vec<Place> = (0..POINTS).map(|k| [x + r * at(k).cos(), y + r * at(k).sin()]).collect();
    let before = flux(field, &circle);
    let mut largest = 0.0;
    for _ in 0..8 {
        for place in &mut circle {
            *place = turned(field, by, STEPS, *place)?;
        }
        largest = larger(largest, (flux(field, &circle) / before - 1.0).abs());
    }
    Ok(largest)
}

/// ∮A·dx, with the derivative of the trigonometric polynomial through all points: exact for what they
/// resolve.
fn flux(field: &impl Field, circle: &[Place]) -> f64 {
    let derivative = |j: usize| {
        (0..POINTS).filter(|&k| k != j).fold([0.0; 2], |[x, y], k| {
            let sign = if (j + k).is_multiple_of(2) { 1.0 } else { -1.0 };
            let weight = sign / ((j as f64 - k as f64) * PI / POINTS as f64).tan() * PI / POINTS as f64;
            [x + weight * circle[k][0], y + weight * circle[k][1]]
        })
    };
    let along = |j: usize| {
        let mut form = [0.0; 2];
        field.one_form(&circle[j], 0.0, &mut form);
        dot(form, derivative(j))
    };
    (0..POINTS).map(along).sum()
}

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
