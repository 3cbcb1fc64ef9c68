//! Sums over pairs by the fast multipole method against the generated sums over all pairs.

#![allow(clippy::unwrap_used)]

mod limits;
mod regular;

use approx::abs_diff_eq;
use dvi_core::fast_sum::{FastSum, FastSumError};
use dvi_core::prelude::*;
use dvi_core::scalar::Lanes;
use dvi_core::{DegenerateLagrangian, Lagrangian, PairSum, System};

/// Vortices, with softened cores where `core` is not 0, in a flow of their own; with other numbers it is the
/// kernel ln(c + s r²).
#[degenerate_lagrangian(
    coordinates(x[gamma.len()], y[gamma.len()]),
    one_form = sum(0..gamma.len(), |j| gamma[j] * x[j] * d(y[j])),
    hamiltonian = shear * sum(0..gamma.len(), |j| gamma[j] * y[j].powi(2))
        - sum_pairs(0..gamma.len(), |j, k| gamma[j] * gamma[k]
            * (core + scale * ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2))).ln()) / (4.0 * PI),
    force(x) = |j| 0.1 * gamma[j] * y[j],
    momenta(impulse = sum(0..gamma.len(), |j| gamma[j] * x[j])),
)]
#[derive(Debug)]
struct Blobs {
    gamma: Vec<f64>,
    core: f64,
    scale: f64,
    shear: f64,
}

/// Bodies in space with momenta; differences the other way round.
#[degenerate_lagrangian(
    coordinates(x[n], y[n], z[n], px[n], py[n], pz[n]),
    one_form = sum(0..n, |j| px[j] * d(x[j]) + py[j] * d(y[j]) + pz[j] * d(z[j])),
    hamiltonian = sum(0..n, |j| (px[j].powi(2) + py[j].powi(2) + pz[j].powi(2)) / (2.0 * mass[j]))
        - g * sum_pairs(0..n, |j, k| mass[j] * mass[k]
            / ((x[k] - x[j]).powi(2) + (y[k] - y[j]).powi(2) + (z[k] - z[j]).powi(2) + core * core).sqrt()),
)]
#[derive(Debug)]
struct Gravity {
    n: usize,
    g: f64,
    mass: Vec<f64>,
    core: f64,
}

/// Charges that are screened, in the plane, all of them equal.
#[degenerate_lagrangian(
    coordinates(x[n], y[n]),
    one_form = sum(0..n, |j| x[j] * d(y[j])),
    hamiltonian = sum_pairs(0..n, |j, k| (-(x[j] - x[k]).hypot(y[j] - y[k]) / length).exp()),
)]
struct Screened {
    n: usize,
    length: f64,
}

/// Particles on a line that repel each other.
#[degenerate_lagrangian(
    coordinates(p[n], x[n]),
    one_form = sum(0..n, |j| p[j] * d(x[j])),
    hamiltonian = sum(0..n, |j| p[j].powi(2) / 2.0)
        + sum_pairs(0..n, |j, k| charge[j].powi(2) * charge[k].powi(2) / (1.0 + (x[j] - x[k]).powi(2))),
)]
struct OnALine {
    n: usize,
    charge: Vec<f64>,
}

/// Numbers in −1..1, the same on each run.
fn numbers(seed: u64) -> impl Iterator<Item = f64> {
    let mut state = seed;
    std::iter::repeat_with(move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    })
}

fn blobs(n: usize, core: f64) -> Blobs {
    let gamma = numbers(1).map(|number| (1.5 + number) / n as f64).take(n).collect();
    Blobs { gamma, core: core * core, scale: 1.0, shear: 0.3 }
}

/// Places in a square, near a line, and in clusters with the sizes 1, 1/8, 1/64 …
fn distributions(n: usize) -> [Vec<f64>; 3] {
    let square: Vec<f64> = numbers(2).take(2 * n).collect();
    let mut line = square.clone();
    (0..n).for_each(|j| line[n + j] = 0.1 * (3.0 * line[j]).sin() + 1e-6 * line[n + j]);
    let cluster = square.iter().enumerate().map(|(j, place)| {
        let number = (j % n % 5) as i32;
        place * 0.125_f64.powi(number) + f64::from(number)
    });
    [square.clone(), line, cluster.collect()]
}

/// The largest difference of two gradients relative to the root of the mean square.
fn apart(found: &[f64], expected: &[f64]) -> f64 {
    let square = |entries: &mut dyn Iterator<Item = f64>| entries.map(|entry| entry * entry).sum::<f64>();
    let differences = &mut found.iter().zip(expected).map(|(a, b)| a - b);
    (square(differences) / square(&mut expected.iter().copied())).sqrt()
}

