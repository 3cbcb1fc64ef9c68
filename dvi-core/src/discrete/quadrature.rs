//! Quadrature rules on [0, 1]: ∫₀¹ f(c) dc ≈ Σⱼ wⱼ f(cⱼ).
//!
//! Gauss rules have their nodes at the zeros of the shifted Legendre polynomial of degree s and are exact to
//! degree 2s − 1; Lobatto rules add both ends and are exact to degree 2s − 3 (Davis & Rabinowitz 1984,
//! sections 2.7 and 2.7.1).

use crate::error::StartError;

/// How many nodes a rule has at most.
pub(crate) const NODES: usize = 5;

/// A rule of one to five nodes in \[0, 1\] whose weights sum to one.
///
/// ```
/// use dvi_core::discrete::Rule;
/// use dvi_core::prelude::*;
///
/// let cube: f64 = Simpson.nodes().iter().zip(Simpson.weights()).map(|(c, w)| w * c * c * c).sum();
/// assert_eq!(cube, 0.25); // exact
/// ```
///
/// [`Midpoint`], [`Trapezoid`] and [`Simpson`] are known at compile time: their steps are straight code. A
/// [`Quadrature`] is any rule, chosen at run time.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no quadrature rule",
    note = "rules are `Midpoint`, `Trapezoid`, `Simpson` and any `Quadrature`"
)]
pub trait Rule: Copy + core::fmt::Debug {
    /// Whether the compiler knows that this is the trapezoidal rule.
    const TRAPEZOIDAL: bool = false;

    /// The nodes cⱼ.
    fn nodes(&self) -> &[f64];
    /// The weights wⱼ.
    fn weights(&self) -> &[f64];

    /// Whether c and 1 − c have the same weight, for every node c, up to rounding; a node that is given more
    /// than once has the sum of its weights.
    fn is_symmetric(&self) -> bool {
        let near = |a: f64, b: f64| a - b <= 1e-15 && b - a <= 1e-15;
        let weight_at = |c: f64| {
            let entries = self.nodes().iter().zip(self.weights());
            entries.filter(|&(&d, _)| near(c, d)).map(|(_, &w)| w).sum::<f64>()
        };
        self.nodes().iter().all(|&c| near(weight_at(c), weight_at(1.0 - c)))
    }

    /// Whether Σ w c = ½, up to rounding, so that linear functions are integrated exactly: symmetric rules
    /// are, and Radau's.
    fn is_exact_for_linear(&self) -> bool {
        let sum: f64 = self.nodes().iter().zip(self.weights()).map(|(c, w)| w * (c - 0.5)).sum();
        (-1e-15..=1e-15).contains(&sum)
    }

    /// How many nodes are neither 0 nor 1.
    fn interior_nodes(&self) -> usize {
        self.nodes().iter().filter(|&&c| c != 0.0 && c != 1.0).count()
    }
}

macro_rules! rules {
    ($($(#[$doc:meta])* $name:ident = [$table:expr];)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct $name;

        impl Rule for $name {
            const TRAPEZOIDAL: bool = matches!($table.0, [0.0, 1.0]);

            #[inline]
            fn nodes(&self) -> &[f64] {
                const { $table.0 }
            }
            #[inline]
            fn weights(&self) -> &[f64] {
                const { $table.1 }
            }
        }
    )*};
}

rules! {
    /// The rule with the node ½, exact for linear functions.
    ///
    /// ```
    /// use dvi_core::prelude::*;
    /// assert_eq!(Variational::midpoint().rule, Midpoint);
    /// ```
    Midpoint = [GAUSS[0]];
    /// The trapezoidal rule: nodes 0 and 1 with weights ½, exact for linear functions.
    ///
    /// ```
    /// use dvi_core::prelude::*;
    /// assert_eq!(Variational::trapezoid().rule, Trapezoid);
    /// ```
    Trapezoid = [LOBATTO[0]];
    /// Simpson's rule: nodes 0, ½ and 1 with weights 1/6, 2/3 and 1/6, exact for cubic functions.
    ///
    /// ```
    /// use dvi_core::prelude::*;
    /// assert_eq!(Variational::simpson().rule, Simpson);
    /// ```
    Simpson = [LOBATTO[1]];
}

/// Any rule, as data.
///
/// ```
#[doc = include_str!("../../docs/hidden/pendulum.txt")]
/// // Radau's rule of two nodes.
/// let rule = Quadrature::new(&[0.0, 2.0 / 3.0], &[0.25, 0.75])?;
/// let method = Variational::new(rule);
/// assert_eq!((method.order(), method.is_symmetric()), (2, false));
/// let mut run = Integrator::new(&Pendulum, method, 0.01, start)?;
/// let energy = run.energy();
/// run.take_steps(10_000)?;
/// assert!((run.energy() - energy).abs() < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quadrature {
    nodes: [f64; NODES],
    weights: [f64; NODES],
    len: usize,
}

