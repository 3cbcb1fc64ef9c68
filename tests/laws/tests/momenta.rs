//! A scheme that preserves dq ∧ dp keeps the momentum maps of symmetries that act linearly, which the
//! motion keeps (Marsden & West 2001, section 1.3.3).

use dvi_core::methods::PreservedForm;
use dvi_laws::Case;
use dvi_tests::larger;

use super::{Outcome, below, of_every_kind};

pub(super) fn momentum_maps_are_kept(case: &Case) -> Outcome {
    let mut run = case.run()?;
    let preserves = matches!(case.form, PreservedForm::Canonical | PreservedForm::OmegaIfAffine);
    let (Some(first), true) = (run.momentum(), preserves) else { return Ok(()) };
    let end = case.begin([case.subject.t, case.subject.h], case.subject.end())?;
    let changed = (end.momentum().ok_or("a momentum")? - first).abs();
    if !case.is_plain() || changed > 1e-9 {
        return Ok(());
    }
    let mut worst = 0.0;
    for _ in 0..20 {
        run.take_steps(25)?;
        worst = larger(worst, (run.momentum().ok_or("a momentum")? - first).abs());
    }
    below(worst, 1e-13, "the momentum drifts")
}

of_every_kind!(momentum_maps_are_kept, separable regular constrained);
