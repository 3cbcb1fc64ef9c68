//! Formulas as they are written: an unsimplified tree, its evaluation, its way into the graph, and a
//! strategy that grows random ones.

use proptest::prelude::*;

use super::evaluate::Point;
use super::field::Field;
use crate::symbolic::{
    Atom, Binary, Coordinate, Expr, Fold, Graph, Index, Node, Parameter, Partial, Range as Values, Relation,
    Size, Unary,
};

/// The range of a sum; `j` is the index of the sum around it, if there is one.
#[derive(Clone, Copy, Debug)]
pub(super) enum Range {
    Whole,
    /// 0..j + 1
    UpTo,
    /// j + 1..n
    Beyond,
    /// 0..n without j
    Except,
}

/// An index: the bound one of the sum `up` levels further out, moved around by `shift`; outside of all
/// sums, `shift` alone.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) up: usize,
    pub(super) shift: i64,
}

#[derive(Clone, Debug)]
pub(super) enum Tree {
    Number(f64),
    Coordinate(u32, Place),
    Velocity(u32, Place),
    Parameter(Place),
    Time,
    /// The index of a sum as a number.
    Count(Place),
    Negated(Box<Tree>),
    Add(Box<Tree>, Box<Tree>),
    Subtract(Box<Tree>, Box<Tree>),
    Multiply(Box<Tree>, Box<Tree>),
    Divide(Box<Tree>, Box<Tree>),
    Powi(Box<Tree>, i32),
    Unary(Unary, Box<Tree>),
    Binary(Binary, Box<Tree>, Box<Tree>),
    Own(Box<Tree>),
    /// A function of two variables: the sine of a + 2b.
    ScalarField(Box<Tree>, Box<Tree>),
    Choose(Box<[Tree; 4]>, Relation),
    Sum(Range, Box<Tree>),
}

/// Number of blocks of coordinates; the first of them has velocities in the formulas.
pub(super) const BLOCKS: usize = 2;

fn size() -> Index {
    Index::size(Size(0))
}

impl Range {
    fn values(self, depth: u32) -> Values {
        let whole = Values::up_to(size());
        let Some(outer) = depth.checked_sub(1).map(Index::open) else { return whole };
        let next = outer.plus(&Index::literal(1), 1);
        match self {
            Self::Whole => whole,
            Self::UpTo => Values { upper: next, ..whole },
            Self::Beyond => Values { lower: next, ..whole },
            Self::Except => Values { except: Some(outer), ..whole },
        }
    }

    fn indices(self, n: i64, outer: Option<i64>) -> Vec<i64> {
        let all = 0..n;
        match (self, outer) {
            (Self::Whole, _) | (_, None) => all.collect(),
            (Self::UpTo, Some(j)) => all.filter(|k| *k <= j).collect(),
            (Self::Beyond, Some(j)) => all.filter(|k| *k > j).collect(),
            (Self::Except, Some(j)) => all.filter(|k| *k != j).collect(),
        }
    }
}

impl Place {
    fn index(self, depth: u32) -> Index {
        match depth {
            0 => Index::literal(self.shift),
            _ => {
                let bound = Index::open(depth - 1 - self.up as u32 % depth);
                match self.shift {
                    0 => bound,
                    shift => bound.plus(&Index::literal(shift), 1).remainder(&size()),
                }
            }
        }
    }

    fn value(self, n: i64, open: &[i64]) -> usize {
        let from = if open.is_empty() { 0 } else { open[open.len() - 1 - self.up % open.len()] };
        (from + self.shift).rem_euclid(n) as usize
    }
}

