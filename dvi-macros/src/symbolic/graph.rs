//! The expression graph: hash-consed, append-only.
//!
//! A node is stored once, so common subexpressions are shared by construction, and an id is larger
//! than the ids of its operands, so passes are loops in id order. An [`Expr`] is a literal factor
//! times a node: signs and literal factors stay outside of the nodes, and f and −2f are one node.

use rustc_hash::{FxHashMap as HashMap, FxHashSet as HashSet};
use std::hash::{Hash, Hasher};
use std::rc::Rc;

use super::functions::Unary;
use super::index::{Free, Index, Range};
use super::partial::Partial;
use super::polynomial::Polynomial;
use super::variables::Variables;
use crate::internal::internal;
use crate::work::step;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Id(pub(crate) u32);

/// `scale` · `node`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Expr {
    pub(crate) scale: f64,
    pub(crate) node: Id,
}

/// A coordinate or velocity: a block of the declaration and an index into it (0 for a single one).
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Coordinate {
    pub(crate) block: u32,
    pub(crate) index: Index,
}

/// A constant of the system: an entry of the model's table of parameters, indexed.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Parameter {
    pub(crate) field: u32,
    pub(crate) indices: Vec<Index>,
}

/// A factor that the caller of a generated function passes in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Weight {
    Qq,
    Qv,
    Vq,
    Vv,
    A,
    B,
    /// Of ∂a/∂q and of ∂a/∂v.
    Q,
    V,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Binary {
    Atan2,
    Hypot,
    Powf,
    /// w/R for a root R ≥ |w|, 0 where R is; the compiler makes it, users do not write it.
    OverRoot,
    /// u/(u² + w²), of which derivatives of `atan2` are made; the compiler makes it, users do not write it.
    OverSquares,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Relation {
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    /// Greater, in a branch that the compiler makes: of a number of terms that is not zero, or of a value
    /// that is finite. The other is zero, and no seam lies between them.
    HasMore,
}

impl Relation {
    pub(crate) fn holds(self, left: f64, right: f64) -> bool {
        match self {
            Self::Less => left < right,
            Self::LessOrEqual => left <= right,
            Self::Greater | Self::HasMore => left > right,
            Self::GreaterOrEqual => left >= right,
        }
    }
}

/// The pattern of nodes that hold no others, but for the one.
macro_rules! leaf {
    () => {
        Node::Coordinate(_)
            | Node::Velocity(_)
            | Node::Time
            | Node::Parameter(_)
            | Node::Count(_)
            | Node::Weight(_)
    };
}
pub(crate) use leaf;

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Node {
    One,
    Coordinate(Coordinate),
    Velocity(Coordinate),
    Time,
    Parameter(Parameter),
    /// An index as a number.
    Count(Index),
    Weight(Weight),
    /// Terms in id order, distinct nodes; the constant is the term on [`Node::One`]. There are two or more;
    /// a single one is a factor with its literal inside, which would be too large or small outside.
    Sum(Vec<Expr>),
    /// Factors with positive exponents in id order; never a single factor to the power one.
    Product(Vec<(Id, u32)>),
    Reciprocal(Id),
    Unary(Unary, Expr),
    Binary(Binary, Expr, Expr),
    /// The user's own function: entry of the model's table, order of the derivative, argument.
    Call(u32, u32, Expr),
    /// A function of several variables that holds data: entry of the model's table, derivative, arguments.
    ScalarField(u32, Partial, Vec<Expr>),
    /// `if left ~ right { then } else { otherwise }`
    Choose {
        left: Expr,
        relation: Relation,
        right: Expr,
        then: Expr,
        otherwise: Expr,
    },
    /// A sum or product over a range. It stays one.
    Reduce {
        fold: Fold,
        /// The name of its index in `body`: above the heights of all folds inside.
        height: u32,
        range: Range,
        /// A literal factor of a sum stands in front of it.
        body: Expr,
    },
}

/// How the values of a range are joined.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) enum Fold {
    Sum,
    Product,
}

