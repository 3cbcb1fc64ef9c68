//! The attribute macros of `dvi-core`: a small compiler from Lagrangians to integrators.
//!
//! A formula goes one way: `syntax` reads the attribute, `model` resolves its names, `lower` turns
//! expressions into a graph, `symbolic` simplifies and differentiates, `structure` sees what a system
//! allows, `program` says what each generated function computes, `select` and `schedule` choose shared
//! products and loops, which make a `routine`, `validate` holds every routine against the formulas as
//! written, and `emit` and `implement` write Rust. `expand` tells that story on one screen for each
//! attribute. Mistakes of the user are found by the stages up to `structure`; a mistake of the compiler is
//! found by `validate`, or ends the expansion as an `internal` error.

mod emit;
mod errors;
mod expand;
#[cfg(test)]
mod fuzz_tests;
mod implement;
mod instructions;
mod internal;
mod lower;
mod model;
mod operations;
#[cfg(test)]
mod oracle_tests;
mod program;
mod routine;
mod schedule;
mod select;
mod structure;
mod symbolic;
mod syntax;
#[cfg(test)]
mod tests;
mod validate;

use proc_macro::TokenStream;

/// Declares a degenerate system, L(q, v, t) = α(q, t)·v − H(q, t), on the struct of its parameters.
///
/// | argument | meaning |
/// |---|---|
/// | `coordinates(x, y[N])` | single coordinates and arrays; a size is a literal, a const generic, a `usize` field, `field.len()`, or sums and multiples of these |
/// | `one_form = …` | α, linear in `d(x)`; or its components `[a, b]`, with `\|i\| …` for an array |
/// | `hamiltonian = …` | H |
/// | `lagrangian = …` | instead of these two: L, affine in the velocities `dot(x)` |
/// | `momenta(name = …)` | conserved quantities to watch |
/// | `functions(f = [f, df, d2f])` | functions of one number, each with its first two derivatives, as paths to `fn(T) -> T` generic over `dvi_core::Scalar` |
/// | `derive(Trait, …)` | what the state derives beside `Clone`, `Debug`, `PartialEq` and, without `Vec`s, `Copy`: `serde::Serialize` for instance, which does not know arrays of const-generic size |
/// | `crate = ::path` | where `dvi_core` is, if it was renamed |
///
/// Formulas are Rust expressions over the coordinates, the fields of the struct by name, `PI` and other
/// constants by their paths (`std::f64::consts::E`), and the time `t` (a coordinate or field of that name takes precedence): operators, methods
/// of `f64`, `erf` and `sinc`, `let` blocks, `if … else`, `as f64`; `name.field` and `self.name.field` are fields of
/// a field. Index sums are `sum(0..n, |j| …)`, `sum_pairs(0..n, |j, k| …)` over j < k and
/// `sum_ordered_pairs` over j ≠ k; the sign of the zero of a sum without terms is not defined. Indices are sums, differences and literal multiples of bound indices,
/// sizes and integers; `%` is the Euclidean remainder.
///
/// Numbers are real: `1/2*x` is 0.5·x, as on paper. In front of an `as` Rust would divide integers without
/// the remainder, so `(k / 2) as f64` is refused; `(k as f64) / 2.0` is the quotient. A constant of the user's and a
/// field of a field, whose types are not known, are taken for integers there.
///
/// The struct may be generic over the type of its parameters, `struct System<P = f64> { mu: P, charges: Vec<P> }`. It is then a
/// system wherever that type is a number or, for derivatives with respect to a parameter, a `dvi_core::Varied` dual number. A field of a
/// field has to be a number.
///
/// At the zeros of a root the rules of differentiation give 0/0. Where a limit exists, it is the derivative for powers of
/// a sum of squares that is written out with positive literal coefficients or runs over a whole array of coordinates, and
/// of `x.hypot(y)`: for the first derivatives of powers of the distance above 1, for the second above 2, of sums over an
/// array from 3 on. So those of `x.powf(1.5)` at 0 and of `(x*x + y*y).powf(1.5)` at the origin are 0. It is so for even
/// roots of even powers, third and higher powers of `cbrt`, and the first derivatives of `cos` and `cosh` of a distance.
/// In products of such powers with coordinates and smooth functions, and in sums of these, limits are looked for too;
/// where none is found the derivative is not a number, as it is where it does not exist, of `x.hypot(y)` at the origin for
/// instance. The derivative of `x.abs()` at 0 is taken to be 0, and its square to be 1; so is that of the root of an even power, a product of such sizes. A function of a
/// sum without terms is a constant where that sum stands directly under a root; of other functions that have no derivative
/// at 0, the derivative is not a number there. Sizes are taken to be at least 1 in all this.
///
/// Derivatives are as exact as the arithmetic of their terms. Where a part of one is beyond the range of the numbers,
/// a derivative can be no number or lose its digits although the formula has a value: `x.exp().atan()` at x = 800, or
/// `(x*a).hypot(y*a)/a` with a = 1e-170. The reciprocal of a sum with exponentials, as in Fermi's function
/// `1/(1 + x.exp())`, is taken to be constant where it is 0.
///
/// Stable Rust computes no array length from a const generic: in a state, an array of size `N + 1` is a
/// `Vec`, and the size of the system is known at run time only.
///
/// For a struct `System` the attribute implements `dvi_core::System`, `dvi_core::Lagrangian` and
/// `dvi_core::DegenerateLagrangian`, defines `SystemState` with the coordinates as fields, and continues
/// the documentation of the struct with its formulas.
///
/// # Errors
/// Each mistake is one error on the token at fault. Ω with a row that is empty for certain is a mistake;
/// another that is singular is an error where a run begins.
#[proc_macro_attribute]
pub fn degenerate_lagrangian(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand::degenerate_lagrangian(attribute.into(), item.into()).into()
}

/// Declares a regular system, L(q, v, t) with a regular mass matrix ∂²L/∂v∂v, on the struct of its
/// parameters.
///
/// | argument | meaning |
/// |---|---|
/// | `coordinates(x, y[N])` | single coordinates and arrays, as in [`macro@degenerate_lagrangian`] |
/// | `lagrangian = …` | L, with the velocities `dot(x)` |
/// | `momenta(name = …)` | conserved quantities to watch; velocities may stand in them |
/// | `functions(f = [f, df, d2f])` | functions of your own, as in [`macro@degenerate_lagrangian`] |
/// | `derive(Trait, …)` | what the state derives beside the usual traits |
/// | `crate = ::path` | where `dvi_core` is, if it was renamed |
///
/// Formulas are those of [`macro@degenerate_lagrangian`], without restriction on the velocities.
///
/// For a struct `System` the attribute implements `dvi_core::System`, `dvi_core::Lagrangian` and
/// `dvi_core::RegularLagrangian`, defines `SystemState` with the coordinates `x` and then the velocities
/// `dot_x` as fields, and continues the documentation of the struct with its formulas.
///
/// # Errors
/// Each mistake is one error on the token at fault. A mass matrix with an empty row is a mistake; another
/// that is singular is an error where a run begins.
#[proc_macro_attribute]
pub fn lagrangian(attribute: TokenStream, item: TokenStream) -> TokenStream {
    expand::lagrangian(attribute.into(), item.into()).into()
}
