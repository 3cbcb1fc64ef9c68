//! Spinors of vectors in space: z ∈ ℂ² with s = z†σz and |z|² = |s|.

use super::{Comparison, Scalar};

/// The coordinates of a spinor, and the components of a vector.
pub(crate) const COORDINATES: usize = 4;
pub(crate) const COMPONENTS: usize = 3;

/// A spinor of a vector, with |z|² = |s|. One component is real, a where s points up and c where it points
/// down, so that the divisor is never small. A vector whose length is infinite or no number has none: its
/// entries stand there, and NaN.
pub fn lift<T: Scalar>([x, y, z]: [T; COMPONENTS]) -> [T; COORDINATES] {
    let (zero, half) = (T::lift(0.0), T::lift(0.5));
    let length = (x * x + y * y + z * z).sqrt();
    let real = (half * (length + z.abs())).sqrt();
    let [p, q] = [x, y].map(|component| half * component.over_root(real));
    let (up, down) = ([real, zero, p, q], [p, -q, real, zero]);
    let none = [x, y, z, T::lift(f64::NAN)];
    core::array::from_fn(|k| {
        let spinor = T::choose(z, Comparison::Less, zero, down[k], up[k]);
        T::choose(length, Comparison::Less, T::lift(f64::INFINITY), spinor, none[k])
    })
}

/// s = z†σz
pub fn lower<T: Scalar>([a, b, c, d]: [T; COORDINATES]) -> [T; COMPONENTS] {
    let two = T::lift(2.0);
    [two * (a * c + b * d), two * (a * d - b * c), a * a + b * b - c * c - d * d]
}

#[test]
fn a_spinor_of_a_vector_has_its_direction_and_length() {
    let near = |s: [f64; 3]| {
        let z = lift(s);
        let found = lower(z);
        let length = s.iter().map(|s| s * s).sum::<f64>().sqrt();
        let error = found.iter().zip(s).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let norm: f64 = z.iter().map(|z| z * z).sum();
        assert!(error <= 4.0 * f64::EPSILON * length, "{s:?} is read as {found:?}");
        assert!((norm - length).abs() <= 4.0 * f64::EPSILON * length, "{s:?} has {z:?}");
    };
    // Everywhere on the sphere, at the poles and next to them.
    for (k, j) in (0..=200).flat_map(|k| (0..40).map(move |j| (k, j))) {
        let (polar, azimuth) = (f64::from(k) * 0.005 * core::f64::consts::PI, f64::from(j) * 0.157);
        near([polar.sin() * azimuth.cos(), polar.sin() * azimuth.sin(), polar.cos()]);
    }
    for x in [0.0, 1e-100, -1e-9, 1e-3] {
        for z in [1.0, -1.0, 0.0, -0.0, 2.5] {
            near([x, -2.0 * x, z]);
        }
    }
}
