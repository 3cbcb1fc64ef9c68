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

use proc_macro2::{Span, TokenStream};
use quote::{ToTokens, format_ident, quote};
use rustc_hash::FxHashSet as HashSet;
use syn::{Ident, Path};

use crate::instructions::{Instruction, Instructions, Register, Signed};
use crate::model::Model;
use crate::routine::Routine;
use crate::schedule::{Accumulated, Step};
use crate::statement::{Output, Place};
use crate::symbolic::{Coordinate, Fold, Graph, Loop, Node};

mod indices;
mod packs;
mod pairs;
mod values;

pub(crate) struct Emitter<'a> {
    pub(crate) graph: &'a Graph,
    pub(crate) model: &'a Model,
}

/// Expressions that nest deeper than this are cut into `let`s: the compiler reads them by recursion.
const DEEPEST_EXPRESSION: u32 = 24;

/// What one evaluation of a body computes.
#[derive(Clone, Copy)]
enum Element {
    /// A number of type `__T`.
    Number,
    /// The same of several terms of a loop.
    Pack,
}

/// One function on its way to tokens.
#[derive(Clone, Copy)]
struct Function<'a> {
    emitter: &'a Emitter<'a>,
    routine: &'a Routine,
    /// Registers that are written into the one expression that uses them.
    inlined: &'a [bool],
    /// Whether a constant stands in the place of functions of several variables where they are not known.
    is_guarded: bool,
    element: Element,
    /// Whether it is the [part](pairs) of one body.
    is_part: bool,
    /// Whether it is inside of what is compiled for the widest instructions.
    is_wide: bool,
}

/// The attribute of functions that are a part of each step that calls them. Not in builds with debug
/// assertions: there nothing is optimised as a rule, and a copy for each caller is work for the compiler
/// that makes no step faster.
pub(crate) struct ForceInline;

impl ToTokens for ForceInline {
    fn to_tokens(&self, tokens: &mut TokenStream) {
        tokens.extend(quote!(#[cfg_attr(not(debug_assertions), inline(always))]));
    }
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

    /// The body of a function that returns the argument to blame if the value of `routine` is no number
    /// because a function of several variables is not known.
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
        let function = Function {
            emitter: self,
            routine,
            inlined: &inlined,
            is_guarded,
            element: Element::Number,
            is_part: false,
            is_wide: false,
        };
        function.steps(&routine.steps)
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
    let mut defined = HashSet::default();
    for step in steps {
        match step {
            Step::Let(register) => {
                defined.insert(*register);
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
    /// The leaf that a register is.
    fn leaf_of(&self, register: Register) -> Option<&Node> {
        match self.routine.code.get(register) {
            Instruction::Leaf(id) => Some(self.emitter.graph.node(*id)),
            _ => None,
        }
    }

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
                let begin = self.begin(folds);
                let repeated = if !self.is_wide && self.has_packs(over, folds, body) {
                    let krate = self.emitter.krate();
                    let wide = Function { is_wide: true, ..*self }.repeated(over, folds, body);
                    quote!(#krate::__private::widest::<__T, _>(__q.len(), #ForceInline || { #wide });)
                } else {
                    self.repeated(over, folds, body)
                };
                quote!(#begin #repeated)
            }
            Step::Write(statement, value) => self.write(&self.routine.statements[*statement].place, *value),
        }
    }

    /// A loop whose sums and products have begun.
    fn repeated(&self, over: &Loop, folds: &[Accumulated], body: &[Step]) -> TokenStream {
        if self.runs_over_packs(over, folds, body) {
            return self.packs(over, folds, body);
        }
        let one_by_one = self.emitter.loop_over(over, &self.terms(folds, body));
        match self.pairs(over, folds, body) {
            Some([many, parts]) => quote!(if #many { #parts } else { #one_by_one }),
            None => one_by_one,
        }
    }

    /// Sums and products without terms.
    fn begin(&self, folds: &[Accumulated]) -> TokenStream {
        let krate = self.emitter.krate();
        let begin = folds.iter().map(|Accumulated { fold, result, .. }| {
            let name = name(*result);
            let neutral = match fold {
                Fold::Sum => quote!(-0.0),
                Fold::Product => quote!(1.0),
            };
            quote!(let mut #name = <__T as #krate::Scalar>::lift(#neutral);)
        });
        quote!(#(#begin)*)
    }

    /// The body of a loop.
    fn terms(&self, folds: &[Accumulated], body: &[Step]) -> TokenStream {
        let mut terms = self.steps(body);
        for Accumulated { fold, result, body } in folds {
            let (name, body) = (name(*result), self.signed(*body));
            terms.extend(match fold {
                Fold::Sum => quote!(#name += #body;),
                Fold::Product => quote!(#name = #name * #body;),
            });
        }
        terms
    }

    fn write(&self, place: &Place, value: Signed) -> TokenStream {
        let target = match place {
            Place::Result => return self.signed(value),
            Place::Entry(output, coordinate) => {
                let array = output.slice(coordinate.block);
                let index = self.entry(&coordinate.index);
                quote!(#array[#index])
            }
            Place::MatrixEntry(row, column) => {
                let (krate, row, column) = (self.emitter.krate(), self.flat(row), self.flat(column));
                let value = self.signed(value);
                return quote!(#krate::Sink::add(__sink, #row, #column, #value););
            }
            Place::Constraint(row) => {
                let (members, member) =
                    (constraint_members(row.constraint), self.emitter.member(&row.member));
                quote!(#members[#member])
            }
            Place::ConstraintDerivative(row, column) => {
                let (first, member) = (first_constraint(row.constraint), self.emitter.member(&row.member));
                let (krate, column, value) = (self.emitter.krate(), self.flat(column), self.signed(value));
                return quote!(#krate::Sink::add(__sink, #first + #member, #column, #value););
            }
        };
        added(&target, value.negative, &self.register(value.register))
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
}

/// `target += value`, or `target -= value`.
fn added(target: &TokenStream, is_negative: bool, value: &TokenStream) -> TokenStream {
    if is_negative { quote!(#target -= #value;) } else { quote!(#target += #value;) }
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
pub(crate) fn constraint_members(constraint: u32) -> Ident {
    slice("g", constraint)
}

/// The number of the first member of a declared constraint.
pub(crate) fn first_constraint(constraint: u32) -> Ident {
    local(format_args!("row{constraint}"))
}

/// The slice of a block of an array, or of g.
pub(crate) fn slice(array: &str, block: u32) -> Ident {
    local(format_args!("{array}{block}"))
}

impl Output {
    pub(crate) fn array(self) -> &'static str {
        match self {
            Self::Lq => "l_q",
            Self::Lv => "l_v",
            Self::Vector => "vector",
        }
    }

    /// The slice of one of its blocks.
    fn slice(self, block: u32) -> Ident {
        slice(self.array(), block)
    }
}
