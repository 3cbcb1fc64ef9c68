//! The right-hand sides by hand, with one reciprocal for each pair and constants computed beforehand: what
//! the other programs are given.

use std::f64::consts::PI;

use dvi_kernels::vortices_by_hand;

/// y' = f(y), with its energy.
pub(crate) trait Field<const N: usize>: Clone + 'static {
    fn slope(&self, y: &[f64; N]) -> [f64; N];
    fn energy(&self, y: &[f64; N]) -> f64;
}

/// Vortices, with y = (x, y).
#[derive(Clone)]
pub(crate) struct Vortices {
    pub(crate) gamma: [f64; 4],
    field: vortices_by_hand::Field,
}

impl Vortices {
    pub(crate) fn new(gamma: [f64; 4]) -> Self {
        Self { gamma, field: vortices_by_hand::Field::new(gamma) }
    }
}

impl Field<8> for Vortices {
    #[inline(always)]
    fn slope(&self, z: &[f64; 8]) -> [f64; 8] {
        self.field.velocity(z)
    }

    fn energy(&self, z: &[f64; 8]) -> f64 {
        let mut energy = 0.0;
        for j in 0..4 {
            for k in j + 1..4 {
                let (dx, dy) = (z[j] - z[k], z[4 + j] - z[4 + k]);
                energy += self.gamma[j] * self.gamma[k] * (dx * dx + dy * dy).ln() / (4.0 * PI);
            }
        }
        energy
    }
}

/// A planet around a fixed sun of mass one.
#[derive(Clone)]
pub(crate) struct Kepler;

impl Field<4> for Kepler {
    #[inline(always)]
    fn slope(&self, [x, y, u, w]: &[f64; 4]) -> [f64; 4] {
        let square = x * x + y * y;
        let pull = -1.0 / (square * square.sqrt());
        [*u, *w, pull * x, pull * y]
    }

    fn energy(&self, [x, y, u, w]: &[f64; 4]) -> f64 {
        0.5 * (u * u + w * w) - 1.0 / (x * x + y * y).sqrt()
    }
}

/// Sun and planets, with y = (q, v) and q = (x, y, z).
#[derive(Clone)]
pub(crate) struct Planets {
    g: f64,
    mass: [f64; 6],
    /// G times the masses.
    pull: [f64; 6],
}

impl Planets {
    pub(crate) fn new(g: f64, mass: [f64; 6]) -> Self {
        Self { g, mass, pull: mass.map(|mass| g * mass) }
    }
}

impl Field<36> for Planets {
    #[inline(always)]
    fn slope(&self, y: &[f64; 36]) -> [f64; 36] {
        let mut slope = [0.0; 36];
        slope[..18].copy_from_slice(&y[18..]);
        for j in 0..6 {
            for k in j + 1..6 {
                let d: [f64; 3] = std::array::from_fn(|i| y[6 * i + j] - y[6 * i + k]);
                let square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
                let inverse = 1.0 / (square * square.sqrt());
                let (from_j, from_k) = (self.pull[j] * inverse, self.pull[k] * inverse);
                for i in 0..3 {
                    slope[18 + 6 * i + j] -= from_k * d[i];
                    slope[18 + 6 * i + k] += from_j * d[i];
                }
            }
        }
        slope
    }

    fn energy(&self, y: &[f64; 36]) -> f64 {
        let mut energy = 0.0;
        for j in 0..6 {
            let square: f64 = (0..3).map(|i| y[18 + 6 * i + j].powi(2)).sum();
            energy += 0.5 * self.mass[j] * square;
            for k in j + 1..6 {
                let square: f64 = (0..3).map(|i| (y[6 * i + j] - y[6 * i + k]).powi(2)).sum();
                energy -= self.g * self.mass[j] * self.mass[k] / square.sqrt();
            }
        }
        energy
    }
}
