//! A run that ends when its energy has gone astray: |E(q, v, t) − E at the start| ≤ limit after every step.
//!
//! What this is for: a method that steps over a singularity finds finite numbers on the other side.
//! Störmer–Verlet on a head-on Kepler orbit goes from energy −1 to 285 within two steps, and nothing but the
//! energy says so.

use crate::discrete::Span;
use crate::error::{StartError, StepFailure};
use crate::memory::{Memory, lasting};
use crate::methods::{
    Carries, DiscreteEnergy, Here, Kept, Method, Scheme, Step, Tolerance, VariableStep, scheme,
};
use crate::scalar::norm::reported;
use crate::state::Statistics;
use crate::system::start::extended;
use crate::system::{Same, TimeTransform};
use crate::{Lagrangian, Real, Scalar, Space, System, Vector};

/// A method whose steps fail where the energy has changed by more than a limit since the start of the run.
///
/// The step that goes beyond the limit fails with [`StepFailure::Energy`], and the run stays at the state
/// before it. Meant for systems whose Lagrangian and constraints do not depend on time; of others it limits
/// by how much the energy may change. Each step costs a copy of what the method carries and one evaluation
/// of the energy, of a regular system one of the velocity too; on a Lagrangian that is not
/// ½ v·M v − V(q, t), of a size known at run time only, that allocates.
///
/// ```
#[doc = include_str!("../../docs/hidden/kepler.txt")]
/// // Störmer–Verlet steps over the sun, and goes on with a wrong energy.
/// let fall = KeplerState { dot_y: 0.0, ..start };
/// let method = EnergyLimit { method: Variational::trapezoid(), limit: 0.1 };
/// let mut run = Integrator::new(&Kepler, method, 0.01, fall)?;
/// assert!(run.take_steps(1000).is_err());
/// assert!((run.energy() + 1.0).abs() < 0.1); // the last good state
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EnergyLimit<M> {
    /// The method.
    pub method: M,
    /// The largest |E − E(start)|, in the units of the energy; E is H − `energy` if the time of the system
    /// is transformed.
    pub limit: f64,
}

/// What a run with a limited energy carries: the memory of its method, where a step began, and the energy at
/// the start.
#[derive(Debug)]
pub struct EnergyLimitMemory<I, V, T> {
    inner: I,
    before: Kept<V, I>,
    v: V,
    start: T,
}

lasting!([I: Memory<T>, V, T: Real] EnergyLimitMemory<I, V, T>, T; part inner, number start);

/// The energy; of a system whose time is transformed H − `energy`, as ρ (H − `energy`) says little where ρ
/// is small.
fn watched<S: Lagrangian<T>, T: Real>(system: &S, q: &[T], v: &[T], t: T) -> T {
    match system.time_transform(q) {
        Some(TimeTransform { hamiltonian, .. }) => hamiltonian - q[extended(system)[1]],
        None => system.energy(q, v, t),
    }
}

scheme! { [M: Scheme] EnergyLimit<M>, as method }

impl<S: System, T: Real, M: Carries<S, T>> Carries<S, T> for EnergyLimit<M> {
    type Memory = EnergyLimitMemory<M::Memory, Vector<S, T>, T>;
}

/// `M`, under a name that is in no field: in `EnergyLimit { method, limit }` rustc would look for the method
/// that does not suit a system, and report it there once more.
type Itself<M> = <M as Same<M>>::As;

impl<M> EnergyLimit<M> {
    /// The memory around that of the method, of a run from (`q`, `v`, `t`).
    fn around<S: Lagrangian<T>, T: Real, I>(
        &self,
        system: &S,
        (q, v, t): (&Vector<S, T>, &[T], T),
        begin: impl Fn() -> Result<I, StartError>,
    ) -> Result<EnergyLimitMemory<I, Vector<S, T>, T>, StartError> {
        StartError::unless(self.limit > 0.0, "limit", self.limit, "positive")?;
        let (start, before) = (watched(system, q, v, t), Kept { q: q.clone(), memory: begin()? });
        Ok(EnergyLimitMemory { inner: begin()?, before, v: system.space().vector(), start })
    }

