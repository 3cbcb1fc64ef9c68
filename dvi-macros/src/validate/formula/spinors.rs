//! Unit vectors of degenerate systems, in complex numbers: with z = (z₁, z₂) a vector has x + iy = 2 z₁* z₂
//! and the height |z₁|² − |z₂|², and the one-form of area is 2 Im(z₁* dz₁ + z₂* dz₂).

use super::super::jet::Jet;
use super::super::point::Variable;
use super::{Evaluation, Quantity, Value};

/// Real and imaginary part.
type Complex = [Jet; 2];

/// a* b
fn product([a, b]: &Complex, [c, d]: &Complex) -> Complex {
    [a.times(c).plus(&b.times(d)), a.times(d).minus(b.times(c))]
}

impl Evaluation<'_> {
    fn spinor(&self, kind: Variable, first: usize, index: i64) -> Value<[Complex; 2]> {
        let part = |number: usize| self.variable(kind, first + number, index);
        Ok([[part(0)?, part(1)?], [part(2)?, part(3)?]])
    }

    /// A unit vector of a coordinate that begins with this block, or a component of it.
    pub(super) fn unit_vector(&self, first: usize, indices: &[i64]) -> Value<Option<Quantity>> {
        let (index, component) = match (self.model.blocks[first].array.is_some(), indices) {
            (true, [index]) => (*index, None),
            (true, [index, component]) => (*index, Some(*component)),
            (false, []) => (0, None),
            (false, [component]) => (0, Some(*component)),
            _ => return Ok(None),
        };
        let [z1, z2] = self.spinor(Variable::Position, first, index)?;
        let [x, y] = product(&z1, &z2).map(|part| part.scaled(2.0));
        let [[up, _], [down, _]] = [product(&z1, &z1), product(&z2, &z2)];
        let vector = Quantity::Vector(vec![x, y, up.minus(down)]);
        Ok(match component {
            Some(component) => vector.component(component).map(Quantity::Number),
            None => Some(vector),
        })
    }

    /// `area(s)`
    pub(super) fn area(&self, first: usize, index: i64) -> Value<Jet> {
        let z = self.spinor(Variable::Position, first, index)?;
        let rate = self.spinor(Variable::Velocity, first, index)?;
        let [[_, a], [_, b]] = [product(&z[0], &rate[0]), product(&z[1], &rate[1])];
        Ok(a.plus(&b).scaled(2.0))
    }
}
