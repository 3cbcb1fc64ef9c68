//! Vectors of the oracle: the values of their components.

use super::evaluate::{Oracle, Outside, minus};
use super::formula::{Formula, Index};
use super::functions::UNARY;
use super::jet::Jet;
use super::rotations::{COMPONENTS, ENTRIES};

fn sum_of_products(a: &[Jet], b: &[Jet]) -> Jet {
    a.iter().zip(b).fold(Jet::constant(0.0), |sum, (a, b)| sum.plus(&a.times(b)))
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

    /// A vector of the struct, or a cross product.
    pub(super) fn vector(&mut self, formula: &Formula) -> Result<Vec<Jet>, Outside> {
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
            Formula::Cross(a, b) => {
                let (a, b) = (self.values(a)?, self.values(b)?);
                let ([a0, a1, a2], [b0, b1, b2]) = (a.as_slice(), b.as_slice()) else {
                    return Err(Outside::Index);
                };
                let minor = |a: &Jet, b: &Jet, c: &Jet, d: &Jet| minus(&a.times(d), &b.times(c));
                vec![minor(a1, a2, b1, b2), minor(a2, a0, b2, b0), minor(a0, a1, b0, b1)]
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
