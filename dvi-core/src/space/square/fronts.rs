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

/// The fronts of a matrix, each after those whose rows it takes over.
#[derive(Clone, Debug, Default)]
pub(crate) struct Fronts {
    pub(super) fronts: Vec<Front>,
}

/// What is eliminated together, and where what belongs to it stands in lists that all fronts share.
#[derive(Clone, Debug, Default)]
pub(super) struct Front {
    /// First those that it eliminates.
    pub(super) columns: Vec<u32>,
    /// How many of its columns it eliminates.
    pub(super) pivots: usize,
    /// The rows of A that it begins with.
    pub(super) own: Vec<u32>,
    /// The fronts whose rows it takes over.
    children: Vec<u32>,
    /// Its rows, those that it takes over among them.
    pub(super) rows: Range<usize>,
    /// The numbers that solve with it.
    pub(super) factors: Range<usize>,
    /// The numbers of the rows that it hands on, which wait for the next front.
    pub(super) waiting: Range<usize>,
}

impl Front {
    pub(super) fn width(&self) -> usize {
        self.columns.len()
    }

    /// The columns of the rows that it hands on.
    pub(super) fn width_left(&self) -> usize {
        self.columns.len() - self.pivots
    }

    /// Which rows of A it hands on, in the list of all rows.
    pub(super) fn rows_left(&self) -> Range<usize> {
        self.rows.start + self.pivots..self.rows.end
    }

    /// How many multiplications its elimination takes at most.
    fn work(&self) -> f64 {
        let [rows, columns] = [self.rows.len(), self.width()].map(|size| size as f64);
        (0..self.pivots).map(|k| k as f64).map(|k| (rows - k) * (columns - k)).sum()
    }
}

impl Fronts {
    /// The fronts of the matrix whose rows have entries in these columns, if their factors have no more
    /// numbers than `most`, and if they are found soon: patterns that fill as they are eliminated take the
    /// cube of their size. Each row needs an entry on the diagonal.
    pub(super) fn new(rows: Vec<Vec<u32>>, most: usize) -> Option<Self> {
        let mut elimination = Elimination::new(rows);
        let mut numbers = 0;
        while let Some((_, column)) = elimination.next.pop_first() {
            numbers += elimination.eliminate(column);
            if numbers > most || elimination.takes_too_long() {
                return None;
            }
        }
        Some(elimination.in_order())
    }

    /// The fronts whose rows a front takes over.
    pub(super) fn children(&self, front: &Front) -> impl Iterator<Item = &Front> {
        front.children.iter().map(|&child| &self.fronts[child as usize])
    }

    /// How many rows all fronts have together.
    pub(super) fn rows(&self) -> usize {
        self.fronts.last().map_or(0, |front| front.rows.end)
    }

    /// How many numbers all fronts solve with.
    pub(super) fn factors(&self) -> usize {
        self.fronts.last().map_or(0, |front| front.factors.end)
    }

    /// How many numbers wait at most.
    pub(super) fn waiting(&self) -> usize {
        self.fronts.iter().map(|front| front.waiting.end).max().unwrap_or(0)
    }

    /// How many numbers the largest front has.
    pub(super) fn largest(&self) -> usize {
        self.fronts.iter().map(|front| front.rows.len() * front.width()).max().unwrap_or(0)
    }

    /// How many numbers are stored.
    pub(super) fn storage(&self) -> usize {
        self.factors() + self.waiting() + self.largest()
    }

    /// How many multiplications an elimination takes at most.
    pub(super) fn work(&self) -> f64 {
        self.fronts.iter().map(Front::work).sum()
    }

    /// Appends a front after those whose rows it takes over. `place` tells where each has got to.
    fn push(&mut self, mut front: Front, place: &[u32]) {
        front.children.iter_mut().for_each(|child| *child = place[*child as usize]);
        let [rows_before, factors_before] = [self.rows(), self.factors()];
        // Rows that wait are on top of those of fronts that this one does not take over.
        let top = self.fronts.last().map_or(0, |front| front.waiting.end);
        let waiting = self.children(&front).next().map_or(top, |child| child.waiting.start);
        let (rows, width, pivots) = (front.rows.len(), front.width(), front.pivots);
        front.rows = rows_before..rows_before + rows;
        front.factors = factors_before..factors_before + pivots * (width + rows - pivots);
        front.waiting = waiting..waiting + (rows - pivots) * (width - pivots);
        self.fronts.push(front);
    }
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
    /// In the order in which they were found, with as many rows.
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
        for column in 0..n as u32 {
            if elimination.takes_too_long() {
                break;
            }
            elimination.place(column);
        }
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

    /// Finds the degree of a column, and its place among the next.
    fn place(&mut self, column: u32) {
        let degree = self.reach(column).len() as u32;
        self.degree[column as usize] = degree;
        self.next.insert((degree, column));
    }

    /// Eliminates a column that has been taken from the next, and with it those that no other rows have
    /// entries in. Returns how many numbers it takes to solve with them.
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
        let numbers = pivots * (columns.len() + rows - pivots);
        self.fronts.push(Front { columns, pivots, own, children, rows: 0..rows, ..Front::default() });
        left.iter().for_each(|&other| self.sets_of[other as usize].push(set));
        self.sets.push(Rows { columns: left.clone(), count: rows - pivots });
        for other in left {
            if self.takes_too_long() {
                break;
            }
            self.place(other);
        }
        numbers
    }

    fn takes_too_long(&self) -> bool {
        self.looks > LOOKS * self.sets_of.len() as u64
    }

    /// The fronts, each after those whose rows it takes over, with nothing that waits between for another.
    fn in_order(mut self) -> Fronts {
        let found = &mut self.fronts;
        let mut is_child = vec![false; found.len()];
        for &child in found.iter().flat_map(|front| &front.children) {
            is_child[child as usize] = true;
        }
        let roots = (0..found.len()).rev().filter(|&front| !is_child[front]);
        // A front comes up before its children and after them.
        let mut to_do: Vec<(usize, bool)> = roots.map(|root| (root, false)).collect();
        let mut place = vec![0_u32; found.len()];
        let mut ordered = Fronts::default();
        while let Some((at, is_after)) = to_do.pop() {
            if is_after {
                place[at] = ordered.fronts.len() as u32;
                ordered.push(mem::take(&mut found[at]), &place);
            } else {
                to_do.push((at, true));
                to_do.extend(found[at].children.iter().rev().map(|&child| (child as usize, false)));
            }
        }
        ordered
    }
}
