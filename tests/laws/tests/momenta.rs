//! A scheme that preserves dq ∧ dp keeps the momentum maps of symmetries that act linearly, which the
//! motion keeps (Marsden & West 2001, section 1.3.3); one that preserves a conjugate form keeps them at the
//! coordinates of that form.

use dvi_core::methods::PreservedForm;
use dvi_laws::Case;
use dvi_tests::apart;

use super::{Outcome, below, of_every_kind};

/// The momenta where a run is, at the coordinates of the form that the scheme preserves.
fn momenta(case: &Case, t: f64, values: &[f64]) -> Outcome<Vec<f64>> {
    let (subject, mut values) = (&case.subject, values.to_vec());
    if case.form == PreservedForm::Conjugate {
        let (rates, shift) = (subject.rates(&values, t), case.equations.shift() * subject.h.powi(2));
        let second = &rates[subject.dimension()..];
        values.iter_mut().zip(second).for_each(|(q, rate)| *q += shift * rate);
    }
    Ok(case.begin([t, subject.h], &values)?.momenta())
}

pub(super) fn momentum_maps_are_kept(case: &Case) -> Outcome {
    let (subject, mut run) = (&case.subject, case.run()?);
    let preserves = match case.form {
        PreservedForm::Canonical | PreservedForm::Omega | PreservedForm::Conjugate => true,
        PreservedForm::OmegaIfAffine => subject.regular || subject.is_affine(),
        _ => false,
    };
    if !preserves || !case.is_plain() || run.momenta().is_empty() {
        return Ok(());
    }
    let end = case.begin([subject.t + subject.time, subject.h], subject.end())?.momenta();
    let of_motion: Vec<bool> = run.momenta().iter().zip(&end).map(|(a, b)| (a - b).abs() < 1e-9).collect();
    let kept = |t, values: &[f64]| -> Outcome<Vec<f64>> {
        let all = momenta(case, t, values)?.into_iter().zip(&of_motion);
        Ok(all.filter_map(|(momentum, &kept)| kept.then_some(momentum)).collect())
    };
    let first = kept(run.time(), &run.values())?;
    for _ in 0..20 {
        run.take_steps(25)?;
        below(apart(&kept(run.time(), &run.values())?, &first), 1e-13, "a momentum drifts")?;
    }
    Ok(())
}

of_every_kind!(momentum_maps_are_kept, affine at_large in_class separable regular constrained);
