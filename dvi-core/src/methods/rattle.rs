//! RATTLE: the constrained step of the trapezoidal rule where L is separable.
//!
//! p½ = p0 + (h/2)F(q0) + G(q0)ᵀι0      q1 = q0 + h M⁻¹p½, with g(q1) = 0
//! p1 = p½ + (h/2)F(q1) + G(q1)ᵀι1, with G(q1) M⁻¹p1 + ∂g/∂t = 0
//!
//! ι0 is found by Newton's method, whose matrix is h G(q1) M⁻¹ G(q0)ᵀ, and ι1 from linear equations with G(q1) M⁻¹ G(q1)ᵀ.

use crate::error::{StartError, StepFailure};
use crate::mechanics::constraints::turning::is_along;
use crate::mechanics::constraints::{Multipliers, consistent};
use crate::mechanics::mass::Mass;
use crate::methods::constrained::Impulses;
use crate::methods::{Carries, Method, PreservedForm, Scheme, VariableStep};
use crate::scalar::norm;
use crate::solve::{Convergence, Stopping, iterate};
use crate::space::sink::Places;
use crate::space::{Sink, SquareMatrix};
use crate::state::Statistics;
use crate::state::memory::{Memory, lasting};
use crate::{ConstrainedSystem, HolonomicLagrangian, Real, Separable, Space, Vector};

/// RATTLE (Andersen 1983), for [`Separable`] systems with constraints: the step of [`Constrained`](crate::methods::Constrained) around
/// [`Variational::trapezoid`](crate::methods::Variational::trapezoid), without second derivatives of L.
///
/// A step evaluates the force once. Its linear equations have one unknown for each constraint and a full matrix, and the gradients of
/// all constraints are kept with an entry for each coordinate; along a chain of many links the banded equations of `Constrained` are
/// cheaper. With sizes that are fixed at compile time all of that is part of the run: with a hundred rods in the plane 0.7 MB, on the
/// stack of the thread that begins it. With sizes that are known at run time only it is on the heap. What is said there of structure and order is true of it. Positions are
/// those of SHAKE (Ryckaert, Ciccotti & Berendsen 1977) with a start on the constraints.
///
/// ```
/// use dvi_core::prelude::*;
///
/// /// Two masses on a rigid rod, in the plane.
/// #[lagrangian(
///     coordinates(x[2], y[2]),
///     lagrangian = sum(0..2, |i| (dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0),
///     constraint = (x[1] - x[0]).powi(2) + (y[1] - y[0]).powi(2) - 1.0,
/// )]
/// struct Dumbbell;
///
/// let start = DumbbellState { x: [0.0, 1.0], y: [0.0; 2], dot_x: [0.0; 2], dot_y: [0.0, 1.0] };
/// let mut run = Integrator::new(&Dumbbell, Rattle::default(), 0.01, start)?;
/// run.take_steps(1000)?;
/// // The centre of mass moves uniformly, and the ends around it.
/// assert!((run.state().y.iter().sum::<f64>() / 2.0 - 5.0).abs() < 1e-12);
/// let tension: Vec<f64> = run.memory().multipliers().collect();
/// assert!((tension[0] + 0.25).abs() < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rattle {
    /// The criterion by which a step counts as solved. Default: to rounding errors.
    pub stopping: Stopping,
}

/// Sums begin here: added to any number it leaves that number, so that the compiler may drop the first addition.
const NEUTRAL: f64 = -0.0;

/// A vector of coordinates for each constraint.
type Rows<S, T> = <<S as ConstrainedSystem>::Multipliers as Space>::Array<Vector<S, T>>;
/// A square matrix over the constraints.
type Gram<S, T> = <<S as ConstrainedSystem>::Multipliers as Space>::Square<T>;

/// Where a run of [`Rattle`] is, and work space.
#[derive(Debug)]
pub struct RattleMemory<S: ConstrainedSystem, T: Real> {
    here: Place<S, T>,
    last_step: T,
    impulses: Impulses<S, T>,
    mass: Mass<S, T>,
    work: Work<S, T>,
}

