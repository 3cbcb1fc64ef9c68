//! A scheme on a system, without their types: what laws are functions of, so that each scheme is
//! compiled once for all of them.

use core::fmt::Debug;
use std::rc::Rc;

use dvi_core::methods::{Carries, Here, Method, PreservedForm, Step};
use dvi_core::prelude::*;
use dvi_core::run::Checkpoint;
use dvi_core::state::{Memory, Statistics};
use dvi_core::{Lagrangian, Real, Space, Vector};
use num_dual::Dual64;

use super::equations::Equations;
use super::subject::Subject;
use dvi_tests::{Outcome, bits, state};

/// How steps of a scheme are solved and added up, as far as it has a choice.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Options {
    /// Of those that have one.
    pub solver: Solver,
    /// Of those that can.
    pub summation: Summation,
}

/// A run, whatever its system and scheme are.
pub trait Steps<T = f64> {
    /// One step.
    ///
    /// # Errors
    /// That of the step.
    fn advance(&mut self) -> Result<(), StepFailure>;
    /// Coordinates, and velocities if there are any.
    fn values(&self) -> Vec<T>;
    /// The time.
    fn time(&self) -> T;
}

/// A run that can be written down.
pub trait Written: Steps {
    /// Many steps at once.
    ///
    /// # Errors
    /// That of the step that failed.
    fn take_steps(&mut self, count: u64) -> Result<(), StepFailure>;
    /// What the next steps follow from.
    fn checkpoint(&self) -> Checkpoint;
    /// What else can be asked.
    fn asked(&self) -> (u64, u64, Statistics);
    /// The momenta that the system declares.
    fn momenta(&self) -> Vec<f64>;
    /// Coordinates and velocities at given times.
    ///
    /// # Errors
    /// Those of the states.
    fn values_at(&mut self, times: &[f64]) -> Outcome<Vec<Vec<f64>>>;
}

impl<S: Lagrangian<T>, M: Method<S, T>, T: Real> Steps<T> for Integrator<&'static S, M, T> {
    fn advance(&mut self) -> Result<(), StepFailure> {
        Run::advance(self).map_err(|error| error.failure)
    }
    fn values(&self) -> Vec<T> {
        self.system().values(&self.state()).map_or_else(|_| Vec::new(), Iterator::collect)
    }
    fn time(&self) -> T {
        Run::time(self)
    }
}

impl<S: Lagrangian, M: Method<S, f64>> Written for Integrator<&'static S, M> {
    fn take_steps(&mut self, count: u64) -> Result<(), StepFailure> {
        Run::take_steps(self, count).map_err(|error| error.failure)
    }
    fn checkpoint(&self) -> Checkpoint {
        Run::checkpoint(self)
    }
    fn asked(&self) -> (u64, u64, Statistics) {
        (self.energy().to_bits(), Run::steps(self), self.statistics())
    }
    fn momenta(&self) -> Vec<f64> {
        Run::momenta(self).map(|(_, value)| value).collect()
    }
    fn values_at(&mut self, times: &[f64]) -> Outcome<Vec<Vec<f64>>> {
        let states = self.states_at(times.iter().copied())?.collect::<Result<Vec<_>, _>>()?;
        states.iter().map(|(_, state)| Ok(self.system().values(state)?.collect())).collect()
    }
}

/// Steps of the method itself, between which nothing is kept but what it keeps.
struct Bare<S: Lagrangian + 'static, M: Method<S, f64>> {
    system: &'static S,
    method: M,
    memory: <M as Carries<S, f64>>::Memory,
    q: Vector<S, f64>,
    start: f64,
    h: f64,
    taken: u32,
}

impl<S: Lagrangian + 'static, M: Method<S, f64>> Steps for Bare<S, M> {
    fn advance(&mut self) -> Result<(), StepFailure> {
        let (t, mut statistics) = (self.time(), Statistics::default());
        let step = Step { system: self.system, q: &mut self.q, t, h: self.h, statistics: &mut statistics };
        self.method.step(step, &mut self.memory)?;
        self.taken += 1;
        Ok(())
    }
    fn values(&self) -> Vec<f64> {
        let mut v = self.system.space().vector();
        let here = Here { system: self.system, q: &self.q, t: self.time() };
        if self.method.velocity(here, &self.memory, &mut v).is_err() {
            v.fill(f64::NAN);
        }
        [&self.q[..], &v].concat()
    }
    fn time(&self) -> f64 {
        self.start + f64::from(self.taken) * self.h
    }
}

