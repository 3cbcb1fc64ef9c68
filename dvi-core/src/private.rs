//! What generated code calls. Not part of the interface.

pub use crate::name::{Argument, Axis, Factor};
pub use crate::scalar::comparison::Comparison;
pub use crate::scalar::number::Number;
pub use crate::scalar::pack::{
    Sums, Waiting, add_to, all, first_unturned, load, packs, parameters, past_unturned, whole, widest,
};
pub use crate::scalar::pairs::{are_many, halves};
pub use crate::scalar::spinor::{lift, lower};
pub use crate::space::room::FewInPlace;
pub use crate::system::kind::{Degenerate, Holonomic, Manifold, Nonholonomic, Regular, Unilateral};
pub use crate::system::packable::{Packable, Packing, Shared};
pub use crate::system::report::{CoordinateBlock, Entry, Formula, OperationCount};
pub use crate::system::stand_in::StandIn;

use crate::error::{IndexError, LengthError, OutsideError};
use crate::field::{self, Expansion};
use crate::scalar::norm::reported;
use crate::space::lines;
use crate::{Real, Scalar, System};

/// The Euclidean remainder of an index that rarely leaves 0..modulus by more than one turn.
#[inline]
pub fn wrap(index: i64, modulus: i64) -> usize {
    let turned = if index < 0 {
        index + modulus
    } else if index >= modulus {
        index - modulus
    } else {
        index
    };
    (if (0..modulus).contains(&turned) { turned } else { remainder(index, modulus) }) as usize
}

/// The Euclidean remainder, −1 where there is none.
pub fn remainder(index: i64, modulus: i64) -> i64 {
    index.checked_rem_euclid(modulus).unwrap_or(-1)
}

/// Σ max(0, first + step·k) for k from 0 to below `rows`: the members of a family with two indices that stand
/// before its row of that number.
#[inline]
pub fn members_before(first: i64, step: i64, rows: usize) -> usize {
    let rows = rows as i64;
    // Where the terms are not negative: from `begin` to below `end`.
    let (begin, end) = match step {
        0 if first < 0 => (0, 0),
        0 => (0, rows),
        ..0 => (0, rows.min(first.div_euclid(-step) + 1)),
        1.. => (0.max(-first.div_euclid(step)), rows),
    };
    let count = 0.max(end - begin);
    (count * first + step * (count * (begin + end - 1) / 2)) as usize
}

/// As many numbers as no memory holds more of.
const MOST_COORDINATES: usize = isize::MAX as usize / size_of::<f64>();

/// Checks that there may be as many coordinates as the sizes of `system` say.
///
/// # Errors
/// [`IndexError`] with the last index of the first array that memory ends before, as far as that is an
/// integer.
pub fn check_sizes<S: System>(system: &S) -> Result<(), IndexError> {
    let mut left = MOST_COORDINATES;
    for (block, declared) in S::REPORT.coordinates.iter().enumerate() {
        let len = system.block_len(block);
        left = left.checked_sub(len).ok_or_else(|| IndexError {
            array: declared.name,
            index: i64::try_from(len - 1).unwrap_or(i64::MAX),
            len: left,
        })?;
    }
    Ok(())
}

/// Checks one index.
///
/// # Errors
/// [`IndexError`] if it is not in 0..len.
pub fn check_index(array: &'static str, index: i128, len: usize) -> Result<(), IndexError> {
    check_indices(array, index, index + 1, len)
}

/// Checks the indices from `first` to the one before `past`.
///
/// # Errors
/// [`IndexError`] with the first of them that is not in 0..len.
pub fn check_indices(array: &'static str, first: i128, past: i128, len: usize) -> Result<(), IndexError> {
    let outside = if (0..len as i128).contains(&first) { len as i128 } else { first };
    if outside >= past {
        return Ok(());
    }
    let index = i64::try_from(outside).unwrap_or(if outside < 0 { i64::MIN } else { i64::MAX });
    Err(IndexError { array, index, len })
}

