//! Every step solves p0 = −D₁L_d(q0, q1) and p1 = D₂L_d(q0, q1), whose derivatives are taken here by dual
//! numbers from the value of L alone.

use super::Outcome;
use super::phase_space::Start;
use dvi_core::discrete::{FrequencyIn, Rule};
use dvi_core::prelude::*;
use dvi_core::{Real, State};
use dvi_tests::larger;
use dvi_tests::zoo::regular::*;
use num_dual::Dual64;

/// Frequencies that the rules below are fitted to, one per coordinate.
pub(super) type Omega<'a> = &'a [f64];

/// h Σ w L with the basis of Kosmas & Vlachos, eq. 15, written out.
pub(super) fn discrete_lagrangian<S: RegularLagrangian<T>, T: Real>(
    system: &S,
    rule: &impl Rule,
    omega: Omega<'_>,
    [t, h]: [f64; 2],
    q0: &[T],
    q1: &[T],
) -> T {
    let mut sum = T::lift(0.0);
    for (&c, &w) in rule.nodes().iter().zip(rule.weights()) {
        let (mut point, mut velocity) = (Vec::new(), Vec::new());
        for (i, (&q0, &q1)) in q0.iter().zip(q1).enumerate() {
            let u = omega[i] * h;
            let [b, b_bar, d, d_bar] = if u == 0.0 {
                [1.0 - c, c, -1.0, 1.0]
            } else {
                let (cosine, sine) = ((1.0 - c) * u, c * u);
                let s = u.sin();
                [cosine.sin() / s, sine.sin() / s, -u * cosine.cos() / s, u * sine.cos() / s]
            };
            point.push(T::lift(b) * q0 + T::lift(b_bar) * q1);
            velocity.push((T::lift(d) * q0 + T::lift(d_bar) * q1) / T::lift(h));
        }
        sum += T::lift(h * w) * system.lagrangian(&point, &velocity, T::lift(t + c * h));
    }
    sum
}

fn dual(q: &[f64], direction: Option<usize>) -> Vec<Dual64> {
    let unit = |i| if Some(i) == direction { 1.0 } else { 0.0 };
    q.iter().enumerate().map(|(i, &q)| Dual64::new(q, unit(i))).collect()
}

#[track_caller]
fn check<S: RegularLagrangian + RegularLagrangian<Dual64>, F: FrequencyIn<f64> + Copy, R: Rule>(
    system: &S,
    method: Variational<F, R>,
    omega: Omega<'_>,
    (q, v): &Start,
) -> Outcome {
    let h = 0.07;
    let state = S::State::read(|block| system.block_len(block), q, v);
    let mut run = Integrator::new_at(system, method, 0.4, h, state)?;
    let name = S::REPORT.system;
    for _ in 0..5 {
        let (t, q0, p0) = (run.time(), run.q().to_vec(), run.memory().p().to_vec());
        run.advance().map_err(|error| format!("{name}, {method:?}: {error}"))?;
        let (q1, p1) = (run.q(), run.memory().p());
        for i in 0..q0.len() {
            let value = |a, b| {
                discrete_lagrangian(system, &method.rule, omega, [t, h], &dual(&q0, a), &dual(q1, b)).eps
            };
            let left = p0[i] + value(Some(i), None);
            let right = p1[i] - value(None, Some(i));
            assert!(
                larger(left.abs(), right.abs()) < 1e-12,
                "{name}, {:?}: {left:e} {right:e}",
                method.rule
            );
        }
    }
    Ok(())
}

#[test]
fn steps_solve_the_discrete_equations() -> Outcome {
    let rules = [
        Quadrature::sigma(0.0),
        Quadrature::sigma(0.4),
        Quadrature::lobatto(2)?,
        Quadrature::lobatto(3)?,
        Quadrature::gauss(3)?,
        Quadrature::lobatto(5)?,
    ];
    let planar = (vec![0.5, 0.2], vec![0.4, -0.7]);
    let pendulums = DoublePendulum { mass: [1.0, 0.7], length: [1.0, 0.8], g: 1.0 };
    let ring = Ring { mass: [1.0, 2.0, 0.5, 1.5], alpha: 0.3 };
    let ring_start = (vec![0.1, -0.2, 0.3, 0.0], vec![0.5, 0.1, -0.4, 0.2]);
    let chain = RunTimeChain { mass: vec![1.0, 2.0, 1.5], coupling: 0.2 };
    let driven = DrivenOscillator { depth: 0.3, omega: 2.0 };
    let particle = MagneticParticle { m: 1.0, b: 0.8 };
    let particle_start = (vec![0.3, 0.2, 0.1], vec![0.4, -0.6, 0.2]);
    for rule in rules {
        let linear = Variational::new(rule);
        let fitted = linear.phase_fitted(Constant(1.3));
        for solver in [Solver::Automatic, Solver::Newton] {
            let (linear, fitted) = (Variational { solver, ..linear }, Variational { solver, ..fitted });
            check(&Kepler { mu: 1.0 }, linear, &[0.0; 2], &planar)?;
            check(&Kepler { mu: 1.0 }, fitted, &[1.3; 2], &planar)?;
            check(&pendulums, linear, &[0.0; 2], &planar)?;
            check(&pendulums, fitted, &[1.3; 2], &planar)?;
            check(&MixedVelocities {}, linear, &[0.0; 2], &planar)?;
            check(&MixedVelocities {}, fitted, &[1.3; 2], &planar)?;
            check(&GrowingMass {}, linear, &[0.0; 2], &planar)?;
            check(&Relativistic { m: 1.0 }, fitted, &[1.3; 2], &planar)?;
            check(&ring, linear, &[0.0; 4], &ring_start)?;
            check(&ring, fitted, &[1.3; 4], &ring_start)?;
            check(&chain, linear, &[0.0; 4], &ring_start)?;
            check(&driven, fitted, &[1.3], &(vec![0.4], vec![0.9]))?;
            check(&particle, linear, &[0.0; 3], &particle_start)?;
        }
    }
    Ok(())
}
