//! The numbers of nodes that methods have coefficients for.

use super::{Galerkin, Gauss, OneStepGauss};

/// A method with as many nodes as it has coefficients for: [`Gauss`] has 1 to 8 stages, [`OneStepGauss`] 1
/// to 4, and [`Galerkin`] 3 to 9 nodes.
///
/// ```
/// use dvi_core::prelude::*;
///
/// /// The order of Gauss collocation, for any number of stages that there are coefficients for.
/// fn order<const S: usize>() -> usize
/// where
///     Gauss<S>: Tabulated,
/// {
///     Gauss::<S>::new().order()
/// }
/// assert_eq!([order::<1>(), order::<8>()], [2, 16]);
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` has no coefficients",
    label = "`Gauss` has 1 to 8 stages, `OneStepGauss` 1 to 4, and `Galerkin` 3 to 9 nodes"
)]
pub trait Tabulated {}

macro_rules! tabulated {
    ($($method:ident: $($nodes:literal)*;)*) => { $($(impl Tabulated for $method<$nodes> {})*)* };
}
tabulated! {
    Gauss: 1 2 3 4 5 6 7 8;
    OneStepGauss: 1 2 3 4;
    Galerkin: 3 4 5 6 7 8 9;
}
