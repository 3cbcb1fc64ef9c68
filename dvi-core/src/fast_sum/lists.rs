//! Which cubes act on which as wholes, and which bodies one by one.

use alloc::vec::Vec;

use super::transfer::{number, offsets, touch};
use super::tree::{Cube, Tree};

/// One cube acts on another of its level.
#[derive(Clone, Copy, Debug)]
pub(super) struct Far {
    pub(super) target: u32,
    pub(super) source: u32,
}

/// All pairs of bodies, each once in each order.
#[derive(Clone, Debug, Default)]
pub(super) struct Lists {
    /// For each level and offset: the cubes that act on others as wholes.
    pub(super) far: Vec<Vec<Far>>,
    /// Cubes whose bodies act one by one: target and source.
    pub(super) near: Vec<(u32, u32)>,
    stack: Vec<(u32, u32)>,
}

impl Lists {
    /// Fills the lists; pairs of cubes with no more than `few` pairs of bodies count as near.
    pub(super) fn fill<const D: usize>(&mut self, tree: &Tree<D>, few: usize) {
        let per_level = offsets::<D>();
        let levels = tree.cubes.last().map_or(0, |last| last.level as usize + 1);
        self.far.iter_mut().for_each(Vec::clear);
        if self.far.len() < levels * per_level {
            self.far.resize(levels * per_level, Vec::new());
        }
        self.near.clear();
        self.stack.clear();
        self.stack.extend((!tree.cubes.is_empty()).then_some((0, 0)));
        while let Some((target, source)) = self.stack.pop() {
            let [one, other] = [target, source].map(|cube| &tree.cubes[cube as usize]);
            if !(one.is_divided() && other.is_divided()) {
                self.near.push((target, source));
                continue;
            }
            for target in one.parts() {
                for source in other.parts() {
                    let [one, other] = [target, source].map(|cube| &tree.cubes[cube]);
                    let pair = (target as u32, source as u32);
                    let offset = one.offset(other);
                    if touch(offset) {
                        self.stack.push(pair);
                    } else if pairs(one, other) > few {
                        let list = &mut self.far[one.level as usize * per_level + number(offset)];
                        list.push(Far { target: pair.0, source: pair.1 });
                    } else {
                        self.near.push(pair);
                    }
                }
            }
        }
        self.near.sort_unstable();
    }
}

fn pairs<const D: usize>(one: &Cube<D>, other: &Cube<D>) -> usize {
    one.bodies().len() * other.bodies().len()
}
