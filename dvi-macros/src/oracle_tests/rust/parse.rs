//! Printed Rust to its tree.

use std::collections::HashMap;

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use quote::ToTokens;
use syn::{
    BinOp, Expr, ExprArray, ExprGroup, ExprParen, ExprReference, ExprTuple, FnArg, ImplItem, ItemImpl, Lit,
    Pat, PatSlice, PatTuple, RangeLimits, Stmt, UnOp,
};

use super::code::{Code, Function, Pattern};
use super::functions::{Callee, callee};
use super::literals::{arm_value, kind, literal_value};
use super::value::Value;

/// The generated functions and constants of a system, by name.
#[derive(Debug, Default)]
pub(crate) struct Expansion {
    pub(super) functions: HashMap<String, Function>,
    pub(crate) constants: HashMap<String, bool>,
    /// The number of seams.
    pub(crate) seams: usize,
    /// The paths of the user's functions by the names that formulas call them by.
    pub(super) own: HashMap<String, String>,
    /// The places of their functions of several variables, likewise.
    pub(super) scalar_fields: HashMap<String, String>,
}

/// Functions that are not interpreted.
const UNREAD: [&str; 3] = ["space", "outside", "time_transform"];

/// The traits whose functions are generated.
pub(super) const TRAITS: [&str; 7] = [
    "System",
    "Lagrangian",
    "DegenerateLagrangian",
    "NondegenerateLagrangian",
    "HolonomicLagrangian",
    "NonholonomicLagrangian",
    "UnilateralLagrangian",
];

pub(super) fn unknown(what: &str, tokens: &impl ToTokens) -> ! {
    panic!("the interpreter does not know this {what}: {}", tokens.to_token_stream())
}

impl Expansion {
    pub(crate) fn new(tokens: TokenStream) -> Self {
        let mut expansion = Self::default();
        expansion.items(tokens);
        expansion
    }

    /// Reads the items of one level. Where they end is seen before they are parsed, because most of them are
    /// not read.
    fn items(&mut self, tokens: TokenStream) {
        let mut item = Vec::new();
        for token in tokens {
            let ends = match &token {
                TokenTree::Group(group) => group.delimiter() == Delimiter::Brace,
                TokenTree::Punct(punct) => punct.as_char() == ';',
                TokenTree::Ident(_) | TokenTree::Literal(_) => false,
            };
            item.push(token);
            if ends {
                self.item(std::mem::take(&mut item));
            }
        }
        assert!(item.is_empty(), "the expansion ends within an item: {}", TokenStream::from_iter(item));
    }

    fn item(&mut self, item: Vec<TokenTree>) {
        let has =
            |name: &str| item.iter().any(|token| matches!(token, TokenTree::Ident(ident) if ident == name));
        if has("impl") {
            if !has("for") || TRAITS.iter().any(|name| has(name)) {
                let implementation = syn::parse2(item.into_iter().collect());
                self.implementation(&implementation.expect("the expansion is Rust"));
            }
        } else if let Some(TokenTree::Group(inside)) = item.last()
            && has("_")
        {
            // `const _: () = { … };`
            self.items(inside.stream());
        }
    }

    fn implementation(&mut self, implementation: &ItemImpl) {
        let name = implementation.trait_.as_ref().and_then(|(path, _)| path.segments.last());
        if name.is_some_and(|name| TRAITS.iter().any(|known| name.ident == known)) {
            implementation.items.iter().for_each(|item| self.member(item));
        } else if name.is_none() {
            implementation.items.iter().for_each(|item| self.own_function(item));
        }
    }

