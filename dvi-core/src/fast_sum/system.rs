//! A fast sum as a system: what `S` is, with the sum over pairs exchanged.
//!
//! The compiler does not recommend these in its messages: a system is not of another kind for them.

use super::FastSum;
use super::packs::Pack;
use crate::error::{IndexError, OutsideError};
use crate::system::TimeTransform;
use crate::{
    DegenerateLagrangian, Held, Lagrangian, NondegenerateLagrangian, PairSum, ProperlyDegenerate,
    RegularLagrangian, Report, Scalar, Separable, Sink, System, Weights,
};

#[diagnostic::do_not_recommend]
impl<S: System, const D: usize> Held for FastSum<'_, S, D> {
    type System = Self;
    fn held(&self) -> &Self {
        self
    }
}

#[diagnostic::do_not_recommend]
impl<S: System, const D: usize> System for FastSum<'_, S, D> {
    type Space = S::Space;
    type State<T: Scalar> = S::State<T>;
    type Kind = S::Kind;
    const REPORT: Report = S::REPORT;
    const HAS_SCALAR_FIELDS: bool = S::HAS_SCALAR_FIELDS;
    const HAS_DOMAIN: bool = S::HAS_DOMAIN;
    const SEAMS: usize = S::SEAMS;
    const TIME_TRANSFORMED: bool = S::TIME_TRANSFORMED;
    const AUTONOMOUS: bool = S::AUTONOMOUS;
    const FORCED: bool = S::FORCED;
    const FAST_SUM: bool = true;

    fn space(&self) -> S::Space {
        self.system.space()
    }
    fn block_len(&self, block: usize) -> usize {
        self.system.block_len(block)
    }
    fn check(&self) -> Result<(), IndexError> {
        self.system.check()
    }
}

#[diagnostic::do_not_recommend]
impl<S, const D: usize> Lagrangian for FastSum<'_, S, D>
where
    S: PairSum<f64, D> + PairSum<Pack, D> + Sync,
{
    fn lagrangian(&self, q: &[f64], v: &[f64], t: f64) -> f64 {
        self.system.rest_lagrangian(q, v, t) - self.pair_energy(q)
    }
    fn gradient(&self, q: &[f64], v: &[f64], t: f64, l_q: &mut [f64], l_v: &mut [f64]) {
        self.system.rest_gradient(q, v, t, l_q, l_v);
        self.add_pairs(q, -1.0, l_q);
    }
    fn linearize<K: Sink<f64>>(
        &self,
        q: &[f64],
        v: &[f64],
        t: f64,
        w: Weights<f64>,
        l_q: &mut [f64],
        l_v: &mut [f64],
        sink: &mut K,
    ) {
        if w.qq == 0.0 {
            // The sum has second derivatives by places only.
            self.system.rest_linearize(q, v, t, w, l_q, l_v, sink);
            self.add_pairs(q, -1.0, l_q);
        } else {
            self.system.linearize(q, v, t, w, l_q, l_v, sink);
            self.gradient(q, v, t, l_q, l_v);
        }
    }
    fn applied_force(&self, q: &[f64], v: &[f64], t: f64, out: &mut [f64]) {
        self.system.applied_force(q, v, t, out);
    }
    fn domain(&self, q: &[f64], t: f64) -> f64 {
        self.system.domain(q, t)
    }
    fn outside(&self, q: &[f64], v: &[f64], t: f64) -> Option<OutsideError> {
        self.system.outside(q, v, t)
    }
    fn time_transform(&self, q: &[f64]) -> Option<TimeTransform<f64>> {
        self.system.time_transform(q)
    }
    fn energy(&self, q: &[f64], v: &[f64], t: f64) -> f64 {
        self.system.rest_energy(q, v, t) + self.pair_energy(q)
    }
    fn momentum(&self, index: usize, q: &[f64], v: &[f64], t: f64) -> f64 {
        self.system.momentum(index, q, v, t)
    }
    fn event(&self, index: usize, q: &[f64], v: &[f64], t: f64) -> f64 {
        self.system.event(index, q, v, t)
    }
    fn seam(&self, index: usize, q: &[f64], v: &[f64], t: f64) -> f64 {
        self.system.seam(index, q, v, t)
    }
    fn event_gradient(
        &self,
        index: usize,
        q: &[f64],
        v: &[f64],
        t: f64,
        l_q: &mut [f64],
        l_v: &mut [f64],
    ) -> f64 {
        self.system.event_gradient(index, q, v, t, l_q, l_v)
    }
}

