//! What is printed, carried out: the instructions of a routine in their loops, on plain numbers.

use rustc_hash::FxHashMap as HashMap;

use super::functions;
use super::point::{Branches, Directions, Point, Variable};
use crate::instructions::{Instruction, Register, Signed};
use crate::internal::internal;
use crate::model::Model;
use crate::routine::Routine;
use crate::schedule::Step;
use crate::statement::{Output, Place, Row};
use crate::symbolic::{Atom, Coordinate, Fold, Graph, Id, Index, Node, Relation};
use crate::work::step;

/// What a routine gives: what it returns, its vectors along the first direction, and its matrix between
/// the first and the second.
#[derive(Debug, Default)]
pub(super) struct Results {
    pub(super) value: f64,
    vectors: HashMap<Output, [f64; 2]>,
    pub(super) matrix: f64,
    /// The constraints along the first direction.
    pub(super) constraints: f64,
    /// Whether an entry was read that is not there.
    pub(super) reads_outside: bool,
}

impl Results {
    pub(super) fn along_first(&self, output: Output) -> f64 {
        self.vectors.get(&output).map_or(0.0, |along| along[0])
    }

    pub(super) fn along_second(&self, output: Output) -> f64 {
        self.vectors.get(&output).map_or(0.0, |along| along[1])
    }
}

pub(super) struct Machine<'a> {
    pub(super) graph: &'a Graph,
    pub(super) model: &'a Model,
    pub(super) point: &'a Point,
    pub(super) directions: Directions<'a>,
    /// For a vector of the entries (i, conjugate of i): the conjugate of each block.
    pub(super) conjugates: Option<&'a [usize]>,
}

struct Run<'a> {
    machine: &'a Machine<'a>,
    routine: &'a Routine,
    registers: Vec<f64>,
    /// The values of the open indices, by depth.
    indices: Vec<i64>,
    results: Results,
}

impl Machine<'_> {
    pub(super) fn run(&self, routine: &Routine) -> Results {
        let registers = vec![f64::NAN; routine.code.len()];
        let mut run =
            Run { machine: self, routine, registers, indices: Vec::new(), results: Results::default() };
        run.steps(&routine.steps);
        run.results
    }

    fn along(&self, is_second: bool, block: usize, index: i64) -> f64 {
        let support = if is_second { self.directions.second } else { self.directions.first };
        self.point.direction(support, is_second, block, index)
    }
}

