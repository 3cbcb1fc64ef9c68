//! Statements to instructions: n-ary products become multiplications that share what they can.
//!
//! A product of the graph is a multiset of factors. The pair of factors that occurs in the most
//! products is multiplied once, again and again, until no pair occurs twice (Breuer 1969); on a tie the
//! pair that is known furthest outside of the loops comes first, so that invariant factors meet before
//! the loop. Powers need no rule of their own: x⁴ is (x·x)·(x·x), and x⁵⁰/y⁵⁰ is (x/y)⁵⁰. A reciprocal
//! that is left with a single use becomes the divisor of a quotient. Factors in front of a sum move into
//! it where the product inside is computed anyway, as it is when a sum and a scatter share their loop.

use std::collections::{BTreeMap, BTreeSet};
use std::iter::repeat_n;

use rustc_hash::{FxHashMap as HashMap, FxHashSet as HashSet};

use crate::instructions::{Instruction, Instructions, Register, Signed};
use crate::internal::internal;
use crate::statement::Statement;
use crate::symbolic::{Expr, Fold, Free, Graph, Id, Loop, Node, leaf};

mod share;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
enum Factor {
    Literal(u64),
    Node(Id),
    Pair(u32),
}

/// |scale|·node.
type Key = (u64, Id);

/// Distinct factors and how often each occurs.
type Powers = Vec<(Factor, u32)>;

struct Pair {
    factors: [Factor; 2],
    /// The indices on which it depends.
    free: Free,
}

struct Builder<'a> {
    graph: &'a mut Graph,
    /// Products whose factors are shared. Every other product is what its node says.
    products: BTreeMap<Key, Powers>,
    /// Products of a sum that are sums of this product.
    absorbed: HashMap<Key, (Loop, Key)>,
    /// Sums and products over a range as loops, each with its body inside of that loop.
    loops: HashMap<Id, (Fold, Loop, Expr)>,
    pairs: Vec<Pair>,
    /// Reciprocals with a single use.
    divisors: HashSet<Factor>,
    out: Instructions,
    values: HashMap<Id, Register>,
}

/// The instructions and, for each statement, its value.
pub(crate) fn select(graph: &mut Graph, statements: &[Statement]) -> (Instructions, Vec<Signed>) {
    let mut builder = Builder {
        graph,
        products: BTreeMap::new(),
        absorbed: HashMap::default(),
        loops: HashMap::default(),
        pairs: Vec::new(),
        divisors: HashSet::default(),
        out: Instructions::default(),
        values: HashMap::default(),
    };
    builder.gather(statements);
    builder.share_pairs();
    builder.find_divisors();
    let values = statements.iter().map(|statement| builder.signed(statement.value)).collect();
    (builder.out, values)
}

