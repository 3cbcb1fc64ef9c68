//! Matrices and solvers with room for the second derivatives of a system.

use crate::space::Storing;
use crate::{Coupled, Lagrangian, Linear, Real, Space, Vector, Weights};

/// A solver for Newton's method, with room for all second derivatives of L. Where they stand does not depend
/// on the point, but the formulas are evaluated, and are defined at (q, v, t).
pub(crate) fn of_second_derivatives<S: Lagrangian<T>, T: Real>(
    system: &S,
    q: &[T],
    v: &[T],
    t: T,
    storing: Storing,
) -> Linear<S, T> {
    system.space().linear(storing, |visit| visit_second_derivatives(system, [q, v], t, visit))
}

/// Visits the places of all second derivatives of L.
pub(crate) fn visit_second_derivatives<S: Lagrangian<T>, T: Real>(
    system: &S,
    [q, v]: [&[T]; 2],
    t: T,
    visit: &mut dyn FnMut(usize, usize),
) {
    let (one, [mut l_q, mut l_v]): (T, [Vector<S, T>; 2]) = (T::lift(1.0), system.space().vectors());
    let weights = Weights { qq: one, qv: one, vq: one, vv: one };
    let mut places: &mut dyn FnMut(usize, usize, T) = &mut |row, column, _| visit(row, column);
    system.linearize(q, v, t, weights, &mut l_q, &mut l_v, &mut places);
}

/// Hands over the entries of the mass matrix at (q, v, t). What is weighted by zero has no place in it.
pub(crate) fn mass_entries<S: Lagrangian<T>, T: Real>(
    system: &S,
    [q, v]: [&[T]; 2],
    t: T,
    mut add: impl FnMut(usize, usize, T),
) {
    let [mut l_q, mut l_v]: [Vector<S, T>; 2] = system.space().vectors();
    let mut sink: &mut dyn FnMut(usize, usize, T) = &mut |row, column, entry| {
        if entry != T::lift(0.0) {
            add(row, column, entry);
        }
    };
    system.linearize(q, v, t, Weights::mass(), &mut l_q, &mut l_v, &mut sink);
}

/// The same for the last `unknown` of several vectors at once.
pub(crate) fn coupled_by_second_derivatives<const NODES: usize, S: Lagrangian<T>, T: Real>(
    system: &S,
    points: [&[T]; 2],
    t: T,
    unknown: usize,
    storing: Storing,
) -> Coupled<NODES, S, T> {
    system.space().coupled(unknown, storing, |visit| visit_second_derivatives(system, points, t, visit))
}
