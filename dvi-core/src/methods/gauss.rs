//! Gauss collocation on q' = X(q, t).
//!
//! Kᵢ = X(q + h Σⱼ aᵢⱼ Kⱼ, t + cᵢh),   q⁺ = q + h Σᵢ bᵢ Kᵢ,   c the zeros of the shifted Legendre polynomial
//! (Butcher 1964; Hairer, Lubich & Wanner 2006, section II.1.3). The stages are iterated as a fixed point
//! down to rounding errors, from the collocation polynomial of the last step, continued.

use crate::error::{StartError, StepFailure};
use crate::mechanics::VectorField;
use crate::mechanics::orientation::FormOrientation;
use crate::methods::{Carries, Method, PreservedForm, Scheme, VariableStep};
use crate::scalar::norm;
use crate::solve::{Convergence, Stopping, iterate};
use crate::state::Statistics;
use crate::state::memory::{Memory, lasting};
use crate::{DegenerateLagrangian, Real, Scalar, Space, System, Vector};

/// Gauss collocation with `S` stages, 1 ≤ `S` ≤ 3, of order 2`S`; `S` = 1 is the implicit midpoint rule.
///
/// Symmetric; preserves Ω if α is affine, and then all quadratic momenta. The fixed point contracts for
/// h small against the fastest time scale only: [`StepFailure::NotConverged`] where it does not.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gauss<const S: usize> {
    /// When the stages count as converged. Default: to rounding errors.
    pub stopping: Stopping,
}

impl<const S: usize> Gauss<S> {
    /// With default options. A number of stages other than 1, 2 or 3 does not compile.
    pub fn new() -> Self {
        const { assert!(S >= 1 && S <= 3, "Gauss collocation is available with 1, 2 or 3 stages") };
        Self::default()
    }
}

/// Nodes, weights and matrix of a collocation method.
#[derive(Clone, Copy, Debug)]
struct Tableau<const S: usize> {
    a: [[f64; S]; S],
    b: [f64; S],
    c: [f64; S],
}

const ROOT_3: f64 = 1.732_050_807_568_877_2;
const ROOT_15: f64 = 3.872_983_346_207_417;

/// The nodes; the rest of the tableau follows from them.
#[rustfmt::skip]
const NODES: [[f64; 3]; 3] = [
    [0.5,                 0.0,                 0.0                 ],
    [0.5 - ROOT_3 / 6.0,  0.5 + ROOT_3 / 6.0,  0.0                 ],
    [0.5 - ROOT_15 / 10.0, 0.5,                0.5 + ROOT_15 / 10.0],
];

#[rustfmt::skip]
const WEIGHTS: [[f64; 3]; 3] = [
    [1.0,        0.0,       0.0       ],
    [0.5,        0.5,       0.0       ],
    [5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0],
];

#[rustfmt::skip]
const MATRICES: [[[f64; 3]; 3]; 3] = [
    [[0.5,                         0.0,                         0.0                        ],
     [0.0,                         0.0,                         0.0                        ],
     [0.0,                         0.0,                         0.0                        ]],
    [[0.25,                        0.25 - ROOT_3 / 6.0,         0.0                        ],
     [0.25 + ROOT_3 / 6.0,         0.25,                        0.0                        ],
     [0.0,                         0.0,                         0.0                        ]],
    [[5.0 / 36.0,                  2.0 / 9.0 - ROOT_15 / 15.0,  5.0 / 36.0 - ROOT_15 / 30.0],
     [5.0 / 36.0 + ROOT_15 / 24.0, 2.0 / 9.0,                   5.0 / 36.0 - ROOT_15 / 24.0],
     [5.0 / 36.0 + ROOT_15 / 30.0, 2.0 / 9.0 + ROOT_15 / 15.0,  5.0 / 36.0                 ]],
];

