//! What the compiler says of the structure of a system, held against numbers.

use super::generated::Functions;
use super::jet::Sized;
use super::machine::Machine;
use super::point::{Directions, Point, Support};
use super::system::{Outputs, Part, System, difference};
use super::{Checked, Difference, TOLERANCE};
use crate::statement::Output;
use crate::structure::{Components, MassMatrix, OneForm};
use crate::symbolic::Graph;

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
        functions: &Functions<'_>,
        point: &Point,
        outputs: &Outputs,
        checked: &mut Checked,
    ) -> Result<(), Difference> {
        match functions {
            Functions::Degenerate(programs, form) => {
                self.check_form(form, point)?;
                if form.canonical {
                    let [one, other] = conjugates(form);
                    for directions in [between(&one, &other), between(&other, &one)] {
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
            Functions::Regular(_, mass) => {
                if let Some(bend) = outputs.constraint_bend() {
                    vanishes("velocity_constraint", "∂²a/∂v∂v", bend)?;
                }
                self.check_mass(mass, point)
            }
        }
    }

    /// The values along these directions, where they exist.
    fn at(&self, point: &Point, directions: Directions<'_>) -> Option<Outputs> {
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
        let components = form.class.components.iter();
        let vanishing: Vec<bool> =
            components.map(|components| *components == Components::Block(false)).collect();
        let directions = Directions { first: Support::Blocks(&vanishing), ..Directions::ALL };
        if vanishing.contains(&true)
            && let Some(outputs) = self.at(point, directions)
        {
            let what = "a component of α that is said to vanish";
            vanishes("ProperlyDegenerate", what, outputs.form_along())?;
        }
        if form.canonical {
            // A coordinate and its conjugate stay together.
            let blocks = form.conjugates.iter().enumerate();
            let splits = splits(blocks.map(|(block, conjugate)| block.min(*conjugate)).collect());
            let [one, other] = conjugates(form);
            let itself = [between(&one, &one), between(&other, &other)];
            let apart = apart(&splits, point.seed());
            for directions in apart.into_iter().chain(itself.into_iter().filter(|_| form.matching)) {
                let what = "an entry of Dα away from the conjugate coordinate";
                if let Some(outputs) = self.at(point, directions) {
                    vanishes("CANONICAL", what, outputs.form_jacobian(point))?;
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
            let splits = splits((0..self.model.blocks.len()).collect());
            for directions in apart(&splits, point.seed()) {
                if let Some(outputs) = self.at(point, directions) {
                    vanishes("DIAGONAL_MASS", "∂²L/∂v∂v off the diagonal", outputs.mass())?;
                }
            }
        }
        Ok(())
    }
}

/// Of each pair of conjugate blocks, one and the other.
fn conjugates(form: &OneForm) -> [Vec<bool>; 2] {
    let blocks = || form.conjugates.iter().enumerate();
    [
        blocks().map(|(block, conjugate)| block < *conjugate).collect(),
        blocks().map(|(block, conjugate)| block > *conjugate).collect(),
    ]
}

fn between<'a>(first: &'a [bool], second: &'a [bool]) -> Directions<'a> {
    Directions { first: Support::Blocks(first), second: Support::Blocks(second) }
}

/// All blocks in two parts, so often that any two with different numbers are apart once: by the digits of
/// their numbers.
fn splits(numbers: Vec<usize>) -> Vec<[Vec<bool>; 2]> {
    let digits = numbers.iter().max().map_or(0, |largest| usize::BITS - largest.leading_zeros());
    let part = |digit: u32, value: usize| -> Vec<bool> {
        numbers.iter().map(|number| number >> digit & 1 == value).collect()
    };
    (0..digits).map(|digit| [part(digit, 0), part(digit, 1)]).collect()
}

/// Directions between which a symmetric matrix vanishes that couples nothing across these splits, and no
/// entry of an array to another one.
fn apart(splits: &[[Vec<bool>; 2]], seed: u64) -> Vec<Directions<'_>> {
    let halves = Directions { first: Support::Half(seed), second: Support::OtherHalf(seed) };
    splits.iter().map(|[one, other]| between(one, other)).chain([halves]).collect()
}
