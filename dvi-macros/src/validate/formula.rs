//! A formula as the user wrote it, evaluated as it stands: no name is resolved in advance, nothing is
//! simplified, and derivatives come from arithmetic on jets.

use rustc_hash::{FxHashMap as HashMap, FxHashSet as HashSet};
use std::cell::RefCell;
use std::rc::Rc;

use quote::ToTokens;
use syn::{BinOp, Expr, ExprClosure, Pat, Stmt, UnOp};

use super::jet::Jet;
use super::point::{Branches, Directions, Point, Variable};
use super::system::System;
use crate::internal::internal;
use crate::model::{Extended, Model};
use crate::symbolic::Index;
use crate::work::step;

mod calls;
mod constraints;
mod covectors;
mod indices;
mod locals;
mod places;
mod spinors;
mod vectors;
mod words;

pub(super) use constraints::Combination;
use vectors::Quantity;
use words::{constant, literal_number, place_text};

/// Why there is no value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum NoValue {
    /// An index beyond its array: these sizes do not go together.
    OutOfRange,
    /// More terms than may be evaluated.
    TooLong,
}

type Value<T> = Result<T, NoValue>;

/// What a name of an inner scope stands for.
#[derive(Clone)]
enum Binding<'a> {
    Value(Quantity),
    Shared(Shared<'a>),
    Index(i64),
    /// An argument: what it is as a value, and as an index.
    Argument(Option<Quantity>, Option<i64>),
    /// A function, and the number of names that its body sees.
    Function(Rc<ExprClosure>, usize),
}

/// A name that all formulas share: a part of what is defined behind so many names.
#[derive(Clone, Copy)]
struct Shared<'a> {
    names: &'a Pat,
    init: &'a Expr,
    sees: usize,
    part: usize,
}

/// The names of the scopes that are open.
#[derive(Default)]
struct Scope<'a> {
    names: Vec<Rc<str>>,
    /// What each of them stands for, the bindings scope last.
    bindings: HashMap<Rc<str>, Vec<Binding<'a>>>,
}

impl<'a> Scope<'a> {
    fn push(&mut self, name: Rc<str>, binding: Binding<'a>) {
        self.bindings.entry(name.clone()).or_default().push(binding);
        self.names.push(name);
    }

    fn len(&self) -> usize {
        self.names.len()
    }

    /// Closes the names from `outside` on, and gives what they stood for.
    fn set_aside(&mut self, outside: usize) -> Vec<(Rc<str>, Binding<'a>)> {
        let mut aside = Vec::new();
        while self.names.len() > outside
            && let Some(name) = self.names.pop()
        {
            let binding = self.bindings.get_mut(&name).and_then(Vec::pop);
            aside.extend(binding.map(|binding| (name, binding)));
        }
        aside
    }

    fn put_back(&mut self, aside: Vec<(Rc<str>, Binding<'a>)>) {
        aside.into_iter().rev().for_each(|(name, binding)| self.push(name, binding));
    }

    fn truncate(&mut self, outside: usize) {
        for name in self.names.drain(outside..) {
            self.bindings.entry(name).or_default().pop();
        }
    }
}

/// The names in the text, each made once: by the place of the node that it is the text of. The formulas
/// stay where they are as long as they are checked.
#[derive(Debug, Default)]
pub(super) struct Texts {
    names: RefCell<HashMap<usize, Rc<str>>>,
    /// The functions of the formulas, which stay where they are too.
    functions: RefCell<HashMap<usize, Rc<ExprClosure>>>,
}

impl Texts {
    fn of<T>(&self, node: &T, text: impl FnOnce() -> String) -> Rc<str> {
        let place = std::ptr::from_ref(node) as usize;
        self.names.borrow_mut().entry(place).or_insert_with(|| text().into()).clone()
    }

    fn function(&self, closure: &ExprClosure) -> Rc<ExprClosure> {
        let place = std::ptr::from_ref(closure) as usize;
        self.functions.borrow_mut().entry(place).or_insert_with(|| closure.clone().into()).clone()
    }
}

fn written(node: &impl ToTokens) -> String {
    node.to_token_stream().to_string().replace(' ', "")
}

/// The sides of the conditions that were taken, each by its place in the text.
pub(super) type Sides = HashSet<(usize, bool)>;

pub(super) struct Evaluation<'a> {
    pub(super) model: &'a Model,
    texts: &'a Texts,
    blocks: HashMap<Rc<str>, usize>,
    parameters: HashSet<&'a str>,
    functions: Vec<Rc<str>>,
    pub(super) point: &'a Point,
    pub(super) directions: Directions<'a>,
    /// Velocities are zero, and no direction changes them.
    pub(super) is_still: bool,
    /// Positions move with their velocities, and the time with 1.
    pub(super) moves: bool,
    /// The first direction of positions is their velocity.
    follows: bool,
    /// Operations that may still be carried out.
    pub(super) budget: u64,
    pub(super) sides: Sides,
    /// Whether rounding may decide what comes out: some part of the formulas has a huge value, even if the
    /// whole has not, or two sides of a comparison cannot be told apart.
    pub(super) is_delicate: bool,
    /// At whose zeros what has been evaluated is not smooth, outside of sums.
    pub(super) seams: Vec<Jet>,
    /// The closures around.
    closures: usize,
    scope: Scope<'a>,
    /// The values of shared names that were used, each by the place of its definition and by how it was
    /// asked for.
    known: HashMap<(usize, [bool; 3]), Vec<Quantity>>,
}

