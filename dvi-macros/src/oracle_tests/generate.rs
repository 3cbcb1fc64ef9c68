//! Random systems in the whole language.
//!
//! Indices are drawn so that they stay in range: the scope knows all values that the bound indices take
//! together.

mod declarations;
mod forms;
mod indices;
mod values;
mod vectors;

use super::formula::{Formula, Index, Loops};
use super::random::Random;
use super::system::{Constraint, Dynamics, Gauge, System};
use crate::syntax::Constrained;
use indices::Scope;

struct Generator<'a> {
    random: &'a mut Random,
    system: System,
    /// Whether velocities may stand in a formula.
    may_move: bool,
    /// The number of nodes that may still be written.
    budget: usize,
    /// What was written before, to be written again: the same parts in several places are what a
    /// compiler shares.
    written: Vec<Formula>,
}

/// A system, degenerate or regular.
pub(super) fn system(random: &mut Random) -> System {
    let regular = random.chance(40);
    let system = declarations::declarations(random, regular);
    let budget = 10 + random.below(30);
    let mut generator = Generator { random, system, may_move: false, budget, written: Vec::new() };
    let dynamics = if regular { generator.regular() } else { generator.degenerate() };
    generator.system.dynamics = dynamics;
    if !regular && !generator.system.has_spinors() && generator.random.chance(40) {
        generator.system.gauge = match generator.random.below(3) {
            0 => Gauge::Auto,
            _ => Gauge::Formula(generator.gauge()),
        };
    }
    for _ in 0..generator.random.below(3) {
        generator.budget = 8;
        generator.may_move = regular;
        let momentum = generator.value(&Scope::outside(), 3);
        generator.system.momenta.push(momentum);
    }
    if generator.system.is_on_manifold() {
        // Such systems have neither constraints nor forces.
        return generator.system;
    }
    if regular && generator.random.chance(40) {
        generator.system.constrained = match generator.random.below(3) {
            0 => Constrained::Velocities,
            1 => Constrained::Gaps,
            _ => Constrained::Positions,
        };
        generator.may_move = false;
        generator.system.constraints = generator.constraints();
    }
    if regular && generator.random.chance(30) {
        generator.system.dissipation = Some(generator.dissipation());
    }
    if generator.random.chance(30) {
        generator.may_move = regular;
        generator.system.forces = generator.forces();
        return generator.system;
    }
    if !regular && generator.random.chance(25) {
        generator.budget = 8;
        let rate = generator.value(&Scope::outside(), 3);
        let rate = generator.positive(rate);
        return generator.system.with_time_transform(rate);
    }
    generator.system
}

impl Generator<'_> {
    fn degenerate(&mut self) -> Dynamics {
        let scope = Scope::outside();
        match self.random.below(10) {
            // Components are of numbers.
            5..=6 if !self.system.has_spinors() => {
                let hamiltonian = self.value(&scope, 6);
                let coordinates = self.system.coordinates();
                let components = coordinates.into_iter().map(|first| self.component(first));
                Dynamics::Components(components.collect(), hamiltonian)
            }
            0..=6 => {
                let hamiltonian = self.value(&scope, 6);
                self.budget = self.budget.max(6);
                let one_form = self.form(&scope, 4);
                Dynamics::OneForm(self.with_base(one_form), hamiltonian)
            }
            _ => {
                let lagrangian = self.affine(&scope, 6);
                Dynamics::Affine(self.with_base(lagrangian))
            }
        }
    }

    fn component(&mut self, first: usize) -> Formula {
        let value = self.entry(first);
        // Blocks come in pairs: yⱼ stands in the component of xⱼ.
        let index = self.system.blocks[first].size.map(|_| Index::bound(0));
        let conjugate = |block: usize| match block.is_multiple_of(2) {
            true => Formula::Coordinate(block + 1, index.clone()),
            false => Formula::Number("0"),
        };
        match self.system.axes(first) {
            1 if value.is_vector() => match first.is_multiple_of(2) {
                true => Formula::Vector(first + 1, None).plus(value),
                false => value,
            },
            1 if !first.is_multiple_of(2) => value,
            1 => conjugate(first).plus(value),
            axes => Formula::List((first..first + axes).map(conjugate).collect()).plus(value),
        }
    }

    /// A function for each entry of a block.
    fn entry(&mut self, block: usize) -> Formula {
        self.budget = self.budget.max(4);
        let is_vector = self.system.axes(block) > 1;
        if !is_vector && self.system.is_whole(block) && self.random.chance(50) {
            return self.vector(&Scope::outside(), 3);
        }
        let scope = match self.system.blocks[block].size {
            Some(size) => Scope::outside().over(0..self.system.sizes[size].value),
            None => Scope::outside(),
        };
        if is_vector { self.vector(&scope, 3) } else { self.value(&scope, 3) }
    }

    /// Forces on all blocks, or on some in any order.
    fn forces(&mut self) -> Vec<(usize, Formula)> {
        let mut coordinates = self.system.coordinates();
        coordinates.retain(|first| !self.system.is_spinor(*first));
        if self.random.chance(50) {
            return coordinates.into_iter().map(|first| (first, self.entry(first))).collect();
        }
        let acts = coordinates.into_iter().rev().filter(|_| self.random.chance(60)).collect::<Vec<_>>();
        acts.into_iter().map(|block| (block, self.entry(block))).collect()
    }

    fn constraints(&mut self) -> Vec<Constraint> {
        let count = 1 + self.random.below(3);
        (0..count).map(|_| self.constraint()).collect()
    }

    /// A function with a coordinate in it, or affine with a velocity in it, alone or with an index that it
    /// depends on.
    fn constraint(&mut self) -> Constraint {
        self.budget = self.budget.max(6);
        let (mut ranges, mut scope) = (Vec::new(), Scope::outside());
        for chance in [80, 80] {
            if self.random.chance(chance)
                && let Some((lower, upper, inside)) = self.loops(&scope, Loops::Single)
            {
                ranges.push((lower, upper));
                scope = inside;
            } else {
                break;
            }
        }
        let block = self.random.below(self.system.blocks.len());
        let index = self.system.blocks[block].size.map(|size| self.index(&scope, size));
        let variable = match self.system.constrained {
            Constrained::Positions | Constrained::Gaps => Formula::Coordinate(block, index),
            Constrained::Velocities => Formula::Velocity(block, index),
        };
        let variable = (0..ranges.len())
            .fold(variable, |variable, level| variable.times(Formula::Count(Index::bound(level).plus(3))));
        let is_sum = self.random.chance(70);
        let value = match self.system.constrained {
            Constrained::Velocities if is_sum => self.affine(&scope, 4),
            Constrained::Positions | Constrained::Velocities | Constrained::Gaps => self.value(&scope, 4),
        };
        let formula = if is_sum { value.plus(variable) } else { variable.times(value) };
        Constraint { ranges, formula }
    }

    fn regular(&mut self) -> Dynamics {
        let scope = Scope::outside();
        self.may_move = true;
        let value = self.value(&scope, 6);
        Dynamics::Regular(if self.random.chance(95) { self.kinetic().plus(value) } else { value })
    }
}
