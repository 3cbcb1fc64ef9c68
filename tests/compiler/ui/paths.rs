//! Paths that lead nowhere: the compiler says so, on the path.

use dvi_core::prelude::*;

/// That a system with a mistake in it is taken for one that can be stepped.
fn stepped<S: DegenerateLagrangian>(system: S, state: S::State<f64>) {
    let _ = Integrator::new(&system, Sigma::midpoint(), 0.1, state);
}

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = f(x), functions(f = [f, g, h]))]
pub struct FunctionDoesNotExist;
const _: fn() = || stepped(FunctionDoesNotExist, FunctionDoesNotExistState { x: 1.0, y: 0.0 });

fn main() {}
