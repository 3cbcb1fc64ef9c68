//! Gauss collocation where no fixed point contracts, by Newton's method: against closed forms of its steps.

use approx::{abs_diff_eq, relative_eq};
use dvi_core::methods::Method;
use dvi_core::prelude::*;
use dvi_core::{Lagrangian, Real};
use dvi_tests::Outcome;
use dvi_tests::apart;
use num_dual::{Dual2_64, Dual64};

/// By what angle a step turns the oscillator of frequency ω, z = ωh: that of the diagonal Padé approximant
/// N(iz)/N(−iz) of e^(iz) (Hairer & Wanner 1996, theorem IV.3.12).
fn angle(stages: usize, z: f64) -> f64 {
    let (mut term, mut numerator) = (1.0, [0.0; 2]);
    for k in 0..=stages {
        numerator[k % 2] += if k % 4 < 2 { term } else { -term };
        term *= z * ((stages - k) as f64 / ((2 * stages - k) as f64 * (k + 1) as f64));
    }
    2.0 * f64::atan2(numerator[1], numerator[0])
}

/// With so many stages.
macro_rules! each {
    ($($stages:literal)*; |$count:ident, $method:ident| $body:expr) => {$({
        let ($count, $method) = ($stages, Gauss::<$stages>::new());
        $body;
    })*};
}

/// Masses between two walls, with springs of length zero between neighbours.
#[lagrangian(
    coordinates(x[N]),
    lagrangian = sum(0..N, |j| dot(x[j]).powi(2)) / 2.0 - k * (x[0].powi(2) + x[N - 1].powi(2)) / 2.0
        - k * sum(1..N, |j| (x[j] - x[j - 1]).powi(2)) / 2.0,
)]
struct Chain<const N: usize> {
    k: f64,
}

/// The same, as long as the run says, and as p dq − H.
#[degenerate_lagrangian(
    coordinates(x[n], p[n]),
    one_form = sum(0..n, |j| p[j] * d(x[j])),
    hamiltonian = sum(0..n, |j| p[j].powi(2)) / 2.0 + k * (x[0].powi(2) + x[n - 1].powi(2)) / 2.0
        + k * sum(1..n, |j| (x[j] - x[j - 1]).powi(2)) / 2.0,
)]
struct LongChain {
    n: usize,
    k: f64,
}

/// Where the masses are after steps of so many stages, by modes: sin(π(l + 1)(j + 1)/(n + 1)) has the
/// frequency 2√k sin(π(l + 1)/(2(n + 1))).
fn by_modes(stages: usize, k: f64, h: f64, steps: u64, start: &[f64]) -> Vec<f64> {
    let n = start.len();
    let wave =
        |l: usize, j: usize| (core::f64::consts::PI * ((l + 1) * (j + 1)) as f64 / (n + 1) as f64).sin();
    let mut end = vec![0.0; n];
    for l in 0..n {
        let frequency =
            2.0 * k.sqrt() * (core::f64::consts::PI * (l + 1) as f64 / (2 * (n + 1)) as f64).sin();
        let share: f64 = (0..n).map(|j| wave(l, j) * start[j]).sum::<f64>() * 2.0 / (n + 1) as f64;
        let now = share * (steps as f64 * angle(stages, frequency * h)).cos();
        (0..n).for_each(|j| end[j] += now * wave(l, j));
    }
    end
}

#[test]
fn stiff_chains_follow_their_modes() -> Outcome {
    fn check<S: Lagrangian, M: Method<S, f64>>(
        system: &S,
        method: M,
        start: S::State<f64>,
        expected: &[f64],
    ) -> Outcome {
        let mut run = Integrator::new(system, method, 0.5, start)?;
        run.take_steps(10)?;
        let off = apart(run.q(), expected);
        assert!(off < 1e-11, "{}: {off:e}", S::REPORT.system);
        assert!(run.statistics().factorisations > 0, "{}", S::REPORT.system);
        Ok(())
    }
    let k = 1e5;
    let x = [0.3, -0.1, 0.2];
    let long: Vec<f64> = (0..8).map(|j| 0.3 * f64::from(j * j).sin()).collect();
    each!(1 8; |stages, method| {
        let start = ChainState { x, dot_x: [0.0; 3] };
        check(&Chain::<3> { k }, method, start, &by_modes(stages, k, 0.5, 10, &x))?;
        for solver in [Solver::Automatic, Solver::Newton] {
            let start = LongChainState { x: long.clone(), p: vec![0.0; long.len()] };
            let chain = LongChain { n: long.len(), k };
            let method = Gauss { solver, ..method };
            check(&chain, method, start, &by_modes(stages, k, 0.5, 10, &long))?;
        }
    });
    Ok(())
}

/// α is curved, and in p = y + y³/3 the motion is that of the oscillator.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = (y + y.powi(3) / 3.0) * d(x),
    hamiltonian = k * (x * x / 2.0 + (y + y.powi(3) / 3.0).powi(2) / 2.0),
)]
struct Curved {
    k: f64,
}

/// By the length of the steps, once and twice, against differences of fourth order.
#[test]
fn derivatives_of_stiff_steps_converge() -> Outcome {
    fn after<T: Real, M: Method<Curved, T>>(method: M, h: T) -> Outcome<T> {
        let start = CurvedStateOf { x: T::lift(0.3), y: T::lift(-0.2) };
        let mut run = Integrator::new(&Curved { k: 60.0 }, method, h, start)?;
        run.take_steps(3)?;
        Ok(run.state().x)
    }
    let (h, d) = (0.1, 1e-5);
    let slope = |[a, b, c, d]: [f64; 4], by: f64| (a - 8.0 * b + 8.0 * c - d) / (12.0 * by);
    let method = Gauss::<4>::new();
    let around = [h - 2.0 * d, h - d, h + d, h + 2.0 * d];
    let (mut values, mut slopes) = ([0.0; 4], [0.0; 4]);
    for (i, h) in around.into_iter().enumerate() {
        values[i] = after(method, h)?;
        slopes[i] = after(method, Dual64::new(h, 1.0))?.eps;
    }
    let (once, twice) = (after(method, Dual64::new(h, 1.0))?, after(method, Dual2_64::new(h, 1.0, 0.0))?);
    let [by_steps, of_slopes] = [slope(values, d), slope(slopes, d)];
    assert!(abs_diff_eq!(once.re, after(method, h)?, epsilon = 1e-13));
    assert!(relative_eq!(once.eps, by_steps, epsilon = 0.0, max_relative = 1e-8), "{once}, {by_steps}");
    assert!(relative_eq!(twice.v1, once.eps, epsilon = 0.0, max_relative = 1e-12), "{twice}, {once}");
    assert!(relative_eq!(twice.v2, of_slopes, epsilon = 0.0, max_relative = 1e-8), "{twice}, {of_slopes}");
    Ok(())
}
