//! Loops over packs of terms.
//!
//! An innermost loop with many terms that need arithmetic alone, on entries that lie beside one another,
//! becomes
//! ```text
//! let mut __r9 = __T::lift(-0.0);
//! let __whole = whole(lower, upper);
//! if lower < __whole {
//!     let __r1 = all(__r1);
//!     let mut __sum9 = Sums::<__T>::empty();
//!     let mut __waiting1 = Waiting([__T::lift(-0.0)]);
//!     for __i1 in packs::<__T>(lower, __whole) {
//!         let __r2 = __r1 - load(__q0, __i1);
//!         …
//!         add_to(__vector0, __i1, __waiting1.exchange(…));
//!         add_to(__vector0, __i1, -…);
//!         __sum9.add_terms(…);
//!     }
//!     let __i1 = __whole;
//!     __waiting1.add_to(__vector0, __i1);
//!     __r9 += __sum9.total();
//! }
//! for __i1 in __whole..upper {
//!     …
//! }
//! ```
//! and it is compiled for the widest instructions of the processor, with the loops around it and nothing
//! else: between such instructions each call of an elementary function costs more. Where a term adds to
//! several entries of one array that lie beside one another, each pack loads and stores the first of them
//! only. What belongs to entries behind them waits for the packs of these: no pack loads what the one before
//! has just stored in other parts. Terms whose places lie on both sides of the end of a ring, as x[(j + 1) %
//! n] for the last j, are taken one by one before and behind the packs.

use std::cmp::Reverse;

use proc_macro2::{Literal, TokenStream};
use quote::{ToTokens as _, quote};
use syn::Ident;

use super::indices::open;
use super::{Element, Function, local, name};
use crate::instructions::{Instruction, Register, Signed};
use crate::internal::internal;
use crate::schedule::{Accumulated, Step};
use crate::statement::Output;
use crate::symbolic::{Coordinate, Fold, Index, Loop, Node, Parameter, Unary};

/// A range whose bounds are literals and that has fewer terms is not worth it.
const FEWEST: i64 = 16;
/// Entries as far apart, the terms of a pack, do not wait.
const APART: u64 = 8;

/// What a statement adds to the entries of an array, in packs.
struct Addition<'a> {
    array: Ident,
    index: Index,
    value: &'a Signed,
    /// So many places before are the first entries of the array that a term adds to; those of this statement
    /// wait for their packs.
    behind: u64,
    waiting: Ident,
}

