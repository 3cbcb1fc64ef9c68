//! The instructions of one function: straight values, loops not yet placed.
//!
//! A sum stands at the outermost depth at which everything that its terms and its range mention is known.
//! So no loop over the same depth runs around it, and its index can be mistaken for no other.

use rustc_hash::FxHashMap as HashMap;

use crate::internal::internal;
use crate::symbolic::{Binary, Fold, Free, Id, Loop, Partial, Relation, Unary};
use crate::work::step;

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
    Call(u32, u32, Signed),
    /// Value, gradient and Hessian of a function of several variables, at once.
    Expansion(u32, Vec<Signed>),
    /// One of the numbers of an expansion.
    Part(Register, Partial),
    Choose(Signed, Relation, Signed, Signed, Signed),
    Reduce(Fold, Loop, Signed),
}

/// The instructions of one function, operands before their users.
#[derive(Debug, Default)]
pub(crate) struct Instructions {
    list: Vec<Instruction>,
    free: Vec<Free>,
    known: HashMap<Instruction, Register>,
}

impl Instruction {
    pub(crate) fn operands(&self) -> Vec<Register> {
        match self {
            Self::Leaf(_) | Self::Literal(_) => Vec::new(),
            Self::Multiply(a, b) | Self::Divide(a, b) => vec![*a, *b],
            Self::Sum(terms) | Self::Expansion(_, terms) => terms.iter().map(|term| term.register).collect(),
            Self::Unary(_, a) | Self::Call(_, _, a) | Self::Reduce(_, _, a) => vec![a.register],
            Self::Part(a, _) => vec![*a],
            Self::Binary(_, a, b) => vec![a.register, b.register],
            Self::Choose(a, _, b, c, d) => vec![a.register, b.register, c.register, d.register],
        }
    }
}

impl Instructions {
    pub(crate) fn get(&self, register: Register) -> &Instruction {
        &self.list[register.0 as usize]
    }

    /// The loops that must run around a register.
    pub(crate) fn depth(&self, register: Register) -> u32 {
        self.free[register.0 as usize].depth()
    }

    pub(crate) fn len(&self) -> usize {
        self.list.len()
    }

    /// A value that depends on indices through its operands alone.
    pub(crate) fn push(&mut self, instruction: Instruction) -> Register {
        self.insert(instruction, Free::default())
    }

    /// A node without operands that depends on these indices.
    pub(crate) fn push_leaf(&mut self, id: Id, free: Free) -> Register {
        self.insert(Instruction::Leaf(id), free)
    }

    fn insert(&mut self, instruction: Instruction, own: Free) -> Register {
        if let Some(register) = self.known.get(&instruction) {
            return *register;
        }
        let operands = instruction.operands().into_iter();
        let mut free = operands.fold(own, |free, operand| free.and(self.free[operand.0 as usize]));
        if let Instruction::Reduce(_, over, _) = &instruction {
            free.open &= !(1 << over.depth);
            free = free.and(over.range.free());
            if free.depth() != over.depth {
                internal("a sum does not stand where its terms are known");
            }
        }
        if free.bound != 0 {
            internal("an index outside of its sum");
        }
        let register = Register(self.list.len() as u32);
        self.list.push(instruction.clone());
        self.free.push(free);
        self.known.insert(instruction, register);
        register
    }

    /// The registers that the roots depend on, in order, down to those that are known `outside`.
    pub(crate) fn reachable(
        &self,
        roots: impl IntoIterator<Item = Register>,
        outside: &[bool],
    ) -> Vec<Register> {
        let mut seen = vec![false; self.list.len()];
        roots.into_iter().for_each(|root| seen[root.0 as usize] = true);
        for position in (0..seen.len()).rev() {
            step();
            seen[position] &= !outside.get(position).is_some_and(|known| *known);
            if seen[position] {
                let operands = self.list[position].operands();
                operands.into_iter().for_each(|operand| seen[operand.0 as usize] = true);
            }
        }
        let found = (0..seen.len()).filter(|position| seen[*position]);
        found.map(|position| Register(position as u32)).collect()
    }
}
