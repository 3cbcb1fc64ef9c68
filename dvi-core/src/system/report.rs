//! What the macro saw of a system, as data that prints.

use core::fmt;

use super::Factor;
use crate::name::Axis;

/// A block of coordinates: `x`, or `x[n]`, or `q[n][m]`, or those of `r[n][3]` or `s[n]: S2` along one axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CoordinateBlock {
    /// The name.
    pub name: &'static str,
    /// The size as written in the attribute, without the outer brackets: `n`, or `n][m`; empty for a single
    /// coordinate.
    pub size: &'static str,
    /// The component, of vectors: their blocks follow each other, and have one name.
    pub axis: Option<Axis>,
    /// Where the block lives.
    pub factor: Factor,
}

/// A quantity and its formula as text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Formula {
    /// What it is: `H`, `∂H/∂x[i]`.
    pub name: &'static str,
    /// The formula.
    pub text: &'static str,
}

/// The operations of one pass through the body of one loop nest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OperationCount {
    /// The loops, outermost first, as `i in 0..n`; empty for straight-line code.
    pub loops: &'static str,
    /// Additions and subtractions.
    pub additions: usize,
    /// Multiplications.
    pub multiplications: usize,
    /// Divisions.
    pub divisions: usize,
    /// Calls of elementary functions and of the user's own.
    pub calls: usize,
}

/// A set of entries of a matrix that can differ from zero.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    /// The coordinate of the row, as `x[i]`.
    pub row: &'static str,
    /// The coordinate of the column, as `y[i]`.
    pub column: &'static str,
    /// The loops that the indices run over; empty for one entry.
    pub loops: &'static str,
}

/// What the compiler saw of a system. `println!("{}", System::REPORT)` shows all of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Report {
    /// The name of the struct.
    pub system: &'static str,
    /// The coordinates in the order in which flat slices hold them: each block has a `name`, a `size` as it
    /// is written, empty for a single coordinate, an `axis`, if it is a component of vectors, and a `factor`,
    /// where it lives.
    pub coordinates: &'static [CoordinateBlock],
    /// The names of the declared momenta.
    pub momenta: &'static [&'static str],
    /// The names of the declared events.
    pub events: &'static [&'static str],
    /// The formulas, as declared and as differentiated, each with a `name`, such as `∂H/∂x[i]`, and a `text`.
    pub formulas: &'static [Formula],
    /// Statements on the structure, a sentence each: linear or nonlinear α, explicit or implicit steps.
    pub structure: &'static [&'static str],
    /// Operations of the residual (first derivatives of L), for each nest of `loops`: `additions`,
    /// `multiplications`, `divisions` and `calls` in one pass.
    pub residual: &'static [OperationCount],
    /// Operations of the residual and the exact Jacobian together.
    pub jacobian: &'static [OperationCount],
    /// The sparsity of the Jacobian: sets of entries, each in a `row` and a `column`, for all passes of
    /// `loops`.
    pub sparsity: &'static [Entry],
}

impl Report {
    #[doc(hidden)]
    #[allow(clippy::too_many_arguments)]
    pub const fn new(
        system: &'static str,
        coordinates: &'static [CoordinateBlock],
        momenta: &'static [&'static str],
        events: &'static [&'static str],
        formulas: &'static [Formula],
        structure: &'static [&'static str],
        residual: &'static [OperationCount],
        jacobian: &'static [OperationCount],
        sparsity: &'static [Entry],
    ) -> Self {
        Self { system, coordinates, momenta, events, formulas, structure, residual, jacobian, sparsity }
    }
}

impl fmt::Display for CoordinateBlock {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, size, axis, factor } = self;
        f.write_str(name)?;
        // A single rotation has the size of its nine entries.
        if !size.is_empty() && (*factor == Factor::Line || axis.is_some()) {
            write!(f, "[{size}]")?;
        }
        match (factor, axis) {
            (Factor::Line, None) => Ok(()),
            (Factor::Line, Some(axis)) => write!(f, "[{}]", axis.of),
            (Factor::Rotation, _) => f.write_str(": SO3"),
            (Factor::Sphere, _) => f.write_str(": S2"),
        }
    }
}

impl fmt::Display for OperationCount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let nest = if self.loops.is_empty() { "once" } else { self.loops };
        let Self { additions, multiplications, divisions, calls, .. } = *self;
        let counts = [
            (additions, "addition"),
            (multiplications, "multiplication"),
            (divisions, "division"),
            (calls, "call"),
        ];
        write!(f, "{nest}: ")?;
        for (place, (count, what)) in counts.into_iter().enumerate() {
            let (comma, plural) = (if place == 0 { "" } else { ", " }, if count == 1 { "" } else { "s" });
            write!(f, "{comma}{count} {what}{plural}")?;
        }
        Ok(())
    }
}

impl fmt::Display for Entry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({}, {})", self.row, self.column)?;
        if self.loops.is_empty() { Ok(()) } else { write!(f, " for {}", self.loops) }
    }
}

fn section<I>(f: &mut fmt::Formatter<'_>, title: &str, lines: I) -> fmt::Result
where
    I: IntoIterator<Item: fmt::Display>,
{
    writeln!(f, "{title}")?;
    lines.into_iter().try_for_each(|line| writeln!(f, "  {line}"))
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.system)?;
        let is_first = |block: &&CoordinateBlock| block.axis.is_none_or(|axis| axis.number == 0);
        section(f, "coordinates", self.coordinates.iter().filter(is_first))?;
        writeln!(f, "formulas")?;
        for formula in self.formulas {
            writeln!(f, "  {} = {}", formula.name, formula.text)?;
        }
        section(f, "structure", self.structure)?;
        section(f, "operations of the residual", self.residual)?;
        section(f, "operations of residual and Jacobian", self.jacobian)?;
        section(f, "entries of the Jacobian", self.sparsity)
    }
}
