//! Loops to tokens. Nothing here can fail.
//!
//! A scope such as `for j { for k > j { … } }` becomes
//! ```text
//! for __i0 in 0usize..__n0 {
//!     let __r1 = __q0[__i0];
//!     let mut __r9 = __T::lift(-0.0);
//!     for __i1 in (__i0 + 1usize)..__n0 {
//!         …
//!         __r9 += …;
//!         __vector0[__i1] -= …;
//!     }
//!     __vector0[__i0] += __r9;
//! }
//! ```
//! Sums begin at −0, which is neutral for every number, so that the optimiser may drop the first
//! addition.

use proc_macro2::{Literal, Span, TokenStream};
use quote::{format_ident, quote, quote_spanned};
use syn::{Ident, Path};

use crate::instructions::{Instruction, Instructions, Register, Signed};
use crate::internal::internal;
use crate::model::{Model, ScalarField};
use crate::program::{Output, Place};
use crate::routine::Routine;
use crate::schedule::{Accumulated, Step};
use crate::symbolic::{Coordinate, Fold, Graph, Id, Node, Parameter, Partial, Relation, Weight};

mod indices;

pub(crate) struct Emitter<'a> {
    pub(crate) graph: &'a Graph,
    pub(crate) model: &'a Model,
}

/// Expressions that nest deeper than this are cut into `let`s: the compiler reads them by recursion.
const DEEPEST_EXPRESSION: u32 = 24;

/// One function on its way to tokens.
struct Function<'a> {
    emitter: &'a Emitter<'a>,
    routine: &'a Routine,
    /// Registers that are written into the one expression that uses them.
    inlined: &'a [bool],
    /// Whether a constant stands in the place of functions of several variables where they are not known.
    is_guarded: bool,
}

pub(crate) fn local(name: impl std::fmt::Display) -> Ident {
    Ident::new(&format!("__{name}"), Span::mixed_site())
}

fn name(register: Register) -> Ident {
    local(format_args!("r{}", register.0))
}

