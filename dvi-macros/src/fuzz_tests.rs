//! Whatever the tokens: no panic, no overflow of the stack, and Rust comes out.

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};
use proptest::prelude::*;
use quote::quote;

use crate::expand::{degenerate_lagrangian, lagrangian};
use crate::oracle_tests::random_system;
use crate::syntax::Kind;

/// A system without mistakes, to be mutated: one of the oracle's, or one with what these do not have.
fn system_without_mistakes(seed: u64) -> (Kind, TokenStream, TokenStream) {
    match seed % 8 {
        0 => (
            Kind::Degenerate,
            quote! {
                coordinates(x[gamma.len()], y[gamma.len()], u, r#type),
                lagrangian = sum(0..=gamma.len() - 1, |j| gamma[j] * x[j] * dot(y[(j + 1) % gamma.len()]))
                    + u * dot(r#type) - { let b = Self::B * u * u; -b.sqrt() + f64::exp(r#type) },
                momenta(impulse = sum(0..gamma.len(), |j| self.gamma[j] * x[j]), other = x[0].hypot(y[0])),
                functions(f = [f, df, d2f]),
                crate = ::other::path,
            },
            quote! { pub(crate) struct System<'a> { gamma: &'a [f64] } },
        ),
        1 => (
            Kind::Regular,
            quote!(coordinates(x, y), lagrangian = dot(x).powi(2) + dot(y).powi(2), force(x) = -x),
            quote! { struct System; },
        ),
        _ => {
            let (kind, attribute, item) = random_system(seed);
            (kind, attribute.parse().expect("tokens"), item.parse().expect("tokens"))
        }
    }
}

/// Words and numbers of the language, of Rust, and of neither.
fn vocabulary() -> Vec<TokenTree> {
    let words = quote! {
        x y z u w t n N PI gamma a s self Self sum sum_pairs sum_ordered_pairs d dot f sin powi powf atan2 len
        coordinates one_form hamiltonian lagrangian force dissipation constraint nonholonomic momenta events functions crate
        if else let match loop for in return break as f64 usize const unsafe async move struct true r#type _
        + - * / % ^ & | ! < > = == <= >= && || += .. ..= , ; : :: . ? @ # $ ~ -> =>
        0 1 2 3 4 -1 0.5 1e300 1e-300 1e999 18446744073709551615 99999999999999999999999999999999999999999
        9223372036854775807 2147483648 281474976710656 1000000000000 2u8 1f32 "text" 'c' 'life b"bytes" 0xff
    };
    words.into_iter().collect()
}

fn bracketed(delimiter: Delimiter, tokens: Vec<TokenTree>) -> TokenTree {
    TokenTree::Group(Group::new(delimiter, tokens.into_iter().collect()))
}

fn any_tokens() -> impl Strategy<Value = TokenStream> {
    let delimiters = vec![Delimiter::Parenthesis, Delimiter::Bracket, Delimiter::Brace, Delimiter::None];
    let leaf = prop::sample::select(vocabulary()).prop_map(|token| vec![token]);
    let trees = leaf.prop_recursive(5, 60, 6, move |inner| {
        let tokens = prop::collection::vec(inner, 0..6).prop_map(|parts| parts.concat());
        (prop::sample::select(delimiters.clone()), tokens.clone(), tokens).prop_map(
            |(delimiter, before, inside)| {
                let mut tokens = before;
                tokens.push(bracketed(delimiter, inside));
                tokens
            },
        )
    });
    trees.prop_map(|tokens| tokens.into_iter().collect())
}

/// One step away from what was written.
#[derive(Clone, Debug)]
enum Mutation {
    Delete(usize),
    Duplicate(usize),
    Replace(usize, usize),
    Insert(usize, usize),
    Unwrap(usize),
}

fn any_mutation() -> impl Strategy<Value = Mutation> {
    let place = 0_usize..400;
    prop_oneof![
        place.clone().prop_map(Mutation::Delete),
        place.clone().prop_map(Mutation::Duplicate),
        (place.clone(), place.clone()).prop_map(|(a, b)| Mutation::Replace(a, b)),
        (place.clone(), place.clone()).prop_map(|(a, b)| Mutation::Insert(a, b)),
        place.prop_map(Mutation::Unwrap),
    ]
}

fn count(tokens: &TokenStream) -> usize {
    let size = |token| match token {
        TokenTree::Group(group) => 1 + count(&group.stream()),
        _ => 1,
    };
    tokens.clone().into_iter().map(size).sum()
}

/// `tokens` with token number `at`, counted through all brackets, replaced.
fn edit(tokens: &TokenStream, at: &mut usize, new: &dyn Fn(TokenTree) -> Vec<TokenTree>) -> TokenStream {
    let mut edited = TokenStream::new();
    for token in tokens.clone() {
        let here = *at == 0;
        *at = at.wrapping_sub(1);
        if here {
            edited.extend(new(token));
        } else if let TokenTree::Group(group) = token {
            let inside = edit(&group.stream(), at, new);
            edited.extend([TokenTree::Group(Group::new(group.delimiter(), inside))]);
        } else {
            edited.extend([token]);
        }
    }
    edited
}

fn mutated(tokens: &TokenStream, mutation: &Mutation) -> TokenStream {
    let length = count(tokens).max(1);
    let vocabulary = vocabulary();
    let word = |n: usize| vocabulary[n % vocabulary.len()].clone();
    let at =
        |place: usize, new: &dyn Fn(TokenTree) -> Vec<TokenTree>| edit(tokens, &mut (place % length), new);
    match *mutation {
        Mutation::Delete(place) => at(place, &|_| Vec::new()),
        Mutation::Duplicate(place) => at(place, &|token| vec![token.clone(), token]),
        Mutation::Replace(place, by) => at(place, &|_| vec![word(by)]),
        Mutation::Insert(place, new) => at(place, &|token| vec![word(new), token]),
        Mutation::Unwrap(place) => at(place, &|token| match token {
            TokenTree::Group(group) => group.stream().into_iter().collect(),
            other => vec![other],
        }),
    }
}

/// Expands on a stack as large as the compiler's.
fn expand(kind: Kind, attribute: &TokenStream, item: &TokenStream) -> String {
    expand_text(kind, attribute.to_string(), item.to_string())
}

/// Token streams stay on their thread; texts travel.
fn expand_text(kind: Kind, attribute: String, item: String) -> String {
    let run = move || {
        let parse = |text: &str| text.parse::<TokenStream>().ok();
        let (Some(attribute), Some(item)) = (parse(&attribute), parse(&item)) else { return String::new() };
        let output = match kind {
            Kind::Degenerate => degenerate_lagrangian(attribute, item.clone()),
            Kind::Regular => lagrangian(attribute, item.clone()),
        };
        let parsed = syn::parse2::<syn::File>(output.clone());
        // What was no item before is none afterwards.
        assert!(parsed.is_ok() || syn::parse2::<syn::Item>(item).is_err(), "not Rust: {output}");
        output.to_string()
    };
    let thread = std::thread::Builder::new().stack_size(8 << 20).spawn(run);
    thread.expect("a thread").join().expect("no panic")
}

fn system() -> TokenStream {
    quote! { struct System { gamma: Vec<f64>, a: [f64; 3], n: usize } }
}

/// A formula as H and as part of L; the expansion of the former.
fn hamiltonian(formula: &str) -> String {
    let regular = format!(
        "coordinates(x[n], y[n]), lagrangian = sum(0..n, |j| dot(x[j]) * dot(y[j])) + dot(x[0]) * ({formula})"
    );
    expand_text(Kind::Regular, regular, system().to_string());
    let attribute = format!(
        "coordinates(x[n], y[n]), one_form = sum(0..n, |j| x[j] * d(y[j])), hamiltonian = {formula}"
    );
    expand_text(Kind::Degenerate, attribute, system().to_string())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_attribute(kind in prop::sample::select(Kind::BOTH.to_vec()), attribute in any_tokens()) {
        expand(kind, &attribute, &system());
    }

    #[test]
    fn any_formula(formula in any_tokens(), role in 0..6) {
        let kind = if role < 4 { Kind::Degenerate } else { Kind::Regular };
        let attribute = match role {
            0 => quote!(coordinates(x, y, z[3], u[n], w[n]), one_form = x * d(y), hamiltonian = #formula),
            1 => quote!(coordinates(x, y, z[3], u[n], w[n]), one_form = #formula, hamiltonian = x),
            2 => quote!(coordinates(x, y, z[3], u[n], w[n]), lagrangian = #formula, momenta(p = #formula)),
            3 => quote!(coordinates(#formula), one_form = x * d(y), hamiltonian = x, functions(#formula)),
            4 => quote!(coordinates(x, y, z[3], u[n], w[n]), lagrangian = #formula, momenta(p = #formula)),
            _ => quote!(coordinates(x, #formula), lagrangian = dot(x) * dot(x), momenta(p = #formula)),
        };
        expand(kind, &attribute, &system());
    }

    #[test]
    fn any_item(seed in any::<u64>(), item in any_tokens()) {
        let (kind, attribute, _) = system_without_mistakes(seed);
        expand(kind, &attribute, &item);
    }

    #[test]
    fn mutated_attributes(seed in any::<u64>(), mutations in prop::collection::vec(any_mutation(), 1..4)) {
        let (kind, attribute, item) = system_without_mistakes(seed);
        let attribute = mutations.iter().fold(attribute, |tokens, mutation| mutated(&tokens, mutation));
        expand(kind, &attribute, &item);
    }

    #[test]
    fn mutated_items(seed in any::<u64>(), mutations in prop::collection::vec(any_mutation(), 1..4)) {
        let (kind, attribute, item) = system_without_mistakes(seed);
        let item = mutations.iter().fold(item, |tokens, mutation| mutated(&tokens, mutation));
        expand(kind, &attribute, &item);
    }
}

#[test]
fn the_systems_themselves_are_accepted() {
    for (kind, attribute, item) in [0, 1].map(system_without_mistakes) {
        let output = expand(kind, &attribute, &item);
        assert!(!output.contains("compile_error"), "{output}");
    }
}

#[test]
fn empty_input() {
    let nothing = TokenStream::new();
    for kind in Kind::BOTH {
        assert!(expand(kind, &nothing, &system()).contains("no coordinates"));
        expand(kind, &nothing, &nothing);
    }
    for formula in
        ["", "()", "{}", "[]", ";", "sum()", "sum(,)", "d()", "if {}", "x[]", "||", "|", "sum(0..n, ||)"]
    {
        hamiltonian(formula);
    }
}

#[test]
fn depth_is_refused_where_it_would_exhaust_the_stack() {
    let nested = |open: &str, close: &str, n: usize| format!("{}x[0]{}", open.repeat(n), close.repeat(n));
    for n in [500, 5000] {
        for (open, close) in [
            ("(", ")"),
            ("{", "}"),
            ("[", "]"),
            ("- ", ""),
            ("!", ""),
            ("& ", ""),
            ("* ", ""),
            ("x = ", ""),
            ("|j| ", ""),
            ("return ", ""),
            ("if ", ""),
            ("sum(0..n, |j| ", ")"),
            ("x[", "]"),
            ("a::<f<", ">>"),
            (".. ", ""),
            ("x as Vec<", ">"),
            ("unsafe {", "}"),
            ("f(1, ", ")"),
            ("if x[0] < 1.0 { 1.0 } else ", "{ }"),
            ("let a = ", ""),
            ("match ", "{}"),
        ] {
            let output = hamiltonian(&nested(open, close, n));
            assert!(output.contains("compile_error"), "{n} times `{open}`");
        }
    }
}

#[test]
fn long_formulas_are_answered() {
    for n in [380, 3000, 20_000] {
        hamiltonian(&format!("x[0]{}", " + x[0] * y[0]".repeat(n)));
        hamiltonian(&format!("x[0]{}", ".sin()".repeat(n)));
        hamiltonian(&format!("x[0]{}", " as f64".repeat(n)));
        hamiltonian(&format!("x{}", "[0]".repeat(n)));
    }
    for n in [50, 1000] {
        hamiltonian(&format!("{{ let a = x[0]; {} a }}", "let a = a.sin() + a.cos();".repeat(n)));
        hamiltonian(&format!("{{ let a = x[0]; {} a }}", "let a = a * a;".repeat(n)));
        hamiltonian(&format!("{{ let a = x[0]; {} a }}", "let a = a * y[0] + x[1];".repeat(n)));
    }
}

#[test]
fn numbers_beyond_reason() {
    for formula in [
        "x[18446744073709551615]",
        "x[9223372036854775807]",
        "x[-9223372036854775807 - 9223372036854775807]",
        "sum(0..n, |j| x[j * 9223372036854775807 + j * 9223372036854775807])",
        "sum(0..n, |j| x[4611686018427387904 * (4611686018427387904 * j)])",
        "sum(n..0, |j| x[j])",
        "sum(5..-5, |j| x[j])",
        "sum(0..=9223372036854775807, |j| x[j])",
        "sum(-9223372036854775807..9223372036854775807, |j| a[j] * x[j])",
        "sum(0..9223372036854775807, |j| a[3 * j] * x[j])",
        "x[0 % -5]",
        "sum(0..n, |j| x[j % (n - n)])",
        "sum(0..n, |j| x[(j + 9223372036854775807) % 3])",
        "x[0].powi(-2147483648)",
        "x[0].powi(2147483647)",
        "x[0].powi(99999999999999999999)",
        "x[0].powi(4096).powi(4096).powi(4096).powi(4096)",
        "(x[0].powi(4096) * x[0].powi(4096)).powi(-4096).powi(4096)",
        "x[0].powf(1e308)",
        "x[0].powf(-64.5)",
        "1e308 * 1e308 * x[0]",
        "x[0] / 1e-320",
        "0.0 / 0.0",
        "1 / 0",
        "(0.0).ln() * x[0]",
        "-0.0 * x[0]",
        "99999999999999999999999999999999999999999999.0e99999999999 * x[0]",
    ] {
        hamiltonian(formula);
    }
    for size in
        ["1000000000000", "18446744073709551615", "-1", "0", "1048576", "9999999999999999999999", "1.5"]
    {
        let size: TokenStream = size.parse().expect("tokens");
        expand(
            Kind::Degenerate,
            &quote!(coordinates(x[#size], y[#size]), one_form = x[0] * d(y[0]), hamiltonian = x[0]),
            &system(),
        );
    }
}

/// A lifetime that is named as a generic type is not that type, whether it is declared or was forgotten.
#[test]
fn lifetimes_named_as_types() {
    let attribute = quote!(coordinates(x), lagrangian = dot(x) * dot(x));
    for generics in ["<a>", "<'a>", "<'a, a>", "<a, const N: usize>"] {
        let item = format!("struct System{generics} {{ gamma: &'a [f64], }}");
        let output = expand_text(Kind::Regular, attribute.to_string(), item);
        let is_kept = output.replace("& '", "&'").contains("&'a [f64]");
        assert!(is_kept && output.contains("Packable"), "{output}");
    }
}

/// As long as a formula may be, and one token longer.
#[test]
fn the_longest_sum_is_expanded() {
    let sum = |terms: usize| {
        let of = |n: usize| {
            format!("{} {n}.5 * {}", if n.is_multiple_of(3) { "-" } else { "+" }, ["x", "y"][n % 2])
        };
        (1..terms).map(of).collect::<String>()
    };
    let expanded = |terms| {
        let attribute = format!("coordinates(x, y), one_form = x * d(y), hamiltonian = x{}", sum(terms));
        expand_text(Kind::Degenerate, attribute, "struct System;".to_string())
    };
    // A sign, a number, `*` and a name, and in front of the first `hamiltonian = x`.
    let longest = (100_000 - 3) / 4 + 1;
    let output = expanded(longest);
    assert!(!output.contains("compile_error"), "{output:.300}");
    assert!(expanded(longest + 1).contains("longer than 100000 tokens"));
}
