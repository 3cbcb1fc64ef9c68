//! Statements to instructions: n-ary products become multiplications that share what they can.
//!
//! A product of the graph is a multiset of factors. The pair of factors that occurs in the most
//! products is multiplied once, again and again, until no pair occurs twice (Breuer 1969); on a tie the
//! pair that is known furthest outside of the loops comes first, so that invariant factors meet before
//! the loop. Powers need no rule of their own: x⁴ is (x·x)·(x·x). A reciprocal with a single use becomes
//! the divisor of a quotient.

use std::collections::{BTreeMap, HashMap};

use crate::program::Statement;
use crate::symbolic::{Binary, Binder, Expr, Graph, Id, Node, Relation, Unary};

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(crate) struct Register(pub(crate) u32);

/// A register with a sign in front.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) struct Signed {
    pub(crate) negative: bool,
    pub(crate) register: Register,
}

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Instruction {
    /// A node without operands.
    Leaf(Id),
    /// The bits of a positive literal.
    Literal(u64),
    Multiply(Register, Register),
    Divide(Register, Register),
    /// Two or more terms.
    Sum(Vec<Signed>),
    Unary(Unary, Signed),
    Binary(Binary, Signed, Signed),
    Power(Register, u32),
    Call(u32, u32, Signed),
    Choose(Signed, Relation, Signed, Signed, Signed),
    Reduce(Binder, Register),
}

/// The instructions of one function, operands before their users.
#[derive(Debug, Default)]
pub(crate) struct Instructions {
    list: Vec<Instruction>,
    free: Vec<u64>,
    known: HashMap<Instruction, Register>,
}

/// Above this exponent a power is a call of `powi`.
const LARGEST_EXPANDED: u32 = 32;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
enum Factor {
    Literal(u64),
    Node(Id),
    Power(Id, u32),
    Pair(u32),
}

/// |scale|·node as a multiset of factors over an optional divisor.
#[derive(Clone, Debug, Default)]
struct Product {
    factors: Vec<Factor>,
    divisor: Option<Id>,
}

type Key = (u64, Id);

struct Builder<'a> {
    graph: &'a Graph,
    products: BTreeMap<Key, Product>,
    pairs: Vec<(Factor, Factor)>,
    out: Instructions,
    values: HashMap<Id, Register>,
}

/// The instructions and, for each statement, its value.
pub(crate) fn select(graph: &Graph, statements: &[Statement]) -> (Instructions, Vec<Signed>) {
    let mut builder = Builder {
        graph,
        products: BTreeMap::new(),
        pairs: Vec::new(),
        out: Instructions::default(),
        values: HashMap::new(),
    };
    builder.gather(statements);
    builder.split_divisors();
    builder.share_pairs();
    let values = statements.iter().map(|statement| builder.signed(statement.value)).collect();
    (builder.out, values)
}

impl Instruction {
    pub(crate) fn operands(&self) -> Vec<Register> {
        match self {
            Self::Leaf(_) | Self::Literal(_) => Vec::new(),
            Self::Multiply(a, b) | Self::Divide(a, b) => vec![*a, *b],
            Self::Sum(terms) => terms.iter().map(|term| term.register).collect(),
            Self::Unary(_, a) | Self::Call(_, _, a) => vec![a.register],
            Self::Power(a, _) | Self::Reduce(_, a) => vec![*a],
            Self::Binary(_, a, b) => vec![a.register, b.register],
            Self::Choose(a, _, b, c, d) => vec![a.register, b.register, c.register, d.register],
        }
    }
}

impl Instructions {
    pub(crate) fn get(&self, register: Register) -> &Instruction {
        &self.list[register.0 as usize]
    }

    pub(crate) fn free(&self, register: Register) -> u64 {
        self.free[register.0 as usize]
    }

    pub(crate) fn len(&self) -> usize {
        self.list.len()
    }

    fn push(&mut self, instruction: Instruction, leaf_free: u64) -> Register {
        if let Some(register) = self.known.get(&instruction) {
            return *register;
        }
        let operands =
            instruction.operands().into_iter().fold(leaf_free, |free, operand| free | self.free(operand));
        let free = match &instruction {
            Instruction::Reduce(binder, _) => (operands & !(1 << binder.level)) | binder.free(),
            _ => operands,
        };
        let register = Register(self.list.len() as u32);
        self.list.push(instruction.clone());
        self.free.push(free);
        self.known.insert(instruction, register);
        register
    }

