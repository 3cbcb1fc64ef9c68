//! Systems without mistakes, to be mutated.

use proc_macro2::TokenStream;
use quote::quote;

use crate::syntax::Kind;

/// Attributes that are right, for mutation, each with its struct: degenerate, then regular.
pub(super) fn systems() -> Vec<(Kind, TokenStream, TokenStream)> {
    let degenerate =
        degenerate_systems().into_iter().map(|(attribute, item)| (Kind::Degenerate, attribute, item));
    let regular = regular_systems().into_iter().map(|(attribute, item)| (Kind::Regular, attribute, item));
    degenerate.chain(regular).collect()
}

fn regular_systems() -> Vec<(TokenStream, TokenStream)> {
    vec![
        (
            quote! {
                coordinates(x[N], r#type),
                lagrangian = sum(0..N, |j| gamma[j] / 2.0 * (dot(x[j]).powi(2) - x[j] * x[(j + 1) % N]))
                    + sum_pairs(0..N, |j, k| dot(x[j]) * dot(x[k]) / (x[j] - x[k]).hypot(1.0))
                    + (1.0 + dot(r#type).powi(2)).sqrt() * r#type + dot(r#type) * t,
                momenta(p = sum(0..N, |j| gamma[j] * dot(x[j])), other = dot(r#type)),
            },
            quote!(
                pub struct System<const N: usize> {
                    gamma: [f64; N],
                }
            ),
        ),
        (
            quote! {
                coordinates(r[N][3], q[2]),
                lagrangian = {
                    let gap = |i, j| r[i] - r[j];
                    sum(0..N, |i| dot(r[i]).norm_squared() / 2.0 + field.dot(r[i].cross(dot(r[i]))))
                        + sum_pairs(0..N, |i, j| 1.0 / gap(i, j).norm()) + dot(q).dot([q[1], -q[0]]) + dot(q).norm_squared()
                },
                force(r) = |i| if t > 1.0 { field } else { -drag[i] / 2.0 },
                dissipation = sum_pairs(0..N, |i, j| (dot(r[i]) - dot(r[j])).norm().powi(3)) + t * dot(q).norm_squared(),
                momenta(l = sum(0..N, |i| r[i].cross(dot(r[i])))[2]),
            },
            quote!(
                struct System<const N: usize> {
                    field: [f64; 3],
                    drag: Vec<[f64; 3]>,
                }
            ),
        ),
        (
            quote! {
                coordinates(q[N][m], p[2][N]),
                lagrangian = sum(0..N, |i| sum(0..m, |j| dot(q[i][j]).powi(2) - k[i][j] * q[(i + 1) % N][m - 1 - j].powi(4)))
                    + sum(0..2, |i| sum(0..N, |j| dot(p[i][j]).powi(2) / 2.0 + p[1 - i][j] * q[j][0])),
                force(q) = |i, j| k[i][j] - dot(q[i][j]),
                constraint(i in 0..N, j in 1..m) = q[i][j] - q[i][j - 1],
            },
            quote!(
                struct System<const N: usize> {
                    m: usize,
                    k: Vec<Vec<f64>>,
                }
            ),
        ),
        (
            quote! {
                coordinates(x, y[gamma.len()]),
                lagrangian = { let v = dot(x); v * v / 2.0 - f(x) }
                    + sum(0..gamma.len(), |j| if dot(y[j]) > 0.0 { dot(y[j]).powf(2.5) } else { f(dot(y[j])) }),
                functions(f = [f, df, d2f]),
                crate = ::other::path,
            },
            quote!(
                struct System<'a> {
                    gamma: &'a [f64],
                }
            ),
        ),
        (
            quote! {
                coordinates(x[n], y),
                lagrangian = sum(0..n, |j| dot(x[j]).powi(2)) / 2.0 + dot(y).powi(2),
                nonholonomic(i in 1..n) = dot(x[i]) * y.sin() - rods[i - 1] * dot(x[i - 1]) * t,
                nonholonomic(i in 0..n, j in i + 1..n) = dot(x[i]) - rods[i] * dot(x[j]),
                nonholonomic = [dot(y) - x[0], sum(0..n, |j| x[j] * dot(x[j])) / (1.0 + y * y)],
                nonholonomic = if y > 0.0 { y * dot(x[0]) } else { let z = dot(y) / 2.0; z - t },
            },
            quote!(
                struct System {
                    n: usize,
                    rods: Vec<f64>,
                }
            ),
        ),
        (
            quote! {
                coordinates(x[n], y),
                lagrangian = sum(0..n, |j| dot(x[j]).powi(2)) / 2.0 + dot(y).powi(2),
                force(y) = -v,
                constraint(i in 1..n) = gap(i, i - 1).powi(2) - rods[i - 1] * t,
                constraint = [y - x[0], sum(0..n, |j| x[j]) - sine],
                constraint = if y > 0.0 { y * x[0] } else { let z = y * y; z - t },
                let = {
                    let v = dot(y);
                    let gap = |j, k| x[j] - x[k];
                    let (sine, _) = y.sin_cos();
                },
            },
            quote!(
                struct System {
                    n: usize,
                    rods: Vec<f64>,
                }
            ),
        ),
    ]
}

fn degenerate_systems() -> Vec<(TokenStream, TokenStream)> {
    vec![
        (
            quote! {
                coordinates(x[N], y[N]),
                one_form = sum(0..N, |j| gamma[j] / 2.0 * (x[j] * d(y[j]) - y[j] * d(x[j]))),
                hamiltonian = sum_pairs(0..N, |j, k| gamma[j] * gamma[k]
                    * ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2)).ln()) / (4.0 * PI),
                momenta(impulse = sum(0..N, |j| gamma[j] * x[j]), other = x[0].hypot(y[0])),
            },
            quote!(
                pub struct System<const N: usize> {
                    gamma: [f64; N],
                }
            ),
        ),
        (
            quote! {
                coordinates(x[gamma.len()], y[gamma.len()], u, w),
                lagrangian = sum(0..gamma.len(), |j| gamma[j] * x[j] * dot(y[(j + 1) % gamma.len()]))
                    + u * dot(w) - if u < w && t > -1.0 { f(u) } else { let a = w.atan2(u); a.powf(2.5) / a },
                functions(f = [f, df, d2f]),
                crate = ::other::path,
            },
            quote!(
                struct System<'a> {
                    gamma: &'a [f64],
                }
            ),
        ),
        (
            quote! {
                coordinates(z[4]),
                one_form = [|i| sum(0..=3, |j| a[i][j] * z[j] * (i + 2 * j) as f64)],
                hamiltonian = sum_ordered_pairs(0..4, |j, k| z[j].powi(-3) * z[k - 0] * self.s),
            },
            quote!(
                pub(crate) struct System {
                    a: [[f64; 4]; 4],
                    s: f64,
                    n: usize,
                }
            ),
        ),
        (
            quote! {
                coordinates(x, y),
                one_form = y.ln() / (2.0 * x) * d(x) - x.ln() / (2.0 * y) * d(y),
                hamiltonian = { let b = Self::B * x; -b.sqrt() + y.mul_add(2.0, 1e-3) + f64::exp(x) },
            },
            quote!(
                struct System;
            ),
        ),
    ]
}
