//! Vectors beside their components: the same functions, instruction for instruction.

use proc_macro2::TokenStream;
use quote::quote;
use syn::visit::Visit as _;

use super::Functions;
use crate::expand::{degenerate_lagrangian, lagrangian};
use crate::work::steps_of;

/// What has the names of the coordinates in it: the state, and the formulas as text.
const OF_STATES: [&str; 5] = ["write", "read", "refill", "fmt", "from"];

/// The generated functions of a system.
fn functions(expansion: &TokenStream) -> Vec<String> {
    let text = expansion.to_string();
    assert!(!text.contains("compile_error"), "{text}");
    let file: syn::File = syn::parse2(expansion.clone()).expect("the expansion parses");
    let mut functions = Functions::default();
    functions.visit_file(&file);
    let computing =
        functions.0.iter().filter(|function| OF_STATES.iter().all(|name| function.sig.ident != name));
    computing.map(|function| quote!(#function).to_string()).collect()
}

/// Compares two systems, of which the first is written in vectors, and the work of the compiler.
fn are_same(
    expand: fn(TokenStream, TokenStream) -> TokenStream,
    item: &TokenStream,
    [vectors, components]: [TokenStream; 2],
) {
    let [of_vectors, of_components] =
        [&vectors, &components].map(|attribute| functions(&expand(attribute.clone(), item.clone())));
    for (of_vectors, of_components) in of_vectors.iter().zip(&of_components) {
        assert!(of_vectors == of_components, "{of_vectors}\n\n{of_components}");
    }
    assert_eq!(of_vectors.len(), of_components.len());
    let [vectors, components] =
        [vectors, components].map(|attribute| steps_of(|| drop(expand(attribute, item.clone()))));
    assert!(10 * vectors <= 11 * components, "{vectors} and {components} steps of the compiler");
}

fn with_size() -> TokenStream {
    quote! { struct Bodies<const N: usize> { m: [f64; N] } }
}

#[test]
fn bodies_in_space() {
    are_same(
        lagrangian,
        &with_size(),
        [
            quote! {
                coordinates(r[N][3]),
                lagrangian = sum(0..N, |i| m[i] / 2.0 * dot(r[i]).norm_squared())
                    + sum_pairs(0..N, |i, j| m[i] * m[j] / (r[i] - r[j]).norm()),
                momenta(p = sum(0..N, |i| m[i] * dot(r[i]))[1]),
            },
            quote! {
                coordinates(x[N], y[N], z[N]),
                lagrangian = sum(0..N, |i| m[i] / 2.0 * (dot(x[i]).powi(2) + dot(y[i]).powi(2) + dot(z[i]).powi(2)))
                    + sum_pairs(0..N, |i, j| m[i] * m[j]
                        / ((x[i] - x[j]).powi(2) + (y[i] - y[j]).powi(2) + (z[i] - z[j]).powi(2)).sqrt()),
                momenta(p = sum(0..N, |i| m[i] * dot(y[i]))),
            },
        ],
    );
}

#[test]
fn vortices_in_the_plane() {
    are_same(
        degenerate_lagrangian,
        &with_size(),
        [
            quote! {
                coordinates(r[N][2]),
                one_form = sum(0..N, |j| m[j] / 2.0 * (r[j][0] * d(r[j][1]) - r[j][1] * d(r[j][0]))),
                hamiltonian = sum_pairs(0..N, |j, k| m[j] * m[k] * (r[j] - r[k]).norm_squared().ln()) / (4.0 * PI),
                momenta(angular = sum(0..N, |j| m[j] * r[j].norm_squared())),
            },
            quote! {
                coordinates(x[N], y[N]),
                one_form = sum(0..N, |j| m[j] / 2.0 * (x[j] * d(y[j]) - y[j] * d(x[j]))),
                hamiltonian = sum_pairs(0..N, |j, k| m[j] * m[k]
                    * ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2)).ln()) / (4.0 * PI),
                momenta(angular = sum(0..N, |j| m[j] * (x[j].powi(2) + y[j].powi(2)))),
            },
        ],
    );
}

/// With the sums over pairs that fast sums take.
#[test]
fn as_many_bodies_as_the_run_knows() {
    let item = quote! { struct Bodies { m: Vec<f64> } };
    are_same(
        lagrangian,
        &item,
        [
            quote! {
                coordinates(r[m.len()][3]),
                lagrangian = sum(0..m.len(), |i| m[i] / 2.0 * dot(r[i]).norm_squared())
                    + sum_pairs(0..m.len(), |i, j| m[i] * m[j] / ((r[i] - r[j]).norm_squared() + 0.01).sqrt()),
            },
            quote! {
                coordinates(x[m.len()], y[m.len()], z[m.len()]),
                lagrangian = sum(0..m.len(), |i| m[i] / 2.0
                        * (dot(x[i]).powi(2) + dot(y[i]).powi(2) + dot(z[i]).powi(2)))
                    + sum_pairs(0..m.len(), |i, j| m[i] * m[j]
                        / ((x[i] - x[j]).powi(2) + (y[i] - y[j]).powi(2) + (z[i] - z[j]).powi(2) + 0.01).sqrt()),
            },
        ],
    );
}
