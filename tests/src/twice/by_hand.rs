//! The formulas of systems that other tests share, in plain Rust.

use dvi_core::Lagrangian;
use nalgebra::RealField;

use super::formula::Formula;
use super::systems::{Damped, real};
use crate::systems::{Curved, LotkaVolterra, ManyVortices, PointVortices, Quadratic, SphereForm};
use crate::zoo::constrained::{Bead, Charge, Double, Links, Spherical, Swing};
use crate::zoo::gauges::OneSided;
use crate::zoo::nonholonomic::{Particle, Steered};
use crate::zoo::particles::Mirror;
use crate::zoo::regular::{
    DoublePendulum, DrivenOscillator, GrowingMass, Kepler, MagneticParticle, MixedVelocities, Relativistic,
    Ring, RunTimeChain, SphericalPendulum, Surface,
};

impl Formula for Damped {
    fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], _t: T) -> T {
        let square = q[0] * q[0] + q[1] * q[1];
        let off = square - real(1.0);
        (v[0] * v[0] + v[1] * v[1]) * real(0.5) - square * off * off
    }
    fn force(&self, _q: &[f64], v: &[f64], _t: f64) -> Vec<f64> {
        vec![-self.gamma * v[0], -self.gamma * v[1]]
    }
}

/// L of systems without forces and constraints.
macro_rules! by_hand {
    ($($system:ty, |$this:ident, $q:ident, $v:ident, $t:ident| $lagrangian:expr;)+) => {$(
        impl Formula for $system {
            #[allow(unused_variables)]
            fn lagrangian<T: RealField + Copy>(&self, $q: &[T], $v: &[T], $t: T) -> T {
                let $this = self;
                $lagrangian
            }
        }
    )+};
}

by_hand! {
    Kepler, |this, q, v, t| square(v) * real(0.5) + real::<T>(this.mu) / square(q).sqrt();
    // From the positions of the two bobs in the plane.
    DoublePendulum, |this, q, v, t| {
        let [mut along, mut up, mut height, mut sum] = [real::<T>(0.0); 4];
        for i in 0..2 {
            let [m, l] = [this.mass[i], this.length[i]].map(real::<T>);
            along += q[i].cos() * v[i] * l;
            up += q[i].sin() * v[i] * l;
            height += (real::<T>(1.0) - q[i].cos()) * l;
            sum += m * ((along * along + up * up) * real(0.5) - height * real(this.g));
        }
        sum
    };
    SphericalPendulum, |this, q, v, t| square(&[v[0], q[0].sin() * v[1]]) * real(0.5) + q[0].cos() * real(this.g);
    // On the surface of this height.
    Surface, |this, q, v, t| {
        let (k, y) = (real::<T>(this.k), q[1]);
        let x = q[0] * k;
        let rise = x.cos() * y.sinh() * v[1] / k - x.sin() * y.cosh() * v[0];
        square(&[v[0], v[1], rise]) * real(0.5) - x.cos() * y.cosh() / k
    };
    Relativistic, |this, q, v, t| {
        -(real::<T>(1.0) - square(v)).sqrt() * real(this.m) - square(q) * real(0.5)
    };
    Ring<4>, |this, q, v, t| (0..4).fold(real(0.0), |sum: T, j| {
        let s = q[(j + 1) % 4] - q[j];
        let kinetic = v[j] * v[j] * real(this.mass[j] / 2.0);
        sum + kinetic - s * s * real(0.5) - s * s * s * real(this.alpha / 3.0)
    });
    RunTimeChain, |this, q, v, t| {
        let n = this.mass.len();
        let mut sum = v[n] * v[n] - (q[0] - q[n]).powi(4) * real(0.25);
        for j in 0..n {
            sum += v[j] * v[j] * real(this.mass[j] / 2.0);
            if j > 0 {
                sum += v[j] * v[j - 1] * real(this.coupling) - (q[j] - q[j - 1]).cosh();
            }
        }
        sum
    };
    DrivenOscillator, |this, q, v, t| {
        let gravity = real::<T>(1.0) + (t * real(this.omega)).cos() * real(this.depth);
        v[0] * v[0] * real(0.5) - gravity * (real::<T>(1.0) - q[0].cos()) + t * q[0]
    };
    GrowingMass, |this, q, v, t| {
        let product = q[0] * q[1];
        (square(v) + v[0] * v[1] - product * product) * (t * real(0.25)).exp()
    };
    MagneticParticle, |this, q, v, t| {
        let [x, y, z] = [q[0], q[1], q[2]];
        let [along_y, along_x] =
            [x * real(0.5) + x * x * x / real(3.0), y * real(0.5) + y * y * y / real(6.0)];
        let off = x * x + y * y - z;
        square(v) * real(this.m / 2.0) + (along_y * v[1] - along_x * v[0]) * real(this.b)
            - off * off * real(0.25)
    };
    MixedVelocities, |this, q, v, t| {
        let apart = v[0] - v[1];
        v[0] * v[0] * real(0.5) + v[0] * v[1] / real(3.0) + apart * apart
            - q[0] * q[0] - q[0] * q[1] - q[1].powi(4)
    };
    PointVortices<4>, |this, q, v, t| vortices(&this.gamma, q, v);
    ManyVortices, |this, q, v, t| vortices(&this.gamma, q, v);
    LotkaVolterra, |this, q, v, t| {
        let [along_x, along_y] = [q[1].ln() / q[0], -q[0].ln() / q[1]].map(|form| form * real(0.5));
        along_x * v[0] + along_y * v[1] - of_prey(this.a, this.b, q)
    };
    OneSided, |this, q, v, t| q[1].ln() / q[0] * v[0] - of_prey(this.a, this.b, q);
    SphereForm, |this, q, v, t| -q[1] * v[0] * real(this.gamma) - q[1] * q[1] * real(0.5) - q[0].cos();
    Curved, |this, q, v, t| {
        let form = |x: T| (x + x * x * x * real(this.kappa)) * real(0.5);
        form(q[0]) * v[1] - form(q[1]) * v[0] - square(q) * real(0.5) - q[0].powi(4) * real(0.25)
    };
}

