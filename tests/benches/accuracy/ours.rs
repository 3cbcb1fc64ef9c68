//! Methods of `dvi-core` on generated systems.

use dvi_core::Lagrangian;
use dvi_core::methods::{Method as Steps, VariableStep};
use dvi_core::prelude::*;

use crate::problem::{Method, Run as OneRun, Scale, Seen, Watch};

/// The first step that a step control tries is this part of the time.
const FIRST: f64 = 1e4;

/// A system with its start, the time at which runs end, and what errors are measured in.
pub(crate) struct Setting<S: Lagrangian> {
    pub(crate) begin: fn() -> (S, S::State<f64>),
    pub(crate) end: f64,
    pub(crate) scale: Scale,
}

impl<S: Lagrangian> Clone for Setting<S> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S: Lagrangian> Copy for Setting<S> {}

impl<S: Lagrangian + 'static> Setting<S> {
    /// A method with these numbers of steps.
    pub(crate) fn method<M>(self, name: &str, method: M, counts: Vec<u64>) -> Method
    where
        M: Steps<S, f64> + Clone + 'static,
    {
        let run = |steps: u64| {
            let [alone, watched] = [method.clone(), method.clone()];
            OneRun::new(
                move || self.alone(alone.clone(), steps).is_some(),
                move || self.watched(watched.clone(), steps),
            )
        };
        Method { name: name.to_owned(), runs: counts.into_iter().map(run).collect() }
    }

    /// A method with steps chosen by these tolerances.
    pub(crate) fn controlled<M>(self, name: &str, method: M, tolerances: &[f64]) -> Method
    where
        M: VariableStep<S, f64> + Copy + 'static,
    {
        let run = |&tolerance: &f64| {
            OneRun::new(
                move || self.alone_to(method, tolerance).is_some(),
                move || self.watched_to(method, tolerance),
            )
        };
        Method { name: name.to_owned(), runs: tolerances.iter().map(run).collect() }
    }

    fn alone_to<M: VariableStep<S, f64>>(self, method: M, tolerance: f64) -> Option<f64> {
        let (system, start) = (self.begin)();
        let control = ErrorControl::new(tolerance, self.end / FIRST);
        let mut run = Integrator::controlled(&system, method, control, start).ok()?;
        run.advance_to(self.end).ok()?;
        Some(std::hint::black_box(run.q()[0]))
    }

    fn watched_to<M: VariableStep<S, f64>>(self, method: M, tolerance: f64) -> Option<Seen> {
        let (system, start) = (self.begin)();
        let control = ErrorControl::new(tolerance, self.end / FIRST);
        let mut run = Integrator::controlled(&system, method, control, start).ok()?;
        let mut watch = Watch::new(run.energy(), self.scale);
        while run.time() < self.end {
            run.advance().ok()?;
            watch.note(run.energy());
        }
        let statistics = run.statistics();
        Some(watch.seen(statistics.gradients + statistics.linearizations))
    }

    fn alone<M: Steps<S, f64>>(self, method: M, steps: u64) -> Option<f64> {
        let (system, start) = (self.begin)();
        let mut run = Integrator::new(&system, method, self.end / steps as f64, start).ok()?;
        run.take_steps(steps).ok()?;
        Some(std::hint::black_box(run.q()[0]))
    }

    fn watched<M: Steps<S, f64>>(self, method: M, steps: u64) -> Option<Seen> {
        let (system, start) = (self.begin)();
        let mut run = Integrator::new(&system, method, self.end / steps as f64, start).ok()?;
        let mut watch = Watch::new(run.energy(), self.scale);
        for _ in 0..steps {
            run.advance().ok()?;
            watch.note(run.energy());
        }
        let statistics = run.statistics();
        Some(watch.seen(statistics.gradients + statistics.linearizations))
    }
}