type Begun<R> = Result<Box<R>, StartError>;
/// Of a time and a step, and coordinates and velocities.
type Begin<T, R> = dyn Fn([f64; 2], &[T]) -> Begun<R>;
type Resume = dyn Fn(&Checkpoint) -> Begun<dyn Written>;

/// A scheme on a system.
pub struct Case {
    /// The method with its options, and the system.
    pub name: String,
    /// What it integrates.
    pub subject: Rc<Subject>,
    /// What is changed of its options.
    pub options: Options,
    /// The order that it says it has on any system of the kind, or that the table says it has on this
    /// one.
    pub order: usize,
    /// Whether a step of −h undoes one of h.
    pub symmetric: bool,
    /// What it says it preserves.
    pub form: PreservedForm,
    /// Its equations.
    pub equations: Equations,
    begin: Box<Begin<f64, dyn Written>>,
    resume: Box<Resume>,
    vary: Box<Begin<Dual64, dyn Steps<Dual64>>>,
    copy: Box<dyn Fn([u32; 2]) -> Outcome>,
}

impl Debug for Case {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(&self.name)
    }
}

impl Case {
    /// A method, in double precision and in dual numbers, on a system that it fits.
    pub fn new<S, M, D>(
        system: &'static S,
        subject: &Rc<Subject>,
        options: Options,
        (method, varied): (M, D),
        (equations, order): (Equations, Option<usize>),
    ) -> Self
    where
        S: Lagrangian + Lagrangian<Dual64> + 'static,
        M: Method<S, f64> + Clone + Debug + 'static,
        D: Method<S, Dual64> + Clone + 'static,
    {
        let (n, [t, h]) = (subject.dimension(), [subject.t, subject.h]);
        let name = format!("{method:?} on {}", subject.name);
        let (order, symmetric) = (order.unwrap_or_else(|| method.order()), method.is_symmetric());
        let form = method.preserved_form();
        let (begun, resumed, copied) = (method.clone(), method.clone(), method);
        let start = subject.start.clone();
        Self {
            name,
            subject: Rc::clone(subject),
            options,
            order,
            symmetric,
            form,
            equations,
            begin: Box::new(move |[t, h], values| {
                let (q, v) = values.split_at(n);
                Ok(Box::new(Integrator::new_at(system, begun.clone(), t, h, state(system, q, v))?))
            }),
            resume: Box::new(move |checkpoint| {
                Ok(Box::new(Integrator::resume(system, resumed.clone(), checkpoint)?))
            }),
            vary: Box::new(move |[t, h], values| {
                let (q, v) = values.split_at(n);
                let [t, h] = [t, h].map(Dual64::from);
                Ok(Box::new(Integrator::new_at(system, varied.clone(), t, h, state(system, q, v))?))
            }),
            copy: Box::new(move |steps| copied_runs_go_on(system, &copied, &start, [t, h], steps)),
        }
    }

    /// Whether it is solved and added up by the options of the first way of its row.
    pub fn is_plain(&self) -> bool {
        self.options == Options::default()
    }

    /// Whether coordinates and velocities are not all that the next step follows from, because momenta
    /// beside the one-form do.
    pub fn has_hidden_state(&self) -> bool {
        self.form == PreservedForm::Discrete
            && !(self.symmetric && self.subject.is_affine() && !self.subject.form_is_driven())
    }

    /// A run from `values`, at a time with a step.
    ///
    /// # Errors
    /// That of the start.
    pub fn begin(&self, at: [f64; 2], values: &[f64]) -> Begun<dyn Written> {
        (self.begin)(at, values)
    }

    /// A run from the start of the subject.
    ///
    /// # Errors
    /// That of the start.
    pub fn run(&self) -> Begun<dyn Written> {
        self.begin([self.subject.t, self.subject.h], &self.subject.start.concat())
    }

