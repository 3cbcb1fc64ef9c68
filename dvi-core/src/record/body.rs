//! Bodies that move in a plane or in space, and how the names of columns tell them.

use std::collections::BTreeMap;
use std::format;
use std::string::String;
use std::vec::Vec;

use serde::Serialize;

use super::column::{Column, Quantity, Values};

/// A body.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub(super) struct Body {
    /// The name; empty if `x` and `y` have none in common.
    pub(super) name: String,
    /// The columns of its coordinates along the axes x, y and, in space, z.
    pub(super) position: Vec<String>,
    /// Whether it is drawn with a line from the origin, as the end of a unit vector is.
    pub(super) is_arm: bool,
}

/// The axis of a name, the rest of it, and the index in an array: `("x", "2", "[3]")` of `x2[3]`.
fn parts(name: &str) -> Vec<(usize, &str, &str)> {
    // A component of a vector: `r[3].x`.
    if let Some((vector, component)) = name.rsplit_once('.')
        && let Some(axis) = ["x", "y", "z"].iter().position(|axis| *axis == component)
    {
        return [(axis, vector, "")].into();
    }
    let (stem, index) = name.split_at(name.find('[').unwrap_or(name.len()));
    let axis = |letter: char| "xyz".find(letter.to_ascii_lowercase());
    let mut letters = stem.chars();
    let first = letters.next().and_then(axis).map(|axis| (axis, &stem[1..], index));
    // The last letter stands for an axis of a name of several letters only.
    let last = letters.next_back().and_then(axis).map(|axis| (axis, &stem[..stem.len() - 1], index));
    first.into_iter().chain(last).collect()
}

/// The bodies that names tell, in the order of their first columns, and the `turning` ones; none if rows are
/// not states one after the other.
pub(super) fn told(columns: &[Column], turning: &[Body]) -> Vec<Body> {
    if columns.iter().all(|column| column.quantity != Quantity::Time) {
        return Vec::new();
    }
    let is_known = |name: &str| turning.iter().any(|body| body.position.iter().any(|known| known == name));
    let mut found: BTreeMap<(&str, &str), [Option<usize>; 3]> = BTreeMap::new();
    for (place, column) in columns.iter().enumerate() {
        let is_position = matches!(column.quantity, Quantity::Coordinate | Quantity::Other);
        if !is_position || !matches!(column.values, Values::Numbers(_)) || is_known(&column.name) {
            continue;
        }
        for (axis, rest, index) in parts(&column.name) {
            found.entry((rest, index)).or_default()[axis].get_or_insert(place);
        }
    }
    let body = |((rest, index), places): ((&str, &str), [Option<usize>; 3])| {
        let [Some(x), Some(y), z] = places else { return None };
        let name = format!("{}{index}", rest.trim_matches('_'));
        let position = [Some(x), Some(y), z].into_iter().flatten();
        let position = position.map(|place| columns[place].name.clone()).collect();
        Some((x, Body { name, position, is_arm: false }))
    };
    let mut bodies: Vec<(usize, Body)> = found.into_iter().filter_map(body).collect();
    bodies.sort_by_key(|&(first, _)| first);
    bodies.into_iter().map(|(_, body)| body).chain(turning.iter().cloned()).collect()
}
