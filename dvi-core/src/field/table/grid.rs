//! The grid that the rows of a table form.

use alloc::format;
use alloc::string::String;
use alloc::vec;
use alloc::vec::Vec;

use super::{Column, Table, TableError};

/// A table with one row for each point of a grid of `D` variables.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid<'a, const D: usize> {
    table: &'a Table,
    columns: [usize; D],
    points: [Vec<f64>; D],
    /// The rows in the order of the grid, the last axis that of neighbours.
    rows: Vec<usize>,
}

impl<'a, const D: usize> Grid<'a, D> {
    /// The grid with the coordinates in `columns`, counted from 0.
    pub(super) fn new(table: &'a Table, columns: [usize; D]) -> Result<Self, TableError> {
        let mut points = [const { Vec::new() }; D];
        // The place of each row on each axis.
        let mut places = vec![[0; D]; table.rows()];
        for axis in 0..D {
            let numbers = (0..table.rows()).map(|row| table.number(row, columns[axis]));
            let numbers = numbers.collect::<Result<Vec<f64>, TableError>>()?;
            monotone(table, columns[axis], &numbers)?;
            let sorted = &mut points[axis];
            sorted.clone_from(&numbers);
            sorted.sort_unstable_by(f64::total_cmp);
            // 0 and −0 are the same place.
            sorted.dedup();
            for (place, &number) in places.iter_mut().zip(&numbers) {
                place[axis] = sorted.partition_point(|&point| point < number);
            }
        }
        let mut rows: Vec<usize> = (0..table.rows()).collect();
        rows.sort_by_key(|&row| places[row]);
        let grid = Self { table, columns, points, rows };
        grid.check(&places)?;
        Ok(grid)
    }

    /// The points of each axis, in increasing order.
    pub fn points(&self) -> &[Vec<f64>; D] {
        &self.points
    }

    /// The numbers of a column at the points of the grid, the last axis that of neighbours: what
    /// [`Spline::new`] takes.
    ///
    /// [`Spline::new`]: crate::field::Spline::new
    ///
    /// # Errors
    /// [`TableError::NoName`], [`TableError::NoColumn`], [`TableError::SameName`], and
    /// [`TableError::NotFinite`].
    pub fn values<'b>(&self, column: impl Into<Column<'b>>) -> Result<Vec<f64>, TableError> {
        let column = self.table.find(column.into())?;
        self.rows.iter().map(|&row| self.table.number(row, column)).collect()
    }

    /// Whether each point stands in one row.
    fn check(&self, places: &[[usize; D]]) -> Result<(), TableError> {
        let doubled = |pair: &&[usize]| places[pair[0]] == places[pair[1]];
        // The first line of the table that repeats another.
        if let Some(pair) = self.rows.windows(2).filter(doubled).min_by_key(|pair| pair[1]) {
            return Err(TableError::Doubled {
                line: self.table.lines[pair[1]],
                column: self.columns.first().map_or(1, |column| column + 1),
                point: self.point(places[pair[1]]),
                first: self.table.lines[pair[0]],
            });
        }
        let points = self.points.iter().try_fold(1_usize, |points, axis| points.checked_mul(axis.len()));
        if points == Some(self.rows.len()) { Ok(()) } else { Err(self.missing(places)) }
    }

    /// The error of a grid without some of its points.
    fn missing(&self, places: &[[usize; D]]) -> TableError {
        let (mut axis, mut place, mut found, mut expected) = (0, 0, 1, 1.0);
        for i in 0..D {
            let mut counts = vec![0_usize; self.points[i].len()];
            places.iter().for_each(|place| counts[place[i]] += 1);
            let others = (0..D).filter(|&j| j != i).map(|j| self.points[j].len() as f64).product::<f64>();
            for (at, &count) in counts.iter().enumerate() {
                // Of the numbers on all axes, the one in the smallest part of its rows.
                if count as f64 * expected < found as f64 * others {
                    (axis, place, found, expected) = (i, at, count, others);
                }
            }
        }
        // The points with this number, in their order, each with the row that should have it.
        let mut point = [0; D];
        point[axis] = place;
        for &row in self.rows.iter().filter(|&&row| places[row][axis] == place) {
            if places[row] != point {
                break;
            }
            for i in (0..D).rev().filter(|&i| i != axis) {
                point[i] += 1;
                if point[i] < self.points[i].len() {
                    break;
                }
                point[i] = 0;
            }
        }
        let line = places.iter().position(|at| at[axis] == place).map_or(0, |row| self.table.lines[row]);
        TableError::Missing {
            line,
            column: self.columns[axis] + 1,
            number: self.coordinate(axis, place),
            found,
            expected: expected as usize,
            point: self.point(point),
        }
    }

    fn coordinate(&self, axis: usize, place: usize) -> String {
        format!("{} = {}", self.table.called(self.columns[axis]), self.points[axis][place])
    }

    fn point(&self, place: [usize; D]) -> String {
        let coordinates: Vec<String> = (0..D).map(|axis| self.coordinate(axis, place[axis])).collect();
        coordinates.join(", ")
    }
}

/// Whether the numbers of an axis increase, or decrease, in the order in which the rows bring new ones.
fn monotone(table: &Table, column: usize, numbers: &[f64]) -> Result<(), TableError> {
    let mut seen: Vec<f64> = Vec::new();
    for (row, &number) in numbers.iter().enumerate() {
        let increases = seen.get(1) > seen.first();
        let is_before = |point: &f64| if increases { *point < number } else { *point > number };
        let place = if seen.len() < 2 { seen.len() } else { seen.partition_point(is_before) };
        let is_known = seen.get(place) == Some(&number) || seen.last() == Some(&number);
        if is_known {
            continue;
        }
        if place < seen.len() {
            let (line, name) = (table.lines[row], table.called(column));
            return Err(TableError::NotMonotone { line, column: column + 1, name, number });
        }
        seen.push(number);
    }
    Ok(())
}