    /// The run of a checkpoint.
    ///
    /// # Errors
    /// That of the start.
    pub fn resume(&self, checkpoint: &Checkpoint) -> Begun<dyn Written> {
        (self.resume)(checkpoint)
    }

    /// A run on dual numbers.
    ///
    /// # Errors
    /// That of the start.
    pub fn vary(&self, at: [f64; 2], values: &[Dual64]) -> Begun<dyn Steps<Dual64>> {
        (self.vary)(at, values)
    }

    /// Whether a run on a memory of so many steps that is restored from another, `before` steps from its
    /// start, goes on as that for as many.
    ///
    /// # Errors
    /// What is not the same, and failures.
    pub fn goes_on_from_a_copy(&self, before: u32, steps: u32) -> Outcome {
        (self.copy)([before, steps])
    }
}

/// Restores the memory of a run of so many steps from one that has taken `before` steps, and goes on with
/// both.
fn copied_runs_go_on<S: Lagrangian + 'static, M: Method<S, f64> + Clone>(
    system: &'static S,
    method: &M,
    [q, v]: &[Vec<f64>; 2],
    at: [f64; 2],
    [before, steps]: [u32; 2],
) -> Outcome {
    let [mut kept, mut other] = [bare(system, method, [q, v], at)?, bare(system, method, [q, v], at)?];
    (0..steps).try_for_each(|_| other.advance())?;
    (0..before).try_for_each(|_| kept.advance())?;
    other.memory.restore(&kept.memory);
    other.q.copy_from_slice(&kept.q);
    other.taken = kept.taken;
    for step in 0..steps {
        kept.advance()?;
        other.advance()?;
        if bits(&kept.values()) != bits(&other.values()) {
            return Err(format!("a copy after {before} steps is another run in step {step}").into());
        }
    }
    Ok(())
}

fn bare<S: Lagrangian + 'static, M: Method<S, f64> + Clone>(
    system: &'static S,
    method: &M,
    [q0, v0]: [&[f64]; 2],
    [t, h]: [f64; 2],
) -> Result<Bare<S, M>, StartError> {
    let mut q = system.space().vector();
    q.copy_from_slice(q0);
    let memory = method.begin(system, &q, v0, t, h)?;
    Ok(Bare { system, method: method.clone(), memory, q, start: t, h, taken: 0 })
}

/// A scheme on a system with a [fuse](super::fuse).
pub struct Fused {
    /// The method and the system.
    pub name: String,
    bare: Box<dyn Fn() -> Begun<dyn Steps>>,
    begin: Box<dyn Fn() -> Begun<dyn Written>>,
    resume: Box<Resume>,
}

impl Fused {
    /// A method on such a system, from coordinates and velocities at a time with a step.
    pub fn new<S, M>(system: &'static S, [q, v]: [&[f64]; 2], [t, h]: [f64; 2], method: M) -> Self
    where
        S: Lagrangian + 'static,
        M: Method<S, f64> + Clone + Debug + 'static,
    {
        let (start, name) = ([q.to_vec(), v.to_vec()], format!("{method:?} on {}", S::REPORT.system));
        let (begun, resumed, same) = (method.clone(), method.clone(), start.clone());
        Self {
            name,
            bare: Box::new(move || Ok(Box::new(bare(system, &method, [&start[0], &start[1]], [t, h])?))),
            begin: Box::new(move || {
                let state = state(system, &same[0], &same[1]);
                Ok(Box::new(Integrator::new_at(system, begun.clone(), t, h, state)?))
            }),
            resume: Box::new(move |checkpoint| {
                Ok(Box::new(Integrator::resume(system, resumed.clone(), checkpoint)?))
            }),
        }
    }

    /// A run of bare steps.
    ///
    /// # Errors
    /// That of the start.
    pub fn bare(&self) -> Begun<dyn Steps> {
        (self.bare)()
    }

    /// A run.
    ///
    /// # Errors
    /// That of the start.
    pub fn run(&self) -> Begun<dyn Written> {
        (self.begin)()
    }

    /// The run of a checkpoint.
    ///
    /// # Errors
    /// That of the start.
    pub fn resume(&self, checkpoint: &Checkpoint) -> Begun<dyn Written> {
        (self.resume)(checkpoint)
    }
}

impl Debug for Fused {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(&self.name)
    }
}
