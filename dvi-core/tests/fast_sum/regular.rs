//! Sums over pairs in regular Lagrangians.

use dvi_core::fast_sum::FastSum;
use dvi_core::methods::Method;
use dvi_core::prelude::*;
use dvi_core::{Lagrangian, NondegenerateLagrangian, Sink, Weights};

use crate::{apart, numbers};

/// Stars that attract each other, in a field that grows, with friction.
#[lagrangian(
    coordinates(x[mass.len()], y[mass.len()], z[mass.len()]),
    lagrangian = sum(0..mass.len(), |j| mass[j] / 2.0 * (dot(x[j]).powi(2) + dot(y[j]).powi(2) + dot(z[j]).powi(2)))
        - t * field * sum(0..mass.len(), |j| mass[j] * z[j])
        + g * sum_pairs(0..mass.len(), |j, k| mass[j] * mass[k]
            / ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2) + (z[j] - z[k]).powi(2) + core.powi(2)).sqrt()),
    force(y) = |j| -friction * dot(y[j]),
)]
struct Stars {
    mass: Vec<f64>,
    g: f64,
    core: f64,
    field: f64,
    friction: f64,
}

/// Charges on rods: what a charge weighs depends on where it is.
#[lagrangian(
    coordinates(x[n], y[n]),
    lagrangian = sum(0..n, |j| (1.0 + x[j].powi(2)) * dot(x[j]).powi(2) / 2.0 + dot(y[j]).powi(2) / 2.0 + dot(x[j]) * y[j])
        - sum_pairs(0..n, |j, k| charge[j] * charge[k] / ((x[j] - x[k]).hypot(y[j] - y[k]) + 0.1)),
)]
struct Charges {
    n: usize,
    charge: Vec<f64>,
}

/// Stars of mass 1 in a plane.
#[lagrangian(
    coordinates(x[n], y[n]),
    lagrangian = sum(0..n, |j| dot(x[j]).powi(2) + dot(y[j]).powi(2)) / 2.0
        + g * sum_pairs(0..n, |j, k| 1.0 / ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2) + 0.01).sqrt()),
)]
struct Disc {
    n: usize,
    g: f64,
}

fn stars(n: usize) -> Stars {
    let mass = numbers(1).map(|number| (1.5 + number) / n as f64).take(n).collect();
    Stars { mass, g: 0.5, core: 0.2, field: 0.3, friction: 0.1 }
}

/// Forces, energies and derivatives at a point and velocity, beside those of the system.
fn compare<const D: usize, S>(system: &S, tolerance: f64)
where
    S: dvi_core::PairSum<f64, D>
        + dvi_core::PairSum<dvi_core::scalar::Lanes<8>, D>
        + NondegenerateLagrangian<f64>
        + Sync,
{
    let fast = FastSum::<_, D>::new(system, tolerance).unwrap();
    let size = dvi_core::PairSum::<f64, D>::bodies(system) * D;
    let q: Vec<f64> = numbers(2).take(size).collect();
    let v: Vec<f64> = numbers(3).take(size).collect();
    let t = 0.7;
    let close = |found: &[f64], expected: &[f64], what: &str| {
        let apart = apart(found, expected);
        assert!(apart < tolerance, "{what}: {apart:e}");
    };
    close(&[fast.lagrangian(&q, &v, t)], &[system.lagrangian(&q, &v, t)], "L");
    close(&[fast.energy(&q, &v, t)], &[system.energy(&q, &v, t)], "E");
    let zeros = || vec![0.0; size];
    let (mut found, mut expected) = (zeros(), zeros());
    fast.force(&q, &v, t, &mut found);
    system.force(&q, &v, t, &mut expected);
    close(&found, &expected, "the force");
    fast.momentum_rate(&q, &v, t, &mut found);
    system.momentum_rate(&q, &v, t, &mut expected);
    assert_eq!(found, expected);
    let (mut found_v, mut expected_v) = (zeros(), zeros());
    fast.gradient(&q, &v, t, &mut found, &mut found_v);
    system.gradient(&q, &v, t, &mut expected, &mut expected_v);
    close(&found, &expected, "∂L/∂q");
    assert_eq!(found_v, expected_v);
    for qq in [0.0, 0.5] {
        let weights = Weights { qq, qv: 2.0, vq: -1.0, vv: 3.0 };
        let (mut sink, mut other) = (Entries::default(), Entries::default());
        let (mut l_q, mut l_v) = (zeros(), zeros());
        fast.linearize(&q, &v, t, weights, &mut l_q, &mut l_v, &mut sink);
        system.linearize(&q, &v, t, weights, &mut expected, &mut expected_v, &mut other);
        close(&l_q, &expected, "∂L/∂q with second derivatives");
        assert_eq!(l_v, expected_v);
        let all = |entries: &Entries| {
            let mut matrix = vec![0.0; size * size];
            entries.0.iter().for_each(|(row, column, value)| matrix[row * size + column] += value);
            matrix
        };
        close(&all(&sink), &all(&other), "the second derivatives");
    }
}

