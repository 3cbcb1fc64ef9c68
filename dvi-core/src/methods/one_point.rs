//! What a run carries whose steps couple two points of Q, with p = α(q) at each: no parasitic mode is left.

use crate::error::StartError;
use crate::mechanics::motion;
use crate::mechanics::orientation::FormOrientation;
use crate::memory::lasting;
use crate::state::rates::Rates;
use crate::system::Degenerate;
use crate::{DegenerateLagrangian, Real, Space, System, Vector};

#[derive(Debug)]
pub(super) struct OnePoint<S: System, T: Real, const KINDS: usize = 1> {
    /// α at the present point.
    pub(super) p: Vector<S, T>,
    /// The mean rates of change of the last steps, and what else a method guesses from.
    pub(super) rates: Rates<S, T, KINDS>,
    pub(super) orientation: FormOrientation<S, T>,
}

impl<S: DegenerateLagrangian<T>, T: Real, const KINDS: usize> OnePoint<S, T, KINDS> {
    /// At (`q`, `t`), where each kind begins with what `seeds` makes of the rates of the motion.
    ///
    /// # Errors
    /// [`StartError::Starter`] where the equations of motion have no solution.
    pub(super) fn new(
        system: &S,
        q: &Vector<S, T>,
        t: T,
        seeds: impl FnOnce(Vector<S, T>) -> [Vector<S, T>; KINDS],
    ) -> Result<Self, StartError> {
        let mut p = system.space().vector();
        system.one_form(q, t, &mut p);
        let velocity =
            <Degenerate as motion::Rates<S, T>>::rates(system, q, &[], t).map_err(StartError::Starter)?;
        let rates = Rates::new(system, seeds(velocity));
        Ok(Self { p, rates, orientation: FormOrientation::new(system, q, t) })
    }

    /// Moves `q` to the end of a step of length `h`, where q and α are those of `end`.
    #[inline]
    pub(super) fn arrive(
        &mut self,
        q: &mut Vector<S, T>,
        (next, p): (&[T], &[T]),
        h: T,
        rates: [&Vector<S, T>; KINDS],
    ) {
        q.copy_from_slice(next);
        self.p.copy_from_slice(p);
        self.rates.push(h, rates);
    }
}

lasting!([S: System, T: Real, const KINDS: usize] OnePoint<S, T, KINDS>, T;
    numbers p, part rates, part orientation);
