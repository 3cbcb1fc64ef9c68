//! Functions of the user's own with another signature than `fn(T) -> T` for every scalar `T`.

use dvi_core::prelude::*;
use dvi_core::Scalar;

fn any<T: Scalar>(x: T) -> T {
    x.sin()
}

mod function_of_f64 {
    use super::*;
    fn f(x: f64) -> f64 {
        x.sin()
    }
    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form    = x * d(y),
        hamiltonian = f(x) + f(y) * f(x * y),
        functions(f = [f, any, any]),
    )]
    pub struct System;
}

mod function_of_two {
    use super::*;
    fn f<T: Scalar>(x: T, y: T) -> T {
        x * y
    }
    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form    = x * d(y),
        hamiltonian = f(x) + f(y),
        functions(f = [any, f, any]),
    )]
    pub struct System;
}

fn main() {}
