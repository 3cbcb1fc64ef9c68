//! Formulas as text: as on paper, for documentation and reports, or in the language of the attribute.

mod letters;

use rustc_hash::FxHashMap as HashMap;

use crate::internal::internal;
use crate::model::Model;
use crate::symbolic::{Binary, Coordinate, Expr, Fold, Graph, Id, Index, Loop, Node, Partial, Relation};
use letters::{Letters, Notation, letter};

/// How tightly the text of an expression holds together.
#[derive(Clone, Copy, PartialEq, PartialOrd)]
enum Strength {
    Sum,
    Product,
    Atom,
}

/// The letters outside of all sums.
fn open_letters(model: &Model) -> Letters<'_> {
    Letters { model, depth: 0, sums: Vec::new(), notation: Notation::Paper }
}

pub(crate) fn print_loops(loops: &[Loop], model: &Model) -> String {
    let letters = open_letters(model);
    let one = |one: &Loop| letters.range(&letter(one.depth as usize), &one.range);
    loops.iter().map(one).collect::<Vec<_>>().join(", ")
}

/// The text of an index outside of all sums.
pub(crate) fn print_index(index: &Index, model: &Model) -> String {
    open_letters(model).index(index)
}

pub(crate) fn print_velocity(coordinate: &Coordinate, model: &Model) -> String {
    open_letters(model).velocity(coordinate)
}

pub(crate) fn print_coordinate(coordinate: &Coordinate, model: &Model) -> String {
    open_letters(model).coordinate(coordinate)
}

/// Beyond this many nodes nobody reads a formula.
const LONGEST: u64 = 1000;

/// The text of an expression inside of `depth` loops, unless it is too long: shared parts are written out
/// each time.
pub(crate) fn print_expr(graph: &Graph, expr: Expr, depth: usize, model: &Model) -> String {
    let nodes = written_out(graph, expr.node);
    if nodes > LONGEST {
        return format!("… ({nodes} operations)");
    }
    let letters = Letters { depth, ..open_letters(model) };
    Printer { graph, letters }.expr(expr, Strength::Sum)
}

/// The text of an expression in the language of the attribute, unless it is too long or something stands in
/// it that has no word there.
pub(crate) fn write_expr(graph: &Graph, expr: Expr, model: &Model) -> Option<String> {
    let can_be_written = |id: Id| match graph.node(id) {
        Node::Weight(_) => false,
        Node::Unary(function, _) => function.is_written(),
        Node::Binary(function, ..) => *function != Binary::OverRoot,
        Node::Call(_, order, _) => *order == 0,
        Node::ScalarField(_, partial, _) => *partial == Partial::Value,
        Node::Choose { relation, .. } => *relation != Relation::HasMore,
        Node::Reduce { range, .. } => range.left_out().next().is_none(),
        _ => true,
    };
    let all = graph.reachable([expr.node]).into_iter().all(can_be_written);
    let letters = Letters { notation: Notation::Language, ..open_letters(model) };
    (all && written_out(graph, expr.node) <= LONGEST)
        .then(|| Printer { graph, letters }.expr(expr, Strength::Sum))
}

/// The number of nodes of an expression as a tree.
fn written_out(graph: &Graph, root: Id) -> u64 {
    let mut sizes: HashMap<Id, u64> = HashMap::default();
    for id in graph.reachable([root]) {
        let operands = graph.node(id).operands();
        let size = operands.iter().fold(1_u64, |size, operand| size.saturating_add(sizes[operand]));
        sizes.insert(id, size);
    }
    sizes[&root]
}

struct Printer<'a> {
    graph: &'a Graph,
    letters: Letters<'a>,
}

