//! What takes the place of a system with mistakes in it: it has every trait, so that the mistakes in its
//! attribute are the only ones that the compiler reports. None of the functions is ever called, as such a
//! program does not compile.

use super::{
    ConstrainedSystem, Degenerate, DegenerateLagrangian, Holonomic, HolonomicLagrangian, Lagrangian,
    Manifold, ManifoldLagrangian, ManifoldSystem, NondegenerateLagrangian, Nonholonomic,
    NonholonomicLagrangian, Packable, ProperlyDegenerate, Regular, RegularLagrangian, Same, Separable,
    System, Unilateral, UnilateralLagrangian, Weights,
};
use crate::{Scalar, Sink};

/// A system with mistakes in it.
pub trait StandIn: System {
    /// `M`, which steps systems of any kind.
    type Suited<M>: Same<M, As = M>;
}

#[diagnostic::do_not_recommend]
impl<S: StandIn, T: Scalar> Lagrangian<T> for S {
    fn lagrangian(&self, _: &[T], _: &[T], t: T) -> T {
        t
    }
    fn gradient(&self, _: &[T], _: &[T], _: T, _: &mut [T], _: &mut [T]) {}
    fn linearize<K: Sink<T>>(
        &self,
        _: &[T],
        _: &[T],
        _: T,
        _: Weights<T>,
        _: &mut [T],
        _: &mut [T],
        _: &mut K,
    ) {
    }
    fn energy(&self, _: &[T], _: &[T], t: T) -> T {
        t
    }
    fn momentum(&self, _: usize, _: &[T], _: &[T], t: T) -> T {
        t
    }
}

#[diagnostic::do_not_recommend]
impl<S: StandIn + System<Kind = Degenerate>, T: Scalar> DegenerateLagrangian<T> for S {
    type Suited<M> = S::Suited<M>;
    const AFFINE: bool = false;
    const MATCHING: bool = false;
    const CANONICAL: bool = false;
    fn hamiltonian(&self, _: &[T], t: T) -> T {
        t
    }
    fn hamiltonian_gradient(&self, _: &[T], _: T, _: &mut [T]) {}
    fn flow_source(&self, _: &[T], _: T, _: &mut [T]) {}
    fn one_form(&self, _: &[T], _: T, _: &mut [T]) {}
    fn one_form_jacobian<K: Sink<T>>(&self, _: &[T], _: T, _: T, _: T, _: &mut K) {}
    fn conjugate_entries(&self, _: &[T], _: T, _: T, _: T, _: &mut [T]) {}
    fn conjugates_end(&self, i: usize) -> usize {
        i + 1
    }
    fn conjugate(&self, i: usize) -> usize {
        i
    }
    fn momentum_gradient(&self, _: usize, _: &[T], _: T, _: &mut [T]) {}
}

#[diagnostic::do_not_recommend]
impl<S: StandIn + System<Kind = Degenerate>, T: Scalar> ProperlyDegenerate<T> for S {
    type Suited<M> = S::Suited<M>;
    fn place(&self, coordinate: usize) -> usize {
        coordinate
    }
}

#[diagnostic::do_not_recommend]
impl<S: StandIn, T: Scalar> NondegenerateLagrangian<T> for S {
    const CONSTANT_MASS: bool = false;
    const UNIFORM_MASS: bool = false;
    const SEPARABLE: bool = false;
    const DIAGONAL_MASS: bool = false;
    const QUADRATIC: bool = false;
    fn force(&self, _: &[T], _: &[T], _: T, _: &mut [T]) {}
    fn conjugate_momentum(&self, _: &[T], _: &[T], _: T, _: &mut [T]) {}
    fn momentum_rate(&self, _: &[T], _: &[T], _: T, _: &mut [T]) {}
}

#[diagnostic::do_not_recommend]
impl<S: StandIn + System<Kind = Regular>, T: Scalar> RegularLagrangian<T> for S {
    type Suited<M> = S::Suited<M>;
}
#[diagnostic::do_not_recommend]
impl<S: StandIn, T: Scalar> Separable<T> for S {
    type Suited<M> = S::Suited<M>;
}
#[diagnostic::do_not_recommend]
impl<S: StandIn + ConstrainedSystem + System<Kind = Nonholonomic>, T: Scalar> NonholonomicLagrangian<T>
    for S
{
    fn velocity_constraint(&self, _: &[T], _: &[T], _: T, _: &mut [T]) {}
    fn velocity_constraint_jacobian<K: Sink<T>>(
        &self,
        _: &[T],
        _: &[T],
        _: T,
        _: [T; 2],
        _: &mut [T],
        _: &mut K,
    ) {
    }
    fn velocity_constraint_rate(&self, _: &[T], _: &[T], _: T, _: &mut [T]) {}
}

#[diagnostic::do_not_recommend]
impl<S: StandIn + ConstrainedSystem + System<Kind = Holonomic>, T: Scalar> HolonomicLagrangian<T> for S {
    fn constraint(&self, _: &[T], _: T, _: &mut [T]) {}
    fn constraint_jacobian<K: Sink<T>>(&self, _: &[T], _: T, _: &mut [T], _: &mut K) {}
    fn constraint_rate(&self, _: &[T], _: &[T], _: T, _: &mut [T]) {}
    fn constraint_curvature(&self, _: &[T], _: &[T], _: T, _: &mut [T]) {}
}

#[diagnostic::do_not_recommend]
impl<S: StandIn + ConstrainedSystem + System<Kind = Unilateral>, T: Scalar> UnilateralLagrangian<T> for S {
    type Suited<M> = S::Suited<M>;
    fn gap(&self, _: &[T], _: T, _: &mut [T]) {}
    fn gap_jacobian<K: Sink<T>>(&self, _: &[T], _: T, _: &mut [T], _: &mut K) {}
    fn gap_rate(&self, _: &[T], _: &[T], _: T, _: &mut [T]) {}
}

#[diagnostic::do_not_recommend]
impl<S: StandIn + ManifoldSystem + System<Kind = Manifold>, T: Scalar> ManifoldLagrangian<T> for S {
    type Suited<M> = S::Suited<M>;
}

impl<const W: usize, S: StandIn> Packable<W> for S {
    type Packed = Self;
    fn packed<R>(systems: &[&Self; W], f: impl FnOnce(&Self) -> R) -> R {
        f(systems[0])
    }
}
