//! Instructions and loops, interpreted as the generated code would run them, against the graph.

use std::collections::{HashMap, HashSet};

use proptest::prelude::*;

use super::evaluate::{Bindings, Evaluation, Point, holds, own_function, scalar_field};
use super::properties::raw_value;
use super::streams::NONLINEAR;
use super::tree::{Tree, point, tree};
use crate::formulas::DegenerateFormulas;
use crate::instructions::{Instruction, Instructions, Register, Signed};
use crate::program::DegeneratePrograms;
use crate::routine::Routine;
use crate::schedule::{Accumulated, Step};
use crate::statement::{Place, Statement};
use crate::symbolic::rules::evaluate_binary;
use crate::symbolic::{Atom, Coordinate, Count, Expr, Fold, Graph, Index, Node, Range, Size};

/// Entries of the outputs by name, each with what was added to it and the sizes of the parts.
type Written = HashMap<String, (f64, f64)>;

fn add(written: &mut Written, point: &Point, place: &Place, at: &Bindings, value: f64) {
    let number = |member: &Count| member.value(|index| Some(point.index(index, at))).expect("a few rows");
    let name = match place {
        Place::Result => "result".to_string(),
        Place::Entry(output, c) => format!("{output:?} {} {}", c.block, point.index(&c.index, at)),
        Place::MatrixEntry(r, c) => {
            let (i, j) = (point.index(&r.index, at), point.index(&c.index, at));
            format!("matrix {} {i} {} {j}", r.block, c.block)
        }
        Place::Constraint(row) => {
            format!("constraint {} {}", row.constraint, number(&row.member))
        }
        Place::ConstraintDerivative(row, c) => {
            let (i, j) = (number(&row.member), point.index(&c.index, at));
            format!("constraint {} {i} by {} {j}", row.constraint, c.block)
        }
    };
    let (sum, size) = written.entry(name).or_default();
    *sum += value;
    *size += value.abs();
}

struct Machine<'a> {
    graph: &'a Graph,
    code: &'a Instructions,
    statements: &'a [Statement],
    point: &'a Point,
    registers: HashMap<Register, f64>,
    written: Written,
}

impl Machine<'_> {
    /// A register that no step has defined yet is a mistake of the schedule.
    fn register(&self, register: Register) -> f64 {
        *self.registers.get(&register).expect("a register is used before it is defined")
    }

    fn signed(&self, value: Signed) -> f64 {
        let register = self.register(value.register);
        if value.negative { -register } else { register }
    }

    fn run(&mut self, steps: &[Step], at: &Bindings) {
        for step in steps {
            match step {
                Step::Let(register) => {
                    let value = self.instruction(self.code.get(*register), at);
                    self.registers.insert(*register, value);
                }
                Step::Write(statement, value) => {
                    let value = self.signed(*value);
                    add(&mut self.written, self.point, &self.statements[*statement].place, at, value);
                }
                Step::Loop { over, folds, body } => {
                    let outside = self.registers.clone();
                    let neutral = |fold: &Accumulated| if fold.fold == Fold::Sum { 0.0 } else { 1.0 };
                    let mut totals: Vec<f64> = folds.iter().map(neutral).collect();
                    for index in self.point.range(&over.range, at) {
                        let mut inside = at.clone();
                        inside.push((Atom::Open(over.depth), index));
                        self.run(body, &inside);
                        for (total, fold) in totals.iter_mut().zip(folds) {
                            let value = self.signed(fold.body);
                            match fold.fold {
                                Fold::Sum => *total += value,
                                Fold::Product => *total *= value,
                            }
                        }
                        self.registers.clone_from(&outside);
                    }
                    self.registers.extend(folds.iter().map(|fold| fold.result).zip(totals));
                }
            }
        }
    }

    fn instruction(&self, instruction: &Instruction, at: &Bindings) -> f64 {
        match instruction {
            Instruction::Leaf(id) => self.point.leaf(self.graph.node(*id), at),
            Instruction::Literal(bits) => f64::from_bits(*bits),
            Instruction::Multiply(a, b) => self.register(*a) * self.register(*b),
            Instruction::Divide(a, b) => self.register(*a) / self.register(*b),
            Instruction::Sum(terms) => terms.iter().map(|term| self.signed(*term)).sum(),
            Instruction::Unary(function, of) => function.evaluate(self.signed(*of)),
            Instruction::Binary(function, a, b) => {
                evaluate_binary(*function, self.signed(*a), self.signed(*b))
            }
            Instruction::Power(of, exponent) => self.register(*of).powi(*exponent),
            Instruction::Call(_, order, of) => own_function(*order, self.signed(*of)),
            Instruction::Expansion(..) => f64::NAN,
            Instruction::Part(expansion, partial) => {
                let Instruction::Expansion(_, at) = self.code.get(*expansion) else {
                    unreachable!("a part")
                };
                let at: Vec<f64> = at.iter().map(|argument| self.signed(*argument)).collect();
                scalar_field(*partial, &at)
            }
            Instruction::Choose(left, relation, right, then, otherwise) => {
                let chosen = holds(self.signed(*left), *relation, self.signed(*right));
                self.signed(if chosen { *then } else { *otherwise })
            }
            Instruction::Reduce(..) => unreachable!("sums are loops"),
        }
    }
}