impl<const S: usize> Tableau<S> {
    fn new() -> Self {
        const { assert!(S >= 1 && S <= 3, "Gauss collocation is available with 1, 2 or 3 stages") };
        Self {
            a: core::array::from_fn(|i| core::array::from_fn(|j| MATRICES[S - 1][i][j])),
            b: core::array::from_fn(|i| WEIGHTS[S - 1][i]),
            c: core::array::from_fn(|i| NODES[S - 1][i]),
        }
    }

    /// Entry (i, j): the j-th Lagrange polynomial of the nodes at 1 + cᵢ.
    fn continuation(&self) -> [[f64; S]; S] {
        let basis = |j: usize, x: f64| {
            let others = (0..S).filter(|&k| k != j);
            others.fold(1.0, |product, k| product * (x - self.c[k]) / (self.c[j] - self.c[k]))
        };
        core::array::from_fn(|i| core::array::from_fn(|j| basis(j, 1.0 + self.c[i])))
    }
}

/// The stages of a Gauss step, and those of the step before.
#[derive(Debug)]
pub struct GaussMemory<const STAGES: usize, S: System, T: Real> {
    field: VectorField<S, T>,
    tableau: Tableau<STAGES>,
    continuation: [[f64; STAGES]; STAGES],
    /// Of the last completed step.
    completed: [Vector<S, T>; STAGES],
    slopes: [Vector<S, T>; STAGES],
    updated: [Vector<S, T>; STAGES],
    point: Vector<S, T>,
    orientation: FormOrientation<S, T>,
}

impl<const STAGES: usize, S: System, T: Real> Memory<T> for GaussMemory<STAGES, S, T> {
    lasting!(T; vectors completed, part orientation);
}

impl<const S: usize> Scheme for Gauss<S> {
    fn order(&self) -> usize {
        2 * S
    }
    fn is_symmetric(&self) -> bool {
        true
    }
    fn preserved_form(&self) -> PreservedForm {
        PreservedForm::OmegaIfAffine
    }
}

impl<const STAGES: usize, S: System, T: Real> Carries<S, T> for Gauss<STAGES> {
    type Memory = GaussMemory<STAGES, S, T>;
}

