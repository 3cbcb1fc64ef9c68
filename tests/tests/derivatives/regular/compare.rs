//! The oracle for what only regular systems have: energy, force, momenta with velocities, and the
//! constants on the structure of L.

use dvi_core::{RegularLagrangian, Space};
use dvi_tests::larger;
use num_dual::{Dual64, HyperDual64};

use crate::derivatives::oracle::{
    Action, Expansion, Number, Place, Random, expanded, lagrangian, largest, single_precision,
};

const POINTS: usize = 25;

/// A regular system and its momenta, written a second time.
pub(crate) trait Sampled: RegularLagrangian + Action {
    fn integrals<D: Number>(&self, _q: &[D], _v: &[D], _t: D) -> Vec<D> {
        Vec::new()
    }
    /// A point in the domain of the formulas.
    fn point(&self, random: &mut Random) -> Vec<f64> {
        random.several(self.space().dimension(), -1.0, 1.0)
    }
    fn velocity(&self, random: &mut Random, count: usize) -> Vec<f64> {
        random.several(count, -1.0, 1.0)
    }
}

/// Compares all of `system` with the oracle on random points, and its constants with the expected ones.
pub(crate) fn agrees<S: Sampled>(system: &S, constants: [bool; 3]) {
    assert_eq!(system.check(), Ok(()));
    let name = S::REPORT.system;
    let found = [S::SEPARABLE, S::DIAGONAL_MASS, S::QUADRATIC];
    assert_eq!(found, constants, "{name}: SEPARABLE, DIAGONAL_MASS, QUADRATIC");
    const { assert!(S::REGULAR) };
    let mut random = Random::new(20_011_023);
    for _ in 0..POINTS {
        let q = system.point(&mut random);
        let v = system.velocity(&mut random, q.len());
        let t = random.between(-2.0, 2.0);
        let place = Place { system: name, q: &q, epsilon: f64::EPSILON };
        lagrangian(system, &place, &v, t, &mut random);
        single_precision(system, &place, &v, t);
        energy_and_force(system, &place, &v, t);
        momenta(system, &place, &v, t);
        claims(system, &place, &v, t);
    }
}

fn expansion<S: Action>(system: &S, q: &[f64], v: &[f64], t: f64) -> Expansion {
    let n = q.len();
    expanded(&[q, v].concat(), &|z| system.action(&z[..n], &z[n..], HyperDual64::from(t)))
}

fn energy_and_force<S: Sampled>(system: &S, place: &Place<'_>, v: &[f64], t: f64) {
    let (q, n) = (place.q, place.q.len());
    let expected = expansion(system, q, v, t);
    let along: f64 = v.iter().zip(&expected.gradient[n..]).map(|(v, p)| v * p).sum();
    let [second, first] = [largest(&expected.hessian), largest(&expected.gradient)];
    let scale = larger(larger(first, second), expected.value.abs());
    place.compare("E", &[system.energy(q, v, t)], &[along - expected.value], scale);
    let mut out = vec![f64::NAN; n];
    system.force(q, v, t, &mut out);
    place.compare("force", &out, &expected.gradient[..n], larger(first, second));
    if S::SEPARABLE {
        out.fill(f64::NAN);
        system.force(q, &[], t, &mut out);
        place.compare("force at rest", &out, &expected.gradient[..n], larger(first, second));
    }
}

fn momenta<S: Sampled>(system: &S, place: &Place<'_>, v: &[f64], t: f64) {
    let (q, n) = (place.q, place.q.len());
    let variables: Vec<Dual64> = [q, v].concat().into_iter().map(Dual64::from).collect();
    let expected = system.integrals(&variables[..n], &variables[n..], Dual64::from(t));
    assert_eq!(expected.len(), S::REPORT.momenta.len());
    for (index, value) in expected.iter().enumerate() {
        let slopes =
            expanded(&[q, v].concat(), &|z| system.integrals(&z[..n], &z[n..], HyperDual64::from(t))[index]);
        let scale = larger(largest(&slopes.gradient), value.re.abs());
        place.compare("momentum", &[system.momentum(index, q, v, t)], &[value.re], scale);
    }
}

/// What the constants claim holds for the second derivative of L.
fn claims<S: Sampled>(system: &S, place: &Place<'_>, v: &[f64], t: f64) {
    let (q, n) = (place.q, place.q.len());
    let [here, rest] = [v, &vec![0.0; n]].map(|v| expansion(system, q, v, t));
    let size = larger(largest(&here.hessian), 1.0);
    let block = |of: &Expansion, rows: usize, columns: usize| -> Vec<f64> {
        (0..n * n).map(|at| of.hessian[2 * n * (rows + at / n) + columns + at % n]).collect()
    };
    let mass = block(&here, n, n);
    let off_diagonal: Vec<f64> =
        (0..n * n).map(|at| if at % (n + 1) == 0 { 0.0 } else { mass[at] }).collect();
    let nothing = vec![0.0; n * n];
    if S::DIAGONAL_MASS {
        place.compare("M off its diagonal", &off_diagonal, &nothing, size);
    }
    if S::QUADRATIC {
        place.compare("M at rest", &block(&rest, n, n), &mass, size);
    }
    if S::SEPARABLE {
        let elsewhere: Vec<f64> = q.iter().map(|q| q + 0.0625).collect();
        let elsewhere = expansion(system, &elsewhere, v, t + 0.5);
        place.compare("M elsewhere", &block(&elsewhere, n, n), &mass, size);
        place.compare("∂²L/∂q∂v", &block(&here, 0, n), &nothing, size);
        place.compare("∂L/∂v at rest", &rest.gradient[n..], &nothing[..n], size);
    }
}
