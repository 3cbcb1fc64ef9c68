//! How the equation of an implicit step is solved: one loop for all iterations, and one order in which they are tried.

mod stopping;

use crate::Real;
use crate::error::StepFailure;
use crate::statistics::Statistics;

pub(crate) use stopping::Convergence;
pub use stopping::Stopping;
use stopping::Verdict;

/// The iteration that solves an implicit step.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Solver {
    /// Fixed point where it contracts fast, Newton where it does not: a step whose fixed-point iteration
    /// is slow is done again by Newton, and so are the 31 steps after it before the fixed point is tried
    /// anew. It holds storage for the Newton matrix.
    #[default]
    Automatic,
    /// One gradient per iteration, no matrix (nonlinear α: one matrix of first derivatives per step).
    FixedPoint,
    /// The exact matrix of second derivatives, factored in each iteration.
    Newton,
}

/// Where Newton begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Guess {
    /// What the last steps let expect, which is best as a rule.
    Extrapolated,
    /// No increment: Newton's first iterate is then the linearly implicit step, which is safer where steps are so long
    /// that extrapolation is off.
    Zero,
}

/// After the fixed point has failed, this many steps are left to Newton before it is tried again.
const STEPS_BEFORE_RETRY: u32 = 32;

/// Iterates until a correction counts as the last. `improve` applies a correction and returns its size.
///
/// # Errors
/// [`StepFailure::NotConverged`], or that of an iteration.
#[inline(always)]
pub(crate) fn iterate<T: Real>(
    mut convergence: Convergence<T>,
    statistics: &mut Statistics,
    mut improve: impl FnMut(&mut Statistics) -> Result<T, StepFailure>,
) -> Result<(), StepFailure> {
    let result = loop {
        let correction = match improve(statistics) {
            Ok(correction) => correction,
            Err(failure) => break Err(failure),
        };
        match convergence.judge(correction) {
            Verdict::Continue => {}
            Verdict::Accept => break Ok(()),
            Verdict::GiveUp => break Err(convergence.failure()),
        }
    };
    statistics.iterations += convergence.iterations as u64;
    result
}

/// How the implicit steps of a run are solved, decided when it begins: `N` is the storage that Newton needs.
#[derive(Debug)]
pub(crate) enum Ladder<N> {
    FixedPoint,
    Newton(N),
    /// The fixed point; Newton where that fails, and for the steps that are left to it.
    Automatic {
        newton: N,
        steps_left: u32,
    },
}

impl<N> Ladder<N> {
    pub(crate) fn new(solver: Solver, storage: impl FnOnce() -> N) -> Self {
        match solver {
            Solver::FixedPoint => Self::FixedPoint,
            Solver::Newton => Self::Newton(storage()),
            Solver::Automatic => Self::Automatic { newton: storage(), steps_left: 0 },
        }
    }

    /// Solves the step of `attempt`: by the fixed point where this run has one, and by Newton where it has not or that
    /// fails; by Newton a second time from another guess where it fails too.
    ///
    /// # Errors
    /// That of the last attempt.
    #[inline(always)]
    pub(crate) fn solve<A>(
        &mut self,
        attempt: &mut A,
        statistics: &mut Statistics,
        fixed_point: impl FnOnce(&mut A, &mut Statistics) -> Result<(), StepFailure>,
        newton: impl FnMut(&mut A, &mut N, Guess, &mut Statistics) -> Result<(), StepFailure>,
    ) -> Result<(), StepFailure> {
        let begins_with_fixed_point = match self {
            Self::FixedPoint => true,
            Self::Newton(_) => false,
            Self::Automatic { steps_left, .. } => *steps_left == 0,
        };
        if begins_with_fixed_point {
            let result = fixed_point(attempt, statistics);
            match (&result, &self) {
                // Where there is nothing to iterate on, Newton does not help.
                (Ok(()) | Err(StepFailure::Resonance { .. } | StepFailure::Frequency { .. }), _)
                | (_, Self::FixedPoint | Self::Newton(_)) => return result,
                (Err(_), Self::Automatic { .. }) => {}
            }
        }
        self.solve_by_newton(attempt, statistics, newton)
    }

    #[inline(never)]
    fn solve_by_newton<A>(
        &mut self,
        attempt: &mut A,
        statistics: &mut Statistics,
        mut newton: impl FnMut(&mut A, &mut N, Guess, &mut Statistics) -> Result<(), StepFailure>,
    ) -> Result<(), StepFailure> {
        let mut by_newton = |storage: &mut N| {
            newton(attempt, storage, Guess::Extrapolated, statistics)
                .or_else(|_| newton(attempt, storage, Guess::Zero, statistics))
        };
        match self {
            // It has returned.
            Self::FixedPoint => Err(StepFailure::Singular { column: 0, pivot: f64::NAN }),
            Self::Newton(storage) => by_newton(storage),
            Self::Automatic { newton, steps_left } => {
                by_newton(newton)?;
                // A step that failed leaves no trace.
                *steps_left = if *steps_left == 0 { STEPS_BEFORE_RETRY - 1 } else { *steps_left - 1 };
                Ok(())
            }
        }
    }

    /// How many iterations the fixed point gets of at most `max`; fewer, `patience`, where Newton stands by.
    #[inline(always)]
    pub(crate) fn budget(&self, max: usize, patience: usize) -> usize {
        match self {
            Self::FixedPoint | Self::Newton(_) => max,
            Self::Automatic { .. } => max.min(patience),
        }
    }

    /// Takes over what the next step depends on.
    pub(crate) fn restore(&mut self, from: &Self) {
        if let (Self::Automatic { steps_left, .. }, Self::Automatic { steps_left: from, .. }) = (self, from) {
            *steps_left = *from;
        }
    }
}