impl Builder<'_> {
    /// All products among the values and the operands of the nodes below them.
    fn gather(&mut self, statements: &[Statement]) {
        let mut sums = Vec::new();
        let mut terms = HashSet::default();
        for statement in statements {
            self.note_term(statement.value, &mut terms);
        }
        for id in self.reachable(statements) {
            match self.graph.node(id).clone() {
                Node::Sum(parts) => parts.iter().for_each(|part| self.note_term(*part, &mut terms)),
                Node::Product(_) => {}
                Node::Reduce { .. } => {
                    let (fold, over, body) = self.as_loop(id);
                    match fold {
                        Fold::Sum => sums.push((id, over, body)),
                        Fold::Product => self.note(body),
                    }
                }
                other => other.parts().into_iter().for_each(|part| self.note(part)),
            }
        }
        for (sum, over, body) in sums {
            if !self.absorb(sum, &over, body) || terms.contains(&sum) {
                self.note(body);
            }
        }
    }

    /// The nodes below the values, with the bodies of sums as they stand inside of their loops, in id
    /// order.
    fn reachable(&mut self, statements: &[Statement]) -> BTreeSet<Id> {
        let mut waiting: Vec<Id> = statements.iter().map(|statement| statement.value.node).collect();
        let mut found = BTreeSet::new();
        while let Some(id) = waiting.pop() {
            if found.insert(id) {
                match self.graph.node(id) {
                    Node::Reduce { .. } => waiting.push(self.as_loop(id).2.node),
                    other => waiting.extend(other.operands()),
                }
            }
        }
        found
    }

    /// A sum or product over a range as the loop that computes it, at the depth where its range and all
    /// that its body takes from outside are known.
    fn as_loop(&mut self, id: Id) -> (Fold, Loop, Expr) {
        if let Some(known) = self.loops.get(&id) {
            return known.clone();
        }
        let Node::Reduce { fold, height, range, body } = self.graph.node(id).clone() else {
            internal("a sum was expected")
        };
        let depth = self.graph.free(id).depth();
        let body = self.graph.opened(height, body, depth);
        let opened = (fold, Loop { depth, range }, body);
        self.loops.insert(id, opened.clone());
        opened
    }

    fn note_term(&mut self, term: Expr, terms: &mut HashSet<Id>) {
        self.note(term);
        if term.scale.abs() == 1.0 {
            terms.insert(term.node);
        }
    }

    /// Moves the factors in front of a sum into it, wherever the product inside is known already.
    /// Whether that happened to all products with the sum.
    fn absorb(&mut self, sum: Id, over: &Loop, body: Expr) -> bool {
        let inner = self.expand((body.scale.abs().to_bits(), body.node));
        let outer: Vec<Key> = self
            .products
            .iter()
            .filter(|(_, powers)| powers.iter().any(|(factor, _)| *factor == Factor::Node(sum)))
            .map(|(key, _)| *key)
            .collect();
        let mut all = !outer.is_empty() && body.scale > 0.0;
        for key in outer.into_iter().filter(|_| body.scale > 0.0) {
            let mut merged = BTreeMap::from_iter(self.products[&key].iter().copied());
            merged.entry(Factor::Node(sum)).and_modify(|exponent| *exponent -= 1);
            merged.retain(|_, exponent| *exponent > 0);
            // A factor that is known only further inside than the sum cannot enter it.
            if merged.keys().any(|factor| self.depth(*factor) > over.depth) {
                all = false;
                continue;
            }
            inner.iter().for_each(|(factor, exponent)| *merged.entry(*factor).or_default() += exponent);
            let merged = Powers::from_iter(merged);
            match self.products.iter().find(|(_, powers)| **powers == merged).map(|(known, _)| *known) {
                Some(known) => {
                    self.products.remove(&key);
                    self.absorbed.insert(key, (over.clone(), known));
                }
                None => all = false,
            }
        }
        all
    }

    fn note(&mut self, expr: Expr) {
        if let Some(key) = self.product_key(expr) {
            let powers = self.expand(key);
            self.products.entry(key).or_insert(powers);
        }
    }

    /// The factors of |scale|·node, in order.
    fn expand(&self, key: Key) -> Powers {
        let mut powers = Vec::new();
        if f64::from_bits(key.0) != 1.0 {
            powers.push((Factor::Literal(key.0), 1));
        }
        powers.extend(
            self.graph.factors(key.1).into_iter().map(|(id, exponent)| (Factor::Node(id), exponent)),
        );
        powers.sort_unstable();
        powers
    }

    /// The key of the product that an expression is, if it is one.
    fn product_key(&self, expr: Expr) -> Option<Key> {
        let magnitude = expr.scale.abs();
        let product = matches!(self.graph.node(expr.node), Node::Product(_) | Node::Reciprocal(_));
        (expr.node != Graph::ONE && (magnitude != 1.0 || product)).then(|| (magnitude.to_bits(), expr.node))
    }

    fn find_divisors(&mut self) {
        let mut uses: HashMap<Factor, u32> = HashMap::default();
        let pairs = self.pairs.iter().flat_map(|pair| pair.factors).map(|factor| (factor, 1));
        for (factor, exponent) in self.products.values().flatten().copied().chain(pairs) {
            *uses.entry(factor).or_default() += exponent;
        }
        let single = uses.into_iter().filter(|(_, uses)| *uses == 1).map(|(factor, _)| factor);
        self.divisors = single.filter(|factor| self.reciprocal_of(*factor).is_some()).collect();
    }

    /// What a factor is the reciprocal of.
    fn reciprocal_of(&self, factor: Factor) -> Option<Id> {
        let Factor::Node(id) = factor else { return None };
        match self.graph.node(id) {
            Node::Reciprocal(of) => Some(*of),
            _ => None,
        }
    }

    fn free(&self, factor: Factor) -> Free {
        match factor {
            Factor::Literal(_) => Free::default(),
            Factor::Node(id) => self.graph.free(id),
            Factor::Pair(pair) => self.pairs[pair as usize].free,
        }
    }

    fn depth(&self, factor: Factor) -> u32 {
        self.free(factor).depth()
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
        self.out.push(Instruction::Literal(value.to_bits()))
    }

    fn product(&mut self, key: Key) -> Register {
        if let Some((over, body)) = self.absorbed.get(&key).cloned() {
            let body = Signed { negative: false, register: self.product(body) };
            return self.out.push(Instruction::Reduce(Fold::Sum, over, body));
        }
        let powers = match self.products.get(&key) {
            Some(shared) => shared.clone(),
            None => self.expand(key),
        };
        let repeated = powers.into_iter().flat_map(|(factor, exponent)| repeat_n(factor, exponent as usize));
        let mut factors: Vec<Factor> = repeated.collect();
        factors.sort_by_key(|factor| (self.depth(*factor), *factor));
        self.multiplied(&factors)
    }

    /// The product of factors from left to right; a reciprocal that nothing else uses divides it.
    fn multiplied(&mut self, factors: &[Factor]) -> Register {
        let mut product: Option<Register> = None;
        let mut divisor: Option<Id> = None;
        for factor in factors {
            if divisor.is_none() && self.divisors.contains(factor) {
                divisor = self.reciprocal_of(*factor);
                continue;
            }
            let factor = self.factor(*factor);
            product = Some(match product {
                Some(product) => self.out.push(Instruction::Multiply(product, factor)),
                None => factor,
            });
        }
        let numerator = product.unwrap_or_else(|| self.literal(1.0));
        match divisor {
            Some(of) => {
                let divisor = self.value(of);
                self.out.push(Instruction::Divide(numerator, divisor))
            }
            None => numerator,
        }
    }

    fn factor(&mut self, factor: Factor) -> Register {
        match factor {
            Factor::Literal(bits) => self.literal(f64::from_bits(bits)),
            Factor::Node(id) => self.value(id),
            Factor::Pair(pair) => {
                let [a, b] = self.pairs[pair as usize].factors;
                self.multiplied(&[a, b])
            }
        }
    }

    fn value(&mut self, id: Id) -> Register {
        if let Some(known) = self.values.get(&id) {
            return *known;
        }
        let register = self.computed(id);
        self.values.insert(id, register);
        register
    }

    fn computed(&mut self, id: Id) -> Register {
        let instruction = match self.graph.node(id).clone() {
            Node::Product(_) => return self.product((1.0_f64.to_bits(), id)),
            Node::Reciprocal(of) => {
                let (one, of) = (self.literal(1.0), self.value(of));
                Instruction::Divide(one, of)
            }
            Node::Sum(terms) => Instruction::Sum(terms.iter().map(|term| self.signed(*term)).collect()),
            Node::Unary(function, of) => Instruction::Unary(function, self.signed(of)),
            Node::Binary(function, a, b) => Instruction::Binary(function, self.signed(a), self.signed(b)),
            Node::Call(function, order, of) => Instruction::Call(function, order, self.signed(of)),
            Node::ScalarField(field, partial, at) => {
                let at = at.into_iter().map(|argument| self.signed(argument)).collect();
                let expansion = self.out.push(Instruction::Expansion(field, at));
                Instruction::Part(expansion, partial)
            }
            Node::Choose { left, relation, right, then, otherwise } => {
                let [left, right, then, otherwise] =
                    [left, right, then, otherwise].map(|part| self.signed(part));
                Instruction::Choose(left, relation, right, then, otherwise)
            }
            Node::Reduce { .. } => {
                let (fold, over, body) = self.as_loop(id);
                Instruction::Reduce(fold, over, self.signed(body))
            }
            Node::One => Instruction::Literal(1.0_f64.to_bits()),
            leaf!() => return self.out.push_leaf(id, self.graph.free(id)),
        };
        self.out.push(instruction)
    }
}
