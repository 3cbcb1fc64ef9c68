//! Random values: everything but what concerns velocities as such.

use super::Generator;
use super::indices::Scope;
use crate::oracle_tests::formula::{Condition, Formula, Loops, Relation};
use crate::oracle_tests::functions::{BinaryFunction, OWN, SCALAR_FIELDS, UNARY, UnaryFunction};
use crate::oracle_tests::rotations::{COMPONENTS, ENTRIES};
use crate::oracle_tests::spinors::SPINOR;

const NUMBERS: [&str; 9] = ["2.0", "0.5", "3", "1.5", "0.25", "1", "4.0", "0.1", "2"];

impl Generator<'_> {
    pub(super) fn value(&mut self, scope: &Scope, depth: usize) -> Formula {
        self.budget = self.budget.saturating_sub(1);
        if depth == 0 || self.budget == 0 {
            return self.leaf(scope);
        }
        if self.random.chance(15)
            && let Some(again) = self.written_before(scope)
        {
            return again;
        }
        let value = self.new_value(scope, depth - 1);
        self.written.push(value.clone());
        value
    }

    /// Something that was written before and has a meaning here.
    fn written_before(&mut self, scope: &Scope) -> Option<Formula> {
        if self.written.is_empty() {
            return None;
        }
        let again = self.random.pick(&self.written).clone();
        let still = self.may_move || !again.has_velocities();
        (still && scope.admits_formula(&again, &self.system)).then_some(again)
    }

    fn new_value(&mut self, scope: &Scope, less: usize) -> Formula {
        if self.system.width > 0 && self.random.chance(30) {
            return self.of_vectors(scope, less);
        }
        match self.random.below(100) {
            0..=25 => self.sum(scope, less),
            26..=37 => {
                let (a, b) = (self.value(scope, less), self.value(scope, less));
                if self.random.chance(50) { a.plus(b) } else { a.minus(b) }
            }
            38..=50 => self.value(scope, less).times(self.value(scope, less)),
            51..=56 => {
                let (above, below) = (self.value(scope, less), self.value(scope, less));
                let below = self.positive(below);
                above.over(below)
            }
            57..=63 => {
                let exponent = *self.random.pick(&[2, 2, 2, 3, 4, 1, 5, -1, -2]);
                let base = self.value(scope, less);
                if exponent < 0 { self.positive(base).power(exponent) } else { base.power(exponent) }
            }
            64..=71 => {
                let of = self.value(scope, less);
                self.unary(of)
            }
            72..=74 => {
                let (a, b) = (self.value(scope, less), self.value(scope, less));
                self.binary(a, b)
            }
            75 => {
                let field = self.random.below(SCALAR_FIELDS.len());
                let at = (0..SCALAR_FIELDS[field].arity).map(|_| self.value(scope, less.min(2))).collect();
                Formula::ScalarField(field, at)
            }
            76..=77 => {
                let function = self.random.below(OWN.len());
                Formula::Own(function, Box::new(self.value(scope, less)))
            }
            78..=81 => {
                let (mut then, mut otherwise) = (self.value(scope, less), self.value(scope, less));
                let condition = self.condition(scope, less.min(2));
                match self.random.below(8) {
                    0 | 1 => {
                        let sum = self.sum(scope, less);
                        then = self.undefined(sum);
                    }
                    2 | 3 => {
                        let sum = self.sum(scope, less);
                        otherwise = self.undefined(sum);
                    }
                    4 => otherwise = self.undefined(otherwise),
                    _ => {}
                }
                Formula::If(Box::new(condition), Box::new(then), Box::new(otherwise))
            }
            82..=86 => {
                let value = self.value(scope, less);
                self.named(scope, value, |this, inside| this.value(inside, less))
            }
            87 => Formula::MultiplyAdd(
                Box::new(self.value(scope, less)),
                Box::new(self.value(scope, less)),
                Box::new(self.value(scope, less)),
            ),
            88..=89 => Formula::Negative(Box::new(self.value(scope, less))),
            90..=95 => {
                let (one, other) = (self.sum(scope, less), self.sum(scope, less));
                match self.random.below(4) {
                    0 => one.power(2),
                    1 => one.over(self.positive(other)),
                    _ => one.times(other),
                }
            }
            _ => self.leaf(scope),
        }
    }

    /// A sum: a form is linear in velocities.
    pub(super) fn any_sum(&mut self) -> Loops {
        *self.random.pick(&[Loops::Single, Loops::Single, Loops::Single, Loops::Pairs, Loops::OrderedPairs])
    }

    fn any_loops(&mut self) -> Loops {
        const MIX: [Loops; 7] = [
            Loops::Single,
            Loops::Single,
            Loops::Single,
            Loops::Product,
            Loops::Pairs,
            Loops::Pairs,
            Loops::OrderedPairs,
        ];
        *self.random.pick(&MIX)
    }

    fn sum(&mut self, scope: &Scope, depth: usize) -> Formula {
        if self.random.chance(15)
            && let Some(sum) = self.sum_in_packs(scope)
        {
            return sum;
        }
        let loops = self.any_loops();
        let sum = self.summed(scope, loops, |this, inside| this.value(inside, depth));
        sum.unwrap_or_else(|| self.value(scope, depth))
    }

    fn leaf(&mut self, scope: &Scope) -> Formula {
        match self.random.below(20) {
            0 => Formula::Number(self.random.pick::<&'static str>(&NUMBERS)),
            1 => Formula::Time,
            2..=5 => self.parameter(scope),
            6 if scope.level > 0 => Formula::Count(self.count(scope)),
            7 => Formula::Pi,
            8..=10 => match scope.name(self.random, false) {
                Some(name) => Formula::Name(name),
                None => self.coordinate(scope),
            },
            11..=13 if self.may_move => self.velocity(scope),
            _ => self.coordinate(scope),
        }
    }

    fn coordinate(&mut self, scope: &Scope) -> Formula {
        let mut block = self.random.below(self.system.blocks.len());
        if self.system.blocks[block].axis == Some([SPINOR - 1, SPINOR]) {
            // Of four coordinates there are three components.
            block -= 1;
        }
        let index = self.index_of(scope, block, ENTRIES);
        Formula::Coordinate(block, index)
    }

    pub(super) fn velocity(&mut self, scope: &Scope) -> Formula {
        // Areas have constant factors, and are among what makes Ω regular.
        let moving: Vec<usize> =
            (0..self.system.blocks.len()).filter(|block| self.system.has_velocity(*block)).collect();
        let block = *self.random.pick(&moving);
        let index = self.index_of(scope, block, COMPONENTS);
        Formula::Velocity(block, index)
    }

    pub(super) fn parameter(&mut self, scope: &Scope) -> Formula {
        let field = self.random.below(self.system.fields.len());
        let shape = self.system.fields[field].shape.clone();
        Formula::Parameter(field, shape.into_iter().map(|size| self.index(scope, size)).collect())
    }

    /// Mostly something that is positive wherever it is defined.
    pub(super) fn positive(&mut self, of: Formula) -> Formula {
        let one = || Formula::Number("1.5");
        match self.random.below(5) {
            0 | 1 => one().plus(of.power(2)),
            2 => one().plus(Formula::Unary(function("sin"), Box::new(of))),
            3 => Formula::Number("1").plus(of.clone().times(of)),
            _ => of,
        }
    }

    /// Something that is no number as a rule, in every term if it is a sum: for a branch, which need not be
    /// taken.
    fn undefined(&mut self, of: Formula) -> Formula {
        let name = *self.random.pick(&["sqrt", "ln"]);
        let nowhere =
            |of: Formula| Formula::Unary(function(name), Box::new(of.minus(Formula::Number("900"))));
        match of {
            Formula::Sum(loops, level, lower, upper, body) => {
                Formula::Sum(loops, level, lower, upper, Box::new(nowhere(*body)))
            }
            other => nowhere(other),
        }
    }

    fn unary(&mut self, of: Formula) -> Formula {
        let function_of = *self.random.pick(UNARY);
        let of = match function_of.name {
            "sqrt" | "ln" | "log2" | "log10" | "acosh" | "ln_1p" | "recip" | "cbrt" => self.positive(of),
            "asin" | "acos" | "atanh" if self.random.chance(75) => {
                Formula::Number("0.8").times(Formula::Unary(function("sin"), Box::new(of)))
            }
            "exp" | "exp2" | "exp_m1" | "sinh" | "cosh" | "tanh" if self.random.chance(60) => {
                of.over(Formula::Number("4.0"))
            }
            _ => of,
        };
        Formula::Unary(function_of, Box::new(of))
    }

    fn binary(&mut self, a: Formula, b: Formula) -> Formula {
        match self.random.below(3) {
            0 => {
                let b = self.positive(b);
                Formula::Binary(BinaryFunction::Atan2, Box::new(a), Box::new(b))
            }
            1 => {
                let function =
                    *self.random.pick(&[BinaryFunction::Hypot, BinaryFunction::Min, BinaryFunction::Max]);
                Formula::Binary(function, Box::new(a), Box::new(b))
            }
            _ => {
                let base = self.positive(a);
                let exponent = if self.random.chance(70) {
                    Formula::Number(self.random.pick::<&'static str>(&["0.5", "1.5", "2.5", "3.0", "2"]))
                } else {
                    b
                };
                Formula::Binary(BinaryFunction::Powf, Box::new(base), Box::new(exponent))
            }
        }
    }

    /// A condition on coordinates, parameters and time.
    pub(super) fn condition(&mut self, scope: &Scope, depth: usize) -> Condition {
        if depth > 0 && self.random.chance(30) {
            let (one, other) = (self.condition(scope, depth - 1), self.condition(scope, depth - 1));
            return match self.random.below(3) {
                0 => Condition::And(Box::new(one), Box::new(other)),
                1 => Condition::Or(Box::new(one), Box::new(other)),
                _ => Condition::Not(Box::new(one)),
            };
        }
        let relations = [Relation::Less, Relation::LessOrEqual, Relation::Greater, Relation::GreaterOrEqual];
        let relation = *self.random.pick(&relations);
        let (left, right) = (self.value(scope, 1.min(depth)), self.leaf(scope));
        Condition::Compare(left, relation, right)
    }
}

fn function(name: &str) -> UnaryFunction {
    *UNARY.iter().find(|function| function.name == name).expect("a function of the table")
}
