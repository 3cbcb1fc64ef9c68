//! The search for a gauge: a function F with α + dF in the class of one-step schemes.
//!
//! Along a half y of the coordinates, F is to have the gradient −α_y. It is put together component by
//! component: each that is left is integrated in its own coordinate, and what that adds to the other
//! components is seen when these are taken anew. Halves are made of whole blocks. Of those that succeed the one
//! with the shortest one-form is taken. The search works on a copy of the graph and ends in text, which goes
//! the way of a gauge that the user has written.

use syn::Expr as Syntax;

use super::Class;
use crate::errors::listed;
use crate::model::Model;
use crate::symbolic::{Contribution, Expr, Graph, Id, Index, Node, print_expr, print_loops, write_expr};

/// A one-form of more nodes than these is not searched.
const LONGEST: usize = 400;
/// A search that has made so many nodes ends without an answer.
const MOST_NODES: u32 = 6000;
/// So many halves are tried.
const MOST_HALVES: usize = 70;

/// What a search has come to.
pub(crate) enum Search {
    /// α is in class as it stands.
    NotNeeded,
    Found(Found),
    /// None was found: why, in words.
    None(String),
}

#[derive(Clone, Debug)]
pub(crate) struct Found {
    /// F in the language of the attribute.
    pub(crate) text: String,
    pub(crate) formula: Syntax,
    /// The names of the coordinates along which α + dF has no component.
    pub(crate) without: Vec<String>,
}

/// Why there is no gauge for one half.
enum Lacking {
    Antiderivative(Contribution),
    Gradient,
    Words,
    /// The search has become too long.
    Room,
}

pub(crate) fn search(graph: &Graph, model: &Model, one_form: Expr) -> Search {
    let mut graph = graph.clone();
    if Class::new(&mut graph, model, one_form).is_proper {
        return Search::NotNeeded;
    }
    if graph.reachable([one_form.node]).len() > LONGEST {
        return Search::None("the one-form is too long for the search".to_string());
    }
    let halves = halves(model);
    if halves.is_empty() {
        let reason =
            "no blocks of coordinates together are half of all, and the search takes a block as a whole";
        return Search::None(reason.to_string());
    }
    let written = graph.next();
    let mut reasons = Vec::new();
    let mut best: Option<(usize, Found)> = None;
    for half in halves.into_iter().take(MOST_HALVES) {
        let attempt = clear(&mut graph, model, one_form, &half, written).and_then(|function| {
            let form = graph.with_differential(one_form, function);
            let found = found(&mut graph, model, form, function).ok_or(Lacking::Words)?;
            Ok((graph.reachable([form.node]).len(), found))
        });
        match attempt {
            Ok((length, found)) if best.as_ref().is_none_or(|(known, _)| length < *known) => {
                best = Some((length, found));
            }
            Ok(_) => {}
            Err(lacking) => reasons.push(lacking.sentence(&graph, model, &half)),
        }
    }
    match best {
        Some((_, found)) => Search::Found(found),
        None => {
            reasons.dedup();
            reasons.truncate(2);
            Search::None(reasons.join("; "))
        }
    }
}

/// F as text, if α + dF is in class.
fn found(graph: &mut Graph, model: &Model, form: Expr, function: Expr) -> Option<Found> {
    let class = Class::new(graph, model, form);
    let is_known =
        |node: &Node| !matches!(node, Node::Call(number, ..) if !model.has_third_derivative(*number));
    if !graph.reachable([function.node]).into_iter().all(|id| is_known(graph.node(id))) {
        return None;
    }
    let text = write_expr(graph, function, model)?;
    let formula = syn::parse_str(&text).ok()?;
    class.is_proper.then(|| Found { text, formula, without: class.names(model, false) })
}

/// The sets of blocks that make half of the coordinates, those of later blocks first.
fn halves(model: &Model) -> Vec<Vec<usize>> {
    const MOST_BLOCKS: usize = 12;
    let blocks = model.blocks.len();
    if blocks > MOST_BLOCKS {
        return Vec::new();
    }
    let members = |set: u32| (0..blocks).filter(move |block| set & (1 << block) != 0);
    let size =
        |set: u32| members(set).fold(Index::default(), |sum, block| sum.plus(&model.block_size(block), 1));
    let all = (1_u32 << blocks) - 1;
    (1..all).rev().filter(|set| size(*set) == size(all & !set)).map(|set| members(set).collect()).collect()
}

/// A function F such that α + dF has no component along these blocks.
fn clear(
    graph: &mut Graph,
    model: &Model,
    one_form: Expr,
    half: &[usize],
    written: Id,
) -> Result<Expr, Lacking> {
    let mut function = Expr::ZERO;
    let is_long = |graph: &Graph| graph.next().0 > written.0 + MOST_NODES;
    let mut components = graph.components(one_form, function);
    let rounds = 2 * components.len() + 2 * model.blocks.len();
    for _ in 0..rounds {
        if is_long(graph) {
            return Err(Lacking::Room);
        }
        let left = components.into_iter().find(|part| half.contains(&block_of(graph, part.target)));
        let Some(part) = left else { return Ok(function) };
        let position = position_of(graph, part.target);
        let Some(integral) = graph.antiderivative(part.value, position, written) else {
            return Err(Lacking::Antiderivative(part));
        };
        let term = part.loops.into_iter().rev().fold(integral, |term, outer| graph.summed(term, outer));
        function = graph.subtract(function, term);
        components = graph.components(one_form, function);
    }
    Err(Lacking::Gradient)
}

fn block_of(graph: &Graph, velocity: Id) -> usize {
    match graph.node(velocity) {
        Node::Velocity(coordinate) => coordinate.block as usize,
        other => crate::internal::internal(format!("a component along {other:?}")),
    }
}

fn position_of(graph: &mut Graph, velocity: Id) -> Id {
    match graph.node(velocity).clone() {
        Node::Velocity(coordinate) => graph.intern(Node::Coordinate(coordinate)),
        other => crate::internal::internal(format!("a component along {other:?}")),
    }
}

impl Lacking {
    fn sentence(&self, graph: &Graph, model: &Model, half: &[usize]) -> String {
        let names: Vec<String> = half.iter().map(|block| model.blocks[*block].name.to_string()).collect();
        let names = listed(names.iter().map(String::as_str));
        match self {
            Self::Antiderivative(part) => {
                let value = print_expr(graph, part.value, part.loops.len(), model);
                let block = &model.blocks[block_of(graph, part.target)].name;
                let loops = match part.loops.as_slice() {
                    [] => String::new(),
                    loops => format!(" for {}", print_loops(loops, model)),
                };
                format!("the component `{value}`{loops} along `{block}` could not be integrated in `{block}`")
            }
            Self::Gradient => {
                format!("no function was found with the gradient of the components along {names}")
            }
            Self::Room => format!("the search for what removes the components along {names} became too long"),
            Self::Words => {
                format!("the function that removes the components along {names} cannot be written")
            }
        }
    }
}
