//! Several numbers in the lanes of one: what is done to one is done to all.
//!
//! Each operation is one on an array, which the compiler turns into SIMD instructions where it finds them.
//! Results are those of the numbers one by one, bit for bit: no lane sees another, and nothing is
//! contracted.

use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use crate::scalar::{Comparison, norm};
use crate::{Real, Scalar};

/// A pack of `W` numbers, the lanes, on which formulas are evaluated at once.
///
/// Generated code takes it as it takes a number. Elementary functions other than roots are computed lane by
/// lane. There is no order of packs: what has to decide does so for each lane. Parameters that differ from
/// lane to lane are of type [`Varied<Lanes<W>>`](crate::Varied). Packs lie at multiples of 64 bytes, so that
/// none of eight numbers is loaded in two parts; those of fewer take as much room.
///
/// ```
/// use dvi_core::prelude::*;
/// use dvi_core::scalar::Lanes;
/// use dvi_core::{Lagrangian, Varied};
///
/// #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - k * x * x / 2.0)]
/// struct Spring<P = f64> { k: P }
///
/// // The energy of two springs in two states.
/// let springs = Spring { k: Varied(Lanes([1.0, 4.0])) };
/// let energy = springs.energy(&[Lanes([0.5, 1.0])], &[Lanes([1.0, 0.0])], Lanes([0.0; 2]));
/// assert_eq!(energy, Lanes([0.625, 2.0]));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(align(64))]
pub struct Lanes<const W: usize, T = f64>(
    /// The numbers.
    pub [T; W],
);

impl<const W: usize, T: Real> Lanes<W, T> {
    /// `value` in all lanes.
    #[inline]
    pub fn all(value: T) -> Self {
        Self([value; W])
    }

    /// The larger number in each lane, as [`norm::larger`].
    #[inline]
    pub(crate) fn larger(self, other: Self) -> Self {
        self.with(other, norm::larger)
    }

    /// The largest of the numbers, which are not negative: by halves, which do not wait for one another.
    #[inline]
    pub(crate) fn largest(self) -> T {
        let (Self(mut numbers), mut count) = (self, W);
        while count > 1 {
            let half = count.div_ceil(2);
            for lane in 0..count - half {
                numbers[lane] = norm::larger(numbers[lane], numbers[lane + half]);
            }
            count = half;
        }
        numbers[0]
    }

    // Loops, and no closures in functions of the library: these are not always inlined. Over the numbers, as
    // what stands behind fewer than eight would be copied with a pack.
    #[inline]
    fn each(self, f: impl Fn(T) -> T) -> Self {
        let Self(mut numbers) = self;
        for lane in 0..W {
            numbers[lane] = f(numbers[lane]);
        }
        Self(numbers)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn with(self, Self(others): Self, f: impl Fn(T, T) -> T) -> Self {
        let Self(mut numbers) = self;
        for lane in 0..W {
            numbers[lane] = f(numbers[lane], others[lane]);
        }
        Self(numbers)
    }
}

macro_rules! operators {
    ($($name:ident $function:ident),*) => {$(
        impl<const W: usize, T: Real> $name for Lanes<W, T> {
            type Output = Self;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn $function(self, other: Self) -> Self {
                self.with(other, $name::$function)
            }
        }
    )*};
}

operators!(Add add, Sub sub, Mul mul, Div div);

impl<const W: usize, T: Real> Neg for Lanes<W, T> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        self.each(Neg::neg)
    }
}

impl<const W: usize, T: Real> AddAssign for Lanes<W, T> {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<const W: usize, T: Real> SubAssign for Lanes<W, T> {
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

macro_rules! lane_by_lane {
    ($($function:ident),*) => {$(
        #[inline]
        fn $function(self) -> Self {
            self.each(Scalar::$function)
        }
    )*};
}

#[diagnostic::do_not_recommend]
impl<const W: usize, T: Real> Scalar for Lanes<W, T> {
    type Pack = Self;
    #[inline]
    fn lift(value: f64) -> Self {
        Self::all(T::lift(value))
    }
    #[inline]
    fn choose(a: Self, comparison: Comparison, b: Self, then: Self, otherwise: Self) -> Self {
        let mut chosen = then;
        for lane in 0..W {
            chosen.0[lane] = T::choose(a.0[lane], comparison, b.0[lane], then.0[lane], otherwise.0[lane]);
        }
        chosen
    }
    #[inline]
    fn piecewise(self, of: impl Fn(f64) -> f64) -> Self {
        self.each(|x| x.piecewise(&of))
    }
    #[inline]
    fn atan2(self, x: Self) -> Self {
        self.with(x, Scalar::atan2)
    }
    #[inline]
    fn hypot(self, y: Self) -> Self {
        self.with(y, Scalar::hypot)
    }
    #[inline]
    fn powf(self, exponent: Self) -> Self {
        self.with(exponent, Scalar::powf)
    }
    #[inline]
    fn powi(self, exponent: i32) -> Self {
        self.each(|x| Scalar::powi(x, exponent))
    }
    lane_by_lane!(
        sqrt, cbrt, exp, exp2, exp_m1, ln, ln_1p, log2, log10, sin, cos, tan, asin, acos, atan, sinh, cosh,
        tanh, asinh, acosh, atanh, abs, signum
    );
}

/// Sets `vector` to one lane of `packs`.
#[inline]
pub(crate) fn read_lane<const W: usize, T: Real>(lane: usize, packs: &[Lanes<W, T>], vector: &mut [T]) {
    for (number, pack) in vector.iter_mut().zip(packs) {
        *number = pack.0[lane];
    }
}

/// Sets one lane of `packs` to `vector`.
#[inline]
pub(crate) fn write_lane<const W: usize, T: Real>(lane: usize, vector: &[T], packs: &mut [Lanes<W, T>]) {
    for (pack, &number) in packs.iter_mut().zip(vector) {
        pack.0[lane] = number;
    }
}

#[cfg(test)]
mod tests {
    use super::Lanes;

    #[test]
    fn packs_lie_at_multiples_of_64_bytes() {
        assert_eq!((align_of::<Lanes<8>>(), size_of::<Lanes<8>>()), (64, 64));
        assert_eq!((align_of::<Lanes<3>>(), size_of::<Lanes<3>>()), (64, 64));
    }
}