impl<S, const D: usize> FastSum<'_, S, D>
where
    S: PairSum<f64, D> + PairSum<Pack, D> + Sync,
{
    /// Adds the gradient of the sum over pairs, times `factor`.
    fn add_pairs(&self, q: &[f64], factor: f64, out: &mut [f64]) {
        let first: [usize; D] = core::array::from_fn(|axis| PairSum::<f64, D>::place(self.system, axis));
        self.pair_gradient(q, |body, gradient| {
            for axis in 0..D {
                out[first[axis] + body] += factor * gradient[axis];
            }
        });
    }
}

#[diagnostic::do_not_recommend]
impl<S, const D: usize> DegenerateLagrangian for FastSum<'_, S, D>
where
    S: PairSum<f64, D> + PairSum<Pack, D> + DegenerateLagrangian + Sync,
{
    type Suited<M> = M;

    const AFFINE: bool = <S as DegenerateLagrangian<f64>>::AFFINE;
    const MATCHING: bool = <S as DegenerateLagrangian<f64>>::MATCHING;
    const CANONICAL: bool = <S as DegenerateLagrangian<f64>>::CANONICAL;

    fn hamiltonian(&self, q: &[f64], t: f64) -> f64 {
        self.system.rest_energy(q, &[], t) + self.pair_energy(q)
    }
    fn hamiltonian_gradient(&self, q: &[f64], t: f64, out: &mut [f64]) {
        self.system.rest_hamiltonian_gradient(q, t, out);
        self.add_pairs(q, 1.0, out);
    }
    fn flow_source(&self, q: &[f64], t: f64, out: &mut [f64]) {
        self.system.rest_flow_source(q, t, out);
        self.add_pairs(q, 1.0, out);
    }
    fn one_form(&self, q: &[f64], t: f64, out: &mut [f64]) {
        self.system.one_form(q, t, out);
    }
    fn one_form_jacobian<K: Sink<f64>>(&self, q: &[f64], t: f64, a: f64, b: f64, sink: &mut K) {
        self.system.one_form_jacobian(q, t, a, b, sink);
    }
    fn conjugate_entries(&self, q: &[f64], t: f64, a: f64, b: f64, out: &mut [f64]) {
        self.system.conjugate_entries(q, t, a, b, out);
    }
    fn conjugates_end(&self, i: usize) -> usize {
        DegenerateLagrangian::<f64>::conjugates_end(self.system, i)
    }
    fn conjugate(&self, i: usize) -> usize {
        DegenerateLagrangian::<f64>::conjugate(self.system, i)
    }
    fn momentum_gradient(&self, index: usize, q: &[f64], t: f64, out: &mut [f64]) {
        self.system.momentum_gradient(index, q, t, out);
    }
}

#[diagnostic::do_not_recommend]
impl<S, const D: usize> ProperlyDegenerate for FastSum<'_, S, D>
where
    S: PairSum<f64, D> + PairSum<Pack, D> + ProperlyDegenerate + Sync,
{
    type Suited<M> = M;

    fn place(&self, coordinate: usize) -> usize {
        ProperlyDegenerate::place(self.system, coordinate)
    }
}

#[diagnostic::do_not_recommend]
impl<S, const D: usize> NondegenerateLagrangian for FastSum<'_, S, D>
where
    S: PairSum<f64, D> + PairSum<Pack, D> + NondegenerateLagrangian + Sync,
{
    const CONSTANT_MASS: bool = <S as NondegenerateLagrangian<f64>>::CONSTANT_MASS;
    const UNIFORM_MASS: bool = <S as NondegenerateLagrangian<f64>>::UNIFORM_MASS;
    const SEPARABLE: bool = <S as NondegenerateLagrangian<f64>>::SEPARABLE;
    const DIAGONAL_MASS: bool = <S as NondegenerateLagrangian<f64>>::DIAGONAL_MASS;
    const QUADRATIC: bool = <S as NondegenerateLagrangian<f64>>::QUADRATIC;

    fn force(&self, q: &[f64], v: &[f64], t: f64, out: &mut [f64]) {
        self.system.rest_force(q, v, t, out);
        self.add_pairs(q, -1.0, out);
    }
    fn conjugate_momentum(&self, q: &[f64], v: &[f64], t: f64, out: &mut [f64]) {
        self.system.conjugate_momentum(q, v, t, out);
    }
    fn momentum_rate(&self, q: &[f64], v: &[f64], t: f64, out: &mut [f64]) {
        self.system.momentum_rate(q, v, t, out);
    }
}

#[diagnostic::do_not_recommend]
impl<S, const D: usize> RegularLagrangian for FastSum<'_, S, D>
where
    S: PairSum<f64, D> + PairSum<Pack, D> + RegularLagrangian + Sync,
{
    type Suited<M> = M;
}

#[diagnostic::do_not_recommend]
impl<S, const D: usize> Separable for FastSum<'_, S, D>
where
    S: PairSum<f64, D> + PairSum<Pack, D> + Separable + Sync,
{
    type Suited<M> = M;
}
