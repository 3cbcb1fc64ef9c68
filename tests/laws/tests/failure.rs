//! Wherever in a step a formula is no number, in any stage or iteration, the step fails with a reason
//! and leaves the run where it was, or finds its way without that evaluation; and the run goes on as if
//! nothing had been.

use dvi_core::prelude::StepFailure;
use dvi_laws::equations::apart;
use dvi_laws::{Fused, fuse, fused};
use dvi_tests::bits;

use super::{Outcome, ask, below};

/// Whether the failure says what a number that is none can be taken for.
fn is_explained(failure: StepFailure) -> bool {
    use StepFailure as F;
    matches!(
        failure,
        F::NotFinite { .. }
            | F::NotConverged { .. }
            | F::Singular { .. }
            | F::Orientation { .. }
            | F::LeftDomain
            | F::UndefinedConstraint { .. }
            | F::RedundantConstraint { .. }
            | F::Energy { .. }
            | F::Gap { .. }
            | F::HalfTurn { .. }
    )
}

pub(super) fn a_failed_step_leaves_no_trace(case: &Fused) -> Outcome {
    let mut failed = 0;
    // Where a run is without a fuse.
    let mut smooth = case.bare()?;
    let mut course = vec![(smooth.values(), smooth.time())];
    for _ in 0..7 {
        smooth.advance()?;
        course.push((smooth.values(), smooth.time()));
    }
    for (before, lasting) in [(0, 0), (3, 0), (3, u64::MAX)] {
        for count in 0.. {
            let mut tried = case.bare()?;
            (0..before).try_for_each(|_| tried.advance())?;
            fuse::set(count, lasting);
            let taken = tried.advance();
            if fuse::take() {
                taken?;
                break;
            }
            if let Err(failure) = taken {
                failed += 1;
                if !is_explained(failure) {
                    return Err(format!("evaluation {count}: {failure}").into());
                }
                let (values, time) = &course[before];
                if (bits(&tried.values()), tried.time()) != (bits(values), *time) {
                    return Err(format!(
                        "after {failure} of evaluation {count} ({lasting} more) it is elsewhere"
                    )
                    .into());
                }
                tried.advance()?;
            }
            for (values, _) in &course[before + 1..before + 4] {
                let off = apart(&tried.values(), values);
                below(off, 1e-13, &format!("evaluation {count} ({lasting} more) has left a trace"))?;
                tried.advance()?;
            }
        }
    }
    if failed > 0 { Ok(()) } else { Err("no evaluation fails".into()) }
}

#[test]
fn of_every_scheme() {
    ask(&fused(), a_failed_step_leaves_no_trace);
}
