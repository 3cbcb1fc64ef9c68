//! Functions and pairs of names inside of a formula.

use dvi_core::prelude::*;

#[lagrangian(
    coordinates(x, y),
    lagrangian = {
        let gap = |a, b| (a * a + b * b).sqrt();
        dot(x).powi(2) + dot(y).powi(2) - gap(x)
    },
)]
struct TooFew;

#[lagrangian(
    coordinates(x, y),
    lagrangian = {
        let gap = |a, b| (a * a + b * b).sqrt();
        dot(x).powi(2) + dot(y).powi(2) - gap + gop(x, y)
    },
)]
struct NotCalled;

#[lagrangian(
    coordinates(x),
    lagrangian = {
        let series = |a| 1.0 + a * series(a);
        dot(x).powi(2) - series(x)
    },
)]
struct CallsItself;

#[lagrangian(
    coordinates(x[3]),
    lagrangian = {
        let entry = |k| x[k].powi(2);
        let square = |a| a * a;
        sum(0..3, |i| dot(x[i]).powi(2) - square(i)) - entry(1.5) - entry(x[0]) - entry(3)
    },
)]
struct NumbersAndIndices;

#[lagrangian(
    coordinates(x, y),
    lagrangian = {
        let energy = |(a, b)| a * a + b * b;
        let (sin, cos) = x;
        let (a, b) = (1.0, 2.0, 3.0);
        let (c, 2) = x.sin_cos();
        dot(x).powi(2) + dot(y).powi(2) - energy(x, y) - sin * cos * a * b * c
    },
)]
struct Patterns;

/// What is no place has no velocity, and a name of the formula is no size.
#[lagrangian(
    coordinates(x[n]),
    lagrangian = {
        let speed = |a| dot(a).powi(2);
        let last = |a| x[n - 1] * a;
        let n = 2.0;
        sum(0..n, |i| dot(x[i]).powi(2)) - speed(x[0]) - last(n)
    },
)]
struct Places {
    n: usize,
}

#[lagrangian(
    coordinates(x),
    lagrangian = {
        let twice = |a, a| a + a;
        let outer = |a| inner(a);
        let inner = |a| a;
        dot(x).powi(2) - twice(x, x) - outer(x) - inner(x)
    },
)]
struct Order;

/// What is no function has no arguments.
#[lagrangian(
    coordinates(x),
    lagrangian = {
        let a = x;
        let f = |b| b;
        dot(x).powi(2) - a(x) - t(x + 1.0) - PI(x) - k(0) - sum(0..3, |i| i(x)) - x.f()
    },
)]
struct Numbers {
    k: [f64; 3],
}

fn main() {}
