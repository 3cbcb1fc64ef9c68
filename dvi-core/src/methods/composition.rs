//! High order from a symmetric method of second order, by steps of different lengths.
//!
//! Φ_h = φ_{γ_s h} ∘ … ∘ φ_{γ₂ h} ∘ φ_{γ₁ h},   γ_{s+1−i} = γᵢ,   Σ γᵢ = 1
//!
//! (Hairer, Lubich & Wanner 2006, section V.3.2). Order 4 asks for Σ γᵢ³ = 0 besides; higher orders have
//! the conditions that the tests of this file walk. Some of the γᵢ are negative: a composition steps back.

use crate::memory::{Memory, lasting};
use core::fmt::Debug;

use crate::error::{StartError, StepFailure};
use crate::methods::{Carries, Here, Kept, Method, PreservedForm, Scheme, Step, VariableStep};
use crate::{Lagrangian, Real, System, Vector};

/// The coefficients up to the middle one; the rest is their mirror image.
#[derive(Debug, PartialEq)]
struct Table {
    name: &'static str,
    order: usize,
    gamma: &'static [f64],
}

impl Table {
    /// All of the coefficients, in the order of the steps.
    fn steps(&self) -> impl Iterator<Item = f64> {
        self.gamma.iter().chain(self.gamma.iter().rev().skip(1)).copied()
    }
}

// γ₁ = 1/(2 − ∛2), γ₂ = −∛2/(2 − ∛2).
#[rustfmt::skip]
static TRIPLE_JUMP: Table = Table {
    name: "triple jump", order: 4,
    gamma: &[1.351_207_191_959_657_5, -1.702_414_383_919_315_3],
};

// γ₁ = γ₂ = 1/(4 − ∛4), γ₃ = −∛4/(4 − ∛4).
#[rustfmt::skip]
static SUZUKI: Table = Table {
    name: "Suzuki", order: 4,
    gamma: &[0.414_490_771_794_375_7, 0.414_490_771_794_375_7, -0.657_963_087_177_503],
};

#[rustfmt::skip]
static YOSHIDA: Table = Table {
    name: "Yoshida A", order: 6,
    gamma: &[ 0.784_513_610_477_557_3,   0.235_573_213_359_358_13, -1.177_679_984_178_871,
              1.315_186_320_683_911_2],
};

#[rustfmt::skip]
static KAHAN_LI_6: Table = Table {
    name: "Kahan–Li 6", order: 6,
    gamma: &[ 0.392_161_444_007_314_1,   0.332_599_136_789_359_43, -0.706_246_172_557_639_3,
              0.082_213_596_293_550_8,   0.798_543_990_934_83],
};

#[rustfmt::skip]
static SUZUKI_UMENO: Table = Table {
    name: "Suzuki–Umeno", order: 8,
    gamma: &[ 0.741_670_364_350_613,    -0.409_100_825_800_031_6,   0.190_754_710_296_238_4,
             -0.573_862_471_116_082_2,   0.299_064_181_303_655_9,   0.334_624_918_245_298_16,
              0.315_293_092_396_766_6,  -0.796_887_939_352_916_4],
};

#[rustfmt::skip]
static KAHAN_LI_8: Table = Table {
    name: "Kahan–Li 8", order: 8,
    gamma: &[ 0.130_202_483_088_890_07,  0.561_162_981_775_108_4,  -0.389_474_962_644_847_27,
              0.158_841_906_555_155_6,  -0.395_903_894_133_237_57,  0.184_539_640_978_315_7,
              0.258_374_387_686_322_04,  0.295_011_723_609_310_3,  -0.605_508_533_830_034_6],
};

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
/// | [`triple_jump`](Self::triple_jump) | 4 | 3 |
/// | [`suzuki`](Self::suzuki) | 4 | 5 |
/// | [`yoshida`](Self::yoshida) | 6 | 7 |
/// | [`kahan_li_6`](Self::kahan_li_6) | 6 | 9 |
/// | [`suzuki_umeno`](Self::suzuki_umeno) | 8 | 15 |
/// | [`kahan_li_8`](Self::kahan_li_8) | 8 | 17 |
///
/// More steps of smaller size have much smaller errors: of two compositions of one order the longer one is
/// usually better at equal cost.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// let method = Composition::yoshida(Variational::trapezoid());
/// assert_eq!((method.order(), method.stages()), (6, 7));
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
    /// Order 4, three steps, the middle one backwards and 1.7 h long (Creutz & Gocksch 1989; Forest 1989;
    /// Suzuki 1990; Yoshida 1990).
    pub fn triple_jump(method: M) -> Self {
        Self { method, table: &TRIPLE_JUMP }
    }

    /// Order 4, five steps, none longer than 0.66 h (Suzuki 1990).
    pub fn suzuki(method: M) -> Self {
        Self { method, table: &SUZUKI }
    }

    /// Order 6, seven steps, solution A (Yoshida 1990).
    pub fn yoshida(method: M) -> Self {
        Self { method, table: &YOSHIDA }
    }

    /// Order 6, nine steps (Kahan & Li 1997).
    pub fn kahan_li_6(method: M) -> Self {
        Self { method, table: &KAHAN_LI_6 }
    }

    /// Order 8, fifteen steps (Suzuki & Umeno 1993).
    pub fn suzuki_umeno(method: M) -> Self {
        Self { method, table: &SUZUKI_UMENO }
    }

    /// Order 8, seventeen steps (Kahan & Li 1997).
    pub fn kahan_li_8(method: M) -> Self {
        Self { method, table: &KAHAN_LI_8 }
    }

    /// The method that is composed.
    pub fn method(&self) -> &M {
        &self.method
    }

    /// The name of the composition.
    pub fn name(&self) -> &'static str {
        self.table.name
    }

    /// The number of steps of the composed method in one step.
    pub fn stages(&self) -> usize {
        2 * self.table.gamma.len() - 1
    }
}

