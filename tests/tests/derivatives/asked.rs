//! What stands in a branch that is not taken, or in a sum without terms, need not be a number.

use dvi_core::prelude::*;

type Outcome = Result<(), String>;

/// ∂L/∂q with velocities of zero.
fn force<S: RegularLagrangian>(system: &S, q: &[f64]) -> Vec<f64> {
    let (v, mut l_q, mut l_v) = (vec![0.0; q.len()], vec![0.0; q.len()], vec![0.0; q.len()]);
    system.gradient(q, &v, 0.0, &mut l_q, &mut l_v);
    l_q
}

/// Each: a name, a potential, a point (x, u), and −∂V/∂x₀ there.
macro_rules! potentials {
    ($($name:ident: $potential:expr, $point:expr => $expected:expr;)*) => {
        $(
            #[lagrangian(
                coordinates(x[N], u),
                lagrangian = sum(0..N, |i| dot(x[i]).powi(2)) / 2 + dot(u).powi(2) / 2 - ($potential),
            )]
            struct $name<const N: usize>;
        )*

        #[test]
        fn forces_ask_for_no_more_than_the_formula() -> Outcome {
            $(
                let point: &[f64] = &$point;
                let found = match point.len() {
                    3 => force(&$name::<2>, point),
                    _ => force(&$name::<3>, point),
                };
                let (expected, rest): (f64, _) = ($expected, found.iter().all(|x| x.is_finite()));
                if (found[0] - expected).abs() > 1e-12 * (1.0 + expected.abs()) || !rest {
                    return Err(format!("{}: {found:?} instead of {expected}", stringify!($name)));
                }
            )*
            Ok(())
        }
    };
}

potentials! {
    TimesSum: u * sum(0..N, |i| if x[i] < 1e3 { x[i] } else { sum(0..N, |k| 1 / x[k]) }),
        [0.0, 1.0, 2.0] => -2.0;
    Squared: sum(0..N, |i| if u > 0.0 { x[i] * u } else { sum(0..N, |w| (x[w] + 10.0).sqrt()) }).powi(2),
        [-20.0, -20.0, -20.0, 1.0] => 120.0;
    UnderRoot: (sum(0..N, |i| if u < 5.0 { x[i] * x[i] } else { sum(0..N, |w| (x[w] + 10.0).sqrt()) }) + 1.0).sqrt(),
        [-20.0, -20.0, -20.0, 1.0] => 20.0 / 1201.0_f64.sqrt();
    Product: (sum(0..N, |i| if x[i] < 5.0 { x[i] * x[i] } else { product(0..N, |w| (x[w] + 10.0).ln()) }) + 1.0).sqrt(),
        [-20.0, -20.0, -20.0, 1.0] => 20.0 / 1201.0_f64.sqrt();
    Nested: sum(0..N, |j| sum(0..N, |i| if u > 0.0 { (x[i] - x[j]).powi(2) } else { sum(0..N, |k| 1 / x[k].powi(2)) }).sqrt()),
        [0.0, 1.0, 2.0] => 2.0;
    OfFactors: product(0..N, |i| if u < 5.0 { x[i] + 1.0 } else { sum(0..N, |w| (x[w] + 10.0).sqrt()) }),
        [-20.0, -20.0, 1.0] => 19.0;
    Empty: sum_pairs(0..N, |i, _j| (x[0] * x[0] + N as f64 - i as f64 - 1.5).sqrt() * u),
        [0.1, 1.0, 2.0] => -0.2 / 0.51_f64.sqrt();
}
