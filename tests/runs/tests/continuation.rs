//! The solution of the equations of a step that is reached from a step of no length without a jump.

use nalgebra::{DMatrix, DVector};

/// The unknowns of a step of length h, from those of no length on, in so many pieces, by Newton's method with
/// residuals and matrix at a length; `None` where solutions meet on the way. Of the unknowns the first
/// `known` are to converge.
pub(crate) fn continued(
    (h, pieces, known): (f64, u32, usize),
    mut unknowns: DVector<f64>,
    equations: impl Fn(f64, &DVector<f64>) -> (DVector<f64>, DMatrix<f64>),
) -> Option<DVector<f64>> {
    let mut first = 0.0;
    for piece in 0..=pieces {
        let mut change = f64::INFINITY;
        for _ in 0..30 {
            let (residual, matrix) = equations(h * f64::from(piece) / f64::from(pieces), &unknowns);
            let factors = matrix.lu();
            let determinant = factors.determinant();
            if piece == 0 {
                first = determinant;
            }
            if determinant / first < 1e-3 {
                return None;
            }
            let correction = factors.solve(&residual)?;
            unknowns -= &correction;
            change = correction.rows(0, known).amax() / (1.0 + unknowns.rows(0, known).amax());
            if change < 1e-14 {
                break;
            }
        }
        if change > 1e-9 {
            return None;
        }
    }
    Some(unknowns)
}
