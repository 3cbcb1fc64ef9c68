//! The states of a run at given times.

use core::iter::FusedIterator;

use super::{Dense, StateOf};
use crate::error::StepError;
use crate::run::Run;

/// The states of a run at given times: see [`Run::states_at`].
#[derive(Debug)]
pub struct StatesAt<R: Run, I> {
    pub(super) dense: Dense<R>,
    pub(super) times: I,
    pub(super) failed: bool,
}

impl<R: Run, I: Iterator<Item = R::Scalar>> Iterator for StatesAt<R, I> {
    type Item = Result<(R::Scalar, StateOf<R>), StepError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.failed {
            return None;
        }
        let t = self.times.next()?;
        let state = self.dense.state_at(t).map(|state| (t, state));
        self.failed = state.is_err();
        Some(state)
    }
}

impl<R: Run, I: Iterator<Item = R::Scalar>> FusedIterator for StatesAt<R, I> {}
