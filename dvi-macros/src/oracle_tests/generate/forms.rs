//! What concerns velocities: one-forms, affine Lagrangians, kinetic energies.

use super::Generator;
use super::indices::Scope;
use crate::oracle_tests::formula::{Atom, Formula, Index, Loops};

impl Generator<'_> {
    /// Something linear in the velocities.
    pub(super) fn form(&mut self, scope: &Scope, depth: usize) -> Formula {
        if depth == 0 || self.budget == 0 {
            return self.value(scope, 1).times(self.velocity(scope));
        }
        self.budget -= 1;
        let less = depth - 1;
        if self.system.width > 0
            && self.random.chance(20)
            && let Some(velocity) = self.vector_velocity(scope)
        {
            return self.vector(scope, less.min(2)).dot(velocity);
        }
        match self.random.below(12) {
            0..=4 => {
                let loops = self.any_sum();
                let sum = self.summed(scope, loops, |this, inside| this.form(inside, less));
                sum.unwrap_or_else(|| self.form(scope, less))
            }
            5 => self.form(scope, less).plus(self.form(scope, less)),
            6 => self.form(scope, less).minus(self.form(scope, less)),
            7 => self.value(scope, less.min(2)).times(self.form(scope, less)),
            8 => {
                let form = self.form(scope, less);
                let below = self.value(scope, less.min(2));
                form.over(self.positive(below))
            }
            9 => {
                let (then, otherwise) = (self.form(scope, less), self.form(scope, less));
                Formula::If(Box::new(self.condition(scope, 1)), Box::new(then), Box::new(otherwise))
            }
            10 => {
                let value = self.value(scope, less);
                self.named(scope, value, |this, inside| this.form(inside, less))
            }
            _ => self.value(scope, less.min(2)).times(self.velocity(scope)),
        }
    }

    /// Something affine in the velocities.
    pub(super) fn affine(&mut self, scope: &Scope, depth: usize) -> Formula {
        if depth > 2 && self.random.chance(50) {
            let loops = self.any_sum();
            if let Some((lower, upper, inside)) = self.loops(scope, loops) {
                let body = self.affine(&inside, depth - 1);
                return Formula::Sum(loops, scope.level, lower, upper, Box::new(body));
            }
        }
        let (value, form) = (self.value(scope, depth.min(4)), self.form(scope, depth.min(3)));
        match self.random.below(4) {
            0 => form.minus(value),
            1 => value.plus(form),
            2 => self.value(scope, 1).times(form.plus(value)),
            _ => form.plus(value),
        }
    }

    /// The form, most often with one added that makes Ω regular.
    pub(super) fn with_base(&mut self, form: Formula) -> Formula {
        if self.random.chance(4) {
            return form;
        }
        let blocks = self.system.blocks.len();
        let pairs = (0..blocks / 2).map(|pair| (2 * pair, 2 * pair + 1));
        let pairs: Vec<(usize, usize)> = pairs
            .filter(|(x, y)| self.system.blocks[*x].size == self.system.blocks[*y].size)
            .filter(|(x, _)| !self.system.is_spinor(*x))
            .collect();
        let form = pairs.into_iter().fold(form, |form, (x, y)| form.plus(self.conjugate(x, y)));
        let mut spinors = self.system.coordinates();
        spinors.retain(|first| self.system.is_spinor(*first));
        spinors.into_iter().fold(form, |form, first| form.plus(self.area(first)))
    }

    /// A function of the coordinates, most often with c Σ xⱼ yⱼ in it, which may cancel in the one-form.
    pub(super) fn gauge(&mut self) -> Formula {
        self.budget = self.budget.max(8);
        self.may_move = false;
        let value = self.value(&Scope::outside(), 5);
        let (x, y) = (0, 1);
        if self.system.blocks[x].size != self.system.blocks[y].size || self.random.chance(20) {
            return value;
        }
        let size = self.system.blocks[x].size;
        let entry = |block| Formula::Coordinate(block, size.map(|_| Index::bound(0)));
        let product = self.over(size, entry(x).times(entry(y)));
        let product = match self.random.below(3) {
            0 => product,
            1 => Formula::Number("0.5").times(product),
            _ => Formula::Negative(Box::new(product)),
        };
        let product = if self.random.chance(30) { Formula::Time.times(product) } else { product };
        if self.random.chance(30) { product } else { product.plus(value) }
    }

    /// The areas of unit vectors, with a factor or without.
    fn area(&mut self, first: usize) -> Formula {
        let size = self.system.blocks[first].size;
        let scope = self.entries(size);
        let term = Formula::Velocity(first, size.map(|_| Index::bound(0)));
        let term = if self.random.chance(60) { self.parameter(&scope).times(term) } else { term };
        self.over(size, term)
    }

    /// Σ xⱼ dyⱼ, with a factor or without.
    fn conjugate(&mut self, x: usize, y: usize) -> Formula {
        let size = self.system.blocks[x].size;
        let scope = self.entries(size);
        let index = size.map(|_| Index::bound(0));
        let term = Formula::Coordinate(x, index.clone()).times(Formula::Velocity(y, index));
        let term = if self.random.chance(40) { self.parameter(&scope).times(term) } else { term };
        self.over(size, term)
    }

    /// ½ m v² for each velocity.
    pub(super) fn kinetic(&mut self) -> Formula {
        let coordinates = self.system.coordinates();
        let terms = coordinates.into_iter().flat_map(|first| self.kinetic_along(first)).collect::<Vec<_>>();
        terms.into_iter().reduce(Formula::plus).expect("a system has coordinates")
    }

    /// That of all components of a coordinate, one by one or of the vector.
    fn kinetic_along(&mut self, first: usize) -> Vec<Formula> {
        let axes = self.system.axes(first);
        let is_single_rotation = self.system.is_rotation(first) && axes == 1;
        if !is_single_rotation && (axes == 1 || self.random.chance(30)) {
            let blocks = (first..first + axes).filter(|block| self.system.has_velocity(*block));
            return blocks.collect::<Vec<_>>().into_iter().map(|block| self.kinetic_of(block)).collect();
        }
        let size = self.system.blocks[first].size.filter(|_| !is_single_rotation);
        let velocity = Formula::VectorVelocity(first, size.map(|_| Index::bound(0)));
        let square = Formula::NormSquared(Box::new(velocity)).over(Formula::Number("2.0"));
        vec![self.over(size, square)]
    }

    /// A function with velocities in it.
    pub(super) fn dissipation(&mut self) -> Formula {
        self.budget = 8;
        self.may_move = true;
        let (scope, value) = (Scope::outside(), self.value(&Scope::outside(), 4));
        match self.random.below(3) {
            0 => value.times(self.velocity(&scope)),
            _ => self.kinetic().plus(value),
        }
    }

    fn kinetic_of(&mut self, block: usize) -> Formula {
        let size = self.system.blocks[block].size;
        let scope = self.entries(size);
        let velocity = Formula::Velocity(block, size.map(|_| Index::bound(0)));
        let square = velocity.power(2).over(Formula::Number("2.0"));
        let term = match self.random.below(4) {
            0 => self.parameter(&scope).times(square),
            1 => {
                let before = std::mem::replace(&mut self.may_move, false);
                let mass = self.value(&scope, 2);
                self.may_move = before;
                self.positive(mass).times(square)
            }
            _ => square,
        };
        self.over(size, term)
    }

    /// Where the entries of an array of that size stand.
    fn entries(&self, size: Option<usize>) -> Scope {
        let outside = Scope::outside();
        size.map_or(outside.clone(), |size| outside.over(0..self.system.sizes[size].value))
    }

    fn over(&self, size: Option<usize>, term: Formula) -> Formula {
        match size {
            Some(size) => {
                let upper = Index::atom(Atom::Size(size));
                Formula::Sum(Loops::Single, 0, Index::literal(0), upper, Box::new(term))
            }
            None => term,
        }
    }
}
