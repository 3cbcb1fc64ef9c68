//! What the compiler writes, for a few canonical systems: one generated function each. That it is right is
//! held against the oracle; here it is read.

use expect_test::{Expect, expect};
use proc_macro2::TokenStream;
use quote::quote;
use syn::ImplItemFn;
use syn::visit::Visit;

use crate::expand::{degenerate_lagrangian, lagrangian};

mod documentation;
mod growth;
mod vectors;

/// All functions of an expansion, those inside of `const _` included.
#[derive(Default)]
struct Functions(Vec<ImplItemFn>);

impl<'ast> Visit<'ast> for Functions {
    fn visit_impl_item_fn(&mut self, function: &'ast ImplItemFn) {
        self.0.push(function.clone());
    }
}

/// The body of a generated function; its signature is that of the trait.
fn body(expansion: TokenStream, name: &str) -> String {
    let file: syn::File = syn::parse2(expansion).expect("the expansion parses");
    let mut functions = Functions::default();
    functions.visit_file(&file);
    let found = functions.0.iter().find(|function| function.sig.ident == name).expect("it is generated");
    let (ident, block) = (&found.sig.ident, &found.block);
    let file = syn::parse2(quote!(fn #ident() #block)).expect("a function");
    without_paths(&prettyplease::unparse(&file))
}

fn check(expansion: TokenStream, name: &str, expected: &Expect) {
    expected.assert_eq(&body(expansion, name));
}

/// What the paths of generated code lead to.
fn without_paths(code: &str) -> String {
    ["::dvi_core::", "::core::primitive::"]
        .iter()
        .fold(code.to_string(), |code, path| code.replace(path, ""))
        .replace("<T as Scalar>", "T")
}

/// The pairs of many bodies are cut into parts, which threads share, and those of a body are taken in packs,
/// with one division for each pair.
#[test]
fn pairs_are_cut_into_parts_and_taken_in_packs() {
    let vortices = degenerate_lagrangian(
        quote! {
            coordinates(x[N], y[N]),
            one_form    = sum(0..N, |j| gamma[j] / 2.0 * (x[j] * d(y[j]) - y[j] * d(x[j]))),
            hamiltonian = sum_pairs(0..N, |j, k| gamma[j] * gamma[k]
                              * ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2)).ln()) / (4.0 * PI),
        },
        quote! { struct PointVortices<const N: usize> { gamma: [f64; N] } },
    );
    let gradient = body(vortices, "hamiltonian_gradient");
    for (what, count) in
        [("widest::<", 1), ("are_many(N)", 1), ("halves(", 1), ("packs::<", 2), ("for ", 5), ("/", 4)]
    {
        assert_eq!(gradient.matches(what).count(), count, "{what} in {gradient}");
    }
}

