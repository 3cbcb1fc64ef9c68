//! What a run has cost.

use core::ops::AddAssign;

/// Counters of the work done by a run, starting values not included.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// let mut run = Integrator::new(&Pendulum, Variational::trapezoid(), 0.1, start)?;
/// run.take_steps(1000)?;
/// let Statistics { steps, iterations, gradients, .. } = run.statistics();
/// assert_eq!((steps, iterations), (1000, 0)); // an explicit step
/// assert!(gradients <= 1001); // one force a step
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Statistics {
    /// Completed steps.
    pub steps: u64,
    /// Steps that a step control has tried and taken back, because their error was too large or because they
    /// failed.
    pub rejected: u64,
    /// Iterations of nonlinear solvers, of both kinds.
    pub iterations: u64,
    /// Evaluations of ∇H, or of ∂L/∂q and ∂L/∂v together.
    pub gradients: u64,
    /// Evaluations of second derivatives of L for the matrices of Newton's method in a step. Those for other
    /// matrices, such as the one that gives velocities for momenta, do not count.
    pub linearizations: u64,
    /// Factorisations of a matrix; divisions by the entries of a matching do not count.
    pub factorisations: u64,
}

impl Statistics {
    /// All counters.
    #[cfg(feature = "alloc")]
    pub(crate) fn counts(self) -> [u64; 6] {
        let Self { steps, rejected, iterations, gradients, linearizations, factorisations } = self;
        [steps, rejected, iterations, gradients, linearizations, factorisations]
    }
}

impl AddAssign for Statistics {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        self.steps += other.steps;
        self.rejected += other.rejected;
        self.iterations += other.iterations;
        self.gradients += other.gradients;
        self.linearizations += other.linearizations;
        self.factorisations += other.factorisations;
    }
}
