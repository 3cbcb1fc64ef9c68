//! When a run is looked at for its parasitic mode: before that can have become too large.

use super::{KEPT, Monitor, ParasiticMode};
use crate::memory::lasting;
use crate::methods::sigma_family::PARASITIC_LIMIT;
use crate::methods::walk::BLOCK;
use crate::scalar::norm::reported;
use crate::{Real, Scalar, System};

/// A mode that is large from the first steps on, as it is where steps are long, may become this many times
/// as large.
const GROWTH: f64 = 3.0;

/// How many looks show the mode as it is from the start.
const FIRST_LOOKS: u32 = 2;

/// By how many radians the motion turns while the mode may grow e-fold; from this follows when to look
/// again.
const RADIANS: f64 = 4.0;

/// When a run is examined.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::methods::sigma_family) enum Pace {
    /// Before each step: the mode may grow by a factor from step to step.
    EachStep,
    /// Before the mode can have become too large, if it grows at a rate of the flow: after 4 to 256 steps.
    WithTheFlow,
    /// Before every 256th step: the mode does not grow, or nobody minds.
    Seldom,
}

impl Pace {
    /// From the start to the first look.
    pub(super) fn first_period(self) -> u64 {
        match self {
            Self::EachStep => 1,
            Self::WithTheFlow => KEPT as u64,
            Self::Seldom => BLOCK,
        }
    }
}

/// The mode in the first looks of a run whose mode grows with the flow: the largest relative size and
/// amplitude.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct First {
    looks: u32,
    relative: f64,
    amplitude: f64,
}

impl<S: System, T: Real> Monitor<S, T> {
    /// Whether the mode is above the limit, and larger than where it came from.
    pub(super) fn is_above(&self, mode: &ParasiticMode<T>) -> bool {
        let [amplitude, relative] = [mode.amplitude, mode.relative].map(reported);
        let First { looks, relative: first, amplitude: from } = self.first;
        let has_grown = relative > GROWTH * first || amplitude > GROWTH * from;
        self.limit.is_some_and(|limit| relative > limit)
            && mode.is_significant
            && (self.pace != Pace::WithTheFlow || (looks >= FIRST_LOOKS && has_grown))
    }

    /// Notes the mode of the first looks, and sets when to look again: before the mode can have reached the
    /// limit if it grows with the turning of the path, `turned`/`moved` being the square of the angle of a
    /// step, or as it has grown since the last look; and not much later than half as far again as the run
    /// has come.
    pub(super) fn keep_pace(&mut self, step: u64, mode: &ParasiticMode<T>, turned: f64, moved: f64) {
        let size = |mode: &ParasiticMode<T>| if mode.is_significant { reported(mode.relative) } else { 0.0 };
        let relative = size(mode);
        let First { looks, relative: first, amplitude } = &mut self.first;
        if *looks < FIRST_LOOKS {
            *looks += 1;
            *first = first.max(relative);
            *amplitude = amplitude.max(reported(mode.amplitude));
        }
        let limit = self.limit.unwrap_or(PARASITIC_LIMIT).max(GROWTH * self.first.relative);
        let room = Scalar::ln((limit / relative).clamp(1.0, f64::MAX));
        let grown = self.last().map_or(0.0, |(_, last)| Scalar::ln((relative / size(&last)).max(1.0)));
        let since = self.last().map_or(1, |(last, _)| step - last) as f64;
        // (steps · angle)² ≤ (RADIANS room)², which is false of what is not a number.
        let fits = |steps: u64| {
            let (by_angle, steps_squared) = (RADIANS * room, (steps * steps) as f64);
            steps_squared * turned <= by_angle * by_angle * moved
                && (grown.is_infinite() || steps as f64 * grown <= room * since)
                && steps * 4 <= step.max(2 * KEPT as u64)
        };
        self.period = KEPT as u64;
        while self.period < BLOCK && fits(2 * self.period) {
            self.period *= 2;
        }
    }
}

lasting!([T: Real] First, T; count looks, bits relative, bits amplitude);
