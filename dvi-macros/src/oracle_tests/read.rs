//! Text to the tree of the oracle, for systems that are written by hand.

use syn::{BinOp, Expr, Lit, Pat, RangeLimits, Stmt, UnOp};

use super::formula::{Atom, Condition, Formula, Index, Loops, Relation};
use super::functions::{BinaryFunction, UNARY};
use super::system::System;

/// Reads formulas over the declarations of a system.
pub(super) struct Reader<'a> {
    pub(super) system: &'a System,
    indices: Vec<String>,
}

impl<'a> Reader<'a> {
    pub(super) fn formula(system: &'a System, text: &str) -> Formula {
        let expr: Expr = syn::parse_str(text).expect("a formula is an expression of Rust");
        Reader { system, indices: Vec::new() }.expr(&expr)
    }

    fn boxed(&mut self, expr: &Expr) -> Box<Formula> {
        Box::new(self.expr(expr))
    }

    fn expr(&mut self, expr: &Expr) -> Formula {
        match expr {
            Expr::Paren(inner) => self.expr(&inner.expr),
            Expr::Lit(literal) => match &literal.lit {
                Lit::Int(value) => Formula::Number(value.to_string().leak()),
                Lit::Float(value) => Formula::Number(value.to_string().leak()),
                _ => panic!("no number"),
            },
            Expr::Unary(unary) if matches!(unary.op, UnOp::Neg(_)) => {
                Formula::Negative(self.boxed(&unary.expr))
            }
            Expr::Binary(binary) => {
                let (a, b) = (self.expr(&binary.left), self.expr(&binary.right));
                match binary.op {
                    BinOp::Add(_) => a.plus(b),
                    BinOp::Sub(_) => a.minus(b),
                    BinOp::Mul(_) => a.times(b),
                    BinOp::Div(_) => a.over(b),
                    _ => panic!("no operator of formulas"),
                }
            }
            Expr::Cast(cast) => Formula::Count(self.index(&cast.expr)),
            Expr::Path(path) => self.place(&path.path.require_ident().expect("a name").to_string(), &[]),
            Expr::Index(index) => {
                let Expr::Path(path) = &*index.expr else { panic!("only names are indexed") };
                let place = [self.index(&index.index)];
                self.place(&path.path.require_ident().expect("a name").to_string(), &place)
            }
            Expr::If(choice) => {
                let condition = self.condition(&choice.cond);
                let then = self.block(&choice.then_branch);
                let (_, otherwise) = choice.else_branch.as_ref().expect("a choice has two branches");
                Formula::If(Box::new(condition), Box::new(then), self.boxed(otherwise))
            }
            Expr::Block(block) => self.block(&block.block),
            Expr::MethodCall(call) => {
                let of = self.boxed(&call.receiver);
                let name = call.method.to_string();
                let argument = call.args.first();
                if name == "powi" {
                    return Formula::Power(of, self.index(argument.expect("an exponent")).constant as i32);
                }
                let binary = BinaryFunction::ALL.into_iter().find(|function| function.name() == name);
                if let Some(function) = binary {
                    return Formula::Binary(function, of, self.boxed(argument.expect("an argument")));
                }
                let function = UNARY.iter().find(|function| function.name == name);
                Formula::Unary(*function.unwrap_or_else(|| panic!("no function {name}")), of)
            }
            Expr::Call(call) => {
                let Expr::Path(path) = &*call.func else { panic!("only names are called") };
                let name = path.path.require_ident().expect("a name").to_string();
                match name.as_str() {
                    "d" | "dot" => match self.expr(&call.args[0]) {
                        Formula::Coordinate(block, index) => Formula::Velocity(block, index),
                        other => panic!("{other:?} has no velocity"),
                    },
                    _ => self.sum(&name, &call.args[0], &call.args[1]),
                }
            }
            _ => panic!("the reader does not know this expression"),
        }
    }

    fn block(&mut self, block: &syn::Block) -> Formula {
        match block.stmts.as_slice() {
            [Stmt::Expr(value, None)] => self.expr(value),
            _ => panic!("the reader knows no `let`"),
        }
    }