/// What a composition carries from step to step: the memory of its method, and where a step began.
#[derive(Debug)]
pub struct CompositionMemory<I, V> {
    inner: I,
    before: Kept<V, I>,
}

impl<I, V> CompositionMemory<I, V> {
    /// The memory of the composed method.
    pub fn inner(&self) -> &I {
        &self.inner
    }
}

impl<I: Memory<T>, V, T: Real> Memory<T> for CompositionMemory<I, V> {
    lasting!(T; part inner);
}

impl<M: Scheme> Scheme for Composition<M> {
    /// That of the composition, or of the composed method if this is higher. If the composed method is not
    /// symmetric, its error terms of even power remain: one order is gained at most.
    fn order(&self) -> usize {
        let (inner, table) = (self.method.order(), self.table.order);
        if self.method.is_symmetric() {
            inner.max(table)
        } else if inner % 2 == 0 && inner + 2 <= table {
            inner + 1
        } else {
            inner
        }
    }
    fn is_symmetric(&self) -> bool {
        self.method.is_symmetric()
    }
    fn preserved_form(&self) -> PreservedForm {
        self.method.preserved_form()
    }
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

    fn velocity(
        &self,
        here: Here<'_, S, T>,
        memory: &Self::Memory,
        v: &mut Vector<S, T>,
    ) -> Result<(), StepFailure> {
        self.method.velocity(here, &memory.inner, v)
    }
}

impl<S: Lagrangian<T>, T: Real, M: VariableStep<S, T>> VariableStep<S, T> for Composition<M> {
    type SuitedToAnyStep<X> = M::SuitedToAnyStep<X>;
}

#[cfg(test)]
mod tests {
    use alloc::{vec, vec::Vec};

    use super::{Composition, KAHAN_LI_6, KAHAN_LI_8, SUZUKI, SUZUKI_UMENO, TRIPLE_JUMP, Table, YOSHIDA};
    use crate::methods::{Gauss, RungeKutta, Scheme};

    static TABLES: [(&Table, usize); 6] = [
        (&TRIPLE_JUMP, 3),
        (&SUZUKI, 5),
        (&YOSHIDA, 7),
        (&KAHAN_LI_6, 9),
        (&SUZUKI_UMENO, 15),
        (&KAHAN_LI_8, 17),
    ];

    /// All words of odd letters with sum `weight`.
    fn words(weight: usize) -> Vec<Vec<usize>> {
        if weight == 0 {
            return vec![Vec::new()];
        }
        let mut out = Vec::new();
        for last in (1..=weight).step_by(2) {
            out.extend(words(weight - last).into_iter().map(|mut word| {
                word.push(last);
                word
            }));
        }
        out
    }

    /// 1/n!
    fn over_factorial(n: usize) -> f64 {
        (1..=n).fold(1.0, |value, k| value / k as f64)
    }