impl<'a> Evaluation<'a> {
    pub(super) fn new(
        System { model, attribute, texts }: System<'a>,
        point: &'a Point,
        directions: Directions<'a>,
        budget: u64,
    ) -> Self {
        let coordinates = model.coordinates().into_iter().map(|blocks| {
            let name = &model.blocks[blocks.start].name;
            (texts.of(name, || name.to_string()), blocks.start)
        });
        let own = model.functions.iter();
        let functions = own.map(|own| texts.of(&own.name, || own.name.to_string())).collect();
        let mut evaluation = Self {
            model,
            texts,
            blocks: coordinates.collect(),
            parameters: model.parameters.iter().map(|parameter| parameter.text.as_str()).collect(),
            functions,
            point,
            directions,
            is_still: false,
            moves: false,
            follows: false,
            budget,
            sides: Sides::default(),
            is_delicate: false,
            seams: Vec::new(),
            closures: 0,
            scope: Scope::default(),
            known: HashMap::default(),
        };
        evaluation.share(&attribute.shared);
        evaluation
    }

    /// The rate of the physical time, and the energy that is conjugate to it.
    pub(super) fn conjugates(&self, extended: Extended) -> Value<[Jet; 2]> {
        let velocity = self.variable(Variable::Velocity, extended.time, 0)?;
        Ok([velocity, self.variable(Variable::Position, extended.energy, 0)?])
    }

    /// dF/dt of a gauge F, and what is left of it at v = 0.
    pub(super) fn rates(&mut self, gauge: &Expr) -> Value<[Jet; 2]> {
        self.moves = true;
        let moving = self.number(gauge)?;
        self.is_still = true;
        let still = self.number(gauge)?;
        (self.moves, self.is_still) = (false, false);
        // Where F has no value, its rate has none, even if it does not change.
        let rate =
            |function: Jet| if function.is_moderate() { function.rate() } else { Jet::number(f64::NAN) };
        Ok([rate(moving), rate(still)])
    }

    pub(super) fn number(&mut self, syntax: &Expr) -> Value<Jet> {
        Ok(self.quantity(syntax)?.number(syntax))
    }

    fn quantity(&mut self, syntax: &Expr) -> Value<Quantity> {
        step();
        self.budget = self.budget.checked_sub(1).ok_or(NoValue::TooLong)?;
        let value = self.evaluate(syntax)?;
        self.is_delicate |= value.is_huge();
        Ok(value)
    }

    fn evaluate(&mut self, syntax: &Expr) -> Value<Quantity> {
        let number = |jet| Ok(Quantity::Number(jet));
        match syntax {
            Expr::Lit(literal) => number(Jet::number(literal_number(&literal.lit))),
            Expr::Paren(inner) => self.quantity(&inner.expr),
            Expr::Unary(unary) => Ok(self.quantity(&unary.expr)?.map(|jet| jet.clone().scaled(-1.0))),
            Expr::Binary(binary) => {
                let (left, right) = (self.quantity(&binary.left)?, self.quantity(&binary.right)?);
                match binary.op {
                    BinOp::Add(_) => Ok(left.with(&right, |a, b| a.clone().plus(b))),
                    BinOp::Sub(_) => Ok(left.with(&right, |a, b| a.clone().minus(b.clone()))),
                    BinOp::Mul(_) => Ok(self.scaled(left, &right, false)),
                    BinOp::Div(_) => Ok(self.scaled(left, &right, true)),
                    _ => unknown(syntax),
                }
            }
            Expr::Array(list) => {
                let components: Result<Vec<Jet>, _> =
                    list.elems.iter().map(|component| self.number(component)).collect();
                Ok(Quantity::Vector(components?))
            }
            Expr::Path(path) => self.name(syntax, &path.path),
            Expr::Field(_) | Expr::Index(_) => self.entry(syntax),
            Expr::MethodCall(call) => self.method(call),
            Expr::Call(call) => self.call(call),
            Expr::Cast(cast) if self.is_index(&cast.expr) => {
                number(Jet::number(self.index(&cast.expr)? as f64))
            }
            Expr::Cast(cast) => number(self.number(&cast.expr)?),
            Expr::Block(block) => self.statements(&block.block),
            Expr::If(choice) => {
                let Some((_, otherwise)) = &choice.else_branch else { unknown(syntax) };
                match self.holds(&choice.cond)? {
                    true => self.statements(&choice.then_branch),
                    false => self.quantity(otherwise),
                }
            }
            _ => unknown(syntax),
        }
    }

