//! Seams that turn within a step: that come nearer at its beginning and go away at its end, as the slopes
//! there tell, or turn more often on the cubic path between the ends.

use super::ControlledRun;
use super::seams::Seams;
use crate::error::StepFailure;
use crate::methods::Method;
use crate::scalar::norm::larger;
use crate::solve::crossing::{Sample, dip};
use crate::{Lagrangian, Real, Scalar};

/// A seam that is not crossed by so many rounding errors of its values at both ends of a step is touched.
const TOUCHING: f64 = 64.0;
/// Looks at the turn of a seam that comes nearer at the beginning of a step and goes away at its end.
const SURE: usize = 6;
/// The places of a step at which seams are looked at for turns: uneven, so that no oscillation keeps step.
const PLACES: [f64; 13] = [0.001, 0.08, 0.19, 0.27, 0.38, 0.45, 0.56, 0.66, 0.74, 0.85, 0.93, 0.999, 1.0];

impl<S: Lagrangian<T>, T: Real> Seams<S, T> {
    /// The part of a step of length `h`, which has been taken, that ends well before a seam turns for the
    /// second time: [`end`](Self::end) sees one turn. As far as the cubic path between its ends tells; a
    /// seam that is farther from zero than it changes may turn as it likes. To be asked behind
    /// [`end`](Self::end), which knows the velocity there.
    pub(super) fn second_turn<M: Method<S, T>>(
        &mut self,
        run: &ControlledRun<'_, S, M, T>,
        h: T,
    ) -> Option<T> {
        let (nothing, mut first) = (T::lift(0.0), None);
        for seam in 0..S::SEAMS {
            let noise = self.noise(run, seam, h);
            let ([mut earlier, mut before], mut last) = ([nothing; 2], self.at_begin(run.system(), seam));
            let ([mut low, mut high], mut slope, mut turns) = ([last; 2], nothing, 0);
            for place in PLACES.map(T::lift) {
                self.set_near(run, [place, h]);
                let value = run.system().seam(seam, &self.near[0], &self.near[1], self.t + place * h);
                (low, high) = (-larger(-low, -value), larger(high, value));
                let change = value - last;
                if Scalar::abs(change) <= noise {
                    continue;
                }
                turns += usize::from(change * slope < nothing);
                let may_meet = larger(low, -high) <= high - low;
                if turns == 2 && may_meet && first.is_none_or(|first| earlier < first) {
                    first = Some(earlier);
                }
                ([earlier, before], last, slope) = ([before, place], value, change);
            }
        }
        first.map(|first| larger(first, T::lift(PLACES[1])))
    }

    /// What rounding may change a seam by at the end of a step of length `h`: each number there is moved up
    /// or down, as a bit of its place among all says, so that of two whose changes cancel one goes up where
    /// the other goes down.
    fn noise<M: Method<S, T>>(&mut self, run: &ControlledRun<'_, S, M, T>, seam: usize, h: T) -> T {
        let (one, part) = (T::lift(1.0), T::lift(TOUCHING) * T::default_epsilon());
        let (system, t, last) = (run.system(), self.t + h, 2 * self.q.len());
        let value = system.seam(seam, run.q(), &self.v_end, t);
        let mut noise = T::lift(0.0);
        for bit in 0..=last.ilog2() {
            let moved =
                |place: usize, x: T| x * if (place >> bit) & 1 == 0 { one + part } else { one - part };
            let [near_q, near_v] = &mut self.near;
            for (k, &q) in run.q().iter().enumerate() {
                (near_q[k], near_v[k]) = (moved(k, q), moved(last - 1 - k, self.v_end[k]));
            }
            let near = system.seam(seam, &self.near[0], &self.near[1], moved(last, t));
            noise = larger(noise, Scalar::abs(near - value));
        }
        noise + Scalar::abs(value) * part
    }

    /// Sets the point near by to a place of a step of length `h`, on the cubic path between its ends.
    fn set_near<M: Method<S, T>>(&mut self, run: &ControlledRun<'_, S, M, T>, [x, h]: [T; 2]) {
        let [one, two, three, six] = [1.0, 2.0, 3.0, 6.0].map(T::lift);
        let [near_q, near_v] = &mut self.near;
        for (k, &end) in run.q().iter().enumerate() {
            let (moved, [v, v_end]) = (end - self.q[k], [self.v[k], self.v_end[k]].map(|v| h * v));
            near_q[k] =
                self.q[k] + x * x * (three - two * x) * moved + x * (x - one) * ((x - one) * v + x * v_end);
            let rate = six * x * (one - x) * moved
                + (x - one) * (three * x - one) * v
                + x * (three * x - two) * v_end;
            near_v[k] = rate / h;
        }
    }

    /// A part of a step of length `h`, which has been taken, at which a seam has been crossed that is ahead
    /// at its end. The run is moved to it, if there is one.
    pub(super) fn dip<M: Method<S, T>>(
        &mut self,
        run: &mut ControlledRun<'_, S, M, T>,
        h: T,
    ) -> Result<Option<T>, StepFailure> {
        let [nothing, one] = [0.0, 1.0].map(T::lift);
        for seam in 0..S::SEAMS {
            if self.at_begin(run.system(), seam) == nothing {
                continue;
            }
            let (from, to) = (self.sample(run, seam, [nothing, h]), self.sample(run, seam, [one, h]));
            let rounding = T::lift(TOUCHING) * T::default_epsilon() * (from.value + to.value);
            let mut is_moved = false;
            let low = dip([from, to], SURE, &mut |place| {
                is_moved = true;
                self.look(run, place * h)?;
                let here = self.sample(run, seam, [place, h]);
                Ok(Sample { value: here.value + rounding, ..here })
            })?;
            if low.is_some() {
                return Ok(low);
            }
            if is_moved {
                self.look(run, h)?;
            }
        }
        Ok(None)
    }

    /// How far ahead a seam is at a place of a step of length `h`, where the run is, or where the step
    /// begins, and how that changes with the place: along the velocity, which changes evenly from the
    /// beginning.
    fn sample<M: Method<S, T>>(
        &mut self,
        run: &ControlledRun<'_, S, M, T>,
        seam: usize,
        [place, h]: [T; 2],
    ) -> Sample<T> {
        let [nothing, one] = [0.0, 1.0].map(T::lift);
        let (system, begins) = (run.system(), place == nothing);
        let (q, v) = if begins { (&*self.q, &*self.v) } else { (run.q(), &*self.v_end) };
        let (t, chord) = (self.t + place * h, Scalar::sqrt(T::default_epsilon()));
        let part = chord / if begins { one } else { place };
        let [near_q, near_v] = &mut self.near;
        for k in 0..q.len() {
            near_q[k] = q[k] + chord * h * v[k];
            near_v[k] = v[k] + part * (self.v_end[k] - self.v[k]);
        }
        let side = if self.at_begin(system, seam) < nothing { -one } else { one };
        let value = side * system.seam(seam, q, v, t);
        let near = side * system.seam(seam, &self.near[0], &self.near[1], t + chord * h);
        Sample { place, value, slope: (near - value) / chord }
    }
}