/// What is kept of a point of the run.
#[derive(Debug)]
struct Place<S: ConstrainedSystem, T: Real> {
    p: Vector<S, T>,
    /// F
    force: Vector<S, T>,
    /// The rows of G.
    rows: Rows<S, T>,
    /// M⁻¹ times each of them.
    solved: Rows<S, T>,
    /// The products of both, row by row: the diagonal of G M⁻¹ Gᵀ.
    squares: Multipliers<S, T>,
    /// Whether the determinant of that matrix is positive, as it is along a run if it is where that begins.
    is_positive: bool,
}

/// The end of a step as it is being found.
#[derive(Debug)]
struct Work<S: ConstrainedSystem, T: Real> {
    q: Vector<S, T>,
    place: Place<S, T>,
    impulses: Impulses<S, T>,
    increment: Vector<S, T>,
    /// A correction of the increment, or the velocity at the end.
    vector: Vector<S, T>,
    values: Multipliers<S, T>,
    gram: Gram<S, T>,
}

impl<S: ConstrainedSystem, T: Real> Memory<T> for Place<S, T> {
    lasting!(T; numbers p, numbers force, vectors rows, vectors solved, numbers squares, flag is_positive);
}

impl<S: ConstrainedSystem, T: Real> Memory<T> for RattleMemory<S, T> {
    lasting!(T; part here, number last_step, part impulses);
}

impl<S: ConstrainedSystem, T: Real> RattleMemory<S, T> {
    /// p = M v at the current point, one entry per coordinate.
    pub fn p(&self) -> &[T] {
        &self.here.p
    }

    /// The Lagrange multipliers λ of the last step: see [`ConstrainedMemory::multipliers`](crate::methods::ConstrainedMemory::multipliers).
    pub fn multipliers(&self) -> impl Iterator<Item = T> + '_ {
        self.impulses.over(self.last_step)
    }

    /// The impulses of the last step: see [`ConstrainedMemory::impulses`](crate::methods::ConstrainedMemory::impulses).
    pub fn impulses(&self) -> [&[T]; 2] {
        [&self.impulses.first, &self.impulses.last]
    }
}

impl<S: ConstrainedSystem, T: Real> Place<S, T> {
    #[inline(always)]
    fn new(system: &S) -> Self {
        let vector = || system.space().vector();
        let rows = || system.multipliers().array(vector);
        let squares = system.multipliers().vector();
        Self { p: vector(), force: vector(), rows: rows(), solved: rows(), squares, is_positive: true }
    }
}

impl<S: ConstrainedSystem, T: Real> Work<S, T> {
    #[inline(always)]
    fn new(system: &S) -> Self {
        let vector = || system.space().vector();
        let m = system.multipliers().dimension();
        let all = |visit: &mut dyn FnMut(usize, usize)| {
            (0..m).for_each(|k| (0..m).for_each(|l| visit(k, l)));
        };
        Self {
            q: vector(),
            place: Place::new(system),
            impulses: Impulses::new(system),
            increment: vector(),
            vector: vector(),
            values: system.multipliers().vector(),
            gram: system.multipliers().square(all),
        }
    }
}

/// Adds Σ `factors`ₖ `rows`ₖ to `sum`.
#[inline(always)]
fn combine<T: Real, V: core::ops::Deref<Target = [T]>>(rows: &[V], factors: &[T], sum: &mut [T]) {
    for (row, &factor) in rows.iter().zip(factors) {
        for (sum, &entry) in sum.iter_mut().zip(row.iter()) {
            *sum += factor * entry;
        }
    }
}

#[inline(always)]
fn dot<T: Real>(a: &[T], b: &[T]) -> T {
    a.iter().zip(b).fold(T::lift(NEUTRAL), |sum, (&a, &b)| sum + a * b)
}