/// What a scope uses, itself, inside of its loops, and as `results`; nothing may be computed in vain.
fn used(
    code: &Instructions,
    steps: &[Step],
    results: &[Register],
) -> Result<HashSet<Register>, TestCaseError> {
    let mut used: HashSet<Register> = results.iter().copied().collect();
    for step in steps {
        match step {
            Step::Let(register) => used.extend(code.get(*register).operands()),
            Step::Write(_, value) => _ = used.insert(value.register),
            Step::Loop { folds, body, .. } => {
                let terms: Vec<Register> = folds.iter().map(|fold| fold.body.register).collect();
                used.extend(self::used(code, body, &terms)?);
            }
        }
    }
    for step in steps {
        match step {
            Step::Let(register) => prop_assert!(used.contains(register), "{register:?} is of no use"),
            Step::Loop { folds, .. } => {
                prop_assert!(folds.iter().all(|fold| used.contains(&fold.result)), "a sum is of no use");
            }
            Step::Write(..) => {}
        }
    }
    Ok(used)
}

/// Runs the statements both ways and compares every entry that is written.
fn check(graph: &Graph, routine: &Routine, point: &Point) -> Result<(), TestCaseError> {
    let Routine { statements, code, steps } = routine;
    used(code, steps, &[])?;
    let mut machine =
        Machine { graph, code, statements, point, registers: HashMap::new(), written: Written::new() };
    machine.run(steps, &Bindings::new());
    let mut expected = Written::new();
    for statement in statements {
        point.passes(&statement.loops, &Bindings::new(), &mut |at| {
            let value = Evaluation::new(graph, point).expr(statement.value, at);
            add(&mut expected, point, &statement.place, at, value);
        });
    }
    prop_assert_eq!(machine.written.len(), expected.len());
    for (place, (value, size)) in &expected {
        let found = machine.written.get(place).map_or(f64::NAN, |(value, _)| *value);
        prop_assert!(
            (found - value).abs() <= 1e-9 * (1.0 + size) || !value.is_finite(),
            "{place}: {found} instead of {value}"
        );
    }
    Ok(())
}

proptest! {
    #![proptest_config(super::configuration(384))]

    #[test]
    fn loops_compute_what_the_graph_says(tree in tree(6), point in point()) {
        check_programs(&tree, &point)?;
    }

    #[test]
    fn loops_compute_nonlinear_functions_of_sums(case in 0..NONLINEAR.len(), point in point()) {
        check_programs(&NONLINEAR[case](), &point)?;
    }
}

/// The functions of a system with this Hamiltonian and α = Σ xⱼ² d(yⱼ), one by one.
fn check_programs(tree: &Tree, point: &Point) -> Result<(), TestCaseError> {
    let size = raw_value(tree, point);
    prop_assume!(size.is_sharp() && size.error < 1e4);
    let mut graph = Graph::new(Vec::new());
    let hamiltonian = tree.lower(&mut graph, 0);
    let one_form = one_form(&mut graph);
    let formulas = DegenerateFormulas {
        one_form,
        hamiltonian,
        gauge: None,
        declared: one_form,
        time: None,
        force: Vec::new(),
        momenta: Vec::new(),
        events: Vec::new(),
    };
    let entries = graph.hessian(one_form);
    let programs = DegeneratePrograms::new(&mut graph, &formulas, &entries, false, None);
    let values = [&programs.shared.lagrangian, &programs.hamiltonian, &programs.hamiltonian_gradient];
    let forms = [
        &programs.shared.gradient,
        &programs.shared.linearize,
        &programs.flow_source,
        &programs.one_form_jacobian,
    ];
    values.into_iter().chain(forms).try_for_each(|routine| check(&graph, routine, point))
}

fn one_form(graph: &mut Graph) -> Expr {
    let index = Index::open(0);
    let x = graph.intern(Node::Coordinate(Coordinate { block: 0, index: index.clone() }));
    let dy = graph.intern(Node::Velocity(Coordinate { block: 1, index }));
    let square = graph.power(x.into(), 2);
    let body = graph.multiply(square, dy.into());
    graph.fold(Fold::Sum, Atom::Open(0), Range::up_to(Index::size(Size(0))), body)
}
