//! Ω q' = ∇H + ∂α/∂t, on Q.

use super::{FirstOrder, Motion, Point, Rates};
use crate::error::{StartError, StepFailure};
use crate::mechanics::VectorField;
use crate::mechanics::orientation::FormOrientation;
use crate::scalar::norm;
use crate::state::Statistics;
use crate::state::memory::{Memory, lasting};
use crate::system::Degenerate;
use crate::{DegenerateLagrangian, Real, Space, System, Vector};

/// The equations of motion of a degenerate system, on Q.
#[derive(Debug)]
pub struct FlowOnQ<S: System, T: Real> {
    field: VectorField<S, T>,
    orientation: FormOrientation<S, T>,
}

impl<S: System, T: Real> Memory<T> for FlowOnQ<S, T> {
    lasting!(T; part orientation);
}

impl<S: System, T: Real> Motion<S, T> for Degenerate {
    type Point = Point<Vector<S, T>, 1>;
    type Equations = FlowOnQ<S, T>;

    fn point(system: &S) -> Self::Point {
        Point([system.space().vector()])
    }
}

impl<S: DegenerateLagrangian<T>, T: Real> FirstOrder<S, T> for Degenerate {
    fn begin(system: &S, q: &Vector<S, T>, _v: &[T], t: T) -> Result<FlowOnQ<S, T>, StartError> {
        Ok(FlowOnQ {
            field: VectorField::new(system, q, t).map_err(StartError::Starter)?,
            orientation: FormOrientation::new(system, q, t),
        })
    }
    #[inline(always)]
    fn gather(_equations: &mut FlowOnQ<S, T>, q: &Vector<S, T>, y: &mut Self::Point) {
        y.0[0].copy_from_slice(q);
    }
    #[inline(always)]
    fn evaluate(
        equations: &mut FlowOnQ<S, T>,
        system: &S,
        y: &Self::Point,
        t: T,
        slope: &mut Self::Point,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        equations.field.evaluate(system, &y.0[0], t, &mut slope.0[0], statistics)
    }
    #[inline(always)]
    fn evaluate_part(
        equations: &mut FlowOnQ<S, T>,
        system: &S,
        _part: usize,
        y: &Self::Point,
        t: T,
        _slope: &Self::Point,
        out: &mut Vector<S, T>,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        equations.field.evaluate(system, &y.0[0], t, out, statistics)
    }
    #[inline(always)]
    fn cancelling(
        _equations: &mut FlowOnQ<S, T>,
        _system: &S,
        _y: &Self::Point,
        _t: T,
    ) -> Result<T, StepFailure> {
        Ok(T::lift(0.0))
    }
    #[inline(always)]
    fn compare(equations: &mut FlowOnQ<S, T>, system: &S, y: &Self::Point, t: T) -> Result<(), StepFailure> {
        equations.orientation.compare(system, &y.0[0], t).map(drop)
    }
    #[inline(always)]
    fn arrive(
        equations: &mut FlowOnQ<S, T>,
        system: &S,
        y: &Self::Point,
        q: &mut Vector<S, T>,
        t: T,
    ) -> Result<(), StepFailure> {
        let [arrival] = &y.0;
        norm::finite(arrival)?;
        equations.orientation.check(system, arrival, t)?;
        q.copy_from_slice(arrival);
        Ok(())
    }
    fn velocity(
        _equations: &FlowOnQ<S, T>,
        _system: &S,
        _q: &Vector<S, T>,
        _t: T,
        _v: &mut Vector<S, T>,
    ) -> Result<(), StepFailure> {
        Ok(())
    }
}

impl<S: DegenerateLagrangian<T>, T: Real> Rates<S, T> for Degenerate {
    fn rates(system: &S, q: &Vector<S, T>, _v: &[T], t: T) -> Result<[Vector<S, T>; 2], StepFailure> {
        let [mut velocity, none] = [0, 1].map(|_| system.space().vector());
        let mut field = VectorField::new(system, q, t)?;
        field.evaluate(system, q, t, &mut velocity, &mut Statistics::default())?;
        Ok([velocity, none])
    }
}