impl Tree {
    /// The value on numbers of any kind: `variables` are the coordinates, then the velocities.
    pub(super) fn evaluate<F: Field>(&self, point: &Point, variables: &[F], open: &mut Vec<i64>) -> F {
        let n = point.size();
        let mut value = |tree: &Self| tree.evaluate(point, variables, open);
        match self {
            Self::Number(number) => F::lift(*number),
            Self::Coordinate(block, place) => variables[*block as usize * n as usize + place.value(n, open)],
            Self::Velocity(block, place) => {
                variables[(BLOCKS + *block as usize) * n as usize + place.value(n, open)]
            }
            Self::Parameter(place) => F::lift(point.parameters[place.value(n, open)]),
            Self::Time => F::lift(point.time),
            Self::Count(place) => F::lift(place.value(n, open) as f64),
            Self::Negated(of) => -value(of),
            Self::Add(a, b) => value(a) + value(b),
            Self::Subtract(a, b) => value(a) - value(b),
            Self::Multiply(a, b) => value(a) * value(b),
            Self::Divide(a, b) => value(a) / value(b),
            Self::Powi(of, exponent) => {
                let base = value(of);
                let power = (0..exponent.unsigned_abs()).fold(F::lift(1.0), |power, _| power * base);
                if *exponent < 0 { F::lift(1.0) / power } else { power }
            }
            Self::Unary(function, of) => F::unary(*function, value(of)),
            Self::Own(of) => F::unary(Unary::Sin, value(of)),
            Self::ScalarField(a, b) => F::unary(Unary::Sin, value(a) + F::lift(2.0) * value(b)),
            Self::Binary(function, a, b) => {
                let (a, b) = (value(a), value(b));
                match function {
                    // Right of the origin only.
                    Binary::Atan2 => F::unary(Unary::Atan, a / b),
                    Binary::Hypot => F::unary(Unary::Sqrt, a * a + b * b),
                    Binary::Powf => F::unary(Unary::Exp, b * F::unary(Unary::Ln, a)),
                    Binary::OverRoot => a / b,
                    Binary::OverSquares => a / (a * a + b * b),
                }
            }
            Self::Choose(parts, relation) => {
                let [left, right, then, otherwise] = &**parts;
                match F::ordered(value(left), value(right)) {
                    None => F::lift(f64::NAN),
                    Some(less) => {
                        let wants_less = matches!(relation, Relation::Less | Relation::LessOrEqual);
                        value(if less == wants_less { then } else { otherwise })
                    }
                }
            }
            Self::Sum(range, body) => {
                let outer = open.last().copied();
                range.indices(n, outer).into_iter().fold(F::lift(0.0), |sum, j| {
                    open.push(j);
                    let term = body.evaluate(point, variables, open);
                    open.pop();
                    sum + term
                })
            }
        }
    }

    /// The same through the constructors.
    pub(super) fn lower(&self, graph: &mut Graph, depth: u32) -> Expr {
        match self {
            Self::Number(number) => Expr::number(*number),
            Self::Coordinate(block, place) => {
                let coordinate = Coordinate { block: *block, index: place.index(depth) };
                graph.intern(Node::Coordinate(coordinate)).into()
            }
            Self::Velocity(block, place) => {
                let coordinate = Coordinate { block: *block, index: place.index(depth) };
                graph.intern(Node::Velocity(coordinate)).into()
            }
            Self::Parameter(place) => {
                let parameter = Parameter { field: 0, indices: vec![place.index(depth)] };
                graph.intern(Node::Parameter(parameter)).into()
            }
            Self::Time => graph.intern(Node::Time).into(),
            Self::Count(place) => graph.count(place.index(depth)),
            Self::Negated(of) => of.lower(graph, depth).negated(),
            Self::Add(a, b) => Self::both(graph, depth, a, b, Graph::add),
            Self::Subtract(a, b) => Self::both(graph, depth, a, b, Graph::subtract),
            Self::Multiply(a, b) => Self::both(graph, depth, a, b, Graph::multiply),
            Self::Divide(a, b) => Self::both(graph, depth, a, b, Graph::divide),
            Self::Powi(of, exponent) => {
                let of = of.lower(graph, depth);
                graph.powi(of, *exponent)
            }
            Self::Unary(function, of) => {
                let of = of.lower(graph, depth);
                graph.unary(*function, of)
            }
            Self::Own(of) => {
                let of = of.lower(graph, depth);
                graph.call(0, 0, of)
            }
            Self::ScalarField(a, b) => Self::both(graph, depth, a, b, |graph, a, b| {
                graph.scalar_field(0, Partial::Value, vec![a, b])
            }),
            Self::Binary(function, a, b) => {
                Self::both(graph, depth, a, b, |graph, a, b| graph.binary(*function, a, b))
            }
            Self::Choose(parts, relation) => {
                let [left, right, then, otherwise] = parts.each_ref().map(|part| part.lower(graph, depth));
                graph.choose(left, *relation, right, then, otherwise)
            }
            Self::Sum(range, body) => {
                let body = body.lower(graph, depth + 1);
                graph.fold(Fold::Sum, Atom::Open(depth), range.values(depth), body)
            }
        }
    }

    fn both(
        graph: &mut Graph,
        depth: u32,
        a: &Self,
        b: &Self,
        join: impl FnOnce(&mut Graph, Expr, Expr) -> Expr,
    ) -> Expr {
        let (a, b) = (a.lower(graph, depth), b.lower(graph, depth));
        join(graph, a, b)
    }

    /// 1 + u²
    fn above_one(self) -> Self {
        Self::Add(Box::new(Self::Number(1.0)), Box::new(Self::Powi(Box::new(self), 2)))
    }

    /// u/(1 + u²), which is at most one half.
    fn small(self) -> Self {
        Self::Divide(Box::new(self.clone()), Box::new(self.above_one()))
    }

    /// f of an argument in its domain that u decides.
    fn within_domain(function: Unary, u: Self) -> Self {
        let argument = match function {
            Unary::Sqrt | Unary::Cbrt | Unary::Ln | Unary::Ln1p | Unary::Log2 | Unary::Log10 => {
                u.above_one()
            }
            Unary::Acosh => u.above_one().above_one(),
            Unary::Sin | Unary::Cos | Unary::Atan | Unary::Abs | Unary::Signum | Unary::Erf => u,
            _ => u.small(),
        };
        Self::Unary(function, Box::new(argument))
    }
}

