//! Where a Gauss step is, and what it leaves to the next one.

use super::coefficients::Coefficients;
use crate::error::{StartError, StepFailure};
use crate::mechanics::motion::{
    AtStages, EquationsOf, FirstOrder, FirstOrderAtStages, PackedOf, PointOf, StageWork, weigh,
};
use crate::memory::{Aside, lasting};
use crate::methods::collocation::packs::{at, beside, combine, nothing, replace, sum};
use crate::methods::collocation::stages::NewtonStages;
use crate::scalar::Lanes;
use crate::shown::shown;
use crate::solve::{Due, Guess, Ladder};
use crate::state::Statistics;
use crate::state::summation::{Summation, left_out};
use crate::{Real, Space, System, Vector};

/// The stages of a Gauss step, and those of the step before.
pub struct GaussMemory<const STAGES: usize, S: System<Kind: FirstOrder<S, T>>, T: Real> {
    pub(super) ladder: Ladder<Aside<NewtonStages<STAGES, S, T>>>,
    pub(super) path: Path<STAGES, S, T>,
}

/// Where the run is, and the polynomial on which it goes on from there.
pub(super) struct Path<const STAGES: usize, S: System<Kind: FirstOrder<S, T>>, T: Real> {
    pub(super) equations: EquationsOf<S, T>,
    pub(super) coefficients: Coefficients<STAGES, T>,
    /// The slopes K of the last completed step.
    pub(super) completed: StagesOf<STAGES, S, T>,
    /// The length of that step; zero before the first.
    last: T,
    /// Whether that step is taken again in part, and none after it.
    again: bool,
    /// The largest momentum of late, as far as errors have been estimated.
    pub(super) momentum: T,
    /// What rounding has left out of y, if sums are compensated.
    pub(super) rest: PointOf<S, T>,
    pub(super) slopes: StagesOf<STAGES, S, T>,
    /// L, of these slopes.
    pub(super) terms: StagesOf<STAGES, S, T>,
    pub(super) stages: StagesOf<STAGES, S, T>,
    /// New slopes, where changes of the old ones count; of equations of second order, what a free motion
    /// adds to q at the stages.
    pub(super) renewed: Vector<S, Lanes<STAGES, T>>,
    /// Where the step begins, its increment, and where it ends.
    pub(super) y: PointOf<S, T>,
    pub(super) increment: PointOf<S, T>,
    pub(super) next: PointOf<S, T>,
    /// In which the iteration judges coordinates.
    pub(super) weights: Vector<S, T>,
    pub(super) work: StageWork<STAGES, S, T>,
}

type StagesOf<const STAGES: usize, S, T> = PackedOf<S, T, Lanes<STAGES, T>>;

lasting!([const STAGES: usize, S: System<Kind: FirstOrder<S, T>>, T: Real] GaussMemory<STAGES, S, T>, T;
    part path, part ladder);

lasting!([const STAGES: usize, S: System<Kind: FirstOrder<S, T>>, T: Real] Path<STAGES, S, T>, T;
    part equations, packs completed, number last, number momentum, part rest);

shown!([const STAGES: usize, S: System<Kind: FirstOrder<S, T>>, T: Real] GaussMemory<STAGES, S, T>,
    |memory| completed: memory.path.completed);

impl<const STAGES: usize, S: System<Kind: FirstOrder<S, T>>, T: Real> Path<STAGES, S, T> {
    /// The first part whose slopes are carried from step to step. Of equations of second order, of which
    /// only forces are evaluated, that is the second.
    pub(super) const FIRST_PART: usize = S::Kind::OF_SECOND_ORDER as usize;

    pub(super) fn begin(system: &S, q: &Vector<S, T>, v: &[T], t: T) -> Result<Self, StartError> {
        let mut equations = S::Kind::begin(system, q, v, t)?;
        let [mut y, mut slope, rest, increment, next]: [PointOf<S, T>; 5] = S::Kind::points(system);
        let [mut completed, slopes, terms, stages]: [StagesOf<STAGES, S, T>; 4] = S::Kind::points(system);
        S::Kind::gather(&mut equations, q, &mut y);
        S::Kind::evaluate(&mut equations, system, &y, t, &mut slope, &mut Statistics::default())
            .map_err(StartError::Starter)?;
        for (packs, numbers) in completed.iter_mut().zip(slope.iter()) {
            packs.iter_mut().zip(numbers.iter()).for_each(|(pack, &number)| *pack = Lanes::all(number));
        }
        Ok(Self {
            equations,
            coefficients: Coefficients::new(),
            completed,
            last: T::lift(0.0),
            again: false,
            momentum: T::lift(0.0),
            rest,
            slopes,
            terms,
            stages,
            renewed: system.space().vector(),
            y,
            increment,
            next,
            weights: system.space().vector(),
            work: StageWork::new(system),
        })
    }

    /// Begins at the polynomial of a step that has been `taken` from here, for parts of it: where its
    /// equations have several solutions they are parts of that one.
    pub(super) fn follow(&mut self, taken: &Self) {
        for (packs, taken) in self.completed.iter_mut().zip(taken.completed.iter()) {
            packs.copy_from_slice(taken);
        }
        (self.last, self.again) = (taken.last, true);
    }

