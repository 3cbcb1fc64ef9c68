//! Systems whose one-form is affine.

use crate::{DegenerateLagrangian, Scalar};

/// A system whose α is affine in q with constant coefficients. The attribute implements it where
/// [`AFFINE`](DegenerateLagrangian::AFFINE) holds.
#[diagnostic::on_unimplemented(
    message = "the one-form of `{Self}` is not affine in the coordinates",
    label = "Dα is not one constant matrix"
)]
pub trait AffineOneForm<T: Scalar = f64>: DegenerateLagrangian<T> {}
