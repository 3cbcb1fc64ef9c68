//! The operations of a generated body, loop nest by loop nest, for the report.

use crate::instructions::{Instruction, Instructions};
use crate::routine::Routine;
use crate::schedule::Step;
use crate::symbolic::{Fold, Loop};

/// Operations of the innermost body of one loop nest.
#[derive(Clone, Debug, Default)]
pub(crate) struct Operations {
    pub(crate) loops: Vec<Loop>,
    pub(crate) additions: usize,
    pub(crate) multiplications: usize,
    pub(crate) divisions: usize,
    pub(crate) calls: usize,
}

impl Routine {
    /// Operation counts, loop nest by loop nest.
    pub(crate) fn operations(&self) -> Vec<Operations> {
        let mut counted = vec![Operations::default()];
        count_operations(&self.code, &self.steps, &[], &mut counted);
        counted.retain(|o| o.additions + o.multiplications + o.divisions + o.calls > 0);
        counted
    }
}

fn count_operations(code: &Instructions, steps: &[Step], loops: &[Loop], counted: &mut Vec<Operations>) {
    let mut here = Operations { loops: loops.to_vec(), ..Operations::default() };
    for step in steps {
        match step {
            Step::Let(register) => match code.get(*register) {
                Instruction::Sum(terms) => here.additions += terms.len() - 1,
                Instruction::Multiply(..) => here.multiplications += 1,
                Instruction::Divide(..) => here.divisions += 1,
                Instruction::Unary(..)
                | Instruction::Binary(..)
                | Instruction::Call(..)
                | Instruction::Expansion(..) => here.calls += 1,
                _ => {}
            },
            Step::Loop { over, folds, body } => {
                let inside: Vec<Loop> = loops.iter().chain([over]).cloned().collect();
                count_operations(code, body, &inside, counted);
                if let Some(inner) = counted.iter_mut().find(|operations| operations.loops == inside) {
                    let sums = folds.iter().filter(|fold| fold.fold == Fold::Sum).count();
                    inner.additions += sums;
                    inner.multiplications += folds.len() - sums;
                }
            }
            // A scatter adds; a returned value does not.
            Step::Write(..) => here.additions += usize::from(!loops.is_empty()),
        }
    }
    match counted.iter_mut().find(|operations| operations.loops == here.loops) {
        Some(known) => {
            known.additions += here.additions;
            known.multiplications += here.multiplications;
            known.divisions += here.divisions;
            known.calls += here.calls;
        }
        None => counted.push(here),
    }
}
