//! The tables on the page of the methods say what the methods say of themselves.

use std::collections::BTreeSet;
use std::fs;

use dvi_core::methods::PreservedForm;
use dvi_core::prelude::*;

use super::{files, names, read, rows};

type Schemes = Vec<Box<dyn Scheme>>;

macro_rules! schemes {
    ($($scheme:expr),* $(,)?) => { vec![$(Box::new($scheme) as Box<dyn Scheme>),*] };
}

/// What the rows speak of, in their order.
fn regular() -> Vec<(&'static str, Schemes)> {
    let sigma = || Variational::sigma(0.3);
    vec![
        ("[`Variational::trapezoid`]", schemes![Variational::trapezoid()]),
        ("[`Variational::midpoint`]", schemes![Variational::midpoint()]),
        ("[`Variational::new`]", schemes![sigma(), Variational::simpson()]),
        (
            "[`Variational::phase_fitted`]",
            schemes![
                sigma().phase_fitted(Constant(1.0)),
                Variational::simpson().phase_fitted(Radial(Reading::Variational)),
                Variational::simpson().phase_fitted(Radial(Reading::Averaged)),
            ],
        ),
        ("[`Galerkin`]", schemes![Galerkin::<3>::new(), Galerkin::<4>::new(), Galerkin::<9>::new()]),
        ("[`Gauss`]", schemes![Gauss::<1>::new(), Gauss::<2>::new(), Gauss::<8>::new()]),
        ("[`Newmark`]", schemes![Newmark::new(0.25)]),
        ("[`Langevin`]", schemes![Langevin { friction: 1.0, temperature: 1.0, seed: 1 }]),
        ("[`RungeKutta`]", schemes![RungeKutta::heun(), RungeKutta::classical()]),
    ]
}

fn special() -> Vec<(&'static str, Schemes)> {
    let [rule, sigma] = [Variational::new(Quadrature::simpson()), Variational::sigma(0.3)];
    vec![
        ("[`Rattle`]", schemes![Rattle::default()]),
        ("[`Constrained`]", schemes![Constrained::new(sigma.rule), Constrained::new(rule.rule)]),
        ("[`Impacts::reflecting`]", schemes![Impacts::reflecting(sigma), Impacts::reflecting(rule)]),
        ("[`Impacts::new`]", schemes![Impacts::new(sigma), Impacts::new(rule)]),
        ("[`Geodesic`]", schemes![Geodesic::new(Quadrature::sigma(0.3)), Geodesic::midpoint()]),
    ]
}

fn degenerate() -> Vec<(&'static str, Schemes)> {
    vec![
        ("[`Sigma::midpoint`]", schemes![Sigma::<f64>::midpoint()]),
        ("[`Sigma::new`]", schemes![Sigma::new(0.3), Sigma::new(0.5)]),
        ("[`OneStep`]", schemes![OneStep::midpoint(), OneStep::trapezoid()]),
        (
            "[`OneStepGauss`]",
            schemes![
                OneStepGauss::<1>::new(),
                OneStepGauss::<2>::new(),
                OneStepGauss::<3>::new(),
                OneStepGauss::<4>::new(),
            ],
        ),
        ("[`Gauss`]", schemes![Gauss::<1>::new(), Gauss::<2>::new(), Gauss::<8>::new()]),
        ("[`Projected`]", schemes![Projected::symmetric()]),
        ("[`RungeKutta`]", schemes![RungeKutta::heun(), RungeKutta::classical()]),
    ]
}

fn word(form: PreservedForm, is_degenerate: bool) -> &'static str {
    match form {
        PreservedForm::Nothing => "nothing",
        PreservedForm::OmegaIfAffine if is_degenerate => "Ω if α is affine",
        PreservedForm::OmegaIfAffine | PreservedForm::Canonical => "dq ∧ dp",
        PreservedForm::Omega => "Ω",
        PreservedForm::Discrete => "a form on Q×Q",
        PreservedForm::Conjugate => "dq' ∧ dp",
        other => panic!("{other:?} has no word"),
    }
}

/// `1, 2` or, where more are in between, the first two and the last: `2, 4, …, 16`.
fn orders(schemes: &[Box<dyn Scheme>]) -> String {
    let orders: BTreeSet<usize> = schemes.iter().map(|scheme| scheme.order()).collect();
    match orders.iter().copied().collect::<Vec<_>>()[..] {
        [first, second, last] if last - second > second - first => format!("{first}, {second}, …, {last}"),
        _ => orders.iter().map(usize::to_string).collect::<Vec<_>>().join(", "),
    }
}

fn forms(schemes: &[Box<dyn Scheme>], is_degenerate: bool) -> String {
    let mut forms: Vec<_> =
        schemes.iter().map(|scheme| word(scheme.preserved_form(), is_degenerate)).collect();
    forms.dedup();
    forms.join(" or ")
}

#[test]
fn tables_of_methods_say_what_methods_say() {
    let text = read("methods.rs");
    let rows = rows(&text);
    let found = |first: &str, order: String, form: String| {
        rows.iter().any(|row| row[0].starts_with(first) && row[1] == order && row[2] == form)
    };
    for (group, is_degenerate) in [(regular(), false), (special(), false), (degenerate(), true)] {
        for (first, schemes) in group {
            let (order, form) = (orders(&schemes), forms(&schemes, is_degenerate));
            assert!(found(first, order.clone(), form.clone()), "| {first} | {order} | {form} |");
        }
    }
    let compositions: Schemes = schemes![
        Composition::suzuki(Variational::trapezoid()),
        Composition::kahan_li_6(Variational::trapezoid()),
        Composition::kahan_li_8(Variational::trapezoid()),
    ];
    assert!(found("[`Composition`]", orders(&compositions), "what it does".to_owned()));
}

#[test]
fn no_method_is_left_out() {
    let text = read("methods.rs");
    let rows = rows(&text);
    for file in files("methods") {
        let source = fs::read_to_string(file).expect("a file");
        for method in source.split(" Scheme for ").skip(1).filter_map(|rest| names(rest).next()) {
            let has_row = rows.iter().any(|row| names(row[0]).next() == Some(method));
            assert!(has_row, "{method} has no row on the page of the methods");
        }
    }
}
