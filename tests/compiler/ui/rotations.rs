//! Mistakes with rotations and unit vectors.

use dvi_core::ManifoldLagrangian;
use dvi_core::prelude::*;

/// That a system with a mistake in it is taken for one with rotations.
fn used<S: ManifoldLagrangian>(system: &S) {
    let _ = dvi_core::ManifoldSystem::tangent(system);
}

#[lagrangian(coordinates(R: SO2), lagrangian = omega(R)[0].powi(2))]
struct DeclarationsS;

#[lagrangian(coordinates(R[2]: SO3), lagrangian = omega(R)[0].powi(2))]
struct DeclarationsT;

#[degenerate_lagrangian(coordinates(R: SO3, x), one_form = R[0][0] * d(x), hamiltonian = x)]
struct DeclarationsW;

#[lagrangian(coordinates(omega_R, R: SO3), lagrangian = omega(R)[0].powi(2))]
struct DeclarationsX;

#[lagrangian(
    coordinates(R: SO3),
    lagrangian = omega(R)[0].powi(2) + omega(R)[1].powi(2) + omega(R)[2].powi(2) - R[2],
)]
struct EntriesS;
const _: fn() = || used(&EntriesS);

#[lagrangian(
    coordinates(R: SO3),
    lagrangian = omega(R)[0].powi(2) + omega(R)[1].powi(2) + omega(R)[3].powi(2) - R[0][3],
)]
struct EntriesT;

#[lagrangian(coordinates(R: SO3), lagrangian = dot(R[0][0]).powi(2) + dot(R[8]).powi(2))]
struct EntriesV;

#[lagrangian(coordinates(R: SO3), lagrangian = omega(R).powi(2) + omega_R[0])]
struct EntriesW;

#[lagrangian(coordinates(R: SO3, s: S2), lagrangian = (omega(R))[0].powi(2) * (R)[0][0] - R[0][1][2] + omega(s)[0])]
struct EntriesY;

#[lagrangian(coordinates(R: SO3), lagrangian = dot(R) + R.sqrt())]
struct EntriesZ;

#[lagrangian(
    coordinates(R: SO3, r[3]),
    lagrangian = omega(R).norm_squared() + dot(r).norm_squared() - R.norm_squared() - r.dot(R) - R[0].norm(),
)]
struct NoVectors;

#[lagrangian(coordinates(R: SO3), lagrangian = omega(R)[0].powi(2) + omega(R)[2].powi(2) - R[2][2])]
struct MassesS;

#[lagrangian(coordinates(R: SO3, x), lagrangian = dot(x).powi(2) - R[2][2])]
struct MassesT;

#[lagrangian(coordinates(s: S2), lagrangian = dot(s[0]).powi(2) + dot(s[1]).powi(2) - s[2])]
struct MassesU;

#[lagrangian(
    coordinates(s: S2),
    lagrangian = sum(0..3, |i| dot(s[i]).powi(2)),
    constraint = s[2] - 0.5,
)]
struct BesideS;

#[lagrangian(coordinates(s: S2), lagrangian = dot(s).norm_squared(), dissipation = dot(s).norm_squared())]
struct BesideT;

#[lagrangian(
    coordinates(R: SO3, x),
    lagrangian = omega(R)[0].powi(2) + omega(R)[1].powi(2) + omega(R)[2].powi(2) + dot(x).powi(2),
    impact = x - R[2][2],
)]
struct BesideU;

#[lagrangian(coordinates(R: SO3), lagrangian = omega(R).norm_squared(), force(R) = -0.1 * omega(R))]
struct BesideV;

#[lagrangian(coordinates(R: SO3), lagrangian = omega(R).norm_squared(), nonholonomic = omega(R)[1])]
struct BesideW;

mod methods {
    use super::*;

    #[lagrangian(coordinates(s: S2), lagrangian = sum(0..3, |i| dot(s[i]).powi(2)))]
    struct Free;

    #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2))]
    struct Flat;

    fn run() {
        let start = FreeState { s: [1.0, 0.0, 0.0], dot_s: [0.0; 3] };
        let _ = Integrator::new(&Free, Variational::trapezoid(), 0.1, start);
        let _ = Integrator::new(&Free, RungeKutta::classical(), 0.1, start);
        let _ = Free.energy_at(0.0, &start);
        let _ = Free.vector_field(0.0, &start);
        let start = FlatState { x: 1.0, dot_x: 0.0 };
        let _ = Integrator::new(&Flat, Geodesic::trapezoid(), 0.1, start);
    }
}

fn main() {}
