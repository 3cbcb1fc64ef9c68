//! How a matrix with a given pattern is stored: the way in which it is eliminated with the least work.

use alloc::vec::Vec;

use super::fronts::{self, Front};
use super::ordering::{Order, Pattern};

/// How a matrix is stored.
#[derive(Debug)]
pub(crate) enum Layout {
    /// All entries.
    Full,
    /// Those near the diagonal, in this order of the coordinates.
    Banded(Order),
    /// Those of the pattern, with the columns that each row has.
    Sparse(Vec<Vec<u32>>, Vec<Front>),
}

/// A multiplication costs that many times more in fronts, which are put together from others, than in a
/// band.
const ASSEMBLY: f64 = 1.5;

/// Bands of no more diagonals than this on either side are taken without a look at fronts.
const NARROW: usize = 32;

/// Matrices of no more rows than this are full if they are not banded.
const SMALL: usize = 64;

impl Layout {
    /// That of the least work for a pattern.
    pub(crate) fn of(mut pattern: Pattern) -> Self {
        let n = pattern.dimension();
        let banded = pattern.banded();
        if n <= SMALL || banded.as_ref().is_some_and(|order| order.bandwidth <= NARROW) {
            return banded.map_or(Self::Full, Self::Banded);
        }
        let size = n as f64;
        let of_band = |width: f64| 2.0 * size * width * width;
        let of_all = size * size * size / 3.0;
        let work = banded.as_ref().map_or(of_all, |order| of_band(order.bandwidth as f64));
        // No more than half of a full matrix.
        let fronts = pattern.rows().and_then(|rows| Some((Front::of(rows.clone(), n * n / 2)?, rows)));
        match (fronts, banded) {
            (Some((fronts, rows)), _) if ASSEMBLY * fronts.iter().map(Front::work).sum::<f64>() < work => {
                Self::Sparse(rows, fronts)
            }
            (_, Some(order)) => Self::Banded(order),
            (_, None) => Self::Full,
        }
    }

    /// How many numbers a matrix of this dimension takes.
    pub(crate) fn storage(&self, dimension: usize) -> usize {
        match self {
            Self::Full => dimension.saturating_mul(dimension),
            Self::Banded(order) => dimension * order.width(),
            Self::Sparse(rows, fronts) => fronts::storage(fronts) + rows.iter().map(Vec::len).sum::<usize>(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Layout, Pattern};

    fn of(n: usize, places: impl IntoIterator<Item = (usize, usize)>) -> Layout {
        let mut pattern = Pattern::new(n);
        places.into_iter().for_each(|(i, j)| pattern.add(i, j));
        Layout::of(pattern)
    }

    #[test]
    fn chains_are_banded_trees_and_wide_lattices_sparse_and_the_rest_full() {
        let n = 2001;
        let chain = of(n, (1..n).map(|i| (i, i - 1)));
        assert!(matches!(chain, Layout::Banded(_)) && chain.storage(n) == 4 * n);
        let tree = of(n, (1..n).map(|i| (i, (i - 1) / 2)));
        assert!(matches!(tree, Layout::Sparse(..)) && tree.storage(n) < 16 * n);
        let side = 120;
        let lattice = |side: usize| {
            let neighbours = |i: usize| [i + 1, i + side].map(move |j| (i, j));
            of(side * side, (0..side * side).flat_map(neighbours).filter(move |&(_, j)| j < side * side))
        };
        assert!(matches!(lattice(20), Layout::Banded(_)));
        assert!(matches!(lattice(side), Layout::Sparse(..)));
        // Each with the first, whose row may become the pivot of any column; and each with two far away.
        // Their fronts would take minutes to find.
        let n = 20_000;
        assert!(matches!(of(n, (1..n).map(|i| (i, 0))), Layout::Full));
        let far = (0..n).flat_map(|i| [(i, (3 * i + 7) % n), (i, (7 * i + 11) % n)]);
        assert!(!matches!(of(n, far), Layout::Sparse(..)));
        assert!(matches!(of(50, (0..50).flat_map(|i| (0..50).map(move |j| (i, j)))), Layout::Full));
        assert!(matches!(of(300, (0..300).flat_map(|i| (0..i).map(move |j| (i, j)))), Layout::Full));
    }
}