    fn statements(&mut self, block: &syn::Block) -> Value<Quantity> {
        let outside = self.scope.len();
        let mut value = None;
        for statement in &block.stmts {
            match statement {
                Stmt::Local(local) => {
                    let Some(init) = &local.init else { unknown(local) };
                    self.binding(&local.pat, &init.expr)?;
                }
                Stmt::Expr(expr, None) => value = Some(self.quantity(expr)?),
                _ => unknown(statement),
            }
        }
        self.scope.truncate(outside);
        value.map_or_else(|| unknown(block), Ok)
    }

    /// Whether a condition holds, each of its comparisons taken as the point says.
    fn holds(&mut self, condition: &Expr) -> Value<bool> {
        match condition {
            Expr::Paren(inner) => self.holds(&inner.expr),
            Expr::Unary(unary) if matches!(unary.op, UnOp::Not(_)) => Ok(!self.holds(&unary.expr)?),
            Expr::Binary(binary) => {
                let compared = match binary.op {
                    BinOp::And(_) => return Ok(self.holds(&binary.left)? && self.holds(&binary.right)?),
                    BinOp::Or(_) => return Ok(self.holds(&binary.left)? || self.holds(&binary.right)?),
                    BinOp::Lt(_) => |a: f64, b: f64| a < b,
                    BinOp::Le(_) => |a: f64, b: f64| a <= b,
                    BinOp::Gt(_) => |a: f64, b: f64| a > b,
                    BinOp::Ge(_) => |a: f64, b: f64| a >= b,
                    _ => unknown(condition),
                };
                let (left, right) = (self.number(&binary.left)?, self.number(&binary.right)?);
                self.is_delicate |= !left.value().is_distinct_from(right.value());
                self.note_seam(|| left.clone().minus(right.clone()));
                Ok(self.side(binary, compared(left.value().value, right.value().value)))
            }
            _ => unknown(condition),
        }
    }

    /// Notes that what is evaluated is not smooth at the zeros of a number.
    fn note_seam(&mut self, seam: impl FnOnce() -> Jet) {
        if self.closures == 0 {
            self.seams.push(seam());
        }
    }

    /// The side of a comparison that is taken.
    fn side<T>(&mut self, place: &T, holds: bool) -> bool {
        let side = holds != (self.point.branches == Branches::Exchanged);
        self.sides.insert((std::ptr::from_ref(place) as usize, side));
        side
    }

    fn bound(&self, name: &str) -> Option<Binding<'a>> {
        self.scope.bindings.get(name).and_then(|bindings| bindings.last()).cloned()
    }

    fn name(&mut self, syntax: &Expr, path: &syn::Path) -> Value<Quantity> {
        let text = self.texts.of(syntax, || written(path));
        match self.bound(&text) {
            Some(Binding::Value(value) | Binding::Argument(Some(value), _)) => return Ok(value),
            Some(Binding::Shared(shared)) => return self.shared(shared),
            Some(Binding::Argument(None, _) | Binding::Index(_) | Binding::Function(..)) | None => {}
        }
        if self.block(&text).is_some() || self.parameter(&text).is_some() {
            return self.entry(syntax);
        }
        if let Some(size) = self.size(&text) {
            return Ok(Quantity::Number(Jet::number(size as f64)));
        }
        if let Some(value) = constant(&text) {
            return Ok(Quantity::Number(Jet::number(value)));
        }
        match &*text {
            "t" => {
                let time = Jet::variable(self.point.time(), [0.0, 0.0, 1.0, 0.0], [0.0; 2]);
                Ok(Quantity::Number(if self.moves { time.moving(Jet::number(1.0)) } else { time }))
            }
            _ => unknown(syntax),
        }
    }

    fn block(&self, name: &str) -> Option<usize> {
        self.blocks.get(name).copied()
    }

    fn parameter(&self, name: &str) -> Option<&'a str> {
        self.parameters.get(name).copied()
    }

    fn size(&self, name: &str) -> Option<i64> {
        let number = self.model.sizes.iter().position(|size| size.text == name)?;
        self.point.size(number)
    }

    fn block_size(&self, block: usize) -> i64 {
        self.length(&self.model.block_size(block))
    }

    fn length(&self, size: &Index) -> i64 {
        match self.point.length(size) {
            Some(size) => size,
            None => internal("a size without a value"),
        }
    }
}

/// What the stages before have admitted, and this one does not know.
fn unknown(syntax: &impl ToTokens) -> ! {
    internal(format!("the self-check cannot read `{}`", syntax.to_token_stream()))
}
