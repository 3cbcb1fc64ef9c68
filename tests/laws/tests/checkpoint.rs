//! A run goes on from its checkpoint, written to a text and read again, and on a memory that is restored
//! from another, bit by bit as if it had not stopped; and many steps at once are the same steps.

use dvi_core::error::StartError;
use dvi_core::run::Checkpoint;
use dvi_core::state::Statistics;
use dvi_laws::case::Written;
use dvi_laws::{Case, STIFF, fused, stiff};
use dvi_tests::bits;

use super::{Outcome, ask, of_every_kind};

/// As a text, and back.
fn written_and_read(checkpoint: &Checkpoint) -> Outcome<Checkpoint> {
    let read = serde_json::from_str(&serde_json::to_string(checkpoint)?)?;
    if &read == checkpoint { Ok(read) } else { Err("what is read is not what was written".into()) }
}

type Asked = (Vec<u64>, u64, (u64, u64, Statistics), Checkpoint);

/// What can be asked of a run, numbers as bits.
fn asked(run: &dyn Written) -> Asked {
    (bits(&run.values()), run.time().to_bits(), run.asked(), run.checkpoint())
}

fn same(run: &dyn Written, other: &dyn Written, what: &str) -> Outcome {
    if asked(run) == asked(other) { Ok(()) } else { Err(format!("{what} it is another run").into()) }
}

type Begun = Result<Box<dyn Written>, StartError>;

/// Of a run before its first step, after it, and in its middle.
fn runs_and_their_checkpoints_go_on(
    steps: u64,
    begin: impl Fn() -> Begun,
    resume: impl Fn(&Checkpoint) -> Begun,
) -> Outcome {
    for before in [0, 1, steps / 2] {
        let (mut run, mut single) = (begin()?, begin()?);
        run.take_steps(before)?;
        (0..before).try_for_each(|_| single.advance())?;
        same(&*run, &*single, &format!("with {before} steps at once"))?;
        let mut again = resume(&written_and_read(&run.checkpoint())?)?;
        for _ in 0..2 {
            same(&*run, &*again, &format!("from its checkpoint after {before} steps"))?;
            run.take_steps(steps / 4)?;
            again.take_steps(steps / 4)?;
        }
    }
    Ok(())
}

pub(super) fn runs_go_on(case: &Case) -> Outcome {
    // Guesses are made from seven steps; what is seen of parasites, where states have momenta of their own,
    // from more.
    let steps = case.subject.steps.min(if case.has_hidden_state() { u32::MAX } else { 24 });
    runs_and_their_checkpoints_go_on(steps.into(), || case.run(), |checkpoint| case.resume(checkpoint))?;
    let few = (case.subject.steps / 4).min(steps / 3);
    [0, 1, steps / 2].iter().try_for_each(|&before| case.goes_on_from_a_copy(before, few))
}

of_every_kind!(runs_go_on);

/// Where the fixed point does not contract, and is tried again after some steps.
#[test]
fn of_stiff_steps() {
    ask(&stiff(&STIFF), runs_go_on);
}

/// With impacts, noise and rotations too.
#[test]
fn of_every_scheme() {
    ask(&fused(), |case| {
        runs_and_their_checkpoints_go_on(12, || case.run(), |checkpoint| case.resume(checkpoint))
    });
}
