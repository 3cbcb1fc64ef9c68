//! Stages in lanes are for systems whose parameters are numbers, and not for those with constraints.

use dvi_core::Varied;
use dvi_core::prelude::*;

#[lagrangian(coordinates(x), lagrangian = (dot(x) * dot(x) - k * x * x) / 2.0)]
pub struct Spring<P> {
    k: P,
}

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x) * dot(x) + dot(y) * dot(y)) / 2.0 - y,
    constraint = x * x + y * y - 1.0,
)]
pub struct Rod;

fn main() -> Result<(), StartError> {
    let spring = Spring { k: Varied(1.0) };
    let method = Gauss::<4>::new().in_lanes();
    Integrator::new(&spring, method, 0.1, SpringState { x: 1.0, dot_x: 0.0 })?;
    Integrator::new(&Rod, method, 0.1, RodState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.0 })?;
    Ok(())
}