impl Printer<'_> {
    fn expr(&self, expr: Expr, around: Strength) -> String {
        let (text, strength) = self.signed(expr);
        let negative = text.starts_with('-') && around > Strength::Sum;
        if strength < around || negative { format!("({text})") } else { text }
    }

    fn signed(&self, expr: Expr) -> (String, Strength) {
        if let Some(value) = expr.as_number() {
            return (self.number(value), Strength::Atom);
        }
        if expr.scale == 1.0 {
            return self.node(expr.node);
        }
        if expr.scale == -1.0 {
            return (format!("-{}", self.expr(expr.node.into(), Strength::Product)), Strength::Product);
        }
        let body = self.expr(expr.node.into(), Strength::Product);
        (format!("{}{}{body}", self.number(expr.scale), self.letters.times()), Strength::Product)
    }

    fn number(&self, value: f64) -> String {
        match self.letters.notation {
            Notation::Paper => number(value),
            Notation::Language => format!("{value:?}"),
        }
    }

    /// f(a), or a.f() as the language has it.
    fn call(&self, name: &str, arguments: &[Expr]) -> (String, Strength) {
        let listed = |arguments: &[Expr]| {
            let arguments: Vec<String> = arguments.iter().map(|a| self.expr(*a, Strength::Sum)).collect();
            arguments.join(", ")
        };
        let text = match (self.letters.notation, arguments) {
            (Notation::Language, [receiver, rest @ ..]) => {
                format!("{}.{name}({})", self.expr(*receiver, Strength::Atom), listed(rest))
            }
            _ => format!("{name}({})", listed(arguments)),
        };
        (text, Strength::Atom)
    }

    fn node(&self, id: Id) -> (String, Strength) {
        match self.graph.node(id) {
            Node::One => ("1".into(), Strength::Atom),
            Node::Coordinate(c) => (self.letters.coordinate(c), Strength::Atom),
            Node::Velocity(c) => (self.letters.velocity(c), Strength::Atom),
            Node::Time => ("t".into(), Strength::Atom),
            Node::Parameter(p) => {
                let indices: String =
                    p.indices.iter().map(|index| format!("[{}]", self.letters.index(index))).collect();
                let name = self.letters.name(&self.letters.model.parameters[p.field as usize].text);
                (format!("{name}{indices}"), Strength::Atom)
            }
            Node::Count(index) => {
                let index = self.letters.index(index);
                let text = match self.letters.notation {
                    Notation::Paper => format!("({index})"),
                    Notation::Language => format!("(({index}) as f64)"),
                };
                (text, Strength::Atom)
            }
            Node::Weight(_) => internal("what the caller of a function passes in stands in no formula"),
            Node::Sum(terms) => (self.sum(terms), Strength::Sum),
            Node::Product(factors) => (self.quotient(factors), Strength::Product),
            Node::Reciprocal(_) => (self.quotient(&[(id, 1)]), Strength::Product),
            Node::Unary(function, u) => self.call(function.name(), &[*u]),
            Node::Binary(Binary::OverSquares, ..) => (self.quotient(&[(id, 1)]), Strength::Product),
            Node::Binary(function, a, b) => self.call(function.name(), &[*a, *b]),
            Node::Call(function, order, u) => {
                let function = &self.letters.model.functions[*function as usize];
                let name = self.letters.name(&function.name.to_string());
                let name = format!("{name}{}", "'".repeat(*order as usize));
                (format!("{name}({})", self.expr(*u, Strength::Sum)), Strength::Atom)
            }
            Node::ScalarField(field, partial, at) => {
                let name = self.letters.name(&self.letters.model.scalar_fields[*field as usize].text);
                let arguments: Vec<String> = at.iter().map(|a| self.expr(*a, Strength::Sum)).collect();
                (format!("{}{name}({})", derivatives(*partial), arguments.join(", ")), Strength::Atom)
            }
            Node::Choose { left, relation, right, then, otherwise } => {
                let sign = match relation {
                    Relation::Less => "<",
                    Relation::LessOrEqual => "<=",
                    Relation::Greater | Relation::HasMore => ">",
                    Relation::GreaterOrEqual => ">=",
                };
                let [left, right, then, otherwise] =
                    [left, right, then, otherwise].map(|part| self.expr(*part, Strength::Sum));
                (format!("(if {left} {sign} {right} {{ {then} }} else {{ {otherwise} }})"), Strength::Atom)
            }
            Node::Reduce { fold, height, range, body } => {
                let own = self.letters.letter(self.letters.depth + self.letters.sums.len());
                let inside = Printer { graph: self.graph, letters: self.letters.inside(*height) };
                if self.letters.notation == Notation::Language {
                    let [lower, upper] = [&range.lower, &range.upper].map(|index| self.letters.index(index));
                    let word = match fold {
                        Fold::Sum => "sum",
                        Fold::Product => "product",
                    };
                    let body = inside.expr(*body, Strength::Sum);
                    return (format!("{word}({lower}..{upper}, |{own}| {body})"), Strength::Atom);
                }
                let range = self.letters.range(&own, range);
                let sign = match fold {
                    Fold::Sum => "Σ",
                    Fold::Product => "Π",
                };
                (format!("{sign}({range}) {}", inside.expr(*body, Strength::Product)), Strength::Product)
            }
        }
    }

    fn sum(&self, terms: &[Expr]) -> String {
        // A positive term first reads best, and the constant last.
        let mut order: Vec<&Expr> = terms.iter().collect();
        order.sort_by_key(|term| (term.scale < 0.0, term.node == Graph::ONE));
        let mut text = String::new();
        for term in order {
            if text.is_empty() {
                text = self.expr(*term, Strength::Sum);
            } else {
                let sign = if term.scale < 0.0 { "-" } else { "+" };
                text +=
                    &format!(" {sign} {}", self.expr(term.scaled(term.scale.signum()), Strength::Product));
            }
        }
        text
    }

    fn quotient(&self, factors: &[(Id, u32)]) -> String {
        let raised = |base: String, exponent: u32| match (exponent, self.letters.notation) {
            (1, _) => base,
            (_, Notation::Paper) => format!("{base}^{exponent}"),
            (_, Notation::Language) => format!("{base}.powi({exponent})"),
        };
        let power = |of: Expr, exponent: u32| raised(self.expr(of, Strength::Atom), exponent);
        let (mut above, mut below) = (Vec::new(), Vec::new());
        for (factor, exponent) in factors {
            match self.graph.node(*factor) {
                Node::Reciprocal(of) => below.push(power((*of).into(), *exponent)),
                Node::Binary(Binary::OverSquares, u, w) => {
                    let (first, second) = if u.node < w.node { (*u, *w) } else { (*w, *u) };
                    let squares = format!("({} + {})", power(first, 2), power(second, 2));
                    above.push(power(*u, *exponent));
                    below.push(raised(squares, *exponent));
                }
                _ => above.push(power((*factor).into(), *exponent)),
            }
        }
        let times = self.letters.times();
        let above = if above.is_empty() { "1".into() } else { above.join(times) };
        match below.as_slice() {
            [] => above,
            [single] => format!("{above}/{single}"),
            several => format!("{above}/({})", several.join(times)),
        }
    }
}

