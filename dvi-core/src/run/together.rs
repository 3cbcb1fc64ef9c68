//! Runs taken together, in the lanes of packs.

use alloc::vec::Vec;

use super::{Integrator, Run, Stepper};
use crate::error::StepError;
use crate::methods::{Companion, InStep};
use crate::shown::shown;
#[cfg(doc)]
use crate::system::Packable;
use crate::{Held, Lagrangian, Space};

/// Where not all can go on together, each run takes this many steps alone.
const ALONE: u64 = 16;

/// Takes steps of several runs in lanes, `W` at a time.
///
/// Those of equal systems, with equal methods, the same step and at the same time go together, and so do
/// those of systems that differ in parameters of a generic type only ([`Packable`]). Each run ends, bit for
/// bit, where it would have ended alone, with the same [`Statistics`](crate::state::Statistics) and the same
/// error, also where others fail. Systems and methods are equal that `==` says are; it must not say so of
/// two that do different things, as of parameters 0.0 and −0.0 in `atan2`. Runs for which the method has no
/// lanes are taken one by one.
///
/// ```
/// use dvi_core::prelude::*;
/// use dvi_core::run::Together;
///
/// #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 + x.cos())]
/// #[derive(PartialEq)]
/// struct Pendulum;
///
/// let begin = |j: u32| {
///     let start = PendulumState { x: 0.1 * f64::from(j), dot_x: 0.0 };
///     Integrator::new(&Pendulum, Variational::trapezoid(), 0.05, start)
/// };
/// let mut runs = (0..8).map(begin).collect::<Result<Vec<_>, _>>()?;
/// let mut alone = begin(3)?;
///
/// let results = Together::<8, _, _>::new(&runs[0]).take_steps(&mut runs, 1000);
/// alone.take_steps(1000)?;
/// assert!(results.iter().all(Result::is_ok));
/// assert_eq!(runs[3].state().x, alone.state().x);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Together<const W: usize, S: Lagrangian, M: InStep<W, S>> {
    packs: M::Packs,
    /// The number of coordinates that there is room for.
    dimension: usize,
}

shown!([const W: usize, S: Lagrangian, M: InStep<W, S>] Together<W, S, M>, |_run| lanes: W);

impl<const W: usize, S: Lagrangian + PartialEq, M: InStep<W, S> + PartialEq> Together<W, S, M> {
    /// Room for runs on the system of `run`, and on others with as many coordinates.
    pub fn new(run: &Integrator<impl Held<System = S>, M>) -> Self {
        const { assert!(W > 0, "a pack has at least one lane") };
        Self { packs: run.method().packs(run.system()), dimension: run.system().space().dimension() }
    }

    /// Takes `count` steps of each run, as [`Run::take_steps`] does, and returns how each has ended.
    pub fn take_steps<'r, H: Held<System = S> + 'r>(
        &mut self,
        runs: impl IntoIterator<Item = &'r mut Integrator<H, M>>,
        count: u64,
    ) -> Vec<Result<(), StepError>>
    where
        S: 'r,
        M: 'r,
    {
        let mut runs: Vec<_> = runs.into_iter().collect();
        let mut results = alloc::vec![Ok(()); runs.len()];
        let mut left: Vec<usize> = (0..runs.len()).collect();
        while let Some(&first) = left.first() {
            let (mut group, others): (Vec<_>, Vec<_>) =
                left.into_iter().partition(|&other| other == first || go_together(runs[first], runs[other]));
            left = others;
            left.extend(group.split_off(group.len().min(W)));
            self.take(&mut runs, group, count, &mut results);
        }
        results
    }

    /// The same of the runs of one `group`.
    fn take<H: Held<System = S>>(
        &mut self,
        runs: &mut [&mut Integrator<H, M>],
        mut group: Vec<usize>,
        count: u64,
        results: &mut [Result<(), StepError>],
    ) {
        // Steps that are looked at where they end are taken one by one.
        let in_lanes = group.iter().all(|&run| {
            runs[run].stepper.kept.is_none() && runs[run].system().space().dimension() == self.dimension
        });
        let mut left = count;
        while left > 0 && !group.is_empty() {
            if in_lanes {
                left -= self.take_in_lanes(runs, &group, left);
            }
            let alone = if in_lanes { left.min(ALONE) } else { left };
            group.retain(|&run| {
                results[run] = runs[run].take_steps(alone);
                results[run].is_ok()
            });
            left -= alone;
        }
    }

    /// Takes up to `count` steps of all runs of the `group`, and returns how many.
    fn take_in_lanes<H: Held<System = S>>(
        &mut self,
        runs: &mut [&mut Integrator<H, M>],
        group: &[usize],
        count: u64,
    ) -> u64 {
        let mut of_all = None;
        let mut companions = Vec::with_capacity(group.len());
        let mut systems = Vec::with_capacity(group.len());
        for (_, run) in runs.iter_mut().enumerate().filter(|(index, _)| group.contains(index)) {
            let clock = run.stepper.clock();
            let Integrator { system, stepper: Stepper { method, memory, q, statistics, .. }, .. } =
                &mut **run;
            of_all = Some((&*method, clock));
            systems.push(system.held());
            companions.push(Companion { memory, q, statistics });
        }
        let Some((method, clock)) = of_all else { return 0 };
        method.steps_together(&systems, &mut self.packs, &mut companions, clock, count)
    }
}

/// Whether two runs may be in one pack.
fn go_together<const W: usize, S: Lagrangian + PartialEq, M: InStep<W, S> + PartialEq>(
    a: &Integrator<impl Held<System = S>, M>,
    b: &Integrator<impl Held<System = S>, M>,
) -> bool {
    let [of_a, of_b] = [a.system(), b.system()];
    let share_packs = core::ptr::eq(of_a, of_b) || M::fit(of_a, of_b).unwrap_or_else(|| of_a == of_b);
    share_packs && a.method() == b.method() && a.stepper.clock() == b.stepper.clock()
}
