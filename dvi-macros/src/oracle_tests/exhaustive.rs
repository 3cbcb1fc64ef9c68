//! Every formula of a small grammar up to a certain size.
//!
//! The grammar has one array x, one single coordinate u, at most two sums, sums and products, squares,
//! and 1/(2 + ·²) as its one function:
//! ```text
//! F ::= u | x[i] (for each bound index i) | F + F | F * F | F² | 1/(2 + F²) | sum(0..N, |i| F)
//!       | sum_pairs(0..N, |i, j| F), which is two sums
//! ```
//! Of operands that may be exchanged one order is kept.

use super::formula::{Atom, Formula, Index, Loops};
use super::system::{Block, Dynamics, Gauge, Size, SizeKind, System};

/// The sums that a formula may still hold.
const SUMS: usize = 2;

/// All formulas with exactly `size` nodes and `sums` sums, inside of `level` bound indices.
fn formulas(size: usize, sums: usize, level: usize) -> Vec<Formula> {
    let mut found = Vec::new();
    if size == 1 && sums == 0 {
        found.push(Formula::Coordinate(1, None));
        found.extend((0..level).map(|bound| Formula::Coordinate(0, Some(Index::bound(bound)))));
    }
    if size < 2 {
        return found;
    }
    for of in formulas(size - 1, sums, level) {
        // (F²)² says nothing that F² does not.
        if !matches!(of, Formula::Power(..)) {
            found.push(of.clone().power(2));
        }
        let below = Formula::Number("2").plus(of.power(2));
        found.push(Formula::Number("1").over(below));
    }
    if sums > 0 {
        for body in formulas(size - 1, sums - 1, level + 1) {
            let upper = Index::atom(Atom::Size(0));
            found.push(Formula::Sum(Loops::Single, level, Index::literal(0), upper, Box::new(body)));
        }
    }
    if sums > 1 {
        for body in formulas(size - 1, sums - 2, level + 2) {
            let upper = Index::atom(Atom::Size(0));
            found.push(Formula::Sum(Loops::Pairs, level, Index::literal(0), upper, Box::new(body)));
        }
    }
    for left_size in 1..size - 1 {
        let right_size = size - 1 - left_size;
        for left_sums in 0..=sums {
            if (left_size, left_sums) > (right_size, sums - left_sums) {
                continue;
            }
            let left = formulas(left_size, left_sums, level);
            let right = formulas(right_size, sums - left_sums, level);
            let alike = (left_size, left_sums) == (right_size, sums - left_sums);
            for (place, a) in left.iter().enumerate() {
                let from = if alike { place } else { 0 };
                for b in &right[from..] {
                    found.push(a.clone().times(b.clone()));
                    found.push(a.clone().plus(b.clone()));
                }
            }
        }
    }
    found
}

/// All formulas of the grammar with one sum or two, and at most `largest` nodes.
pub(super) fn all(largest: usize) -> Vec<Formula> {
    let sizes = (1..=largest).flat_map(|size| (1..=SUMS).map(move |sums| (size, sums)));
    sizes.flat_map(|(size, sums)| formulas(size, sums, 0)).collect()
}

/// A size that is a literal for some systems and a const generic for others.
fn sizes(number: usize) -> Vec<Size> {
    let kind = if number.is_multiple_of(2) { SizeKind::Literal } else { SizeKind::Constant("N") };
    vec![Size { kind, value: 3 }]
}

fn over_all(term: Formula) -> Formula {
    Formula::Sum(Loops::Single, 0, Index::literal(0), Index::atom(Atom::Size(0)), Box::new(term))
}

/// A formula as the Hamiltonian of x, y and u, w.
pub(super) fn as_hamiltonian(number: usize, formula: Formula) -> System {
    let entry = || Some(Index::bound(0));
    let blocks = [("x", Some(0)), ("u", None), ("y", Some(0)), ("w", None)];
    let one_form = over_all(Formula::Coordinate(0, entry()).times(Formula::Velocity(2, entry())))
        .plus(Formula::Coordinate(1, None).times(Formula::Velocity(3, None)));
    let blocks = blocks.map(|(name, size)| Block::line(name, size)).into();
    System::of(sizes(number), blocks, Dynamics::OneForm(one_form, formula))
}

/// A formula as the gauge of a canonical system in x, y and u, w.
pub(super) fn as_gauge(number: usize, formula: Formula) -> System {
    let hamiltonian = Formula::Coordinate(1, None).times(Formula::Coordinate(3, None));
    System { gauge: Gauge::Formula(formula), ..as_hamiltonian(number, hamiltonian) }
}

/// A formula as a kinetic energy: of the velocities of x, and of u or its velocity.
pub(super) fn as_kinetic_energy(number: usize, formula: Formula) -> System {
    let moving = number.is_multiple_of(3);
    let squares = over_all(Formula::Velocity(0, Some(Index::bound(0))).power(2))
        .plus(Formula::Velocity(1, None).power(2));
    let dynamics = Dynamics::Regular(squares.plus(in_velocities(formula, moving)));
    System::of(sizes(number), vec![Block::line("x", Some(0)), Block::line("u", None)], dynamics)
}

fn in_velocities(mut formula: Formula, moving: bool) -> Formula {
    match formula {
        Formula::Coordinate(0, index) => return Formula::Velocity(0, index),
        Formula::Coordinate(block, index) if moving => return Formula::Velocity(block, index),
        _ => {}
    }
    for part in formula.parts_mut() {
        *part = in_velocities(part.clone(), moving);
    }
    formula
}