impl Run<'_> {
    fn steps(&mut self, steps: &[Step]) {
        for step in steps {
            match step {
                Step::Let(register) => {
                    let value = self.instruction(self.routine.code.get(*register));
                    self.registers[register.0 as usize] = value;
                }
                Step::Write(statement, value) => {
                    let value = self.signed(*value);
                    self.write(&self.routine.statements[*statement].place, value);
                }
                Step::Loop { over, folds, body } => {
                    let neutral = |fold| match fold {
                        // As sums of Rust: −0 + x is x for every x.
                        Fold::Sum => -0.0,
                        Fold::Product => 1.0,
                    };
                    let mut totals: Vec<f64> = folds.iter().map(|fold| neutral(fold.fold)).collect();
                    let (lower, upper) = (self.index(&over.range.lower), self.index(&over.range.upper));
                    let except: Vec<i64> = over.range.left_out().map(|index| self.index(index)).collect();
                    for index in self.machine.point.visited(lower, upper) {
                        if except.contains(&index) {
                            continue;
                        }
                        self.indices.push(index);
                        self.steps(body);
                        for (total, fold) in totals.iter_mut().zip(folds) {
                            let value = self.signed(fold.body);
                            match fold.fold {
                                Fold::Sum => *total += value,
                                Fold::Product => *total *= value,
                            }
                        }
                        self.indices.pop();
                    }
                    for (fold, total) in folds.iter().zip(totals) {
                        self.registers[fold.result.0 as usize] = total;
                    }
                }
            }
        }
    }

    fn write(&mut self, place: &Place, value: f64) {
        match place {
            Place::Result => self.results.value += value,
            Place::Entry(output, coordinate) => {
                let (block, index) = (coordinate.block as usize, self.index(&coordinate.index));
                let at_partner = self
                    .machine
                    .conjugates
                    .map_or(1.0, |conjugates| self.machine.along(true, conjugates[block], index));
                let first = self.machine.along(false, block, index) * at_partner;
                let second = self.machine.along(true, block, index);
                let along = self.results.vectors.entry(*output).or_insert([0.0; 2]);
                along[0] += component(first, value);
                along[1] += component(second, value);
            }
            Place::MatrixEntry(row, column) => {
                let (i, j) = (self.index(&row.index), self.index(&column.index));
                let (row, column) = (row.block as usize, column.block as usize);
                let along = self.machine.along(false, row, i) * self.machine.along(true, column, j);
                self.results.matrix += component(along, value);
            }
            Place::Constraint(row) => {
                let along = self.along_row(row);
                self.results.constraints += component(along, value);
            }
            Place::ConstraintDerivative(row, column) => {
                let (block, index) = (column.block as usize, self.index(&column.index));
                let along = self.along_row(row) * self.machine.along(true, block, index);
                self.results.matrix += component(along, value);
            }
        }
    }

    fn along_row(&self, row: &Row) -> f64 {
        let Machine { point, directions, .. } = self.machine;
        let Some(member) = row.member.value(|index| Some(self.index(index))) else {
            internal("too many constraints")
        };
        point.row(directions.first, row.constraint as usize, member)
    }

    fn register(&self, register: Register) -> f64 {
        self.registers[register.0 as usize]
    }

    fn signed(&self, value: Signed) -> f64 {
        let register = self.register(value.register);
        if value.negative { -register } else { register }
    }

    fn instruction(&mut self, instruction: &Instruction) -> f64 {
        step();
        match instruction {
            Instruction::Leaf(id) => self.leaf(*id),
            Instruction::Literal(bits) => f64::from_bits(*bits),
            Instruction::Multiply(a, b) => self.register(*a) * self.register(*b),
            Instruction::Divide(a, b) => self.register(*a) / self.register(*b),
            Instruction::Sum(terms) => terms.iter().map(|term| self.signed(*term)).sum(),
            Instruction::Unary(function, of) => functions::printed_unary(function.name(), self.signed(*of)),
            Instruction::Binary(function, a, b) => {
                functions::printed_binary(function.name(), self.signed(*a), self.signed(*b))
            }
            Instruction::Call(function, order, of) => {
                functions::stand_in(*function as usize, *order, self.signed(*of))
            }
            // Its parts are what is read.
            Instruction::Expansion(..) => f64::NAN,
            Instruction::Part(expansion, partial) => {
                let Instruction::Expansion(field, at) = self.routine.code.get(*expansion) else {
                    internal("a part of what is no expansion")
                };
                let at: Vec<f64> = at.iter().map(|argument| self.signed(*argument)).collect();
                functions::scalar_field_stand_in(*field as usize, &partial.axes(), &at)
            }
            Instruction::Choose(left, relation, right, then, otherwise) => {
                let (left, right) = (self.signed(*left), self.signed(*right));
                let holds = relation.holds(left, right);
                let is_exchanged =
                    *relation != Relation::HasMore && self.machine.point.branches == Branches::Exchanged;
                self.signed(if holds != is_exchanged { *then } else { *otherwise })
            }
            Instruction::Reduce(..) => internal("a sum outside of its loop"),
        }
    }

    fn variable(&mut self, kind: Variable, coordinate: &Coordinate) -> f64 {
        let Machine { point, model, .. } = self.machine;
        let (block, index) = (coordinate.block as usize, self.index(&coordinate.index));
        let size = point.length(&model.block_size(block));
        if size.is_some_and(|size| (0..size).contains(&index)) {
            return point.variable(kind, block, index);
        }
        self.results.reads_outside = true;
        f64::NAN
    }

    fn leaf(&mut self, id: Id) -> f64 {
        let Machine { graph, point, model, .. } = self.machine;
        match graph.node(id) {
            Node::Coordinate(coordinate) => self.variable(Variable::Position, coordinate),
            Node::Velocity(coordinate) => self.variable(Variable::Velocity, coordinate),
            Node::Time => point.time(),
            Node::Parameter(parameter) => {
                let indices: Vec<i64> = parameter.indices.iter().map(|index| self.index(index)).collect();
                point.parameter(&model.parameters[parameter.field as usize].text, &indices)
            }
            Node::Count(index) => self.index(index) as f64,
            Node::Weight(weight) => point.weight(*weight),
            other => internal(format!("{other:?} is not a leaf")),
        }
    }

    /// The value of an index; −1, which is in no array, where a remainder is taken by zero.
    fn index(&self, index: &Index) -> i64 {
        let known = |atom: &Atom| match atom {
            Atom::Open(depth) => Some(self.indices[*depth as usize]),
            Atom::Size(size) => self.machine.point.size(size.0 as usize),
            _ => internal("an index outside of its sum"),
        };
        index.value(&known).unwrap_or(-1)
    }
}

/// What an entry adds along a direction; nothing where the direction does not go, even if the entry is no
/// number.
fn component(direction: f64, entry: f64) -> f64 {
    if direction == 0.0 { 0.0 } else { direction * entry }
}
