//! The interpolant of a kernel between two cubes at their Chebyshev nodes, in products of the basis.

use alloc::vec::Vec;

use super::basis::{self, Basis};
use super::matrix::padded;
use super::packs::LANES;
use super::transfer::larger;
use crate::scalar::widest_if;

/// The coefficients of K(|u − v + 2t|²).
#[derive(Clone, Debug)]
pub(super) struct Interpolant {
    order: usize,
    size: usize,
    /// For all degrees below the order along each axis: where the function stands in the basis, if it does.
    places: Vec<usize>,
    coefficients: Vec<f64>,
    /// The largest |K| at the nodes.
    largest: f64,
}

impl Interpolant {
    pub(super) fn new<const D: usize>(basis: &Basis<D>, t: [i32; D], kernel: impl Fn(f64) -> f64) -> Self {
        let (order, size) = (basis.order, basis.len());
        let transform = Transform { order, axes: D, matrix: basis::coefficients(order) };
        let nodes = basis::nodes(order);
        let all = order.pow(D as u32);
        let coordinate = |place: usize, axis: usize| nodes[place / order.pow((D - 1 - axis) as u32) % order];
        let place = |degrees: &[usize; D]| degrees.iter().fold(0, |place, degree| place * order + degree);
        let functions: Vec<usize> = basis.degrees.iter().map(place).collect();
        let mut places = alloc::vec![usize::MAX; all];
        functions.iter().enumerate().for_each(|(function, place)| places[*place] = function);
        // First for each node of the target in the functions of the source, then these functions in those of
        // the target.
        let [mut values, mut room] = [alloc::vec![0.0; all * LANES], alloc::vec![0.0; all * LANES]];
        let mut half = alloc::vec![0.0; all * padded(size)];
        let mut largest = 0.0;
        for first in (0..all).step_by(LANES) {
            for (source, values) in values.chunks_exact_mut(LANES).enumerate() {
                for (target, value) in (first..all).zip(values) {
                    let square = |axis: usize| {
                        let steps = 2.0 * f64::from(t[axis]);
                        (coordinate(target, axis) - coordinate(source, axis) + steps).powi(2)
                    };
                    *value = kernel((0..D).map(square).sum());
                    largest = larger(largest, value.abs());
                }
            }
            transform.apply(&mut values, &mut room);
            for (function, place) in functions.iter().enumerate() {
                for (target, value) in (first..all).zip(&values[place * LANES..(place + 1) * LANES]) {
                    half[(function / LANES * all + target) * LANES + function % LANES] = *value;
                }
            }
        }
        let mut coefficients = alloc::vec![0.0; size * size];
        for (first, columns) in (0..size).step_by(LANES).zip(half.chunks_exact_mut(all * LANES)) {
            transform.apply(columns, &mut room);
            for (m, place) in functions.iter().enumerate() {
                for (n, value) in (first..size).zip(&columns[place * LANES..(place + 1) * LANES]) {
                    coefficients[m * size + n] = *value;
                }
            }
        }
        Self { order, size, places, coefficients, largest }
    }

    /// Where the function of these degrees stands.
    pub(super) fn place<const D: usize>(&self, degrees: [usize; D]) -> usize {
        self.places[degrees.iter().fold(0, |place, degree| place * self.order + degree)]
    }

    /// The largest |K|; no number if K is none somewhere.
    pub(super) fn size(&self) -> f64 {
        self.largest
    }

    /// The largest coefficient but that of the constant function.
    pub(super) fn varying(&self) -> f64 {
        self.coefficients[1..].iter().map(|entry| entry.abs()).fold(0.0, larger)
    }

    /// κ_{mn}
    pub(super) fn coefficient(&self, m: usize, n: usize) -> f64 {
        self.coefficients[m * self.size + n]
    }
}

/// From values at the nodes of a cube to coefficients, several functions at once: the same matrix along each
/// axis.
struct Transform {
    order: usize,
    axes: usize,
    matrix: Vec<f64>,
}

impl Transform {
    /// Replaces the values; `room` is as long.
    fn apply(&self, values: &mut [f64], room: &mut [f64]) {
        for axis in 0..self.axes {
            self.along(axis, values, room);
            values.copy_from_slice(room);
        }
    }

    fn along(&self, axis: usize, from: &[f64], to: &mut [f64]) {
        let Self { order, axes, matrix } = self;
        let inner = order.pow((axes - 1 - axis) as u32) * LANES;
        widest_if(
            true,
            #[cfg_attr(not(debug_assertions), inline(always))]
            || {
                to.fill(0.0);
                let blocks = from.chunks_exact(inner * order).zip(to.chunks_exact_mut(inner * order));
                for (from, to) in blocks {
                    for (row, to) in matrix.chunks_exact(*order).zip(to.chunks_exact_mut(inner)) {
                        for (factor, from) in row.iter().zip(from.chunks_exact(inner)) {
                            to.iter_mut().zip(from).for_each(|(to, from)| *to += factor * from);
                        }
                    }
                }
            },
        );
    }
}
