//! What the language does not say, as it is tried.

use dvi_core::prelude::*;

#[degenerate_lagrangian(
    coordinates(m[3]),
    poisson = [[0.0, -m[2], m[1]], [m[2], 0.0, -m[0]], [-m[1], m[0], 0.0]],
    hamiltonian = sum(0..3, |k| m[k].powi(2) / i[k]) / 2.0,
)]
struct PoissonStructuresEuler {
    i: [f64; 3],
}

#[degenerate_lagrangian(coordinates(x, y, z), one_form = y * d(x) + z * d(y), hamiltonian = x + y + z)]
struct PoissonStructuresLotkaVolterra;

#[degenerate_lagrangian(coordinates(x, y), one_form = y * d(x), hamiltonian = x, casimirs(c = x * y))]
struct PoissonStructuresCasimirs;

#[degenerate_lagrangian(
    coordinates(q, p),
    one_form = p * d(q),
    hamiltonian = (q * q + p * p) / 2.0,
    noise = nu * (q * q + p * p) / 2.0,
)]
struct Noise {
    nu: f64,
}

#[degenerate_lagrangian(coordinates(y[4]), equations = [|i| -y[i]])]
struct EquationsE5;

#[degenerate_lagrangian(coordinates(x, y), dot(x) = y)]
struct EquationsField;

#[lagrangian(
    coordinates(x, y, lambda),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - y + lambda * (x * x + y * y - 1.0),
)]
struct AlgebraicUnknowns;

#[lagrangian(
    coordinates(x, y, z),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2) + dot(z).powi(2)) / 2.0 - z,
    nonholonomic = dot(x).powi(2) - a * dot(z),
)]
struct ConstraintsThatAreNotAffine {
    a: f64,
}

#[lagrangian(coordinates(q[N][M][K]), lagrangian = dot(q[0][0][0]).powi(2) / 2.0)]
struct ThreeIndices<const N: usize, const M: usize, const K: usize>;

#[lagrangian(coordinates(a), lagrangian = dot(a.sin()).powi(2) / 2.0)]
struct VelocitiesOfFunctionsS;

#[lagrangian(
    coordinates(x[N]),
    lagrangian = sum(0..N, |i| dot(next(i)).powi(2) + dot([x[i], x[0]])[0]),
    let = { let next = |i| x[(i + 1) % N]; },
)]
struct VelocitiesOfFunctionsOfCalls<const N: usize>;

fn main() {}
