//! What is known of a method before it meets a system.

/// The geometric structure that every step of a method preserves, up to rounding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum PreservedForm {
    /// None.
    Nothing,
    /// The form of the equations of motion where it is constant: dq ∧ dp for a regular system; Ω = −dα on Q
    /// for a degenerate one whose α is affine.
    OmegaIfAffine,
    /// Ω = −dα on Q, of a degenerate system.
    Omega,
    /// The discrete two-form ∂²L_d/∂q0∂q1 dq0 ∧ dq1 on Q×Q (Rowley & Marsden 2002, eq. 17).
    Discrete,
    /// dq ∧ dp on T*Q.
    Canonical,
    /// dq' ∧ dp, where q' differs from q by a term of second order in h that the method documents:
    /// its orbits are those of a symplectic map in other coordinates.
    Conjugate,
}

/// What is known of a method before it meets a system.
///
/// ```
/// use dvi_core::methods::PreservedForm;
/// use dvi_core::prelude::*;
///
/// let method = Composition::kahan_li_8(Variational::trapezoid());
/// assert_eq!((method.order(), method.is_symmetric()), (8, true));
/// assert_eq!(method.preserved_form(), PreservedForm::Canonical);
/// assert_eq!(RungeKutta::classical().preserved_form(), PreservedForm::Nothing);
/// ```
pub trait Scheme {
    /// The order of convergence on smooth systems whose Lagrangian does not depend on time. On others it is
    /// the same, unless the documentation of the method says otherwise.
    fn order(&self) -> usize;
    /// Whether a step with −h undoes a step with h.
    fn is_symmetric(&self) -> bool;
    /// What is preserved on systems without friction or drives and, with constraints, where these are
    /// holonomic. Constraints of the velocities leave no two-form to preserve, and a method does not know of
    /// them before it meets a system.
    fn preserved_form(&self) -> PreservedForm;
}

/// What is known of a method, from expressions of it, or of the method inside.
macro_rules! scheme {
    ([$($generics:tt)*] $Method:ty, as $inner:ident) => {
        $crate::methods::scheme! {
            [$($generics)*] $Method, |method|
            order: method.$inner.order(),
            is_symmetric: method.$inner.is_symmetric(),
            preserved_form: method.$inner.preserved_form(),
        }
    };
    (
        [$($generics:tt)*] $Method:ty, |$method:pat_param|
        $(#[$doc:meta])*
        order: $order:expr,
        is_symmetric: $is_symmetric:expr,
        preserved_form: $form:expr,
    ) => {
        impl<$($generics)*> $crate::methods::Scheme for $Method {
            $(#[$doc])*
            #[allow(unused_variables)]
            fn order(&self) -> usize {
                let $method = self;
                $order
            }
            #[allow(unused_variables)]
            fn is_symmetric(&self) -> bool {
                let $method = self;
                $is_symmetric
            }
            #[allow(unused_variables)]
            fn preserved_form(&self) -> $crate::methods::PreservedForm {
                let $method = self;
                $form
            }
        }
    };
}
pub(crate) use scheme;