#[derive(Clone, Debug, Default)]
pub(crate) struct Graph {
    nodes: Vec<Node>,
    /// The indices on which each node depends.
    free: Vec<Free>,
    /// The height that a fold around each node takes.
    heights: Vec<u32>,
    known: HashMap<Node, Id>,
    /// Whether the form of each node shows that it is zero or more.
    pub(super) never_negative: Vec<bool>,
    /// What each node depends on, of what has a number.
    pub(super) variables: Vec<Variables>,
    pub(super) numbers: HashMap<Id, usize>,
    /// Sums that derivatives made and that stand in no formula as written.
    pub(super) unsigned_sums: HashSet<Id>,
    pub(super) derivatives: HashMap<(Id, Id), Expr>,
    /// How many terms the sums of each node have, of those that were asked.
    pub(super) term_counts: HashMap<Id, Expr>,
    /// Nodes multiplied out, strictly and loosely, or nothing for those that are too long.
    pub(super) multiplied_out: HashMap<(Id, bool), Option<Rc<Polynomial>>>,
    /// The number of coordinates in each block of the declaration.
    pub(super) block_sizes: Vec<Index>,
}

impl PartialEq for Expr {
    fn eq(&self, other: &Self) -> bool {
        self.scale.to_bits() == other.scale.to_bits() && self.node == other.node
    }
}

impl Eq for Expr {}

impl Hash for Expr {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.scale.to_bits().hash(state);
        self.node.hash(state);
    }
}

impl Expr {
    pub(crate) const ZERO: Self = Self { scale: 0.0, node: Graph::ONE };
    pub(crate) const ONE: Self = Self { scale: 1.0, node: Graph::ONE };

    pub(crate) fn number(value: f64) -> Self {
        // One zero, so that equal expressions are equal nodes.
        Self { scale: if value == 0.0 { 0.0 } else { value }, node: Graph::ONE }
    }

    pub(crate) fn as_number(self) -> Option<f64> {
        (self.node == Graph::ONE).then_some(self.scale)
    }

    pub(crate) fn is_zero(self) -> bool {
        self.scale == 0.0
    }

    pub(crate) fn scaled(self, factor: f64) -> Self {
        let scale = self.scale * factor;
        if scale == 0.0 { Self::ZERO } else { Self { scale, node: self.node } }
    }

    pub(crate) fn negated(self) -> Self {
        self.scaled(-1.0)
    }
}

impl From<Id> for Expr {
    fn from(node: Id) -> Self {
        Self { scale: 1.0, node }
    }
}

/// A variable of a derivative: position or velocity.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Variable {
    Position,
    Velocity,
}

impl Node {
    pub(crate) fn is_position(&self) -> bool {
        matches!(self, Self::Coordinate(_))
    }

    pub(crate) fn is_velocity(&self) -> bool {
        matches!(self, Self::Velocity(_))
    }

    pub(crate) fn is_time(&self) -> bool {
        matches!(self, Self::Time)
    }

    /// Whether it changes along a motion.
    pub(crate) fn varies(&self) -> bool {
        self.is_position() || self.is_velocity() || self.is_time()
    }

    /// The operands; of a product its factors, without their exponents.
    pub(crate) fn parts(&self) -> Vec<Expr> {
        match self {
            Self::One | leaf!() => Vec::new(),
            Self::Sum(terms) | Self::ScalarField(_, _, terms) => terms.clone(),
            Self::Product(factors) => factors.iter().map(|(factor, _)| (*factor).into()).collect(),
            Self::Reciprocal(of) => vec![(*of).into()],
            Self::Unary(_, of) | Self::Call(_, _, of) | Self::Reduce { body: of, .. } => vec![*of],
            Self::Binary(_, a, b) => vec![*a, *b],
            Self::Choose { left, right, then, otherwise, .. } => vec![*left, *right, *then, *otherwise],
        }
    }

    pub(crate) fn operands(&self) -> Vec<Id> {
        self.parts().into_iter().map(|part| part.node).collect()
    }
}

impl Graph {
    pub(crate) const ONE: Id = Id(0);

    pub(crate) fn new(block_sizes: Vec<Index>) -> Self {
        let mut graph = Self { block_sizes, ..Self::default() };
        graph.intern(Node::One);
        graph
    }

    pub(crate) fn node(&self, id: Id) -> &Node {
        &self.nodes[id.0 as usize]
    }

    pub(crate) fn free(&self, id: Id) -> Free {
        self.free[id.0 as usize]
    }

    pub(super) fn height(&self, id: Id) -> u32 {
        self.heights[id.0 as usize]
    }

