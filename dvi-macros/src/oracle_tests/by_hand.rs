//! Systems that are written by hand: each was wrong once, or was refused though it is right.

use super::compare::{Verdict, compare};
use super::formula::Formula;
use super::random::Random;
use super::read::Reader;
use super::summary::describe;
use super::system::{Block, Container, Dynamics, Field, Size, SizeKind, System};

const CONJUGATE: &str = "u * d(w) + sum(0..N, |j| x[j] * d(y[j]))";

#[rustfmt::skip]
const HAMILTONIANS: &[&str] = &[
    // Sums in sums that use a coordinate from outside.
    "sum_pairs(0..N, |i, j| s * (x[i] + x[j] - u).powi(2)) / 4",
    "sum_pairs(0..N, |i, j| s * (x[i] + x[j] - u).powi(2)) / 2",
    "sum_pairs(0..N, |i, j| (u + x[i] - x[j]).powi(4))",
    "sum(0..2, |i| sum(0..2, |j| 1 / (w + x[i] + x[j])))",
    "sum_ordered_pairs(0..2, |i, j| sum(0..2, |k| 1 / (x[j] + x[k] - u))).powi(2)",
    // Products of sums with the same factors.
    "sum(0..N, |i| g[i]) * sum_pairs(0..N, |i, j| x[j].powi(2)) + sum_pairs(0..N, |i, j| g[i] * x[j].powi(2))",
    "(sum(0..N, |i| g[i] * x[i]) - sum(0..N, |i| g[i]) * sum(0..N, |i| x[i])) * sum(0..N, |i| x[i].powi(2))",
    // A root beside its own radicand, with a factor in it.
    "w * (3 * w).sqrt()",
    // A bound on a function outside of its domain.
    "u + w.acos().max(1)",
    "w.max((u - 0.5).sqrt()) * w.min((u - 0.5).ln())",
    // One array at two depths.
    "sum(0..N, |j| (x[j] - sum(0..N, |k| x[k]) / (N as f64)).powi(2)) / (N as f64)",
    "sum_pairs(0..N, |i, j| x[j]) * sum(0..N, |i| x[i]).powi(2)",
    "sum(0..N, |i| sum(0..N - i, |j| y[j])) / sum(0..N, |i| y[i])",
    "sum(0..N, |i| if x[i] < 1 { 1 / (3 + sum_ordered_pairs(0..2, |j, k| x[j])) } else { 1 })",
    // Ranges that begin below zero.
    "sum(-1..2, |k| x[k + 1])",
    "sum_pairs(-2..1, |i, j| x[i + 2] * y[j + 2])",
    "sum(0..N, |i| sum(i - 1..i + 2, |k| x[k % N] * y[i]))",
    // Exponents that are zero for one index, and not beside it.
    "product(0..2, |i| (2 + x[i]).powf(x[1] - x[i]))",
    "sum(0..N, |i| (u * u + 1).powf(u * (i as f64)) + (2 + x[i]).powf(i as f64))",
    // An exponent that looks constant where it is 1 to all digits, of bases that have no logarithm.
    "(u - 0.9).powf((40 * w).erf())",
    // Exponents that are constant in one branch, of bases that have no logarithm.
    "(u - 5).powf(if w < 5 { 2 } else { u }) + (u - 5).powf(if w < 5 { 1 } else { u })",
    "(u - 5).powf(if w < 5 { 3 } else { w }) * (2 - sum(0..N, |i| x[i] * x[i]) * 9).powf(if u < 5 { 1 } else { x[0] })",
    // A power that overflows before it divides.
    "u.powi(-600) + w",
    // A branch that is not taken has no value.
    "if u > 5 { sum(0..N, |i| (x[i] - 9).sqrt()) } else { u * u }",
    "if u > 5 || w > 5 { sum(0..N, |i| (x[i] - 9).sqrt()) } else { u * u }",
    "if u > 5 || w > 5 { sum(0..N, |i| (x[i] - 9).sqrt() * w).powi(3) + w } else { if w > 4 { u.powi(2) } else { w.powi(2) } } * w.powi(2)",
    // A literal near the smallest number, beside one of ordinary size.
    "9.33e-305 * u + 10000.0 * w * w",
    "sum(0..N, |i| 9.33e-305 * x[i] + 10000.0 * y[i] * y[i])",
    // A root of a sum that has no terms for some indices.
    "sum(0..N, |j| sum(0..j, |k| (x[k] - u).powi(2) + 1).sqrt())",
    "sum(0..N, |j| sum(0..j, |k| x[k] - u).cbrt())",
    "sum(0..N, |j| sum_pairs(j..N, |k, l| (x[k] - u).powi(2) + x[l] * x[l] + 1).sqrt())",
    "sum(0..N, |j| sum_ordered_pairs(0..j + 1, |k, l| (x[k] - u).powi(2) * x[l] * x[l] + 1).sqrt() * w)",
    "sum(0..N, |j| sum(0..j, |k| sum(0..k, |l| (x[l] - u).powi(2) + 1)).sqrt() * x[j])",
    "sum(0..N, |j| sum(0..j, |k| (w * w + 1) * sum(0..k, |l| (x[l] - u).powi(2) + 1) + 1).sqrt())",
    "sum(0..N, |j| sum_pairs(0..j, |k, l| if s > 1 { 1 } else { x[k] + x[l] }).cbrt())",
    // Choices of zero in a sum over an index that nothing else in it depends on.
    "sum_ordered_pairs(0..N, |i, j| if u > 5 { sum_pairs(0..N, |k, l| (w - 9).sqrt() * x[i]) } else { 1 }) + w",
    "sum_pairs(0..N, |i, j| sum_ordered_pairs(0..i + 2, |k, l| if u < 9 { u } else { 1 })) * sum_pairs(0..2, |k, l| if u < 9 { (w * w + 1).sqrt() * u } else { 1 })",
    "sum(0..N, |i| if x[i] < 5 { x[i] } else { sum(0..N, |k| (x[k] - 50).sqrt()) }) * u",
    "(sum(0..N, |i| if x[i] < 5 { x[i] } else { sum(0..N, |k| (x[k] - 50).sqrt()) }).powi(2) + 1).ln()",
    "sum(0..N, |j| (x[j] + sum(0..N, |i| if u > 9 { sum(0..N, |k| (x[k] - 50).sqrt()) } else { x[i] * u })).powi(2))",
    // What no term of an empty sum asks for.
    "sum_pairs(0..N, |i, j| sum(0..N, |k| sum_ordered_pairs(0..k + 1, |l, m| y[k]).hypot(sum(i + 1..N, |l| 1)) * x[k]))",
    "sum(0..N, |i| sum(i + 1..N, |j| (x[i] * x[i] - i as f64 + N as f64 - 2 + u * u).sqrt() + y[j]))",
    // Indices whose bounds depend on each other.
    "sum(0..N, |j| sum(j..N, |k| x[k - j]))",
    "sum(0..N, |j| sum(0..N - j, |k| x[j + k]))",
    "sum_pairs(0..N, |j, k| g[k - j - 1] * x[j])",
    "sum_pairs(0..N, |i, j| x[i + 1] * x[j])",
    "sum_pairs(0..4, |i, j| x[i])",
    // A comma of the attribute behind two bars.
    "if u > 1 || w > 1 { u * u } else { w }",
];