impl Emitter<'_> {
    pub(crate) fn krate(&self) -> &Path {
        &self.model.crate_path
    }

    /// The body of a function that carries out its statements.
    pub(crate) fn body(&self, routine: &Routine) -> TokenStream {
        self.body_of(routine, false)
    }

    /// The body of a function that returns the argument to blame if the value of `routine` is no number because a function of
    /// several variables is not known.
    pub(crate) fn guarded(&self, routine: &Routine) -> TokenStream {
        let (krate, value, body) = (self.krate(), self.body(routine), self.body_of(routine, true));
        let has_choices = (0..routine.code.len())
            .any(|position| matches!(routine.code.get(Register(position as u32)), Instruction::Choose(..)));
        quote! {
            let mut __outside = ::core::option::Option::None;
            let __with_constants: __T = { #body };
            let __value: __T = { #value };
            #krate::__private::to_blame(__outside, [__value, __with_constants], #has_choices)
        }
    }

    fn body_of(&self, routine: &Routine, is_guarded: bool) -> TokenStream {
        let code = &routine.code;
        let mut uses = vec![0_u32; code.len()];
        let mut elsewhere = vec![false; code.len()];
        count_uses(code, &routine.steps, &mut uses, &mut elsewhere);
        let mut inlined = vec![false; code.len()];
        let mut nesting = vec![0_u32; code.len()];
        for position in 0..code.len() {
            let instruction = code.get(Register(position as u32));
            let inside = instruction.operands().into_iter().map(|operand| operand.0 as usize);
            let deepest = inside.filter(|operand| inlined[*operand]).map(|operand| nesting[operand]).max();
            nesting[position] = 1 + deepest.unwrap_or(0);
            let is_short =
                uses[position] == 1 && !elsewhere[position] && nesting[position] < DEEPEST_EXPRESSION;
            inlined[position] = is_short || matches!(instruction, Instruction::Literal(_));
        }
        Function { emitter: self, routine, inlined: &inlined, is_guarded }.steps(&routine.steps)
    }
}

/// Counts the uses of each register, and notes those whose use is in another scope.
fn count_uses(
    code: &Instructions,
    steps: &[Step],
    uses: &mut [u32],
    elsewhere: &mut [bool],
) -> Vec<Register> {
    let mut used = Vec::new();
    let mut defined = Vec::new();
    for step in steps {
        match step {
            Step::Let(register) => {
                defined.push(*register);
                used.extend(code.get(*register).operands());
            }
            Step::Write(_, value) => used.push(value.register),
            Step::Loop { folds, body, .. } => {
                defined.extend(folds.iter().map(|fold| fold.result));
                let inner = count_uses(code, body, uses, elsewhere);
                inner.into_iter().chain(folds.iter().map(|fold| fold.body.register)).for_each(|register| {
                    elsewhere[register.0 as usize] = true;
                });
            }
        }
    }
    used.iter().for_each(|register| uses[register.0 as usize] += 1);
    used.retain(|register| !defined.contains(register));
    used
}

impl Function<'_> {
    fn steps(&self, steps: &[Step]) -> TokenStream {
        steps.iter().map(|step| self.step(step)).collect()
    }

    fn step(&self, step: &Step) -> TokenStream {
        match step {
            Step::Let(register) if self.inlined[register.0 as usize] => TokenStream::new(),
            Step::Let(register) => {
                let (name, value) = (name(*register), self.instruction(*register));
                quote!(let #name = #value;)
            }
            Step::Loop { over, folds, body } => {
                let mut begin = TokenStream::new();
                let mut accumulate = self.steps(body);
                for Accumulated { fold, result, body } in folds {
                    let (krate, name) = (self.emitter.krate(), name(*result));
                    let body = self.signed(*body);
                    let (neutral, join) = match fold {
                        Fold::Sum => (quote!(-0.0), quote!(#name += #body;)),
                        Fold::Product => (quote!(1.0), quote!(#name = #name * #body;)),
                    };
                    begin.extend(quote!(let mut #name = <__T as #krate::Scalar>::lift(#neutral);));
                    accumulate.extend(join);
                }
                let repeated = self.emitter.loop_over(over, &accumulate);
                quote!(#begin #repeated)
            }
            Step::Write(statement, value) => self.write(&self.routine.statements[*statement].place, *value),
        }
    }

    fn write(&self, place: &Place, value: Signed) -> TokenStream {
        let target = match place {
            Place::Result => return self.signed(value),
            Place::Entry(output, coordinate) => {
                let array =
                    format_ident!("{}", output_block(*output, coordinate.block), span = Span::mixed_site());
                let index = self.emitter.index(&coordinate.index);
                quote!(#array[#index])
            }
            Place::MatrixEntry(row, column) => {
                let (krate, row, column) = (self.emitter.krate(), self.flat(row), self.flat(column));
                let value = self.signed(value);
                return quote!(#krate::Sink::add(__sink, #row, #column, #value););
            }
            Place::Constraint(row) => {
                let (members, member) =
                    (local(constraint_members(row.constraint)), self.emitter.index(&row.member));
                quote!(#members[#member])
            }
            Place::ConstraintDerivative(row, column) => {
                let (first, member) =
                    (local(first_constraint(row.constraint)), self.emitter.index(&row.member));
                let (krate, column, value) = (self.emitter.krate(), self.flat(column), self.signed(value));
                return quote!(#krate::Sink::add(__sink, #first + #member, #column, #value););
            }
        };
        let register = self.register(value.register);
        if value.negative { quote!(#target -= #register;) } else { quote!(#target += #register;) }
    }

    /// The number of a coordinate in the order of declaration.
    fn flat(&self, coordinate: &Coordinate) -> TokenStream {
        let offset = local(format_args!("offset{}", coordinate.block));
        let index = self.emitter.index(&coordinate.index);
        quote!(#offset + #index)
    }

    fn register(&self, register: Register) -> TokenStream {
        if self.inlined[register.0 as usize] {
            let value = self.instruction(register);
            match self.routine.code.get(register) {
                Instruction::Leaf(_) | Instruction::Literal(_) | Instruction::Reduce(..) => value,
                _ => quote!((#value)),
            }
        } else {
            let name = name(register);
            quote!(#name)
        }
    }

    fn signed(&self, value: Signed) -> TokenStream {
        let register = self.register(value.register);
        if value.negative { quote!((-#register)) } else { register }
    }

    fn instruction(&self, register: Register) -> TokenStream {
        let krate = self.emitter.krate();
        let scalar = quote!(<__T as #krate::Scalar>);
        match self.routine.code.get(register) {
            Instruction::Leaf(id) => self.leaf(*id),
            Instruction::Literal(bits) => {
                let value = literal(f64::from_bits(*bits));
                quote!(#scalar::lift(#value))
            }
            Instruction::Multiply(a, b) => {
                let (a, b) = (self.register(*a), self.register(*b));
                quote!(#a * #b)
            }
            Instruction::Divide(a, b) => {
                let (a, b) = (self.register(*a), self.register(*b));
                quote!(#a / #b)
            }
            Instruction::Sum(terms) => self.sum(terms),
            Instruction::Unary(function, of) => {
                let (function, of) = (format_ident!("{}", function.name()), self.signed(*of));
                quote!(#scalar::#function(#of))
            }
            Instruction::Binary(function, a, b) => {
                let (function, a, b) =
                    (format_ident!("{}", function.name()), self.signed(*a), self.signed(*b));
                quote!(#scalar::#function(#a, #b))
            }
            Instruction::Power(of, exponent) => {
                let of = self.register(*of);
                let exponent = Literal::i32_suffixed(*exponent);
                quote!(#scalar::powi(#of, #exponent))
            }
            Instruction::Call(function, order, of) => {
                let (name, of) = (own_function(*function as usize, *order as usize), self.signed(*of));
                quote!(Self::#name(#of))
            }
            Instruction::Expansion(field, at) => {
                let name = scalar_field(*field as usize);
                let at = at.iter().map(|argument| self.signed(*argument));
                if !self.is_guarded {
                    return quote!(self.#name([#(#at),*]));
                }
                let ScalarField { text, tokens, arity, span, .. } =
                    &self.emitter.model.scalar_fields[*field as usize];
                // With the span of the one above, so that a type that is no such function is one error.
                let domain = quote_spanned!(*span=> #krate::ScalarField::<#arity>::domain(&#tokens));
                let arguments = (1..=*arity)
                    .map(|number| quote!(#krate::__private::Argument { function: #text, number: #number }));
                quote! {{
                    let __at = [#(#at),*];
                    match #krate::__private::outside(&[#(#arguments),*], #domain, __at) {
                        ::core::option::Option::None => self.#name(__at),
                        __found => {
                            __outside = __outside.or(__found);
                            #krate::__private::constant()
                        }
                    }
                }}
            }
            Instruction::Part(expansion, partial) => {
                let expansion = self.register(*expansion);
                match partial {
                    Partial::Value => quote!(#expansion.value),
                    Partial::First(axis) => quote!(#expansion.gradient[#axis]),
                    Partial::Second(first, second) => quote!(#expansion.hessian[#first][#second]),
                }
            }
            Instruction::Choose(left, relation, right, then, otherwise) => {
                let relation = match relation {
                    Relation::Less => quote!(Less),
                    Relation::LessOrEqual => quote!(LessOrEqual),
                    Relation::Greater | Relation::HasMore => quote!(Greater),
                    Relation::GreaterOrEqual => quote!(GreaterOrEqual),
                };
                let [left, right, then, otherwise] =
                    [left, right, then, otherwise].map(|part| self.signed(*part));
                quote!(#scalar::choose(#left, #krate::Comparison::#relation, #right, #then, #otherwise))
            }
            Instruction::Reduce(..) => {
                let name = name(register);
                quote!(#name)
            }
        }
    }

    /// A positive term first: a − b rather than −b + a.
    fn sum(&self, terms: &[Signed]) -> TokenStream {
        let mut order: Vec<&Signed> = terms.iter().collect();
        order.sort_by_key(|term| term.negative);
        let mut tokens = self.signed(*order[0]);
        for term in &order[1..] {
            let value = self.register(term.register);
            tokens = if term.negative { quote!(#tokens - #value) } else { quote!(#tokens + #value) };
        }
        tokens
    }

    fn leaf(&self, id: Id) -> TokenStream {
        let krate = self.emitter.krate();
        match self.emitter.graph.node(id) {
            Node::Coordinate(coordinate) => self.gather("q", coordinate),
            Node::Velocity(coordinate) => self.gather("v", coordinate),
            Node::Parameter(parameter) => self.parameter(parameter),
            Node::Count(index) => {
                let index = self.emitter.signed_index(index);
                quote!(<__T as #krate::Scalar>::lift(#index as f64))
            }
            Node::Weight(weight) => match weight {
                Weight::Qq => quote!(__w.qq),
                Weight::Qv => quote!(__w.qv),
                Weight::Vq => quote!(__w.vq),
                Weight::Vv => quote!(__w.vv),
                Weight::A => quote!(__a),
                Weight::B => quote!(__b),
                Weight::Q => quote!(__weights[0usize]),
                Weight::V => quote!(__weights[1usize]),
            },
            Node::Time => quote!(__t),
            other => internal(format!("{other:?} is not a leaf")),
        }
    }

    fn gather(&self, array: &str, coordinate: &Coordinate) -> TokenStream {
        let array = local(format_args!("{array}{}", coordinate.block));
        let index = self.emitter.index(&coordinate.index);
        quote!(#array[#index])
    }

    fn parameter(&self, parameter: &Parameter) -> TokenStream {
        let krate = self.emitter.krate();
        let name = &self.emitter.model.parameters[parameter.field as usize];
        let indices = parameter.indices.iter().map(|index| self.emitter.index(index));
        let place = &name.tokens;
        let place = quote!(#place #([#indices])*);
        match &name.generic {
            Some(generic) => quote!(<#generic as #krate::Parameter<__T>>::value(#place)),
            None => quote!(<__T as #krate::Scalar>::lift(#krate::__private::Number::number(#place))),
        }
    }
}

/// The function that calls the user's own: a mistake in its signature is one error, on its path.
pub(crate) fn own_function(function: usize, order: usize) -> Ident {
    format_ident!("__function{function}_{order}")
}

/// The function that expands a function of several variables.
pub(crate) fn scalar_field(field: usize) -> Ident {
    format_ident!("__scalar_field{field}")
}

/// The slice of g or a with the members of a declared constraint.
pub(crate) fn constraint_members(constraint: u32) -> String {
    format!("g{constraint}")
}

/// The number of the first member of a declared constraint.
pub(crate) fn first_constraint(constraint: u32) -> String {
    format!("row{constraint}")
}

pub(crate) fn output_block(output: Output, block: u32) -> String {
    match output {
        Output::Lq => format!("__l_q{block}"),
        Output::Lv => format!("__l_v{block}"),
        Output::Vector => format!("__vector{block}"),
    }
}

fn literal(value: f64) -> TokenStream {
    if value.is_finite() {
        let literal = Literal::f64_suffixed(value);
        quote!(#literal)
    } else if value.is_nan() {
        quote!(f64::NAN)
    } else {
        quote!(f64::INFINITY)
    }
}