/// Nodes and weights.
type Table<'a> = (&'a [f64], &'a [f64]);

#[rustfmt::skip]
const GAUSS: [Table<'static>; 5] = [
    (&[0.5], &[1.0]),
    // ½ ∓ √3/6
    (&[0.211_324_865_405_187_1, 0.788_675_134_594_812_9], &[0.5, 0.5]),
    // ½ ∓ √15/10
    (&[0.112_701_665_379_258_31, 0.5, 0.887_298_334_620_741_7], &[5.0 / 18.0, 4.0 / 9.0, 5.0 / 18.0]),
    // ½ ∓ ½√(3/7 ± (2/7)√(6/5)), weights (18 ∓ √30)/72
    (&[0.069_431_844_202_973_71, 0.330_009_478_207_571_87, 0.669_990_521_792_428_1, 0.930_568_155_797_026_3],
    &[0.173_927_422_568_726_93, 0.326_072_577_431_273_1, 0.326_072_577_431_273_1, 0.173_927_422_568_726_93]),
    // ½ ∓ ⅙√(5 ± 2√(10/7)), weights (322 ∓ 13√70)/1800 and 64/225
    (&[0.046_910_077_030_668_004, 0.230_765_344_947_158_45,
       0.5, 0.769_234_655_052_841_5, 0.953_089_922_969_332],
     &[0.118_463_442_528_094_54, 0.239_314_335_249_683_23,
       64.0 / 225.0, 0.239_314_335_249_683_23, 0.118_463_442_528_094_54]),
];

#[rustfmt::skip]
const LOBATTO: [Table<'static>; 4] = [
    (&[0.0, 1.0], &[0.5, 0.5]),
    (&[0.0, 0.5, 1.0], &[1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0]),
    // ½ ∓ √5/10
    (&[0.0,        0.276_393_202_250_021, 0.723_606_797_749_979, 1.0       ],
     &[1.0 / 12.0, 5.0 / 12.0,            5.0 / 12.0,            1.0 / 12.0]),
    // ½ ∓ √21/14
    (&[0.0,        0.172_673_164_646_011_43, 0.5,         0.827_326_835_353_988_6, 1.0       ],
     &[1.0 / 20.0, 49.0 / 180.0,             16.0 / 45.0, 49.0 / 180.0,            1.0 / 20.0]),
];

impl Quadrature {
    const fn of((nodes, weights): Table<'_>) -> Self {
        let mut rule = Self { nodes: [0.0; NODES], weights: [0.0; NODES], len: nodes.len() };
        rule.nodes.split_at_mut(nodes.len()).0.copy_from_slice(nodes);
        rule.weights.split_at_mut(nodes.len()).0.copy_from_slice(weights);
        rule
    }

    /// Any rule, of one to five nodes.
    ///
    /// # Errors
    /// [`StartError::Parameter`] if there are no or more than five nodes, the numbers of nodes and weights
    /// differ, a node lies outside of \[0, 1\], or the weights do not sum up to one within 1e-12.
    pub fn new(nodes: &[f64], weights: &[f64]) -> Result<Self, StartError> {
        let (count, weight_count) = (nodes.len(), weights.len());
        StartError::unless((1..=NODES).contains(&count), "nodes.len()", count as f64, "1 to 5")?;
        let as_many = weight_count == count;
        StartError::unless(as_many, "weights.len()", weight_count as f64, "as many weights as nodes")?;
        for &node in nodes {
            StartError::unless((0.0..=1.0).contains(&node), "node", node, "0 <= node <= 1")?;
        }
        let sum: f64 = weights.iter().sum();
        let differs = if sum > 1.0 { sum - 1.0 } else { 1.0 - sum };
        StartError::unless(differs <= 1e-12, "sum of the weights", sum, "1")?;
        Ok(Self::of((nodes, weights)))
    }

    /// ½.
    pub const fn midpoint() -> Self {
        Self::of(GAUSS[0])
    }

    /// 0 and 1, with weights ½.
    pub const fn trapezoid() -> Self {
        Self::of(LOBATTO[0])
    }

    /// 0, ½ and 1, with weights 1/6, 2/3, 1/6.
    pub const fn simpson() -> Self {
        Self::of(LOBATTO[1])
    }

    /// One node at `sigma`. A run refuses one that is not in \[0, 1\].
    pub const fn sigma(sigma: f64) -> Self {
        Self::of((&[sigma], &[1.0]))
    }