    /// `fn __function0_1<T>(x: T) -> T { let function: fn(T) -> T = path; function(x) }`
    fn own_function(&mut self, item: &ImplItem) {
        if let ImplItem::Fn(function) = item
            && let Some(Stmt::Local(local)) = function.block.stmts.first()
            && let Some(init) = &local.init
        {
            let path = init.expr.to_token_stream().to_string().replace(' ', "");
            self.own.insert(function.sig.ident.to_string(), path);
        }
        // `fn __scalar_field0<T>(&self, at: [T; 2]) -> … { ScalarField::<2>::expansion(&self.psi, at) }`
        if let ImplItem::Fn(function) = item
            && let Some(Stmt::Expr(Expr::Call(call), None)) = function.block.stmts.first()
            && let Some(Expr::Reference(place)) = call.args.first()
        {
            let place = place.expr.to_token_stream().to_string().replace(' ', "");
            self.scalar_fields.insert(function.sig.ident.to_string(), place);
        }
    }

    fn member(&mut self, item: &ImplItem) {
        match item {
            ImplItem::Const(constant) => {
                let Expr::Lit(literal) = &constant.expr else { return };
                match &literal.lit {
                    Lit::Bool(value) => {
                        self.constants.insert(constant.ident.to_string(), value.value);
                    }
                    Lit::Int(value) if constant.ident == "SEAMS" => {
                        self.seams = value.base10_parse().expect("a count");
                    }
                    _ => {}
                }
            }
            // The shape of the configuration space is a type; dimensions are compared by `block_len`. What
            // is said of a point outside of a table is text, and ρ with H are compared in the self-check and
            // by values.
            ImplItem::Fn(function) if !UNREAD.contains(&function.sig.ident.to_string().as_str()) => {
                self.functions.insert(function.sig.ident.to_string(), Parser::function(function));
            }
            _ => {}
        }
    }
}

/// Names in scope, each with its slot.
#[derive(Default)]
struct Parser {
    scope: Vec<(String, usize)>,
    slots: usize,
}

impl Parser {
    fn function(function: &syn::ImplItemFn) -> Function {
        let mut parser = Self::default();
        let mut parameters = 0;
        for input in &function.sig.inputs {
            if let FnArg::Typed(typed) = input {
                parser.pattern(&typed.pat);
                parameters += 1;
            }
        }
        let body = parser.block(&function.block);
        Function { parameters, slots: parser.slots, body }
    }

    fn pattern(&mut self, pattern: &Pat) -> Pattern {
        match pattern {
            Pat::Ident(name) if name.subpat.is_none() => {
                self.scope.push((name.ident.to_string(), self.slots));
                self.slots += 1;
                Pattern::Slot(self.slots - 1)
            }
            Pat::Wild(_) => Pattern::Ignored,
            Pat::Type(typed) => self.pattern(&typed.pat),
            Pat::Tuple(PatTuple { elems, .. }) | Pat::Slice(PatSlice { elems, .. }) => {
                Pattern::Tuple(elems.iter().map(|element| self.pattern(element)).collect())
            }
            other => unknown("pattern", other),
        }
    }

    fn block(&mut self, block: &syn::Block) -> Code {
        let outside = self.scope.len();
        let mut steps = Vec::new();
        for statement in &block.stmts {
            match statement {
                Stmt::Local(local) => {
                    let Some(init) = &local.init else { unknown("statement", local) };
                    let value = self.expr(&init.expr);
                    let pattern = self.pattern(&local.pat);
                    steps.push(Code::Let(pattern, Box::new(value)));
                }
                Stmt::Expr(expr, semicolon) => {
                    steps.push(self.expr(expr));
                    if semicolon.is_some() {
                        steps.push(Code::Value(Value::Unit));
                    }
                }
                other => unknown("statement", other),
            }
        }
        self.scope.truncate(outside);
        Code::Block(steps)
    }

    fn boxed(&mut self, expr: &Expr) -> Box<Code> {
        Box::new(self.expr(expr))
    }

