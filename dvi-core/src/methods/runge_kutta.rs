//! Explicit Runge–Kutta methods on q' = X(q, t): the baselines.
//!
//! kᵢ = X(q + h Σⱼ aᵢⱼ kⱼ, t + cᵢh),   q⁺ = q + h Σᵢ bᵢ kᵢ

use crate::error::{StartError, StepFailure};
use crate::mechanics::VectorField;
use crate::mechanics::orientation::FormOrientation;
use crate::methods::{Carries, Method, PreservedForm, Scheme, VariableStep};
use crate::scalar::norm;
use crate::state::Statistics;
use crate::state::memory::{Memory, lasting};
use crate::{DegenerateLagrangian, Real, Space, System, Vector};

const STAGES: usize = 4;

/// The coefficients of an explicit method, in rows of up to four stages.
#[derive(Debug, PartialEq)]
struct Tableau {
    name: &'static str,
    order: usize,
    stages: usize,
    a: [[f64; STAGES]; STAGES],
    b: [f64; STAGES],
    c: [f64; STAGES],
}

const THIRD: f64 = 1.0 / 3.0;
const SIXTH: f64 = 1.0 / 6.0;

#[rustfmt::skip]
static MIDPOINT: Tableau = Tableau {
    name: "midpoint", order: 2, stages: 2,
    a: [[0.0, 0.0, 0.0, 0.0],
        [0.5, 0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, 0.0]],
    b:  [0.0, 1.0, 0.0, 0.0],
    c:  [0.0, 0.5, 0.0, 0.0],
};

#[rustfmt::skip]
static HEUN: Tableau = Tableau {
    name: "Heun", order: 2, stages: 2,
    a: [[0.0, 0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, 0.0]],
    b:  [0.5, 0.5, 0.0, 0.0],
    c:  [0.0, 1.0, 0.0, 0.0],
};

#[rustfmt::skip]
static CLASSICAL: Tableau = Tableau {
    name: "classical", order: 4, stages: 4,
    a: [[0.0, 0.0, 0.0, 0.0],
        [0.5, 0.0, 0.0, 0.0],
        [0.0, 0.5, 0.0, 0.0],
        [0.0, 0.0, 1.0, 0.0]],
    b:  [SIXTH, THIRD, THIRD, SIXTH],
    c:  [0.0, 0.5, 0.5, 1.0],
};

/// An explicit Runge–Kutta method on q' = X(q): kᵢ = X(q + h Σⱼ aᵢⱼ kⱼ), q⁺ = q + h Σᵢ bᵢ kᵢ.
///
/// Neither symmetric nor symplectic: energy and, on nonlinear systems, all momenta but the linear ones
/// drift.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RungeKutta {
    tableau: &'static Tableau,
}

impl RungeKutta {
    /// Order 2: q⁺ = q + h X(q + ½h X(q)) (Runge 1895).
    pub fn midpoint() -> Self {
        Self { tableau: &MIDPOINT }
    }

    /// Order 2: q⁺ = q + ½h (k₁ + X(q + h k₁)) (Heun 1900).
    pub fn heun() -> Self {
        Self { tableau: &HEUN }
    }

    /// Order 4: "the" Runge–Kutta method (Kutta 1901).
    pub fn classical() -> Self {
        Self { tableau: &CLASSICAL }
    }

    /// The name of the tableau.
    pub fn name(&self) -> &'static str {
        self.tableau.name
    }
}

/// The stages of a Runge–Kutta step.
#[derive(Debug)]
pub struct RungeKuttaMemory<S: System, T: Real> {
    field: VectorField<S, T>,
    slopes: [Vector<S, T>; STAGES],
    point: Vector<S, T>,
    orientation: FormOrientation<S, T>,
}

impl<S: System, T: Real> Memory<T> for RungeKuttaMemory<S, T> {
    lasting!(T; part orientation);
}

impl Scheme for RungeKutta {
    fn order(&self) -> usize {
        self.tableau.order
    }
    fn is_symmetric(&self) -> bool {
        false
    }
    fn preserved_form(&self) -> PreservedForm {
        PreservedForm::Nothing
    }
}

impl<S: System, T: Real> Carries<S, T> for RungeKutta {
    type Memory = RungeKuttaMemory<S, T>;
}

