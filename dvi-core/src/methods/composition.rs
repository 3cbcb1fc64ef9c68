//! High order from a symmetric method of second order, by steps of different lengths (Hairer, Lubich &
//! Wanner 2006, section V.3.2).

mod table;

use crate::error::{StartError, StepFailure};
use crate::memory::{Memory, lasting};
use crate::methods::{Carries, Here, Kept, Method, Scheme, Step, VariableStep, scheme};
use crate::{Lagrangian, Real, System, Vector};
use table::{KAHAN_LI_6, KAHAN_LI_8, SUZUKI, Table};

/// A symmetric composition: several steps of a method `M`, of different lengths, make one step of higher
/// order.
///
/// ```math
/// \Phi_h = \varphi_{\gamma_s h} \circ \dots \circ \varphi_{\gamma_2 h} \circ \varphi_{\gamma_1 h}, \qquad
/// \gamma_{s+1-i} = \gamma_i, \quad \sum_i \gamma_i = 1
/// ```
///
/// `M` is to be a symmetric method of order two, such as `Variational::trapezoid()` or `Gauss::<1>`; another
/// one that is accepted gains what [`order`](Scheme::order) says. Some γ are negative: the composition steps
/// back on the way.
///
/// | constructor | order | steps |
/// |---|---|---|
/// | [`suzuki`](Self::suzuki) | 4 | 5 |
/// | [`kahan_li_6`](Self::kahan_li_6) | 6 | 9 |
/// | [`kahan_li_8`](Self::kahan_li_8) | 8 | 17 |
///
/// There are compositions of fewer steps, such as the triple jump and those of Yoshida: at equal cost the
/// smaller steps of a longer one have much smaller errors as a rule.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// let method = Composition::kahan_li_6(Variational::trapezoid());
/// assert_eq!(method.order(), 6);
/// let mut run = Integrator::new(&Pendulum, method, 0.1, start)?;
/// let energy = run.energy();
/// run.take_steps(10_000)?;
/// assert!((run.energy() - energy).abs() < 1e-5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Composition<M> {
    method: M,
    table: &'static Table,
}

impl<M> Composition<M> {
    /// Order 4, five steps, none longer than 0.66 h (Suzuki 1990).
    pub fn suzuki(method: M) -> Self {
        Self { method, table: &SUZUKI }
    }

    /// Order 6, nine steps (Kahan & Li 1997).
    pub fn kahan_li_6(method: M) -> Self {
        Self { method, table: &KAHAN_LI_6 }
    }

    /// Order 8, seventeen steps (Kahan & Li 1997).
    pub fn kahan_li_8(method: M) -> Self {
        Self { method, table: &KAHAN_LI_8 }
    }
}

/// What a composition carries from step to step: the memory of its method, and where a step began.
#[derive(Debug)]
pub struct CompositionMemory<I, V> {
    inner: I,
    before: Kept<V, I>,
}

lasting!([I: Memory<T>, V, T: Real] CompositionMemory<I, V>, T; part inner);

scheme! {
    [M: Scheme] Composition<M>, |method|
    /// That of the composition, or of the composed method if this is higher. If the composed method is not
    /// symmetric, its error terms of even power remain: one order is gained at most.
    order: match (method.method.order(), method.table.order) {
        (inner, table) if method.method.is_symmetric() => inner.max(table),
        (inner, table) if inner % 2 == 0 && inner + 2 <= table => inner + 1,
        (inner, _) => inner,
    },
    is_symmetric: method.method.is_symmetric(),
    preserved_form: method.method.preserved_form(),
}

impl<S: System, T: Real, M: Carries<S, T>> Carries<S, T> for Composition<M> {
    type Memory = CompositionMemory<M::Memory, Vector<S, T>>;
}

impl<S: Lagrangian<T>, T: Real, M: VariableStep<S, T>> Method<S, T> for Composition<M> {
    type Suited<X> = M::SuitedToAnyStep<X>;

    fn begin(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, h: T) -> Result<Self::Memory, StartError> {
        let begin = || self.method.begin(system, q, v, t, h);
        Ok(CompositionMemory { inner: begin()?, before: Kept { q: q.clone(), memory: begin()? } })
    }

    #[inline]
    fn step(&self, step: Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        let Step { system, q, t, h, statistics } = step;
        let CompositionMemory { inner, before } = memory;
        before.take(q, inner);
        let mut elapsed = 0.0;
        for gamma in self.table.steps() {
            let (t, h) = (t + T::lift(elapsed) * h, T::lift(gamma) * h);
            let step = Step { system, q, t, h, statistics };
            if let Err(failure) = self.method.step(step, inner) {
                before.go_back(q, inner);
                return Err(failure);
            }
            elapsed += gamma;
        }
        Ok(())
    }

    fn velocity(&self, here: Here<'_, S, T>, memory: &Self::Memory, v: &mut [T]) -> Result<(), StepFailure> {
        self.method.velocity(here, &memory.inner, v)
    }
}

impl<S: Lagrangian<T>, T: Real, M: VariableStep<S, T>> VariableStep<S, T> for Composition<M> {
    type SuitedToAnyStep<X> = M::SuitedToAnyStep<X>;
}

#[cfg(test)]
mod tests {
    use super::Composition;
    use crate::methods::{Gauss, RungeKutta, Scheme};

    #[test]
    fn the_order_is_that_of_the_better_one_unless_symmetry_is_missing() {
        assert_eq!(Composition::suzuki(Gauss::<1>::new()).order(), 4);
        assert_eq!(Composition::suzuki(Gauss::<3>::new()).order(), 6);
        assert_eq!(Composition::kahan_li_8(Gauss::<2>::new()).order(), 8);
        assert_eq!(Composition::suzuki(RungeKutta::midpoint()).order(), 3);
        assert_eq!(Composition::suzuki(RungeKutta::classical()).order(), 4);
        assert_eq!(Composition::kahan_li_6(RungeKutta::classical()).order(), 5);
        assert!(Composition::suzuki(Gauss::<1>::new()).is_symmetric());
        assert!(!Composition::suzuki(RungeKutta::midpoint()).is_symmetric());
    }
}
