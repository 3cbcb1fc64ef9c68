//! Ω q' = ∇H + ∂α/∂t, on Q.

use super::{
    AtStages, FirstOrder, FirstOrderAtStages, InLanes, Point, Rates, StageEquations, StageWork, points,
};
use crate::error::{StartError, StepFailure};
use crate::mechanics::VectorField;
use crate::mechanics::orientation::FormOrientation;
use crate::memory::lasting;
use crate::scalar::{Lanes, norm};
use crate::state::Statistics;
use crate::system::Degenerate;
use crate::{DegenerateLagrangian, Real, Scalar, Sink, Space, System, Vector, Weights};

/// The equations of motion of a degenerate system, on Q.
#[derive(Debug)]
pub struct FlowOnQ<S: System, T: Real> {
    field: VectorField<S, T>,
    orientation: FormOrientation<S, T>,
}

lasting!([S: System, T: Real] FlowOnQ<S, T>, T; part orientation);

impl<S: DegenerateLagrangian<T>, T: Real> FirstOrder<S, T> for Degenerate {
    type Suited<M> = M;
    type Point<P: Scalar> = Point<Vector<S, P>, 1>;
    type Equations = FlowOnQ<S, T>;

    fn points<P: Scalar, const COUNT: usize>(system: &S) -> [Self::Point<P>; COUNT] {
        points(system.space())
    }
    fn begin(system: &S, q: &Vector<S, T>, _v: &[T], t: T) -> Result<FlowOnQ<S, T>, StartError> {
        Ok(FlowOnQ {
            field: VectorField::new(system, q, t).map_err(StartError::Starter)?,
            orientation: FormOrientation::new(system, q, t),
        })
    }
    fn gather(_equations: &mut FlowOnQ<S, T>, q: &Vector<S, T>, y: &mut Self::Point<T>) {
        y.0[0].copy_from_slice(q);
    }
    #[inline]
    fn evaluate_part(
        equations: &mut FlowOnQ<S, T>,
        system: &S,
        _part: usize,
        y: &Self::Point<T>,
        t: T,
        slope: &mut Self::Point<T>,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        equations.field.evaluate(system, &y.0[0], t, &mut slope.0[0], statistics)
    }
    fn compare(flow: &mut FlowOnQ<S, T>, system: &S, y: &Self::Point<T>, t: T) -> Result<(), StepFailure> {
        flow.orientation.compare(system, &y.0[0], t)
    }
    fn arrive(
        equations: &mut FlowOnQ<S, T>,
        system: &S,
        y: &Self::Point<T>,
        q: &mut Vector<S, T>,
        t: T,
    ) -> Result<(), StepFailure> {
        let [arrival] = &y.0;
        norm::finite(arrival)?;
        equations.orientation.pass(system, &[], (arrival, t))?;
        q.copy_from_slice(arrival);
        Ok(())
    }
}

impl<S: DegenerateLagrangian<T>, T: Real> StageEquations<S, T> for Degenerate {
    fn residual(system: &S, [q, v]: [&[T]; 2], t: T, force: &mut [T], residual: &mut [T]) {
        let one = T::lift(1.0);
        system.flow_source(q, t, force);
        for (residual, &source) in residual.iter_mut().zip(force.iter()) {
            *residual = -source;
        }
        let mut product = |i: usize, j: usize, entry: T| residual[i] += entry * v[j];
        system.one_form_jacobian(q, t, -one, one, &mut product);
    }
    fn newton_weights([of_row, of_column]: [bool; 2], [_, after]: [T; 2], [_, per_h]: [T; 2]) -> Weights<T> {
        let zero = T::lift(0.0);
        let omega = if of_column { per_h } else { zero };
        if of_row { Weights { qq: after, qv: omega, vq: -omega, vv: -after } } else { Weights::none() }
    }
    /// The rate of Dα is a third derivative of L, and a difference here, to half of the digits: Newton's
    /// method gains as many in each iteration.
    fn newton_matrix<K: Sink<T>>(
        system: &S,
        [q, v]: [&[T]; 2],
        [t, h]: [T; 2],
        [later, _]: [&mut [T]; 2],
        sink: &mut K,
    ) {
        if S::AFFINE {
            return;
        }
        let (zero, difference) = (T::lift(0.0), Scalar::sqrt(T::default_epsilon()) * h);
        let per_time = T::lift(1.0) / difference;
        for ((later, &q), &v) in later.iter_mut().zip(q).zip(v) {
            *later = q + difference * v;
        }
        system.one_form_jacobian(q, t, -per_time, zero, sink);
        system.one_form_jacobian(later, t + difference, per_time, zero, sink);
    }
}

#[diagnostic::do_not_recommend]
impl<const W: usize, S, T: Real> FirstOrderAtStages<InLanes, W, S, T> for Degenerate
where
    S: DegenerateLagrangian<T> + DegenerateLagrangian<Lanes<W, T>>,
{
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn evaluate_at_stages(
        equations: &mut FlowOnQ<S, T>,
        at: &AtStages<'_, W, S, T>,
        work: &mut StageWork<W, S, T>,
        out: &mut Vector<S, Lanes<W, T>>,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        let StageWork { point, gradient, entries, .. } = work;
        let work = ([&mut gradient[..], &mut entries[..]], &mut point[0][..]);
        equations.field.evaluate_in_lanes(at.system, &at.y.0[0], at.t, work, out, statistics)
    }
}

impl<S: DegenerateLagrangian<T>, T: Real> Rates<S, T> for Degenerate {
    fn rates(system: &S, q: &Vector<S, T>, _v: &[T], t: T) -> Result<Vector<S, T>, StepFailure> {
        let mut velocity = system.space().vector();
        let mut field = VectorField::new(system, q, t)?;
        field.evaluate(system, q, t, &mut velocity, &mut Statistics::default())?;
        Ok(velocity)
    }
}