    fn expr(&mut self, expr: &Expr) -> Code {
        match expr {
            Expr::Paren(ExprParen { expr, .. })
            | Expr::Group(ExprGroup { expr, .. })
            | Expr::Reference(ExprReference { expr, .. }) => self.expr(expr),
            Expr::Block(block) => self.block(&block.block),
            Expr::Lit(literal) => Code::Value(literal_value(&literal.lit)),
            Expr::Path(path) => self.path(path),
            Expr::Field(field) => {
                Code::Field(self.boxed(&field.base), field.member.to_token_stream().to_string())
            }
            Expr::Index(index) if matches!(&*index.index, Expr::Range(all) if all.start.is_none() && all.end.is_none()) => {
                self.expr(&index.expr)
            }
            Expr::Index(index) => Code::Index(self.boxed(&index.expr), self.boxed(&index.index)),
            Expr::Unary(unary) => match unary.op {
                UnOp::Neg(_) => Code::Negative(self.boxed(&unary.expr)),
                UnOp::Not(_) => Code::Not(self.boxed(&unary.expr)),
                _ => unknown("operator", unary),
            },
            Expr::Binary(binary) => self.binary(binary),
            Expr::Assign(assign) => Code::Assign(None, self.boxed(&assign.left), self.boxed(&assign.right)),
            Expr::Call(call) => {
                let Expr::Path(path) = &*call.func else { unknown("call", call) };
                if segments(path).last().is_some_and(|name| name == "halves") {
                    return self.halves(call);
                }
                let arguments = call.args.iter().map(|argument| self.expr(argument)).collect();
                called(&segments(path), arguments)
            }
            Expr::MethodCall(call) => {
                let receiver = self.boxed(&call.receiver);
                let arguments = call.args.iter().map(|argument| self.expr(argument)).collect();
                method(receiver, call.method.to_string(), arguments)
            }
            // What runs compiled for another processor is the same.
            Expr::Closure(closure) if closure.inputs.is_empty() => self.expr(&closure.body),
            Expr::Cast(cast) => Code::Cast(self.boxed(&cast.expr), kind(&cast.ty)),
            Expr::Tuple(tuple) if tuple.elems.is_empty() => Code::Value(Value::Unit),
            Expr::Array(ExprArray { elems, .. }) | Expr::Tuple(ExprTuple { elems, .. }) => {
                Code::Tuple(elems.iter().map(|element| self.expr(element)).collect())
            }
            Expr::If(choice) => {
                let (condition, then) = (self.boxed(&choice.cond), self.block(&choice.then_branch));
                let otherwise = choice.else_branch.as_ref().map(|(_, expr)| self.boxed(expr));
                Code::If(condition, Box::new(then), otherwise)
            }
            Expr::Match(choice) => {
                let value = self.boxed(&choice.expr);
                let arms =
                    choice.arms.iter().map(|arm| (arm_value(&arm.pat), self.expr(&arm.body))).collect();
                Code::Match(value, arms)
            }
            Expr::ForLoop(repeated) => self.repeated(repeated),
            Expr::Return(returned) => Code::Return(
                returned.expr.as_ref().map_or_else(|| Box::new(Code::Value(Value::Unit)), |e| self.boxed(e)),
            ),
            Expr::Continue(_) => Code::Continue,
            Expr::Try(tried) => Code::Try(self.boxed(&tried.expr)),
            other => unknown("expression", other),
        }
    }

    /// The pairs of many bodies.
    fn halves(&mut self, call: &syn::ExprCall) -> Code {
        let mut arguments = call.args.iter();
        let (Some(bodies), Some(entries), Some(Expr::Closure(row))) =
            (arguments.next(), arguments.next(), arguments.next())
        else {
            unknown("call", call)
        };
        let (bodies, entries) = (self.boxed(bodies), self.boxed(entries));
        let outside = self.scope.len();
        let patterns: Vec<Pattern> = row.inputs.iter().map(|input| self.pattern(input)).collect();
        let body = self.boxed(&row.body);
        self.scope.truncate(outside);
        let patterns = patterns.try_into().unwrap_or_else(|_| unknown("closure", row));
        Code::Halves(bodies, entries, patterns, body)
    }

