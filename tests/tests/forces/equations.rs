//! The discrete equations of Lagrange and d'Alembert, with their forces by hand, and what follows from them.

use approx::abs_diff_eq;
use dvi_core::Space;
use dvi_core::discrete::{Interval, Rule};
use dvi_core::methods::{Method, VariationalMethod};
use dvi_core::prelude::*;
use dvi_tests::larger;
use nalgebra::{Matrix4, Vector4};
use num_dual::Dual64;

use super::Outcome;
use super::systems::{ByHand, Damped, DampedState, Driven, DrivenState, Swirl};

const DAMPED: Damped = Damped { gamma: 0.3 };
const H: f64 = 0.05;

/// Points and velocities of a particle, one after the other.
fn run<M: Method<Damped, f64>>(
    method: M,
    steps: usize,
) -> Result<Vec<DampedState>, Box<dyn core::error::Error>> {
    let start = Damped::state(Damped::start());
    let mut states = vec![start];
    for state in Integrator::new(&DAMPED, method, H, start)?.take(steps) {
        states.push(state?);
    }
    Ok(states)
}

/// ∂L/∂q + F at a point with a velocity.
fn pull([x, y]: [f64; 2], [u, v]: [f64; 2]) -> [f64; 2] {
    let s = x * x + y * y;
    let slope = 2.0 * ((s - 1.0).powi(2) + 2.0 * s * (s - 1.0));
    [-slope * x - DAMPED.gamma * u, -slope * y - DAMPED.gamma * v]
}

/// p0 + D₁L_d + F⁻ and D₂L_d + F⁺ − p1 of a rule with linear interpolation, where p is the velocity.
fn defects(nodes: &[f64], weights: &[f64], [from, to]: [&DampedState; 2]) -> f64 {
    let [q0, q1] = [from, to].map(|state| [state.x, state.y]);
    let velocity: [f64; 2] = core::array::from_fn(|i| (q1[i] - q0[i]) / H);
    let (mut left, mut right) = ([0.0; 2], [0.0; 2]);
    for (c, w) in nodes.iter().zip(weights) {
        let force = pull(core::array::from_fn(|i| (1.0 - c) * q0[i] + c * q1[i]), velocity);
        for i in 0..2 {
            left[i] += H * w * (1.0 - c) * force[i];
            right[i] += H * w * c * force[i];
        }
    }
    let defect = |i: usize, p0: f64, p1: f64| {
        larger((p0 - velocity[i] + left[i]).abs(), (velocity[i] + right[i] - p1).abs())
    };
    larger(defect(0, from.dot_x, to.dot_x), defect(1, from.dot_y, to.dot_y))
}

#[test]
fn steps_solve_the_equations_of_lagrange_and_dalembert() -> Outcome {
    for rule in [
        Quadrature::sigma(0.0),
        Quadrature::sigma(0.4),
        Quadrature::gauss(1)?,
        Quadrature::lobatto(2)?,
        Quadrature::lobatto(3)?,
        Quadrature::gauss(3)?,
    ] {
        let (nodes, weights) = (rule.nodes().to_vec(), rule.weights().to_vec());
        for pair in run(Variational::new(rule), 200)?.windows(2) {
            let defect = defects(&nodes, &weights, [&pair[0], &pair[1]]);
            assert!(defect < 1e-13, "{nodes:?}: {defect:e}");
        }
    }
    Ok(())
}

/// By the forced discrete Noether theorem the angular momentum changes by F⁻·ξ(q0) + F⁺·ξ(q1) with ξ = (−y,
/// x), because L is invariant under rotations (Marsden & West 2001, section 3.2.4).
#[test]
fn the_angular_momentum_changes_by_the_moment_of_the_discrete_forces() -> Outcome {
    for (rule, c) in [(Quadrature::gauss(1)?, 0.5), (Quadrature::sigma(0.3), 0.3)] {
        for pair in run(Variational::new(rule), 400)?.windows(2) {
            let [from, to] = [&pair[0], &pair[1]];
            let moment = |s: &DampedState| s.x * s.dot_y - s.y * s.dot_x;
            // F at the node: −γ Δ/h.
            let force = [-DAMPED.gamma * (to.x - from.x) / H, -DAMPED.gamma * (to.y - from.y) / H];
            let turned = |s: &DampedState| s.x * force[1] - s.y * force[0];
            let expected = H * ((1.0 - c) * turned(from) + c * turned(to));
            let change = moment(to) - moment(from);
            assert!(abs_diff_eq!(change, expected, epsilon = 1e-12), "{change:e} {expected:e}");
        }
    }
    Ok(())
}

/// The tangent map of a step in (q, p) by the second derivatives of the discrete Lagrangian and the
/// derivatives of the forces, against the step in dual numbers.
fn tangent_maps_agree<M>(method: M) -> Outcome
where
    M: Method<Damped, f64> + Method<Damped, Dual64> + Clone,
    M: VariationalMethod<
            Damped,
            f64,
            DiscreteLagrangian: dvi_core::discrete::TwiceDifferentiable<Damped, f64>,
        >,
{
    let start = Damped::start();
    let mut by_hand = Matrix4::zeros();
    for column in 0..4 {
        let [x, y, dot_x, dot_y] =
            core::array::from_fn(|i| Dual64::new(start[i], if i == column { 1.0 } else { 0.0 }));
        let state = DampedState { x, y, dot_x, dot_y };
        let mut run = Integrator::new(&DAMPED, method.clone(), Dual64::from(H), state)?;
        run.advance()?;
        let DampedState { x, y, dot_x, dot_y } = run.state();
        by_hand.set_column(column, &Vector4::new(x.eps, y.eps, dot_x.eps, dot_y.eps));
    }
    let mut run = Integrator::new(&DAMPED, method.clone(), H, Damped::state(start))?;
    run.advance()?;
    let mut map = TangentMap::new(&DAMPED, &method);
    map.evaluate(&DAMPED, Interval { t: 0.0, h: H }, &start[..2], run.q())?;
    for column in 0..4 {
        let mut vectors = [DAMPED.space().vector(), DAMPED.space().vector()];
        vectors[column / 2][column % 2] = 1.0;
        let [dq, dp] = &mut vectors;
        map.apply(dq, dp);
        for (row, found) in dq.iter().chain(dp.iter()).enumerate() {
            let error = (found - by_hand[(row, column)]).abs();
            assert!(error < 1e-12, "({row}, {column}): {error:e}");
        }
    }
    // Friction takes volume from the phase space: the form is not preserved.
    assert!(map.symplectic_defect(&DAMPED) > 1e-3);
    Ok(())
}

