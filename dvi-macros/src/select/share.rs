//! Pairs of factors that occur in several products.

use std::collections::BTreeMap;

use super::{Builder, Factor};

impl Builder<'_> {
    /// Multiplies the pair that occurs most often once for all, again and again.
    pub(super) fn share_pairs(&mut self) {
        let mut counts: BTreeMap<(Factor, Factor), i64> = BTreeMap::new();
        let mut products: Vec<Vec<Factor>> = self.products.values().cloned().collect();
        for factors in &products {
            count_pairs(factors, 1, &mut counts);
        }
        loop {
            let rank = |(a, b): (Factor, Factor)| {
                // A division should come last: its result is waited for longest.
                let divides = [a, b].iter().any(|factor| self.is_reciprocal(*factor));
                (divides, self.depth(a).max(self.depth(b)), a, b)
            };
            let best = counts.iter().max_by_key(|(pair, count)| (**count, std::cmp::Reverse(rank(**pair))));
            let Some((pair, 2..)) = best.map(|(pair, count)| (*pair, *count)) else { break };
            let fresh = Factor::Pair(self.pairs.len() as u32);
            self.pairs.push(pair);
            for factors in &mut products {
                let times = occurrences(factors, pair);
                if times > 0 {
                    count_pairs(factors, -1, &mut counts);
                    for _ in 0..times {
                        remove(factors, pair.0);
                        remove(factors, pair.1);
                        factors.push(fresh);
                    }
                    count_pairs(factors, 1, &mut counts);
                }
            }
        }
        for (product, factors) in self.products.values_mut().zip(products) {
            *product = factors;
        }
    }
}

fn multiplicity(factors: &[Factor], factor: Factor) -> usize {
    factors.iter().filter(|known| **known == factor).count()
}

fn occurrences(factors: &[Factor], (a, b): (Factor, Factor)) -> usize {
    if a == b { multiplicity(factors, a) / 2 } else { multiplicity(factors, a).min(multiplicity(factors, b)) }
}

pub(super) fn remove(factors: &mut Vec<Factor>, factor: Factor) {
    if let Some(position) = factors.iter().position(|known| *known == factor) {
        factors.remove(position);
    }
}

fn count_pairs(factors: &[Factor], sign: i64, counts: &mut BTreeMap<(Factor, Factor), i64>) {
    let mut distinct = factors.to_vec();
    distinct.sort_unstable();
    distinct.dedup();
    for (position, a) in distinct.iter().enumerate() {
        for b in &distinct[position..] {
            let times = occurrences(factors, (*a, *b)) as i64;
            if times > 0 {
                let count = counts.entry((*a, *b)).or_default();
                *count += sign * times;
                if *count == 0 {
                    counts.remove(&(*a, *b));
                }
            }
        }
    }
}
