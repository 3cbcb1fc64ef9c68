//! Unit vectors of degenerate systems, and their one-form of area.

use dvi_core::prelude::*;

#[degenerate_lagrangian(coordinates(s[N]: S2), one_form = sum(0..N, |i| d(s[i])), hamiltonian = s[0][2])]
struct Differential<const N: usize>;

#[degenerate_lagrangian(coordinates(s: S2), lagrangian = area(s) + dot(s)[0] - s[2])]
struct Velocity;

#[degenerate_lagrangian(
    coordinates(s: S2, x, p),
    one_form = area(s) + area(x) * p + p * d(x),
    hamiltonian = s[2] + p * p + x * x,
)]
struct AreaOfANumber;

#[degenerate_lagrangian(coordinates(s: S2), one_form = area(s[0]) + area(s, s), hamiltonian = s[2])]
struct AreaOfAComponent;

#[degenerate_lagrangian(coordinates(s[N]: S2), one_form = sum(0..N, |i| area(s)), hamiltonian = s[0][2])]
struct AreaOfAnArray<const N: usize>;

#[degenerate_lagrangian(
    coordinates(s: S2),
    one_form = area(s),
    hamiltonian = s[2] + area(s),
    momenta(axial = s[2] * area(s)),
)]
struct AreaInHamiltonian;

#[degenerate_lagrangian(
    coordinates(s[N]: S2),
    one_form = sum(0..N, |i| area(s[i])),
    hamiltonian = sum(0..N, |i| s[i][3] + s[i][i] + s[i].z),
    momenta(total = sum(0..N, |i| s[i]), axial = s[0] + 1.0),
)]
struct VectorAsNumber<const N: usize>;

#[degenerate_lagrangian(coordinates(s: S2, n: S2), one_form = area(s), hamiltonian = s[2] + n[2])]
struct WithoutArea;

#[degenerate_lagrangian(coordinates(s[N]: S2, x), one_form = area(s[0]) + x * d(x), hamiltonian = x)]
struct OddNumbers<const N: usize>;

#[degenerate_lagrangian(
    coordinates(s[N]: S2, x, p),
    one_form = p * d(x) + sum(0..N, |i| (1.0 + x * x) * area(s[i])) + area(s[0]) / (2.0 + t) + s[0][2] * (area(s[1]) * 2.0),
    hamiltonian = sum(0..N, |i| s[i][2]) + p * p,
)]
struct StrengthThatVaries<const N: usize>;

#[degenerate_lagrangian(
    coordinates(s: S2, x, p),
    one_form = [0.0, p, 0.0],
    hamiltonian = s[2] + p * p,
    force(s) = [1.0, 0.0, 0.0],
)]
struct Components;

#[degenerate_lagrangian(coordinates(s: S2), one_form = area(s), hamiltonian = s[2], gauge = s[0] * s[1])]
struct Gauged;

#[degenerate_lagrangian(coordinates(s: S2), one_form = area(s), hamiltonian = s[2], gauge = auto)]
struct GaugedByItself;

#[degenerate_lagrangian(coordinates(s[2][3]: S2), one_form = area(s[0]), hamiltonian = s[0][2])]
struct TwoSizes;

#[degenerate_lagrangian(coordinates(s: S2), one_form = area(s), hamiltonian = s[2])]
struct Spin;

fn main() {
    let start = SpinState { s: [1.0, 0.0, 0.0] };
    let _ = Integrator::new(&Spin, OneStep::midpoint(), 0.1, start);
}
