//! Loops that run over packs of eight terms: for every number of terms, and so for every number that is
//! left over, numbers in lanes, whose terms are taken one by one, get what each of them gets alone, bit for
//! bit. What is added to which entry is held by the oracle of `dvi-macros`, in chunks of two.

mod neighbours;

use dvi_core::Varied;
use dvi_core::prelude::*;
use dvi_core::scalar::Lanes;
use dvi_examples::models::{VortexBlobs, VortexBlobsState};
use dvi_tests::{Outcome, bits};

use crate::together::same_as_alone;

const SIZES: core::ops::Range<usize> = 1..45;
pub(crate) const W: usize = 3;

/// A number between −1 and 1 that depends on `seed` in no simple way.
fn number(seed: usize) -> f64 {
    (1.7 * seed as f64 + 0.3).sin() * (0.37 * (seed * seed) as f64).cos()
}

fn numbers(count: usize, seed: usize) -> Vec<f64> {
    (0..count).map(|j| number(1000 * seed + j)).collect()
}

/// Compares what `together` sets its output to at a point and a time with what `alone` does in each lane,
/// bit for bit.
#[track_caller]
pub(crate) fn lanes_agree(
    q: &[f64],
    together: impl Fn(&[Lanes<W>], Lanes<W>, &mut [Lanes<W>]),
    alone: impl Fn(&[f64], f64, &mut [f64]),
) {
    let moved = |lane: usize, i: usize| q[i] * (1.0 + 0.01 * lane as f64) + 0.02 * (lane * i) as f64;
    let packs: Vec<_> = (0..q.len()).map(|i| Lanes(core::array::from_fn(|lane| moved(lane, i)))).collect();
    let times = Lanes(core::array::from_fn(|lane| 0.3 + 0.1 * lane as f64));
    let mut found = vec![Lanes::all(0.0); q.len()];
    together(&packs, times, &mut found);
    for lane in 0..W {
        let point: Vec<f64> = (0..q.len()).map(|i| moved(lane, i)).collect();
        let mut expected = vec![0.0; q.len()];
        alone(&point, times.0[lane], &mut expected);
        let found: Vec<f64> = found.iter().map(|pack| pack.0[lane]).collect();
        assert_eq!(bits(&found), bits(&expected), "lane {lane}: {found:?}, alone {expected:?}");
    }
}

/// The same of ∇H.
fn gradients_agree(system: &(impl DegenerateLagrangian + DegenerateLagrangian<Lanes<W>>), q: &[f64]) {
    lanes_agree(
        q,
        |q, t, out| system.hamiltonian_gradient(q, t, out),
        |q, t, out| system.hamiltonian_gradient(q, t, out),
    );
}

#[test]
fn pairs_of_vortices() {
    for n in SIZES {
        gradients_agree(&VortexBlobs { gamma: numbers(n, 1), core: 0.1 }, &numbers(2 * n, 2));
    }
}

/// Masses in space that attract each other; of the generic type are the masses, integers the charges.
#[lagrangian(
    coordinates(x[m.len()], y[m.len()], z[m.len()]),
    lagrangian = sum(0..m.len(), |j| m[j] * (dot(x[j]).powi(2) + dot(y[j]).powi(2) + dot(z[j]).powi(2)) / 2.0)
        + sum_pairs(0..m.len(), |i, j| (m[i] * m[j] - charge[i] * charge[j])
            / ((x[i] - x[j]).powi(2) + (y[i] - y[j]).powi(2) + (z[i] - z[j]).powi(2) + softening * softening).sqrt()),
)]
struct Bodies<P = f64> {
    m: Box<[P]>,
    charge: Vec<i32>,
    softening: f64,
}

#[test]
fn forces_between_bodies() {
    for n in SIZES {
        let m = numbers(n, 3).into_iter().map(|m| 1.5 + m).collect();
        let system = Bodies { m, charge: (0..n).map(|j| (j % 5) as i32 - 2).collect(), softening: 0.1 };
        let q = numbers(3 * n, 4);
        lanes_agree(&q, |q, t, out| system.force(q, &[], t, out), |q, t, out| system.force(q, &[], t, out));
    }
}

