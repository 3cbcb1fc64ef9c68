//! Vortices and charged particles by hand.

use std::f64::consts::PI;

use dvi_tests::systems::PointVortices;
use dvi_tests::zoo::particles::{GuidingCentre, PlaneParticle, SphereVortices};

use crate::derivatives::oracle::{ByHand, Number, Random};

impl<const N: usize> ByHand for PointVortices<N> {
    fn alpha<D: Number>(&self, q: &[D], _t: D) -> Vec<D> {
        let along_x = (0..N).map(|j| -q[N + j] * (self.gamma[j] / 2.0));
        along_x.chain((0..N).map(|j| q[j] * (self.gamma[j] / 2.0))).collect()
    }
    fn energy<D: Number>(&self, q: &[D], _t: D) -> D {
        let mut sum = D::zero();
        for j in 0..N {
            for k in 0..j {
                let (x, y) = (q[j] - q[k], q[N + j] - q[N + k]);
                sum += (x * x + y * y).ln() * (self.gamma[j] * self.gamma[k]);
            }
        }
        sum / (4.0 * PI)
    }
    fn integrals<D: Number>(&self, q: &[D], _t: D) -> Vec<D> {
        let sum = |f: &dyn Fn(usize) -> D| (0..N).map(|j| f(j) * self.gamma[j]).sum();
        let squares = sum(&|j| q[j] * q[j] + q[N + j] * q[N + j]);
        vec![sum(&|j| q[j]), sum(&|j| q[N + j]), squares]
    }
}

impl<const N: usize> ByHand for SphereVortices<N> {
    fn alpha<D: Number>(&self, q: &[D], _t: D) -> Vec<D> {
        (0..2 * N).map(|i| if i < N { -q[N + i] * self.gamma[i] } else { D::zero() }).collect()
    }
    /// The chord between two points of the sphere in Cartesian coordinates.
    fn energy<D: Number>(&self, q: &[D], _t: D) -> D {
        let position = |j: usize| {
            let (phi, z) = (q[j], q[N + j]);
            let flat = (-(z * z) + 1.0).sqrt();
            [flat * phi.cos(), flat * phi.sin(), z]
        };
        let mut sum = D::zero();
        for j in 0..N {
            for k in 0..j {
                let chord: D =
                    position(j).into_iter().zip(position(k)).map(|(a, b)| (a - b) * (a - b)).sum();
                sum += chord.ln() * (self.gamma[j] * self.gamma[k]);
            }
        }
        sum / (4.0 * PI)
    }
    fn integrals<D: Number>(&self, q: &[D], _t: D) -> Vec<D> {
        let z = (0..N).map(|j| q[N + j] * self.gamma[j]).sum();
        let x = (0..N).map(|j| (-(q[N + j] * q[N + j]) + 1.0).sqrt() * q[j].cos() * self.gamma[j]).sum();
        vec![z, x]
    }
    fn point(&self, random: &mut Random) -> Vec<f64> {
        let longitudes: Vec<f64> = (0..N).map(|j| 2.0 * j as f64 + random.between(-0.8, 0.8)).collect();
        longitudes.into_iter().chain((0..N).map(|_| random.between(-0.8, 0.8))).collect()
    }
}

impl ByHand for PlaneParticle {
    fn alpha<D: Number>(&self, q: &[D], _t: D) -> Vec<D> {
        let (x, y) = (q[0], q[1]);
        vec![-(y / 2.0 + y * y * y / 6.0) * self.b, (x / 2.0 + x.sin() * y.cos() * self.ripple) * self.b]
    }
    fn energy<D: Number>(&self, q: &[D], _t: D) -> D {
        let (x, y) = (q[0], q[1]);
        (x.cos() * (y + y).cos() - x * y) * self.e + (-x * x - y * y).exp()
    }
}

impl ByHand for GuidingCentre {
    fn alpha<D: Number>(&self, q: &[D], _t: D) -> Vec<D> {
        let [x, y, z, u] = [q[0], q[1], q[2], q[3]];
        let axial = x * x + y * y + 1.0;
        let parallel = u / (axial + z * z * self.shear).sqrt();
        let axial_potential = -axial.ln() / 2.0;
        vec![-y / 2.0 - y * parallel, x / 2.0 + x * parallel, axial_potential + parallel, z * x * self.shear]
    }
    fn energy<D: Number>(&self, q: &[D], _t: D) -> D {
        let [x, y, z, u] = [q[0], q[1], q[2], q[3]];
        u * u / 2.0 + (x * x + y * y + z * z * self.shear + 1.0).sqrt() * self.mu
    }
}
