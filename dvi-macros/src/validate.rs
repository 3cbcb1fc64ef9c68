//! The self-check of an expansion: what is about to be printed against the formulas as written.
//!
//! The formulas are evaluated as they stand in the attribute, on numbers that carry derivatives
//! ([`formula`], [`jet`]); the scheduled instructions of each function are carried out on plain numbers
//! ([`machine`]); both at the same points, drawn from the text of the formulas ([`point`]). The two share
//! no code with each other, nor with simplification, differentiation and scheduling. A difference beyond
//! rounding is a compile error (translation validation; Pnueli, Siegel & Singerman 1998).
//!
//! Gradients and second derivatives are compared along random directions, which speak for all of their
//! entries at once. Sizes that are not literal are small numbers, long ranges are visited at the first of
//! their values, entries of parameters are numbers and the user's functions are sines. Comparisons are taken
//! both ways.

use quote::ToTokens;

use self::formula::{NoValue, Texts};
pub(crate) use self::generated::Functions;
use self::jet::{First, Sized};
use self::output::Output;
use self::point::{Branches, Directions, Point, Support, mix_text};
use self::system::{Part, System, difference};
use crate::model::Model;
use crate::symbolic::Graph;
use crate::syntax::Attribute;

mod claims;
mod formula;
mod functions;
mod generated;
mod jet;
mod machine;
mod output;
mod point;
mod system;

/// Differences beyond this part of the sum of the absolute terms are no rounding.
const TOLERANCE: f64 = 1e-8;
/// A derivative that is a smaller part of the sum of its absolute terms may be rounding.
const MOVES: f64 = 1e-6;
/// Points that are checked with each way of taking comparisons, if they are not too dear.
const POINTS: usize = 2;
/// Points that are drawn before none is said to be found.
const ATTEMPTS: u64 = 160;
/// Operations on jets that a check may cost, about.
const BUDGET: u64 = 24_000;

/// What a check has found, if no difference.
#[derive(Clone, Debug, Default)]
pub(crate) struct Checked {
    points: usize,
    /// The largest difference, in units of the sum of the absolute terms.
    largest: f64,
    /// Whether one side of some comparison was never taken.
    misses_a_side: bool,
}

/// A function that does not give what the formulas say.
#[derive(Clone, Debug)]
pub(crate) struct Difference {
    function: &'static str,
    quantity: String,
    expected: f64,
    found: f64,
}

impl Checked {
    /// What is said of the check in reports.
    pub(crate) fn sentence(&self) -> String {
        if self.points == 0 {
            return "Not checked: no point was found at which the formulas have a value.".to_string();
        }
        let bound = 10_f64.powi(self.largest.max(1e-15).log10().ceil() as i32);
        let side = if self.misses_a_side { " One side of a comparison was not reached." } else { "" };
        format!(
            "Checked when compiled: at {} points, every generated function agrees with the formulas as written, to \
             {bound:e} of the sum of the absolute terms.{side}",
            self.points
        )
    }
}

impl Difference {
    pub(crate) fn message(&self) -> String {
        let Self { function, quantity, expected, found } = self;
        format!(
            "this is a mistake in dvi-macros, not in your formulas: the generated `{function}` differs from what they \
             say, {quantity} is {found:?} instead of {expected:?} at the point of the self-check; please report it together \
             with this system"
        )
    }
}

pub(crate) fn check(
    graph: &Graph,
    model: &Model,
    attribute: &Attribute,
    functions: &Functions<'_>,
) -> Result<Checked, Difference> {
    Check { graph, system: System { model, attribute, texts: &Texts::default() } }.run(functions)
}

struct Check<'a> {
    graph: &'a Graph,
    system: System<'a>,
}