/// Entries of a matrix, in their order.
#[derive(Default)]
struct Entries(Vec<(usize, usize, f64)>);

impl Sink<f64> for Entries {
    fn add(&mut self, row: usize, column: usize, value: f64) {
        self.0.push((row, column, value));
    }
}

#[test]
fn functions_are_those_of_the_system() {
    compare::<3, _>(&stars(400), 1e-6);
    let n = 300;
    compare::<2, _>(&Charges { n, charge: numbers(4).map(|number| 1.5 + number).take(n).collect() }, 1e-8);
}

fn start(n: usize) -> StarsState {
    let some = |seed| numbers(seed).take(n).collect();
    let slow = |seed| numbers(seed).map(|number| 0.1 * number).take(n).collect();
    StarsState { x: some(5), y: some(6), z: some(7), dot_x: slow(8), dot_y: slow(9), dot_z: slow(10) }
}

/// Where the stars of a disc are after some steps, by the fast sum and by the sum over all pairs.
fn same_course<'s, M>(disc: &'s Disc, fast: &'s FastSum<'s, Disc, 2>, method: M)
where
    M: Method<FastSum<'s, Disc, 2>, f64> + Method<Disc, f64> + Copy,
{
    let some = |seed| numbers(seed).take(disc.n).collect();
    let start = DiscState { x: some(5), y: some(6), dot_x: some(7), dot_y: some(8) };
    let mut run = Integrator::new(fast, method, 0.02, start.clone()).unwrap();
    let mut exact = Integrator::new(disc, method, 0.02, start).unwrap();
    run.take_steps(10).unwrap();
    exact.take_steps(10).unwrap();
    let (found, expected) = (run.state(), exact.state());
    for (found, expected) in [(&found.x, &expected.x), (&found.dot_y, &expected.dot_y)] {
        let apart = apart(found, expected);
        assert!(apart > 0.0 && apart < 1e-8, "{apart:e}");
    }
}

#[test]
fn methods_for_regular_systems_take_them() {
    /// That it compiles is enough: a step asks for nothing but the functions that are compared above.
    fn takes<M: for<'s> Method<FastSum<'s, Disc, 2>, f64>>(_: M) {}
    takes(Galerkin::<3>::new());
    let n = 300;
    let disc = Disc { n, g: 1.0 / n as f64 };
    let fast = FastSum::new(&disc, 1e-8).unwrap();
    let stopping = Stopping { tolerance: 1e-10, ..Stopping::default() };
    same_course(&disc, &fast, Composition::kahan_li_8(Variational::trapezoid()));
    same_course(&disc, &fast, Gauss::<2> { stopping, ..Gauss::new() });
    same_course(&disc, &fast, RungeKutta::classical());
    for beta in [0.0, 0.25] {
        same_course(&disc, &fast, Newmark { stopping, ..Newmark::new(beta) });
    }
}

/// With all second derivatives: those of the sum over all pairs.
#[test]
fn newton_steps_of_systems_without_a_constant_mass() {
    let n = 70;
    let charges = Charges { n, charge: numbers(4).map(|number| 0.2 + 0.1 * number).take(n).collect() };
    let some = |seed| numbers(seed).take(n).collect();
    let start = ChargesState { x: some(5), y: some(6), dot_x: some(7), dot_y: some(8) };
    let fast = FastSum::<_, 2>::new(&charges, 1e-8).unwrap();
    let stopping = Stopping { tolerance: 1e-10, ..Stopping::default() };
    let method = Variational { stopping, ..Variational::midpoint() };
    let mut run = Integrator::new(&fast, method, 0.02, start.clone()).unwrap();
    let mut exact = Integrator::new(&charges, method, 0.02, start).unwrap();
    run.take_steps(3).unwrap();
    exact.take_steps(3).unwrap();
    let apart = apart(&run.state().x, &exact.state().x);
    assert!(apart < 1e-8, "{apart:e}");
}

#[test]
fn verlet_steps_of_many_stars_keep_the_energy() {
    let n = 3000;
    let stars = Stars { field: 0.0, friction: 0.0, ..stars(n) };
    let fast = FastSum::new(&stars, 1e-3).unwrap();
    let error = fast.measured_error(&start(n), 100).unwrap();
    assert!(error < 1e-3, "{error:e}");
    let drift = |step: f64| {
        let mut run = Integrator::new(&fast, Variational::trapezoid(), step, start(n)).unwrap();
        let energy = run.energy();
        run.take_steps((0.2 / step) as u64).unwrap();
        (run.energy() / energy - 1.0).abs()
    };
    // Of second order, as far as the tolerance.
    let [long, short] = [drift(0.05), drift(0.025)];
    assert!(short < 0.3 * long + 1e-4 && long < 0.01, "{long:e} {short:e}");
}
