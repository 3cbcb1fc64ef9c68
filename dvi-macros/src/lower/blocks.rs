//! Blocks with `let`, and choices.

use syn::{BinOp, Expr as Syntax, ExprIf, Pat, Stmt, UnOp};

use super::{Binding, Lowering, Role, Value, Written, bound_name};
use crate::symbolic::{Expr, Free, Relation};
use crate::syntax::{closure, value};

impl Lowering<'_> {
    /// `{ let a = …; let b = …; value }`
    pub(super) fn statements(&mut self, block: &syn::Block) -> Option<Value> {
        let outside = self.scope.len();
        let mut value = None;
        let mut ended = false;
        for (position, statement) in block.stmts.iter().enumerate() {
            match statement {
                Stmt::Local(local) => self.binding(local),
                Stmt::Expr(expr, None) if position + 1 == block.stmts.len() => {
                    ended = true;
                    value = self.value(expr);
                }
                other => {
                    ended = true;
                    self.errors.push_once(
                        "statement",
                        other,
                        "a block of a formula holds `let` bindings and ends with its value",
                    );
                }
            }
        }
        if !ended {
            self.errors.push(block, "this block has no value: end it with an expression, without `;`");
        }
        self.scope.truncate(outside);
        value
    }

    pub(super) fn binding(&mut self, local: &syn::Local) {
        let init = value(local);
        if let Some(closure) = init.and_then(closure) {
            return self.define(&local.pat, closure);
        }
        if let Pat::Tuple(names) = &local.pat {
            return self.bind_tuple(names, init);
        }
        let value = match init {
            Some(init) => self.value(init),
            None => self.refuse(local, "write `let name = value;`"),
        };
        let written = local.init.as_ref().map_or(Written::Real, |init| self.written(&init.expr));
        match bound_name(&local.pat) {
            Some(name) => self.scope.push((name, Binding::Value { value, written })),
            None => {
                self.errors.push(
                    &local.pat,
                    "write `let name = value;`: a formula binds one name at a time, and it keeps its value",
                );
                // One error is enough for a name that is used further on.
                if let Pat::Ident(name) = &local.pat {
                    self.scope.push((name.ident.to_string(), Binding::Value { value: None, written }));
                }
            }
        }
    }

    /// `if a < b { value } else { value }`
    pub(super) fn choice(&mut self, choice: &ExprIf) -> Option<Value> {
        let then = self.statements(&choice.then_branch);
        let Some((_, otherwise)) = &choice.else_branch else {
            return self.refuse(choice, "an `if` of a formula needs its `else` branch");
        };
        let value = self.value(otherwise);
        let branches = then.zip(value).and_then(|(then, value)| {
            let block = choice.then_branch.clone();
            let block = Syntax::Block(syn::ExprBlock { attrs: Vec::new(), label: None, block });
            self.alike((&block, then), (otherwise, value), "a choice")
        });
        let [then, otherwise] = branches.map_or([None, None], |branches| branches.map(Some));
        self.condition(&choice.cond, then, otherwise)
    }

    fn condition(
        &mut self,
        condition: &Syntax,
        then: Option<Value>,
        otherwise: Option<Value>,
    ) -> Option<Value> {
        match condition {
            Syntax::Paren(inner) => self.condition(&inner.expr, then, otherwise),
            Syntax::Unary(unary) if matches!(unary.op, UnOp::Not(_)) => {
                self.condition(&unary.expr, otherwise, then)
            }
            Syntax::Binary(binary) => {
                let relation = match binary.op {
                    BinOp::Lt(_) => Relation::Less,
                    BinOp::Le(_) => Relation::LessOrEqual,
                    BinOp::Gt(_) => Relation::Greater,
                    BinOp::Ge(_) => Relation::GreaterOrEqual,
                    BinOp::And(_) => {
                        let inner = self.condition(&binary.right, then, otherwise.clone());
                        return self.condition(&binary.left, inner, otherwise);
                    }
                    BinOp::Or(_) => {
                        let inner = self.condition(&binary.right, then.clone(), otherwise);
                        return self.condition(&binary.left, then, inner);
                    }
                    BinOp::Eq(_) | BinOp::Ne(_) => {
                        let [a, b] = [&binary.left, &binary.right].map(|side| self.real_text(side));
                        let equal = matches!(binary.op, BinOp::Eq(_));
                        let meant = if equal {
                            format!("{a} <= {b} && {a} >= {b}")
                        } else {
                            format!("{a} < {b} || {a} > {b}")
                        };
                        let message =
                            format!("a condition compares with `<`, `<=`, `>` or `>=`, as in `{meant}`");
                        return self.refuse(condition, message);
                    }
                    _ => {
                        return self.refuse(condition, "a condition compares with `<`, `<=`, `>` or `>=`");
                    }
                };
                let (left, right) = (self.expr(&binary.left), self.expr(&binary.right));
                let (left, right) = (left?, right?);
                self.check_at_rest(condition, "this condition", &[left, right])?;
                self.note_seam(left, right);
                then?.zip(otherwise?, |then, otherwise| {
                    let value = self.graph.choose(left, relation, right, then, otherwise);
                    self.admitted(condition, value)
                })
            }
            _ => self.refuse(condition, "a condition compares with `<`, `<=`, `>` or `>=`"),
        }
    }

    /// Notes that the formula is not smooth where `a` is `b`: where `abs` and `signum` are taken of zero,
    /// and where what a condition, `min` or `max` compares is equal. What depends on an index differs from
    /// term to term of a sum, and is left out.
    pub(super) fn note_seam(&mut self, a: Expr, b: Expr) {
        // A formula of the motion may use a name that formulas share.
        let is_of_motion =
            !matches!(self.role, Role::Gauge | Role::Constraint(_) | Role::Momentum | Role::Event);
        let is_one = [a, b].iter().all(|side| self.graph.free(side.node) == Free::default());
        if is_of_motion && is_one && !self.seams.contains(&[a, b]) {
            self.seams.push([a, b]);
        }
    }
}