impl Check<'_> {
    fn run(&self, functions: &Functions<'_>) -> Result<Checked, Difference> {
        let mut checked = Checked::default();
        let mut sides = formula::Sides::default();
        for branches in [Branches::AsCompared, Branches::Exchanged] {
            if branches == Branches::Exchanged && sides.is_empty() {
                break;
            }
            let mut trials = Trials { seed: self.seed(), attempt: 0, sizes: 0, branches, most_visited: 5 };
            let (mut accepted, mut spent) = (0, 0);
            while accepted < POINTS && (accepted == 0 || spent < BUDGET / 4) && trials.attempt < ATTEMPTS {
                let point = trials.next(self.system.model);
                let budget = if trials.most_visited > 2 { BUDGET / 4 } else { 64 * BUDGET };
                let outputs = match self.system.outputs(&point, Directions::ALL, Part::All, budget) {
                    Ok(values) => values,
                    Err(reason) => {
                        trials.learn(reason);
                        continue;
                    }
                };
                spent += outputs.cost;
                if !outputs.is_moderate() {
                    continue;
                }
                if !outputs.sides.is_empty()
                    && functions.reads_outside(self.graph, self.system.model, &point)
                {
                    trials.learn(NoValue::OutOfRange);
                    continue;
                }
                accepted += 1;
                sides.extend(&outputs.sides);
                self.compare(&point, &outputs, functions, &mut checked)?;
                self.compare_seams(&point, &outputs, functions)?;
                self.system.check_claims(self.graph, functions, &point, &outputs, &mut checked)?;
            }
            checked.points += accepted;
        }
        checked.misses_a_side = sides.iter().any(|(place, side)| !sides.contains(&(*place, !side)));
        Ok(checked)
    }

    /// The same points for the same formulas.
    fn seed(&self) -> u64 {
        let formulas = self.system.attribute.formulas();
        formulas.fold(2002, |seed, formula| mix_text(seed, &formula.to_token_stream().to_string()))
    }

    fn compare(
        &self,
        point: &Point,
        outputs: &system::Outputs,
        functions: &Functions<'_>,
        checked: &mut Checked,
    ) -> Result<(), Difference> {
        let found = functions.carried_out(self.graph, self.system.model, point, Directions::ALL);
        for (output, found) in found {
            let difference = outputs.difference(&output, found, point);
            checked.largest = checked.largest.max(difference.min(TOLERANCE));
            if difference > TOLERANCE {
                return Err(self.locate(point, functions, &output).unwrap_or_else(|| Difference {
                    function: output.function,
                    quantity: output.quantity(None),
                    expected: outputs.expected(&output, point).value,
                    found,
                }));
            }
        }
        Ok(())
    }

    /// What the formulas have been found to compare is among the seams, if it moves.
    fn compare_seams(
        &self,
        point: &Point,
        outputs: &system::Outputs,
        functions: &Functions<'_>,
    ) -> Result<(), Difference> {
        let found = functions.seams(self.graph, self.system.model, point);
        for written in &outputs.seams {
            let moves = [First::Q, First::V, First::T].iter().any(|&direction| {
                let Sized { value, size } = written.first(direction);
                value.abs() > MOVES * size
            });
            let expected = written.value();
            let off = |seam: &f64| difference(expected, *seam).min(difference(expected, -seam));
            let nearest = found.iter().copied().min_by(|a, b| off(a).total_cmp(&off(b))).unwrap_or(f64::NAN);
            if moves && off(&nearest) > TOLERANCE {
                let quantity = "a number at whose zero a formula is not smooth".to_string();
                return Err(Difference {
                    function: "seam",
                    quantity,
                    expected: expected.value,
                    found: nearest,
                });
            }
        }
        Ok(())
    }

    /// The entry of an output that differs most.
    fn locate(&self, point: &Point, functions: &Functions<'_>, output: &Output) -> Option<Difference> {
        const MOST: i64 = 12;
        let model = self.system.model;
        let entries = (0..model.blocks.len()).flat_map(|block| {
            let size = point.length(&model.block_size(block)).unwrap_or(0).min(MOST);
            (0..size).map(move |index| Support::Entry(block, index))
        });
        let entries: Vec<Support<'_>> = entries.collect();
        let rows = functions.constraint_lengths().iter().enumerate().flat_map(|(number, length)| {
            let length = length.value(|index| point.length(index)).unwrap_or(0).min(MOST);
            (0..length).map(move |member| Support::Constraint(number, member))
        });
        let rows: Vec<Support<'_>> =
            if output.is_by_constraint() { rows.collect() } else { entries.clone() };
        let mut worst: Option<(f64, Difference)> = None;
        for first in &rows {
            for second in if output.is_matrix { entries.as_slice() } else { std::slice::from_ref(first) } {
                let directions = Directions { first: *first, second: *second };
                let Ok(outputs) = self.system.outputs(point, directions, Part::All, 64 * BUDGET) else {
                    continue;
                };
                let found = functions.carried_out(self.graph, model, point, directions);
                let Some((output, found)) = found.into_iter().find(|(known, _)| known == output) else {
                    continue;
                };
                let difference = outputs.difference(&output, found, point);
                if difference > TOLERANCE && worst.as_ref().is_none_or(|(known, _)| difference > *known) {
                    let place = self.named(directions, output.is_matrix);
                    let expected = outputs.expected(&output, point).value;
                    let quantity = output.quantity(Some(&place));
                    worst = Some((
                        difference,
                        Difference { function: output.function, quantity, expected, found },
                    ));
                }
            }
        }
        worst.map(|(_, difference)| difference)
    }

    fn named(&self, directions: Directions<'_>, is_matrix: bool) -> String {
        let name = |support: Support<'_>| match support {
            Support::Entry(block, index) => self.system.model.blocks[block].at(index),
            Support::Constraint(number, member) => format!("constraint {number}, member {member}"),
            Support::All | Support::Blocks(_) | Support::Half(_) | Support::OtherHalf(_) => String::new(),
        };
        if is_matrix {
            format!("({}, {})", name(directions.first), name(directions.second))
        } else {
            name(directions.first)
        }
    }
}

/// What is tried next.
struct Trials {
    seed: u64,
    attempt: u64,
    sizes: usize,
    branches: Branches,
    most_visited: i64,
}

impl Trials {
    fn next(&mut self, model: &Model) -> Point {
        self.attempt += 1;
        let mut point = Point::new(model, self.seed, self.attempt, self.sizes, self.branches);
        point.most_visited = self.most_visited;
        point
    }

    fn learn(&mut self, reason: NoValue) {
        match reason {
            NoValue::OutOfRange => self.sizes += 1,
            NoValue::TooLong => self.most_visited = (self.most_visited - 1).max(2),
        }
    }
}
