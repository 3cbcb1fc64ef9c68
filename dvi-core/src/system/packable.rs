//! Systems whose runs share packs.

use crate::scalar::Lanes;
use crate::{System, Varied};

/// A system whose runs can be taken together, with parameters of their own in each of `W` lanes.
///
/// The attributes implement it for every system. A struct that is generic over the type of its parameters,
/// `struct Kepler<P = f64>`, is packed where that type is `f64`: what is of the generic type, a number or an
/// array or vector of numbers, may differ from lane to lane, and all other fields must be equal. There must
/// be no other generic type, no lifetime and no `where`. Systems of all other structs share a pack if they
/// are equal.
#[diagnostic::on_unimplemented(
    message = "`{Self}` does not say how its parameters stand in the lanes of a pack",
    label = "its runs cannot be taken together",
    note = "the attributes implement `Packable`, of a struct with parameters of a generic type where that \
        is `f64`"
)]
pub trait Packable<const W: usize>: System {
    /// A system in packs.
    type Packed: System<Space = Self::Space>;

    /// Whether it differs from `other` in nothing but what may differ from lane to lane; `None` if only
    /// equal systems share a pack.
    fn fits(&self, _other: &Self) -> Option<bool> {
        None
    }

    /// Calls `f` with the pack of `systems`, of which there is at least one, each of which
    /// [`fits`](Self::fits) the first, or is equal to it; lanes without a system have the first.
    fn packed<R>(systems: &[&Self; W], f: impl FnOnce(&Self::Packed) -> R) -> R;
}

/// A field with a parameter, or parameters, that go into the lanes of a pack.
pub trait Packing<const W: usize> {
    /// The field of a system in packs.
    type Packed;
    /// Whether there are as many parameters as in `other`.
    fn fits(&self, other: &Self) -> bool;
    /// The pack of fields of which each fits the first.
    fn pack(fields: [&Self; W]) -> Self::Packed;
}

impl<const W: usize> Packing<W> for f64 {
    type Packed = Varied<Lanes<W>>;
    fn fits(&self, _other: &Self) -> bool {
        true
    }
    fn pack(fields: [&Self; W]) -> Self::Packed {
        Varied(Lanes(fields.map(|&field| field)))
    }
}

impl<const W: usize, const N: usize, F: Packing<W>> Packing<W> for [F; N] {
    type Packed = [F::Packed; N];
    fn fits(&self, other: &Self) -> bool {
        self.iter().zip(other).all(|(field, other)| field.fits(other))
    }
    fn pack(fields: [&Self; W]) -> Self::Packed {
        core::array::from_fn(|i| F::pack(fields.map(|field| &field[i])))
    }
}

#[cfg(feature = "alloc")]
impl<const W: usize, F: Packing<W>> Packing<W> for alloc::vec::Vec<F> {
    type Packed = alloc::vec::Vec<F::Packed>;
    fn fits(&self, other: &Self) -> bool {
        self.len() == other.len() && self.iter().zip(other).all(|(field, other)| field.fits(other))
    }
    fn pack(fields: [&Self; W]) -> Self::Packed {
        (0..fields[0].len()).map(|i| F::pack(fields.map(|field| &field[i]))).collect()
    }
}

/// A field that all systems of a pack have alike. A bound on what it has itself would be one without `W`,
/// which has to hold.
pub trait Shared<const W: usize> {
    /// Whether it is that of `other`.
    fn same(&self, other: &Self) -> bool;
    /// The field of a system in packs.
    fn copy(&self) -> Self;
}

impl<const W: usize, F: Clone + PartialEq> Shared<W> for F {
    fn same(&self, other: &Self) -> bool {
        self == other
    }
    fn copy(&self) -> Self {
        self.clone()
    }
}
