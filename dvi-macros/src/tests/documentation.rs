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

#[test]
fn names_of_lets_are_kept() {
    check(
        lagrangian(
            quote! {
                coordinates(a, b),
                lagrangian = {
                    let first = length[0] * dot(a);
                    let second = length[1] * dot(b);
                    let kinetic = mass[0] * first.powi(2) / 2.0
                        + mass[1] * (first.powi(2) + second.powi(2)) / 2.0
                        + mass[1] * first * second * (a - b).cos();
                    let height = (mass[0] + mass[1]) * length[0] * (1.0 - a.cos())
                        + mass[1] * length[1] * (1.0 - b.cos());
                    kinetic - g * height
                },
            },
            quote! { struct DoublePendulum { mass: [f64; 2], length: [f64; 2], g: f64 } },
        ),
        &expect![[r#"

            # Dynamics

            L(q, v, t), and what is declared with it:

            ```math
            \begin{aligned}
            L &= \mathit{kinetic} - g \, \mathit{height} \\
            \mathit{first} &= \mathit{length}_{0} \, \dot{a} \\
            \mathit{second} &= \mathit{length}_{1} \, \dot{b} \\
            \mathit{kinetic} &= \frac{\mathit{mass}_{0} \, {\mathit{first}}^{2}}{2} + \frac{\mathit{mass}_{1} \, \left({\mathit{first}}^{2} + {\mathit{second}}^{2}\right)}{2} \\
            &\quad + \mathit{mass}_{1} \, \mathit{first} \, \mathit{second} \, \cos\left(a - b\right) \\
            \mathit{height} &= \left(\mathit{mass}_{0} + \mathit{mass}_{1}\right) \, \mathit{length}_{0} \, \left(1 - \cos a\right) + \mathit{mass}_{1} \, \mathit{length}_{1} \, \left(1 - \cos b\right)
            \end{aligned}
            ```

            The compiler makes of it:

            ```math
            \begin{aligned}
            \partial L / \partial a &= -\mathit{length}_{0} \, \left(\dot{a} \, \mathit{length}_{1} \, \dot{b} \, \mathit{mass}_{1} \, \sin\left(a - b\right) + \left(\mathit{mass}_{0} + \mathit{mass}_{1}\right) \, g \, \sin a\right) \\
            \partial L / \partial \dot{a} &= \mathit{length}_{0} \, \left(\mathit{length}_{0} \, \dot{a} \, \left(\mathit{mass}_{0} + \mathit{mass}_{1}\right) + \mathit{length}_{1} \, \dot{b} \, \mathit{mass}_{1} \, \cos\left(a - b\right)\right) \\
            \partial L / \partial b &= \mathit{length}_{1} \, \mathit{mass}_{1} \, \left(\mathit{length}_{0} \, \dot{a} \, \dot{b} \, \sin\left(a - b\right) - g \, \sin b\right) \\
            \partial L / \partial \dot{b} &= \mathit{length}_{1} \, \mathit{mass}_{1} \, \left(\mathit{length}_{1} \, \dot{b} + \mathit{length}_{0} \, \dot{a} \, \cos\left(a - b\right)\right)
            \end{aligned}
            ```
        "#]],
    );
}

#[test]
fn functions_and_pairs_of_names_are_lines() {
    check(
        lagrangian(
            quote! {
                coordinates(x, y),
                lagrangian = {
                    let pull = |m, at| m / (x - at).hypot(y);
                    let (s, c) = y.sin_cos();
                    (dot(x).powi(2) + dot(y).powi(2)) / 2.0 + pull(mass, -1.0) + pull(1.0, s) * c
                },
            },
            quote! { struct TwoSuns { mass: f64 } },
        ),
        &expect![[r#"

            # Dynamics

            L(q, v, t), and what is declared with it:

            ```math
            \begin{aligned}
            L &= \frac{{\dot{x}}^{2} + {\dot{y}}^{2}}{2} + \mathit{pull}\left(\mathit{mass}, -1\right) + \mathit{pull}\left(1, s\right) \, c \\
            \mathit{pull}\left(m, \mathit{at}\right) &= \frac{m}{\sqrt{{\left(x - \mathit{at}\right)}^2 + {y}^2}} \\
            s &= \sin y \\
            c &= \cos y
            \end{aligned}
            ```

            The compiler makes of it:

            ```math
            \begin{aligned}
            E &= 0.5 \, \left({\dot{x}}^{2} + {\dot{y}}^{2} - \frac{2 \, \mathit{mass}}{\sqrt{{\left(x + 1\right)}^2 + {y}^2}}\right) - \frac{\cos y}{\sqrt{{\left(x - \sin y\right)}^2 + {y}^2}} \\
            \partial L / \partial x &= -\left(\frac{\mathit{mass} \, \left(x + 1\right)}{{\sqrt{{\left(x + 1\right)}^2 + {y}^2}}^{3}} + \frac{\left(\cos y\right) \, \left(x - \sin y\right)}{{\sqrt{{\left(x - \sin y\right)}^2 + {y}^2}}^{3}}\right) \\
            \partial L / \partial \dot{x} &= \dot{x} \\
            \partial L / \partial \dot{y} &= \dot{y}
            \end{aligned}
            ```
        "#]],
    );
}

#[test]
fn what_formulas_share_stands_once() {
    check(
        lagrangian(
            quote! {
                coordinates(x, y),
                lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - k * r + push(x, 1.0),
                force(x) = push(y, r),
                let = {
                    let (s, c) = y.sin_cos();
                    let r = x.hypot(c);
                    let push = |a, b| { let twice = 2.0 * a; twice * s + b };
                },
            },
            quote! { struct Shared { k: f64 } },
        ),
        &expect![[r#"

            # Dynamics

            L(q, v, t), and what is declared with it:

            ```math
            \begin{aligned}
            L &= \frac{{\dot{x}}^{2} + {\dot{y}}^{2}}{2} - k \, r + \mathit{push}\left(x, 1\right) \\
            F_{x} &= \mathit{push}\left(y, r\right) \\
            s &= \sin y \\
            c &= \cos y \\
            r &= \sqrt{{x}^2 + {c}^2} \\
            \mathit{twice} &= 2 \, a \\
            \mathit{push}\left(a, b\right) &= \mathit{twice} \, s + b
            \end{aligned}
            ```

            The compiler makes of it:

            ```math
            \begin{aligned}
            E &= 2 \, \left(0.25 \, \left({\dot{x}}^{2} + {\dot{y}}^{2} + 2 \, \sqrt{{x}^2 + {\left(\cos y\right)}^2} \, k\right) - \left(\left(\sin y\right) \, x + 0.5\right)\right) \\
            \partial L / \partial y &= \left(2 \, \cos y\right) \, \left(x + \frac{\left(0.5 \, \sin y\right) \, k}{\sqrt{{x}^2 + {\left(\cos y\right)}^2}}\right) \\
            \partial L / \partial x + F_{x} &= \sqrt{{x}^2 + {\left(\cos y\right)}^2} + 2 \, y \, \sin y + 2 \, \left(\sin y - \frac{0.5 \, x \, k}{\sqrt{{x}^2 + {\left(\cos y\right)}^2}}\right) \\
            \partial L / \partial \dot{x} &= \dot{x} \\
            \partial L / \partial \dot{y} &= \dot{y}
            \end{aligned}
            ```
        "#]],
    );
}

#[test]
fn a_family_over_pairs_has_two_ranges() {
    check(
        lagrangian(
            quote! {
                coordinates(x[n], y[n]),
                lagrangian = sum(0..n, |i| dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0,
                impact(i in 0..n, j in i + 1..n) = (x[i] - x[j]).hypot(y[i] - y[j]) - 2.0 * r,
            },
            quote! { struct Discs { n: usize, r: f64 } },
        ),
        &expect![[r#"

            # Dynamics

            L(q, v, t), and what is declared with it:

            ```math
            \begin{aligned}
            L &= \frac{\sum_{i = 0}^{n - 1} \left({\dot{x}_{i}}^{2} + {\dot{y}_{i}}^{2}\right)}{2} \\
            0 &\le \sqrt{{\left(x_{i} - x_{j}\right)}^2 + {\left(y_{i} - y_{j}\right)}^2} - 2 \, r \qquad \text{for } 0 \le i \le n - 1, \ i + 1 \le j \le n - 1
            \end{aligned}
            ```

            The compiler makes of it:

            ```math
            \begin{aligned}
            E &= 0.5 \, \sum_{i = 0}^{n - 1} \left({\dot{x}_{i}}^{2} + {\dot{y}_{i}}^{2}\right)
            \end{aligned}
            ```
        "#]],
    );
}

#[test]
fn sums_pairs_components_and_momenta() {
    check(
        degenerate_lagrangian(
            quote! {
                coordinates(x[N], y[N]),
                one_form = [|j| 0.0, |j| gamma[j] * x[j]],
                hamiltonian = -sum_pairs(0..N, |j, k| gamma[j] * gamma[k]
                    * ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2) + 1e-3).ln()) / (4.0 * PI),
                momenta(angular = sum(0..N, |j| gamma[j] * (x[j].powi(2) + y[j].powi(2)))),
            },
            quote! { struct Vortices<const N: usize> { gamma: [f64; N] } },
        ),
        &expect![[r#"

            # Dynamics

            L(q, v, t) = α(q, t)·v − H(q, t), as it is declared:

            ```math
            \begin{aligned}
            \alpha_{x_{j}} &= 0 \\
            \alpha_{y_{j}} &= \gamma_{j} \, x_{j} \\
            H &= -\frac{\sum_{0 \le j < k \le N - 1} \gamma_{j} \, \gamma_{k} \, \ln\left({\left(x_{j} - x_{k}\right)}^{2} + {\left(y_{j} - y_{k}\right)}^{2} + 10^{-3}\right)}{4 \, \pi} \\
            \text{angular} &= \sum_{j = 0}^{N - 1} \gamma_{j} \, \left({x_{j}}^{2} + {y_{j}}^{2}\right)
            \end{aligned}
            ```
        "#]],
    );
}

#[test]
fn arrays_of_rotations_have_indices_before_those_of_entries() {
    check(
        lagrangian(
            quote! {
                coordinates(R[N]: SO3, s[N]: S2),
                lagrangian = sum(0..N, |i| omega(R[i])[0].powi(2) + omega(R[i]).norm_squared() + dot(s[i]).norm_squared())
                    - R[0][2][1] * s[0][2] - s[0].dot(R[0].column(1)),
            },
            quote! { struct Tops<const N: usize>; },
        ),
        &expect![[r#"

            # Dynamics

            L(q, v, t), and what is declared with it:

            ```math
            \begin{aligned}
            L &= \sum_{i = 0}^{N - 1} \left({\omega\left(R_{i}\right)_{0}}^{2} + {\left|\left(\omega\left(R_{i}\right)_{0}, \omega\left(R_{i}\right)_{1}, \omega\left(R_{i}\right)_{2}\right)\right|}^{2} + {\left|\dot{\mathbf{s}}_{i}\right|}^{2}\right) \\
            &\quad - R_{0,2,1} \, s_{0,2} - \mathbf{s}_{0} \cdot \left(R_{0,0,1}, R_{0,1,1}, R_{0,2,1}\right)
            \end{aligned}
            ```

            The compiler makes of it:

            ```math
            \begin{aligned}
            E &= R_{0,2,1} \, s_{0,2} + s_{0,0} \, R_{0,0,1} + s_{0,1} \, R_{0,1,1} \\
            &\quad + \sum_{i = 0}^{N - 1} \left({\omega\left(R_{i}\right)_{0}}^{2} + {\omega\left(R_{i}\right)_{0}}^{2} + {\omega\left(R_{i}\right)_{1}}^{2} + {\omega\left(R_{i}\right)_{2}}^{2} + {\dot{s}_{i,0}}^{2} + {\dot{s}_{i,1}}^{2} + {\dot{s}_{i,2}}^{2}\right) \\
            &\quad + R_{0,2,1} \, s_{0,2}
            \end{aligned}
            ```
        "#]],
    );
}

#[test]
fn rotations_constraints_choices_and_functions() {
    check(
        lagrangian(
            quote! {
                coordinates(R: SO3, s: S2, omega_0),
                lagrangian = sum(0..3, |k| dot(s[k]).powi(2)) + omega(R)[0].powi(2) + omega(R)[1].powi(2)
                    + (omega(R)[2].powi(2) + dot(omega_0).powi(2)) / 2.0 - R[2][1] * psi(omega_0, t),
                functions(psi = path),
            },
            quote! { struct Top; },
        ),
        &expect![[r#"

            # Dynamics

            L(q, v, t), and what is declared with it:

            ```math
            \begin{aligned}
            L &= \sum_{k = 0}^{2} {\dot{s}_{k}}^{2} + {\omega\left(R\right)_{0}}^{2} + {\omega\left(R\right)_{1}}^{2} + \frac{{\omega\left(R\right)_{2}}^{2} + {\dot{\omega}_{0}}^{2}}{2} - R_{2,1} \, \psi\left(\omega_{0}, t\right)
            \end{aligned}
            ```

            The compiler makes of it:

            ```math
            \begin{aligned}
            E &= \sum_{i = 0}^{2} {\dot{s}_{i}}^{2} + {\omega\left(R\right)_{0}}^{2} + {\omega\left(R\right)_{1}}^{2} + 0.5 \, \left({\omega\left(R\right)_{2}}^{2} + {\dot{\omega}_{0}}^{2}\right) + R_{2,1} \, \psi\left(\omega_{0}, t\right)
            \end{aligned}
            ```
        "#]],
    );
    check(
        lagrangian(
            quote! {
                coordinates(x[n], y[n]),
                lagrangian = sum(0..n, |i| (dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0
                    - if x[i] < 0.0 && t > 1.0 { k * x[i].abs() } else { x[(i + 1) % n].sin() }),
                force(y) = |i| -drag * dot(y[i]),
                dissipation = drag * sum_pairs(0..n, |i, j| (dot(x[i]) - dot(x[j])).powi(2)),
                constraint = x[0].hypot(y[0]) - self.rod,
                constraint(i in 1..n) = (x[i] - x[i - 1]).sqrt() - rod,
            },
            quote! { struct Chain { n: usize, k: f64, rod: f64, drag: f64 } },
        ),
        &expect![[r#"

            # Dynamics

            L(q, v, t), and what is declared with it:

            ```math
            \begin{aligned}
            L &= \sum_{i = 0}^{n - 1} \left(\frac{{\dot{x}_{i}}^{2} + {\dot{y}_{i}}^{2}}{2} - \begin{cases} k \, \left|x_{i}\right| & \text{if } x_{i} < 0 \text{ and } t > 1 \\ \sin x_{\left(i + 1\right) \bmod n} & \text{otherwise} \end{cases}\right) \\
            R &= \mathit{drag} \, \sum_{0 \le i < j \le n - 1} {\left(\dot{x}_{i} - \dot{x}_{j}\right)}^{2} \\
            F_{y_{i}} &= -\mathit{drag} \, \dot{y}_{i} \\
            0 &= \sqrt{{x_{0}}^2 + {y_{0}}^2} - \mathit{rod} \\
            0 &= \sqrt{x_{i} - x_{i - 1}} - \mathit{rod} \qquad \text{for } 1 \le i \le n - 1
            \end{aligned}
            ```
        "#]],
    );
}

#[test]
fn a_dissipation_function_stands_as_it_is_written() {
    check(
        lagrangian(
            quote! {
                coordinates(x, y),
                lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
                force(y) = -y,
                dissipation = gamma * dot(x).powi(2) / 2.0,
            },
            quote! { struct Damped { gamma: f64 } },
        ),
        &expect![[r#"

            # Dynamics

            L(q, v, t), and what is declared with it:

            ```math
            \begin{aligned}
            L &= \frac{{\dot{x}}^{2} + {\dot{y}}^{2}}{2} \\
            R &= \frac{\gamma \, {\dot{x}}^{2}}{2} \\
            F_{y} &= -y
            \end{aligned}
            ```

            The compiler makes of it:

            ```math
            \begin{aligned}
            E &= 0.5 \, \left({\dot{x}}^{2} + {\dot{y}}^{2}\right) \\
            \partial L / \partial \dot{x} &= \dot{x} \\
            \partial L / \partial \dot{y} &= \dot{y} \\
            \partial L / \partial y + F_{y} - \partial R / \partial \dot{y} &= -y \\
            \partial L / \partial x - \partial R / \partial \dot{x} &= -\dot{x} \, \gamma
            \end{aligned}
            ```
        "#]],
    );
}

#[test]
fn unit_vectors_and_their_areas() {
    check(
        degenerate_lagrangian(
            quote! {
                coordinates(s[N]: S2, n: S2),
                one_form = sum(0..N, |i| gamma[i] * area(s[i])) - area(n),
                hamiltonian = sum(0..N, |i| s[i].dot(n)) + n[2],
            },
            quote! { struct Spins<const N: usize> { gamma: [f64; N] } },
        ),
        &expect![[r#"

            # Dynamics

            L(q, v, t) = α(q, t)·v − H(q, t), as it is declared:

            ```math
            \begin{aligned}
            \alpha &= \sum_{i = 0}^{N - 1} \gamma_{i} \, \operatorname{area}\left(\mathbf{s}_{i}\right) - \operatorname{area}\left(\mathbf{n}\right) \\
            H &= \sum_{i = 0}^{N - 1} \mathbf{s}_{i} \cdot \mathbf{n} + n_{2}
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

            The compiler makes of it:

            ```math
            \begin{aligned}
            E &= {\dot{q}_{0}}^{2} + {\dot{q}_{1}}^{2} + {\dot{q}_{2}}^{2} + 0.5 \, \sum_{i = 0}^{N - 1} m_{i} \, \left({\dot{r}_{i,0}}^{2} + {\dot{r}_{i,1}}^{2} + {\dot{r}_{i,2}}^{2}\right) \\
            &\quad - \sum_{i = 0}^{N - 1} \sum_{j = i + 1}^{N - 1} \frac{m_{j} \, m_{i}}{\sqrt{{\left(r_{i,0} - r_{j,0}\right)}^{2} + {\left(r_{i,1} - r_{j,1}\right)}^{2} + {\left(r_{i,2} - r_{j,2}\right)}^{2}}}
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
