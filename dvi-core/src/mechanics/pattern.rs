//! Matrices and solvers with room for the second derivatives of a system.

use crate::space::Storing;
use crate::{Coupled, Lagrangian, Linear, Real, Space, Square, Vector, Weights};

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
    points: [&[T]; 2],
    t: T,
    visit: &mut dyn FnMut(usize, usize),
) {
    let one = T::lift(1.0);
    let weights = Weights { qq: one, qv: one, vq: one, vv: one };
    visit_entries(system, points, t, weights, |_| true, visit);
}

/// A matrix with room for those second derivatives at (q, v, t) that count.
pub(crate) fn of_entries<S: Lagrangian<T>, T: Real>(
    system: &S,
    [q, v]: [&[T]; 2],
    t: T,
    weights: Weights<T>,
    counts: impl Fn(T) -> bool,
) -> Square<S, T> {
    system.space().square(|visit| visit_entries(system, [q, v], t, weights, counts, visit))
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

fn visit_entries<S: Lagrangian<T>, T: Real>(
    system: &S,
    [q, v]: [&[T]; 2],
    t: T,
    weights: Weights<T>,
    counts: impl Fn(T) -> bool,
    visit: &mut dyn FnMut(usize, usize),
) {
    let space = system.space();
    let [mut l_q, mut l_v]: [Vector<S, T>; 2] = [space.vector(), space.vector()];
    let mut places = |row: usize, column: usize, entry: T| {
        if counts(entry) {
            visit(row, column);
        }
    };
    system.linearize(q, v, t, weights, &mut l_q, &mut l_v, &mut places);
}