    fn path(&mut self, path: &syn::ExprPath) -> Code {
        let segments = segments(path);
        if let [name] = segments.as_slice() {
            if name == "self" {
                return Code::Value(Value::System);
            }
            let known = self.scope.iter().rev().find(|(known, _)| known == name);
            return known.map_or_else(|| Code::Named(name.clone()), |(_, slot)| Code::Slot(*slot));
        }
        match segments.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
            [.., "Comparison", relation] => Code::Value(Value::Text((*relation).to_string())),
            [.., "f64", "NAN"] => Code::Value(Value::Real(f64::NAN)),
            [.., "f64", "INFINITY"] => Code::Value(Value::Real(f64::INFINITY)),
            _ => unknown("path", path),
        }
    }

    fn binary(&mut self, binary: &syn::ExprBinary) -> Code {
        let (left, right) = (self.boxed(&binary.left), self.boxed(&binary.right));
        let operator = match binary.op {
            BinOp::AddAssign(_) => plus(),
            BinOp::SubAssign(_) => minus(),
            operator => return Code::Binary(operator, left, right),
        };
        Code::Assign(Some(operator), left, right)
    }

    fn repeated(&mut self, repeated: &syn::ExprForLoop) -> Code {
        let bounds = match &*repeated.expr {
            Expr::Range(range) if matches!(range.limits, RangeLimits::HalfOpen(_)) => {
                range.start.as_deref().zip(range.end.as_deref())
            }
            // Packs of one.
            Expr::Call(call) => match &*call.func {
                Expr::Path(path) if segments(path).last().is_some_and(|name| name == "packs") => {
                    call.args.first().zip(call.args.last())
                }
                _ => None,
            },
            _ => None,
        };
        let Some((start, end)) = bounds else { unknown("loop", repeated) };
        let (lower, upper) = (self.boxed(start), self.boxed(end));
        let outside = self.scope.len();
        let pattern = self.pattern(&repeated.pat);
        let body = self.block(&repeated.body);
        self.scope.truncate(outside);
        Code::For(pattern, lower, upper, Box::new(body))
    }
}

fn plus() -> BinOp {
    BinOp::Add(Default::default())
}

fn minus() -> BinOp {
    BinOp::Sub(Default::default())
}

/// A call. Packs hold one term each, and so are numbers.
fn called(path: &[String], arguments: Vec<Code>) -> Code {
    let mut given = arguments.clone().into_iter().map(Box::new);
    let mut next = || given.next().unwrap_or_else(|| panic!("an argument of {}", path.join("::")));
    match path.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
        [.., "__private", "all"] => *next(),
        [.., "__private", "load"] => Code::Index(next(), next()),
        [.., "__private", "parameters"] => Code::Call(Callee::Number, vec![Code::Index(next(), next())]),
        [.., "__private", "add_to"] => {
            Code::Assign(Some(plus()), Box::new(Code::Index(next(), next())), next())
        }
        [.., "Sums", "empty"] => Code::Value(Value::Real(-0.0)),
        [.., "__private", "widest"] => {
            next();
            *next()
        }
        _ => Code::Call(callee(path), arguments),
    }
}

/// A call of a method; the sum of packs of one is a number.
fn method(receiver: Box<Code>, name: String, mut arguments: Vec<Code>) -> Code {
    match name.as_str() {
        "add_terms" => {
            let terms = arguments.pop().unwrap_or_else(|| panic!("terms to add"));
            Code::Assign(Some(plus()), receiver, Box::new(terms))
        }
        "total" => *receiver,
        _ => Code::Method(receiver, name, arguments),
    }
}

/// The segments of a path; `<T as Trait>::name` is `Trait::name`.
fn segments(path: &syn::ExprPath) -> Vec<String> {
    path.path.segments.iter().map(|segment| segment.ident.to_string()).collect()
}