#[test]
fn forces_between_bodies_with_masses_in_lanes() {
    for n in SIZES {
        let mass = |j: usize, lane: usize| 1.0 + 0.1 * (j + lane) as f64;
        let masses = (0..n).map(|j| Varied(Lanes::<W>(core::array::from_fn(|lane| mass(j, lane)))));
        let together = Bodies { m: masses.collect(), charge: vec![1; n], softening: 0.1 };
        let q = numbers(3 * n, 6);
        let packs: Vec<_> = q.iter().map(|q| Lanes::<W>::all(*q)).collect();
        let [mut found, mut momentum] = [vec![Lanes::<W>::all(0.0); 3 * n], vec![Lanes::all(0.0); 3 * n]];
        together.gradient(&packs, &packs, Lanes::all(0.0), &mut found, &mut momentum);
        for lane in 0..W {
            let alone =
                Bodies { m: (0..n).map(|j| mass(j, lane)).collect(), charge: vec![1; n], softening: 0.1 };
            let [mut expected, mut momentum] = [vec![0.0; 3 * n], vec![0.0; 3 * n]];
            alone.gradient(&q, &q, 0.0, &mut expected, &mut momentum);
            let same = found.iter().zip(&expected).all(|(pack, x)| pack.0[lane].to_bits() == x.to_bits());
            assert!(same, "{n} bodies, lane {lane}");
        }
    }
}

/// One sum, with neighbours: entries beside that of the index, and parameters that begin elsewhere.
#[degenerate_lagrangian(
    coordinates(x[n], y[n]),
    one_form = sum(0..n, |j| y[j] * d(x[j])),
    hamiltonian = sum(0..n, |j| (k[j + 2] * x[j] * x[j] + y[j] * y[j]) / 2.0) * sum(1..n, |j| x[j] * y[j - 1]),
)]
struct Products<'a> {
    n: usize,
    k: &'a [f32],
}

#[test]
fn sums_with_neighbours() {
    let k: Vec<f32> = numbers(SIZES.end + 2, 7).into_iter().map(|k| k as f32 + 2.0).collect();
    for n in SIZES {
        gradients_agree(&Products { n, k: &k }, &numbers(2 * n, 8));
    }
}

/// A number of terms that the compiler knows.
#[degenerate_lagrangian(
    coordinates(x[N], y[N]),
    one_form = sum(0..N, |j| gamma[j] * y[j] * d(x[j])),
    hamiltonian = sum_pairs(0..N, |i, j| gamma[i] * gamma[j] / (4.0 * PI)
        * ((x[i] - x[j]).powi(2) + (y[i] - y[j]).powi(2) + 0.01).ln()),
)]
struct FixedSize<P: Copy, const N: usize> {
    gamma: [P; N],
}

#[test]
fn pairs_of_a_number_that_the_compiler_knows() {
    fn check<const N: usize>() {
        let system = FixedSize::<f64, N> { gamma: core::array::from_fn(|j| number(j + 17)) };
        gradients_agree(&system, &numbers(2 * N, 9));
    }
    check::<1>();
    check::<8>();
    check::<9>();
    check::<16>();
    check::<17>();
    check::<31>();
    check::<33>();
}

/// A run of many vortices is the same alone and in lanes, step by step.
#[test]
fn runs_of_many_vortices() -> Outcome {
    let n = 21;
    let gamma = numbers(n, 1).into_iter().map(|gamma| 1.2 + gamma).collect();
    let system = VortexBlobs { gamma, core: 0.1 };
    let places = |seed| VortexBlobsState { x: numbers(n, seed), y: numbers(n, seed + 1) };
    let runs: Vec<_> = (0..W).map(|j| (&system, places(10 * j))).collect();
    let errors = same_as_alone::<W, _, _>(&runs, &Sigma::midpoint(), 0.01, &[50])?;
    assert!(errors.iter().all(Option::is_none), "{errors:?}");
    Ok(())
}