/// Sets a matrix to `factor` A Bᵀ, where A and B have these rows.
#[inline(always)]
fn fill<T: Real, V: core::ops::Deref<Target = [T]>, Q: SquareMatrix<T>>(
    gram: &mut Q,
    [a, b]: [&[V]; 2],
    factor: T,
) {
    let entries = gram.cleared();
    for (k, a) in a.iter().enumerate() {
        for (l, b) in b.iter().enumerate() {
            entries.add(k, l, factor * dot(a, b));
        }
    }
}

/// Overwrites `x` with the solution of (`factor` A Bᵀ) y = x, where A and B have these rows.
///
/// # Errors
/// [`StepFailure::RedundantConstraint`].
#[inline(always)]
fn solve<T: Real, V: core::ops::Deref<Target = [T]>, Q: SquareMatrix<T>>(
    gram: &mut Q,
    rows: [&[V]; 2],
    factor: T,
    x: &mut [T],
) -> Result<(), StepFailure> {
    fill(gram, rows, factor);
    gram.eliminate(x).map_err(named)
}

/// The failure of a matrix over the constraints, with the name of one.
#[cold]
fn named(failure: StepFailure) -> StepFailure {
    match failure {
        StepFailure::Singular { column, pivot } => {
            StepFailure::RedundantConstraint { constraint: column, pivot }
        }
        other => other,
    }
}

/// Whether the solution of a step, with G(q1) = `rows`, lies on the branch of the motion: where no gradient has turned by a right
/// angle in the metric of M, the displacement makes no larger angle than 45° with the constraints, and the determinant of G(q1) M⁻¹ G(q0)ᵀ has the sign of that of G(q0) M⁻¹ G(q0)ᵀ.
///
/// # Errors
/// [`StepFailure::Turned`] and [`StepFailure::Branch`].
#[inline(always)]
fn is_on_branch<S: ConstrainedSystem, T: Real>(
    gram: &mut Gram<S, T>,
    rows: &Rows<S, T>,
    here: &Place<S, T>,
    (increment, norms): (&[T], [T; 2]),
) -> Result<(), StepFailure> {
    for (constraint, (row, solved)) in rows.iter().zip(here.solved.iter()).enumerate() {
        let square = here.squares[constraint];
        // What is no number is no turn by less than a right angle either.
        let is_small = dot(row, solved) * square > T::lift(0.0);
        let is_here =
            is_small && (!S::AUTONOMOUS || is_along(dot(&here.rows[constraint], increment), square, norms));
        if !is_here {
            return Err(StepFailure::Turned { constraint });
        }
    }
    // Of one constraint that is the determinant.
    if rows.len() > 1 {
        fill(gram, [rows, &here.solved], T::lift(1.0));
        gram.factor().map_err(named)?;
        if gram.is_positive() != here.is_positive {
            return Err(StepFailure::Branch);
        }
    }
    Ok(())
}

/// One step: where it begins, and how long it is.
struct Step<'a, S: ConstrainedSystem, T: Real> {
    system: &'a S,
    mass: &'a Mass<S, T>,
    q: &'a [T],
    here: &'a Place<S, T>,
    t: T,
    h: T,
    stopping: Stopping,
}

