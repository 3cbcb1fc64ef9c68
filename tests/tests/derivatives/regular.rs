//! Regular systems by hand, and what the compiler is to see of each.

mod compare;

use dvi_tests::zoo::regular::*;

use crate::derivatives::oracle::{Action, Number, Random};
use compare::{Sampled, agrees};

/// SEPARABLE, DIAGONAL_MASS and QUADRATIC.
struct Constants(bool, bool, bool);

macro_rules! systems {
    ($($name:ident: $system:expr => $constants:expr;)*) => {$(
        #[test]
        fn $name() {
            let Constants(separable, diagonal, quadratic) = $constants;
            agrees(&$system, [separable, diagonal, quadratic]);
        }
    )*};
}

const MASS: [f64; 4] = [1.0, 0.5, 2.0, 0.75];

systems! {
    kepler: Kepler { mu: 1.25 } => Constants(true, true, true);
    double_pendulum: DoublePendulum { mass: [1.0, 0.5], length: [0.75, 1.5], g: 9.81 } => Constants(false, false, true);
    spherical_pendulum: SphericalPendulum { g: 2.5 } => Constants(false, true, true);
    surface: Surface { k: 1.5 } => Constants(false, false, true);
    relativistic: Relativistic { m: 1.5 } => Constants(false, false, false);
    ring: Ring::<4> { mass: MASS, alpha: 0.25 } => Constants(true, true, true);
    run_time_chain: RunTimeChain { mass: MASS.to_vec(), coupling: 0.125 } => Constants(true, false, true);
    one_mass: RunTimeChain { mass: vec![2.0], coupling: 0.125 } => Constants(true, false, true);
    driven_oscillator: DrivenOscillator { depth: 0.5, omega: 1.5 } => Constants(true, true, true);
    growing_mass: GrowingMass {} => Constants(false, false, true);
    magnetic_particle: MagneticParticle { m: 1.5, b: -0.75 } => Constants(false, true, true);
    gravity: Gravity::<3> { mass: [1.0, 0.5, 2.0] } => Constants(true, true, true);
    mixed_velocities: MixedVelocities {} => Constants(true, false, true);
    tangled: Tangled { g: 0.75 } => Constants(false, false, false);
}

impl Action for Kepler {
    fn action<D: Number>(&self, q: &[D], v: &[D], _t: D) -> D {
        (v[0] * v[0] + v[1] * v[1]) / 2.0 + (q[0] * q[0] + q[1] * q[1]).sqrt().recip() * self.mu
    }
}

impl Sampled for Kepler {
    fn integrals<D: Number>(&self, q: &[D], v: &[D], _t: D) -> Vec<D> {
        vec![q[0] * v[1] - q[1] * v[0]]
    }
    fn point(&self, random: &mut Random) -> Vec<f64> {
        random.several(2, 0.5, 1.5)
    }
}

/// From the positions of the two bobs in the plane.
impl Action for DoublePendulum {
    fn action<D: Number>(&self, q: &[D], v: &[D], _t: D) -> D {
        let ([m1, m2], [l1, l2]) = (self.mass, self.length);
        let (mut x, mut y) = (D::zero(), D::zero());
        let mut action = D::zero();
        let mut height = D::zero();
        for (i, (m, l)) in [(m1, l1), (m2, l2)].into_iter().enumerate() {
            x += q[i].cos() * v[i] * l;
            y += q[i].sin() * v[i] * l;
            height += (-q[i].cos() + 1.0) * l;
            action += (x * x + y * y) * (m / 2.0) - height * (m * self.g);
        }
        action
    }
}

impl Sampled for DoublePendulum {}

impl Action for SphericalPendulum {
    fn action<D: Number>(&self, q: &[D], v: &[D], _t: D) -> D {
        let around = q[0].sin() * v[1];
        (v[0] * v[0] + around * around) / 2.0 + q[0].cos() * self.g
    }
}

impl Sampled for SphericalPendulum {
    fn integrals<D: Number>(&self, q: &[D], v: &[D], _t: D) -> Vec<D> {
        vec![q[0].sin() * q[0].sin() * v[1]]
    }
}

impl Action for Surface {
    fn action<D: Number>(&self, q: &[D], v: &[D], _t: D) -> D {
        let (x, y) = (q[0] * self.k, q[1]);
        let rise = -x.sin() * y.cosh() * v[0] + x.cos() * y.sinh() * v[1] / self.k;
        (v[0] * v[0] + v[1] * v[1] + rise * rise) / 2.0 - x.cos() * y.cosh() / self.k
    }
}

impl Sampled for Surface {}

impl Action for Relativistic {
    fn action<D: Number>(&self, q: &[D], v: &[D], _t: D) -> D {
        let slowness = (-(v[0] * v[0] + v[1] * v[1]) + 1.0).sqrt();
        -slowness * self.m - (q[0] * q[0] + q[1] * q[1]) / 2.0
    }
}

impl Sampled for Relativistic {
    fn integrals<D: Number>(&self, _q: &[D], v: &[D], _t: D) -> Vec<D> {
        vec![v[0] * self.m / (-(v[0] * v[0] + v[1] * v[1]) + 1.0).sqrt()]
    }
    fn velocity(&self, random: &mut Random, count: usize) -> Vec<f64> {
        random.several(count, -0.6, 0.6)
    }
}

