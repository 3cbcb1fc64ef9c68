//! The check of all sizes, and of all indices against the arrays that they go to.
//!
//! Sizes that only the run knows can disagree with each other: a parameter array shorter than the
//! coordinates, a neighbour beyond the last one. The generated check walks the loops of the formulas
//! once, before the first step, and names the first index that is out of range.

use rustc_hash::FxHashSet as HashSet;

use proc_macro2::TokenStream;
use quote::quote;
use syn::ext::IdentExt as _;

use super::state::on_stack;
use crate::emit::Emitter;
use crate::program::Programs;
use crate::routine::Routine;
use crate::symbolic::{Atom, Free, Id, Index, Loop, Node, Range, Renaming};

/// Where the walk is: inside of these loops, with the indices of the sums around as open ones.
#[derive(Clone, Default, PartialEq, Eq, Hash)]
struct Place {
    loops: Vec<Loop>,
    names: Vec<Renaming>,
}

/// An access: the loops around it, the length of the array as text, which says which row of a table it is,
/// the index.
#[derive(PartialEq, Eq, Hash)]
struct Access {
    loops: Vec<Loop>,
    array: String,
    length: String,
    index: Index,
}

/// The length of an array, and the indices that it depends on.
struct Length {
    tokens: TokenStream,
    free: Free,
}

struct Walk<'a> {
    emitter: &'a Emitter<'a>,
    seen: HashSet<Access>,
    visited: HashSet<(Place, Id)>,
    tokens: TokenStream,
}

pub(super) fn check(emitter: &Emitter<'_>, programs: &Programs) -> TokenStream {
    let mut walk =
        Walk { emitter, seen: HashSet::default(), visited: HashSet::default(), tokens: TokenStream::new() };
    let routines: Vec<&Routine> = programs.dynamics().chain(programs.observed()).collect();
    for statement in routines.iter().flat_map(|routine| &routine.statements) {
        walk.node(&Place { loops: statement.loops.clone(), names: Vec::new() }, statement.value.node);
    }
    let (krate, checks) = (emitter.krate(), walk.tokens);
    // Sizes that are literals, and const generics by themselves, are those of types.
    let is_checked = (0..emitter.model.blocks.len()).any(|block| !on_stack(emitter, block));
    let sizes = is_checked.then(|| quote!(#krate::__private::check_sizes(self)?;));
    quote!(#sizes #checks ::core::result::Result::Ok(()))
}

impl Place {
    fn index(&self, index: &Index) -> Index {
        self.names.iter().fold(index.clone(), |index, renaming| index.renamed(renaming))
    }

    /// Inside of a sum of this height over this range.
    fn inside(&self, height: u32, range: &Range) -> Self {
        let depth = self.loops.last().map_or(0, |innermost| innermost.depth + 1);
        let range = self.names.iter().fold(range.clone(), |range, renaming| range.renamed(renaming));
        let mut place = self.clone();
        place.loops.push(Loop { depth, range });
        place.names.push(Renaming { from: Atom::Bound(height), to: Atom::Open(depth) });
        place
    }
}

impl Walk<'_> {
    fn node(&mut self, place: &Place, id: Id) {
        if !self.visited.insert((place.clone(), id)) {
            return;
        }
        let model = self.emitter.model;
        match self.emitter.graph.node(id) {
            Node::Coordinate(c) | Node::Velocity(c) => {
                let block = &model.blocks[c.block as usize];
                let name = block.name.unraw();
                let names = [name.to_string(), format!("{name}[i]")];
                for ((index, size), name) in block.indices(&c.index).iter().zip(block.sizes()).zip(names) {
                    let index = place.index(index);
                    if !self.emitter.stays_inside(&index, &size, &place.loops) {
                        let length = self.emitter.index(&size);
                        let length = Length { tokens: length, free: Free::default() };
                        self.access(place, name, &length, &index);
                    }
                }
            }
            Node::Parameter(p) => {
                let parameter = &model.parameters[p.field as usize];
                let mut tokens = parameter.tokens.clone();
                let mut free = Free::default();
                for index in &p.indices {
                    let index = place.index(index);
                    let length = Length { tokens: quote!(#tokens.len()), free };
                    self.access(place, parameter.text.replace("r#", ""), &length, &index);
                    free = free.and(index.free());
                    let index = self.emitter.index(&index);
                    tokens = quote!(#tokens[#index]);
                }
            }
            Node::Reduce { height, range, body, .. } => {
                self.node(&place.inside(*height, range), body.node);
            }
            other => other.operands().into_iter().for_each(|operand| self.node(place, operand)),
        }
    }

    /// The check of one access, in the loops that it depends on: whatever else is around it may run or not,
    /// as it is read outside of what it does not depend on. Where its index goes on by one in the innermost
    /// loop, the bounds of that are enough.
    fn access(&mut self, place: &Place, array: String, length: &Length, index: &Index) {
        let mut needed = length.free.and(index.free()).open;
        let mut around: Vec<&Loop> = Vec::new();
        for over in place.loops.iter().rev() {
            if needed & (1 << over.depth) != 0 {
                needed |= over.range.free().open;
                around.push(over);
            }
        }
        let loops = around.iter().map(|over| (*over).clone()).collect();
        let access =
            Access { loops, array: array.clone(), length: length.tokens.to_string(), index: index.clone() };
        if !self.seen.insert(access) {
            return;
        }
        let mut around = around.into_iter().peekable();
        let run = around.next_if(|over| {
            let is_fixed = length.free.open & (1 << over.depth) == 0;
            is_fixed && over.range.left_out().next().is_none() && index.follows(over.depth)
        });
        let (krate, length) = (self.emitter.krate(), &length.tokens);
        let tokens = if let Some(over) = run {
            let [first, past] = [&over.range.lower, &over.range.upper].map(|bound| {
                self.emitter.wide_index(&index.plus(&Index::open(over.depth), -1).plus(bound, 1))
            });
            quote!(#krate::__private::check_indices(#array, #first, #past, #length)?;)
        } else {
            let value = self.emitter.wide_index(index);
            quote!(#krate::__private::check_index(#array, #value, #length)?;)
        };
        self.tokens.extend(around.fold(tokens, |tokens, over| self.emitter.loop_over(over, &tokens)));
    }
}
