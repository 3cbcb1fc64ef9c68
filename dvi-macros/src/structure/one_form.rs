//! Ω and Dα of a one-form.

use syn::Expr as Syntax;

use super::{Class, Entry, collected, has_matching};
use crate::errors::Errors;
use crate::formulas::dalpha;
use crate::lower::spinors::{STRENGTH, is_constant};
use crate::model::Model;
use crate::symbolic::{Coordinate, Expr, Graph, Index, Node, Range, SecondContribution};
use crate::words::AREA;

/// The structure of a one-form; see the constants of `dvi_core::DegenerateLagrangian`.
#[derive(Clone, Debug)]
pub(crate) struct OneForm {
    pub(crate) linear: bool,
    pub(crate) matching: bool,
    pub(crate) canonical: bool,
    /// The conjugate of each block, where canonical.
    pub(crate) conjugates: Vec<usize>,
    /// Whether one-step schemes can be used.
    pub(crate) class: Class,
    /// Blocks that Ω does not involve.
    untouched: Vec<usize>,
    /// Whether the places of Ω that are not zero leave room for an inverse.
    invertible: bool,
    /// Whether some area has a factor that is not constant.
    bends_areas: bool,
}

/// Ω = (Dα)ᵀ − Dα entry by entry: what (i, j) and (j, i) of Dα contribute, cancelled where they are the same
/// formula.
pub(super) fn omega(graph: &mut Graph, entries: &[SecondContribution]) -> Vec<Entry> {
    let above = dalpha(graph, entries).into_iter().filter(|(i, j, _)| i != j).map(|(i, j, entry)| {
        let (row, column, value) = if i < j { (i, j, entry.value.negated()) } else { (j, i, entry.value) };
        Entry { row, column, loops: entry.loops.clone(), value }
    });
    let above: Vec<Entry> = above.collect();
    collected(graph, above)
}

/// The conjugate of each block, if Ω couples block to block, entry by entry, and Dα holds nothing else but
/// entries on its diagonal.
fn conjugates<T>(
    model: &Model,
    omega: &[Entry],
    dalpha: &[(Coordinate, Coordinate, T)],
) -> Option<Vec<usize>> {
    let mut conjugates: Vec<Option<usize>> = vec![None; model.blocks.len()];
    for entry in omega {
        let [row, column] = entry.blocks();
        if row == column || entry.row.index != entry.column.index || !covers(model, row, column, entry) {
            return None;
        }
        for (one, other) in [(row, column), (column, row)] {
            if conjugates[one].is_some_and(|known| known != other) {
                return None;
            }
            conjugates[one] = Some(other);
        }
    }
    let conjugates: Vec<usize> = conjugates.into_iter().collect::<Option<_>>()?;
    // The same index on both sides: the diagonal of a block, or that between a block and its conjugate.
    let belongs = |(i, j, _): &(Coordinate, Coordinate, T)| {
        i.index == j.index && (i.block == j.block || conjugates[i.block as usize] == j.block as usize)
    };
    dalpha.iter().all(belongs).then_some(conjugates)
}

/// Whether the loops of an entry visit each index of its blocks.
fn covers(model: &Model, row: usize, column: usize, entry: &Entry) -> bool {
    match (entry.loops.as_slice(), &model.blocks[row].array, &model.blocks[column].array) {
        ([], None, None) => true,
        (loops, Some(_), Some(_)) => {
            let [sizes, others] = [row, column].map(|block| model.blocks[block].sizes());
            let ranges: Vec<Range> = sizes.iter().cloned().map(Range::up_to).collect();
            let indices: Vec<Index> = loops.iter().map(|over| Index::open(over.depth)).collect();
            sizes == others
                && loops.iter().map(|over| &over.range).eq(&ranges)
                && entry.row.index == model.blocks[row].place(&indices)
        }
        _ => false,
    }
}

impl OneForm {
    /// From α·v, its second derivative, and α·v as it was declared, without a gauge.
    pub(crate) fn new(
        graph: &mut Graph,
        model: &Model,
        one_form: Expr,
        entries: &[SecondContribution],
        declared: Expr,
    ) -> Self {
        let linear = entries.iter().all(|entry| !graph.depends(entry.value.node, Node::is_position))
            && !graph.depends(one_form.node, Node::is_time);
        let jacobian = dalpha(graph, entries);
        let diagonal = jacobian.iter().any(|(i, j, _)| i.block == j.block);
        let omega = omega(graph, entries);
        let places: Vec<[usize; 2]> = omega.iter().map(Entry::blocks).collect();
        let touched = |block: &usize| places.iter().any(|place| place.contains(block));
        let untouched = (0..model.blocks.len()).filter(|block| !touched(block)).collect();
        let conjugates = conjugates(model, &omega, &jacobian);
        let canonical = conjugates.is_some();
        let matching = canonical && !diagonal;
        let conjugates = conjugates.unwrap_or_else(|| (0..model.blocks.len()).collect());
        let invertible = has_matching(model, &places);
        let class =
            Class::new(graph, model, one_form).with_advice(graph, model, declared, declared != one_form);
        let bends_areas = jacobian.iter().any(|(i, _, entry)| {
            model.blocks[i.block as usize].is_spinor() && !is_constant(graph, entry.value.node)
        });
        Self { linear, matching, canonical, conjugates, class, untouched, invertible, bends_areas }
    }

