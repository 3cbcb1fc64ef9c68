//! Unit vectors: S².

use nalgebra::{Matrix2, Vector3};

use crate::{Real, Scalar};

/// A great circle from s0: s(c) = cos(cθ) s0 + sin(cθ) d, with the axis n = s0 × d.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GreatCircle<T> {
    start: Vector3<T>,
    pub(crate) direction: Vector3<T>,
    pub(crate) axis: Vector3<T>,
    pub(crate) angle: T,
}

/// Where a point moves on a great circle, and what varies with its end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Passing<T> {
    pub(crate) point: Vector3<T>,
    /// The direction of the circle at the point.
    pub(crate) direction: Vector3<T>,
    pub(crate) sine: T,
    pub(crate) cosine: T,
}

/// Below this angle what is of its size is left out of a derivative, in radians.
const NEAR: f64 = 1e-8;

impl<T: Real> GreatCircle<T> {
    /// The circle from a unit vector along the rotation vector `w`, of which the part along the unit vector
    /// is left out. Where nothing is left, its direction is any.
    #[inline]
    pub(crate) fn new(start: Vector3<T>, w: Vector3<T>) -> Self {
        let along = w - start * start.dot(&w);
        let angle = along.norm();
        let axis = if angle > T::lift(0.0) { along / angle } else { normal(&start) };
        Self { start, direction: axis.cross(&start), axis, angle }
    }

    #[inline]
    pub(crate) fn at(&self, c: T) -> Passing<T> {
        let Self { start, direction, angle, .. } = self;
        let (sine, cosine) = (Scalar::sin(c * *angle), Scalar::cos(c * *angle));
        let point = start * cosine + direction * sine;
        Passing { point, direction: direction * cosine - start * sine, sine, cosine }
    }

    /// How D₁L_d at the part `c`, along the circle and across, changes with the end of the circle, where
    /// ∂L/∂q and ∂L/∂v/h there are the same: the directions along and across turn with it.
    #[inline]
    pub(crate) fn bend(&self, c: T, [l_q, l_v]: [Vector3<T>; 2]) -> Matrix2<T> {
        let (one, zero, theta) = (T::lift(1.0), T::lift(0.0), self.angle);
        let (rest, here, end) = (one - c, self.at(c), self.at(one));
        let far = self.at(rest);
        let sinc = Scalar::sinc(theta);
        // sin((1 − c)θ)/sin θ and θ cos((1 − c)θ)/sin θ.
        let (a, b) = (rest * Scalar::sinc(rest * theta) / sinc, far.cosine / sinc);
        // What goes with θ near zero, where a quotient would be rounding.
        let per_theta = if theta > T::lift(NEAR) { one / theta } else { zero };
        let per_sine = per_theta / sinc;
        let a_slope = (rest * far.cosine - a * end.cosine) * per_sine;
        let b_slope = (far.cosine - rest * theta * far.sine - b * end.cosine) * per_sine;
        let [along, outward, across] = [here.direction, here.point, self.axis]
            .map(|direction| [direction.dot(&l_q), direction.dot(&l_v)]);
        let by_length = c * rest * outward[0] + (one - c - c) * outward[1] + c * rest * theta * along[1];
        let turned = c * Scalar::sinc(c * theta);
        Matrix2::new(
            by_length,
            (a - rest * here.cosine) * per_theta * across[0]
                + ((here.cosine - b) * per_theta + rest * here.sine) * across[1],
            b_slope * across[1] - a_slope * across[0],
            (a * here.cosine - rest) * per_theta * along[0]
                + a * turned * outward[0]
                + (one - b * here.cosine) * per_theta * along[1]
                + (rest - b * turned) * outward[1],
        )
    }

    /// s(1) − s0.
    #[inline]
    pub(crate) fn increment(&self) -> Vector3<T> {
        let half = Scalar::sin(T::lift(0.5) * self.angle);
        self.direction * Scalar::sin(self.angle) - self.start * (T::lift(2.0) * half * half)
    }
}

/// A unit vector at right angles to `s`.
pub(crate) fn normal<T: Real>(s: &Vector3<T>) -> Vector3<T> {
    // The coordinate axis that makes the largest angle with it.
    let small = |k: usize| Scalar::abs(s[k]);
    let axis = if small(0) <= small(1) && small(0) <= small(2) {
        Vector3::x()
    } else if small(1) <= small(2) {
        Vector3::y()
    } else {
        Vector3::z()
    };
    let across = s.cross(&axis);
    across / across.norm()
}
