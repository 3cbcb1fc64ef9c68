//! Pairs of factors that occur in several products.
//!
//! Each pair knows how often it occurs and in which products, so that to share one touches these products
//! only. Once all products are counted, a pair occurs less and less often, as other pairs take its factors:
//! no count in the queue is too small, and the first one that is right is the largest.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use rustc_hash::FxHashMap as HashMap;

use super::{Builder, Factor, Pair};
use crate::internal::internal;
use crate::work::step;

/// A factor by its place in the order of factors.
type Number = usize;

#[derive(Default)]
struct Occurrences {
    count: u32,
    /// Where it occurs, or did.
    products: Vec<usize>,
}

/// What decides between pairs that occur equally often: a division should come last, because its result is
/// waited for longest, and what is known further outside comes first.
type Rank = (bool, u32, Number, Number);

#[derive(Default)]
struct Sharing {
    factors: Vec<Factor>,
    /// Whether each of them divides, and the loops that must run around it.
    ranks: Vec<(bool, u32)>,
    products: Vec<Vec<(Number, u32)>>,
    pairs: HashMap<(Number, Number), Occurrences>,
    /// Pairs that have been counted and not been put in the queue.
    fresh: Vec<(Number, Number)>,
    queue: BinaryHeap<(u32, Reverse<Rank>)>,
}

impl Builder<'_> {
    /// Multiplies the pair that occurs most often once for all, again and again.
    pub(super) fn share_pairs(&mut self) {
        let mut sharing = Sharing::default();
        let numbers: HashMap<Factor, Number> =
            self.repeated().into_iter().map(|factor| (factor, sharing.number(self, factor))).collect();
        for (product, powers) in self.products.values_mut().enumerate() {
            sharing.products.push(Vec::new());
            powers.retain(|(factor, exponent)| match numbers.get(factor) {
                Some(number) => {
                    sharing.enter(product, *number, *exponent);
                    false
                }
                None => true,
            });
        }
        sharing.wait();
        while let Some((a, b)) = sharing.next() {
            let pair = self.pair(sharing.factors[a], sharing.factors[b]);
            let pair = sharing.number(self, pair);
            sharing.replace(a, b, pair);
            sharing.wait();
        }
        for (powers, shared) in self.products.values_mut().zip(&sharing.products) {
            powers.extend(shared.iter().map(|(number, exponent)| (sharing.factors[*number], *exponent)));
        }
    }

    /// The factors that occur twice in all, in order: no other is in a pair that does.
    fn repeated(&self) -> Vec<Factor> {
        let mut powers: Vec<(Factor, u32)> = self.products.values().flatten().copied().collect();
        powers.sort_unstable();
        let occurrences = |same: &[(Factor, u32)]| same.iter().map(|(_, exponent)| exponent).sum::<u32>();
        let alike = powers.chunk_by(|(one, _), (two, _)| one == two);
        alike.filter(|same| occurrences(same) > 1).map(|same| same[0].0).collect()
    }

    fn pair(&mut self, a: Factor, b: Factor) -> Factor {
        let number = self.pairs.len() as u32;
        self.pairs.push(Pair { factors: [a, b], free: self.free(a).and(self.free(b)) });
        Factor::Pair(number)
    }
}

impl Sharing {
    /// The number of a factor that comes behind all others.
    fn number(&mut self, builder: &Builder<'_>, factor: Factor) -> Number {
        self.factors.push(factor);
        self.ranks.push((builder.reciprocal_of(factor).is_some(), builder.depth(factor)));
        self.factors.len() - 1
    }

    /// Puts a power into a product, behind what is there.
    fn enter(&mut self, product: usize, factor: Number, exponent: u32) {
        let powers = &mut self.products[product];
        powers.push((factor, exponent));
        for (other, times) in powers {
            step();
            let count = if *other == factor { exponent / 2 } else { exponent.min(*times) };
            if count > 0 {
                let pair = (*other, factor);
                let known = self.pairs.entry(pair).or_insert_with(|| {
                    self.fresh.push(pair);
                    Occurrences::default()
                });
                known.count += count;
                known.products.push(product);
            }
        }
    }

    /// Takes a factor out of a product some times.
    fn leave(&mut self, product: usize, factor: Number, times: u32) {
        let powers = &mut self.products[product];
        let Some(position) = powers.iter().position(|(known, _)| *known == factor) else {
            internal("a factor is taken out of a product that has none of it")
        };
        let before = powers[position].1;
        let after = before - times;
        for (other, exponent) in powers.iter() {
            step();
            let lost = if *other == factor {
                before / 2 - after / 2
            } else {
                before.min(*exponent) - after.min(*exponent)
            };
            let pair = (factor.min(*other), factor.max(*other));
            if let Some(known) = self.pairs.get_mut(&pair).filter(|_| lost > 0) {
                known.count -= lost;
            }
        }
        powers[position].1 = after;
        powers.retain(|(_, exponent)| *exponent > 0);
    }

    /// Puts a pair in the place of its factors, wherever both are.
    fn replace(&mut self, a: Number, b: Number, pair: Number) {
        let occurrences = self.pairs.remove(&(a, b)).unwrap_or_default();
        for product in occurrences.products {
            step();
            let exponent = |factor: Number| {
                self.products[product]
                    .iter()
                    .find(|(known, _)| *known == factor)
                    .map_or(0, |(_, known)| *known)
            };
            let times = if a == b { exponent(a) / 2 } else { exponent(a).min(exponent(b)) };
            if times > 0 {
                self.leave(product, a, times);
                self.leave(product, b, times);
                self.enter(product, pair, times);
            }
        }
    }

    /// Puts the new pairs that occur twice in the queue.
    fn wait(&mut self) {
        for pair in self.fresh.drain(..) {
            let count = self.pairs[&pair].count;
            if count > 1 {
                let (a, b) = pair;
                let [(divides_a, depth_a), (divides_b, depth_b)] = [self.ranks[a], self.ranks[b]];
                let rank = (divides_a || divides_b, depth_a.max(depth_b), a, b);
                self.queue.push((count, Reverse(rank)));
            }
        }
    }

    /// The pair that occurs most often, if it does so twice.
    fn next(&mut self) -> Option<(Number, Number)> {
        loop {
            step();
            let (waiting, Reverse(rank)) = self.queue.pop()?;
            let pair = (rank.2, rank.3);
            let count = self.pairs[&pair].count;
            match count {
                _ if count == waiting => return Some(pair),
                0 | 1 => {}
                _ => self.queue.push((count, Reverse(rank))),
            }
        }
    }
}