/// ½ Σ Γ (x dy − y dx) less −Σ ΓΓ' ln r/2π.
fn vortices<T: RealField + Copy>(gamma: &[f64], q: &[T], v: &[T]) -> T {
    let n = gamma.len();
    let mut sum = real::<T>(0.0);
    for j in 0..n {
        sum += (q[j] * v[n + j] - q[n + j] * v[j]) * real(gamma[j] / 2.0);
        for k in 0..j {
            let apart = square(&[q[j] - q[k], q[n + j] - q[n + k]]);
            sum -= apart.ln() * real(gamma[j] * gamma[k] / (4.0 * core::f64::consts::PI));
        }
    }
    sum
}

/// The energy of predators and prey.
fn of_prey<T: RealField + Copy>(a: [f64; 2], b: [f64; 2], q: &[T]) -> T {
    (0..2).fold(real(0.0), |sum, i| sum + q[i] * real(a[i]) + q[i].ln() * real(b[i]))
}

/// L as it is generated, which the compiler holds against the formulas as written; no derivative is.
macro_rules! generated {
    ($($system:ty),+ $(,)?) => {$(
        impl Formula for $system {
            fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], t: T) -> T {
                Lagrangian::<T>::lagrangian(self, q, v, t)
            }
        }
    )+};
}

generated!(Quadratic, Mirror);

/// The same with constraints by hand, and forces.
macro_rules! constrained {
    ($($system:ty, |$this:ident, $q:ident, $t:ident| $constraints:expr
        $(, force |$v:ident| $force:expr)? $(, slips |$u:ident| $slips:expr)?;)+) => {$(
        impl Formula for $system {
            fn lagrangian<T: RealField + Copy>(&self, q: &[T], v: &[T], t: T) -> T {
                Lagrangian::<T>::lagrangian(self, q, v, t)
            }
            #[allow(unused_variables)]
            fn constraints<T: RealField + Copy>(&self, $q: &[T], $t: T) -> Vec<T> {
                let $this = self;
                $constraints
            }
            $(#[allow(unused_variables)]
            fn force(&self, _q: &[f64], $v: &[f64], _t: f64) -> Vec<f64> {
                let $this = self;
                $force
            })?
            $(fn slips<T: RealField + Copy>(&self, $q: &[T], $u: &[T], $t: T) -> Vec<T> {
                $slips
            })?
        }
    )+};
}

/// The square of the length.
fn square<T: RealField + Copy>(x: &[T]) -> T {
    x.iter().fold(real(0.0), |sum, &x| sum + x * x)
}

constrained! {
    Double, |this, q, t| {
        let outer = square(&[q[1] - q[0], q[3] - q[2]]).sqrt();
        vec![square(&[q[0], q[2]]) - real(1.0), outer - real(this.rod)]
    };
    Swing, |this, q, t| {
        let off = q[0] - real::<T>(0.3) * (t + t).sin();
        vec![(square(&[off, q[1]]) - real(1.0)) * (real::<T>(2.0) + t.cos())]
    }, force |v| v.iter().map(|v| -this.gamma * v).collect();
    Bead, |this, q, t| vec![square(&[q[0], q[1], q[1]]) - real(1.0)];
    Charge, |this, q, t| vec![square(q) - real(1.0)];
    Particle, |this, q, _t| Vec::new(), slips |v| vec![v[2] - q[1] * v[0]];
    Steered, |this, q, t| Vec::new(), force |v| vec![-0.2 * v[0]], slips |v| {
        vec![(v[1] - q[0] * v[0] - t.cos()) * (real::<T>(2.0) + q[0].sin())]
    };
    Spherical, |this, q, t| vec![square(q) - real(1.0)];
    Links, |this, q, t| {
        let n = this.rod.len();
        let before = |k: usize| if k.is_multiple_of(n) { real(0.0) } else { q[k - 1] };
        (0..n)
            .map(|i| square(&[q[i] - before(i), q[n + i] - before(n + i)]) - real(this.rod[i] * this.rod[i]))
            .collect()
    };
}