impl<S: HolonomicLagrangian<T> + Separable<T>, T: Real> Work<S, T> {
    /// Sets ι0, Δ and q1, with q1 on the constraints, from a guess of ι0: `ratio` times `last`.
    #[inline(always)]
    fn shake(
        &mut self,
        step: &Step<'_, S, T>,
        (ratio, last): (T, &[T]),
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let Step { system, mass, q, here, t, h, stopping } = *step;
        let Self { q: q1, place, impulses, increment, vector, values, gram } = self;
        let half = T::lift(0.5) * h;
        for ((p, &p0), &f) in place.p.iter_mut().zip(here.p.iter()).zip(here.force.iter()) {
            *p = p0 + half * f;
        }
        mass.solve(&place.p, increment);
        for ((impulse, value), &last) in impulses.first.iter_mut().zip(values.iter_mut()).zip(last) {
            *impulse = ratio * last;
            *value = *impulse;
        }
        combine(&here.solved, values, increment);
        increment.iter_mut().for_each(|delta| *delta *= h);
        let scale = norm::largest(q) + norm::largest(increment);
        let convergence = Convergence::new(stopping, scale, q, stopping.max_iterations);
        iterate(convergence, statistics, |_| {
            add(q, increment, q1);
            constrain(system, q1, t + h, values, &mut place.rows);
            solve(gram, [&place.rows, &here.solved], h, values)?;
            for (impulse, value) in impulses.first.iter_mut().zip(values.iter_mut()) {
                *impulse -= *value;
                *value *= h;
            }
            vector.fill(T::lift(NEUTRAL));
            combine(&here.solved, values, vector);
            for (delta, &change) in increment.iter_mut().zip(vector.iter()) {
                *delta -= change;
            }
            Ok(norm::largest(vector))
        })?;
        add(q, increment, q1);
        constrain(system, q1, t + h, values, &mut place.rows);
        let norms = [&*increment, q].map(|x| {
            vector.fill(T::lift(NEUTRAL));
            mass.multiply_add(T::lift(1.0), x, vector);
            dot(vector, x)
        });
        let is_here = is_on_branch(gram, &place.rows, here, (increment, norms));
        is_here.map_err(|failure| norm::finite(q1).err().unwrap_or(failure))
    }

    /// Sets p1, with its velocity along the constraints, and ι1.
    #[inline(always)]
    fn rattle(&mut self, step: &Step<'_, S, T>) -> Result<(), StepFailure> {
        let Step { system, mass, here, t, h, .. } = *step;
        let Self { q, place, impulses, .. } = self;
        let (t1, half) = (t + h, T::lift(0.5) * h);
        combine(&here.rows, &impulses.first, &mut place.p);
        place.is_positive = here.is_positive;
        system.force(q, &[], t1, &mut place.force);
        for (p, &f) in place.p.iter_mut().zip(place.force.iter()) {
            *p += half * f;
        }
        self.align(system, mass, t1)
    }

    /// Makes the velocity of p at q one along the constraints, of which the gradients are here.
    #[inline(always)]
    fn align(&mut self, system: &S, mass: &Mass<S, T>, t: T) -> Result<(), StepFailure> {
        let Self {
            q, place: Place { p, rows, solved, squares, .. }, impulses, vector: v, values, gram, ..
        } = self;
        for (row, solved) in rows.iter().zip(solved.iter_mut()) {
            mass.solve(row, solved);
        }
        for (square, (row, solved)) in squares.iter_mut().zip(rows.iter().zip(solved.iter())) {
            *square = dot(row, solved);
        }
        mass.solve(p, v);
        if S::AUTONOMOUS {
            for (value, row) in values.iter_mut().zip(rows.iter()) {
                *value = dot(row, v);
            }
        } else {
            system.constraint_rate(q, v, t, values);
        }
        solve(gram, [rows, solved], T::lift(1.0), values)?;
        for (impulse, value) in impulses.last.iter_mut().zip(values.iter_mut()) {
            *value = -*value;
            *impulse = *value;
        }
        combine(rows, values, p);
        norm::finite(p)
    }
}

/// With so many entries of G a step has its work space on the stack, where it can stay in registers.
const SHORT: usize = 64;

/// Whether the work space of a step is on the stack, with `entries` in G: a question that is answered when compiled.
#[inline(always)]
fn is_short<S: ConstrainedSystem>(entries: usize) -> bool {
    <S::Space as Space>::ON_STACK && <S::Multipliers as Space>::ON_STACK && entries <= SHORT
}

