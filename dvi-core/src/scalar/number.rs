//! The numbers that parameters of a formula are.

use crate::Scalar;

/// A number of Rust, or a reference to one.
#[diagnostic::on_unimplemented(
    message = "a parameter of a formula must be a number, `{Self}` is not",
    label = "not a number"
)]
pub trait Number: Copy + Sync {
    /// Its value.
    fn number(self) -> f64;
}

macro_rules! number {
    ($($type:ty),*) => {$(
        impl Number for $type {
            #[inline]
            fn number(self) -> f64 {
                self as f64
            }
        }
    )*};
}

number!(f64, f32, i8, i16, i32, i64, isize, u8, u16, u32, u64, usize);

#[diagnostic::do_not_recommend]
impl<N: Number> Number for &N {
    #[inline]
    fn number(self) -> f64 {
        (*self).number()
    }
}

/// What can be a parameter of a system that is computed in `T`: any [`Number`], which is a constant there,
/// and [`Varied<T>`](Varied), which is not.
///
/// A struct may be generic over the type of its parameters. Derivatives with respect to one then come from
/// dual numbers, as they do for a coordinate. Whether a step has converged is decided by its values.
/// Newton's method, which solves the steps of a run in dual numbers by default, therefore takes two
/// iterations more, which brings derivatives of up to third order where its matrix is exact: where no
/// frequency is read from the motion. A fixed point takes 64 more, which leave r⁶⁴ of an error of the
/// derivatives at a rate of convergence r.
///
/// ```
/// use dvi_core::prelude::*;
/// use dvi_core::{Parameter, Varied};
/// use num_dual::Dual64;
///
/// #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 - k * x * x / 2.0)]
/// struct Spring<P = f64> { k: P }
///
/// // x(t) = cos(√k t) at k = 1, and its derivative −t sin(√k t) / (2√k) in k, after a time of 1.
/// let spring = Spring { k: Varied(Dual64::from(1.0).derivative()) };
/// let start = SpringStateOf { x: Dual64::from(1.0), dot_x: Dual64::from(0.0) };
/// let h = Dual64::from(0.001);
/// let mut run = Integrator::new(&spring, Variational::trapezoid(), h, start)?;
/// run.take_steps(1000)?;
/// assert!((run.state().x.re - 1.0_f64.cos()).abs() < 1e-6);
/// assert!((run.state().x.eps + 1.0_f64.sin() / 2.0).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[diagnostic::on_unimplemented(
    message = "a parameter of a system that is computed in `{T}` is a number or `Varied<{T}>`, `{Self}` is \
        neither",
    label = "cannot be a parameter in `{T}`"
)]
pub trait Parameter<T>: Copy + Sync {
    /// Its value among the numbers that the system is computed in.
    fn value(self) -> T;
}

#[diagnostic::do_not_recommend]
impl<N: Number, T: Scalar> Parameter<T> for N {
    #[inline]
    fn value(self) -> T {
        T::lift(self.number())
    }
}

/// A parameter that is a number of the kind that the system is computed in: a dual number with a derivative,
/// or a pack of lanes with a value each.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Varied<T>(
    /// Its value.
    pub T,
);

impl<T: Scalar> Parameter<T> for Varied<T> {
    #[inline]
    fn value(self) -> T {
        self.0
    }
}
