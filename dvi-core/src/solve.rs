//! How the equation of an implicit step is solved: one loop for all iterations, and one order in which they
//! are tried.

mod coupled;
pub(crate) mod crossing;
mod fixed_point;
mod newton;
pub(crate) mod sizes;
mod stopping;

use crate::Real;
use crate::error::StepFailure;
use crate::memory::lasting;
use crate::scalar::{carries_derivatives, is_plain};
use crate::space::linear::Storing;
use crate::state::Statistics;

pub(crate) use crate::state::history::Guess;
pub(crate) use coupled::{CoupledEquations, solve_coupled};
pub(crate) use fixed_point::solve_by_fixed_point;
pub(crate) use newton::{AtIncrement, Linearize, residual, solve_by_newton};
pub(crate) use sizes::Due;
pub use stopping::Stopping;
pub(crate) use stopping::{Convergence, Convergences, Course, Judge, Quick, Verdict};

/// The iteration that solves an implicit step.
///
/// ```
#[doc = include_str!("../docs/hidden/vortices.txt")]
/// let newton = Sigma { solver: Solver::Newton, ..Sigma::midpoint() };
/// let mut quick = Integrator::new(&Vortices, Sigma::midpoint(), 0.1, start.clone())?;
/// let mut newton = Integrator::new(&Vortices, newton, 0.1, start)?;
/// quick.take_steps(100)?;
/// newton.take_steps(100)?;
/// // The same steps, in more iterations without a matrix or in fewer with one.
/// assert!((quick.state().x[0] - newton.state().x[0]).abs() < 1e-13);
/// assert!(quick.statistics().linearizations == 0 && newton.statistics().linearizations > 0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Solver {
    /// Fixed point where it contracts fast, Newton where it does not: a step whose fixed-point iteration is
    /// slow is done again by Newton, and so are the 31 steps after it before the fixed point is tried anew.
    /// It holds storage for the Newton matrix, unless that would take more than 1024 numbers for each
    /// coordinate: there it is [`NewtonKrylov`](Self::NewtonKrylov) that stands by.
    #[default]
    Automatic,
    /// One gradient per iteration, no matrix (nonlinear α: one matrix of first derivatives per step).
    FixedPoint,
    /// The exact matrix of second derivatives, factored in each iteration, in the storage that its pattern
    /// needs.
    Newton,
    /// Newton's method from products of that matrix with vectors alone, by the generalised minimal residual
    /// method: for many bodies that all depend on each other, whose matrix is too large. It fails where
    /// forces between neighbours are so stiff that 200 products do not make the residual ten times smaller.
    /// Systems of fixed size are solved as by [`Newton`](Self::Newton), and so are runs in dual numbers.
    NewtonKrylov,
}

impl Solver {
    /// How Newton's equations are stored.
    pub(crate) fn storing(self) -> Storing {
        match self {
            Self::Automatic => Storing::IfSmall,
            Self::FixedPoint | Self::Newton => Storing::Always,
            Self::NewtonKrylov => Storing::Never,
        }
    }

    /// The solver of a run in `T`: where numbers carry derivatives, of which a fixed point does not see
    /// whether they have converged, Newton's method, which needs to know no more than when values have.
    pub(crate) fn in_numbers<T: Real>(self) -> Self {
        match self {
            Self::Automatic | Self::NewtonKrylov if carries_derivatives::<T>() => Self::Newton,
            solver => solver,
        }
    }
}

/// After the fixed point has failed, this many steps are left to Newton before it is tried again.
const STEPS_BEFORE_RETRY: u32 = 32;

/// What is iterated.
pub(crate) trait Iteration<T> {
    /// Does what is due, in a loop of its own: what an improvement reads and does not change can stay in
    /// registers then. What is left to do is left to [`improve`](Self::improve).
    #[inline]
    fn prepare(&mut self, _due: &mut Due) {}

    /// Applies a correction and returns the largest of its sizes in the units of the coordinates, after it
    /// has done what is `due`.
    ///
    /// # Errors
    /// Any [`StepFailure`] ends the iteration.
    fn improve(&mut self, due: &mut Due, statistics: &mut Statistics) -> Result<T, StepFailure>;

    /// Counts what `times` improvements have cost, if they have not counted it themselves.
    #[inline]
    fn count(&self, _times: u64, _statistics: &mut Statistics) {}
}

impl<T, F: FnMut(&mut Due, &mut Statistics) -> Result<T, StepFailure>> Iteration<T> for F {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn improve(&mut self, due: &mut Due, statistics: &mut Statistics) -> Result<T, StepFailure> {
        self(due, statistics)
    }
}