    /// Sets the slopes and terms to those of the polynomial through the completed stages, continued into the
    /// next step, or to zero: where they have a kink it leads far away, out of the domain of L too.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn guess(&mut self, guess: Guess, h: T) {
        let Self { coefficients, completed, last, again, slopes, terms, y, .. } = self;
        let weights = Lanes::all(h) * coefficients.b;
        let continued;
        let continuation = if *again {
            continued = coefficients.within(h / *last);
            &continued
        } else if h == *last || *last == T::lift(0.0) {
            &coefficients.continuation
        } else {
            continued = coefficients.continuation_over(h / *last);
            &continued
        };
        for part in Self::FIRST_PART..y.len() {
            match guess {
                Guess::Extrapolated => combine(continuation, &completed[part], nothing, &mut slopes[part]),
                Guess::Zero => slopes[part].fill(Lanes::all(T::lift(0.0))),
            }
            weigh(weights, &slopes[part], &mut terms[part]);
        }
    }

    /// Sets one part of the points of the stages by the slopes of that part.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn reach(&mut self, part: usize) {
        let Self { coefficients, terms, stages, y, rest, .. } = self;
        combine(&coefficients.mu, &terms[part], beside(&y[part], &rest[part]), &mut stages[part]);
    }

    /// Sets the positions of the stages of the last step, and their velocities.
    pub(super) fn set_stages(&mut self) {
        self.set_velocities();
        let Self { coefficients, completed, last, slopes, terms, stages, y, .. } = self;
        if !S::Kind::OF_SECOND_ORDER {
            slopes[0].copy_from_slice(&completed[0]);
        }
        weigh(Lanes::all(*last) * coefficients.b, &slopes[0], &mut terms[0]);
        combine(&coefficients.mu, &terms[0], at(&y[0]), &mut stages[0]);
    }

    /// Evaluates one part of the slopes at the points of all stages, and returns the largest change of a
    /// velocity.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn evaluate_part<E>(
        &mut self,
        part: usize,
        system: &S,
        [t, h]: [T; 2],
        statistics: &mut Statistics,
    ) -> Result<T, StepFailure>
    where
        S::Kind: FirstOrderAtStages<E, STAGES, S, T>,
    {
        let Self { equations, coefficients, slopes, terms, stages, renewed, weights: units, work, .. } =
            self;
        let (velocity, forces) = slopes.split_at_mut(1);
        let t = Lanes::all(t) + coefficients.c * Lanes::all(h);
        let at = AtStages { system, part, y: &*stages, velocity: &velocity[0], t };
        let weights = Lanes::all(h) * coefficients.b;
        if part > 0 {
            let force = &mut forces[part - 1];
            S::Kind::evaluate_at_stages(equations, &at, work, force, statistics)?;
            weigh(weights, force, &mut terms[part]);
            return Ok(T::lift(0.0));
        }
        S::Kind::evaluate_at_stages(equations, &at, work, renewed, statistics)?;
        let terms = &mut terms[0][..];
        let weigh = |k: usize, slope| terms[k] = weights * slope;
        Ok(replace(system, units, &mut velocity[0], renewed, weigh))
    }

    /// Does what is `due` before an iteration from `q`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn prepare(&mut self, system: &S, due: &mut Due, q: &[T], h: T) {
        let Self { coefficients, slopes, terms, stages, weights, .. } = self;
        if S::Kind::OF_SECOND_ORDER {
            return due.prepare_places(system, weights, q, &mut stages[0]);
        }
        if due.prepare_slopes(system, weights, (q, h), &mut slopes[0]) {
            let weights = Lanes::all(h) * coefficients.b;
            weigh(weights, &slopes[0], &mut terms[0]);
        }
    }

    /// Moves to the end of the step by the terms of the parts from `first`, and by the increments of those
    /// before.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn arrive(
        &mut self,
        first: usize,
        summation: Summation,
        system: &S,
        q: &mut Vector<S, T>,
        [t, h]: [T; 2],
    ) -> Result<(), StepFailure> {
        let Self { equations, completed, last, slopes, terms, y, rest, increment, next, .. } = self;
        for part in 0..y.len() {
            if part >= first {
                for (increment, terms) in increment[part].iter_mut().zip(terms[part].iter()) {
                    *increment = sum(&terms.0);
                }
            }
            let numbers = y[part].iter().zip(increment[part].iter()).zip(rest[part].iter());
            for (next, ((&y, &increment), &rest)) in next[part].iter_mut().zip(numbers) {
                *next = y + (increment + rest);
            }
        }
        S::Kind::arrive(equations, system, next, q, t + h)?;
        if summation == Summation::Compensated {
            for part in 0..y.len() {
                let sums = y[part].iter().zip(increment[part].iter()).zip(next[part].iter());
                for (rest, ((&y, &increment), &next)) in rest[part].iter_mut().zip(sums) {
                    *rest = left_out(y, increment + *rest, next);
                }
            }
        }
        for part in first..y.len() {
            completed[part].copy_from_slice(&slopes[part]);
        }
        *last = h;
        Ok(())
    }
}