    /// Reports what makes Ω singular for certain; `at` is the formula of α or L.
    pub(crate) fn check(&self, model: &Model, at: Option<&Syntax>, errors: &mut Errors) {
        let Some(at) = at else { return };
        // Those of a spinor are four.
        let numbers: Vec<usize> =
            (0..model.blocks.len()).filter(|block| !model.blocks[*block].is_spinor()).collect();
        let dimension =
            numbers.iter().fold(Index::default(), |sum, block| sum.plus(&model.block_size(*block), 1));
        let odd = dimension.as_literal().filter(|dimension| dimension % 2 != 0);
        if let (Some(dimension), Some(last)) = (odd, numbers.last()) {
            let beside = if model.has_spinors() { " beside the unit vectors" } else { "" };
            let message = format!(
                "Ω = -dα is nondegenerate in even dimension only, and the number of coordinates{beside} is \
                 {dimension}; add the conjugate coordinate or remove one"
            );
            errors.push(&model.blocks[*last].name, message);
            return;
        }
        if self.untouched.len() == model.blocks.len() {
            let message = "Ω = -dα is zero here, so nothing determines the motion; the one-form needs a term such as \
                           `p * d(q)` that is not the differential of a function";
            errors.push(at, message);
            return;
        }
        if self.untouched.is_empty() && self.class.is_too_small(model) {
            let message = format!(
                "Ω = -dα is singular for all parameters: α has components along {} only, less than half of the \
                 coordinates",
                self.class.names(model, true).join(", ")
            );
            errors.push(at, message);
            return;
        }
        if self.untouched.is_empty() && !self.invertible {
            let message = "Ω = -dα is singular for all parameters: its nonzero entries leave a coordinate without a \
                           conjugate; the one-form needs more terms such as `p * d(q)`";
            errors.push(at, message);
        }
        if self.bends_areas {
            errors.push(at, STRENGTH);
        }
        for block in &self.untouched {
            let block = &model.blocks[*block];
            let name = block.label();
            if block.is_spinor() {
                let message = format!(
                    "Ω = -dα does not involve the unit vector `{name}`, so that nothing determines its motion: the one-form needs a \
                     term `kappa * {AREA}({name})`"
                );
                errors.push_once(&format!("no area of {name}"), &block.name, message);
                continue;
            }
            let message = format!(
                "Ω = -dα does not involve `{name}`, so it is singular and the motion of `{name}` is not \
                 determined; the one-form needs a term that couples it, such as `{name} * d(other)`"
            );
            errors.push(&block.name, message);
        }
    }

    /// What is said of the structure in reports.
    pub(crate) fn sentences(&self, model: &Model, is_forced: bool) -> Vec<String> {
        let affine = match self.linear {
            true => "α is affine in q with constant coefficients: Ω is constant.",
            false => "α is nonlinear in q or depends on t.",
        };
        let conjugates = match self.canonical {
            true => {
                "Ω couples each coordinate to one conjugate: q' = X(q) takes one division per coordinate."
            }
            false => "Ω is dense: q' = X(q) takes one linear solve.",
        };
        if model.has_spinors() {
            let first = match self.linear {
                true => {
                    "Begin with `Sigma::midpoint()`, the implicit midpoint rule, or `Gauss`: they keep the lengths of unit vectors."
                }
                false => "Begin with `Gauss::<2>::new()`: it keeps the lengths of unit vectors.",
            };
            return [affine, conjugates, first].map(str::to_string).into();
        }
        let mut sentences = vec![affine];
        sentences.push(match self.linear {
            true => {
                "Of the σ-family any σ can be used where Dα is antisymmetric, σ = 0 and σ = 1 without an iteration; \
                 elsewhere σ = ½ alone."
            }
            false => "Of the σ-family σ = ½ alone can be used: Dα is not constant.",
        });
        sentences.push(conjugates);
        let mut sentences: Vec<String> = sentences.into_iter().map(str::to_string).collect();
        sentences.push(self.class.sentence(model));
        let one_step = match is_forced {
            true => "`OneStep::midpoint()`: it has no parasitic mode.",
            false => "`OneStep::midpoint()`: it has no parasitic mode and preserves Ω.",
        };
        sentences.push(match (self.linear, self.class.is_proper) {
            (false, false) if self.class.advice.is_some() => {
                format!("Begin with `gauge = auto` and {one_step}")
            }
            (false, true) => format!("Begin with {one_step}"),
            (true, _) => "Begin with `Sigma::midpoint()`: α is affine, so it is the implicit midpoint rule."
                .to_string(),
            (false, false) => {
                "Begin with `Gauss::<2>::new()`: α is not affine, and `Sigma` would have a parasitic mode."
                    .to_string()
            }
        });
        sentences
    }
}
