//! Systems with impacts, and their equations of motion by hand.

use dvi_core::prelude::*;

use super::reference::ByHand;

/// A ball above the floor.
#[lagrangian(coordinates(y), lagrangian = m * dot(y).powi(2) / 2.0 - m * y, impact = y)]
pub(crate) struct Ball {
    pub(crate) m: f64,
}

/// A particle in a potential without symmetry, on a wavy floor.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - y - 0.15 * x * x - 0.1 * x.powi(4) - 0.15 * x * x * y * y,
    impact = y - a * x.cos(),
)]
#[derive(Clone, Copy)]
pub(crate) struct Wavy {
    pub(crate) a: f64,
}

impl ByHand<2> for Wavy {
    fn acceleration(&self, [x, y]: [f64; 2], _: [f64; 2], _: f64) -> [f64; 2] {
        [-0.3 * x - 0.4 * x.powi(3) - 0.3 * x * y * y, -1.0 - 0.3 * x * x * y]
    }
    fn gap(&self, [x, y]: [f64; 2], _: f64) -> f64 {
        y - self.a * x.cos()
    }
    fn reflected(&self, [x, _]: [f64; 2], [u, w]: [f64; 2], _: f64) -> [f64; 2] {
        let [nx, ny] = [self.a * x.sin(), 1.0];
        let change = 2.0 * (u * nx + w * ny) / (nx * nx + ny * ny);
        [u - change * nx, w - change * ny]
    }
}

/// Coupled coordinates with a mass matrix that depends on the position and a term linear in the velocities, in a bowl.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (1.0 + 0.2 * y * y) * dot(x).powi(2) / 2.0 + dot(y).powi(2) / 2.0 + 0.3 * dot(x) * dot(y)
        + b * (x * dot(y) - y * dot(x)) / 2.0 - 0.5 * x * x - 0.8 * y * y,
    impact = [1.0 - x * x - 0.5 * y * y, y + 0.7],
)]
#[derive(Clone, Copy)]
pub(crate) struct Bowl {
    pub(crate) b: f64,
}

impl ByHand<2> for Bowl {
    fn acceleration(&self, [x, y]: [f64; 2], [u, w]: [f64; 2], _: f64) -> [f64; 2] {
        let (m, c, b) = (1.0 + 0.2 * y * y, 0.3, self.b);
        // m x'' + c y'' + 0.4 y u w − b w = −x and c x'' + y'' − 0.2 y u² + b u = −1.6 y
        let (f, g) = (-x - 0.4 * y * u * w + b * w, -1.6 * y + 0.2 * y * u * u - b * u);
        let d = m - c * c;
        [(f - c * g) / d, (m * g - c * f) / d]
    }
    fn gap(&self, [x, y]: [f64; 2], _: f64) -> f64 {
        (1.0 - x * x - 0.5 * y * y).min(y + 0.7)
    }
    fn reflected(&self, [x, y]: [f64; 2], [u, w]: [f64; 2], _: f64) -> [f64; 2] {
        let n = if 1.0 - x * x - 0.5 * y * y < y + 0.7 { [-2.0 * x, -y] } else { [0.0, 1.0] };
        let (m, c) = (1.0 + 0.2 * y * y, 0.3);
        let d = m - c * c;
        // M⁻¹n
        let k = [(n[0] - c * n[1]) / d, (m * n[1] - c * n[0]) / d];
        let lambda = -2.0 * (n[0] * u + n[1] * w) / (n[0] * k[0] + n[1] * k[1]);
        [u + lambda * k[0], w + lambda * k[1]]
    }
}

/// A particle whose momentum is no affine function of its velocity, above a sloping floor.
#[lagrangian(
    coordinates(x, y),
    lagrangian = -(1.0 - dot(x).powi(2) - dot(y).powi(2)).sqrt() - 0.5 * y - 0.2 * x * x,
    impact = y - 0.3 * x,
)]
#[derive(Clone, Copy)]
pub(crate) struct Fast;

impl ByHand<2> for Fast {
    fn acceleration(&self, [x, _]: [f64; 2], [u, w]: [f64; 2], _: f64) -> [f64; 2] {
        // p' = F with p = γv: v' = (F − v (v·F))/γ
        let (f, per_gamma) = ([-0.4 * x, -0.5], (1.0 - u * u - w * w).sqrt());
        let along = u * f[0] + w * f[1];
        [(f[0] - u * along) * per_gamma, (f[1] - w * along) * per_gamma]
    }
    fn gap(&self, [x, y]: [f64; 2], _: f64) -> f64 {
        y - 0.3 * x
    }
    fn reflected(&self, _: [f64; 2], [u, w]: [f64; 2], _: f64) -> [f64; 2] {
        let change = 2.0 * (w - 0.3 * u) / 1.09;
        [u + 0.3 * change, w - change]
    }
}

/// A ball with friction on a table that moves up and down.
#[lagrangian(
    coordinates(y),
    lagrangian = dot(y).powi(2) / 2.0 - y,
    force(y) = -0.05 * dot(y) + 0.3 * t.cos(),
    impact = y - a * (2.0 * t).sin(),
)]
#[derive(Clone, Copy)]
pub(crate) struct Table {
    pub(crate) a: f64,
}

impl ByHand<1> for Table {
    fn acceleration(&self, _: [f64; 1], [w]: [f64; 1], t: f64) -> [f64; 1] {
        [-1.0 - 0.05 * w + 0.3 * t.cos()]
    }
    fn gap(&self, [y]: [f64; 1], t: f64) -> f64 {
        y - self.a * (2.0 * t).sin()
    }
    fn reflected(&self, _: [f64; 1], [w]: [f64; 1], t: f64) -> [f64; 1] {
        [4.0 * self.a * (2.0 * t).cos() - w]
    }
}

/// A particle in a central potential within a circle.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - (x * x + y * y) / 2.0 - 0.3 * (x * x + y * y).powi(2),
    impact = 1.0 - x * x - y * y,
    momenta(l = x * dot(y) - y * dot(x)),
)]
#[derive(Clone, Copy)]
pub(crate) struct Circle;

/// Balls on a line, of unit diameter.
#[lagrangian(
    coordinates(x[m.len()]),
    lagrangian = sum(0..m.len(), |i| m[i] * dot(x[i]).powi(2) / 2.0),
    impact(i in 1..m.len()) = x[i] - x[i - 1] - 1.0,
    momenta(p = sum(0..m.len(), |i| m[i] * dot(x[i]))),
)]
pub(crate) struct Balls {
    pub(crate) m: Vec<f64>,
}

/// A free particle between two walls.
#[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0, impact = [x, 1.0 - x])]
pub(crate) struct Channel;

/// A free particle in a corner of the plane.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    impact = [x, y],
)]
pub(crate) struct Corner;

/// A free particle beside a disc.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    impact = x * x + y * y - 1.0,
)]
pub(crate) struct Disc;

/// A particle in a potential between two walls that are not parallel.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - 0.5 * x * x * y - 0.2 * y.powi(4) - x,
    impact = [x + 0.05 * y * y, 0.3 - x + 0.1 * y],
)]
pub(crate) struct Slot;
