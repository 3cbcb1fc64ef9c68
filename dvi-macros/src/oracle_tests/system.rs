//! A system under test: its declarations, its formulas, and the numbers that its struct holds.

use super::formula::{Formula, Index};
use crate::syntax::{Constrained, Factor};

/// How the size of an array is written, and what it is in the test.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Size {
    pub(super) kind: SizeKind,
    pub(super) value: i64,
}

#[derive(Clone, Debug, PartialEq)]
pub(super) enum SizeKind {
    Literal,
    /// `const N: usize`
    Constant(&'static str),
    /// A field of type `usize`.
    Field(&'static str),
    /// The length of an array of the struct.
    Length(&'static str),
    /// Two sizes of the table.
    Product(usize, usize),
}

/// The type of a field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Container {
    /// `f64`
    Scalar,
    /// `i32`
    Integer,
    /// `[f64; n]`
    Array,
    Vector,
    /// `&'a [f64]`
    Slice,
    /// `[[f64; n]; n]`
    Matrix,
    /// `Vec<Vec<f64>>`
    VectorOfVectors,
    /// `Vec<[f64; n]>`
    VectorOfArrays,
}

#[derive(Clone, Debug)]
pub(super) struct Field {
    pub(super) name: &'static str,
    pub(super) container: Container,
    /// The sizes of its entries, as entries of the table of sizes.
    pub(super) shape: Vec<usize>,
    /// Its entries, row by row.
    pub(super) values: Vec<f64>,
}

#[derive(Clone, Debug)]
pub(super) struct Block {
    pub(super) name: &'static str,
    pub(super) size: Option<usize>,
    /// The component that it is, and how many there are, if it is one of vectors.
    pub(super) axis: Option<[usize; 2]>,
    pub(super) factor: Factor,
}

/// What the attribute declares.
#[derive(Clone, Debug)]
pub(super) enum Dynamics {
    /// α as a sum of `… * d(x)`, and H.
    OneForm(Formula, Formula),
    /// α as a list of components, and H. The index of a component is that of level 0.
    Components(Vec<Formula>, Formula),
    /// `#[degenerate_lagrangian(lagrangian = …)]`
    Affine(Formula),
    /// `#[lagrangian(lagrangian = …)]`
    Regular(Formula),
}

/// What is added to α.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Gauge {
    None,
    Formula(Formula),
    /// Whatever the compiler finds.
    Auto,
}

/// A constraint as it is declared, alone or one for each index in a range, or each pair of indices. They are
/// those of the levels 0 and 1.
#[derive(Clone, Debug)]
pub(super) struct Constraint {
    pub(super) ranges: Vec<(Index, Index)>,
    pub(super) formula: Formula,
}

#[derive(Clone, Debug)]
pub(super) struct System {
    pub(super) sizes: Vec<Size>,
    pub(super) fields: Vec<Field>,
    pub(super) blocks: Vec<Block>,
    /// The number of components of all vectors.
    pub(super) width: usize,
    pub(super) dynamics: Dynamics,
    pub(super) gauge: Gauge,
    /// ρ; then the last two blocks are the time and the energy, which the attribute does not declare.
    pub(super) time_transform: Option<Formula>,
    /// The forces, each on a block. The index of an entry is that of level 0.
    pub(super) forces: Vec<(usize, Formula)>,
    /// R of the force −∂R/∂v.
    pub(super) dissipation: Option<Formula>,
    pub(super) constraints: Vec<Constraint>,
    pub(super) constrained: Constrained,
    pub(super) momenta: Vec<Formula>,
}

/// The coordinates that a time transformation adds.
const EXTENDED: [&str; 2] = ["t", "energy"];

impl Block {
    /// A number, or an array of numbers.
    pub(super) fn line(name: &'static str, size: Option<usize>) -> Self {
        Self { name, size, axis: None, factor: Factor::Line }
    }
}

impl System {
    /// With nothing but a motion.
    pub(super) fn of(sizes: Vec<Size>, blocks: Vec<Block>, dynamics: Dynamics) -> Self {
        Self {
            sizes,
            fields: Vec::new(),
            blocks,
            width: 0,
            dynamics,
            gauge: Gauge::None,
            time_transform: None,
            forces: Vec::new(),
            dissipation: None,
            constraints: Vec::new(),
            constrained: Constrained::Positions,
            momenta: Vec::new(),
        }
    }

    pub(super) fn size_values(&self) -> Vec<i64> {
        self.sizes.iter().map(|size| size.value).collect()
    }

    pub(super) fn block_length(&self, block: usize) -> usize {
        self.blocks[block].size.map_or(1, |size| self.sizes[size].value as usize)
    }

