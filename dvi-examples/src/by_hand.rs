//! TEMPORARY until the macro can be used.
#![allow(missing_docs, clippy::all)]
use dvi_core::*;
#[derive(Clone, Debug)]
pub struct PointVortices<const N: usize> {
    pub gamma: [f64; N],
}
#[derive(Clone, Debug)]
pub struct PointVorticesState<const N: usize, T = f64> {
    pub x: [T; N],
    pub y: [T; N],
}
impl<const N: usize, T: Scalar> State<T> for PointVorticesState<N, T> {
    fn write(&self, _: impl Fn(usize) -> usize, flat: &mut [T]) -> Result<(), LengthError> {
        flat[..N].copy_from_slice(&self.x);
        flat[N..].copy_from_slice(&self.y);
        Ok(())
    }
    fn read(_: impl Fn(usize) -> usize, flat: &[T]) -> Self {
        Self { x: std::array::from_fn(|i| flat[i]), y: std::array::from_fn(|i| flat[N + i]) }
    }
}
const REP: Report =
    Report::new("PointVortices", &[], &["impulse_x", "impulse_y", "angular"], &[], &[], &[], &[], &[]);
impl<const N: usize> PointVortices<N> {
    fn g<T: Scalar>(&self, j: usize) -> T {
        T::lift(self.gamma[j])
    }
}
impl<const N: usize> Lagrangian for PointVortices<N> {
    type Space = Fixed<2, N>;
    type State<T: Scalar> = PointVorticesState<N, T>;
    const REPORT: Report = REP;
    fn space(&self) -> Self::Space {
        Fixed
    }
    fn block_len(&self, _: usize) -> usize {
        N
    }
    fn check(&self) -> Result<(), IndexError> {
        Ok(())
    }
    fn lagrangian<T: Scalar>(&self, q: &[T], v: &[T], t: T) -> T {
        let mut s = T::lift(0.0) - self.hamiltonian(q, t);
        for j in 0..N {
            s += self.g::<T>(j) * T::lift(0.5) * (q[j] * v[N + j] - q[N + j] * v[j]);
        }
        s
    }
    fn gradient<T: Scalar>(&self, q: &[T], v: &[T], t: T, l_q: &mut [T], l_v: &mut [T]) {
        self.hamiltonian_gradient(q, t, l_q);
        self.one_form(q, t, l_v);
        for j in 0..N {
            let g = self.g::<T>(j) * T::lift(0.5);
            l_q[j] = g * v[N + j] - l_q[j];
            l_q[N + j] = -(g * v[j]) - l_q[N + j];
        }
    }
    fn linearize<T: Scalar>(
        &self,
        q: &[T],
        v: &[T],
        t: T,
        w: Weights<T>,
        l_q: &mut [T],
        l_v: &mut [T],
        m: &mut [T],
    ) {
        self.gradient(q, v, t, l_q, l_v);
        let n = 2 * N;
        for j in 0..N {
            let g = self.g::<T>(j) * T::lift(0.5);
            // L_qv[i][k] = d alpha_k / d q_i
            m[j * n + N + j] += w.qv * g - w.vq * g;
            m[(N + j) * n + j] += w.vq * g - w.qv * g;
        }
        for j in 0..N {
            for k in 0..j {
                let dx = q[j] - q[k];
                let dy = q[N + j] - q[N + k];
                let r = dx * dx + dy * dy;
                let c = self.g::<T>(j) * self.g(k) / T::lift(2.0 * std::f64::consts::PI) / (r * r) * w.qq;
                let xx = c * (dy * dy - dx * dx);
                let xy = T::lift(-2.0) * c * dx * dy;
                for (a, b, s) in [(j, j, 1.0), (k, k, 1.0), (j, k, -1.0), (k, j, -1.0)] {
                    let s = T::lift(s);
                    m[a * n + b] += -(s * xx);
                    m[(N + a) * n + N + b] += s * xx;
                    m[a * n + N + b] += -(s * xy);
                    m[(N + a) * n + b] += -(s * xy);
                }
            }
        }
    }
    fn momentum<T: Scalar>(&self, i: usize, q: &[T], _: T) -> T {
        let mut s = T::lift(0.0);
        for j in 0..N {
            s += self.g::<T>(j)
                * match i {
                    0 => q[j],
                    1 => q[N + j],
                    _ => q[j] * q[j] + q[N + j] * q[N + j],
                };
        }
        s
    }
    fn momentum_gradient<T: Scalar>(&self, i: usize, q: &[T], _: T, out: &mut [T]) {
        for j in 0..N {
            let g = self.g::<T>(j);
            let z = T::lift(0.0);
            let two = T::lift(2.0);
            let (a, b) = match i {
                0 => (g, z),
                1 => (z, g),
                _ => (two * g * q[j], two * g * q[N + j]),
            };
            out[j] = a;
            out[N + j] = b;
        }
    }
}
impl<const N: usize> DegenerateLagrangian for PointVortices<N> {
    const LINEAR: bool = true;
    const MATCHING: bool = true;
    const CANONICAL: bool = true;
    #[inline(always)]
    fn hamiltonian<T: Scalar>(&self, q: &[T], _: T) -> T {
        let mut s = T::lift(0.0);
        for j in 0..N {
            for k in 0..j {
                let dx = q[j] - q[k];
                let dy = q[N + j] - q[N + k];
                s += self.g::<T>(j) * self.g(k) * Scalar::ln(dx * dx + dy * dy);
            }
        }
        s / T::lift(4.0 * std::f64::consts::PI)
    }
    #[inline(always)]
    fn hamiltonian_gradient<T: Scalar>(&self, q: &[T], _: T, out: &mut [T]) {
        let q = &q[..2 * N];
        let out = &mut out[..2 * N];
        out.fill(T::lift(0.0));
        for j in 0..N {
            for k in 0..j {
                let dx = q[j] - q[k];
                let dy = q[N + j] - q[N + k];
                let c =
                    self.g::<T>(j) * self.g(k) / (T::lift(2.0 * std::f64::consts::PI) * (dx * dx + dy * dy));
                out[j] += c * dx;
                out[k] -= c * dx;
                out[N + j] += c * dy;
                out[N + k] -= c * dy;
            }
        }
    }
    fn one_form<T: Scalar>(&self, q: &[T], _: T, out: &mut [T]) {
        for j in 0..N {
            let g = self.g::<T>(j) * T::lift(0.5);
            out[j] = -(g * q[N + j]);
            out[N + j] = g * q[j];
        }
    }
    fn one_form_jacobian<T: Scalar>(&self, _: &[T], _: T, a: T, b: T, m: &mut [T]) {
        let n = 2 * N;
        for j in 0..N {
            let g = self.g::<T>(j) * T::lift(0.5);
            m[j * n + N + j] += b * g - a * g;
            m[(N + j) * n + j] += a * g - b * g;
        }
    }
    fn partner_entries<T: Scalar>(&self, _: &[T], _: T, a: T, b: T, out: &mut [T]) {
        for j in 0..N {
            let g = self.g::<T>(j) * T::lift(0.5);
            out[j] = b * g - a * g;
            out[N + j] = a * g - b * g;
        }
    }
    fn partner(&self, i: usize) -> usize {
        if i < N { i + N } else { i - N }
    }
}
#[derive(Clone, Debug)]
pub struct Rotation {
    pub omega: f64,
}
#[derive(Clone, Debug)]
pub struct RotationState<T = f64> {
    pub x: T,
    pub y: T,
}
impl<T: Scalar> State<T> for RotationState<T> {
    fn write(&self, _: impl Fn(usize) -> usize, flat: &mut [T]) -> Result<(), LengthError> {
        flat[0] = self.x;
        flat[1] = self.y;
        Ok(())
    }
    fn read(_: impl Fn(usize) -> usize, flat: &[T]) -> Self {
        Self { x: flat[0], y: flat[1] }
    }
}
impl Lagrangian for Rotation {
    type Space = Fixed<2, 1>;
    type State<T: Scalar> = RotationState<T>;
    const REPORT: Report = Report::new("Rotation", &[], &[], &[], &[], &[], &[], &[]);
    fn space(&self) -> Self::Space {
        Fixed
    }
    fn block_len(&self, _: usize) -> usize {
        1
    }
    fn check(&self) -> Result<(), IndexError> {
        Ok(())
    }
    fn lagrangian<T: Scalar>(&self, q: &[T], v: &[T], t: T) -> T {
        (q[0] * v[1] - q[1] * v[0]) * T::lift(0.5) - self.hamiltonian(q, t)
    }
    fn gradient<T: Scalar>(&self, q: &[T], v: &[T], t: T, l_q: &mut [T], l_v: &mut [T]) {
        let w = T::lift(self.omega);
        let h = T::lift(0.5);
        l_q[0] = h * v[1] - w * q[0];
        l_q[1] = -(h * v[0]) - w * q[1];
        self.one_form(q, t, l_v);
    }
    fn linearize<T: Scalar>(
        &self,
        q: &[T],
        v: &[T],
        t: T,
        w: Weights<T>,
        l_q: &mut [T],
        l_v: &mut [T],
        m: &mut [T],
    ) {
        self.gradient(q, v, t, l_q, l_v);
        let g = T::lift(0.5);
        let o = T::lift(self.omega);
        m[1] += w.qv * g - w.vq * g;
        m[2] += w.vq * g - w.qv * g;
        m[0] += -(w.qq * o);
        m[3] += -(w.qq * o);
    }
    fn momentum<T: Scalar>(&self, _: usize, _: &[T], t: T) -> T {
        t
    }
    fn momentum_gradient<T: Scalar>(&self, _: usize, _: &[T], _: T, _: &mut [T]) {}
}
impl DegenerateLagrangian for Rotation {
    const LINEAR: bool = true;
    const MATCHING: bool = true;
    const CANONICAL: bool = true;
    fn hamiltonian<T: Scalar>(&self, q: &[T], _: T) -> T {
        T::lift(self.omega * 0.5) * (q[0] * q[0] + q[1] * q[1])
    }
    fn hamiltonian_gradient<T: Scalar>(&self, q: &[T], _: T, out: &mut [T]) {
        out[0] = T::lift(self.omega) * q[0];
        out[1] = T::lift(self.omega) * q[1];
    }
    fn one_form<T: Scalar>(&self, q: &[T], _: T, out: &mut [T]) {
        let g = T::lift(0.5);
        out[0] = -(g * q[1]);
        out[1] = g * q[0];
    }
    fn one_form_jacobian<T: Scalar>(&self, _: &[T], _: T, a: T, b: T, m: &mut [T]) {
        let g = T::lift(0.5);
        m[1] += b * g - a * g;
        m[2] += a * g - b * g;
    }
    fn partner_entries<T: Scalar>(&self, _: &[T], _: T, a: T, b: T, out: &mut [T]) {
        let g = T::lift(0.5);
        out[0] = b * g - a * g;
        out[1] = a * g - b * g;
    }
    fn partner(&self, i: usize) -> usize {
        1 - i
    }
}
