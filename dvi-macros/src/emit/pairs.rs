//! Loops over all pairs of many bodies.
//!
//! A loop over bodies around a loop over packs of those that come after is cut into parts, which threads
//! share, where there are many:
//! ```text
//! if are_many(n) {
//!     let __p0 = &self.gamma[..];
//!     halves(
//!         n,
//!         [&mut __vector0[..], …],
//!         |__i0: usize, [__lower, __upper, __first]: [usize; 3], [__vector0, …]: &mut [&mut [__T]; 2]| {
//!             let __r1 = __q0[__i0];
//!             let mut __r9 = __T::lift(-0.0);
//!             … the loop over packs, for __i1 from __lower to __upper, where __vector0 begins with the entry of __first …
//!             [__r9, …]
//!         },
//!     );
//! } else {
//!     … the two loops …
//! }
//! ```
//! Nothing of `self` is read in a part but slices of numbers, so that other fields need not be `Sync`. What
//! is added to the entries of a body itself must be linear in its sums over the others, which come in
//! several parts. What does not depend on them is added before, in a loop of its own.

use proc_macro2::TokenStream;
use quote::{ToTokens as _, quote};
use syn::Ident;

use super::indices::open;
use super::values::parameter_slice;
use super::{Element, ForceInline, Function, added, local};
use crate::instructions::{Instruction, Register, Signed};
use crate::schedule::{Accumulated, Step};
use crate::symbolic::{Atom, Index, Loop, Node};

/// How a value depends on the sums over the other bodies.
#[derive(Clone, Debug, PartialEq)]
enum Dependence {
    Free,
    Linear,
    /// The sum of a linear part and a free one.
    Both {
        linear: Vec<Signed>,
        free: Vec<Signed>,
    },
}

/// Something that is added to an entry of a body itself.
struct Own {
    array: Ident,
    value: Signed,
    dependence: Dependence,
}

/// A loop over bodies around one over those that come after.
struct Nest<'a> {
    body: &'a [Step],
    inner: &'a Loop,
    folds: &'a [Accumulated],
    terms: &'a [Step],
    /// Registers of a body itself, in order.
    known: Vec<(Register, Dependence)>,
    own: Vec<Own>,
    /// The slices whose entries are added to, without repetition.
    arrays: Vec<Ident>,
}

impl Nest<'_> {
    fn add_array(&mut self, array: Ident) {
        if !self.arrays.contains(&array) {
            self.arrays.push(array);
        }
    }

    fn dependence(&self, register: Register) -> Dependence {
        let known = self.known.iter().find(|(known, _)| *known == register);
        known.map_or(Dependence::Free, |(_, dependence)| dependence.clone())
    }
}

