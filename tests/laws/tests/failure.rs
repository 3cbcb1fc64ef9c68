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
    for (before, lasting) in [(0, 0), (3, 0), (3, u64::MAX)] {
        for count in 0.. {
            let (mut tried, mut smooth) = (case.bare()?, case.bare()?);
            for _ in 0..before {
                tried.advance()?;
                smooth.advance()?;
            }
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
                if (bits(&tried.values()), tried.time()) != (bits(&smooth.values()), smooth.time()) {
                    return Err(format!(
                        "after {failure} of evaluation {count} ({lasting} more) it is elsewhere"
                    )
                    .into());
                }
                tried.advance()?;
            }
            smooth.advance()?;
            for _ in 0..3 {
                let off = apart(&tried.values(), &smooth.values());
                below(off, 1e-13, &format!("evaluation {count} ({lasting} more) has left a trace"))?;
                tried.advance()?;
                smooth.advance()?;
            }
        }
    }
    if failed > 0 { Ok(()) } else { Err("no evaluation fails".into()) }
}

#[test]
fn of_every_scheme() {
    ask(&fused(), a_failed_step_leaves_no_trace);
}
