//! Small things that are done with measured numbers.

use anyhow::{Context as _, Result};
use dvi_core::diagnostics::convergence_order;
use rayon::prelude::*;

/// The larger of two measured numbers; not a number if one of them is not, so that no bound holds for it.
pub fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || a > b { a } else { b }
}

/// The largest of some magnitudes.
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, larger)
}

/// The largest that `of` reads of all.
pub fn most<T>(all: &[T], of: impl Fn(&T) -> f64) -> f64 {
    largest(all.iter().map(of))
}

pub fn least(values: impl IntoIterator<Item = f64>) -> f64 {
    -values.into_iter().map(|value| -value).fold(f64::NEG_INFINITY, larger)
}

pub fn mean(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    values.sum::<f64>() / count
}

/// The largest difference of a number of one from the number of the other in the same place.
pub fn apart<'a>(one: impl IntoIterator<Item = &'a f64>, other: impl IntoIterator<Item = &'a f64>) -> f64 {
    largest(one.into_iter().zip(other).map(|(a, b)| (a - b).abs()))
}

pub fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// The largest distance of a point of one from the point of the other in the same place.
pub fn farthest(one: &[[f64; 2]], other: &[[f64; 2]]) -> f64 {
    largest(one.iter().zip(other).map(|(&a, &b)| distance(a, b)))
}

pub fn dot<const N: usize>(a: [f64; N], b: [f64; N]) -> f64 {
    a.into_iter().zip(b).map(|(a, b)| a * b).sum()
}

pub fn difference<const N: usize>(a: [f64; N], b: [f64; N]) -> [f64; N] {
    std::array::from_fn(|i| a[i] - b[i])
}

/// The sum of a vector and a multiple of another.
pub fn moved<const N: usize>(from: [f64; N], by: f64, along: [f64; N]) -> [f64; N] {
    std::array::from_fn(|i| from[i] + by * along[i])
}

pub fn length<const N: usize>(v: [f64; N]) -> f64 {
    dot(v, v).sqrt()
}

/// The order that errors show which belong to lengths of steps: see [`convergence_order`].
pub fn order(points: impl IntoIterator<Item = (f64, f64)>) -> Option<f64> {
    convergence_order(&points.into_iter().collect::<Vec<_>>())
}

/// What `make` makes of each of the cases, up to the first failure.
pub fn each<T, U, const N: usize>(cases: [T; N], make: impl FnMut(T) -> Result<U>) -> Result<[U; N]> {
    let made = cases.into_iter().map(make).collect::<Result<Vec<_>>>()?;
    made.try_into().ok().context("not as many results as cases")
}

/// The same, side by side on the threads that there are.
pub fn side_by_side<T: Send, U: Send, const N: usize>(
    cases: [T; N],
    make: impl Fn(T) -> Result<U> + Sync + Send,
) -> Result<[U; N]> {
    let made = cases.into_par_iter().with_max_len(1).map(make).collect::<Result<Vec<_>>>()?;
    made.try_into().ok().context("not as many results as cases")
}

/// What `make` makes of each of the cases, and the names and errors of those in which it fails.
pub fn attempts<T: Copy, U>(
    cases: impl IntoIterator<Item = T>,
    make: impl Fn(T) -> Result<U>,
    name: impl Fn(T) -> String,
) -> (Vec<U>, Vec<String>) {
    let (mut made, mut failures) = (Vec::new(), Vec::new());
    for case in cases {
        match make(case) {
            Ok(one) => made.push(one),
            Err(error) => failures.push(format!("{}: {error}.", name(case))),
        }
    }
    (made, failures)
}

/// The order that the errors of several cases show: `error` returns the length of the steps and the error.
pub fn order_of<T>(
    cases: impl IntoIterator<Item = T>,
    error: impl FnMut(T) -> Result<(f64, f64)>,
) -> Result<Option<f64>> {
    Ok(order(cases.into_iter().map(error).collect::<Result<Vec<_>>>()?))
}

/// A circle as a closed line.
pub fn circle([x, y]: [f64; 2], radius: f64) -> Vec<[f64; 2]> {
    let angles = (0..=200).map(|k| std::f64::consts::TAU * f64::from(k) / 200.0);
    angles.map(|angle| [x + radius * angle.cos(), y + radius * angle.sin()]).collect()
}

/// A polygon as a closed line.
pub fn closed(corners: &[[f64; 2]]) -> Vec<[f64; 2]> {
    corners.iter().chain(corners.first()).copied().collect()
}

/// The area of a polygon, by Gauss's formula.
pub fn area(polygon: &[[f64; 2]]) -> f64 {
    let next = polygon.iter().cycle().skip(1);
    polygon.iter().zip(next).map(|(a, b)| a[0] * b[1] - a[1] * b[0]).sum::<f64>() / 2.0
}
