//! The check of all indices against the arrays that they go to.
//!
//! Sizes that only the run knows can disagree with each other: a parameter array shorter than the
//! coordinates, a neighbour beyond the last one. The generated check walks the loops of the formulas
//! once, before the first step, and names the first index that is out of range.

use std::collections::HashSet;

use proc_macro2::TokenStream;
use quote::quote;

use crate::emit::Emitter;
use crate::program::{Programs, Statement};
use crate::symbolic::{Binder, Id, Index, Node};

/// An access: the loops around it, those among them that only decide whether there is a pass, the array
/// as text, the index.
#[derive(PartialEq, Eq, Hash)]
struct Access {
    loops: Vec<Binder>,
    guards: Vec<Binder>,
    array: String,
    index: Index,
}

struct Walk<'a> {
    emitter: &'a Emitter<'a>,
    seen: HashSet<Access>,
    visited: HashSet<(Vec<Binder>, Id)>,
    tokens: TokenStream,
}

pub(super) fn check(emitter: &Emitter<'_>, programs: &Programs) -> TokenStream {
    let mut walk =
        Walk { emitter, seen: HashSet::new(), visited: HashSet::new(), tokens: TokenStream::new() };
    for statement in [&programs.lagrangian].into_iter().chain(&programs.momenta).flatten() {
        walk.statement(statement);
    }
    let checks = walk.tokens;
    quote!(#checks ::core::result::Result::Ok(()))
}

impl Walk<'_> {
    fn statement(&mut self, statement: &Statement) {
        self.node(&statement.loops, statement.value.node);
    }

    fn node(&mut self, loops: &[Binder], id: Id) {
        // Other loops decide nothing but how often a node is visited.
        let free = self.emitter.graph.free(id);
        let (needed, guards) = relevant(loops, free);
        let loops: Vec<Binder> = needed.into_iter().chain(guards).collect();
        if !self.visited.insert((loops.clone(), id)) {
            return;
        }
        match self.emitter.graph.node(id) {
            Node::Coordinate(c) | Node::Velocity(c) => {
                let block = &self.emitter.model.blocks[c.block as usize];
                if block.array.is_some() {
                    let length = self.emitter.index(&self.emitter.model.block_size(c.block as usize));
                    self.access(&loops, c.index.free(), block.name.to_string(), &length, &c.index);
                }
            }
            Node::Parameter(p) => {
                let mut place = self.emitter.model.parameters[p.field as usize].tokens.clone();
                let mut free = 0;
                for index in &p.indices {
                    free |= index.free();
                    let name = self.emitter.model.parameters[p.field as usize].text.clone();
                    let length = quote!(#place.len());
                    self.access(&loops, free, name, &length, index);
                    let index = self.emitter.index(index);
                    place = quote!(#place[#index]);
                }
            }
            Node::Reduce(binder, body) => {
                let inside: Vec<Binder> = loops.iter().chain([binder]).cloned().collect();
                self.node(&inside, *body);
            }
            other => other.operands().into_iter().for_each(|operand| self.node(&loops, operand)),
        }
    }

    /// The check of one access, inside the loops that the index and the array depend on: in each of their
    /// passes in which the loops that depend on these have a pass too, if the index has an offset.
    fn access(&mut self, loops: &[Binder], free: u64, array: String, length: &TokenStream, index: &Index) {
        let (loops, guards) = relevant(loops, free);
        let guards = if index.is_plain() { Vec::new() } else { guards };
        let access = Access {
            loops: loops.clone(),
            guards: guards.clone(),
            array: array.clone(),
            index: index.clone(),
        };
        if !self.seen.insert(access) || self.is_whole_range(&loops, &array, index) {
            return;
        }
        let krate = self.emitter.krate();
        let value = self.emitter.signed_index(index);
        let mut tokens = quote!(#krate::__private::check_index(#array, #value, #length)?;);
        if !guards.is_empty() {
            // The first pass of these loops is enough.
            tokens = quote!(#tokens break '__guarded;);
            for binder in guards.iter().rev() {
                tokens = self.emitter.loop_over(binder, &tokens);
            }
            tokens = quote!('__guarded: { #tokens });
        }
        for binder in loops.iter().rev() {
            tokens = self.emitter.loop_over(binder, &tokens);
        }
        self.tokens.extend(tokens);
    }

    /// `x[j]` for j in 0..(the size of x) needs no check.
    fn is_whole_range(&self, loops: &[Binder], array: &str, index: &Index) -> bool {
        let model = self.emitter.model;
        let Some(block) = model.blocks.iter().position(|block| block.name == array) else { return false };
        match loops {
            [.., binder] if *index == Index::bound(binder.level) => binder.upper == model.block_size(block),
            [] => index.as_literal().zip(model.block_size(block).as_literal()).is_some(),
            _ => false,
        }
    }
}

/// The loops that a set of levels depends on, ranges of ranges included; and of the others those that may
/// be empty because of them, with what their ranges depend on.
fn relevant(loops: &[Binder], free: u64) -> (Vec<Binder>, Vec<Binder>) {
    let level = |binder: &Binder| 1_u64 << binder.level;
    let with_ranges = |levels: u64| {
        loops.iter().rev().fold(levels, |levels, binder| {
            if levels & level(binder) != 0 { levels | binder.free() } else { levels }
        })
    };
    let needed = with_ranges(free);
    let dependent =
        loops.iter().fold(
            needed,
            |levels, binder| {
                if binder.free() & levels != 0 { levels | level(binder) } else { levels }
            },
        );
    let all = with_ranges(dependent);
    let kept = loops.iter().filter(|binder| all & level(binder) != 0).cloned();
    kept.partition(|binder| needed & level(binder) != 0)
}
