//! Which cubes act on which as wholes, and which bodies one by one.

use alloc::vec::Vec;
use core::ops::Range;

use super::packs::LANES;
use super::transfer::{number, offsets, touch};
use super::tree::{Cube, Tree};

/// One cube acts on another of its level.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Pair {
    pub(super) target: u32,
    pub(super) source: u32,
}

/// All pairs of bodies, each once in each order.
#[derive(Clone, Debug, Default)]
pub(super) struct Lists {
    /// For each level and offset: the cubes that act on others as wholes, in the order of the targets.
    pub(super) far: Vec<Vec<Pair>>,
    /// Cubes whose bodies act one by one, in the order of the targets.
    pub(super) near: Vec<Pair>,
    /// For each of these pairs, the packs that the sources of the earlier ones fill, if they come after
    /// their targets; and at the end those of all.
    pub(super) packs: Vec<usize>,
    /// Where the pair stands that has target and source exchanged.
    pub(super) opposite: Vec<usize>,
    /// Where the near pairs of each cube begin, and where those of the last one end.
    firsts: Vec<usize>,
    queue: Vec<Pair>,
}

impl Lists {
    /// Fills the lists; pairs of cubes with no more than `few` pairs of bodies count as near.
    pub(super) fn fill<const D: usize>(&mut self, tree: &Tree<D>, few: usize) {
        let Self { far, near, queue, .. } = self;
        let per_level = offsets::<D>();
        far.iter_mut().for_each(Vec::clear);
        if far.len() < tree.levels.len() * per_level {
            far.resize(tree.levels.len() * per_level, Vec::new());
        }
        near.clear();
        queue.clear();
        queue.extend((!tree.cubes.is_empty()).then_some(Pair { target: 0, source: 0 }));
        let cubes = |pair: Pair| [pair.target, pair.source].map(|cube| &tree.cubes[cube as usize]);
        let mut next = 0;
        while next < queue.len() {
            let target = queue[next].target;
            let past = next + queue[next..].iter().take_while(|pair| pair.target == target).count();
            let are_wholes = |pair: Pair| {
                let [one, other] = cubes(pair);
                one.is_divided() && other.is_divided() && touch(one.offset(other))
            };
            near.extend(queue[next..past].iter().filter(|pair| !are_wholes(**pair)));
            for part in tree.cubes[target as usize].parts() {
                for place in next..past {
                    if !are_wholes(queue[place]) {
                        continue;
                    }
                    for source in tree.cubes[queue[place].source as usize].parts() {
                        let pair = Pair { target: part as u32, source: source as u32 };
                        let [one, other] = cubes(pair);
                        let offset = one.offset(other);
                        if touch(offset) || pairs(one, other) <= few {
                            queue.push(pair);
                        } else {
                            far[one.level as usize * per_level + number(offset)].push(pair);
                        }
                    }
                }
            }
            next = past;
        }
    }

    /// Counts the pairs of cubes of one level as near.
    pub(super) fn approach<const D: usize>(&mut self, level: usize) {
        let lists = level * offsets::<D>()..(level + 1) * offsets::<D>();
        for list in &mut self.far[lists] {
            self.near.append(list);
        }
        self.near.sort_unstable();
    }

    /// Finds what depends on both orders of a pair.
    pub(super) fn oppose<const D: usize>(&mut self, tree: &Tree<D>) {
        let Self { near, packs, opposite, firsts, .. } = self;
        firsts.clear();
        for (number, pair) in near.iter().enumerate() {
            firsts.resize(firsts.len().max(pair.target as usize + 1), number);
        }
        firsts.resize(tree.cubes.len() + 1, near.len());
        packs.clear();
        opposite.clear();
        let mut before = 0;
        for Pair { target, source } in near.iter().copied() {
            packs.push(before);
            if source > target {
                before += tree.cubes[source as usize].bodies().len().div_ceil(LANES);
            }
            let first = firsts[source as usize];
            let of_source = &near[first..firsts[source as usize + 1]];
            // In the order of their sources.
            opposite.push(first + of_source.partition_point(|pair| pair.source < target));
        }
        packs.push(before);
    }

    /// The packs that the sources of the near pairs of earlier cubes fill.
    pub(super) fn packs_before(&self, cube: usize) -> usize {
        self.packs[self.firsts[cube]]
    }
}

/// Those of a list whose targets are in a range.
pub(super) fn on(list: &[Pair], targets: &Range<usize>) -> Range<usize> {
    let place = |end: usize| list.partition_point(|pair| (pair.target as usize) < end);
    place(targets.start)..place(targets.end)
}

/// How many ordered pairs of bodies there are between two cubes.
pub(super) fn pairs<const D: usize>(one: &Cube<D>, other: &Cube<D>) -> usize {
    one.bodies().len() * other.bodies().len()
}
