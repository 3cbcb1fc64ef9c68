//! Functions of several variables that hold data: what a formula calls as `psi(r, z)`.
//!
//! A measured or computed field is known on a grid, and no formula says what it is. A struct has such a
//! function as one of its fields, of a type that implements [`ScalarField`], and its formulas call the field
//! by its name. The attribute differentiates through the call by the chain rule.
//!
//! With the feature `alloc` there is one: a [`Spline`] through the values of a table on a grid, which has one
//! [`Axis`] for each variable.
//!
//! ```
//! use dvi_core::field::{Axis, Expansion, ScalarField, Spline};
//!
//! let height = Axis::new(&[0.0, 10.0, 20.0, 30.0, 50.0])?;
//! let speed = Spline::new([height], &[0.0, 3.0, 4.0, 4.5, 5.0])?;
//!
//! let there: Expansion<1> = speed.expansion([20.0]);
//! assert!((there.value - 4.0).abs() < 1e-12 && there.gradient[0] > 0.0);
//! assert_eq!(speed.domain(), [(0.0, 50.0)]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#[cfg(feature = "alloc")]
mod axis;
#[cfg(feature = "alloc")]
mod basis;
#[cfg(feature = "alloc")]
mod interpolation;
#[cfg(feature = "alloc")]
mod spline;
#[cfg(feature = "alloc")]
mod table;

#[cfg(feature = "alloc")]
pub use axis::Axis;
#[cfg(feature = "alloc")]
pub use spline::Spline;
#[cfg(feature = "alloc")]
pub use table::SplineError;

use crate::Scalar;

/// The expansion of a function of `D` variables about a point, up to the second order.
///
/// ```
/// use dvi_core::field::Expansion;
///
/// // x² y at (3, 2).
/// let here = Expansion { value: 18.0, gradient: [12.0, 9.0], hessian: [[4.0, 6.0], [6.0, 0.0]] };
/// // A hundredth further along x: f + ∂f/∂x δ + ½ ∂²f/∂x² δ².
/// let there: f64 = here.value + here.gradient[0] * 0.01 + here.hessian[0][0] * 0.01 * 0.01 / 2.0;
/// assert!((there - 3.01 * 3.01 * 2.0).abs() < 1e-14);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Expansion<const D: usize, T = f64> {
    /// f.
    pub value: T,
    /// ∂f/∂xⁱ.
    pub gradient: [T; D],
    /// ∂²f/∂xⁱ∂xʲ, both halves of the symmetric matrix.
    pub hessian: [[T; D]; D],
}

/// The expansion of a function that is the same everywhere.
pub(crate) fn constant<const D: usize, T: Scalar>(value: f64) -> Expansion<D, T> {
    let zero = T::lift(0.0);
    Expansion { value: T::lift(value), gradient: [zero; D], hessian: [[zero; D]; D] }
}

/// A function of `D` variables that has two continuous derivatives and may hold data.
///
/// One evaluation gives the value with all derivatives, so that terms of a formula that need several of them
/// at the same point share the work. The integrators rely on the derivatives being those of the value: the
/// energy of a run drifts where they are not.
///
/// ```
/// use dvi_core::field::{Expansion, ScalarField};
/// use dvi_core::Scalar;
///
/// /// f(x, y) = k x y²
/// struct Product { k: f64 }
///
/// impl ScalarField<2> for Product {
///     fn expansion<T: Scalar>(&self, [x, y]: [T; 2]) -> Expansion<2, T> {
///         let (k, two) = (T::lift(self.k), T::lift(2.0));
///         let mixed = two * k * y;
///         Expansion {
///             value: k * x * y * y,
///             gradient: [k * y * y, mixed * x],
///             hessian: [[T::lift(0.0), mixed], [mixed, two * k * x]],
///         }
///     }
/// }
///
/// assert_eq!(Product { k: 0.5 }.expansion([3.0, 2.0]).gradient, [2.0, 6.0]);
/// ```
#[diagnostic::on_unimplemented(
    message = "a formula cannot call `{Self}` as a function of so many numbers: it does not implement \
               `ScalarField<{D}>`",
    label = "does not implement `ScalarField<{D}>`",
    note = "`dvi_core::field::ScalarField` says what such a function is"
)]
pub trait ScalarField<const D: usize> {
    /// The value and the derivatives at `at`. Outside of the [domain](Self::domain) the value is not a
    /// number.
    fn expansion<T: Scalar>(&self, at: [T; D]) -> Expansion<D, T>;

    /// The least and the largest value of each variable at which the function is known. A variable without
    /// an end, or one in which the function is periodic, is known from −∞ to ∞, and so is each by default.
    fn domain(&self) -> [(f64, f64); D] {
        [(f64::NEG_INFINITY, f64::INFINITY); D]
    }
}

macro_rules! pointer {
    ($($pointer:ty),*) => {$(
        impl<const D: usize, F: ScalarField<D>> ScalarField<D> for $pointer {
            fn expansion<T: Scalar>(&self, at: [T; D]) -> Expansion<D, T> {
                (**self).expansion(at)
            }

            fn domain(&self) -> [(f64, f64); D] {
                (**self).domain()
            }
        }
    )*};
}

pointer!(&F);
#[cfg(feature = "alloc")]
pointer!(alloc::boxed::Box<F>, alloc::rc::Rc<F>, alloc::sync::Arc<F>);