    /// The discrete energy of the method, not a number if it is not known.
    fn energy_of<S: Lagrangian<T>, T: Real>(&self, span: Span<'_, S, T>, node: &mut [Vector<S, T>; 2]) -> T
    where
        Itself<M>: Method<S, T>,
    {
        let energy = <Itself<M> as Method<S, T>>::DISCRETE_ENERGY;
        energy.map_or(T::lift(f64::NAN), |energy| energy(&self.method, span, node))
    }
}

impl<S: Lagrangian<T>, T: Real, M> Method<S, T> for EnergyLimit<M>
where
    Itself<M>: Method<S, T>,
{
    type Suited<X> = <M as Method<S, T>>::Suited<X>;

    fn begin(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, h: T) -> Result<Self::Memory, StartError> {
        self.around(system, (q, v, t), || self.method.begin(system, q, v, t, h))
    }

    fn begin_again(
        &self,
        system: &S,
        q: &Vector<S, T>,
        v: &[T],
        t: T,
        h: T,
    ) -> Result<Self::Memory, StartError> {
        self.around(system, (q, v, t), || self.method.begin_again(system, q, v, t, h))
    }

    fn begun_anew(&self, before: &Self::Memory, begun: Self::Memory) -> Self::Memory {
        EnergyLimitMemory { inner: self.method.begun_anew(&before.inner, begun.inner), ..begun }
    }

    fn step(&self, step: Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        let Step { system, q, t, h, statistics } = step;
        let EnergyLimitMemory { inner, before, v, start } = memory;
        before.take(q, inner);
        self.method.step(Step { system, q, t, h, statistics }, inner)?;
        let end = t + h;
        let verdict = self.method.velocity(Here { system, q, t: end }, inner, v).and_then(|()| {
            let now = watched(system, q, if S::REGULAR { v } else { &[] }, end);
            // An energy that is not a number is within no limit.
            let within = Scalar::abs(now - *start) <= T::lift(self.limit);
            let [start, now] = [*start, now].map(reported);
            if within { Ok(()) } else { Err(StepFailure::Energy { start, now, limit: self.limit }) }
        });
        if verdict.is_err() {
            before.go_back(q, inner);
        }
        verdict
    }

    fn part_of_step(
        &self,
        part: Step<'_, S, T>,
        whole: T,
        memory: &mut Self::Memory,
        taken: &Self::Memory,
    ) -> Result<(), StepFailure> {
        self.method.part_of_step(part, whole, &mut memory.inner, &taken.inner)
    }

    const HAS_JUMPS: bool = <Itself<M> as Method<S, T>>::HAS_JUMPS;

    fn place(
        &self,
        memory: &mut Self::Memory,
        index: usize,
        q: &mut Vector<S, T>,
        v: [&mut Vector<S, T>; 2],
    ) -> Option<T> {
        self.method.place(&mut memory.inner, index, q, v)
    }

    fn velocity(&self, here: Here<'_, S, T>, memory: &Self::Memory, v: &mut [T]) -> Result<(), StepFailure> {
        self.method.velocity(here, &memory.inner, v)
    }

    const DISCRETE_ENERGY: Option<DiscreteEnergy<Self, S, T>> =
        if <Itself<M> as Method<S, T>>::DISCRETE_ENERGY.is_some() { Some(Self::energy_of) } else { None };

    const ESTIMATES_LOCAL_ERROR: bool = <Itself<M> as Method<S, T>>::ESTIMATES_LOCAL_ERROR;

    fn local_error(
        &self,
        system: &S,
        memory: &mut Self::Memory,
        t: T,
        lengths: [T; 2],
        tolerance: Tolerance,
        statistics: &mut Statistics,
    ) -> Result<T, StepFailure> {
        self.method.local_error(system, &mut memory.inner, t, lengths, tolerance, statistics)
    }
}

impl<S: Lagrangian<T>, T: Real, M> VariableStep<S, T> for EnergyLimit<M>
where
    Itself<M>: VariableStep<S, T>,
{
    type SuitedToAnyStep<X> = <M as VariableStep<S, T>>::SuitedToAnyStep<X>;
}