    /// The Gauss rule with one to five nodes, exact to degree 2·`nodes` − 1.
    ///
    /// # Errors
    /// [`StartError::Parameter`] for another number of nodes.
    pub fn gauss(nodes: usize) -> Result<Self, StartError> {
        let is_known = (1..=NODES).contains(&nodes);
        StartError::unless(is_known, "nodes of the Gauss rule", nodes as f64, "1 to 5")?;
        Ok(Self::of(GAUSS[nodes - 1]))
    }

    /// The Lobatto rule with two to five nodes, both ends among them, exact to degree 2·`nodes` − 3.
    ///
    /// # Errors
    /// [`StartError::Parameter`] for another number of nodes.
    pub fn lobatto(nodes: usize) -> Result<Self, StartError> {
        let is_known = (2..=NODES).contains(&nodes);
        StartError::unless(is_known, "nodes of the Lobatto rule", nodes as f64, "2 to 5")?;
        Ok(Self::of(LOBATTO[nodes - 2]))
    }
}

impl Rule for Quadrature {
    #[inline]
    fn nodes(&self) -> &[f64] {
        &self.nodes[..self.len]
    }
    #[inline]
    fn weights(&self) -> &[f64] {
        &self.weights[..self.len]
    }
}

#[cfg(test)]
mod tests {
    use super::{Midpoint, Quadrature, Rule, Simpson, Trapezoid};
    use crate::error::StartError;

    fn moment(rule: &Quadrature, degree: i32) -> f64 {
        rule.nodes().iter().zip(rule.weights()).map(|(c, w)| w * c.powi(degree)).sum()
    }

    #[track_caller]
    fn check(rule: &Quadrature, degree: i32) {
        for k in 0..=degree {
            let error = moment(rule, k) - 1.0 / f64::from(k + 1);
            assert!(error.abs() < 2e-16, "{rule:?}, degree {k}: {error:e}");
        }
        let beyond = moment(rule, degree + 1) - 1.0 / f64::from(degree + 2);
        assert!(beyond.abs() > 1e-7, "{rule:?}: {beyond:e}");
        assert!(rule.is_symmetric());
    }

    #[test]
    fn a_node_that_is_given_twice_has_both_weights() -> Result<(), StartError> {
        let third = 1.0 / 3.0;
        assert!(!Quadrature::new(&[0.25, 0.25, 0.75], &[third; 3])?.is_symmetric());
        assert!(Quadrature::new(&[0.25, 0.25, 0.75], &[0.25, 0.25, 0.5])?.is_symmetric());
        assert!(Quadrature::new(&[0.0, 0.5, 1.0, 0.5], &[0.25; 4])?.is_symmetric());
        Ok(())
    }

    #[test]
    fn rules_are_exact_to_their_degree_and_no_further() -> Result<(), StartError> {
        for s in 1..=5 {
            check(&Quadrature::gauss(s)?, 2 * s as i32 - 1);
        }
        for s in 2..=5 {
            let rule = Quadrature::lobatto(s)?;
            check(&rule, 2 * s as i32 - 3);
            assert_eq!((rule.nodes()[0], rule.nodes()[s - 1]), (0.0, 1.0));
        }
        fn same(rule: &Quadrature, known: &impl Rule) -> bool {
            (rule.nodes(), rule.weights()) == (known.nodes(), known.weights())
        }
        assert!(same(&Quadrature::gauss(1)?, &Midpoint));
        assert!(same(&Quadrature::lobatto(2)?, &Trapezoid) && same(&Quadrature::lobatto(3)?, &Simpson));
        Ok(())
    }

    #[test]
    fn rules_that_are_none_are_refused() {
        for (nodes, weights) in [
            (&[][..], &[][..]),
            (&[0.5; 6], &[1.0 / 6.0; 6]),
            (&[0.5, 1.0], &[1.0]),
            (&[-0.1, 1.0], &[0.5, 0.5]),
            (&[f64::NAN], &[1.0]),
            (&[0.5], &[0.9]),
            (&[0.5], &[f64::NAN]),
        ] {
            assert!(
                matches!(Quadrature::new(nodes, weights), Err(StartError::Parameter { .. })),
                "{nodes:?}"
            );
        }
        for count in [0, 6] {
            assert!(Quadrature::gauss(count).is_err() && Quadrature::lobatto(count).is_err());
        }
        assert!(Quadrature::lobatto(1).is_err());
        assert!(!Quadrature::sigma(0.3).is_symmetric() && Quadrature::sigma(0.5).is_symmetric());
        let rules = [Quadrature::trapezoid(), Quadrature::sigma(0.3), Quadrature::simpson()];
        assert_eq!(rules.map(|rule| rule.interior_nodes()), [0, 1, 1]);
    }
}
