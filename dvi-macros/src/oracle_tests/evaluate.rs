//! The oracle: formulas evaluated on jets, as they are written.

use super::formula::{Condition, Formula, Index, Loops, Relation};
use super::functions::{BinaryFunction, own, scalar_field};
use super::jet::{Jet, Sized};
use super::rate;
use super::system::{Constraint, Dynamics, Gauge, System};

/// Where a formula is evaluated.
#[derive(Clone, Debug)]
pub(super) struct Point {
    pub(super) q: Vec<f64>,
    pub(super) v: Vec<f64>,
    pub(super) t: f64,
}

/// Why there is no value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Outside {
    /// The point is outside of the domain of a function, or too near to its border.
    Domain,
    /// An index leaves its array, or no sum binds it: the formula has no meaning at any point.
    Index,
}

pub(super) struct Oracle<'a> {
    pub(super) system: &'a System,
    sizes: Vec<i64>,
    pub(super) point: &'a Point,
    bound: Vec<i64>,
    names: Vec<(usize, Vec<Jet>)>,
    /// At whose zeros what has been evaluated is not smooth, outside of sums.
    pub(super) seams: Vec<Jet>,
}

/// The only component of what is no vector.
fn single(values: Vec<Jet>) -> Result<Jet, Outside> {
    <[Jet; 1]>::try_from(values).map(|[value]| value).map_err(|_| Outside::Index)
}

/// An operation on two vectors, component by component, or on a vector and a number.
fn together(a: &[Jet], b: &[Jet], operation: fn(&Jet, &Jet) -> Jet) -> Vec<Jet> {
    match (a, b) {
        ([a], several) => several.iter().map(|b| operation(a, b)).collect(),
        (several, [b]) => several.iter().map(|a| operation(a, b)).collect(),
        (a, b) => a.iter().zip(b).map(|(a, b)| operation(a, b)).collect(),
    }
}

pub(super) fn minus(a: &Jet, b: &Jet) -> Jet {
    a.plus(&b.scaled(-1.0))
}

/// Conditions that are nearer to equality than this decide nothing.
const NEAR: f64 = 1e-6;

impl<'a> Oracle<'a> {
    pub(super) fn new(system: &'a System, point: &'a Point) -> Self {
        Self {
            system,
            sizes: system.size_values(),
            point,
            bound: Vec::new(),
            names: Vec::new(),
            seams: Vec::new(),
        }
    }

    /// The number of variables of a jet: q, v and t.
    pub(super) fn variables(&self) -> usize {
        2 * self.system.dimension() + 1
    }

    /// L with dF/dt of a gauge F.
    pub(super) fn lagrangian(&mut self) -> Result<Jet, Outside> {
        let declared = match &self.system.time_transform {
            Some(rate) => self.extended(rate)?,
            None => self.declared()?,
        };
        match &self.system.gauge {
            Gauge::Formula(gauge) => Ok(declared.plus(&rate::rate(self.system, gauge, self.point)?)),
            Gauge::None | Gauge::Auto => Ok(declared),
        }
    }

    /// α·v − e t' − ρ (H − e)
    fn extended(&mut self, rate: &Formula) -> Result<Jet, Outside> {
        let system = self.system;
        let Some([time, energy]) = system.extended() else { panic!("the time is transformed") };
        let (form, hamiltonian) = match &system.dynamics {
            Dynamics::OneForm(_, hamiltonian) | Dynamics::Components(_, hamiltonian) => {
                let hamiltonian = self.value(hamiltonian)?;
                (self.declared()?.plus(&hamiltonian), hamiltonian)
            }
            Dynamics::Affine(_) | Dynamics::Regular(_) => {
                let hamiltonian = self.at_rest()?.scaled(-1.0);
                (self.declared()?.plus(&hamiltonian), hamiltonian)
            }
        };
        let variable = |place: usize, value: f64| Jet::variable(value, place, self.variables());
        let energy = variable(energy, self.point.q[energy]);
        let velocity = variable(system.dimension() + time, self.point.v[time]);
        let difference = hamiltonian.plus(&energy.scaled(-1.0));
        let work = self.value(rate)?.times(&difference);
        Ok(form.plus(&energy.times(&velocity).scaled(-1.0)).plus(&work.scaled(-1.0)))
    }

    /// L at v = 0, as a function of q and t.
    fn at_rest(&self) -> Result<Jet, Outside> {
        let (n, point) = (self.system.dimension(), self.point);
        let still = Point { q: point.q.clone(), v: vec![0.0; n], t: point.t };
        let value = Oracle::new(self.system, &still).declared()?;
        let is_position = |i: usize| i < n || i == 2 * n;
        let only = |holds: bool, entry: Sized| if holds { entry } else { Sized::default() };
        Ok(Jet::from_derivatives(
            value.value,
            self.variables(),
            |i| only(is_position(i), value.gradient(i)),
            |i, j| only(is_position(i) && is_position(j), value.hessian(i, j)),
        ))
    }