fn place() -> impl Strategy<Value = Place> {
    (0..3_usize, prop_oneof![3 => Just(0_i64), 1 => 1..3_i64]).prop_map(|(up, shift)| Place { up, shift })
}

fn leaf() -> impl Strategy<Value = Tree> {
    let number = prop_oneof![
        prop::sample::select(vec![0.0, 1.0, -1.0, 2.0, 0.5, -3.0]),
        (-2.0..2.0_f64).prop_filter("a number", |value| value.abs() > 0.01),
    ];
    prop_oneof![
        2 => number.prop_map(Tree::Number),
        5 => (0..BLOCKS as u32, place()).prop_map(|(block, place)| Tree::Coordinate(block, place)),
        1 => place().prop_map(|place| Tree::Velocity(0, place)),
        1 => place().prop_map(Tree::Parameter),
        1 => Just(Tree::Time),
        1 => place().prop_map(Tree::Count),
    ]
}

/// Every function of the first table, by name.
fn unary() -> impl Strategy<Value = Unary> {
    let names = crate::symbolic::unary_names();
    prop::sample::select(names.filter_map(crate::symbolic::unary_by_name).collect::<Vec<_>>())
}

fn relation() -> impl Strategy<Value = Relation> {
    prop::sample::select(vec![
        Relation::Less,
        Relation::LessOrEqual,
        Relation::Greater,
        Relation::GreaterOrEqual,
    ])
}

/// Random formulas with sums in them, as often as `sums` says, if at all.
pub(super) fn tree(sums: u32) -> impl Strategy<Value = Tree> {
    leaf().prop_recursive(5, 24, 3, move |inner| {
        let boxed = || inner.clone().prop_map(Box::new);
        let pair = || (boxed(), boxed());
        let range = prop::sample::select(vec![Range::Whole, Range::UpTo, Range::Beyond, Range::Except]);
        let half_integers = prop::sample::select(vec![-1.5, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 2.5, 0.3]);
        let summed = (range, boxed()).prop_map(|(range, body)| Tree::Sum(range, body)).boxed();
        let plain = prop_oneof![
            1 => boxed().prop_map(Tree::Negated),
            3 => pair().prop_map(|(a, b)| Tree::Add(a, b)),
            3 => pair().prop_map(|(a, b)| Tree::Subtract(a, b)),
            4 => pair().prop_map(|(a, b)| Tree::Multiply(a, b)),
            2 => pair().prop_map(|(a, b)| Tree::Divide(a, b)),
            1 => (boxed(), inner.clone())
                .prop_map(|(a, b)| Tree::Divide(a, Box::new(b.above_one()))),
            2 => (boxed(), prop_oneof![8 => -3..5_i32, 1 => Just(40)]).prop_map(|(of, exponent)| Tree::Powi(of, exponent)),
            4 => (unary(), inner.clone()).prop_map(|(function, u)| Tree::within_domain(function, u)),
            1 => boxed().prop_map(Tree::Own),
            1 => pair().prop_map(|(a, b)| Tree::ScalarField(a, b)),
            1 => (boxed(), inner.clone())
                .prop_map(|(a, b)| Tree::Binary(Binary::Atan2, a, Box::new(b.above_one()))),
            1 => (boxed(), inner.clone())
                .prop_map(|(a, b)| Tree::Binary(Binary::Hypot, a, Box::new(b.above_one()))),
            1 => (inner.clone(), inner.clone()).prop_map(|(a, b)| {
                Tree::Binary(Binary::Powf, Box::new(a.above_one()), Box::new(b.small()))
            }),
            1 => (inner.clone(), half_integers).prop_map(|(a, exponent)| {
                Tree::Binary(Binary::Powf, Box::new(a.above_one()), Box::new(Tree::Number(exponent)))
            }),
            1 => (inner.clone(), inner.clone(), inner.clone(), inner.clone(), relation())
                .prop_map(|(a, b, c, d, relation)| Tree::Choose(Box::new([a, b, c, d]), relation)),
        ];
        if sums == 0 { plain.boxed() } else { prop_oneof![24 => plain, sums => summed].boxed() }
    })
}

/// Random points of three bodies.
pub(super) fn point() -> impl Strategy<Value = Point> {
    let array = || prop::collection::vec(prop_oneof![-1.7..-0.2_f64, 0.2..1.7_f64], 3);
    (prop::collection::vec(array(), BLOCKS), prop::collection::vec(array(), BLOCKS), array(), 0.3..1.9_f64)
        .prop_map(|(coordinates, velocities, parameters, time)| Point {
            coordinates,
            velocities,
            parameters,
            time,
        })
}
