//! Several mistakes: each gets its error, none hides another.

use dvi_core::prelude::*;

/// That a system with a mistake in it is taken for one that can be stepped.
fn stepped<S: DegenerateLagrangian>(system: S, state: S::State<f64>) {
    let _ = Integrator::new(&system, Sigma::midpoint(), 0.1, state);
}

#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = x * d(w) + a,
    hamiltonian = x.sine() + omga * y + x % y,
    momenta(p = x * d(x), q = unknown, r = x.powi(y)),
    symmetry = x,
)]
pub struct InEveryArgument {
    pub omega: f64,
}
const _: fn() = || stepped(InEveryArgument { omega: 1.0 }, InEveryArgumentState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = x * d(y),
    hamiltonian = {
        let a = first + x;
        let b = second.sqrt();
        if a == b { third } else { a * b }
    },
)]
pub struct InOneBlock;
const _: fn() = || stepped(InOneBlock, InOneBlockState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(
    coordinates(x[4], y[n], x[4], omega),
    one_form = sum(0..4, |j| x[j] * d(y[j])),
    hamiltonian = x[0],
    functions(f = [g]),
)]
pub struct InTheDeclarations {
    pub omega: f64,
}
const _: fn() =
    || stepped(InTheDeclarations { omega: 1.0 }, InTheDeclarationsState { x: [1.0; 4], y: [0.0; 4] });

#[degenerate_lagrangian(
    coordinates(x, y),
    one_form(x * d(y)),
    hamiltonian = x + ,
    momenta = p,
    momentum(p = x),
)]
pub struct InTheArguments;
const _: fn() = || stepped(InTheArguments, InTheArgumentsState { x: 1.0, y: 0.0 });

#[degenerate_lagrangian(coordinates(x, y, u, w), one_form = x * d(y), hamiltonian = nothing * x)]
pub struct SingularTwice;
const _: fn() = || stepped(SingularTwice, SingularTwiceState { x: 1.0, y: 0.0, u: 0.0, w: 0.0 });

fn main() {}
