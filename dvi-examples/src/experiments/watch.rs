//! A long run that is looked at now and then.

use dvi_core::error::StepError;

use crate::job::Job;

/// Steps of a run of which every so many are followed by a look at the state.
#[derive(Clone, Copy, Debug)]
pub struct Watch {
    pub steps: u64,
    pub every: u64,
    /// The length of a step.
    pub h: f64,
}

impl Watch {
    /// Hands the time and the state that `later` comes to, again and again, to `note`.
    ///
    /// # Errors
    /// That of the first step that fails.
    pub fn run<S>(
        self,
        job: &Job<'_>,
        mut later: impl FnMut() -> Result<S, StepError>,
        mut note: impl FnMut(f64, &S),
    ) -> Result<(), StepError> {
        let mut done = 0_u64;
        job.repeat(self.steps / self.every, || {
            let state = later()?;
            done += self.every;
            note(done as f64 * self.h, &state);
            Ok(())
        })
    }
}
