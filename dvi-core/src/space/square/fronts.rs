//! Which columns of a sparse matrix are eliminated together, and with which rows.
//!
//! A column is eliminated from all rows that have an entry there. Whichever of them becomes the pivot, the
//! others then have entries in the columns of all: the rows of one *front*. A front ends with as many rows
//! fewer as it has eliminated columns, and the rows that are left go together to the front that eliminates
//! the next of their columns. As a front holds every row with an entry in its columns, pivots may be chosen
//! freely while the numbers are computed, and room for all of them is there from the beginning (George & Ng
//! 1985). The order is that of minimum degree: next comes a column whose rows reach the fewest columns.

use alloc::collections::BTreeSet;
use alloc::vec;
use alloc::vec::Vec;
use core::mem;
use core::ops::Range;

/// What is eliminated together, and where what belongs to it stands in lists that all fronts share.
#[derive(Clone, Debug)]
pub(crate) struct Front {
    /// First those that it eliminates.
    pub(super) columns: Vec<u32>,
    /// How many of its columns it eliminates.
    pub(super) pivots: usize,
    /// The rows of A that it begins with.
    pub(super) own: Vec<u32>,
    /// The fronts before it whose rows it takes over.
    pub(super) children: Vec<u32>,
    /// Its rows, those that it takes over among them; when it is eliminated, the pivots come first.
    pub(super) rows: Range<usize>,
    /// Its numbers, row by row.
    pub(super) numbers: Range<usize>,
}

impl Front {
    /// The fronts of the matrix whose rows have entries in these columns, if their factors have no more
    /// numbers than `most`, and if they are found soon: patterns that fill as they are eliminated take the
    /// cube of their size. Each row needs an entry on the diagonal.
    pub(super) fn of(rows: Vec<Vec<u32>>, most: usize) -> Option<Vec<Self>> {
        let (mut elimination, mut numbers) = (Elimination::new(rows), 0);
        while let Some((_, column)) = elimination.next.pop_first() {
            numbers += elimination.eliminate(column);
            if numbers > most || elimination.takes_too_long() {
                return None;
            }
        }
        Some(elimination.fronts)
    }

    pub(super) fn width(&self) -> usize {
        self.columns.len()
    }

    /// Which rows of A it hands on, in the list of all rows.
    pub(super) fn rows_left(&self) -> Range<usize> {
        self.rows.start + self.pivots..self.rows.end
    }

    /// How many multiplications its elimination takes at most.
    pub(super) fn work(&self) -> f64 {
        let [rows, columns] = [self.rows.len(), self.width()].map(|size| size as f64);
        (0..self.pivots).map(|k| k as f64).map(|k| (rows - k) * (columns - k)).sum()
    }
}

/// How many numbers all fronts have together.
pub(super) fn storage(fronts: &[Front]) -> usize {
    fronts.last().map_or(0, |front| front.numbers.end)
}

/// How many columns are looked at for each row, on average, in the search for fronts. A square lattice of 90
/// 000 rows takes some thousand.
const LOOKS: u64 = 4096;

/// A matrix whose columns are being eliminated.
struct Elimination {
    /// Sets of rows that have entries in the same columns: the rows of A one by one, then those that each
    /// front hands on.
    sets: Vec<Rows>,
    /// The sets that have entries in each column.
    sets_of: Vec<Vec<u32>>,
    /// Columns that are not yet eliminated, by their degree.
    next: BTreeSet<(u32, u32)>,
    degree: Vec<u32>,
    /// The last search that has seen a column.
    seen: Vec<u64>,
    searches: u64,
    looks: u64,
    /// Those that have been found.
    fronts: Vec<Front>,
}

/// Rows that have entries in the same columns.
struct Rows {
    /// Empty when they have gone to a front.
    columns: Vec<u32>,
    /// How many rows.
    count: usize,
}

impl Elimination {
    fn new(rows: Vec<Vec<u32>>) -> Self {
        let n = rows.len();
        let mut sets_of = vec![Vec::new(); n];
        let set = |(row, columns): (usize, Vec<u32>)| {
            columns.iter().for_each(|&column| sets_of[column as usize].push(row as u32));
            Rows { columns, count: 1 }
        };
        let sets = rows.into_iter().enumerate().map(set).collect();
        let mut elimination = Self {
            sets,
            sets_of,
            next: BTreeSet::new(),
            degree: vec![0; n],
            seen: vec![0; n],
            searches: 0,
            looks: 0,
            fronts: Vec::new(),
        };
        elimination.place_all(0..n as u32);
        elimination
    }

    /// The columns in which rows with an entry in `column` have entries.
    fn reach(&mut self, column: u32) -> Vec<u32> {
        self.searches += 1;
        let mut reach = Vec::new();
        for &set in &self.sets_of[column as usize] {
            self.looks += self.sets[set as usize].columns.len() as u64;
            for &other in &self.sets[set as usize].columns {
                if mem::replace(&mut self.seen[other as usize], self.searches) != self.searches {
                    reach.push(other);
                }
            }
        }
        reach
    }

    /// Finds the degrees of columns, and their places among the next, unless it takes too long.
    fn place_all(&mut self, columns: impl IntoIterator<Item = u32>) {
        for column in columns {
            if self.takes_too_long() {
                return;
            }
            let degree = self.reach(column).len() as u32;
            self.degree[column as usize] = degree;
            self.next.insert((degree, column));
        }
    }

    /// Eliminates a column that has been taken from the next, and with it those that no other rows have
    /// entries in. Returns how many numbers their factors have.
    fn eliminate(&mut self, column: u32) -> usize {
        let mut columns = self.reach(column);
        columns.sort_unstable();
        let (n, set) = (self.sets_of.len(), self.sets.len() as u32);
        let (mut rows, mut own, mut children) = (0, Vec::new(), Vec::new());
        for set in mem::take(&mut self.sets_of[column as usize]) {
            let Rows { columns, count } = &mut self.sets[set as usize];
            *columns = Vec::new();
            rows += *count;
            match (set as usize).checked_sub(n) {
                None => own.push(set),
                Some(child) => children.push(child as u32),
            }
        }
        let sets = &self.sets;
        for &other in &columns {
            self.next.remove(&(self.degree[other as usize], other));
            self.sets_of[other as usize].retain(|&set| !sets[set as usize].columns.is_empty());
        }
        let is_pivot = |other: &u32| self.sets_of[*other as usize].is_empty();
        let (mut columns, left): (Vec<u32>, Vec<u32>) = columns.into_iter().partition(is_pivot);
        let pivots = columns.len();
        columns.extend(&left);
        let factors = pivots * (columns.len() + rows - pivots);
        let [row, number] = self.fronts.last().map_or([0; 2], |front| [front.rows.end, front.numbers.end]);
        let numbers = number..number + rows * columns.len();
        self.fronts.push(Front { columns, pivots, own, children, rows: row..row + rows, numbers });
        left.iter().for_each(|&other| self.sets_of[other as usize].push(set));
        self.sets.push(Rows { columns: left.clone(), count: rows - pivots });
        self.place_all(left);
        factors
    }

    fn takes_too_long(&self) -> bool {
        self.looks > LOOKS * self.sets_of.len() as u64
    }
}