impl Function<'_> {
    /// Whether a loop, or one inside of it, runs over packs.
    pub(super) fn has_packs(&self, over: &Loop, folds: &[Accumulated], body: &[Step]) -> bool {
        self.runs_over_packs(over, folds, body)
            || body.iter().any(|step| match step {
                Step::Loop { over, folds, body } => self.has_packs(over, folds, body),
                Step::Let(_) | Step::Write(..) => false,
            })
    }

    /// Whether the terms of a loop can be taken in packs.
    pub(super) fn runs_over_packs(&self, over: &Loop, folds: &[Accumulated], body: &[Step]) -> bool {
        let lower = over.range.lower.as_literal().unwrap_or(0);
        let is_short = over.range.upper.as_literal().is_some_and(|upper| upper - lower < FEWEST);
        let sums = folds.iter().all(|fold| fold.fold == Fold::Sum);
        let mut entries: Vec<(Output, &Coordinate)> = Vec::new();
        let steps = body.iter().all(|step| match step {
            Step::Let(register) => self.is_packed(*register, over),
            Step::Loop { .. } => false,
            Step::Write(statement, _) => {
                let Some((output, entry)) = self.routine.statements[*statement].place.entry() else {
                    return false;
                };
                let mut others =
                    entries.iter().filter(|(of, other)| *of == output && other.block == entry.block);
                // Else nobody knows which of two statements adds first to an entry: see `by_entry`.
                let are_ordered = others.all(|(_, other)| {
                    other.index.unturned().plus(&entry.index.unturned(), -1).as_literal().is_some()
                });
                entries.push((output, entry));
                are_ordered && follows(&entry.index, over)
            }
        });
        !is_short && over.range.left_out().next().is_none() && sums && steps
    }

    /// Whether a register can be computed for several terms at once.
    fn is_packed(&self, register: Register, over: &Loop) -> bool {
        match self.routine.code.get(register) {
            Instruction::Literal(_)
            | Instruction::Multiply(..)
            | Instruction::Divide(..)
            | Instruction::Sum(_)
            | Instruction::Unary(Unary::Sqrt, _) => true,
            Instruction::Leaf(id) => match self.emitter.graph.node(*id) {
                Node::Coordinate(entry) | Node::Velocity(entry) => follows(&entry.index, over),
                Node::Parameter(parameter) => self.is_packed_parameter(parameter, over),
                // Those that depend on the index are numbers of their own.
                _ => false,
            },
            _ => false,
        }
    }

    fn is_packed_parameter(&self, parameter: &Parameter, over: &Loop) -> bool {
        let known = &self.emitter.model.parameters[parameter.field as usize];
        let [index] = parameter.indices.as_slice() else { return false };
        known.is_slice && follows(index, over)
    }

    /// The index of an entry in packs, which take no place beyond the end of a ring.
    pub(super) fn index(&self, index: &Index) -> TokenStream {
        match self.element {
            Element::Number => self.emitter.index(index),
            Element::Pack => self.emitter.index(&index.unturned()),
        }
    }

    /// How far before and behind a term are the places on rings that it needs.
    fn reach(&self, body: &[Step]) -> [u64; 2] {
        let indices = body.iter().filter_map(|step| match step {
            Step::Let(register) => match self.leaf_of(*register)? {
                Node::Coordinate(entry) | Node::Velocity(entry) => Some(&entry.index),
                Node::Parameter(parameter) => parameter.indices.first(),
                _ => None,
            },
            Step::Write(statement, _) => {
                self.routine.statements[*statement].place.entry().map(|(_, entry)| &entry.index)
            }
            Step::Loop { .. } => None,
        });
        indices.filter_map(Index::on_ring).fold([0, 0], |[before, behind], ring| {
            let steps = ring.shift.unsigned_abs();
            if ring.shift < 0 { [before.max(steps), behind] } else { [before, behind.max(steps)] }
        })
    }

    /// A loop, as packs and then what is left. Its sums have begun.
    pub(super) fn packs(&self, over: &Loop, folds: &[Accumulated], body: &[Step]) -> TokenStream {
        let bounds = [&over.range.lower, &over.range.upper].map(|bound| self.emitter.range_bound(bound));
        self.packs_between(&bounds, over.depth, folds, body)
    }

    /// The same of the loop at `depth`, between these bounds.
    pub(super) fn packs_between(
        &self,
        [lower, upper]: &[TokenStream; 2],
        depth: u32,
        folds: &[Accumulated],
        body: &[Step],
    ) -> TokenStream {
        let krate = self.emitter.krate();
        let packed = Function { element: Element::Pack, ..*self };
        let (index, whole) = (open(depth), local("whole"));
        let outside = self.read_from_outside(folds, body).into_iter().map(|register| {
            let name = name(register);
            quote!(let #name = #krate::__private::all(#name);)
        });
        let sums: Vec<_> = folds.iter().map(|fold| local(format_args!("sum{}", fold.result.0))).collect();
        let terms = folds.iter().map(|fold| packed.signed(fold.body));
        let results = folds.iter().map(|fold| name(fold.result));
        let lets = body.iter().filter(|step| matches!(step, Step::Let(_))).map(|step| packed.step(step));
        let additions = self.additions(body);
        let wait = additions.iter().map(|addition| self.wait(addition));
        let add = additions.iter().map(|addition| packed.add(addition));
        let arrive: TokenStream = additions.iter().map(|addition| packed.arrive(addition)).collect();
        let rest = self.terms(folds, body);
        let (lower, past, turned) = match self.reach(body) {
            [0, 0] => (lower.clone(), upper.clone(), TokenStream::new()),
            reach => {
                let begin = local("begin");
                let [before, behind] = reach.map(Literal::u64_unsuffixed);
                let turned = quote! {
                    let #begin = #krate::__private::first_unturned(#lower, #upper, #before);
                    for #index in #lower..#begin { #rest }
                };
                let past = quote!(#krate::__private::past_unturned(#begin, #upper, #behind));
                (begin.into_token_stream(), past, turned)
            }
        };
        let (is_any, arrive) = if arrive.is_empty() {
            (TokenStream::new(), arrive)
        } else {
            // Where there is no pack, the entries may not be there either.
            (quote!(if #lower < #whole), quote!(let #index = #whole; #arrive))
        };
        quote! {
            #turned
            let #whole = #krate::__private::whole(#lower, #past);
            #is_any {
                #(#outside)*
                #(let mut #sums = #krate::__private::Sums::<__T>::empty();)*
                #(#wait)*
                for #index in #krate::__private::packs::<__T>(#lower, #whole) {
                    #(#lets)*
                    #(#add)*
                    #(#sums.add_terms(#terms);)*
                }
                #arrive
                #(#results += #sums.total();)*
            }
            for #index in #whole..#upper { #rest }
        }
    }

    /// What a body adds to entries, in an order in which packs add to each of them as the terms do one by
    /// one. What adds to the entry j + 1 comes before what adds to the entry j: so does, one by one, the
    /// earlier of the two terms that add to the same entry.
    fn additions<'a>(&self, body: &'a [Step]) -> Vec<Addition<'a>> {
        let mut additions: Vec<Addition<'a>> = Vec::new();
        for step in body {
            let Step::Write(statement, value) = step else { continue };
            let Some((output, entry)) = self.routine.statements[*statement].place.entry() else {
                internal("packs add to entries alone")
            };
            let waiting = local(format_args!("waiting{statement}"));
            let (array, index) = (output.slice(entry.block), entry.index.unturned());
            additions.push(Addition { array, index, value, behind: 0, waiting });
        }
        additions.sort_by_key(|addition| Reverse(addition.index.constant));
        let mut first: Vec<(Ident, i64)> = Vec::new();
        for Addition { array, index, behind, .. } in additions.iter_mut().rev() {
            let Some((_, constant)) = first.iter().find(|(known, _)| known == array) else {
                first.push((array.clone(), index.constant));
                continue;
            };
            let apart = index.constant.abs_diff(*constant);
            if apart < APART {
                (*behind, index.constant) = (apart, *constant);
            }
        }
        additions
    }

    /// What waits before the first pack: nothing, which is zero with the sign that changes no number.
    fn wait(&self, Addition { behind, waiting, .. }: &Addition<'_>) -> TokenStream {
        let krate = self.emitter.krate();
        let nothing = (0..*behind).map(|_| quote!(<__T as #krate::Scalar>::lift(-0.0)));
        if *behind == 0 {
            return TokenStream::new();
        }
        quote!(let mut #waiting = #krate::__private::Waiting([#(#nothing),*]);)
    }

    /// Adds the terms of a pack.
    fn add(&self, Addition { array, index, value, behind, waiting }: &Addition<'_>) -> TokenStream {
        let (krate, index, terms) = (self.emitter.krate(), self.entry(index), self.signed(**value));
        let terms = if *behind == 0 { terms } else { quote!(#waiting.exchange(#terms)) };
        quote!(#krate::__private::add_to(#array, #index, #terms);)
    }

    /// Adds what waits after the last pack.
    fn arrive(&self, Addition { array, index, behind, waiting, .. }: &Addition<'_>) -> TokenStream {
        let index = self.entry(index);
        if *behind == 0 { TokenStream::new() } else { quote!(#waiting.add_to(#array, #index);) }
    }

    /// The registers that the body of a loop reads and does not compute.
    fn read_from_outside(&self, folds: &[Accumulated], body: &[Step]) -> Vec<Register> {
        let code = &self.routine.code;
        let mut used: Vec<Register> = folds.iter().map(|fold| fold.body.register).collect();
        let mut inside = Vec::new();
        for step in body {
            match step {
                Step::Let(register) => {
                    used.extend(code.get(*register).operands());
                    inside.push(*register);
                }
                Step::Write(_, Signed { register, .. }) => used.push(*register),
                Step::Loop { .. } => {}
            }
        }
        used.sort_unstable();
        used.dedup();
        used.retain(|register| {
            !inside.contains(register) && !matches!(code.get(*register), Instruction::Literal(_))
        });
        used
    }
}

/// Whether an index goes on by one with that of the loop, around the end of a ring at most.
fn follows(index: &Index, over: &Loop) -> bool {
    index.on_ring().map_or_else(
        || index.follows(over.depth),
        |ring| ring.unturned.follows(over.depth) && *ring.length == over.range.upper,
    )
}
