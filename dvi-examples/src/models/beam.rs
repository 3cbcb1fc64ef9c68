//! A beam that is clamped at one end: small deflections by finite elements, and large ones by an elastic rod
//! of masses.

use dvi_core::prelude::*;

use super::joined;

/// The deflection of a beam by n cubic elements (Euler and Bernoulli; Przemieniecki 1968, chapters 5 and
/// 11): in all of mass 1, length 1 and bending stiffness 1. Node i is at (i + 1)/n, with the deflection w
/// and the slope w′; the mass matrix is the consistent one.
#[lagrangian(
    coordinates(w[n], slope[n]),
    lagrangian = {
        let l = 1.0 / (n as f64);
        let first = 156.0 * dot(w[0]).powi(2) - 44.0 * l * dot(w[0]) * dot(slope[0]) + 4.0 * (l * dot(slope[0])).powi(2);
        let others = sum(1..n, |i| 156.0 * (dot(w[i - 1]).powi(2) + dot(w[i]).powi(2)) + 108.0 * dot(w[i - 1]) * dot(w[i])
            + 44.0 * l * (dot(w[i - 1]) * dot(slope[i - 1]) - dot(w[i]) * dot(slope[i]))
            + 26.0 * l * (dot(slope[i - 1]) * dot(w[i]) - dot(w[i - 1]) * dot(slope[i]))
            + l * l * (4.0 * dot(slope[i - 1]).powi(2) + 4.0 * dot(slope[i]).powi(2) - 6.0 * dot(slope[i - 1]) * dot(slope[i])));
        let clamped = 12.0 * w[0].powi(2) - 12.0 * l * w[0] * slope[0] + 4.0 * (l * slope[0]).powi(2);
        let bent = sum(1..n, |i| 12.0 * (w[i] - w[i - 1]).powi(2) - 12.0 * l * (w[i] - w[i - 1]) * (slope[i - 1] + slope[i])
            + 4.0 * l * l * (slope[i - 1].powi(2) + slope[i - 1] * slope[i] + slope[i].powi(2)));
        l / 840.0 * (first + others) - (clamped + bent) / (2.0 * l.powi(3))
    },
)]
#[derive(Clone, Debug)]
pub struct Beam {
    pub n: usize,
}

/// n segments in the plane that stretch, and bend at their joints by the angle between them (Bergou et al.
/// 2008, in the plane): in all of mass 1, length 1 and bending stiffness 1. Mass i is at the end of segment
/// i, and the last mass is half of another. The first segment bends against the x axis.
#[lagrangian(
    coordinates(r[n][2]),
    lagrangian = {
        let l = 1.0 / (n as f64);
        let bend = |a, b| (a[0] * b[1] - a[1] * b[0]).atan2(a.dot(b)).powi(2);
        let kinetic = sum(0..n, |i| dot(r[i]).norm_squared()) - dot(r[n - 1]).norm_squared() / 2.0;
        let stretched = (r[0].norm() - l).powi(2) + sum(1..n, |i| ((r[i] - r[i - 1]).norm() - l).powi(2));
        let clamped = 2.0 * r[0][1].atan2(r[0][0]).powi(2) + bend(r[0], r[1] - r[0]);
        let bent = sum(2..n, |i| bend(r[i - 1] - r[i - 2], r[i] - r[i - 1]));
        l / 2.0 * kinetic - stretching / (2.0 * l) * stretched - (clamped + bent) / (2.0 * l)
    },
)]
#[derive(Clone, Debug)]
pub struct Rod {
    pub n: usize,
    /// The force that doubles the length of a segment.
    pub stretching: f64,
}

/// A mode of a clamped beam (Euler and Bernoulli; Meirovitch 2001, chapter 8): its frequency is β², where
/// cos β cosh β = −1.
#[derive(Clone, Copy, Debug)]
pub struct Mode {
    pub beta: f64,
}

impl Mode {
    /// Mode k, counted from 0. Newton's method solves cos β + 1/cosh β = 0 from (k + ½)π, which is less than
    /// 0.31 away.
    pub fn new(k: u32) -> Self {
        let mut beta = (f64::from(k) + 0.5) * std::f64::consts::PI;
        for _ in 0..20 {
            let rate = -beta.sin() - beta.sinh() / beta.cosh().powi(2);
            beta -= (beta.cos() + 1.0 / beta.cosh()) / rate;
        }
        Self { beta }
    }

    pub fn frequency(&self) -> f64 {
        self.beta * self.beta
    }

    /// The deflection at s and its derivative.
    pub fn shape(&self, s: f64) -> [f64; 2] {
        let (beta, x) = (self.beta, self.beta * s);
        let sigma = (beta.sinh() - beta.sin()) / (beta.cosh() + beta.cos());
        let deflection = x.cosh() - x.cos() - sigma * (x.sinh() - x.sin());
        [deflection, beta * (x.sinh() + x.sin() - sigma * (x.cosh() - x.cos()))]
    }
}

impl Beam {
    fn moving(&self, at: impl Fn(f64) -> [f64; 2]) -> [Vec<f64>; 2] {
        [0, 1].map(|k| (1..=self.n).map(|i| at(i as f64 / self.n as f64)[k]).collect())
    }

    /// Straight, with velocities that are those of a mode.
    pub fn struck(&self, mode: Mode) -> BeamState {
        let [dot_w, dot_slope] = self.moving(|s| mode.shape(s));
        BeamState { w: vec![0.0; self.n], slope: vec![0.0; self.n], dot_w, dot_slope }
    }

    /// At rest, as a force at the end bends it by `deflection`.
    pub fn loaded(&self, deflection: f64) -> BeamState {
        let [w, slope] =
            self.moving(|s| [s * s * (1.5 - 0.5 * s), s * (3.0 - 1.5 * s)].map(|x| deflection * x));
        BeamState { w, slope, dot_w: vec![0.0; self.n], dot_slope: vec![0.0; self.n] }
    }
}

impl Rod {
    /// Straight, with velocities across it that are those of a mode times `speed`.
    pub fn struck(&self, mode: Mode, speed: f64) -> RodState {
        let places = (1..=self.n).map(|i| i as f64 / self.n as f64);
        let (r, dot_r) = places.map(|s| ([s, 0.0], [0.0, speed * mode.shape(s)[0]])).unzip();
        RodState { r, dot_r }
    }

    /// At rest and not stretched, with the curvature 3a(1 − s)² at s, so that its end has the angle a and
    /// its energy is 0.9a² but for the length of the segments.
    pub fn bent(&self, angle: f64) -> RodState {
        let l = 1.0 / self.n as f64;
        let along = |i: f64| angle * (1.0 - (1.0 - i * l).powi(3));
        let r = joined(self.n, |i| [along(i).cos(), along(i).sin()]);
        RodState { r, dot_r: vec![[0.0; 2]; self.n] }
    }
}