#[test]
fn tangent_maps_hold_the_derivatives_of_the_forces() -> Outcome {
    tangent_maps_agree(Variational::midpoint())?;
    tangent_maps_agree(Variational::new(Quadrature::gauss(2)?))?;
    tangent_maps_agree(Variational::new(Quadrature::sigma(0.3)))?;
    tangent_maps_agree(Galerkin::<3>::new())?;
    tangent_maps_agree(Galerkin::<4>::new())
}

/// The integral of the power is of order four in the step.
#[test]
fn the_energy_changes_by_the_work_of_the_forces() -> Outcome {
    fn balance<const N: usize, S, M>(
        system: &S,
        method: M,
        steps: u64,
    ) -> Result<f64, Box<dyn core::error::Error>>
    where
        S: ByHand<N>
            + Lagrangian
            + System<Kind: dvi_core::mechanics::Rates<S, f64> + dvi_core::system::Smooth>,
        M: Method<S, f64>,
    {
        let mut run = Integrator::new(system, method, 2.0 / steps as f64, S::state(S::start()))?;
        let (begin, mut work) = (run.energy(), Work::new(&run));
        for _ in 0..steps {
            run.advance()?;
            work.record(&run);
        }
        Ok((run.energy() - begin - work.total()).abs())
    }
    let mut errors = Vec::new();
    for steps in [160, 240, 320, 480] {
        errors.push((2.0 / steps as f64, balance(&DAMPED, Galerkin::<5>::new(), steps)?));
    }
    let order = convergence_order(&errors).ok_or("no slope")?;
    assert!(abs_diff_eq!(order, 4.0, epsilon = 0.3), "{order}: {errors:?}");
    let driven = Driven { drag: [0.5, 0.8] };
    assert!(balance(&driven, Galerkin::<4>::new(), 200)? < 1e-8);
    assert!(balance(&super::systems::Pendulum { gamma: 0.2 }, OneStepGauss::<3>::new(), 200)? < 1e-8);
    assert!(balance(&super::systems::Harvested { harvest: 0.1 }, Gauss::<3>::new(), 200)? < 1e-8);
    Ok(())
}

/// Matrices of Newton's method hold the derivatives of the forces: two iterations are enough for most steps.
#[test]
fn newtons_method_knows_the_derivatives_of_the_forces() -> Outcome {
    fn iterations<M: Method<Driven, f64>>(method: M) -> Result<f64, Box<dyn core::error::Error>> {
        let system = Driven { drag: [0.5, 0.8] };
        let start: DrivenState = Driven::state(Driven::start());
        let mut run = Integrator::new(&system, method, 0.2, start)?;
        run.take_steps(100)?;
        Ok(run.statistics().iterations as f64 / 100.0)
    }
    for found in [
        iterations(Variational::midpoint())?,
        iterations(Variational::trapezoid())?,
        iterations(Galerkin::<3>::new())?,
        iterations(Galerkin::<5>::new())?,
    ] {
        assert!(found < 2.6, "{found}");
    }
    Ok(())
}

/// A force of size zero changes no bit of a run, and neither does one that is not there.
#[test]
fn without_forces_runs_are_the_same_to_the_bit() -> Outcome {
    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + 2.0 * dot(y).powi(2)) / 2.0 - x.powi(2) / 2.0 - y.powi(4) / 4.0,
    )]
    struct Free;
    fn bits<S: RegularLagrangian, M: Method<S, f64>>(
        system: &S,
        method: M,
        start: S::State<f64>,
    ) -> Result<Vec<u64>, Box<dyn core::error::Error>> {
        let mut run = Integrator::new(system, method, 0.05, start)?;
        run.take_steps(1000)?;
        Ok(dvi_tests::bits(run.q()))
    }
    let [x, y, dot_x, dot_y] = Swirl::start();
    let (swirl, swirling) = (Swirl { swirl: 0.0 }, Swirl::state(Swirl::start()));
    let free = FreeState { x, y, dot_x, dot_y };
    assert_eq!(
        bits(&Free, Variational::trapezoid(), free)?,
        bits(&swirl, Variational::trapezoid(), swirling)?
    );
    assert_eq!(
        bits(&Free, Variational::midpoint(), free)?,
        bits(&swirl, Variational::midpoint(), swirling)?
    );
    assert_eq!(bits(&Free, Galerkin::<3>::new(), free)?, bits(&swirl, Galerkin::<3>::new(), swirling)?);
    assert_eq!(bits(&Free, Newmark::new(0.25), free)?, bits(&swirl, Newmark::new(0.25), swirling)?);
    const { assert!(!Free::FORCED && Swirl::FORCED) };
    Ok(())
}