/// A literal, or the multiple of π that it is.
fn number(value: f64) -> String {
    const PI_PARTS: [f64; 6] = [1.0, 2.0, 4.0, 8.0, 3.0, 6.0];
    for part in PI_PARTS {
        let multiple = value * part / std::f64::consts::PI;
        if multiple.round() == multiple && multiple != 0.0 && multiple.abs() < 10.0 && value.abs() > 0.1 {
            return if part == 1.0 { format!("{multiple}π") } else { format!("({multiple}π/{part})") };
        }
        let inverse = 1.0 / (value.abs() * std::f64::consts::PI * part);
        if (inverse - 1.0).abs() < 4.0 * f64::EPSILON {
            let sign = if value < 0.0 { "-" } else { "" };
            return if part == 1.0 { format!("{sign}(1/π)") } else { format!("{sign}(1/{part}π)") };
        }
    }
    if value == value.round() && value.abs() < 1e15 { format!("{value}") } else { format!("{value:?}") }
}

/// ∂₁∂₂ in front of the name of a function of several variables.
fn derivatives(partial: Partial) -> String {
    partial.axes().into_iter().map(|axis| format!("∂{}", subscript(axis + 1))).collect()
}

fn subscript(number: usize) -> String {
    let digits = number.to_string();
    digits.chars().filter_map(|digit| char::from_u32('₀' as u32 + digit as u32 - '0' as u32)).collect()
}
