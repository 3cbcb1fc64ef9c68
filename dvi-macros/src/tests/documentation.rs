//! What the documentation of a struct is continued with.

use expect_test::{Expect, expect};
use proc_macro2::TokenStream;
use quote::quote;

use crate::expand::{degenerate_lagrangian, lagrangian};

/// Compares what stands below the user's own words, up to the sentences on structure.
fn check(expansion: TokenStream, expected: &Expect) {
    let file: syn::File = syn::parse2(expansion).expect("the expansion parses");
    let attributes = file.items.iter().find_map(|item| match item {
        syn::Item::Struct(item) => Some(&item.attrs),
        _ => None,
    });
    let text = attributes.expect("a struct").iter().find_map(|attribute| match &attribute.meta {
        syn::Meta::NameValue(doc) if doc.path.is_ident("doc") => match &doc.value {
            syn::Expr::Lit(syn::ExprLit { lit: syn::Lit::Str(text), .. }) => Some(text.value()),
            _ => None,
        },
        _ => None,
    });
    let text = text.expect("documentation");
    let formulas = text.split("\n- ").next().unwrap_or_default();
    expected.assert_eq(formulas);
}

/// Names of `let`s, functions and pairs of names stand once, and names that formulas share behind them.
#[test]
fn names_are_lines_of_their_own() {
    check(
        lagrangian(
            quote! {
                coordinates(x, y),
                lagrangian = {
                    let pull = |m, at| m / (x - at).hypot(y);
                    let kinetic: f64 = mass[0] * (dot(x).powi(2) + dot(y).powi(2)) / 2.0;
                    let height = (mass[0] + mass[1]) * length[0] * (1.0 - x.cos()) - 1e-3 * (x.abs() + PI).sqrt();
                    kinetic - k_r * height + pull(mass[1], -1.0) + pull(1.0, s) * c + push(x, 1.0)
                },
                force(x) = push(y, r),
                dissipation = gamma * dot(y).powi(2) / 2.0,
                momenta(angular_1 = dot(x) * dot(y).recip()),
                events(low = r - mass2.exp()),
                let = {
                    let (s, c) = y.sin_cos();
                    let r = f64::asinh(x).cbrt();
                    let push = |a, b| { let twice = 2.0 * a; twice * s + b };
                },
            },
            quote! { struct Shared { k_r: f64, mass: [f64; 2], length: [f64; 2], mass2: f64, gamma: f64 } },
        ),
        &expect![[r#"

            # Dynamics

            L(q, v, t), and what is declared with it:

            ```math
            \begin{aligned}
            L &= \mathit{kinetic} - k_{r} \, \mathit{height} + \mathit{pull}\left(\mathit{mass}_{1}, -1\right) + \mathit{pull}\left(1, s\right) \, c + \mathit{push}\left(x, 1\right) \\
            \mathit{pull}\left(m, \mathit{at}\right) &= \frac{m}{\sqrt{{\left(x - \mathit{at}\right)}^2 + {y}^2}} \\
            \mathit{kinetic} &= \frac{\mathit{mass}_{0} \, \left({\dot{x}}^{2} + {\dot{y}}^{2}\right)}{2} \\
            \mathit{height} &= \left(\mathit{mass}_{0} + \mathit{mass}_{1}\right) \, \mathit{length}_{0} \, \left(1 - \cos x\right) - 10^{-3} \, \sqrt{\left|x\right| + \pi} \\
            R &= \frac{\gamma \, {\dot{y}}^{2}}{2} \\
            F_{x} &= \mathit{push}\left(y, r\right) \\
            \text{angular\_1} &= \dot{x} \, \frac{1}{\dot{y}} \\
            \text{low} &= r - \mathrm{e}^{\mathit{mass2}} \\
            s &= \sin y \\
            c &= \cos y \\
            r &= \sqrt[3]{\operatorname{asinh} x} \\
            \mathit{twice} &= 2 \, a \\
            \mathit{push}\left(a, b\right) &= \mathit{twice} \, s + b
            \end{aligned}
            ```
        "#]],
    );
}

#[test]
fn vectors_are_bold_and_their_products_signs() {
    check(
        lagrangian(
            quote! {
                coordinates(r[N][3], q[3]),
                lagrangian = {
                    let gap = |i, j| r[i] - r[j];
                    let field = b - 2.0 * q;
                    sum(0..N, |i| m[i] / 2.0 * dot(r[i]).norm_squared() + field.dot(r[i].cross(dot(r[i]))))
                        + sum_pairs(0..N, |i, j| m[i] * m[j] / gap(i, j).norm()) + dot(q).dot([q[1], -q[0], drag[0][2]])
                        + dot(q).norm_squared()
                },
                force(r) = |i| -drag[i] - dot(r[i])[0] * b,
                force(q) = -q,
            },
            quote! { struct Bodies<const N: usize> { m: [f64; N], b: [f64; 3], drag: [[f64; 3]; N] } },
        ),
        &expect![[r#"

            # Dynamics

            L(q, v, t), and what is declared with it:

            ```math
            \begin{aligned}
            L &= \sum_{i = 0}^{N - 1} \left(\frac{m_{i}}{2} \, {\left|\dot{\mathbf{r}}_{i}\right|}^{2} + \mathbf{\mathit{field}} \cdot \left(\mathbf{r}_{i} \times \dot{\mathbf{r}}_{i}\right)\right) \\
            &\quad + \sum_{0 \le i < j \le N - 1} \frac{m_{i} \, m_{j}}{\left|\mathit{gap}\left(i, j\right)\right|} + \dot{\mathbf{q}} \cdot \left(q_{1}, -q_{0}, \mathit{drag}_{0,2}\right) + {\left|\dot{\mathbf{q}}\right|}^{2} \\
            \mathit{gap}\left(i, j\right) &= \mathbf{r}_{i} - \mathbf{r}_{j} \\
            \mathbf{\mathit{field}} &= \mathbf{b} - 2 \, \mathbf{q} \\
            F_{\mathbf{r}_{i}} &= -\mathbf{\mathit{drag}}_{i} - \dot{r}_{i,0} \, \mathbf{b} \\
            F_{\mathbf{q}} &= -\mathbf{q}
            \end{aligned}
            ```
        "#]],
    );
}

#[test]
fn rotations_have_indices_before_those_of_entries() {
    check(
        lagrangian(
            quote! {
                coordinates(R[N]: SO3, s: S2, Q: SO3, omega_0),
                lagrangian = sum(0..N, |i| omega(R[i])[0].powi(2) + omega(R[i]).norm_squared())
                    + dot(s).norm_squared() + omega(Q).norm_squared() + dot(omega_0).powi(2)
                    - R[0][2][1] * s[2] - s.dot(R[0].column(1)) - Q[2][1] * psi(omega_0, t),
                functions(psi = path),
            },
            quote! { struct Tops<const N: usize>; },
        ),
        &expect![[r#"

            # Dynamics

            L(q, v, t), and what is declared with it:

            ```math
            \begin{aligned}
            L &= \sum_{i = 0}^{N - 1} \left({\omega\left(R_{i}\right)_{0}}^{2} + {\left|\left(\omega\left(R_{i}\right)_{0}, \omega\left(R_{i}\right)_{1}, \omega\left(R_{i}\right)_{2}\right)\right|}^{2}\right) + {\left|\dot{\mathbf{s}}\right|}^{2} \\
            &\quad + {\left|\left(\omega\left(Q\right)_{0}, \omega\left(Q\right)_{1}, \omega\left(Q\right)_{2}\right)\right|}^{2} + {\dot{\omega}_{0}}^{2} - R_{0,2,1} \, s_{2} \\
            &\quad - \mathbf{s} \cdot \left(R_{0,0,1}, R_{0,1,1}, R_{0,2,1}\right) - Q_{2,1} \, \psi\left(\omega_{0}, t\right)
            \end{aligned}
            ```
        "#]],
    );
}

#[test]
fn choices_sums_and_families_have_their_signs() {
    check(
        lagrangian(
            quote! {
                coordinates(x[n], y[n]),
                lagrangian = sum(0..n, |i| (dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0
                    - if x[i] < 0.0 && t > 1.0 { k * x[i].abs() } else { x[(i + 1) % n].sin() })
                    - sum_ordered_pairs(0..n, |i, j| x[i] * y[j]) - product(0..n, |i| y[i]),
                impact = x[0].hypot(y[0]) - self.rod,
                impact(i in 0..n, j in i + 1..n) = (x[i] - x[j]).hypot(y[i] - y[j]) - 2.0 * rod,
            },
            quote! { struct Chain { n: usize, k: f64, rod: f64 } },
        ),
        &expect![[r#"

            # Dynamics

            L(q, v, t), and what is declared with it:

            ```math
            \begin{aligned}
            L &= \sum_{i = 0}^{n - 1} \left(\frac{{\dot{x}_{i}}^{2} + {\dot{y}_{i}}^{2}}{2} - \begin{cases} k \, \left|x_{i}\right| & \text{if } x_{i} < 0 \text{ and } t > 1 \\ \sin x_{\left(i + 1\right) \bmod n} & \text{otherwise} \end{cases}\right) \\
            &\quad - \sum_{0 \le i \ne j \le n - 1} x_{i} \, y_{j} - \prod_{i = 0}^{n - 1} y_{i} \\
            0 &\le \sqrt{{x_{0}}^2 + {y_{0}}^2} - \mathit{rod} \\
            0 &\le \sqrt{{\left(x_{i} - x_{j}\right)}^2 + {\left(y_{i} - y_{j}\right)}^2} - 2 \, \mathit{rod} \qquad \text{for } 0 \le i \le n - 1, \ i + 1 \le j \le n - 1
            \end{aligned}
            ```
        "#]],
    );
}

#[test]
fn one_forms_and_areas() {
    check(
        degenerate_lagrangian(
            quote! {
                coordinates(s[N]: S2, n: S2, x, y),
                one_form = sum(0..N, |i| gamma[i] * area(s[i])) - area(n) + x * d(y),
                hamiltonian = sum(0..N, |i| s[i].dot(n)) + n[2] + x.atan2(y),
            },
            quote! { struct Spins<const N: usize> { gamma: [f64; N] } },
        ),
        &expect![[r#"

            # Dynamics

            L(q, v, t) = α(q, t)·v − H(q, t), as it is declared:

            ```math
            \begin{aligned}
            \alpha &= \sum_{i = 0}^{N - 1} \gamma_{i} \, \operatorname{area}\left(\mathbf{s}_{i}\right) - \operatorname{area}\left(\mathbf{n}\right) + x \, \mathrm{d}y \\
            H &= \sum_{i = 0}^{N - 1} \mathbf{s}_{i} \cdot \mathbf{n} + n_{2} + \operatorname{atan2}\left(x, y\right)
            \end{aligned}
            ```
        "#]],
    );
}

#[test]
fn numbers_with_two_indices_have_both() {
    check(
        degenerate_lagrangian(
            quote! {
                coordinates(p[N][m], q[N][m]),
                one_form = [|i, j| 0.0, |i, j| p[i][j]],
                hamiltonian = sum(0..N, |i| sum(0..m, |j| p[i][j].powi(2) / 2.0 - q[(i + 1) % N][j].cos())),
                force(q) = |a, b| -p[a][b],
            },
            quote! { struct Rotors<const N: usize> { m: usize } },
        ),
        &expect![[r#"

            # Dynamics

            L(q, v, t) = α(q, t)·v − H(q, t), as it is declared:

            ```math
            \begin{aligned}
            \alpha_{p_{i,j}} &= 0 \\
            \alpha_{q_{i,j}} &= p_{i,j} \\
            H &= \sum_{i = 0}^{N - 1} \sum_{j = 0}^{m - 1} \left(\frac{{p_{i,j}}^{2}}{2} - \cos q_{\left(i + 1\right) \bmod N,j}\right) \\
            F_{q_{a,b}} &= -p_{a,b}
            \end{aligned}
            ```
        "#]],
    );
}
