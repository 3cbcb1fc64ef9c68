//! Loops that field lines carry along, and the flux of the field through them.

use dvi_core::ProperlyDegenerate;

use crate::vocabulary::*;

/// Steps for each turn, after which the field is the same.
pub const STEPS: u64 = 24;
/// Points on a loop.
const POINTS: usize = 256;

/// A point of the plane in which the lines are seen.
pub type Place = [f64; 2];

/// A field whose lines are seen in a plane.
pub trait Field: ProperlyDegenerate<State<f64>: From<(f64, f64)>> {}

impl<F: ProperlyDegenerate<State<f64>: From<(f64, f64)>>> Field for F {}

/// The Poincaré map: where the line through a place is after one turn of `steps` steps.
pub fn turned<F: Field>(field: &F, method: impl Method<F, f64>, steps: u64, [x, y]: Place) -> Result<Place> {
    let mut run = Integrator::new(field, method, TAU / steps as f64, (x, y).into())?;
    run.take_steps(steps)?;
    Ok(place(&run))
}

/// The largest relative change of the flux ∮A·dx through a loop that is carried along for eight turns.
pub fn flux_change<F: Field>(
    field: &F,
    method: impl Method<F, f64> + Copy,
    [x, y]: Place,
    radius: f64,
) -> Result<f64> {
    let angle = |k: usize| TAU * k as f64 / POINTS as f64;
    let mut circle: Vec<Place> =
        (0..POINTS).map(|k| [x + radius * angle(k).cos(), y + radius * angle(k).sin()]).collect();
    let before = flux(field, &circle);
    let mut largest = 0.0;
    for _ in 0..8 {
        for place in &mut circle {
            *place = turned(field, method, STEPS, *place)?;
        }
        largest = larger(largest, (flux(field, &circle) / before - 1.0).abs());
    }
    Ok(largest)
}

/// ∮A·dx, with the derivative of the trigonometric polynomial through all points: exact for what they
/// resolve.
fn flux(field: &impl Field, circle: &[Place]) -> f64 {
    let derivative = |j: usize| {
        let others = (0..POINTS).filter(|&k| k != j);
        others.fold([0.0; 2], |[x, y], k| {
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