const ONE_FORMS: &[&str] = &[
    "sum(0..N, |i| x[i] * d(y[i])) + x[0] * d(y[1]) + y[1] * d(x[0]) + u * d(w)",
    "sum(0..N, |i| x[i] * d(y[i])) + x[0] * d(y[1]) + u * d(w)",
    "sum(0..N, |i| x[i] * d(y[(i + 1) % N])) + u * d(w)",
    "(u * d(w) - w * d(u)) / 2 + t * d(u) + sum(0..N, |j| x[j] * d(y[j]))",
    "u * d(w) + sum(0..N, |j| x[j] * d(y[j]) + t * t * d(x[j]))",
];

const KINETIC: &[&str] = &[
    "sum(0..N, |j| (dot(x[j]) - 0.1 * sum(0..N, |k| dot(x[k]))).powi(2)) / 2 + dot(u).powi(2)",
    "sum_pairs(0..N, |i, j| (dot(u) + dot(x[i]) - dot(x[j])).powi(4)) + sum(0..N, |i| dot(x[i]).powi(2))",
    "sum(0..N, |i| dot(x[i])).powi(2) * (1 + u * u) + sum(0..N, |i| dot(x[i]).powi(2)) + dot(u).powi(2)",
];

/// u, w, x[N], y[N] and the parameters s and g[N], with N = 3.
fn declarations(kind: SizeKind, dynamics: Dynamics) -> System {
    let field = |name, container, shape, values| Field { name, container, shape, values };
    let fields = vec![
        field("s", Container::Scalar, vec![], vec![2.5]),
        field("g", Container::Vector, vec![0], vec![1.0, 2.0, 4.0]),
    ];
    let sizes = [("u", None), ("w", None), ("x", Some(0)), ("y", Some(0))];
    let mut blocks = Vec::from(sizes.map(|(name, size)| Block::line(name, size)));
    if matches!(dynamics, Dynamics::Regular(_)) {
        blocks.retain(|block| ["u", "x"].contains(&block.name));
    }
    let momenta = vec![Formula::Time];
    System { fields, momenta, ..System::of(vec![Size { kind, value: 3 }], blocks, dynamics) }
}

/// The systems with a literal size, a const generic, and a size that the run knows.
fn systems() -> Vec<System> {
    let kinds = [SizeKind::Literal, SizeKind::Constant("N"), SizeKind::Field("n"), SizeKind::Length("g")];
    let mut systems = Vec::new();
    for kind in kinds {
        let open = |regular: bool| {
            let time = || Formula::Time;
            let dynamics =
                if regular { Dynamics::Regular(time()) } else { Dynamics::OneForm(time(), time()) };
            declarations(kind.clone(), dynamics)
        };
        let (degenerate, regular) = (open(false), open(true));
        let read = |text: &str| Reader::formula(&degenerate, text);
        for hamiltonian in HAMILTONIANS {
            let dynamics = Dynamics::OneForm(read(CONJUGATE), read(hamiltonian));
            systems.push(System { dynamics, ..degenerate.clone() });
        }
        for one_form in ONE_FORMS {
            let dynamics = Dynamics::OneForm(read(one_form), read("u * u + sum(0..N, |i| x[i] * y[i])"));
            systems.push(System { dynamics, ..degenerate.clone() });
        }
        for kinetic in KINETIC {
            let dynamics = Dynamics::Regular(Reader::formula(&regular, kinetic));
            systems.push(System { dynamics, ..regular.clone() });
        }
    }
    systems
}

#[test]
fn systems_by_hand() {
    super::on_large_stack(|| {
        let mut failures = Vec::new();
        for system in systems() {
            let verdict = compare(&system, &mut Random::new(1));
            if !matches!(verdict, Verdict::Agrees { .. }) {
                failures.push(describe(&system, &verdict));
            }
        }
        assert!(failures.is_empty(), "{} systems:\n{}", failures.len(), failures.join("\n\n"));
    });
}
