//! The coefficients of symmetric compositions.
//!
//! Order 4 asks for Σ γᵢ³ = 0 beside Σ γᵢ = 1; higher orders have the conditions that the test of this file
//! walks. Some of the γᵢ are negative: a composition steps back.

/// The coefficients up to the middle one; the rest is their mirror image.
#[derive(Debug, PartialEq)]
pub(super) struct Table {
    pub(super) order: usize,
    pub(super) gamma: &'static [f64],
}

impl Table {
    /// All of the coefficients, in the order of the steps.
    pub(super) fn steps(&self) -> impl Iterator<Item = f64> {
        self.gamma.iter().chain(self.gamma.iter().rev().skip(1)).copied()
    }
}

// γ₁ = γ₂ = 1/(4 − ∛4), γ₃ = −∛4/(4 − ∛4).
#[rustfmt::skip]
pub(super) static SUZUKI: Table = Table {
    order: 4,
    gamma: &[0.414_490_771_794_375_7, 0.414_490_771_794_375_7, -0.657_963_087_177_503],
};

#[rustfmt::skip]
pub(super) static KAHAN_LI_6: Table = Table {
    order: 6,
    gamma: &[ 0.392_161_444_007_314_1,   0.332_599_136_789_359_43, -0.706_246_172_557_639_3,
              0.082_213_596_293_550_8,   0.798_543_990_934_83],
};

#[rustfmt::skip]
pub(super) static KAHAN_LI_8: Table = Table {
    order: 8,
    gamma: &[ 0.130_202_483_088_890_07,  0.561_162_981_775_108_4,  -0.389_474_962_644_847_27,
              0.158_841_906_555_155_6,  -0.395_903_894_133_237_57,  0.184_539_640_978_315_7,
              0.258_374_387_686_322_04,  0.295_011_723_609_310_3,  -0.605_508_533_830_034_6],
};

#[cfg(test)]
mod tests {
    use alloc::{vec, vec::Vec};

    use super::{KAHAN_LI_6, KAHAN_LI_8, SUZUKI, Table};

    static TABLES: [(&Table, usize); 3] = [(&SUZUKI, 5), (&KAHAN_LI_6, 9), (&KAHAN_LI_8, 17)];

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
            assert_eq!(table.steps().count(), steps);
            assert!(table.steps().eq(table.steps().collect::<Vec<_>>().into_iter().rev()), "{table:?}");
            assert!((table.steps().sum::<f64>() - 1.0).abs() < 1e-15, "{table:?}");
            for weight in 1..=table.order {
                let deviation = deviation(table, weight);
                assert!(deviation < 2e-14, "{table:?}, weight {weight}: {deviation:e}");
            }
            assert!(deviation(table, table.order + 1) > 1e-4, "{table:?}");
        }
    }

    #[test]
    fn closed_forms() {
        let four = 4.0_f64.cbrt();
        let exact = [1.0 / (4.0 - four), 1.0 / (4.0 - four), -four / (4.0 - four)];
        for (found, exact) in SUZUKI.gamma.iter().zip(exact) {
            assert!((found - exact).abs() < 1e-15, "{found} {exact}");
        }
    }
}
