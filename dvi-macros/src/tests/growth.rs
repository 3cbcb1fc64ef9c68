//! How the work of the compiler grows with the size of a system: with the number of its terms.

use proc_macro2::TokenStream;
use quote::quote;

use crate::expand::{degenerate_lagrangian, lagrangian};
use crate::oracle_tests::random::Random;
use crate::work::steps_of;

/// A sum, cut into `let`s of 50 terms, each with its kinetic energy beside it.
fn system(coordinates: &[String], terms: &[String]) -> u64 {
    let kinetic: Vec<String> = coordinates.iter().map(|name| format!("dot({name}).powi(2)")).collect();
    let mut text = String::new();
    let mut total = Vec::new();
    for (sign, list) in [("0.5 *", &kinetic), ("-", &terms.to_vec())] {
        for part in list.chunks(50) {
            let name = format!("part{}", total.len());
            text += &format!("let {name} = {};\n", part.join(" + "));
            total.push(format!("{sign} {name}"));
        }
    }
    let formula = format!("{{ {text} {} }}", total.join(" + "));
    steps(lagrangian, &format!("coordinates({}), lagrangian = {formula}", coordinates.join(", ")))
}

/// The steps of an expansion.
fn steps(expand: fn(TokenStream, TokenStream) -> TokenStream, attribute: &str) -> u64 {
    let attribute = attribute.parse().expect("it is Rust");
    steps_of(|| {
        let expansion = expand(attribute, quote! { struct System; }).to_string();
        assert!(!expansion.contains("compile_error"), "{expansion}");
    })
}

/// Σ a xⁱyʲ
fn monomials(count: usize) -> u64 {
    let mut random = Random::new(20);
    let terms = (0..count).map(|_| {
        let (a, i, j) = (1 + random.below(999_999), random.below(71), random.below(71));
        format!("{a}e-6 * x.powi({i}) * y.powi({j})")
    });
    system(&["x".to_string(), "y".to_string()], &terms.collect::<Vec<_>>())
}

/// As many springs, each between a coordinate and the next one.
fn chain(count: usize) -> u64 {
    let names: Vec<String> = (0..=count).map(|number| format!("x{number}")).collect();
    let springs = names.windows(2).map(|pair| format!("({} - {}).powi(4)", pair[0], pair[1]));
    system(&names, &springs.collect::<Vec<_>>())
}

/// Charges on a line, each two of them with a term of their own.
fn pairs(count: usize) -> u64 {
    let mut random = Random::new(20);
    let bodies = (2.0 * count as f64).sqrt().ceil() as usize;
    let names: Vec<String> = (0..bodies).map(|number| format!("x{number}")).collect();
    let pairs = (0..bodies).flat_map(|j| (0..j).map(move |k| (j, k))).take(count);
    let terms =
        pairs.map(|(j, k)| format!("{}e-3 / (1.0 + (x{j} - x{k}).powi(2)).sqrt()", 1 + random.below(999)));
    system(&names, &terms.collect::<Vec<_>>())
}

/// A gauge of quotients, each of which has the one before above and below.
fn quotients(count: usize) -> u64 {
    let next = |number: usize| format!("let a{} = (x + a{number}) / (y + a{number});\n", number + 1);
    let chain: String = (0..count).map(next).collect();
    let attribute = format!(
        "coordinates(x, y), one_form = x * d(y), hamiltonian = x * y, gauge = {{ let a0 = 2.0 + y * y; {chain} a{count} }}"
    );
    steps(degenerate_lagrangian, &attribute)
}

/// A potential that the same statements make again and again of two formulas, with each in it more than
/// once.
fn recursion(statements: &str, last: &str, count: usize) -> u64 {
    let kinetic = "0.5 * (dot(x).powi(2) + dot(y).powi(2))";
    let all = format!("{statements}\n").repeat(count);
    let formula = format!("{kinetic} - {{ let a = x; let b = y; {all} {last} }}");
    steps(lagrangian, &format!("coordinates(x, y), lagrangian = {formula}"))
}

/// Twice as many terms are little more than twice the work.
const LITTLE_MORE: f64 = 2.4;

/// Twice as many terms are less than `most` times the work.
fn grows_by(most: f64, name: &str, work: impl Fn(usize) -> u64, sizes: [usize; 3]) {
    let steps = sizes.map(&work);
    for (size, pair) in sizes.iter().zip(steps.windows(2)) {
        let ratio = pair[1] as f64 / pair[0] as f64;
        assert!(
            ratio < most,
            "{name}: {size} terms take {} steps, twice as many {ratio:.2} times that",
            pair[0]
        );
    }
}

#[test]
fn monomials_without_end() {
    grows_by(LITTLE_MORE, "monomials", monomials, [500, 1000, 2000]);
}

#[test]
fn neighbours_without_end() {
    grows_by(LITTLE_MORE, "a chain", chain, [50, 100, 200]);
}

#[test]
fn pairs_without_end() {
    grows_by(LITTLE_MORE, "pairs", pairs, [250, 500, 1000]);
}

#[test]
fn quotients_of_quotients_without_end() {
    grows_by(LITTLE_MORE, "quotients of quotients", quotients, [8, 16, 32]);
}

/// Each formula stands in the next one twice: as a tree they grow with a power of their number.
#[test]
fn recursions_without_end() {
    for (statements, last) in [
        ("let c = x * b - 0.5 * a; let a = b; let b = c;", "(2.0 + b).sqrt()"),
        ("let b = (b * y).hypot(a + b);", "b"),
    ] {
        grows_by(8.0, statements, |count| recursion(statements, last, count), [8, 16, 32]);
    }
}
