//! The numbers that formulas are evaluated on.
//!
//! Generated code asks for [`Scalar`] and nothing more: ring operations, elementary functions, and a
//! branch-free choice. Every real field of nalgebra that is `Copy` is a scalar (`f64`, `f32`, dual
//! numbers), and so is a pack of several ([`Lanes`]), because nothing here orders or tests a value.
//! The solvers, which must decide, ask for [`Real`].

pub(crate) mod comparison;
mod error_function;
pub(crate) mod lanes;
pub(crate) mod norm;
pub(crate) mod number;
pub(crate) mod pack;
pub(crate) mod pairs;
pub(crate) mod passes;
pub(crate) mod simd;
mod sinc;
pub(crate) mod spinor;

use core::fmt::Debug;
use core::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

use nalgebra::RealField;

pub(crate) use comparison::Comparison;
pub use lanes::Lanes;
pub use number::{Parameter, Varied};
pub use simd::widest_if;

macro_rules! scalar {
    ($($(#[$doc:meta])* $name:ident),* $(,)?) => {
        /// A number that a generated formula can be evaluated on.
        #[diagnostic::on_unimplemented(
            message = "a system is computed in real numbers, and `{Self}` is not a real number",
            label = "write a number with a point, as in `1.0`"
        )]
        pub trait Scalar:
            Copy
            + Debug
            + Add<Output = Self>
            + Sub<Output = Self>
            + Mul<Output = Self>
            + Div<Output = Self>
            + Neg<Output = Self>
            + AddAssign
            + SubAssign
            + Send
            + Sync
            + 'static
        {
            /// Several of them, which generated loops take at once.
            #[doc(hidden)]
            type Pack: pack::Pack<Self>;
            /// The constant `value`.
            fn lift(value: f64) -> Self;
            /// `then` where `a` compares to `b` as asked, `otherwise` elsewhere.
            fn choose(a: Self, comparison: Comparison, b: Self, then: Self, otherwise: Self) -> Self;
            /// A function of `self` that is constant between jumps, as an entry of a table is of the place
            /// where it is looked up: `of` the value, without derivatives.
            fn piecewise(self, of: impl Fn(f64) -> f64) -> Self;
            /// The angle of the point (`x`, `self`), in radians.
            fn atan2(self, x: Self) -> Self;
            /// √(`self`² + `y`²) without undue overflow.
            fn hypot(self, y: Self) -> Self;
            /// `self` raised to a real power.
            fn powf(self, exponent: Self) -> Self;
            /// `self` raised to an integer power.
            fn powi(self, exponent: i32) -> Self;
            /// −1, 0 or 1: the derivative of |`self`|, taken to be 0 at 0.
            #[inline]
            fn sign(self) -> Self {
                let (zero, one) = (Self::lift(0.0), Self::lift(1.0));
                let below = Self::choose(self, Comparison::Less, zero, -one, zero * self);
                Self::choose(self, Comparison::Greater, zero, one, below)
            }
            /// `self`/`root` for a `root` ≥ |`self`|, and 0 where `root` is 0: derivatives hold such a
            /// quotient where the term that it stands in has the limit 0.
            #[inline]
            fn over_root(self, root: Self) -> Self {
                let zero = Self::lift(0.0);
                Self::choose(root, Comparison::LessOrEqual, zero, zero * self, self / root)
            }
            /// `self`/(`self`² + `other`²) without undue overflow: derivatives of [`atan2`](Self::atan2) are
            /// made of it. The larger of the two is taken out of the squares (Smith 1962, algorithm 116).
            #[inline]
            fn over_squares(self, other: Self) -> Self {
                let (size, other_size) = (self.abs(), other.abs());
                let if_less =
                    |then, otherwise| Self::choose(size, Comparison::Less, other_size, then, otherwise);
                let (less, more) = (if_less(self, other), if_less(other, self));
                let quotient = less / more;
                if_less(quotient, Self::lift(1.0)) / (more + less * quotient)
            }
            /// The error function 2/√π ∫ e^(−s²) ds from 0 to `self`.
            fn erf(self) -> Self {
                crate::scalar::error_function::erf(self)
            }
            /// sin(`self`)/`self`, and 1 at 0.
            fn sinc(self) -> Self {
                crate::scalar::sinc::bessel::<0, Self>(self)
            }
            /// j₁(`self`)/`self` with the spherical Bessel function j₁: −1/`self` times the derivative of
            /// [`sinc`](Self::sinc).
            fn sinc1(self) -> Self {
                crate::scalar::sinc::bessel::<1, Self>(self)
            }
            /// j₂(`self`)/`self`²: −1/`self` times the derivative of [`sinc1`](Self::sinc1).
            fn sinc2(self) -> Self {
                crate::scalar::sinc::bessel::<2, Self>(self)
            }
            /// j₃(`self`)/`self`³: −1/`self` times the derivative of [`sinc2`](Self::sinc2).
            fn sinc3(self) -> Self {
                crate::scalar::sinc::bessel::<3, Self>(self)
            }
            $($(#[$doc])* fn $name(self) -> Self;)*
        }

        #[diagnostic::do_not_recommend]
        impl<T: RealField + Copy> Scalar for T {
            type Pack = Lanes<{ pack::CHUNK }, T>;
            #[inline]
            fn lift(value: f64) -> Self {
                nalgebra::convert(value)
            }
            #[inline]
            fn choose(a: Self, comparison: Comparison, b: Self, then: Self, otherwise: Self) -> Self {
                let holds = match comparison {
                    Comparison::Less => a < b,
                    Comparison::LessOrEqual => a <= b,
                    Comparison::Greater => a > b,
                    Comparison::GreaterOrEqual => a >= b,
                };
                if holds { then } else { otherwise }
            }
            #[inline]
            fn piecewise(self, of: impl Fn(f64) -> f64) -> Self {
                Self::lift(of(norm::reported(self)))
            }
            #[inline]
            fn atan2(self, x: Self) -> Self {
                RealField::atan2(self, x)
            }
            #[inline]
            fn hypot(self, y: Self) -> Self {
                nalgebra::ComplexField::hypot(self, y)
            }
            #[inline]
            fn powf(self, exponent: Self) -> Self {
                nalgebra::ComplexField::powf(self, exponent)
            }
            #[inline]
            fn powi(self, exponent: i32) -> Self {
                nalgebra::ComplexField::powi(self, exponent)
            }
            $(#[inline] fn $name(self) -> Self {
                nalgebra::ComplexField::$name(self)
            })*
        }
    };
}

scalar! {
    /// √self
    sqrt,
    /// ∛self
    cbrt,
    /// eˢᵉˡᶠ
    exp,
    /// 2ˢᵉˡᶠ
    exp2,
    /// eˢᵉˡᶠ − 1, accurate near zero.
    exp_m1,
    /// Natural logarithm.
    ln,
    /// ln(1 + self), accurate near zero.
    ln_1p,
    /// Logarithm to base 2.
    log2,
    /// Logarithm to base 10.
    log10,
    /// Sine of an angle in radians.
    sin,
    /// Cosine of an angle in radians.
    cos,
    /// Tangent of an angle in radians.
    tan,
    /// Arc sine, in radians.
    asin,
    /// Arc cosine, in radians.
    acos,
    /// Arc tangent, in radians.
    atan,
    /// Hyperbolic sine.
    sinh,
    /// Hyperbolic cosine.
    cosh,
    /// Hyperbolic tangent.
    tanh,
    /// Inverse hyperbolic sine.
    asinh,
    /// Inverse hyperbolic cosine.
    acosh,
    /// Inverse hyperbolic tangent.
    atanh,
    /// Absolute value.
    abs,
    /// 1 or −1, with the sign of `self`, which may be that of a zero.
    signum,
}

/// A scalar with an order: what the solvers need to decide whether they are done.
///
/// Implemented for every real field of nalgebra that is `Copy`.
#[diagnostic::on_unimplemented(
    message = "a system is computed in real numbers, and `{Self}` is not a real number",
    label = "write a number with a point, as in `1.0`"
)]
pub trait Real: Scalar + RealField + Copy {}

#[diagnostic::do_not_recommend]
impl<T: RealField + Copy> Real for T {}

/// Whether a number has parts that comparisons do not see, as the derivative of a dual number: it is larger
/// than its digits need.
pub(crate) fn carries_derivatives<T: Real>() -> bool {
    size_of::<T>() > if is_single::<T>() { size_of::<f32>() } else { size_of::<f64>() }
}

/// Whether the compiler sees that it does not: it is as large as its alignment, and not larger than `f64`.
pub(crate) const fn is_plain<T>() -> bool {
    size_of::<T>() == align_of::<T>() && size_of::<T>() <= size_of::<f64>()
}

/// The smallest number that has all digits: those below are multiples of one number.
pub(crate) fn smallest_normal<T: Real>() -> T {
    T::lift(if is_single::<T>() { f64::from(f32::MIN_POSITIVE) } else { f64::MIN_POSITIVE })
}

/// Whether it has the digits of `f32`.
fn is_single<T: Real>() -> bool {
    T::default_epsilon() > T::lift(1e-10)
}
