//! The work of the forces along a run: the integral of their power F·q' over the time.
//!
//! Between two states the power is taken for the cubic polynomial through the last four of them, which
//! Simpson's rule integrates exactly.

use crate::mechanics::motion::Rates;
use crate::run::Run;
use crate::system::Smooth;
use crate::{Real, System};

/// The states through which the power is interpolated.
const POINTS: usize = 4;

/// The work ∫ F·q' dt that the forces on a system have done along a run.
///
/// Where the Lagrangian does not depend on time, and no constraint moves, the energy changes by this work.
/// So the difference of the two is the error of the method and of this integral, which is of order four if
/// every state is recorded. Constraints g(q, t) = 0 that depend on time, and A v + b = 0 with a b that is
/// not zero, do work that is not in it.
///
/// ```
/// use dvi_core::diagnostics::Work;
/// use dvi_core::prelude::*;
///
/// #[lagrangian(
///     coordinates(x),
///     lagrangian = dot(x).powi(2) / 2.0 - x * x / 2.0,
///     force(x) = -0.1 * dot(x),
/// )]
/// struct Damped;
///
/// let start = DampedState { x: 1.0, dot_x: 0.0 };
/// let mut run = Integrator::new(&Damped, Galerkin::<4>::new(), 0.1, start)?;
/// let (mut work, begin) = (Work::new(&run), run.energy());
/// for _ in 0..100 {
///     run.advance()?;
///     work.record(&run);
/// }
/// assert!((run.energy() - begin - work.total()).abs() < 1e-6);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Work<T = f64> {
    /// Time and power of the last states, the latest first.
    latest: [Sample<T>; POINTS],
    known: usize,
    total: T,
}

#[derive(Clone, Copy, Debug)]
struct Sample<T> {
    t: T,
    power: T,
}

impl<T: Real> Work<T> {
    /// None yet, from the present state of `run`.
    pub fn new<R: Run<Scalar = T>>(run: &R) -> Self
    where
        <R::System as System>::Kind: Rates<R::System, T> + Smooth,
    {
        let start = Sample { t: run.time(), power: run.power() };
        Self { latest: [start; POINTS], known: 1, total: T::lift(0.0) }
    }

    /// Adds the work up to the present state of `run`, at a time other than that of the state before.
    pub fn record<R: Run<Scalar = T>>(&mut self, run: &R)
    where
        <R::System as System>::Kind: Rates<R::System, T> + Smooth,
    {
        self.latest.rotate_right(1);
        self.latest[0] = Sample { t: run.time(), power: run.power() };
        if self.known < POINTS {
            // As long as there are more points to come, all of the work is integrated anew.
            self.known += 1;
            self.total = self.since(self.known - 1);
        } else {
            self.total += self.since(1);
        }
    }

    /// The work since the first record, in units of energy; not a number where a velocity was not
    /// determined.
    pub fn total(&self) -> T {
        self.total
    }

    /// The integral of the polynomial through all points over the last `steps` of them.
    fn since(&self, steps: usize) -> T {
        let (from, to) = (self.latest[steps].t, self.latest[0].t);
        let [half, four, six] = [0.5, 4.0, 6.0].map(T::lift);
        let [begin, middle, end] = [from, half * (from + to), to].map(|t| self.power(t));
        (to - from) / six * (begin + four * middle + end)
    }

    /// The polynomial at time `t`, by Neville's scheme.
    fn power(&self, t: T) -> T {
        let points = &self.latest[..self.known];
        let mut value = self.latest.map(|point| point.power);
        for order in 1..points.len() {
            for k in 0..points.len() - order {
                let (near, far) = (points[k].t, points[k + order].t);
                value[k] = ((t - far) * value[k] + (near - t) * value[k + 1]) / (near - far);
            }
        }
        value[0]
    }
}