impl Function<'_> {
    /// The index of an entry of an output.
    pub(super) fn entry(&self, index: &Index) -> TokenStream {
        let index = self.index(index);
        if self.is_part {
            let first = local("first");
            quote!(#index - #first)
        } else {
            index
        }
    }

    /// Whether there are many bodies in a loop over them, and its parts, if it can be cut.
    pub(super) fn pairs(
        &self,
        over: &Loop,
        folds: &[Accumulated],
        body: &[Step],
    ) -> Option<[TokenStream; 2]> {
        let is_outermost = over.depth == 0 && matches!(self.element, Element::Number) && folds.is_empty();
        let nest = if is_outermost { self.nest(over, body)? } else { return None };
        let krate = self.emitter.krate();
        let bodies = self.emitter.range_bound(&over.range.upper);
        let alone = self.alone(over, &nest);
        let slices = self.parameters_of(&nest).into_iter().map(|field| {
            let (slice, place) =
                (parameter_slice(field), &self.emitter.model.parameters[field as usize].tokens);
            quote!(let #slice = &#place[..];)
        });
        let (arrays, count, part) = (&nest.arrays, nest.arrays.len(), self.part(&nest));
        let (body, [lower, upper, first]) = (open(over.depth), ["lower", "upper", "first"].map(local));
        let parts = quote! {
            #alone
            #(#slices)*
            #krate::__private::halves(
                #bodies,
                [#(&mut #arrays[..]),*],
                #ForceInline
                |
                    #body: ::core::primitive::usize,
                    [#lower, #upper, #first]: [::core::primitive::usize; 3],
                    [#(#arrays),*]: &mut [&mut [__T]; #count],
                | { #part },
            );
        };
        Some([quote!(#krate::__private::are_many(#bodies)), parts])
    }

    /// The two loops, if what they do can be cut into parts.
    fn nest<'a>(&self, over: &Loop, body: &'a [Step]) -> Option<Nest<'a>> {
        let mut loops = body.iter().filter_map(|step| match step {
            Step::Loop { over, folds, body } => Some((over, folds, body)),
            Step::Let(_) | Step::Write(..) => None,
        });
        let (Some((inner, folds, terms)), None) = (loops.next(), loops.next()) else { return None };
        let after = Index::open(over.depth).plus(&Index::literal(1), 1);
        let is_all = over.range.lower == Index::default() && over.range.left_out().next().is_none();
        let is_after = inner.range.lower == after && inner.range.upper == over.range.upper;
        if !(is_all && is_after && self.runs_over_packs(inner, folds, terms)) {
            return None;
        }
        let known = folds.iter().map(|fold| (fold.result, Dependence::Linear)).collect();
        let mut nest = Nest { body, inner, folds, terms, known, own: Vec::new(), arrays: Vec::new() };
        for step in terms {
            match step {
                Step::Let(register) => self.is_of_slices(*register).then_some(())?,
                Step::Write(statement, _) => nest.add_array(self.array_of(*statement, inner.depth)?),
                Step::Loop { .. } => return None,
            }
        }
        for step in body {
            match step {
                Step::Let(register) => {
                    let dependence = self.dependence(&nest, *register)?;
                    nest.known.push((*register, dependence));
                }
                Step::Write(statement, value) => {
                    let array = self.array_of(*statement, over.depth)?;
                    let dependence = nest.dependence(value.register);
                    if dependence != Dependence::Free {
                        nest.add_array(array.clone());
                    }
                    nest.own.push(Own { array, value: *value, dependence });
                }
                Step::Loop { .. } => {}
            }
        }
        (!nest.arrays.is_empty()).then_some(nest)
    }

    /// The slice that a statement adds to, at the index of the loop at `depth` itself.
    fn array_of(&self, statement: usize, depth: u32) -> Option<Ident> {
        let (output, entry) = self.routine.statements[statement].place.entry()?;
        (entry.index == Index::open(depth)).then(|| output.slice(entry.block))
    }

    /// Whether a register, if it is a leaf, is read from a slice at a place that the loops know.
    fn is_of_slices(&self, register: Register) -> bool {
        let is_of_loops = |index: &Index| index.terms.iter().all(|(atom, _)| matches!(atom, Atom::Open(_)));
        let Some(leaf) = self.leaf_of(register) else { return true };
        match leaf {
            Node::Coordinate(entry) | Node::Velocity(entry) => is_of_loops(&entry.index),
            Node::Parameter(parameter) => {
                let known = &self.emitter.model.parameters[parameter.field as usize];
                matches!(parameter.indices.as_slice(), [index] if known.is_slice && is_of_loops(index))
            }
            _ => false,
        }
    }

    /// How a value of a body itself depends on its sums; `None` if it cannot stand in a part.
    fn dependence(&self, nest: &Nest<'_>, register: Register) -> Option<Dependence> {
        let instruction = self.routine.code.get(register);
        let of = |register: &Register| nest.dependence(*register);
        let is_free = |register: &Register| of(register) == Dependence::Free;
        if instruction.operands().iter().all(is_free) {
            let is_read = match instruction {
                Instruction::Expansion(..) | Instruction::Part(..) | Instruction::Reduce(..) => false,
                _ => self.is_of_slices(register),
            };
            return is_read.then_some(Dependence::Free);
        }
        match instruction {
            Instruction::Multiply(a, b) => match (of(a), of(b)) {
                (Dependence::Linear, Dependence::Free) | (Dependence::Free, Dependence::Linear) => {
                    Some(Dependence::Linear)
                }
                _ => None,
            },
            Instruction::Divide(a, b) => {
                (of(a) == Dependence::Linear && is_free(b)).then_some(Dependence::Linear)
            }
            Instruction::Sum(terms) => {
                let (free, linear): (Vec<Signed>, Vec<Signed>) =
                    terms.iter().partition(|term| is_free(&term.register));
                let is_linear = linear.iter().all(|term| of(&term.register) == Dependence::Linear);
                let dependence =
                    if free.is_empty() { Dependence::Linear } else { Dependence::Both { linear, free } };
                is_linear.then_some(dependence)
            }
            _ => None,
        }
    }

    /// The fields whose parameters the parts read.
    fn parameters_of(&self, nest: &Nest<'_>) -> Vec<u32> {
        let steps = nest.body.iter().chain(nest.terms);
        let field = |step: &Step| match step {
            Step::Let(register) => match self.leaf_of(*register)? {
                Node::Parameter(parameter) => Some(parameter.field),
                _ => None,
            },
            Step::Loop { .. } | Step::Write(..) => None,
        };
        let mut fields: Vec<u32> = steps.filter_map(field).collect();
        fields.sort_unstable();
        fields.dedup();
        fields
    }

    /// What is added to the entries of each body whatever the others do.
    fn alone(&self, over: &Loop, nest: &Nest<'_>) -> TokenStream {
        let alone: TokenStream = nest
            .own
            .iter()
            .map(|own| {
                let value = match &own.dependence {
                    Dependence::Free => self.register(own.value.register),
                    Dependence::Both { free, .. } => self.sum(free),
                    Dependence::Linear => return TokenStream::new(),
                };
                let (array, index) = (&own.array, open(over.depth));
                added(&quote!(#array[#index]), own.value.negative, &value)
            })
            .collect();
        if alone.is_empty() {
            return alone;
        }
        let free = nest.known.iter().filter(|(_, dependence)| *dependence == Dependence::Free);
        let values: TokenStream = free.map(|(register, _)| self.step(&Step::Let(*register))).collect();
        self.emitter.loop_over(over, &quote!(#values #alone))
    }

    /// The pairs of one body with some of those that come after: what is to be added to its own entries.
    fn part(&self, nest: &Nest<'_>) -> TokenStream {
        let function = Function { is_part: true, ..*self };
        let bounds = ["lower", "upper"].map(|bound| local(bound).into_token_stream());
        let steps: TokenStream = nest
            .body
            .iter()
            .map(|step| match step {
                // The linear part of a sum stands where it is added.
                Step::Let(register) if matches!(nest.dependence(*register), Dependence::Both { .. }) => {
                    TokenStream::new()
                }
                Step::Let(_) => function.step(step),
                Step::Loop { .. } => {
                    let begin = function.begin(nest.folds);
                    let packs = function.packs_between(&bounds, nest.inner.depth, nest.folds, nest.terms);
                    quote!(#begin #packs)
                }
                Step::Write(..) => TokenStream::new(),
            })
            .collect();
        let added = nest.arrays.iter().map(|array| function.added(nest, array));
        quote!(#steps [#(#added),*])
    }

    /// What is to be added to one of a body's own entries.
    fn added(&self, nest: &Nest<'_>, array: &Ident) -> TokenStream {
        let krate = self.emitter.krate();
        let own = nest.own.iter().filter(|own| own.array == *array);
        let added = own.filter_map(|own| {
            let value = match &own.dependence {
                Dependence::Linear => self.register(own.value.register),
                Dependence::Both { linear, .. } => self.sum(linear),
                Dependence::Free => return None,
            };
            Some(if own.value.negative { quote!(-(#value)) } else { quote!(#value) })
        });
        let added: Vec<TokenStream> = added.collect();
        match added.as_slice() {
            [] => quote!(<__T as #krate::Scalar>::lift(-0.0)),
            [added] => added.clone(),
            several => quote!(#((#several))+*),
        }
    }
}