impl<const STAGES: usize, S: DegenerateLagrangian<T>, T: Real> Method<S, T> for Gauss<STAGES> {
    fn begin(&self, system: &S, q: &Vector<S, T>, _v: &[T], t: T, _h: T) -> Result<Self::Memory, StartError> {
        self.stopping.validate()?;
        let mut field = VectorField::new(system, q, t).map_err(StartError::Starter)?;
        let (vectors, tableau) = (|| core::array::from_fn(|_| system.space().vector()), Tableau::new());
        let mut completed: [Vector<S, T>; STAGES] = vectors();
        for slope in &mut completed {
            field.evaluate(system, q, t, slope, &mut Statistics::default()).map_err(StartError::Starter)?;
        }
        Ok(GaussMemory {
            field,
            tableau,
            continuation: tableau.continuation(),
            completed,
            slopes: vectors(),
            updated: vectors(),
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
        memory.guess(q);
        let size = memory.slopes.iter().fold(T::lift(0.0), |m, slope| m.max(norm::largest(slope)));
        let h_size = Scalar::abs(h);
        let scale = norm::largest(q) + h_size * size;
        let convergence = Convergence::fixed_point(self.stopping, scale, q, self.stopping.max_iterations);
        iterate(convergence, statistics, |statistics| {
            Ok(h_size * memory.iterate(system, q, t, h, statistics)?)
        })?;
        let GaussMemory { tableau, slopes, completed, point, orientation, .. } = memory;
        combine(q, h, &tableau.b, slopes, point);
        norm::finite(point)?;
        orientation.check(system, point, t + h)?;
        q.copy_from_slice(point);
        for (completed, slope) in completed.iter_mut().zip(slopes.iter()) {
            completed.copy_from_slice(slope);
        }
        Ok(())
    }
}

impl<const STAGES: usize, S: DegenerateLagrangian<T>, T: Real> VariableStep<S, T> for Gauss<STAGES> {}

impl<const STAGES: usize, S: DegenerateLagrangian<T>, T: Real> GaussMemory<STAGES, S, T> {
    /// Continues the polynomial through the completed stages into the next step.
    #[inline]
    fn guess(&mut self, q: &[T]) {
        for (row, slope) in self.continuation.iter().zip(&mut self.slopes) {
            for n in 0..q.len() {
                let terms = row.iter().zip(&self.completed).map(|(&l, k)| T::lift(l) * k[n]);
                slope[n] = terms.fold(T::lift(0.0), |sum, term| sum + term);
            }
        }
    }

    /// Evaluates all stages once and returns the largest change of a slope.
    #[inline]
    fn iterate(
        &mut self,
        system: &S,
        q: &Vector<S, T>,
        t: T,
        h: T,
        statistics: &mut Statistics,
    ) -> Result<T, StepFailure> {
        let Self { field, tableau, slopes, updated, point, .. } = self;
        let mut correction = T::lift(0.0);
        for i in 0..STAGES {
            combine(q, h, &tableau.a[i], slopes, point);
            let stage_time = t + T::lift(tableau.c[i]) * h;
            field.evaluate(system, point, stage_time, &mut updated[i], statistics)?;
            correction = correction.max(norm::distance(&updated[i], &slopes[i]));
        }
        core::mem::swap(slopes, updated);
        Ok(correction)
    }
}

/// Sets `out` to q + h Σ wⱼ kⱼ.
#[inline(always)]
fn combine<const S: usize, T: Real, V: core::ops::Deref<Target = [T]> + core::ops::DerefMut>(
    q: &V,
    h: T,
    weights: &[f64; S],
    slopes: &[V; S],
    out: &mut V,
) {
    let factors: [T; S] = weights.map(|weight| h * T::lift(weight));
    for (n, (out, &q)) in out.iter_mut().zip(q.iter()).enumerate() {
        *out = factors.iter().zip(slopes).fold(q, |sum, (&factor, k)| sum + factor * k[n]);
    }
}

#[cfg(test)]
mod tests {
    use super::Tableau;

    /// The simplifying assumptions that define collocation at the zeros of the Legendre polynomial:
    /// C(s): Σⱼ aᵢⱼ cⱼᵏ⁻¹ = cᵢᵏ/k for k ≤ s, and B(2s): Σᵢ bᵢ cᵢᵏ⁻¹ = 1/k for k ≤ 2s.
    fn check<const S: usize>() {
        let Tableau::<S> { a, b, c } = Tableau::new();
        let moment = |w: &[f64; S], k: i32| w.iter().zip(&c).map(|(w, c)| w * c.powi(k - 1)).sum::<f64>();
        for k in 1..=2 * S as i32 {
            assert!((moment(&b, k) * f64::from(k) - 1.0).abs() < 1e-14, "B({k}) of {S} stages");
        }
        let beyond = 2 * S as i32 + 1;
        assert!((moment(&b, beyond) * f64::from(beyond) - 1.0).abs() > 1e-4, "{S} stages");
        for i in 0..S {
            for k in 1..=S as i32 {
                assert!((moment(&a[i], k) * f64::from(k) - c[i].powi(k)).abs() < 1e-15, "C({k}), row {i}");
            }
            for j in 0..S {
                let symplectic = b[i] * a[i][j] + b[j] * a[j][i] - b[i] * b[j];
                assert!(symplectic.abs() < 1e-16, "{S} stages, ({i}, {j})");
            }
        }
    }

    #[test]
    fn tableaus_are_those_of_gauss() {
        check::<1>();
        check::<2>();
        check::<3>();
    }

    #[test]
    fn continuation_reproduces_polynomials_of_the_stages() {
        let tableau = Tableau::<3>::new();
        let cubic_free = |x: f64| 2.0 - x + 3.0 * x * x;
        for (row, c) in tableau.continuation().iter().zip(tableau.c) {
            let value: f64 = row.iter().zip(tableau.c).map(|(l, c)| l * cubic_free(c)).sum();
            assert!((value - cubic_free(1.0 + c)).abs() < 1e-12);
        }
    }
}