    /// Where the coordinates of a block begin in a flat slice.
    pub(super) fn offset(&self, block: usize) -> usize {
        (0..block).map(|before| self.block_length(before)).sum()
    }

    pub(super) fn dimension(&self) -> usize {
        self.offset(self.blocks.len())
    }

    /// The first block of each coordinate that the attribute declares.
    pub(super) fn coordinates(&self) -> Vec<usize> {
        let is_first = |block: &usize| self.blocks[*block].axis.is_none_or(|[number, _]| number == 0);
        (0..self.declared_blocks().len()).filter(is_first).collect()
    }

    /// The number of blocks of the coordinate that begins with one.
    pub(super) fn axes(&self, first: usize) -> usize {
        self.blocks[first].axis.map_or(1, |[_, of]| of)
    }

    /// Whether an array is a vector as a whole.
    pub(super) fn is_whole(&self, block: usize) -> bool {
        let Block { size, axis, .. } = &self.blocks[block];
        axis.is_none() && size.is_some_and(|size| self.is_width(size))
    }

    /// Whether a size is the number of components of vectors.
    pub(super) fn is_width(&self, size: usize) -> bool {
        self.sizes[size] == Size { kind: SizeKind::Literal, value: self.width as i64 }
    }

    /// The blocks that the attribute declares.
    pub(super) fn declared_blocks(&self) -> &[Block] {
        let added = if self.time_transform.is_some() { EXTENDED.len() } else { 0 };
        &self.blocks[..self.blocks.len() - added]
    }

    /// The places of the time and of the energy among the coordinates, if the time is transformed.
    pub(super) fn extended(&self) -> Option<[usize; 2]> {
        let first = self.blocks.len().checked_sub(EXTENDED.len())?;
        self.time_transform.as_ref().map(|_| [self.offset(first), self.offset(first + 1)])
    }

    pub(super) fn with_time_transform(mut self, rate: Formula) -> Self {
        self.blocks.extend(EXTENDED.map(|name| Block::line(name, None)));
        Self { time_transform: Some(rate), ..self }
    }

    pub(super) fn without_time_transform(mut self) -> Self {
        self.blocks.truncate(self.declared_blocks().len());
        Self { time_transform: None, ..self }
    }

    pub(super) fn is_regular(&self) -> bool {
        matches!(self.dynamics, Dynamics::Regular(_))
    }

    /// Whether one of its formulas is such a one, or has it inside.
    pub(super) fn has(&self, is_one: &dyn Fn(&Formula) -> bool) -> bool {
        self.clone().formulas_mut().into_iter().any(|formula| formula.has(is_one))
    }

    /// Whether it calls this function of several variables.
    pub(super) fn evaluates(&self, field: usize) -> bool {
        self.has(&|part| matches!(part, Formula::ScalarField(known, _) if *known == field))
    }

    /// Whether it calls this function of the user's.
    pub(super) fn calls(&self, function: usize) -> bool {
        self.has(&|part| matches!(part, Formula::Own(known, _) if *known == function))
    }

    /// All formulas, to be changed in place.
    pub(super) fn formulas_mut(&mut self) -> Vec<&mut Formula> {
        let mut formulas = match &mut self.dynamics {
            Dynamics::OneForm(one_form, hamiltonian) => vec![one_form, hamiltonian],
            Dynamics::Components(components, hamiltonian) => {
                components.iter_mut().chain([hamiltonian]).collect()
            }
            Dynamics::Affine(lagrangian) | Dynamics::Regular(lagrangian) => vec![lagrangian],
        };
        if let Gauge::Formula(gauge) = &mut self.gauge {
            formulas.push(gauge);
        }
        formulas.extend(&mut self.time_transform);
        formulas.extend(self.forces.iter_mut().map(|(_, force)| force));
        formulas.extend(&mut self.dissipation);
        formulas.extend(self.constraints.iter_mut().map(|constraint| &mut constraint.formula));
        formulas.extend(&mut self.momenta);
        formulas
    }

    /// `|i| component` of a block as Σ componentᵢ·d(xᵢ), or component·d(x).
    pub(super) fn component_term(&self, block: usize, component: &Formula) -> Formula {
        let along = |index: Option<Index>| match (self.axes(block), component.is_vector()) {
            (1, false) => component.clone().times(Formula::Velocity(block, index)),
            _ => component.clone().dot(Formula::VectorVelocity(block, index)),
        };
        match self.blocks[block].size {
            None => along(None),
            Some(_) if self.axes(block) == 1 && component.is_vector() => along(None),
            Some(size) => {
                let term = along(Some(Index::bound(0)));
                let upper = Index::atom(super::formula::Atom::Size(size));
                Formula::Sum(super::formula::Loops::Single, 0, Index::literal(0), upper, Box::new(term))
            }
        }
    }
}