impl<S: DegenerateLagrangian<T>, T: Real> Method<S, T> for RungeKutta {
    fn begin(&self, system: &S, q: &Vector<S, T>, _v: &[T], t: T, _h: T) -> Result<Self::Memory, StartError> {
        Ok(RungeKuttaMemory {
            field: VectorField::new(system, q, t).map_err(StartError::Starter)?,
            slopes: core::array::from_fn(|_| system.space().vector()),
            point: system.space().vector(),
            orientation: FormOrientation::new(system, q, t),
        })
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
        let Tableau { stages, a, b, c, .. } = self.tableau;
        let RungeKuttaMemory { field, slopes, point, orientation } = memory;
        for i in 0..(*stages).min(STAGES) {
            combine(q, h, &a[i], &slopes[..i], point);
            if i > 0 {
                orientation.compare(system, point, t + T::lift(c[i]) * h)?;
            }
            field.evaluate(system, point, t + T::lift(c[i]) * h, &mut slopes[i], statistics)?;
        }
        combine(q, h, b, &slopes[..*stages], point);
        norm::finite(point)?;
        orientation.check(system, point, t + h)?;
        q.copy_from_slice(point);
        Ok(())
    }
}

impl<S: DegenerateLagrangian<T>, T: Real> VariableStep<S, T> for RungeKutta {}

/// Sets `out` to q + h Σ wⱼ kⱼ.
#[inline(always)]
fn combine<T: Real, V: core::ops::Deref<Target = [T]> + core::ops::DerefMut>(
    q: &V,
    h: T,
    weights: &[f64; STAGES],
    slopes: &[V],
    out: &mut V,
) {
    out.copy_from_slice(q);
    for (&weight, slope) in weights.iter().zip(slopes) {
        if weight != 0.0 {
            let factor = h * T::lift(weight);
            for (out, &k) in out.iter_mut().zip(slope.iter()) {
                *out += factor * k;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{CLASSICAL, HEUN, MIDPOINT, STAGES, Tableau};

    /// The eight trees up to order four: order, elementary weight, density (Butcher 1963).
    fn conditions(table: &Tableau) -> [(usize, f64, f64); 8] {
        let Tableau { a, b, c, .. } = table;
        let dot = |x: &[f64; STAGES], y: &[f64; STAGES]| x.iter().zip(y).map(|(x, y)| x * y).sum::<f64>();
        let times = |x: &[f64; STAGES], y: &[f64; STAGES]| core::array::from_fn(|i| x[i] * y[i]);
        let apply = |x: &[f64; STAGES]| -> [f64; STAGES] { core::array::from_fn(|i| dot(&a[i], x)) };
        let (cc, ac) = (times(c, c), apply(c));
        [
            (1, b.iter().sum(), 1.0),
            (2, dot(b, c), 2.0),
            (3, dot(b, &cc), 3.0),
            (3, dot(b, &ac), 6.0),
            (4, dot(b, &times(&cc, c)), 4.0),
            (4, dot(b, &times(c, &ac)), 8.0),
            (4, dot(b, &apply(&cc)), 12.0),
            (4, dot(b, &apply(&ac)), 24.0),
        ]
    }

    #[test]
    fn tableaus_meet_the_conditions_of_their_order_and_not_of_the_next() {
        for table in [&MIDPOINT, &HEUN, &CLASSICAL] {
            let met = |(_, weight, density): &(usize, f64, f64)| (weight * density - 1.0).abs() < 1e-15;
            let (upto, beyond): (alloc::vec::Vec<_>, alloc::vec::Vec<_>) =
                conditions(table).into_iter().partition(|condition| condition.0 <= table.order);
            assert!(upto.iter().all(met), "{}: {upto:?}", table.name);
            assert!(beyond.is_empty() || !beyond.iter().all(met), "{}", table.name);
        }
    }

    #[test]
    fn tableaus_are_consistent_explicit_and_use_their_stages_only() {
        for table in [&MIDPOINT, &HEUN, &CLASSICAL] {
            for i in 0..STAGES {
                assert_eq!(table.a[i].iter().sum::<f64>(), table.c[i], "{} row {i}", table.name);
                assert!(table.a[i][i..].iter().all(|&a| a == 0.0), "{} row {i}", table.name);
            }
            assert!(table.b[table.stages..].iter().all(|&b| b == 0.0), "{}", table.name);
        }
    }
}