/// Neighbours and run-time sizes are checked once, before the first step.
#[test]
fn check_of_indices() {
    check(
        degenerate_lagrangian(
            quote! {
                coordinates(q[k.len()], p[k.len()]),
                one_form    = sum(0..k.len(), |j| p[j] * d(q[j])),
                hamiltonian = sum(0..k.len(), |j| mass[j] * p[j] * p[j] - (q[(j + 1) % k.len()] - q[j]).cos()),
            },
            quote! { struct Chain<'a> { k: &'a [f64], mass: Vec<f64> } },
        ),
        "check",
        &expect![[r#"
            fn check() {
                __private::check_sizes(self)?;
                __private::check_indices(
                    "mass",
                    (0i128),
                    (0i128 + 1i128 * (self.k.len() as i128)),
                    self.mass.len(),
                )?;
                for __i0 in (0usize)..(self.k.len()) {
                    __private::check_index(
                        "q",
                        (0i128
                            + 1i128
                                * (__private::remainder(
                                    (1i64 + 1i64 * (__i0 as i64)),
                                    (0i64 + 1i64 * (self.k.len() as i64)),
                                ) as i128)),
                        self.k.len(),
                    )?;
                }
                ::core::result::Result::Ok(())
            }
        "#]],
    );
}

fn kepler() -> TokenStream {
    lagrangian(
        quote! {
            coordinates(x, y),
            lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 + mu / (x * x + y * y).sqrt(),
        },
        quote! { struct Kepler { mu: f64 } },
    )
}

#[test]
fn kepler_linearized() {
    check(
        kepler(),
        "linearize",
        &expect![[r#"
            fn linearize() {
                let (__q0, __rest) = q_.split_at(1usize);
                let (__q1, __rest) = __rest.split_at(1usize);
                let _ = __rest;
                let (__v0, __rest) = v_.split_at(1usize);
                let (__v1, __rest) = __rest.split_at(1usize);
                let _ = __rest;
                l_q_.fill(T::lift(-0.0));
                let (__l_q0, __rest) = l_q_.split_at_mut(1usize);
                let (__l_q1, __rest) = __rest.split_at_mut(1usize);
                let _ = __rest;
                l_v_.fill(T::lift(-0.0));
                let (__l_v0, __rest) = l_v_.split_at_mut(1usize);
                let (__l_v1, __rest) = __rest.split_at_mut(1usize);
                let _ = __rest;
                let __offset0: usize = 0usize;
                let __offset1: usize = 1usize;
                let __r0 = __q0[0usize];
                let __r2 = __r0 * __r0;
                let __r3 = __q1[0usize];
                let __r4 = __r3 * __r3;
                let __r7 = T::lift(1f64)
                    / (T::sqrt((__r2 + __r4)));
                let __r9 = __r7 * __r7;
                let __r11 = __r7
                    * (T::lift(
                        __private::Number::number(self.mu),
                    ) * __r9);
                let __r17 = T::lift(3f64) * __r9;
                let __r21 = w_.qq * __r11;
                let __r25 = ((__r0 * __r3) * __r17) * __r21;
                let __r26 = w_.vv;
                __l_q0[0usize] -= (__r0 * __r11);
                __l_v0[0usize] += __v0[0usize];
                __l_q1[0usize] -= (__r3 * __r11);
                __l_v1[0usize] += __v1[0usize];
                Sink::add(
                    sink_,
                    __offset0 + 0usize,
                    __offset0 + 0usize,
                    (((__r17 * __r2) - T::lift(1f64)) * __r21),
                );
                Sink::add(sink_, __offset0 + 0usize, __offset1 + 0usize, __r25);
                Sink::add(sink_, __offset1 + 0usize, __offset0 + 0usize, __r25);
                Sink::add(sink_, __offset0 + 0usize, __offset0 + 0usize, __r26);
                Sink::add(
                    sink_,
                    __offset1 + 0usize,
                    __offset1 + 0usize,
                    (((__r17 * __r4) - T::lift(1f64)) * __r21),
                );
                Sink::add(sink_, __offset1 + 0usize, __offset1 + 0usize, __r26);
            }
        "#]],
    );
}

#[test]
fn the_force_of_a_separable_system_reads_no_velocity() {
    assert!(!body(kepler(), "force").contains("v_"));
}

#[test]
fn one_loop_holds_all_of_the_energy() {
    let chain = lagrangian(
        quote! {
            coordinates(q[N]),
            lagrangian = sum(0..N, |j| mass[j] * dot(q[j]).powi(2) / 2.0 - (1.0 - (q[(j + 1) % N] - q[j]).cos())),
        },
        quote! { struct Chain<const N: usize> { mass: [f64; N] } },
    );
    assert_eq!(body(chain, "energy").matches("for ").count(), 1);
}

/// As many functions inside one another as a long chain of `let` makes; squares that underflow on the way
/// to a derivative of 10⁻¹²⁰; and powers of literals, and of each of two factors, that are no numbers.
#[test]
fn extreme_formulas_expand() {
    let nested = format!("x{}", ".sin()".repeat(100));
    let bindings: String = (1..60).map(|k| format!("let a{k} = (a{} * 1.1 + x).sin();", k - 1)).collect();
    let small = "x + 16.0.powf(50 - y).powi(-2)".to_string();
    let powers = "(x / 3.0).powi(700) + (x * y).powi(400) + (x / y).powi(1100)".to_string();
    for formula in [nested, format!("{{ let a0 = x + y; {bindings} a59 }}"), small, powers] {
        let arguments = format!("coordinates(x, y), one_form = x * d(y), hamiltonian = {formula}");
        let attribute: TokenStream = arguments.parse().expect("tokens");
        let expansion = degenerate_lagrangian(attribute, quote! { struct System; }).to_string();
        assert!(!expansion.contains("compile_error"), "{formula}");
    }
}
