//! The search for a gauge: a function F with α + dF in the class of one-step schemes.
//!
//! Along a half y of the coordinates, F is to have the gradient −α_y. It is put together component by
//! component: each that is left is integrated in its own coordinate, and what that adds to the other
//! components is seen when these are taken anew. Halves are made of whole blocks. Of those that succeed the
//! one with the shortest one-form is taken. The search works on a copy of the graph and ends in text, which
//! goes the way of a gauge that the user has written.

use syn::Expr as Syntax;

use super::Class;
use super::one_form::omega;
use crate::errors::listed;
use crate::model::Model;
use crate::print::{print_expr, print_loops, write_expr};
use crate::symbolic::{Contribution, Expr, Graph, Id, Index, Node, Terms};

/// A one-form of more nodes than these is not searched.
const LONGEST: usize = 400;
/// So many halves are tried.
const MOST_HALVES: usize = 70;
/// Halves of more blocks are not listed.
const MOST_BLOCKS: usize = 16;

/// What a search may cost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Effort {
    /// The user asks for the best gauge.
    Asked,
    /// The first one is good advice, if it is found at once.
    Advice,
}

impl Effort {
    /// A search that has made so many nodes ends without an answer.
    fn most_nodes(self) -> u32 {
        match self {
            Self::Asked => 6000,
            Self::Advice => 1500,
        }
    }
}

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
    /// This function of the user's has no third derivative.
    ThirdDerivative(String),
    /// The search has become too long.
    Room,
}

pub(crate) fn search(graph: &Graph, model: &Model, one_form: Expr, effort: Effort) -> Search {
    let mut graph = graph.clone();
    if Class::new(&mut graph, model, one_form).is_proper {
        return Search::NotNeeded;
    }
    if model.has_spinors() {
        return Search::None("that of unit vectors, `area(s)`, has no such half".to_string());
    }
    if graph.reachable([one_form.node]).len() > LONGEST {
        return Search::None("the one-form is too long for the search".to_string());
    }
    if model.blocks.len() > MOST_BLOCKS {
        return Search::None(format!("the search takes at most {MOST_BLOCKS} blocks of coordinates"));
    }
    let coupled = coupled(&mut graph, model, one_form);
    let (all, halves) = halves(model, &coupled);
    if halves.is_empty() {
        let reason = match all {
            0 => {
                "no blocks of coordinates together are half of all, and the search takes a block as a whole"
            }
            _ => "Ω couples coordinates of every half to each other",
        };
        return Search::None(reason.to_string());
    }
    let components = graph.components(one_form, Expr::ZERO);
    let positive = graph.positive(components.iter().map(|part| part.value.node));
    let mut reasons = Vec::new();
    let mut best: Option<((bool, usize), Found)> = None;
    // Denominators with parameters in them are a last resort.
    for may_divide in [false, true] {
        let last = Id(graph.next().0 + effort.most_nodes());
        let terms = Terms { positive: &positive, may_divide, last };
        for half in halves.iter().take(MOST_HALVES) {
            let attempt = clear(&mut graph, model, one_form, half, terms).and_then(|function| {
                let form = graph.with_differential(one_form, function);
                let found = found(&mut graph, model, form, function)?;
                let depends_on_time = graph.depends(function.node, Node::is_time);
                Ok(((depends_on_time, graph.reachable([form.node]).len()), found))
            });
            match attempt {
                Ok((cost, found)) if best.as_ref().is_none_or(|(known, _)| cost < *known) => {
                    best = Some((cost, found));
                }
                Ok(_) => {}
                Err(lacking) => {
                    let reason = lacking.sentence(&graph, model, half);
                    if !reasons.contains(&reason) {
                        reasons.push(reason);
                    }
                }
            }
            if best.is_some() && effort == Effort::Advice {
                break;
            }
        }
        if best.is_some() || effort == Effort::Advice {
            break;
        }
    }
    match best {
        Some((_, found)) => Search::Found(found),
        None => {
            reasons.truncate(2);
            Search::None(reasons.join("; "))
        }
    }
}

/// F as text, if α + dF is in class.
fn found(graph: &mut Graph, model: &Model, form: Expr, function: Expr) -> Result<Found, Lacking> {
    let class = Class::new(graph, model, form);
    let below = graph.reachable([function.node]);
    let lacking = below.into_iter().find_map(|id| match graph.node(id) {
        Node::Call(number, ..) if !model.has_third_derivative(*number) => {
            Some(model.functions[*number as usize].name.to_string())
        }
        _ => None,
    });
    if let Some(name) = lacking {
        return Err(Lacking::ThirdDerivative(name));
    }
    let text = write_expr(graph, function, model).ok_or(Lacking::Words)?;
    let formula = syn::parse_str(&text).map_err(|_| Lacking::Words)?;
    if !class.is_proper {
        return Err(Lacking::Gradient);
    }
    Ok(Found { text, formula, without: class.names(model, false) })
}

