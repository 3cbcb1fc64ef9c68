//! A pendulum of many links, by constraints.

use dvi_core::prelude::*;

/// n equal masses on equal rods without mass, one below the other: in all of mass 1 and length 1, with g =
/// 1.
#[lagrangian(
    coordinates(x[n], y[n]),
    lagrangian = sum(0..n, |i| (dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0 - y[i]) / (n as f64),
    constraint = x[0].powi(2) + y[0].powi(2) - 1.0 / (n as f64).powi(2),
    constraint(i in 1..n) = (x[i] - x[i - 1]).powi(2) + (y[i] - y[i - 1]).powi(2) - 1.0 / (n as f64).powi(2),
)]
#[derive(Clone, Debug)]
pub struct Links {
    /// How many links there are.
    pub n: usize,
}

impl Links {
    /// The length of a rod.
    pub fn rod(&self) -> f64 {
        1.0 / self.n as f64
    }

    /// At rest, with angles from the vertical that grow from zero at the pivot to `angle` at the end.
    pub fn bent(&self, angle: f64) -> LinksState {
        let (mut x, mut y, mut place) = (Vec::new(), Vec::new(), [0.0; 2]);
        for i in 0..self.n {
            let theta = angle * (i as f64 + 0.5) * self.rod();
            place = [place[0] + self.rod() * theta.sin(), place[1] - self.rod() * theta.cos()];
            x.push(place[0]);
            y.push(place[1]);
        }
        LinksState { x, y, dot_x: vec![0.0; self.n], dot_y: vec![0.0; self.n] }
    }
}