/// Holds energy and gradient of fast sums against those of their system, to the tolerances.
fn compare<S, const D: usize>(system: &S, q: &[f64], tolerances: &[f64], case: &str)
where
    S: PairSum<f64, D> + PairSum<Lanes<8>, D> + DegenerateLagrangian + Sync,
{
    let [mut found, mut expected] = [vec![0.0; q.len()], vec![0.0; q.len()]];
    DegenerateLagrangian::<f64>::hamiltonian_gradient(system, q, 0.2, &mut expected);
    let expected_energy = DegenerateLagrangian::<f64>::hamiltonian(system, q, 0.2);
    for &tolerance in tolerances {
        let fast = FastSum::new(system, tolerance).unwrap();
        fast.hamiltonian_gradient(q, 0.2, &mut found);
        let (force, energy) =
            (apart(&found, &expected), (fast.hamiltonian(q, 0.2) / expected_energy - 1.0).abs());
        assert!(force < tolerance, "{case}, tolerance {tolerance:e}: forces {force:e}");
        assert!(energy < tolerance, "{case}, tolerance {tolerance:e}: energy {energy:e}");
    }
}

#[test]
fn forces_and_energies_are_those_of_all_pairs_to_the_tolerance() {
    for core in [0.0, 0.02, 0.5] {
        for (number, q) in distributions(3000).iter().enumerate() {
            let case = format!("core {core}, distribution {number}");
            compare::<_, 2>(&blobs(3000, core), q, &[1e-2, 1e-3, 1e-6, 1e-8, 1e-10], &case);
        }
    }
}

#[test]
fn in_space_and_on_a_line() {
    let n = 6000;
    for core in [0.0, 0.1] {
        let mass = numbers(3).map(|number| 1.5 + number).take(n).collect();
        let q: Vec<f64> = numbers(4).take(6 * n).collect();
        let case = format!("core {core}");
        compare::<_, 3>(&Gravity { n, g: 0.01, mass, core }, &q, &[1e-3, 1e-5], &case);
    }
    let n = 2000;
    let q: Vec<f64> = numbers(5).map(|number| 40.0 * number).take(2 * n).collect();
    compare::<_, 1>(&OnALine { n, charge: q.clone() }, &q, &[1e-8], "on a line");
    compare::<_, 2>(&Screened { n, length: 3.0 }, &q, &[1e-6], "screened");
}

/// With a coarse tolerance, so that another function than H̃ would be seen.
#[test]
fn forces_are_the_derivative_of_the_energy() {
    let n = 3000;
    let blobs = blobs(n, 1e-3);
    let fast = FastSum::<_, 2>::new(&blobs, 1e-2).unwrap();
    for q in distributions(n) {
        let mut gradient = vec![0.0; 2 * n];
        fast.hamiltonian_gradient(&q, 0.0, &mut gradient);
        // A force that is none of a potential is taken off.
        (0..n).for_each(|j| gradient[j] += 0.1 * blobs.gamma[j] * q[n + j]);
        let mut sizes: Vec<(f64, usize)> =
            gradient.iter().enumerate().map(|(i, entry)| (entry.abs(), i)).collect();
        sizes.sort_by(|a, b| b.0.total_cmp(&a.0));
        // Few bodies move, by so little that none leaves its cube.
        for &(_, i) in sizes.iter().step_by(2 * n / 20) {
            let step = 1e-7;
            let at = |by: f64| {
                let mut q = q.clone();
                q[i] += by * step;
                fast.hamiltonian(&q, 0.0)
            };
            let slope = (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * step);
            let energy = fast.hamiltonian(&q, 0.0);
            let rounding = 1e-15 * energy.abs() / step;
            assert!(
                abs_diff_eq!(slope, gradient[i], epsilon = 1e-6 * gradient[i].abs() + 30.0 * rounding),
                "{i}: {slope:e}, {:e}",
                gradient[i]
            );
        }
    }
}

#[test]
fn the_other_functions_are_those_of_the_system() {
    let n = 300;
    let blobs = blobs(n, 0.1);
    let fast = FastSum::<_, 2>::new(&blobs, 1e-10).unwrap();
    let q: Vec<f64> = numbers(6).take(2 * n).collect();
    let v: Vec<f64> = numbers(7).take(2 * n).collect();
    let close = |found: &[f64], expected: &[f64], what: &str| {
        let apart = apart(found, expected);
        assert!(apart < 1e-10, "{what}: {apart:e}");
    };
    close(&[fast.lagrangian(&q, &v, 0.0)], &[Lagrangian::<f64>::lagrangian(&blobs, &q, &v, 0.0)], "L");
    close(&[fast.energy(&q, &v, 0.0)], &[blobs.energy(&q, &v, 0.0)], "E");
    let empty = || vec![0.0; 2 * n];
    let [mut found, mut expected, mut found_v, mut expected_v] = [empty(), empty(), empty(), empty()];
    fast.gradient(&q, &v, 0.0, &mut found, &mut found_v);
    blobs.gradient(&q, &v, 0.0, &mut expected, &mut expected_v);
    close(&found, &expected, "∂L/∂q");
    assert_eq!(found_v, expected_v);
    fast.flow_source(&q, 0.0, &mut found);
    blobs.flow_source(&q, 0.0, &mut expected);
    close(&found, &expected, "the source of the flow");
    fast.applied_force(&q, &v, 0.0, &mut found);
    blobs.applied_force(&q, &v, 0.0, &mut expected);
    assert_eq!(found, expected);
    assert_eq!(fast.momentum(0, &q, &v, 0.0), blobs.momentum(0, &q, &v, 0.0));
}