    /// The registers that the roots depend on, in order.
    pub(crate) fn reachable(&self, roots: impl IntoIterator<Item = Register>) -> Vec<Register> {
        let mut seen = vec![false; self.list.len()];
        roots.into_iter().for_each(|root| seen[root.0 as usize] = true);
        for position in (0..seen.len()).rev() {
            if seen[position] {
                self.list[position]
                    .operands()
                    .into_iter()
                    .for_each(|operand| seen[operand.0 as usize] = true);
            }
        }
        (0..seen.len()).filter(|position| seen[*position]).map(|position| Register(position as u32)).collect()
    }
}

impl Builder<'_> {
    /// All products among the values and the operands of the nodes below them.
    fn gather(&mut self, statements: &[Statement]) {
        for statement in statements {
            self.note(statement.value);
        }
        for id in self.graph.reachable(statements.iter().map(|statement| statement.value.node)) {
            match self.graph.node(id) {
                Node::Sum(terms) => terms.iter().for_each(|term| self.note(*term)),
                Node::Reciprocal(of) | Node::Reduce(_, of) => self.note((*of).into()),
                Node::Unary(_, of) | Node::Call(_, _, of) => self.note(*of),
                Node::Binary(_, a, b) => [*a, *b].into_iter().for_each(|part| self.note(part)),
                Node::Choose { left, right, then, otherwise, .. } => {
                    [*left, *right, *then, *otherwise].into_iter().for_each(|part| self.note(part));
                }
                _ => {}
            }
        }
    }

    fn note(&mut self, expr: Expr) {
        let Some(key) = self.product_key(expr) else { return };
        let literal = f64::from_bits(key.0);
        let mut factors = Vec::new();
        if literal != 1.0 {
            factors.push(Factor::Literal(key.0));
        }
        let mut add = |id: Id, exponent: u32| match exponent {
            0..=LARGEST_EXPANDED => factors.extend(std::iter::repeat_n(Factor::Node(id), exponent as usize)),
            _ => factors.push(Factor::Power(id, exponent)),
        };
        match self.graph.node(expr.node) {
            Node::Product(powers) => powers.iter().for_each(|(id, exponent)| add(*id, *exponent)),
            _ => add(expr.node, 1),
        }
        self.products.entry(key).or_insert(Product { factors, divisor: None });
    }

    /// The key of the product that an expression is, if it is one.
    fn product_key(&self, expr: Expr) -> Option<Key> {
        let magnitude = expr.scale.abs();
        let product = matches!(self.graph.node(expr.node), Node::Product(_) | Node::Reciprocal(_));
        (expr.node != Graph::ONE && (magnitude != 1.0 || product)).then(|| (magnitude.to_bits(), expr.node))
    }

    fn split_divisors(&mut self) {
        let mut uses: HashMap<Id, usize> = HashMap::new();
        for product in self.products.values() {
            for factor in &product.factors {
                if let Factor::Node(id) = factor {
                    *uses.entry(*id).or_default() += 1;
                }
            }
        }
        for product in self.products.values_mut() {
            let single = product.factors.iter().position(|factor| match factor {
                Factor::Node(id) => uses[id] == 1 && matches!(self.graph.node(*id), Node::Reciprocal(_)),
                _ => false,
            });
            if let Some(position) = single
                && let Factor::Node(id) = product.factors.remove(position)
                && let Node::Reciprocal(of) = self.graph.node(id)
            {
                product.divisor = Some(*of);
            }
        }
    }

    fn share_pairs(&mut self) {
        let mut counts: BTreeMap<(Factor, Factor), i64> = BTreeMap::new();
        let mut products: Vec<Vec<Factor>> =
            self.products.values().map(|product| product.factors.clone()).collect();
        for factors in &products {
            count_pairs(factors, 1, &mut counts);
        }
        loop {
            let best = counts.iter().max_by_key(|(pair, count)| {
                (**count, std::cmp::Reverse((self.depth(pair.0).max(self.depth(pair.1)), **pair)))
            });
            let Some((pair, 2..)) = best.map(|(pair, count)| (*pair, *count)) else { break };
            let fresh = Factor::Pair(self.pairs.len() as u32);
            self.pairs.push(pair);
            for factors in &mut products {
                let times = occurrences(factors, pair);
                if times > 0 {
                    count_pairs(factors, -1, &mut counts);
                    for _ in 0..times {
                        remove(factors, pair.0);
                        remove(factors, pair.1);
                        factors.push(fresh);
                    }
                    count_pairs(factors, 1, &mut counts);
                }
            }
        }
        for (product, factors) in self.products.values_mut().zip(products) {
            product.factors = factors;
        }
    }

    fn free(&self, factor: Factor) -> u64 {
        match factor {
            Factor::Literal(_) => 0,
            Factor::Node(id) | Factor::Power(id, _) => self.graph.free(id),
            Factor::Pair(pair) => {
                let (a, b) = self.pairs[pair as usize];
                self.free(a) | self.free(b)
            }
        }
    }

    fn depth(&self, factor: Factor) -> u32 {
        64 - self.free(factor).leading_zeros()
    }

    fn signed(&mut self, expr: Expr) -> Signed {
        let negative = expr.scale < 0.0;
        let register = if expr.node == Graph::ONE {
            self.literal(expr.scale.abs())
        } else if let Some(key) = self.product_key(expr) {
            self.product(key)
        } else {
            self.value(expr.node)
        };
        Signed { negative, register }
    }

    fn literal(&mut self, value: f64) -> Register {
        self.out.push(Instruction::Literal(value.to_bits()), 0)
    }

    fn product(&mut self, key: Key) -> Register {
        let mut product = self.products.get(&key).cloned().unwrap_or_default();
        product.factors.sort_by_key(|factor| (self.depth(*factor), *factor));
        let mut registers = Vec::new();
        for factor in product.factors {
            registers.push(self.factor(factor));
        }
        let numerator = registers.into_iter().reduce(|a, b| self.out.push(Instruction::Multiply(a, b), 0));
        let numerator = match numerator {
            Some(numerator) => numerator,
            None => self.literal(1.0),
        };
        match product.divisor {
            Some(of) => {
                let divisor = self.value(of);
                self.out.push(Instruction::Divide(numerator, divisor), 0)
            }
            None => numerator,
        }
    }

    fn factor(&mut self, factor: Factor) -> Register {
        match factor {
            Factor::Literal(bits) => self.literal(f64::from_bits(bits)),
            Factor::Node(id) => self.value(id),
            Factor::Power(id, exponent) => {
                let base = self.value(id);
                self.out.push(Instruction::Power(base, exponent), 0)
            }
            Factor::Pair(pair) => {
                let (a, b) = self.pairs[pair as usize];
                let (a, b) = (self.factor(a), self.factor(b));
                self.out.push(Instruction::Multiply(a, b), 0)
            }
        }
    }

    fn value(&mut self, id: Id) -> Register {
        if let Some(known) = self.values.get(&id) {
            return *known;
        }
        let graph = self.graph;
        let instruction = match graph.node(id) {
            Node::Product(_) => return self.product((1.0_f64.to_bits(), id)),
            Node::Reciprocal(of) => {
                let (one, of) = (self.literal(1.0), self.value(*of));
                Instruction::Divide(one, of)
            }
            Node::Sum(terms) => Instruction::Sum(terms.iter().map(|term| self.signed(*term)).collect()),
            Node::Unary(function, of) => Instruction::Unary(*function, self.signed(*of)),
            Node::Binary(function, a, b) => Instruction::Binary(*function, self.signed(*a), self.signed(*b)),
            Node::Call(function, order, of) => Instruction::Call(*function, *order, self.signed(*of)),
            Node::Choose { left, relation, right, then, otherwise } => {
                let [left, right, then, otherwise] =
                    [left, right, then, otherwise].map(|part| self.signed(*part));
                Instruction::Choose(left, *relation, right, then, otherwise)
            }
            Node::Reduce(binder, body) => {
                Instruction::Reduce(binder.clone(), self.signed((*body).into()).register)
            }
            Node::One => Instruction::Literal(1.0_f64.to_bits()),
            _ => Instruction::Leaf(id),
        };
        let leaf_free = if matches!(instruction, Instruction::Leaf(_)) { graph.free(id) } else { 0 };
        let register = self.out.push(instruction, leaf_free);
        self.values.insert(id, register);
        register
    }
}

fn multiplicity(factors: &[Factor], factor: Factor) -> usize {
    factors.iter().filter(|known| **known == factor).count()
}

fn occurrences(factors: &[Factor], (a, b): (Factor, Factor)) -> usize {
    if a == b { multiplicity(factors, a) / 2 } else { multiplicity(factors, a).min(multiplicity(factors, b)) }
}

fn remove(factors: &mut Vec<Factor>, factor: Factor) {
    if let Some(position) = factors.iter().position(|known| *known == factor) {
        factors.remove(position);
    }
}

fn count_pairs(factors: &[Factor], sign: i64, counts: &mut BTreeMap<(Factor, Factor), i64>) {
    let mut distinct = factors.to_vec();
    distinct.sort_unstable();
    distinct.dedup();
    for (position, a) in distinct.iter().enumerate() {
        for b in &distinct[position..] {
            let times = occurrences(factors, (*a, *b)) as i64;
            if times > 0 {
                let count = counts.entry((*a, *b)).or_default();
                *count += sign * times;
                if *count == 0 {
                    counts.remove(&(*a, *b));
                }
            }
        }
    }
}
