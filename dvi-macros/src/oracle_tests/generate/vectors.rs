//! Random vectors, and numbers that are made of them.

use super::Generator;
use super::indices::Scope;
use crate::oracle_tests::formula::{Formula, Index};
use crate::oracle_tests::rotations::COMPONENTS;
use crate::oracle_tests::system::{Container, System};

impl Generator<'_> {
    pub(super) fn vector(&mut self, scope: &Scope, depth: usize) -> Formula {
        self.budget = self.budget.saturating_sub(1);
        if depth == 0 || self.budget == 0 {
            return self.vector_leaf(scope);
        }
        let less = depth - 1;
        match self.random.below(16) {
            0..=1 => self.vector(scope, less).plus(self.vector(scope, less)),
            2..=3 => self.vector(scope, less).minus(self.vector(scope, less)),
            4 => Formula::Negative(Box::new(self.vector(scope, less))),
            5 => self.value(scope, less).times(self.vector(scope, less)),
            6 => self.vector(scope, less).times(self.value(scope, less)),
            7 => {
                let (above, below) = (self.vector(scope, less), self.value(scope, less));
                let below = self.positive(below);
                above.over(below)
            }
            8 | 13 if self.system.width == 3 => {
                Formula::Cross(Box::new(self.vector(scope, less)), Box::new(self.vector(scope, less)))
            }
            9 => Formula::List((0..self.system.width).map(|_| self.value(scope, less.min(1))).collect()),
            10 => {
                let (then, otherwise) = (self.vector(scope, less), self.vector(scope, less));
                let condition = self.condition(scope, less.min(1));
                Formula::If(Box::new(condition), Box::new(then), Box::new(otherwise))
            }
            11 => {
                let value = self.any(scope, less);
                self.named(scope, value, |this, inside| this.vector(inside, less))
            }
            12 => {
                let loops = self.any_sum();
                let sum = self.summed(scope, loops, |this, inside| this.vector(inside, less));
                sum.unwrap_or_else(|| self.vector_leaf(scope))
            }
            _ => self.vector_leaf(scope),
        }
    }

    /// A number that is made of vectors.
    pub(super) fn of_vectors(&mut self, scope: &Scope, less: usize) -> Formula {
        match self.random.below(8) {
            0..=1 => self.vector(scope, less).dot(self.vector(scope, less)),
            2..=3 => Formula::NormSquared(Box::new(self.vector(scope, less))),
            4..=5 => Formula::Norm(Box::new(self.vector(scope, less))),
            6 => {
                let number = self.random.below(self.system.width);
                Formula::Component(Box::new(self.vector(scope, less)), number)
            }
            _ => {
                let value = self.vector(scope, less);
                self.named(scope, value, |this, inside| this.value(inside, less))
            }
        }
    }

    fn any(&mut self, scope: &Scope, depth: usize) -> Formula {
        if self.random.chance(50) { self.vector(scope, depth) } else { self.value(scope, depth) }
    }

    fn vector_leaf(&mut self, scope: &Scope) -> Formula {
        let leaf = match self.random.below(8) {
            0 => self.vector_parameter(scope),
            1..=2 => scope.name(self.random, true).map(Formula::VectorName),
            3 if self.may_move => self.vector_velocity(scope),
            _ => None,
        };
        let leaf = leaf.or_else(|| self.vector_coordinate(scope));
        leaf.unwrap_or_else(|| Formula::List((0..self.system.width).map(|_| self.value(scope, 0)).collect()))
    }

    /// All of a coordinate, or a column of it.
    fn vector_coordinate(&mut self, scope: &Scope) -> Option<Formula> {
        Some(match self.vector_of(scope, Formula::Vector, |_, _| true)? {
            Formula::Vector(first, index) if self.system.is_rotation(first) => {
                Formula::Column(first, index, self.random.below(COMPONENTS))
            }
            vector => vector,
        })
    }

    /// Its velocity, which no unit vector has.
    pub(super) fn vector_velocity(&mut self, scope: &Scope) -> Option<Formula> {
        self.vector_of(scope, Formula::VectorVelocity, |system, first| !system.is_spinor(first))
    }

    fn vector_of(
        &mut self,
        scope: &Scope,
        of: fn(usize, Option<Index>) -> Formula,
        counts: fn(&System, usize) -> bool,
    ) -> Option<Formula> {
        let coordinates = self.system.coordinates().into_iter();
        let vectors: Vec<usize> = coordinates
            .filter(|first| {
                let is_single = self.system.is_whole(*first) || self.system.is_single_factor(*first);
                is_single || self.system.axes(*first) > 1
            })
            .filter(|first| counts(&self.system, *first))
            .collect();
        if vectors.is_empty() {
            return None;
        }
        let first = *self.random.pick(&vectors);
        let size = self.system.blocks[first].size.filter(|_| self.system.axes(first) > 1);
        Some(of(first, size.map(|size| self.index(scope, size))))
    }

    fn vector_parameter(&mut self, scope: &Scope) -> Option<Formula> {
        let is_vector = |field: &usize| {
            let field = &self.system.fields[*field];
            let is_array =
                matches!(field.container, Container::Array | Container::Matrix | Container::VectorOfArrays);
            is_array && field.shape.last().is_some_and(|size| self.system.is_width(*size))
        };
        let fields: Vec<usize> = (0..self.system.fields.len()).filter(is_vector).collect();
        if fields.is_empty() {
            return None;
        }
        let field = *self.random.pick(&fields);
        let mut outer = self.system.fields[field].shape.clone();
        outer.pop();
        let indices = outer.into_iter().map(|size| self.index(scope, size)).collect();
        Some(Formula::VectorParameter(field, indices))
    }
}
