//! A run on dual numbers as its own tangent map: the derivatives of whole steps, except at an equilibrium.

use dvi_core::methods::Method;
use dvi_core::prelude::*;
use dvi_core::{Space, State};
use dvi_tests::Outcome;
use dvi_tests::larger;
use num_dual::Dual64;

/// Coordinates and velocities.
pub(super) type Start = (Vec<f64>, Vec<f64>);

/// (q, p) after `steps` steps from (q, v), with the derivative along one direction of (q, v).
fn along<S: RegularLagrangian<Dual64>, M: Method<S, Dual64>>(
    system: &S,
    method: M,
    h: f64,
    (q, v): &Start,
    steps: u64,
    direction: usize,
) -> Outcome<[Vec<f64>; 2]> {
    let n = system.space().dimension();
    let dual = |x: &[f64], offset: usize| -> Vec<Dual64> {
        let unit = |i| if i + offset == direction { 1.0 } else { 0.0 };
        x.iter().enumerate().map(|(i, &x)| Dual64::new(x, unit(i))).collect()
    };
    let state = S::State::read(|block| system.block_len(block), &dual(q, 0), &dual(v, n));
    let mut run = Integrator::new(system, method, Dual64::from(h), state)?;
    run.take_steps(steps)?;
    let (mut q, mut v) = (vec![Dual64::from(0.0); n], vec![Dual64::from(0.0); n]);
    run.state().write(|block| system.block_len(block), &mut q, &mut v)?;
    let (mut l_q, mut p) = (q.clone(), q.clone());
    system.gradient(&q, &v, run.time(), &mut l_q, &mut p);
    Ok([q, p].map(|x| x.iter().map(|x| x.eps).collect()))
}

/// max |NᵀJN − N₀ᵀJN₀| over the derivatives N of (q, p) after `steps` steps and N₀ of (q, p) at the start,
/// both with respect to (q, v) at the start: zero if the steps preserve dq ∧ dp.
pub(super) fn symplectic_defect<S: RegularLagrangian<Dual64>, M: Method<S, Dual64> + Clone>(
    system: &S,
    method: &M,
    h: f64,
    start: &Start,
    steps: u64,
) -> Outcome<f64> {
    let n = start.0.len();
    let mut columns = Vec::new();
    for direction in 0..2 * n {
        let before = along(system, method.clone(), h, start, 0, direction)?;
        columns.push([before, along(system, method.clone(), h, start, steps, direction)?]);
    }
    let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
    let form = |[q, p]: &[Vec<f64>; 2], [r, s]: &[Vec<f64>; 2]| dot(q, s) - dot(p, r);
    let mut defect = 0.0_f64;
    for a in &columns {
        for b in &columns {
            defect = larger(defect, (form(&a[1], &b[1]) - form(&a[0], &b[0])).abs());
        }
    }
    Ok(defect)
}