/// The first argument of a function that leaves its domain.
pub fn outside<const D: usize, T: Real>(
    arguments: &'static [Argument; D],
    domain: [(f64, f64); D],
    at: [T; D],
) -> Option<OutsideError> {
    let mut arguments = arguments.iter().zip(at).zip(domain);
    arguments.find_map(|((argument, value), (least, largest))| {
        let value = reported(value);
        let is_inside = least <= value && value <= largest;
        let bound = if value > largest { largest } else { least };
        (!is_inside).then_some(OutsideError { argument, value, bound })
    })
}

/// A function that is the same everywhere, in place of one that is not known.
pub fn constant<const D: usize, T: Scalar>() -> Expansion<D, T> {
    field::constant(1.0)
}

/// The argument to blame for an L that is not a number: the first that left its domain, if there is one, and
/// if the other parts of the formulas are not to blame. Where a formula chooses between two branches
/// (`has_choices`), the function may stand in the one that was not taken: then L is a number, or is none
/// with a constant in place of the function either.
pub fn to_blame<T: Real>(
    outside: Option<OutsideError>,
    [value, with_constants]: [T; 2],
    has_choices: bool,
) -> Option<OutsideError> {
    outside.filter(|_| !value.is_finite() && (!has_choices || with_constants.is_finite()))
}

/// Copies entries of a state, which have so many `components` each, to their places in a flat slice: all
/// first components stand before all second ones.
///
/// # Errors
/// [`LengthError`] if there are not as many as declared.
pub fn write<const D: usize, E: Copy, T>(
    array: &'static str,
    entries: &[E],
    expected: usize,
    at: &mut usize,
    flat: &mut [T],
    components: fn(E) -> [T; D],
) -> Result<(), LengthError> {
    let error = LengthError { array, row: None, expected, found: entries.len() };
    if entries.len() != expected {
        return Err(error);
    }
    let end = *at + D * expected;
    let places = flat.get_mut(*at..end).ok_or(error)?;
    for (i, &entry) in entries.iter().enumerate() {
        for (axis, component) in components(entry).into_iter().enumerate() {
            places[axis * expected + i] = component;
        }
    }
    *at = end;
    Ok(())
}

/// Copies the rows of an array with two indices to their places in a flat slice, one after the other: of so
/// many entries, so many in each.
///
/// # Errors
/// [`LengthError`] if there are not as many rows as declared, or not as many entries in one.
pub fn write_rows<T: Copy, R: AsRef<[T]>>(
    array: &'static str,
    rows: &[R],
    [all, length]: [usize; 2],
    at: &mut usize,
    flat: &mut [T],
) -> Result<(), LengthError> {
    // Of empty rows nobody knows how many there are to be.
    let (expected, found) = (all.checked_div(length).unwrap_or(rows.len()), rows.len());
    if expected != found {
        return Err(LengthError { array, row: None, expected, found });
    }
    let write_row = |(row, entries): (usize, &R)| {
        let written = write(array, entries.as_ref(), length, at, flat, |entry| [entry]);
        written.map_err(|error| LengthError { row: Some(row), ..error })
    };
    rows.iter().enumerate().try_for_each(write_row)
}

/// Moves on behind so many entries of a state, and gives each, of its components.
#[inline]
pub fn read<const D: usize, E, T: Copy>(
    len: usize,
    at: &mut usize,
    flat: &[T],
    entry: fn([T; D]) -> E,
) -> impl Fn(usize) -> E {
    let start = *at;
    *at += D * len;
    move |i| entry(core::array::from_fn(|axis| flat[start + axis * len + i]))
}

/// Moves on behind the rows of an array with two indices, of so many entries, so many in each, and gives
/// them.
pub fn rows<'f, T>(
    [all, length]: [usize; 2],
    at: &mut usize,
    flat: &'f [T],
) -> core::slice::ChunksExact<'f, T> {
    let start = *at;
    *at += all;
    lines(&flat[start..*at], length)
}

#[test]
fn members_are_counted_row_by_row() {
    for (first, step, rows) in
        (-7..7).flat_map(|a| (-3..4).flat_map(move |b| (0..9).map(move |n| (a, b, n))))
    {
        let expected: i64 = (0..rows).map(|row| (first + step * row).max(0)).sum();
        let found = members_before(first, step, rows as usize);
        assert_eq!(found, expected as usize, "{rows} rows of {first} + {step}k");
    }
}