    fn sum(&mut self, name: &str, range: &Expr, body: &Expr) -> Formula {
        let (Expr::Range(range), Expr::Closure(closure)) = (range, body) else {
            panic!("sum(range, closure)")
        };
        assert!(matches!(range.limits, RangeLimits::HalfOpen(_)));
        let end = |end: &Option<Box<Expr>>| self.index(end.as_ref().expect("a bound"));
        let (lower, upper) = (end(&range.start), end(&range.end));
        let loops = match name {
            "sum" => Loops::Single,
            "product" => Loops::Product,
            "sum_pairs" => Loops::Pairs,
            "sum_ordered_pairs" => Loops::OrderedPairs,
            _ => panic!("no sum {name}"),
        };
        let level = self.indices.len();
        self.indices.extend(closure.inputs.iter().map(|input| match input {
            Pat::Ident(name) => name.ident.to_string(),
            _ => panic!("an index is a name"),
        }));
        let body = self.boxed(&closure.body);
        self.indices.truncate(level);
        Formula::Sum(loops, level, lower, upper, body)
    }

    fn condition(&mut self, expr: &Expr) -> Condition {
        let Expr::Binary(binary) = expr else { panic!("a condition compares") };
        let relation = match binary.op {
            BinOp::Or(_) => {
                let (a, b) = (self.condition(&binary.left), self.condition(&binary.right));
                return Condition::Or(Box::new(a), Box::new(b));
            }
            BinOp::Lt(_) => Relation::Less,
            BinOp::Gt(_) => Relation::Greater,
            _ => panic!("the reader does not know this condition"),
        };
        Condition::Compare(self.expr(&binary.left), relation, self.expr(&binary.right))
    }

    /// A coordinate, a parameter, a constant or time.
    fn place(&self, name: &str, indices: &[Index]) -> Formula {
        if let Some(block) = self.system.blocks.iter().position(|block| block.name == name) {
            return Formula::Coordinate(block, indices.first().cloned());
        }
        if let Some(field) = self.system.fields.iter().position(|field| field.name == name) {
            return Formula::Parameter(field, indices.to_vec());
        }
        match name {
            "t" => Formula::Time,
            "PI" => Formula::Pi,
            _ => panic!("nothing is called {name}"),
        }
    }

    fn index(&self, expr: &Expr) -> Index {
        match expr {
            Expr::Paren(inner) => self.index(&inner.expr),
            Expr::Lit(literal) => match &literal.lit {
                Lit::Int(value) => Index::literal(value.base10_parse().expect("an integer")),
                _ => panic!("an index is an integer"),
            },
            Expr::Unary(unary) => scaled(&self.index(&unary.expr), -1),
            Expr::Path(path) => {
                let name = path.path.require_ident().expect("a name").to_string();
                let bound = self.indices.iter().position(|known| *known == name);
                let size = || (0..self.system.sizes.len()).find(|size| self.system.size_name(*size) == name);
                let atom =
                    bound.map_or_else(|| Atom::Size(size().expect("an index or a size")), Atom::Bound);
                Index::atom(atom)
            }
            Expr::Binary(binary) => {
                let (a, b) = (self.index(&binary.left), self.index(&binary.right));
                match binary.op {
                    BinOp::Add(_) => sum(a, &b),
                    BinOp::Sub(_) => sum(a, &scaled(&b, -1)),
                    BinOp::Rem(_) => a.modulo(b),
                    _ => panic!("the reader does not know this index"),
                }
            }
            _ => panic!("the reader does not know this index"),
        }
    }
}

fn scaled(index: &Index, factor: i64) -> Index {
    let terms = index.terms.iter().map(|(atom, coefficient)| (atom.clone(), factor * coefficient));
    Index { constant: factor * index.constant, terms: terms.collect() }
}

fn sum(mut a: Index, b: &Index) -> Index {
    a.constant += b.constant;
    a.terms.extend(b.terms.iter().cloned());
    a
}
