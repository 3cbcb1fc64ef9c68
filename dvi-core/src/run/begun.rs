//! What a run carries when it begins.

use super::StepControl;
use super::clock::Time;
use crate::error::StartError;
use crate::memory::{Aside, Memory, lasting};
use crate::methods::{Carries, Kept, Method};
use crate::state::Statistics;
use crate::system::start::{consistent, flatten, named, validate, velocities};
use crate::{Lagrangian, Real, Vector};

/// What a run carries from a point with coordinates `Q` on: that of its method, and of its control.
pub(super) struct Begun<Q, K, L, T> {
    pub(super) q: Q,
    pub(super) memory: K,
    pub(super) kept: Option<Aside<Kept<Q, K>>>,
    pub(super) control_memory: L,
    pub(super) time: Time<T>,
    pub(super) statistics: Statistics,
}

lasting!([T: Real, Q, K: Memory<T>, L: Memory<T>] Begun<Q, K, L, T>, T;
    part memory, part control_memory, part time);

/// The same under a control.
pub(super) type BegunOf<S, K, C, T> = Begun<Vector<S, T>, K, <C as Carries<S, T>>::Memory, T>;

/// The coordinates and velocities of a state that a run can begin from.
pub(super) fn point<S: Lagrangian<T>, T: Real>(
    system: &S,
    t: T,
    start: &S::State<T>,
) -> Result<[Vector<S, T>; 2], StartError> {
    validate(system, t)?;
    let at = flatten(system, t, start)?;
    consistent(system, &at[0], t)?;
    Ok(at)
}

/// From a point with velocities, by what `control` and `method` begin with there, the latter with steps of a
/// length.
#[cfg_attr(not(feature = "alloc"), allow(clippy::useless_conversion))]
pub(super) fn carried<S: Lagrangian<T>, C: StepControl<S, T>, K, T: Real>(
    system: &S,
    [q, all]: &[Vector<S, T>; 2],
    t: T,
    control: impl FnOnce(&[T], &[T]) -> Result<(C::Memory, T), StartError>,
    method: impl Fn(&Vector<S, T>, &[T], T) -> Result<K, StartError>,
) -> Result<BegunOf<S, K, C, T>, StartError> {
    let reason = "the time of the system is transformed, which sets the lengths of its steps";
    StartError::unless_it(!S::TIME_TRANSFORMED || C::ONE_LENGTH, "a step control", reason)?;
    let v = &all[..velocities(system)];
    let begin = || {
        let (control_memory, h) = control(q, v)?;
        let memory = method(q, v, h)?;
        let kept = if S::TIME_TRANSFORMED || S::HAS_DOMAIN || C::REJECTS {
            Some(Kept { q: q.clone(), memory: method(q, v, h)? }.into())
        } else {
            None
        };
        let (time, statistics) = (Time::new(t, h, 0), Statistics::default());
        Ok(Begun { q: q.clone(), memory, kept, control_memory, time, statistics })
    };
    begin().map_err(|error| named(system, [q, all], t, error))
}

/// From a state.
pub(super) fn begun<S: Lagrangian<T>, M: Method<S, T>, C: StepControl<S, T>, T: Real>(
    system: &S,
    method: &M,
    control: &C,
    t: T,
    start: &S::State<T>,
) -> Result<BegunOf<S, M::Memory, C, T>, StartError> {
    let at = point(system, t, start)?;
    control.admit::<M>()?;
    let lengths = |q: &_, v: &_| control.begin(system, q, v, t);
    carried::<S, C, _, T>(system, &at, t, lengths, |q, v, h| method.begin(system, q, v, t, h))
}
