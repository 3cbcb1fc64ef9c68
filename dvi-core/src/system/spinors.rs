//! Unit vectors of degenerate systems: a run carries a spinor z ∈ ℂ² of each, of which s = z†σz.
//!
//! With z = (a + ib, c + id) these are the Hopf map and the pull-back of the one-form of area (McLachlan,
//! Modin & Verdier 2014, *Collective symplectic integrators*),
//!
//! s = (2(ac + bd), 2(ad − bc), a² + b² − c² − d²),     A = 2 (a db − b da + c dd − d dc),     dA = area.
//!
//! |s| = |z|², which is quadratic: methods that preserve such invariants stay on the sphere. Neither the
//! length of z nor its phase is the user's, so that there are no poles. The four coordinates of arrays lie
//! one array after the other, as components of vectors do.

use super::blocks::{Block, blocks};
use super::{Name, System};
use crate::error::StartError;
use crate::name::Factor;
use crate::scalar::spinor::{COORDINATES, lift, lower};
use crate::scalar::{Comparison, Scalar};
use crate::system::report::{CoordinateBlock, Report};
use crate::{Real, Space, Vector};

/// Whether a block is a coordinate of spinors.
pub(crate) const fn is_spinor(block: &CoordinateBlock, is_regular: bool) -> bool {
    !is_regular && matches!(block.factor, Factor::Sphere)
}

const fn has_spinors(report: &Report, is_regular: bool) -> bool {
    let mut block = 0;
    while block < report.coordinates.len() {
        if is_spinor(&report.coordinates[block], is_regular) {
            return true;
        }
        block += 1;
    }
    false
}

/// Whether unit vectors are among the coordinates of a degenerate system.
pub(crate) const fn has<S: System>() -> bool {
    const { has_spinors(&S::REPORT, S::REGULAR) }
}

/// All spinors of a system.
fn spinors<S: System>(system: &S) -> impl Iterator<Item = Block> {
    blocks(system).filter(|block| !S::REGULAR && block.factor == Factor::Sphere)
}

fn of<T: Scalar>(spinor: Block, q: &[T]) -> [T; COORDINATES] {
    core::array::from_fn(|number| q[spinor.place(number)])
}

fn set<T: Scalar>(spinor: Block, q: &mut [T], z: [T; COORDINATES]) {
    spinor.places().zip(z).for_each(|(place, z)| q[place] = z);
}

/// The unit vector that a place in the flat state belongs to.
pub(crate) fn at_place<S: System>(system: &S, place: usize) -> Option<Name> {
    let Block { name, index, factor, .. } =
        spinors(system).find(|spinor| spinor.places().any(|other| other == place))?;
    Some(Name { block: name, is_velocity: false, row: None, index, axis: None, factor })
}

/// Puts the components of vectors in the first three places of their spinors.
pub(crate) fn lower_all<S: System, T: Scalar>(system: &S, q: &mut [T]) {
    if !has::<S>() {
        return;
    }
    for spinor in spinors(system) {
        let z = of(spinor, q);
        let s = lower(z);
        // What no spinor is of is there as it is.
        let is_number = |k: usize| T::choose(z[3], Comparison::Less, T::lift(f64::INFINITY), s[k], z[k]);
        set(spinor, q, [is_number(0), is_number(1), is_number(2), z[3]]);
    }
}

/// The same of a copy, if there are some.
pub(crate) fn lowered<S: System, T: Scalar>(system: &S, q: &[T]) -> Option<Vector<S, T>> {
    has::<S>().then(|| {
        let mut lowered: Vector<S, T> = system.space().vector();
        lowered.copy_from_slice(q);
        lower_all(system, &mut lowered);
        lowered
    })
}

/// The reverse of [`lower_all`].
pub(crate) fn lift_all<S: System, T: Scalar>(system: &S, q: &mut [T]) {
    if has::<S>() {
        spinors(system).for_each(|spinor| {
            let [x, y, z, _] = of(spinor, q);
            set(spinor, q, lift([x, y, z]));
        });
    }
}

/// Makes rates of spinors at `q` such that vectors are read from them as if they were states: those of the
/// vectors, ṡ = 2 Re z†σż, as half of the difference of z†σz where z is moved by ż and by −ż.
pub(crate) fn lift_rates<S: System, T: Scalar>(system: &S, q: &[T], rates: &mut [T]) {
    if !has::<S>() {
        return;
    }
    for spinor in spinors(system) {
        let (z, rate) = (of(spinor, q), of(spinor, rates));
        let forth = lower(core::array::from_fn(|k| z[k] + rate[k]));
        let back = lower(core::array::from_fn(|k| z[k] - rate[k]));
        set(spinor, rates, lift(core::array::from_fn(|k| T::lift(0.5) * (forth[k] - back[k]))));
    }
}

/// Whether the vectors of a state that is given have length 1.
///
/// # Errors
/// [`StartError::OffManifold`] with the first that has not.
pub(crate) fn check<S: System, T: Real>(system: &S, q: &[T]) -> Result<(), StartError> {
    if !has::<S>() {
        return Ok(());
    }
    spinors(system).try_for_each(|spinor| {
        let length = of(spinor, q).into_iter().fold(T::lift(0.0), |sum, z| sum + z * z);
        spinor.check(Scalar::abs(length * length - T::lift(1.0)))
    })
}

/// Refuses what would not keep |z|, or is not said in terms of vectors.
///
/// # Errors
/// [`StartError::Unsupported`] if there are unit vectors.
pub(crate) fn refuse<S: System>(option: &'static str) -> Result<(), StartError> {
    let reason = "it would not keep the lengths of unit vectors; `Gauss`, and with affine α `Sigma::midpoint()` from \
                  `Start::Consistent`, keep them";
    StartError::unless_it(!has::<S>(), option, reason)
}
