//! Places in a square lattice, whose numbers are products of the side and an index.

use approx::assert_abs_diff_eq;
use dvi_core::prelude::*;
use dvi_tests::Outcome;

/// The φ⁴ lattice on a torus, with a side that is written as the system has it.
macro_rules! lattice {
    ($name:ident [$($generics:tt)*] $side:expr, { $($field:ident: $type:ty),* }) => {
        #[lagrangian(
            coordinates(q[$side * $side]),
            lagrangian = sum(0..$side, |i| sum(0..$side, |j| dot(q[$side * i + j]).powi(2) / 2.0
                - (at(i + 1, j) - at(i, j)).powi(2) / 2.0 - (at(i, j + 1) - at(i, j)).powi(2) / 2.0
                - k[$side * i + j] * at(i, j).powi(4) / 4.0)),
            momenta(p = sum(0..$side * $side, |site| dot(q[site]))),
            let = { let at = |i, j| q[$side * (i % $side) + j % $side]; },
        )]
        struct $name<$($generics)*> { $($field: $type,)* k: Vec<f64> }
    };
}

lattice!(Literal [] 4, {});
lattice!(Constant [const N: usize] N, {});
lattice!(RunTime [] n, { n: usize });

const SIDE: usize = 4;

fn entries(of: fn(f64) -> f64) -> Vec<f64> {
    (0..SIDE * SIDE).map(|site| of(site as f64)).collect()
}

/// The acceleration of each site, its neighbours written out.
fn acceleration(q: &[f64], k: &[f64]) -> Vec<f64> {
    let site = |i: usize, j: usize| q[SIDE * (i % SIDE) + j % SIDE];
    let of = |i: usize, j: usize| {
        let neighbours = site(i + 1, j) + site(i + SIDE - 1, j) + site(i, j + 1) + site(i, j + SIDE - 1);
        neighbours - 4.0 * site(i, j) - k[SIDE * i + j] * site(i, j).powi(3)
    };
    (0..SIDE * SIDE).map(|place| of(place / SIDE, place % SIDE)).collect()
}

#[test]
fn a_square_lattice_moves_as_it_does_by_hand() -> Outcome {
    let k = entries(|site| 1.0 + (0.7 * site).sin() / 2.0);
    let (mut q, mut v) = (entries(|site| (1.3 * site).sin()), entries(|site| (2.1 * site).cos() / 2.0));
    let (h, steps) = (0.05, 200);
    let (first, dot_first) = (q.clone(), v.clone());
    for _ in 0..steps {
        v.iter_mut().zip(acceleration(&q, &k)).for_each(|(v, a)| *v += h / 2.0 * a);
        q.iter_mut().zip(&v).for_each(|(q, v)| *q += h * v);
        v.iter_mut().zip(acceleration(&q, &k)).for_each(|(v, a)| *v += h / 2.0 * a);
    }

    let constant = Constant::<SIDE> { k: k.clone() };
    let start = ConstantState { q: first.clone(), dot_q: dot_first.clone() };
    let mut run = Integrator::new(&constant, Variational::trapezoid(), h, start)?;
    run.take_steps(steps)?;
    assert_abs_diff_eq!(run.state().q.as_slice(), q.as_slice(), epsilon = 1e-11);

    let run_time = RunTime { n: SIDE, k: k.clone() };
    let start = RunTimeState { q: first.clone(), dot_q: dot_first.clone() };
    let mut other = Integrator::new(&run_time, Variational::trapezoid(), h, start)?;
    other.take_steps(steps)?;
    assert_eq!(other.state().q, run.state().q);

    let literal = Literal { k };
    let [q, dot_q] =
        [first, dot_first].map(|entries| <[f64; SIDE * SIDE]>::try_from(entries).expect("all sites"));
    let mut fixed = Integrator::new(&literal, Variational::trapezoid(), h, LiteralState { q, dot_q })?;
    fixed.take_steps(steps)?;
    assert_abs_diff_eq!(fixed.state().q.as_slice(), run.state().q.as_slice(), epsilon = 1e-12);
    Ok(())
}

#[test]
fn what_does_not_fit_into_the_square_is_said_where_a_run_begins() {
    let short = RunTime { n: 3, k: vec![1.0; 8] };
    let start = RunTimeState { q: vec![0.1; 9], dot_q: vec![0.0; 9] };
    let error =
        Integrator::new(&short, Variational::trapezoid(), 0.1, start).map(|_| ()).expect_err("8 of 9");
    let StartError::Index(error) = error else { panic!("{error}") };
    assert_eq!((error.array, error.index, error.len), ("k", 8, 8));
}
