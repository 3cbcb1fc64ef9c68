//! What the compiler says of the structure of a system, held against numbers.

use super::generated::Functions;
use super::jet::Sized;
use super::machine::Machine;
use super::point::{Directions, Point, Support};
use super::system::{Outputs, Part, System, difference};
use super::{Checked, Difference, TOLERANCE};
use crate::program::Output;
use crate::structure::{Components, MassMatrix, OneForm};
use crate::symbolic::Graph;

pub(super) enum Claims<'a> {
    Degenerate(&'a OneForm),
    Regular(&'a MassMatrix),
}

/// A claim about numbers that vanish, or that are the same at two points.
fn claim(name: &'static str, what: &str, expected: Sized, found: f64) -> Result<(), Difference> {
    if difference(expected, found) <= TOLERANCE {
        return Ok(());
    }
    Err(Difference { function: name, quantity: what.to_string(), expected: expected.value, found })
}

fn vanishes(name: &'static str, what: &str, number: Sized) -> Result<(), Difference> {
    claim(name, what, Sized { value: 0.0, size: number.size }, number.value)
}

fn is_same(name: &'static str, what: &str, here: Sized, there: Sized) -> Result<(), Difference> {
    claim(name, what, Sized { value: here.value, size: here.size + there.size }, there.value)
}

impl System<'_> {
    pub(super) fn check_claims(
        &self,
        graph: &Graph,
        claims: &Claims<'_>,
        functions: &Functions<'_>,
        point: &Point,
        outputs: &Outputs,
        checked: &mut Checked,
    ) -> Result<(), Difference> {
        match (claims, functions) {
            (Claims::Degenerate(form), Functions::Degenerate(programs)) => {
                self.check_form(form, point)?;
                if form.canonical {
                    let blocks = form.conjugates.iter().enumerate();
                    for (block, conjugate) in blocks {
                        let first = Support::Block(block);
                        let directions = Directions { first, second: Support::Block(*conjugate) };
                        let Some(outputs) = self.at(point, directions) else { continue };
                        let conjugates = Some(form.conjugates.as_slice());
                        let machine = Machine { graph, model: self.model, point, directions, conjugates };
                        let found = machine.run(&programs.conjugate_entries).along_first(Output::Vector);
                        let expected = outputs.form_jacobian(point);
                        claim("conjugate_entries", "an entry of a Dα + b (Dα)ᵀ", expected, found)?;
                        checked.largest = checked.largest.max(difference(expected, found));
                    }
                }
                Ok(())
            }
            (Claims::Regular(mass), Functions::Regular(_)) => {
                if let Some(bend) = outputs.constraint_bend() {
                    vanishes("velocity_constraint", "∂²a/∂v∂v", bend)?;
                }
                self.check_mass(mass, point)
            }
            _ => Ok(()),
        }
    }

    /// The values along these directions, where they exist.
    fn at(&self, point: &Point, directions: Directions) -> Option<Outputs> {
        self.outputs(point, directions, Part::Form, u64::MAX).ok().filter(Outputs::is_moderate)
    }

    fn check_form(&self, form: &OneForm, point: &Point) -> Result<(), Difference> {
        if form.linear {
            let there = self.at(&point.elsewhere(true, true, true), Directions::ALL);
            if let (Some(here), Some(there)) = (self.at(point, Directions::ALL), there) {
                is_same("AFFINE", "Dα elsewhere", here.form_jacobian(point), there.form_jacobian(point))?;
                vanishes("AFFINE", "∂α/∂t", here.form_rate())?;
            }
        }
        for (block, components) in form.class.components.iter().enumerate() {
            let directions = Directions { first: Support::Block(block), ..Directions::ALL };
            if *components == Components::Block(false)
                && let Some(outputs) = self.at(point, directions)
            {
                vanishes(
                    "ProperlyDegenerate",
                    "a component of α that is said to vanish",
                    outputs.form_along(),
                )?;
            }
        }
        if form.canonical {
            for (block, conjugate) in form.conjugates.iter().enumerate() {
                let what = "an entry of Dα away from the conjugate coordinate";
                for directions in away_from(block, *conjugate, form.matching, point.seed()) {
                    if let Some(outputs) = self.at(point, directions) {
                        vanishes("CANONICAL", what, outputs.form_jacobian(point))?;
                    }
                }
            }
        }
        Ok(())
    }

    fn check_mass(&self, mass: &MassMatrix, point: &Point) -> Result<(), Difference> {
        let Some(here) = self.at(point, Directions::ALL) else { return Ok(()) };
        if mass.quadratic
            && let Some(there) = self.at(&point.elsewhere(false, true, false), Directions::ALL)
        {
            is_same("QUADRATIC", "∂²L/∂v∂v at other velocities", here.mass(), there.mass())?;
        }
        if mass.separable {
            vanishes("SEPARABLE", "∂F/∂v", here.friction())?;
        }
        if mass.uniform
            && let Some(there) = self.at(&point.elsewhere(true, true, true), Directions::ALL)
        {
            is_same("UNIFORM_MASS", "∂²L/∂v∂v elsewhere", here.mass(), there.mass())?;
        }
        if mass.constant {
            for coupling in here.coupling() {
                vanishes("CONSTANT_MASS", "∂²L/∂q∂v", coupling)?;
            }
            if let Some(at_rest) = self.at(&point.at_rest(), Directions::ALL) {
                vanishes("CONSTANT_MASS", "∂L/∂v at v = 0", at_rest.momentum_along())?;
            }
        }
        if mass.diagonal {
            for block in 0..self.model.blocks.len() {
                for directions in away_from(block, block, false, point.seed()) {
                    if let Some(outputs) = self.at(point, directions) {
                        vanishes("DIAGONAL_MASS", "∂²L/∂v∂v off the diagonal", outputs.mass())?;
                    }
                }
            }
        }
        Ok(())
    }
}

/// Directions between which a matrix vanishes that couples each entry of `block` to the same entry of
/// `conjugate` only, and to itself unless `is_off_diagonal`.
fn away_from(block: usize, conjugate: usize, is_off_diagonal: bool, seed: u64) -> Vec<Directions> {
    let pair = |first, second| Directions { first, second };
    let mut directions = vec![
        pair(Support::Block(block), Support::Except(block, conjugate)),
        pair(Support::Half(block, seed), Support::OtherHalf(block, seed)),
        pair(Support::Half(block, seed), Support::OtherHalf(conjugate, seed)),
    ];
    if is_off_diagonal {
        directions.push(pair(Support::Block(block), Support::Block(block)));
    }
    directions
}
