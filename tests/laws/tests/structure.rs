//! Runs on dual numbers carry tangent vectors along: a scheme preserves the two-form that it says it
//! preserves, evaluated on all pairs of them, and one of order four at most no other that it could.
//!
//! - [`Canonical`](PreservedForm::Canonical): Σ dq ∧ dp, with p = ∂L/∂v.
//! - [`Omega`](PreservedForm::Omega), and `OmegaIfAffine` of affine one-forms: Σ dq ∧ dα.
//! - [`Discrete`](PreservedForm::Discrete): Σ dq1 ∧ dp1 with p1 = D₂L_d(q0, q1), which is ∂²L_d/∂q0∂q1
//!   dq0 ∧ dq1 (Rowley & Marsden 2002, eq. 17).
//! - [`Conjugate`](PreservedForm::Conjugate): Σ dq' ∧ dp with q' = q + c h² q̈, as the table says.
//!
//! Momenta and their variations are derivatives of the Lagrangian by dual numbers.

use dvi_core::methods::PreservedForm;
use dvi_laws::Case;
use dvi_laws::equations::Equations;
use dvi_laws::formula::along;
use dvi_tests::larger;
use num_dual::Dual64;

use super::{Outcome, below, of_every_kind};

const STEPS: usize = 4;

type Tangent = [Vec<f64>; 2];

/// The variations of q and p, after each step but the first ones, of the run whose start varies as it is
/// said.
fn tangents(case: &Case, start: &[Dual64], skip: usize) -> Outcome<Vec<Tangent>> {
    let (subject, n) = (&case.subject, case.subject.dimension());
    let mut run = case.vary([subject.t, subject.h], start)?;
    let mut tangents = Vec::new();
    let mut last: Option<Vec<Dual64>> = None;
    for step in 0..=STEPS + skip {
        let (values, t) = (run.values(), run.time().re);
        let (q, v) = values.split_at(n);
        let rest = vec![Dual64::from(0.0); n];
        let p = match (&case.equations, case.form, &last) {
            (Equations::Discrete(nodes), PreservedForm::Discrete, Some(before)) => {
                let h = subject.h;
                let of = |i| {
                    let ends = [&along(before, None)[..], &along(q, Some(i))];
                    nodes
                        .discrete_lagrangian(|q, v, t| subject.twice(q, v, t), [t - h, h], ends, &[])
                        .eps1eps2
                };
                (0..n).map(of).collect()
            }
            _ => subject.varied_momenta(q, if subject.regular { v } else { &rest }, t),
        };
        if step >= skip {
            let mut moved: Vec<f64> = q.iter().map(|q| q.eps).collect();
            if case.form == PreservedForm::Conjugate {
                let (rates, shift) =
                    (subject.varied_rates(&values, t), case.equations.shift() * subject.h.powi(2));
                moved.iter_mut().zip(&rates[n..]).for_each(|(moved, rate)| *moved += shift * rate);
            }
            tangents.push([moved, p]);
        }
        last = Some(q.to_vec());
        if step < STEPS + skip {
            run.advance()?;
        }
    }
    Ok(tangents)
}

fn two_form([q, p]: &Tangent, [r, s]: &Tangent) -> f64 {
    let dot = |x: &[f64], y: &[f64]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
    dot(q, s) - dot(p, r)
}

/// By how much the form changes, over its size.
pub(crate) fn lost(case: &Case) -> Outcome<f64> {
    let skip = usize::from(case.form == PreservedForm::Discrete);
    let start = case.subject.start.concat();
    let mut all = Vec::new();
    for direction in case.subject.directions() {
        let start: Vec<Dual64> = start.iter().zip(&direction).map(|(&x, &by)| Dual64::new(x, by)).collect();
        all.push(tangents(case, &start, skip)?);
    }
    let (mut lost, mut size): (f64, f64) = (0.0, 1.0);
    for (i, a) in all.iter().enumerate() {
        for b in &all[..i] {
            let first = two_form(&a[0], &b[0]);
            for (a, b) in a.iter().zip(b) {
                lost = larger(lost, (two_form(a, b) - first).abs());
                size = larger(size, first.abs());
            }
        }
    }
    Ok(lost / size)
}

pub(super) fn forms_are_preserved(case: &Case) -> Outcome {
    let preserves = match case.form {
        PreservedForm::Nothing => false,
        PreservedForm::OmegaIfAffine => case.subject.regular || case.subject.is_affine(),
        _ => true,
    } && !case.subject.is_forced();
    if preserves {
        below(lost(case)?, 1e-13, "the form changes")
    } else if (1..=4).contains(&case.order) {
        below(-lost(case)?, -2e-12, "it preserves what it does not say")
    } else {
        Ok(())
    }
}

of_every_kind!(forms_are_preserved, affine at_large in_class separable regular constrained);