#[test]
fn few_bodies_are_summed_one_by_one() {
    for n in [0, 1, 2, 7, 8, 9, 64] {
        let blobs = blobs(n, 0.1);
        let q: Vec<f64> = numbers(8).take(2 * n).collect();
        let fast = FastSum::<_, 2>::new(&blobs, 1e-2).unwrap();
        let [mut found, mut expected] = [vec![0.0; 2 * n], vec![0.0; 2 * n]];
        fast.hamiltonian_gradient(&q, 0.0, &mut found);
        blobs.hamiltonian_gradient(&q, 0.0, &mut expected);
        for (found, expected) in found.iter().zip(&expected) {
            assert!(abs_diff_eq!(found, expected, epsilon = 1e-14), "{n}: {found:e}, {expected:e}");
        }
    }
}

/// Bodies at one place, far away, at powers of two, and moved all together.
#[test]
fn odd_places() {
    let n = 500;
    let soft = blobs(n, 0.1);
    let places: Vec<f64> = numbers(9).take(2 * n).collect();
    let at_one_place = vec![0.7; 2 * n];
    let on_edges: Vec<f64> = places.iter().map(|place| (place * 8.0).round() / 8.0).collect();
    let far: Vec<f64> = places.iter().map(|place| place + 1e6).collect();
    let spread: Vec<f64> =
        places.iter().enumerate().map(|(i, place)| place * 10.0_f64.powi(i as i32 % 13 - 6)).collect();
    for (q, case) in
        [(at_one_place, "at one place"), (on_edges, "on edges"), (far, "far away"), (spread, "spread")]
    {
        compare::<_, 2>(&soft, &q, &[1e-8], case);
    }
}

#[test]
fn places_that_are_no_numbers_give_no_numbers() {
    let n = 100;
    let blobs = blobs(n, 0.0);
    let fast = FastSum::<_, 2>::new(&blobs, 1e-6).unwrap();
    let good: Vec<f64> = numbers(10).take(2 * n).collect();
    for bad in [f64::NAN, f64::INFINITY, -f64::INFINITY, 1e300] {
        let mut q = good.clone();
        q[5] = bad;
        let mut gradient = vec![0.0; 2 * n];
        fast.hamiltonian_gradient(&q, 0.0, &mut gradient);
        assert!(gradient.iter().any(|entry| entry.is_nan()), "{bad}");
        assert!(fast.hamiltonian(&q, 0.0).is_nan(), "{bad}");
        // Nothing of it is left.
        fast.hamiltonian_gradient(&good, 0.0, &mut gradient);
        assert!(gradient.iter().all(|entry| entry.is_finite()));
    }
    // Two bodies at one place, as in a sum over all pairs.
    let mut q = good;
    (q[1], q[n + 1]) = (q[0], q[n]);
    let mut gradient = vec![0.0; 2 * n];
    fast.hamiltonian_gradient(&q, 0.0, &mut gradient);
    assert!(!gradient[0].is_finite() && !gradient[1].is_finite() && gradient[2].is_finite());
}

#[test]
fn evaluations_do_not_depend_on_those_before() {
    let n = 2000;
    let blobs = blobs(n, 0.0);
    let bits = |q: &[f64], before: &[&[f64]]| {
        let fast = FastSum::<_, 2>::new(&blobs, 1e-6).unwrap();
        let mut gradient = vec![0.0; 2 * n];
        before.iter().for_each(|q| fast.hamiltonian_gradient(q, 0.0, &mut gradient));
        fast.hamiltonian_gradient(q, 0.0, &mut gradient);
        gradient.push(fast.hamiltonian(q, 0.0));
        gradient.iter().map(|entry| entry.to_bits()).collect::<Vec<_>>()
    };
    let [square, line, cluster] = distributions(n);
    assert_eq!(bits(&square, &[]), bits(&square, &[&line, &cluster, &square]));
}

