//! Vectors of the oracle: the values of their components.

use super::evaluate::{Oracle, Outside};
use super::formula::{Formula, Index};
use super::functions::UNARY;
use super::jet::Jet;
use super::rotations::{COMPONENTS, ENTRIES};

fn sum_of_products(a: &[Jet], b: &[Jet]) -> Jet {
    a.iter().zip(b).fold(Jet::constant(0.0), |sum, (a, b)| sum.plus(&a.times(b)))
}

fn minus(a: &[Jet], b: &[Jet]) -> Vec<Jet> {
    a.iter().zip(b).map(|(a, b)| a.plus(&b.scaled(-1.0))).collect()
}

impl Oracle<'_> {
    /// A number made of vectors.
    pub(super) fn of_vectors(&mut self, formula: &Formula) -> Result<Jet, Outside> {
        Ok(match formula {
            Formula::Dot(a, b) => sum_of_products(&self.values(a)?, &self.values(b)?),
            Formula::NormSquared(of) => {
                let of = self.values(of)?;
                sum_of_products(&of, &of)
            }
            Formula::Norm(of) => {
                let of = self.values(of)?;
                let square = sum_of_products(&of, &of);
                // A root near zero has large derivatives.
                if square.value.value < 1e-3 {
                    return Err(Outside::Domain);
                }
                let root = UNARY.iter().find(|function| function.name == "sqrt").ok_or(Outside::Domain)?;
                square.unary(&root.at)
            }
            Formula::Component(of, number) => self.values(of)?.get(*number).ok_or(Outside::Index)?.clone(),
            _ => return Err(Outside::Index),
        })
    }

    /// The components of a formula, one if it is a number.
    pub(super) fn values(&mut self, formula: &Formula) -> Result<Vec<Jet>, Outside> {
        if !formula.is_vector() {
            return Ok(vec![self.value(formula)?]);
        }
        let values = self.components(formula)?;
        if values.iter().all(Jet::is_moderate) { Ok(values) } else { Err(Outside::Domain) }
    }

    fn components(&mut self, formula: &Formula) -> Result<Vec<Jet>, Outside> {
        Ok(match formula {
            Formula::Vector(block, index) if self.system.is_spinor(*block) => {
                self.unit_vector(*block, index.as_ref())?
            }
            Formula::Vector(block, index) => {
                let places = self.places(*block, index.as_ref(), 0..self.numbers(*block))?;
                self.at(places)
            }
            Formula::Column(block, index, column) => {
                let places = self.places(*block, index.as_ref(), (*column..ENTRIES).step_by(COMPONENTS))?;
                self.at(places)
            }
            Formula::VectorVelocity(block, index) => {
                let numbers = 0..self.numbers(*block).min(COMPONENTS);
                let (places, n) = (self.places(*block, index.as_ref(), numbers)?, self.point.q.len());
                let velocity = |place| Jet::variable(self.point.v[place], n + place, self.variables());
                places.into_iter().map(velocity).collect()
            }
            Formula::VectorParameter(field, indices) => {
                let size = self.system.fields[*field].shape.last().ok_or(Outside::Index)?;
                let entry = |component| {
                    let indices = [indices.as_slice(), &[Index::literal(component)]].concat();
                    Ok(Jet::constant(self.parameter(*field, &indices)?))
                };
                (0..self.system.sizes[*size].value).map(entry).collect::<Result<_, _>>()?
            }
            Formula::VectorName(name) => {
                let known = self.names.iter().rev().find(|(known, _)| known == name);
                known.ok_or(Outside::Index)?.1.clone()
            }
            Formula::List(components) => {
                components.iter().map(|component| self.value(component)).collect::<Result<_, _>>()?
            }
            Formula::Cross(a, b) => {
                let (a, b) = (self.values(a)?, self.values(b)?);
                let (Ok([a0, a1, a2]), Ok([b0, b1, b2])) =
                    (<[Jet; 3]>::try_from(a), <[Jet; 3]>::try_from(b))
                else {
                    return Err(Outside::Index);
                };
                minus(
                    &[a1.times(&b2), a2.times(&b0), a0.times(&b1)],
                    &[a2.times(&b1), a0.times(&b2), a1.times(&b0)],
                )
            }
            Formula::Negative(of) => {
                self.values(of)?.iter().map(|component| component.scaled(-1.0)).collect()
            }
            Formula::Add(a, b) => {
                let (a, b) = (self.values(a)?, self.values(b)?);
                a.iter().zip(&b).map(|(a, b)| a.plus(b)).collect()
            }
            Formula::Subtract(a, b) => minus(&self.values(a)?, &self.values(b)?),
            Formula::Multiply(a, b) => {
                let (factor, vector) = if a.is_vector() { (b, a) } else { (a, b) };
                let (factor, vector) = (self.value(factor)?, self.values(vector)?);
                vector.iter().map(|component| component.times(&factor)).collect()
            }
            Formula::Divide(a, b) => {
                let (a, b) = (self.values(a)?, self.power(b, -1)?);
                a.iter().map(|component| component.times(&b)).collect()
            }
            Formula::If(condition, then, otherwise) => {
                let taken = if self.holds(condition)? { then } else { otherwise };
                self.values(taken)?
            }
            Formula::Let(name, value, body) => self.with_name(*name, value, body)?,
            Formula::Sum(loops, level, lower, upper, body) => {
                let mut sum: Option<Vec<Jet>> = None;
                for term in self.terms(*loops, *level, [lower, upper])? {
                    let value = self.all_inside(&term, body)?;
                    sum = Some(match sum {
                        None => value,
                        Some(sum) => sum.iter().zip(&value).map(|(a, b)| a.plus(b)).collect(),
                    });
                }
                sum.unwrap_or_else(|| vec![Jet::constant(0.0); self.system.width])
            }
            _ => return Err(Outside::Index),
        })
    }

    /// The coordinates at these places.
    fn at(&self, places: Vec<usize>) -> Vec<Jet> {
        let variable = |place| Jet::variable(self.point.q[place], place, self.variables());
        places.into_iter().map(variable).collect()
    }

    /// The number of coordinates of a vector or a rotation.
    fn numbers(&self, first: usize) -> usize {
        match self.system.axes(first) {
            1 => self.system.block_length(first),
            axes => axes,
        }
    }

    /// The places of coordinates of a vector or a rotation among all, by their numbers in it.
    fn places(
        &self,
        first: usize,
        index: Option<&Index>,
        numbers: impl Iterator<Item = usize>,
    ) -> Result<Vec<usize>, Outside> {
        match index {
            Some(_) => numbers.map(|number| self.coordinate(first + number, index)).collect(),
            None => Ok(numbers.map(|number| self.system.offset(first) + number).collect()),
        }
    }
}