/// The pairs of single coordinates that Ω couples for certain: no gauge removes the components along both.
fn coupled(graph: &mut Graph, model: &Model, one_form: Expr) -> Vec<[usize; 2]> {
    let entries = graph.hessian(one_form);
    let mut coupled = Vec::new();
    for entry in omega(graph, &entries) {
        let pair = entry.blocks();
        let are_single = pair.iter().all(|&block| model.blocks[block].array.is_none());
        let rest = graph.multiplied_out(&[entry.value]);
        if are_single && rest.is_some_and(|rest| !rest.is_zero()) && !graph.vanishes(&[entry.value]) {
            coupled.push(pair);
        }
    }
    coupled
}

/// How many sets of blocks make half of the coordinates, and those among them that Ω does not couple to
/// themselves, sets of later blocks first.
fn halves(model: &Model, coupled: &[[usize; 2]]) -> (usize, Vec<Vec<usize>>) {
    let sizes: Vec<Index> = (0..model.blocks.len()).map(|block| model.block_size(block)).collect();
    let members = |set: u32| (0..sizes.len()).filter(move |block| set & (1 << block) != 0);
    let are_single = model.blocks.iter().all(|block| block.array.is_none());
    let size = |set: u32| members(set).fold(Index::default(), |sum, block| sum.plus(&sizes[block], 1));
    let all = (1_u32 << sizes.len()) - 1;
    let is_half = |set: &u32| match are_single {
        true => 2 * set.count_ones() as usize == sizes.len(),
        false => size(*set) == size(all & !*set),
    };
    let halves: Vec<u32> = (1..all).rev().filter(is_half).collect();
    let is_free =
        |set: &&u32| !coupled.iter().any(|pair| pair.iter().all(|block| **set & (1 << block) != 0));
    // What the time transformation adds along the time stays there: formulas do not know its energy.
    let keeps_time = |set: &&u32| model.extended.is_none_or(|extended| **set & (1 << extended.time) == 0);
    (
        halves.len(),
        halves.iter().filter(is_free).filter(keeps_time).map(|set| members(*set).collect()).collect(),
    )
}

/// A function F such that α + dF has no component along these blocks.
fn clear(
    graph: &mut Graph,
    model: &Model,
    one_form: Expr,
    half: &[usize],
    terms: Terms<'_>,
) -> Result<Expr, Lacking> {
    let mut function = Expr::ZERO;
    let mut components = graph.components(one_form, function);
    let rounds = 2 * components.len() + 2 * model.blocks.len();
    for _ in 0..rounds {
        if graph.next() > terms.last {
            return Err(Lacking::Room);
        }
        let left = components.into_iter().find(|part| half.contains(&block_of(graph, part.target)));
        let Some(part) = left else { return Ok(function) };
        let coordinate = graph.variable(part.target).1.clone();
        let position = graph.intern(Node::Coordinate(coordinate));
        let Some(integral) = graph.antiderivative(part.value, position, terms) else {
            return Err(Lacking::Antiderivative(part));
        };
        if let Some(field) = graph.scalar_field_below(integral) {
            return Err(Lacking::ThirdDerivative(model.scalar_fields[field as usize].text.clone()));
        }
        let term = part.loops.into_iter().rev().fold(integral, |term, outer| graph.summed(term, outer));
        function = graph.subtract(function, term);
        components = graph.components(one_form, function);
    }
    Err(Lacking::Gradient)
}

fn block_of(graph: &Graph, velocity: Id) -> usize {
    graph.variable(velocity).1.block as usize
}

impl Lacking {
    fn sentence(&self, graph: &Graph, model: &Model, half: &[usize]) -> String {
        let names = listed(half.iter().map(|block| model.blocks[*block].label()));
        match self {
            Self::Antiderivative(part) => {
                let value = print_expr(graph, part.value, part.loops.len(), model);
                let block = model.blocks[block_of(graph, part.target)].label();
                let loops = match part.loops.as_slice() {
                    [] => String::new(),
                    loops => format!(" for {}", print_loops(loops, model)),
                };
                format!(
                    "the component `{value}`{loops} along `{block}` could not be integrated in `{block}`"
                )
            }
            Self::Gradient => {
                format!("no function was found with the gradient of the components along {names}")
            }
            Self::Room => {
                format!("the search for what removes the components along {names} became too long")
            }
            Self::ThirdDerivative(name) => {
                format!("what removes the components along {names} needs the third derivative of `{name}`")
            }
            Self::Words => {
                format!("the function that removes the components along {names} cannot be written")
            }
        }
    }
}