/// Repeats an iteration until a correction counts as the last.
///
/// # Errors
/// [`StepFailure::NotConverged`], or that of an iteration.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn repeat<T: Real>(
    mut convergence: impl Judge<T>,
    statistics: &mut Statistics,
    mut iteration: impl Iteration<T>,
) -> Result<(), StepFailure> {
    // The second is how many improvements there were beside the iterations.
    let (result, more) = 'iterated: loop {
        iteration.prepare(&mut convergence.course().due);
        loop {
            let correction = match iteration.improve(&mut convergence.course().due, statistics) {
                Ok(correction) => correction,
                Err(failure) => break 'iterated (Err(failure), 1),
            };
            match convergence.judge(correction) {
                Verdict::Continue if convergence.course().due == Due::Nothing => {}
                Verdict::Continue => break,
                // Comparisons have not seen the derivatives that numbers may carry; for plain numbers this
                // is not compiled.
                Verdict::Accept if const { !is_plain::<T>() } && carries_derivatives::<T>() => {
                    let Course { due, more, .. } = convergence.course();
                    let more = *more;
                    let mut improve = |_| iteration.improve(due, statistics).map(drop);
                    break 'iterated ((0..more).try_for_each(&mut improve), more as u64);
                }
                Verdict::Accept => break 'iterated (Ok(()), 0),
                Verdict::GiveUp => break 'iterated (Err(convergence.course().failure()), 0),
            }
        }
    };
    let iterations = convergence.course().iterations as u64;
    statistics.iterations += iterations;
    iteration.count(iterations + more, statistics);
    result
}

/// Newton's method: iterates until a correction counts as the last. `improve` is as [`Iteration::improve`];
/// an iteration takes so long that a pointer to it costs nothing.
#[inline]
pub(crate) fn newton<T: Real>(
    stopping: Stopping,
    statistics: &mut Statistics,
    improve: &mut dyn FnMut(&mut Due, &mut Statistics) -> Result<T, StepFailure>,
) -> Result<(), StepFailure> {
    repeat(Convergence::new(stopping, stopping.max_iterations), statistics, improve)
}

/// Attempts a step from what the last steps let expect, and from zero where that fails: where steps are
/// long, extrapolation is off, or leads to another branch.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn from_either_guess(
    mut attempt: impl FnMut(Guess) -> Result<(), StepFailure>,
) -> Result<(), StepFailure> {
    // In a loop, as there is one copy of the attempt in the code then.
    let mut guess = Guess::Extrapolated;
    loop {
        match attempt(guess) {
            Err(_) if guess == Guess::Extrapolated => guess = Guess::Zero,
            result => return result,
        }
    }
}

/// How the implicit steps of a run are solved, decided when it begins: by the fixed point, by Newton, or by
/// Newton where the fixed point fails.
#[derive(Debug)]
pub(crate) struct Ladder<N> {
    newton: Option<Newton<N>>,
}

/// Newton, with the storage that it needs.
#[derive(Debug)]
struct Newton<N> {
    storage: N,
    /// Whether all steps are Newton's, and else how many are before the fixed point is tried again.
    always: bool,
    steps_left: u32,
}

impl<N> Ladder<N> {
    pub(crate) fn new(solver: Solver, storage: impl FnOnce() -> N) -> Self {
        let always = match solver {
            Solver::FixedPoint => return Self { newton: None },
            Solver::Newton | Solver::NewtonKrylov => true,
            Solver::Automatic => false,
        };
        Self { newton: Some(Newton { storage: storage(), always, steps_left: 0 }) }
    }

    /// Solves the step of `attempt`: by the fixed point where this run has one, and by Newton where it has
    /// not or that fails; by Newton a second time from another guess where it fails too.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn solve<A>(
        &mut self,
        attempt: &mut A,
        statistics: &mut Statistics,
        fixed_point: impl FnOnce(&mut A, &mut Statistics) -> Result<(), StepFailure>,
        solve_by_newton: impl FnMut(&mut A, &mut N, Guess, &mut Statistics) -> Result<(), StepFailure>,
    ) -> Result<(), StepFailure> {
        let newton = match &mut self.newton {
            Some(newton) if newton.always || newton.steps_left > 0 => newton,
            newton => match (fixed_point(attempt, statistics), newton) {
                // Where there is nothing to iterate on, Newton does not help.
                (
                    result @ (Ok(()) | Err(StepFailure::Resonance { .. } | StepFailure::Frequency { .. })),
                    _,
                )
                | (result, None) => return result,
                (Err(_), Some(newton)) => newton,
            },
        };
        newton.solve(attempt, statistics, solve_by_newton)
    }

    /// Whether the next step begins with the fixed point.
    pub(crate) fn tries_fixed_point(&self) -> bool {
        self.newton.as_ref().is_none_or(|newton| !newton.always && newton.steps_left == 0)
    }

    /// Tries the fixed point in the next step, as in the first.
    pub(crate) fn begin_again(&mut self) {
        if let Some(newton) = &mut self.newton {
            newton.steps_left = 0;
        }
    }

    /// How many iterations the fixed point gets of at most `max`; fewer, `patience`, where Newton stands by.
    #[inline]
    pub(crate) fn budget(&self, max: usize, patience: usize) -> usize {
        if self.newton.is_some() { max.min(patience) } else { max }
    }
}

lasting!([N, T: Real] Ladder<N>, T; parts newton);

lasting!([N, T: Real] Newton<N>, T; count steps_left);

impl<N> Newton<N> {
    #[inline(never)]
    fn solve<A>(
        &mut self,
        attempt: &mut A,
        statistics: &mut Statistics,
        mut solve: impl FnMut(&mut A, &mut N, Guess, &mut Statistics) -> Result<(), StepFailure>,
    ) -> Result<(), StepFailure> {
        from_either_guess(|guess| solve(attempt, &mut self.storage, guess, statistics))?;
        // A step that failed leaves no trace.
        self.steps_left = if self.steps_left == 0 { STEPS_BEFORE_RETRY - 1 } else { self.steps_left - 1 };
        Ok(())
    }
}
