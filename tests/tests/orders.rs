//! Orders of convergence, by regression.

use approx::abs_diff_eq;
use dvi_core::prelude::*;
use dvi_tests::Outcome;
use dvi_tests::apart;
use dvi_tests::configurations::leapfrogging;
use dvi_tests::systems::{LotkaVolterra, LotkaVolterraState, PointVorticesState};

#[test]
fn regression_finds_slopes_and_refuses_what_has_none() {
    let power = |h: f64| (h, 3.0 * h.powf(2.5));
    let order = convergence_order(&[power(0.1), power(0.2), power(0.7)]);
    assert!(order.is_some_and(|order| (order - 2.5).abs() < 1e-13));
    assert_eq!(convergence_order(&[]), None);
    assert_eq!(convergence_order(&[(0.1, 1.0)]), None);
    assert_eq!(convergence_order(&[(0.1, 1.0), (0.1, 2.0)]), None);
    assert_eq!(convergence_order(&[(0.1, 0.0), (0.2, 1.0)]), None);
    assert_eq!(convergence_order(&[(0.1, f64::NAN), (0.2, 1.0)]), None);
}

#[test]
fn a_second_point_without_an_energy_is_refused() {
    let (system, start) = leapfrogging();
    let second = PointVorticesState { x: [0.5, 0.5, -1.0, 1.0], y: [0.0, 0.0, -2.0, -2.0] };
    let run = Integrator::from_two_points(&system, Sigma::leapfrog(), 0.1, start, second);
    assert!(matches!(run.err(), Some(StartError::Undefined { .. })));
}

/// One motion in forms whose Dα is antisymmetric, and not.
#[degenerate_lagrangian(
    coordinates(q, p),
    one_form = (1.0 - share) * p * d(q) - share * q * d(p),
    hamiltonian = p * p / 2.0 - q.cos(),
)]
#[derive(Clone, Debug)]
struct Pendulum {
    share: f64,
}

/// The order of a member of the σ-family, by the third point that it finds to two of the motion: a parasitic
/// mode that grows from step to step has no time to.
fn order_of_a_step<S: DegenerateLagrangian>(system: &S, start: S::State<f64>, sigma: f64) -> Outcome<f64> {
    let mut errors = Vec::new();
    for h in [0.02, 0.014, 0.01, 0.007] {
        let mut motion = Integrator::new(system, Gauss::<4>::new(), h, start.clone())?;
        motion.advance()?;
        let second = motion.state();
        let mut run = Integrator::from_two_points(system, Sigma::new(sigma), h, start.clone(), second)?;
        motion.advance()?;
        run.take_steps(2)?;
        let off = apart(run.q(), motion.q());
        errors.push((h, off));
    }
    Ok(convergence_order(&errors).ok_or("no slope")? - 1.0)
}

/// dF with F'' ≠ 0 adds (σ − ½) Δ·F''Δ to the discrete Lagrangian, beside a difference of F.
#[test]
fn sigma_away_from_one_half_is_of_first_order_where_dalpha_is_not_antisymmetric() -> Outcome {
    let start = PendulumState { q: 1.0, p: 0.4 };
    let of = |share: f64, sigma: f64| order_of_a_step(&Pendulum { share }, start, sigma);
    for (share, sigma, expected) in [
        (0.5, 0.3, 2.0),
        (0.5, 0.8, 2.0),
        (0.0, 0.5, 2.0),
        (0.3, 0.5, 2.0),
        (0.0, 0.3, 1.0),
        (0.3, 0.3, 1.0),
        (0.3, 0.8, 1.0),
    ] {
        let order = of(share, sigma)?;
        assert!(abs_diff_eq!(order, expected, epsilon = 0.06), "share {share}, sigma {sigma}: {order}");
    }
    // Of a form that is not affine Dα is not antisymmetric either.
    let (prey, start) =
        (LotkaVolterra { a: [1.0, 1.0], b: [-1.0, -2.0] }, LotkaVolterraState { x: 1.4, y: 1.7 });
    for (sigma, expected) in [(0.5, 2.0), (0.4, 1.0)] {
        let order = order_of_a_step(&prey, start, sigma)?;
        assert!(abs_diff_eq!(order, expected, epsilon = 0.15), "Lotka-Volterra, sigma {sigma}: {order}");
    }
    Ok(())
}