    pub(super) fn find(&self, node: &Node) -> Option<Id> {
        self.known.get(node).copied()
    }

    /// The id of a node that the constructors have brought to its normal form.
    pub(crate) fn intern(&mut self, node: Node) -> Id {
        if let Some(id) = self.known.get(&node) {
            return *id;
        }
        #[cfg(test)]
        assert!(super::tests::is_normal(self, &node), "{node:?}");
        let operands = node.operands();
        let inside = operands.iter().fold(Free::default(), |free, id| free.and(self.free(*id)));
        let highest = operands.iter().map(|id| self.height(*id)).max().unwrap_or(0);
        let (free, height) = match &node {
            Node::Coordinate(c) | Node::Velocity(c) => (c.index.free(), 0),
            Node::Parameter(p) => {
                (p.indices.iter().fold(Free::default(), |free, index| free.and(index.free())), 0)
            }
            Node::Count(index) => (index.free(), 0),
            Node::Reduce { height, range, .. } => {
                let rest = Free { bound: inside.bound & !(1 << height), ..inside };
                (rest.and(range.free()), height + 1)
            }
            _ => (inside, highest),
        };
        let Ok(number) = u32::try_from(self.nodes.len()) else { internal("the graph is full") };
        let id = Id(number);
        self.never_negative.push(self.stays_above_zero(&node));
        let variables = self.variables_below(&node, &operands);
        self.variables.push(variables);
        self.nodes.push(node.clone());
        self.free.push(free);
        self.heights.push(height);
        self.known.insert(node, id);
        id
    }

    /// Whether any formula, or anything that was made of one, has such a node.
    pub(crate) fn mentions(&self, property: impl FnMut(&Node) -> bool) -> bool {
        self.nodes.iter().any(property)
    }

    /// The nodes that the roots depend on, in id order.
    pub(crate) fn reachable(&self, roots: impl IntoIterator<Item = Id>) -> Vec<Id> {
        self.reachable_by(roots, Node::operands)
    }

    /// The same by some of the operands.
    pub(super) fn reachable_by(
        &self,
        roots: impl IntoIterator<Item = Id>,
        operands: impl Fn(&Node) -> Vec<Id>,
    ) -> Vec<Id> {
        let mut seen: HashSet<Id> = HashSet::default();
        let mut found: Vec<Id> = roots.into_iter().filter(|root| seen.insert(*root)).collect();
        let mut next = 0;
        while let Some(id) = found.get(next) {
            step();
            let operands = operands(self.node(*id));
            found.extend(operands.into_iter().filter(|operand| seen.insert(*operand)));
            next += 1;
        }
        found.sort_unstable();
        found
    }

    /// Whether any node below `root` (itself included) has the property.
    pub(crate) fn depends(&self, root: Id, property: impl Fn(&Node) -> bool) -> bool {
        self.reachable([root]).into_iter().any(|id| property(self.node(id)))
    }

    pub(crate) fn has_velocity(&self, root: Id) -> bool {
        self.depends(root, Node::is_velocity)
    }

    /// What a derivative is by.
    pub(crate) fn variable(&self, id: Id) -> (Variable, &Coordinate) {
        match self.node(id) {
            Node::Coordinate(coordinate) => (Variable::Position, coordinate),
            Node::Velocity(coordinate) => (Variable::Velocity, coordinate),
            other => internal(format!("a derivative by {other:?}")),
        }
    }

    /// The velocity of a position.
    pub(super) fn velocity_of(&mut self, position: Id) -> Id {
        let coordinate = self.variable(position).1.clone();
        self.intern(Node::Velocity(coordinate))
    }

    /// A function of several variables that stands below `root`.
    pub(crate) fn scalar_field_below(&self, root: Expr) -> Option<u32> {
        self.reachable([root.node]).into_iter().find_map(|id| match self.node(id) {
            Node::ScalarField(field, ..) => Some(*field),
            _ => None,
        })
    }

    /// Whether `node` stands below `root`, or is it.
    pub(super) fn depends_on(&self, root: Id, node: Id) -> bool {
        root >= node && self.reachable([root]).contains(&node)
    }

    /// The id that the next new node gets.
    pub(crate) fn next(&self) -> Id {
        Id(self.nodes.len() as u32)
    }
}
