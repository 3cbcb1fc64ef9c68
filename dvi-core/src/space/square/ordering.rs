//! The order of the coordinates in which the entries of a matrix lie near its diagonal: that of Cuthill &
//! McKee (1969), reversed (George 1971), unless the order of declaration is as good.

use alloc::vec;
use alloc::vec::Vec;

/// A matrix with more entries in a row than this, on average, counts as full.
const FULL: usize = 64;

/// Where a matrix has entries, transposed places included.
#[derive(Debug)]
pub(crate) struct Pattern {
    dimension: usize,
    /// Off the diagonal, both (i, j) and (j, i), some more than once.
    places: Vec<(u32, u32)>,
    is_full: bool,
}

/// Where each coordinate stands in a banded matrix, and how far from the diagonal its entries lie at most.
#[derive(Clone, Debug)]
pub(crate) struct Order {
    /// The place of each coordinate.
    pub(super) place: Vec<u32>,
    pub(super) bandwidth: usize,
}

impl Order {
    /// How many numbers are stored of a row: those of the band, and as many again as its half to the right.
    pub(super) fn width(&self) -> usize {
        3 * self.bandwidth + 1
    }
}

impl Pattern {
    pub(crate) fn new(dimension: usize) -> Self {
        let is_full = u32::try_from(dimension).is_err();
        Self { dimension, places: Vec::new(), is_full }
    }

    pub(crate) fn add(&mut self, row: usize, column: usize) {
        if row == column || self.is_full {
            return;
        }
        // The dimension fits.
        let (row, column) = (row as u32, column as u32);
        self.places.extend([(row, column), (column, row)]);
        if self.places.len() >= 2 * FULL * self.dimension {
            self.tidy();
        }
    }

    fn tidy(&mut self) {
        self.places.sort_unstable();
        self.places.dedup();
        self.is_full |= self.places.len() > FULL * self.dimension;
    }

    pub(super) fn dimension(&self) -> usize {
        self.dimension
    }

    /// The columns in which each row has entries, ascending, the diagonal among them, unless the matrix
    /// counts as full.
    pub(super) fn rows(&mut self) -> Option<Vec<Vec<u32>>> {
        self.tidy();
        if self.is_full {
            return None;
        }
        let mut rows: Vec<Vec<u32>> = (0..self.dimension as u32).map(|i| vec![i]).collect();
        self.places.iter().for_each(|&(i, j)| rows[i as usize].push(j));
        rows.iter_mut().for_each(|row| row.sort_unstable());
        Some(rows)
    }

    /// The order in which the matrix is banded, if that takes at most half of the storage of a full one.
    pub(super) fn banded(&mut self) -> Option<Order> {
        let rows = self.rows()?;
        let declared: Vec<u32> = (0..self.dimension as u32).collect();
        let [declared, found] = [declared, cuthill_mckee(&rows)].map(|place| {
            let distance = |&(i, j): &(u32, u32)| place[i as usize].abs_diff(place[j as usize]) as usize;
            let bandwidth = self.places.iter().map(distance).max().unwrap_or(0);
            Order { place, bandwidth }
        });
        let best = if found.bandwidth < declared.bandwidth { found } else { declared };
        (2 * best.width() <= self.dimension).then_some(best)
    }
}

/// The reversed order of Cuthill & McKee, of a matrix whose rows have entries in these columns: breadth
/// first from an end of each connected part, neighbours of few neighbours first.
fn cuthill_mckee(rows: &[Vec<u32>]) -> Vec<u32> {
    let n = rows.len();
    let mut visited = vec![false; n];
    let mut order: Vec<u32> = Vec::with_capacity(n);
    // Appends what is connected to `start`, and returns the last of it, which is as far away as any.
    let mut walk = |start: u32, order: &mut Vec<u32>| {
        let begin = order.len();
        let mut next = begin;
        order.push(start);
        visited[start as usize] = true;
        while let Some(&i) = order.get(next) {
            let first = order.len();
            for &j in &rows[i as usize] {
                if !visited[j as usize] {
                    visited[j as usize] = true;
                    order.push(j);
                }
            }
            order[first..].sort_by_key(|&j| rows[j as usize].len());
            next += 1;
        }
        order[begin..].iter().for_each(|&i| visited[i as usize] = false);
        order[order.len() - 1]
    };
    let mut placed = vec![false; n];
    for start in 0..n as u32 {
        if placed[start as usize] {
            continue;
        }
        let begin = order.len();
        let mut end = start;
        // From its far end, twice, is from about its outermost point.
        for _ in 0..2 {
            end = walk(end, &mut order);
            order.truncate(begin);
        }
        walk(end, &mut order);
        order[begin..].iter().for_each(|&i| placed[i as usize] = true);
    }
    let mut place = vec![0_u32; n];
    for (at, &i) in order.iter().rev().enumerate() {
        place[i as usize] = at as u32;
    }
    place
}
