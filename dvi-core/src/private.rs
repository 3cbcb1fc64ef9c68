//! What generated code calls. Not part of the interface.

pub use crate::Number;
pub use crate::error::Argument;
pub use crate::system::stand_in::StandIn;

use crate::Real;
use crate::error::{IndexError, LengthError, OutsideError};
use crate::scalar::norm::reported;

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

/// Checks one index.
///
/// # Errors
/// [`IndexError`] if it is not in 0..len.
pub fn check_index(array: &'static str, index: i64, len: usize) -> Result<(), IndexError> {
    match usize::try_from(index) {
        Ok(position) if position < len => Ok(()),
        _ => Err(IndexError { array, index, len }),
    }
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

/// Copies a block of a state to its place in a flat slice.
///
/// # Errors
/// [`LengthError`] if the block does not have the declared length.
pub fn write_block<T: Copy>(
    array: &'static str,
    block: &[T],
    expected: usize,
    at: &mut usize,
    flat: &mut [T],
) -> Result<(), LengthError> {
    let error = LengthError { array, expected, found: block.len() };
    let place = flat.get_mut(*at..*at + block.len()).filter(|_| block.len() == expected).ok_or(error)?;
    place.copy_from_slice(block);
    *at += expected;
    Ok(())
}

/// Reads a block of known length.
#[inline]
pub fn read_array<T: Copy, const N: usize>(_len: usize, at: &mut usize, flat: &[T]) -> [T; N] {
    let start = *at;
    *at += N;
    core::array::from_fn(|i| flat[start + i])
}