    /// A symmetric method is φ_h = exp(hτ₁ + h³τ₃ + h⁵τ₅ + …) with vector fields τ that do not commute. The
    /// factor of the word τ_i τ_j … in the product of the φ_{γh} must be that of exp(hτ₁) up to the order.
    /// Returns the largest deviation among the words of `weight`.
    fn deviation(table: &Table, weight: usize) -> f64 {
        // Of all prefixes of one word at a time, as far as the steps have come.
        let of_word = |word: &Vec<usize>| {
            let mut prefixes = vec![0.0; word.len() + 1];
            prefixes[0] = 1.0;
            for gamma in table.steps() {
                for end in (1..=word.len()).rev() {
                    let split = |from: usize| {
                        let power = word[from..end].iter().sum::<usize>() as i32;
                        prefixes[from] * gamma.powi(power) * over_factorial(end - from)
                    };
                    prefixes[end] = (0..=end).map(split).sum();
                }
            }
            let exact =
                if word.iter().all(|&letter| letter == 1) { over_factorial(word.len()) } else { 0.0 };
            (prefixes[word.len()] - exact).abs()
        };
        words(weight).iter().map(of_word).fold(0.0, f64::max)
    }

    #[test]
    fn tables_meet_the_conditions_of_their_order_and_not_of_the_next() {
        for (table, steps) in TABLES {
            assert_eq!(table.steps().count(), steps, "{}", table.name);
            assert!(table.steps().eq(table.steps().collect::<Vec<_>>().into_iter().rev()), "{}", table.name);
            assert!((table.steps().sum::<f64>() - 1.0).abs() < 1e-15, "{}", table.name);
            for weight in 1..=table.order {
                let deviation = deviation(table, weight);
                assert!(deviation < 2e-14, "{}, weight {weight}: {deviation:e}", table.name);
            }
            assert!(deviation(table, table.order + 1) > 1e-4, "{}", table.name);
        }
    }

    #[test]
    fn closed_forms() {
        let (two, four) = (2.0_f64.cbrt(), 4.0_f64.cbrt());
        let exact = [1.0 / (2.0 - two), -two / (2.0 - two), 1.0 / (4.0 - four), -four / (4.0 - four)];
        let found = [TRIPLE_JUMP.gamma[0], TRIPLE_JUMP.gamma[1], SUZUKI.gamma[0], SUZUKI.gamma[2]];
        for (found, exact) in found.iter().zip(exact) {
            assert!((found - exact).abs() < 1e-15, "{found} {exact}");
        }
        assert_eq!(SUZUKI.gamma[0], SUZUKI.gamma[1]);
    }

    /// The end of a pendulum from (1, 0.5) at time 1, by compositions of leapfrog: kick, drift, kick.
    fn pendulum(table: &Table, steps: usize) -> [f64; 2] {
        let (mut x, mut v) = (1.0_f64, 0.5);
        for _ in 0..steps {
            for gamma in table.steps() {
                let h = gamma / steps as f64;
                v -= 0.5 * h * x.sin();
                x += h * v;
                v -= 0.5 * h * x.sin();
            }
        }
        [x, v]
    }

    #[test]
    fn leapfrog_on_a_pendulum_gains_the_order_of_the_table() {
        let reference = pendulum(&KAHAN_LI_8, 48);
        #[rustfmt::skip]
        let cases = [
            (&TRIPLE_JUMP,  [64, 128]), (&SUZUKI,       [32, 64]),
            (&YOSHIDA,      [10, 20]),  (&KAHAN_LI_6,   [6, 12]),
            (&SUZUKI_UMENO, [4, 8]),    (&KAHAN_LI_8,   [2, 4]),
        ];
        for (table, steps) in cases {
            let error = |steps| {
                let [x, v] = pendulum(table, steps);
                (x - reference[0]).abs().max((v - reference[1]).abs())
            };
            let order = (error(steps[0]) / error(steps[1])).log2();
            assert!((order - table.order as f64).abs() < 0.35, "{}: {order}", table.name);
        }
    }

    #[test]
    fn the_order_is_that_of_the_better_one_unless_symmetry_is_missing() {
        assert_eq!(Composition::triple_jump(Gauss::<1>::new()).order(), 4);
        assert_eq!(Composition::triple_jump(Gauss::<3>::new()).order(), 6);
        assert_eq!(Composition::kahan_li_8(Gauss::<2>::new()).order(), 8);
        assert_eq!(Composition::suzuki(RungeKutta::midpoint()).order(), 3);
        assert_eq!(Composition::suzuki(RungeKutta::classical()).order(), 4);
        assert_eq!(Composition::yoshida(RungeKutta::classical()).order(), 5);
        assert_eq!(Composition::suzuki(Composition::triple_jump(Gauss::<1>::new())).stages(), 5);
        assert!(Composition::suzuki(Gauss::<1>::new()).is_symmetric());
        assert!(!Composition::suzuki(RungeKutta::midpoint()).is_symmetric());
    }
}
