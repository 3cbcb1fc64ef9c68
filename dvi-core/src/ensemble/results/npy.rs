//! The head of a file of NumPy, in version 3 of the format, whose names are UTF-8.

use std::format;
use std::io;
use std::string::String;
use std::vec::Vec;

use super::columns::Column;

const MARK: &[u8] = b"\x93NUMPY\x03\x00";
/// The data begin at a multiple of this.
const ALIGNMENT: usize = 64;

/// What stands before the records.
pub(super) fn head(columns: &[Column], members: usize) -> io::Result<Vec<u8>> {
    let field = |column: &Column| column.kind.map(|kind| format!("('{}', '{kind}'), ", column.name));
    let fields: String = columns.iter().filter_map(field).collect();
    let mut text = format!("{{'descr': [{fields}], 'fortran_order': False, 'shape': ({members},), }}");
    let before = MARK.len() + size_of::<u32>();
    // A line end closes the padding.
    let len = (before + text.len() + 1).next_multiple_of(ALIGNMENT) - before;
    text.extend(core::iter::repeat_n(' ', len - text.len() - 1));
    text.push('\n');
    let len = u32::try_from(len).map_err(io::Error::other)?;
    Ok([MARK, &len.to_le_bytes(), text.as_bytes()].concat())
}
