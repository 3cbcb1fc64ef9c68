//! What becomes of the entries of a matrix.

/// What takes the entries of a matrix, to which generated second derivatives go one by one: a matrix of a
/// [`Space`](crate::Space), or a function of row, column and entry. An entry may come in several parts,
/// which a sink adds.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// // The only entry of ∂²L/∂q∂q, which is −cos(angle).
/// let (mut l_q, mut l_v, mut stiffness) = ([0.0], [0.0], 0.0);
/// let by_angle = dvi_core::Weights { qq: 1.0, qv: 0.0, vq: 0.0, vv: 0.0 };
/// let mut sink = |_row: usize, _column: usize, entry: f64| stiffness += entry;
/// Pendulum.linearize(&[0.5], &[2.0], 0.0, by_angle, &mut l_q, &mut l_v, &mut sink);
/// assert_eq!(stiffness, -0.5_f64.cos());
/// ```
pub trait Sink<T> {
    /// Adds `entry` to the entry in `row` and `column`, both counted from 0.
    fn add(&mut self, row: usize, column: usize, entry: T);
}

impl<T, F: FnMut(usize, usize, T)> Sink<T> for F {
    #[inline]
    fn add(&mut self, row: usize, column: usize, entry: T) {
        self(row, column, entry);
    }
}
