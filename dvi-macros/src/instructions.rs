//! The instructions of one function: straight values, loops not yet placed.

use std::collections::HashMap;

use crate::symbolic::{Binary, Binder, Id, Relation, Unary};

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

    pub(crate) fn push(&mut self, instruction: Instruction, leaf_free: u64) -> Register {
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