impl<const N: usize> Action for Ring<N> {
    fn action<D: Number>(&self, q: &[D], v: &[D], _t: D) -> D {
        let kinetic: D = (0..N).map(|j| v[j] * v[j] * (self.mass[j] / 2.0)).sum();
        let potential = |j: usize| {
            let s = q[if j + 1 < N { j + 1 } else { 0 }] - q[j];
            s * s / 2.0 + s * s * s * (self.alpha / 3.0)
        };
        kinetic - (0..N).map(potential).sum::<D>()
    }
}

impl<const N: usize> Sampled for Ring<N> {
    fn integrals<D: Number>(&self, _q: &[D], v: &[D], _t: D) -> Vec<D> {
        vec![(0..N).map(|j| v[j] * self.mass[j]).sum()]
    }
}

impl Action for RunTimeChain {
    fn action<D: Number>(&self, q: &[D], v: &[D], _t: D) -> D {
        let n = self.mass.len();
        let mut action = v[n] * v[n] - (q[0] - q[n]).powi(4) / 4.0;
        for j in 0..n {
            action += v[j] * v[j] * (self.mass[j] / 2.0);
            if j > 0 {
                action += v[j] * v[j - 1] * self.coupling - (q[j] - q[j - 1]).cosh();
            }
        }
        action
    }
}

impl Sampled for RunTimeChain {}

impl Action for DrivenOscillator {
    fn action<D: Number>(&self, q: &[D], v: &[D], t: D) -> D {
        let gravity = (t * self.omega).cos() * self.depth + 1.0;
        v[0] * v[0] / 2.0 - gravity * (-q[0].cos() + 1.0) + t * q[0]
    }
}

impl Sampled for DrivenOscillator {}

impl Action for GrowingMass {
    fn action<D: Number>(&self, q: &[D], v: &[D], t: D) -> D {
        (v[0] * v[0] + v[0] * v[1] + v[1] * v[1] - q[0] * q[0] * q[1] * q[1]) * (t / 4.0).exp()
    }
}

impl Sampled for GrowingMass {}

impl Action for MagneticParticle {
    fn action<D: Number>(&self, q: &[D], v: &[D], _t: D) -> D {
        let [x, y, z] = [q[0], q[1], q[2]];
        let kinetic = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) * (self.m / 2.0);
        let along = (x / 2.0 + x * x * x / 3.0) * v[1] - (y / 2.0 + y * y * y / 6.0) * v[0];
        let off = x * x + y * y - z;
        kinetic + along * self.b - off * off / 4.0
    }
}

impl Sampled for MagneticParticle {}

impl<const N: usize> Action for Gravity<N> {
    fn action<D: Number>(&self, q: &[D], v: &[D], _t: D) -> D {
        let mut action = D::zero();
        for j in 0..N {
            action += (v[j] * v[j] + v[N + j] * v[N + j]) * (self.mass[j] / 2.0);
            for k in 0..j {
                let (x, y) = (q[j] - q[k], q[N + j] - q[N + k]);
                action += (x * x + y * y).sqrt().recip() * (self.mass[j] * self.mass[k]);
            }
        }
        action
    }
}

impl<const N: usize> Sampled for Gravity<N> {
    fn integrals<D: Number>(&self, q: &[D], v: &[D], _t: D) -> Vec<D> {
        let sum = |f: &dyn Fn(usize) -> D| (0..N).map(|j| f(j) * self.mass[j]).sum();
        vec![sum(&|j| v[j]), sum(&|j| q[j] * v[N + j] - q[N + j] * v[j])]
    }
    fn point(&self, random: &mut Random) -> Vec<f64> {
        (0..2 * N).map(|i| (i % N) as f64 + random.between(-0.3, 0.3)).collect()
    }
}

impl Action for MixedVelocities {
    fn action<D: Number>(&self, q: &[D], v: &[D], _t: D) -> D {
        let apart = v[0] - v[1];
        v[0] * v[0] / 2.0 + v[0] * v[1] / 3.0 + apart * apart
            - q[0] * q[0]
            - q[0] * q[1]
            - q[1] * q[1] * q[1] * q[1]
    }
}

impl Sampled for MixedVelocities {}

impl Action for Tangled {
    fn action<D: Number>(&self, q: &[D], v: &[D], t: D) -> D {
        let (u, w) = (q[3], v[3]);
        let speed = v[..3].iter().map(|&v| v * v).sum::<D>();
        let choice = if u.re() > 0.0 { w * w * w * w + w * w } else { w.cosh() * 2.0 };
        let rest = w.exp() + (v[1] * u).sin() - q[2] * v[2] + w * t;
        (speed + 1.0).sqrt() * (q[0].sin() + 2.0) + choice + rest * self.g
    }
}

impl Sampled for Tangled {
    fn integrals<D: Number>(&self, _q: &[D], v: &[D], _t: D) -> Vec<D> {
        vec![v[..3].iter().map(|v| v.abs()).sum::<D>().ln_1p()]
    }
}