/// The forces on many bodies and their energy, bit for bit.
#[cfg(feature = "threads")]
#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let n = 3000;
    let blobs = blobs(n, 0.01);
    for q in distributions(n) {
        let bits = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let fast = FastSum::<_, 2>::new(&blobs, 1e-6).unwrap();
                let mut gradient = vec![0.0; 2 * n];
                fast.hamiltonian_gradient(&q, 0.0, &mut gradient);
                gradient.push(fast.hamiltonian(&q, 0.0));
                gradient.iter().map(|entry| entry.to_bits()).collect::<Vec<_>>()
            })
        };
        let alone = bits(1);
        for threads in [2, 3, 5, 16] {
            assert!(bits(threads) == alone, "{threads} threads");
        }
    }
}

#[test]
fn many_bodies_take_far_fewer_operations_than_all_pairs() {
    let operations = |n: usize| {
        let q = &distributions(n)[0];
        let state = BlobsState { x: q[..n].to_vec(), y: q[n..].to_vec() };
        FastSum::<_, 2>::new(&blobs(n, 0.1), 1e-6).unwrap().operations(&state).unwrap()
    };
    let few = operations(50);
    assert_eq!((few.pairs, few.products), (50 * 49, 0));
    // Four times as many bodies in the same square: the cubes are divided once more.
    let [some, many] = [operations(8000), operations(32_000)].map(|all| (all.pairs + all.products) as f64);
    assert!(many < 5.0 * some, "{some} {many}");
    assert!(many < 0.1 * 32_000.0_f64.powi(2), "{many}");
    let mut nowhere = BlobsState { x: vec![0.0; 3], y: vec![0.0; 3] };
    nowhere.x[1] = f64::NAN;
    let operations = FastSum::<_, 2>::new(&blobs(3, 0.1), 1e-6).unwrap().operations(&nowhere).unwrap();
    assert_eq!((operations.pairs, operations.products), (0, 0));
}

#[test]
fn runs_conserve_the_energy_and_go_on_from_checkpoints() {
    let n = 600;
    let blobs = Blobs { shear: 0.0, ..blobs(n, 0.05) };
    let [_, line, _] = distributions(n);
    let start = BlobsState { x: line[..n].to_vec(), y: line[n..].to_vec() };
    let fast = FastSum::<_, 2>::new(&blobs, 1e-8).unwrap();
    assert_eq!(fast.names().count(), 2 * n);
    for step in [0.02, -0.02] {
        let mut run = Integrator::new(&fast, Gauss::<2>::new(), step, start.clone()).unwrap();
        let mut exact = Integrator::new(&blobs, Gauss::<2>::new(), step, start.clone()).unwrap();
        run.take_steps(20).unwrap();
        let checkpoint = run.checkpoint();
        run.take_steps(20).unwrap();
        exact.take_steps(40).unwrap();
        let (found, expected) = (run.state(), exact.state());
        for (a, b) in found.x.iter().zip(&expected.x) {
            assert!(abs_diff_eq!(a, b, epsilon = 1e-7), "{a} {b}");
        }
        run = Integrator::resume(&fast, Gauss::<2>::new(), &checkpoint).unwrap();
        run.take_steps(20).unwrap();
        assert_eq!(run.state().x, found.x);
    }
    let error = fast.measured_error(&start, 50).unwrap();
    assert!(error > 0.0 && error < 1e-8, "{error:e}");
}

#[test]
fn steps_are_solved_as_far_as_forces_are_known() {
    let n = 1000;
    let blobs = Blobs { shear: 0.0, ..blobs(n, 0.02) };
    let q = &distributions(n)[0];
    let start = BlobsState { x: q[..n].to_vec(), y: q[n..].to_vec() };
    let fast = FastSum::<_, 2>::new(&blobs, 1e-6).unwrap();
    let evaluations = |stopping: Stopping| {
        let method = Gauss::<2> { stopping, ..Gauss::new() };
        let mut run = Integrator::new(&fast, method, 0.05, start.clone()).unwrap();
        run.take_steps(30).map(|()| run.statistics().gradients)
    };
    let some = evaluations(Stopping { tolerance: 1e-7, ..Stopping::default() }).unwrap();
    // To rounding errors: many more, or an iteration that does not end.
    let most = evaluations(Stopping::default());
    assert!(some < 30 * 20, "{some}");
    assert!(most.is_err() || most.is_ok_and(|most| most > 2 * some), "{some} {most:?}");
}

#[test]
fn tolerances_out_of_range_are_errors() {
    let blobs = blobs(3, 0.0);
    for tolerance in [0.0, -1.0, 1e-11, 0.1, f64::NAN, f64::INFINITY] {
        let Err(error @ FastSumError::Tolerance { tolerance: found, .. }) =
            FastSum::<_, 2>::new(&blobs, tolerance)
        else {
            panic!("{tolerance:e} is taken");
        };
        assert_eq!(found.to_bits(), tolerance.to_bits());
        assert!(error.to_string().contains("between 1e-10 and 1e-2"), "{error}");
    }
}