    /// α·v − H, or L itself.
    fn declared(&mut self) -> Result<Jet, Outside> {
        let system = self.system;
        match &system.dynamics {
            Dynamics::Affine(lagrangian) | Dynamics::Regular(lagrangian) => self.value(lagrangian),
            Dynamics::OneForm(one_form, hamiltonian) => {
                Ok(self.value(one_form)?.plus(&self.value(hamiltonian)?.scaled(-1.0)))
            }
            Dynamics::Components(components, hamiltonian) => {
                let mut sum = self.value(hamiltonian)?.scaled(-1.0);
                for (first, component) in system.coordinates().into_iter().zip(components) {
                    sum = sum.plus(&self.value(&system.component_term(first, component))?);
                }
                Ok(sum)
            }
        }
    }

    pub(super) fn value(&mut self, formula: &Formula) -> Result<Jet, Outside> {
        single(self.values(formula)?)
    }

    /// The components of a formula, one if it is a number.
    pub(super) fn values(&mut self, formula: &Formula) -> Result<Vec<Jet>, Outside> {
        let values = self.evaluate(formula)?;
        if values.iter().all(Jet::is_moderate) { Ok(values) } else { Err(Outside::Domain) }
    }

    fn evaluate(&mut self, formula: &Formula) -> Result<Vec<Jet>, Outside> {
        let number = match formula {
            Formula::Number(text) => Jet::constant(text.parse().expect("a number")),
            Formula::Pi => Jet::constant(std::f64::consts::PI),
            Formula::Time => {
                let variables = self.variables();
                match self.system.extended() {
                    Some([time, _]) => Jet::variable(self.point.q[time], time, variables),
                    None => Jet::variable(self.point.t, variables - 1, variables),
                }
            }
            Formula::Name(name) | Formula::VectorName(name) => {
                let known = self.names.iter().rev().find(|(known, _)| known == name);
                return Ok(known.ok_or(Outside::Index)?.1.clone());
            }
            Formula::Coordinate(block, _) | Formula::Velocity(block, _) if self.system.is_spinor(*block) => {
                self.of_spinor(formula)?
            }
            Formula::Coordinate(block, index) => self.variable(*block, index.as_ref(), false)?,
            Formula::Velocity(block, index) => self.variable(*block, index.as_ref(), true)?,
            Formula::Parameter(field, indices) => Jet::constant(self.parameter(*field, indices)?),
            Formula::Count(index) => Jet::constant(self.index(index)? as f64),
            Formula::Negative(of) => {
                return Ok(self.values(of)?.iter().map(|part| part.scaled(-1.0)).collect());
            }
            Formula::Add(a, b) => return Ok(together(&self.values(a)?, &self.values(b)?, Jet::plus)),
            Formula::Subtract(a, b) => return Ok(together(&self.values(a)?, &self.values(b)?, minus)),
            Formula::Multiply(a, b) => return Ok(together(&self.values(a)?, &self.values(b)?, Jet::times)),
            Formula::Divide(a, b) => {
                return Ok(together(&self.values(a)?, &[self.power(b, -1)?], Jet::times));
            }
            Formula::Power(of, exponent) => self.power(of, *exponent)?,
            Formula::Unary(function, of) => {
                let is_sum = matches!(**of, Formula::Sum(loops, ..) if loops != Loops::Product);
                let of = self.value(of)?;
                if is_sum && of.is_nothing() && ["sqrt", "cbrt"].contains(&function.name) {
                    // The root of a sum without terms is a constant.
                    return Ok(vec![Jet::constant(0.0)]);
                }
                if !(function.domain)(of.value.value) {
                    return Err(Outside::Domain);
                }
                if ["abs", "signum"].contains(&function.name) {
                    self.note_seam(&of);
                }
                of.unary(&function.at)
            }
            Formula::Binary(function, a, b) => {
                let (a, b) = (self.value(a)?, self.value(b)?);
                if matches!(function, BinaryFunction::Min | BinaryFunction::Max) {
                    self.note_seam(&minus(&a, &b));
                }
                a.binary(*function, &b).ok_or(Outside::Domain)?
            }
            Formula::MultiplyAdd(a, b, c) => self.value(a)?.times(&self.value(b)?).plus(&self.value(c)?),
            Formula::Own(function, of) => self.value(of)?.unary(&|x| own(*function, x)),
            Formula::ScalarField(field, at) => scalar_field(*field, &self.each(at)?),
            Formula::If(condition, then, otherwise) => {
                let taken = if self.holds(condition)? { then } else { otherwise };
                return self.values(taken);
            }
            Formula::Let(name, value, body) => {
                let value = self.values(value)?;
                self.names.push((*name, value));
                let body = self.values(body);
                self.names.pop();
                return body;
            }
            Formula::Sum(Loops::Product, level, lower, upper, body) => {
                let mut product = Jet::constant(1.0);
                for term in self.terms(Loops::Product, *level, [lower, upper])? {
                    product = product.times(&single(self.inside(&term, body)?)?);
                }
                product
            }
            Formula::Sum(loops, level, lower, upper, body) => {
                let components = if formula.is_vector() { self.system.width } else { 1 };
                let mut sum = vec![Jet::constant(0.0); components];
                for term in self.terms(*loops, *level, [lower, upper])? {
                    sum = together(&sum, &self.inside(&term, body)?, Jet::plus);
                }
                return Ok(sum);
            }
            Formula::Dot(..) | Formula::Norm(_) | Formula::NormSquared(_) | Formula::Component(..) => {
                self.of_vectors(formula)?
            }
            Formula::List(components) => return self.each(components),
            Formula::Vector(..)
            | Formula::VectorVelocity(..)
            | Formula::Column(..)
            | Formula::VectorParameter(..)
            | Formula::Cross(..) => return self.vector(formula),
        };
        Ok(vec![number])
    }

