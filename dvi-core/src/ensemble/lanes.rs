//! Members that go together in the lanes of packs, for methods that have them.

use std::vec::Vec;

use crate::Lagrangian;
use crate::error::StepError;
use crate::methods::{InStep, Method};
use crate::run::{Integrator, Together};

/// Takes steps of several runs. It hides the number of lanes, and what the method must be able to do for
/// them.
pub(super) trait Packs<'a, S: Lagrangian, M: Method<S, f64>> {
    fn take_steps(&mut self, runs: Vec<&mut Integrator<&'a S, M>>, count: u64)
    -> Vec<Result<(), StepError>>;
}

impl<'a, const W: usize, S, M> Packs<'a, S, M> for Together<W, S, M>
where
    S: Lagrangian + PartialEq + 'a,
    M: InStep<W, S> + PartialEq,
{
    fn take_steps(
        &mut self,
        runs: Vec<&mut Integrator<&'a S, M>>,
        count: u64,
    ) -> Vec<Result<(), StepError>> {
        Together::take_steps(self, runs, count)
    }
}
