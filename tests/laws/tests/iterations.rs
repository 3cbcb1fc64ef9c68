//! How many iterations a step takes, which no other law sees: a wrong matrix or a poor guess leaves the
//! same motion, later.
//!
//! The guess of an increment is that of the polynomial through as many of the last as are kept, so that its
//! error is a difference of all these, which is taken here of the increments of the run. From there
//! Newton's method squares the correction, and a fixed point multiplies it by hω, or by (hω)² where it
//! sums forces that depend on the place, with the largest frequency ω of the equations of motion: how many
//! corrections follow until the next would no longer count is what a step may take.

use dvi_core::prelude::*;
use dvi_laws::case::Written;
use dvi_laws::equations::Equations;
use dvi_laws::formula::dual;
use dvi_laws::subject::size;
use dvi_laws::{Case, fused};
use nalgebra::DMatrix;

use super::{Outcome, ask, below, of_every_kind};

/// Corrections that are smaller, of numbers of one, are nothing.
const TOLERANCE: f64 = 1e-17;
/// How many increments guess the next.
const DEPTH: usize = 7;
/// How many steps are taken, if parasites stay small in so many.
const STEPS: usize = DEPTH + 16;

/// Corrections by Newton's method from a first one on, until the next is nothing: θc/(1 − θ) with the ratio
/// θ of the last two, which is c, or `stale` where the matrix is not that of the place.
fn by_newton(first: f64, stale: f64) -> f64 {
    let (mut before, mut now, mut count) = (first, first, 1.0);
    while now * now >= TOLERANCE * (before - now) {
        (before, now) = (now, now * now.max(stale));
        count += 1.0;
    }
    count
}

/// Corrections by a fixed point, which goes on to where they are rounding errors of the increment: then one
/// does not shrink, and three more may be no better.
fn by_fixed_point(first: f64, ratio: f64, rounding: f64) -> f64 {
    4.0 + ((rounding / first).ln() / ratio.min(0.9).ln()).ceil().max(1.0)
}

/// The largest frequency or rate of the equations of motion, as linear ones.
fn rate(case: &Case, t: f64, values: &[f64]) -> f64 {
    let mut slopes = DMatrix::zeros(values.len(), values.len());
    for (k, mut column) in slopes.column_iter_mut().enumerate() {
        column.copy_from_slice(&case.subject.varied_rates(&dual(values, Some(k)), t)[..values.len()]);
    }
    slopes.complex_eigenvalues().iter().map(|root| root.norm()).fold(0.0, f64::max)
}

/// How many iterations a step of a run takes on the average, and how many it may, which depends on the error
/// of the guess: in the first steps, where that is poor, and in those after them. Of the first `n` values,
/// whose guesses are `off` times farther off than that of their increments.
fn counts(
    run: &mut dyn Written,
    [n, off, steps]: [usize; 3],
    allowed: impl Fn(f64, f64) -> f64,
) -> Outcome<[[f64; 2]; 2]> {
    let (mut q, mut before) = (run.values(), run.asked().2.iterations);
    let (mut differences, mut sums) = (Vec::<Vec<f64>>::new(), [[0.0; 2]; 2]);
    for step in 0..steps {
        run.take_steps(1)?;
        let (now, count) = (run.values(), run.asked().2.iterations);
        let minus = |b: &[f64], a: &[f64]| -> Vec<f64> { b.iter().zip(a).map(|(b, a)| b - a).collect() };
        let mut next = vec![minus(&now[..n], &q[..n])];
        for (order, before) in differences.iter().take(DEPTH).enumerate() {
            next.push(minus(&next[order], before));
        }
        // Each of these numbers stands in the difference up to 2⁷ times.
        let sizes = size(&q[..n]) + size(&next[0]);
        let guess = (off as f64 * size(&next[next.len() - 1]) / sizes + 128.0 * f64::EPSILON).min(0.9);
        let rounding = f64::EPSILON * size(&next[0]) / sizes;
        let (is_late, of) = if step < DEPTH { (0, DEPTH) } else { (1, steps - DEPTH) };
        sums[is_late][0] += (count - before) as f64 / of as f64;
        sums[is_late][1] += allowed(guess, rounding) / of as f64;
        (q, before, differences) = (now, count, next);
    }
    Ok(sums)
}

/// By less than one in all the steps.
fn are_allowed(counts: [[f64; 2]; 2], of: &str) -> Outcome {
    for ([found, allowed], steps) in counts.into_iter().zip(["the first steps", "later steps"]) {
        below(found, allowed + 0.01, &format!("iterations of {steps}, {of}"))?;
    }
    Ok(())
}

fn steps_take_as_many_as_follow(case: &Case) -> Outcome {
    let is = |name: &str| case.name.starts_with(name);
    // The steps of a composition are those of its method.
    if is("Composition") {
        return Ok(());
    }
    let (start, solver) = (case.subject.start.concat(), case.options.solver);
    let has_matrix = ["Constrained", "Rattle", "Projected", "OneStep"].into_iter().any(is)
        || matches!(solver, Solver::Newton | Solver::NewtonKrylov);
    // These solve for an increment, and then for another or for the rates.
    let sets = if is("OneStep") { 2.0 } else { 1.0 };
    // Frequencies along the run are at most twice those at its start.
    let omega = 2.0 * rate(case, case.subject.t, &start);
    let collocates = matches!(case.equations, Equations::Collocation(_));
    let is_squared = case.subject.regular && !case.subject.is_forced() && !collocates;
    // Collocation guesses velocities too, and stages between are guessed farther off.
    let guessed = if collocates { start.len() } else { case.subject.dimension() };
    let steps = STEPS.min(case.subject.steps as usize);
    let off = if is("Gauss") || is("Galerkin") { 100 } else { 10 };
    // In the matrix of Gauss forms and masses are those of where the step begins, and in any a frequency is
    // a number.
    let is_stale = is("Gauss") && !case.subject.is_affine()
        || ["Radial(", "Curvature("].iter().any(|frequency| case.name.contains(frequency));
    let mut before = f64::INFINITY;
    for by in [1.0, 0.5, 0.25, 0.125] {
        let h = by * case.subject.h;
        let ratio = (h * omega).powi(if is_squared { 2 } else { 1 });
        let stale = if is_stale { h * omega } else { 0.0 };
        // One more of Newton's may find that nothing but rounding is left.
        let allowed = |first, rounding| {
            let fixed = if has_matrix { 0.0 } else { by_fixed_point(first, ratio, rounding) };
            (sets * by_newton(first, stale) + 1.0).max(fixed)
        };
        let mut run = case.begin([case.subject.t, h], &start)?;
        let counts = counts(&mut *run, [guessed, off, steps], allowed)?;
        are_allowed(counts, &format!("{by} h"))?;
        let found = counts[1][0];
        // A parasite changes sign in every step, however short that is; and instead of Newton's method a
        // fixed point, which is cheaper, is enough of shorter steps.
        if !case.has_hidden_state() && (has_matrix || solver == Solver::FixedPoint) {
            below(found, before + 1.01, "more iterations of half the step")?;
        }
        before = found;
    }
    Ok(())
}

of_every_kind!(steps_take_as_many_as_follow);

#[test]
fn on_manifolds_too() {
    let cases: Vec<_> = fused().into_iter().filter(|case| case.name.starts_with("Geodesic")).collect();
    ask(&cases, |case| {
        let mut run = case.run()?;
        let n = run.values().len() / 2;
        are_allowed(counts(&mut *run, [n, 10, STEPS], |first, _| by_newton(first, 0.0) + 1.0)?, "h")
    });
}