    /// Several numbers.
    fn each(&mut self, formulas: &[Formula]) -> Result<Vec<Jet>, Outside> {
        formulas.iter().map(|formula| self.value(formula)).collect()
    }

    fn note_seam(&mut self, seam: &Jet) {
        if self.bound.is_empty() {
            self.seams.push(seam.clone());
        }
    }

    /// The indices of the terms of a sum.
    fn terms(
        &self,
        loops: Loops,
        level: usize,
        [lower, upper]: [&Index; 2],
    ) -> Result<Vec<Vec<i64>>, Outside> {
        // The level is the number of indices that are bound around the sum.
        if level != self.bound.len() {
            return Err(Outside::Index);
        }
        let (lower, upper) = (self.index(lower)?, self.index(upper)?);
        let mut terms = Vec::new();
        for first in lower..upper {
            let seconds = match loops {
                Loops::Single | Loops::Product => {
                    terms.push(vec![first]);
                    continue;
                }
                Loops::Pairs => first + 1..upper,
                Loops::OrderedPairs => lower..upper,
            };
            terms.extend(seconds.filter(|second| *second != first).map(|second| vec![first, second]));
        }
        Ok(terms)
    }

    /// All constraints, one after the other.
    pub(super) fn constraints(&mut self) -> Result<Vec<Jet>, Outside> {
        let system = self.system;
        let mut values = Vec::new();
        for Constraint { ranges, formula } in &system.constraints {
            self.members(ranges, formula, &mut values)?;
        }
        Ok(values)
    }

    /// A constraint for all values of these indices.
    fn members(
        &mut self,
        ranges: &[(Index, Index)],
        formula: &Formula,
        values: &mut Vec<Jet>,
    ) -> Result<(), Outside> {
        let [(lower, upper), inner @ ..] = ranges else {
            values.push(self.value(formula)?);
            return Ok(());
        };
        for index in self.index(lower)?..self.index(upper)? {
            self.bound.push(index);
            let inside = self.members(inner, formula, values);
            self.bound.pop();
            inside?;
        }
        Ok(())
    }

    /// A body with its indices at these values.
    pub(super) fn inside(&mut self, indices: &[i64], body: &Formula) -> Result<Vec<Jet>, Outside> {
        let outside = self.bound.len();
        self.bound.extend(indices);
        let values = self.values(body);
        self.bound.truncate(outside);
        values
    }

    fn power(&mut self, of: &Formula, exponent: i32) -> Result<Jet, Outside> {
        let of = self.value(of)?;
        if exponent < 0 && of.value.value.abs() < 1e-2 {
            return Err(Outside::Domain);
        }
        Ok(of.power(exponent))
    }

    fn holds(&mut self, condition: &Condition) -> Result<bool, Outside> {
        Ok(match condition {
            Condition::Compare(left, relation, right) => {
                let (left, right) = (self.value(left)?, self.value(right)?);
                self.note_seam(&minus(&left, &right));
                let (left, right) = (left.value, right.value);
                let difference = left.value - right.value;
                if difference.abs() < NEAR * (1.0 + left.size + right.size) {
                    return Err(Outside::Domain);
                }
                match relation {
                    Relation::Less | Relation::LessOrEqual => difference < 0.0,
                    Relation::Greater | Relation::GreaterOrEqual => difference > 0.0,
                }
            }
            Condition::And(a, b) => self.holds(a)? && self.holds(b)?,
            Condition::Or(a, b) => self.holds(a)? || self.holds(b)?,
            Condition::Not(of) => !self.holds(of)?,
        })
    }

    fn index(&self, index: &Index) -> Result<i64, Outside> {
        index.value(&self.sizes, &self.bound).ok_or(Outside::Index)
    }

    /// An index into an array of this length.
    fn position(&self, index: &Index, length: usize) -> Result<usize, Outside> {
        let position = usize::try_from(self.index(index)?).ok().filter(|position| *position < length);
        position.ok_or(Outside::Index)
    }

    pub(super) fn coordinate(&self, block: usize, index: Option<&Index>) -> Result<usize, Outside> {
        let length = self.system.block_length(block);
        let position = index.map_or(Ok(0), |index| self.position(index, length))?;
        Ok(self.system.offset(block) + position)
    }

    pub(super) fn parameter(&self, field: usize, indices: &[Index]) -> Result<f64, Outside> {
        let field = &self.system.fields[field];
        let mut place = 0;
        for (index, size) in indices.iter().zip(&field.shape) {
            let length = self.sizes[*size] as usize;
            place = place * length + self.position(index, length)?;
        }
        Ok(field.values[place])
    }
}