/// Sets `g` and the rows of G at (`q`, `t`).
#[inline(always)]
fn constrain<S: HolonomicLagrangian<T>, T: Real>(
    system: &S,
    q: &[T],
    t: T,
    g: &mut [T],
    rows: &mut [Vector<S, T>],
) {
    rows.iter_mut().for_each(|row| row.fill(T::lift(NEUTRAL)));
    system.constraint_jacobian(q, t, g, &mut Places(|k: usize, j: usize, entry| rows[k][j] += entry));
}

/// Sets `sum` to q + Δ.
#[inline(always)]
fn add<T: Real>(q: &[T], increment: &[T], sum: &mut [T]) {
    for ((sum, &q), &delta) in sum.iter_mut().zip(q).zip(increment) {
        *sum = q + delta;
    }
}

impl Scheme for Rattle {
    fn order(&self) -> usize {
        2
    }
    fn is_symmetric(&self) -> bool {
        true
    }
    fn preserved_form(&self) -> PreservedForm {
        PreservedForm::Canonical
    }
}

impl<S: ConstrainedSystem, T: Real> Carries<S, T> for Rattle {
    type Memory = RattleMemory<S, T>;
}

impl<S: HolonomicLagrangian<T> + Separable<T>, T: Real> Method<S, T> for Rattle {
    fn begin(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, h: T) -> Result<Self::Memory, StartError> {
        self.stopping.validate()?;
        consistent::check(system, [q, v], t, h)?;
        let mass = Mass::new(system, q, t).map_err(StartError::Starter)?;
        let mut work = Work::new(system);
        let Work { q: at, place, values, .. } = &mut work;
        at.copy_from_slice(q);
        constrain(system, q, t, values, &mut place.rows);
        system.force(q, &[], t, &mut place.force);
        mass.multiply_add(T::lift(1.0), v, &mut place.p);
        work.align(system, &mass, t).map_err(StartError::Starter)?;
        let Work { place, gram, .. } = &mut work;
        fill(gram, [&place.rows, &place.solved], T::lift(1.0));
        gram.factor().map_err(named).map_err(StartError::Starter)?;
        place.is_positive = gram.is_positive();
        let mut here = Place::new(system);
        here.restore(&work.place);
        let (last_step, impulses) = (T::lift(0.0), Impulses::new(system));
        Ok(RattleMemory { here, last_step, impulses, mass, work })
    }

    #[inline]
    fn step(
        &self,
        system: &S,
        memory: &mut Self::Memory,
        q: &mut Vector<S, T>,
        t: T,
        h: T,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let RattleMemory { here, last_step, impulses, mass, work } = memory;
        let mut on_stack;
        let work: &mut Work<S, T> = if is_short::<S>(q.len() * system.multipliers().dimension()) {
            on_stack = Work::new(system);
            &mut on_stack
        } else {
            work
        };
        let step = Step { system, mass, q, here, t, h, stopping: self.stopping };
        let zero = T::lift(0.0);
        let mut ratio = if *last_step == zero { zero } else { h / *last_step };
        // Newton's method finds the nearest of several solutions: from the last impulse, and else from none.
        while let Err(failure) = work.shake(&step, (ratio, &impulses.first), statistics) {
            if ratio == zero {
                return Err(failure);
            }
            ratio = zero;
        }
        work.rattle(&step)?;
        statistics.gradients += 1;
        q.copy_from_slice(&work.q);
        here.restore(&work.place);
        impulses.restore(&work.impulses);
        *last_step = h;
        Ok(())
    }

    fn velocity(
        &self,
        _system: &S,
        memory: &Self::Memory,
        _q: &Vector<S, T>,
        _t: T,
        v: &mut Vector<S, T>,
    ) -> Result<(), StepFailure> {
        memory.mass.solve(&memory.here.p, v);
        Ok(())
    }
}

impl<S: HolonomicLagrangian<T> + Separable<T>, T: Real> VariableStep<S, T> for Rattle {}
