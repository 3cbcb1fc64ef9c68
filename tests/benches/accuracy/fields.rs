//! The right-hand sides by hand, with one reciprocal for each pair and constants computed beforehand: what
//! the other programs and the methods by hand are given.

use std::f64::consts::PI;

use dvi_kernels::vortices_by_hand;

/// y' = f(y), with its energy.
pub(crate) trait Field<const N: usize>: Clone + 'static {
    fn slope(&self, y: &[f64; N]) -> [f64; N];
    fn energy(&self, y: &[f64; N]) -> f64;
}

/// q'' = f(q), with `N` coordinates.
pub(crate) trait Forces<const N: usize>: Clone + 'static {
    fn acceleration(&self, q: &[f64; N]) -> [f64; N];
    fn energy(&self, q: &[f64; N], v: &[f64; N]) -> f64;
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

impl Forces<2> for Kepler {
    #[inline(always)]
    fn acceleration(&self, q: &[f64; 2]) -> [f64; 2] {
        let square = q[0] * q[0] + q[1] * q[1];
        let pull = -1.0 / (square * square.sqrt());
        [pull * q[0], pull * q[1]]
    }

    fn energy(&self, q: &[f64; 2], v: &[f64; 2]) -> f64 {
        0.5 * (v[0] * v[0] + v[1] * v[1]) - 1.0 / (q[0] * q[0] + q[1] * q[1]).sqrt()
    }
}

impl Field<4> for Kepler {
    #[inline(always)]
    fn slope(&self, y: &[f64; 4]) -> [f64; 4] {
        first_order::<2, 4>(self, y)
    }

    fn energy(&self, y: &[f64; 4]) -> f64 {
        Forces::energy(self, &half::<2>(&y[..2]), &half::<2>(&y[2..]))
    }
}

/// Sun and planets, with q = (x, y, z).
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

impl Forces<18> for Planets {
    #[inline(always)]
    fn acceleration(&self, q: &[f64; 18]) -> [f64; 18] {
        let mut a = [0.0; 18];
        for j in 0..6 {
            for k in j + 1..6 {
                let d: [f64; 3] = std::array::from_fn(|i| q[6 * i + j] - q[6 * i + k]);
                let square = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
                let inverse = 1.0 / (square * square.sqrt());
                let (from_j, from_k) = (self.pull[j] * inverse, self.pull[k] * inverse);
                for i in 0..3 {
                    a[6 * i + j] -= from_k * d[i];
                    a[6 * i + k] += from_j * d[i];
                }
            }
        }
        a
    }

    fn energy(&self, q: &[f64; 18], v: &[f64; 18]) -> f64 {
        let mut energy = 0.0;
        for j in 0..6 {
            let square: f64 = (0..3).map(|i| v[6 * i + j].powi(2)).sum();
            energy += 0.5 * self.mass[j] * square;
            for k in j + 1..6 {
                let square: f64 = (0..3).map(|i| (q[6 * i + j] - q[6 * i + k]).powi(2)).sum();
                energy -= self.g * self.mass[j] * self.mass[k] / square.sqrt();
            }
        }
        energy
    }
}

impl Field<36> for Planets {
    #[inline(always)]
    fn slope(&self, y: &[f64; 36]) -> [f64; 36] {
        first_order::<18, 36>(self, y)
    }

    fn energy(&self, y: &[f64; 36]) -> f64 {
        Forces::energy(self, &half::<18>(&y[..18]), &half::<18>(&y[18..]))
    }
}

/// (q, v)' = (v, f(q)), with `M` = 2`N`.
#[inline(always)]
fn first_order<const N: usize, const M: usize>(forces: &impl Forces<N>, y: &[f64; M]) -> [f64; M] {
    let mut slope = [0.0; M];
    slope[..N].copy_from_slice(&y[N..]);
    slope[N..].copy_from_slice(&forces.acceleration(&half(&y[..N])));
    slope
}

#[inline(always)]
fn half<const N: usize>(numbers: &[f64]) -> [f64; N] {
    let mut half = [0.0; N];
    half.copy_from_slice(numbers);
    half
}
