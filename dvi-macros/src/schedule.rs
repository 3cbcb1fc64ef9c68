//! Instructions to loops: each one as far outside as it can stand, sums over the same range together.
//!
//! A scope is the body of a function or of a loop. It computes what depends on its open indices only
//! and is needed here or further inside; then it runs its loops. Sums and statements over the same
//! range share one loop, unless one needs the result of the other.

use crate::instructions::{Instruction, Instructions, Register, Signed};
use crate::internal::internal;
use crate::statement::Statement;
use crate::symbolic::{Fold, Loop};

#[derive(Debug)]
pub(crate) enum Step {
    Let(Register),
    /// Sums and products accumulated, and statements carried out, over one range.
    Loop {
        over: Loop,
        folds: Vec<Accumulated>,
        body: Vec<Step>,
    },
    /// Statement number and its value.
    Write(usize, Signed),
}

/// A sum or product that a loop accumulates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Accumulated {
    pub(crate) fold: Fold,
    pub(crate) result: Register,
    pub(crate) body: Signed,
}

#[derive(Clone, Copy)]
enum Duty<'a> {
    Write { statement: usize, loops: &'a [Loop], value: Signed },
    Fold { body: Register },
}

impl Duty<'_> {
    fn register(&self) -> Register {
        match self {
            Self::Write { value, .. } => value.register,
            Self::Fold { body } => *body,
        }
    }
}

struct Group<'a> {
    entry: usize,
    over: &'a Loop,
    folds: Vec<Accumulated>,
    duties: Vec<Duty<'a>>,
}

struct Scheduler<'a> {
    code: &'a Instructions,
}

pub(crate) fn schedule(code: &Instructions, statements: &[Statement], values: &[Signed]) -> Vec<Step> {
    let duties: Vec<Duty<'_>> = statements
        .iter()
        .zip(values)
        .enumerate()
        .map(|(number, (statement, value))| Duty::Write {
            statement: number,
            loops: &statement.loops,
            value: *value,
        })
        .collect();
    Scheduler { code }.scope(0, &vec![false; code.len()], &duties)
}

impl<'a> Scheduler<'a> {
    /// The steps inside of `depth` loops.
    fn scope(&self, depth: u32, outside: &[bool], duties: &[Duty<'a>]) -> Vec<Step> {
        // The body of a known sum is of no use here, even if it stands in a loop with the same index.
        let mut needed = self.code.reachable(duties.iter().map(Duty::register), outside);
        needed.retain(|register| self.code.depth(*register) <= depth);
        let stages = self.stages(&needed);
        let mut defined = outside.to_vec();
        needed.iter().for_each(|register| defined[register.0 as usize] = true);
        let groups = self.groups(&needed, &stages, duties);
        let entries = groups.iter().map(|group| group.entry);
        let last = needed.iter().map(|r| stages[r.0 as usize]).chain(entries).max().unwrap_or(0);
        let mut steps = Vec::new();
        for stage in 0..=last {
            let here = needed.iter().filter(|register| stages[register.0 as usize] == stage);
            let values =
                here.filter(|register| !matches!(self.code.get(**register), Instruction::Reduce(..)));
            steps.extend(values.map(|register| Step::Let(*register)));
            for group in groups.iter().filter(|group| group.entry == stage) {
                if group.over.depth != depth {
                    internal("a loop runs at a depth that is not its own");
                }
                let folds = group.folds.iter().map(|fold| Duty::Fold { body: fold.body.register });
                let inside: Vec<Duty<'a>> = folds.chain(group.duties.iter().copied()).collect();
                let body = self.scope(depth + 1, &defined, &inside);
                let (over, folds) = (group.over.clone(), group.folds.clone());
                steps.push(Step::Loop { over, folds, body });
            }
        }
        steps.extend(duties.iter().filter_map(|duty| match duty {
            Duty::Write { statement, loops: [], value } => Some(Step::Write(*statement, *value)),
            _ => None,
        }));
        steps
    }

    /// How many loops of this scope must have run before a register of it is known.
    fn stages(&self, needed: &[Register]) -> Vec<usize> {
        let mut stages = vec![0; self.code.len()];
        for register in needed {
            stages[register.0 as usize] = match self.code.get(*register) {
                Instruction::Reduce(_, _, body) => 1 + self.entry(body.register, &stages),
                other => {
                    other.operands().iter().map(|operand| stages[operand.0 as usize]).max().unwrap_or(0)
                }
            };
        }
        stages
    }

    /// The stage after which everything below `register` that this scope computes is known.
    fn entry(&self, register: Register, stages: &[usize]) -> usize {
        self.code.reachable([register], &[]).iter().map(|below| stages[below.0 as usize]).max().unwrap_or(0)
    }

    fn groups(&self, needed: &[Register], stages: &[usize], duties: &[Duty<'a>]) -> Vec<Group<'a>> {
        let mut groups: Vec<Group<'a>> = Vec::new();
        for register in needed {
            let Instruction::Reduce(fold, over, body) = self.code.get(*register) else { continue };
            let entry = stages[register.0 as usize] - 1;
            let fold = Accumulated { fold: *fold, result: *register, body: *body };
            match groups.iter_mut().find(|group| group.entry == entry && group.over == over) {
                Some(group) => group.folds.push(fold),
                None => groups.push(Group { entry, over, folds: vec![fold], duties: Vec::new() }),
            }
        }
        for duty in duties {
            let Duty::Write { statement, loops: [over, inner @ ..], value } = *duty else { continue };
            let entry = self.entry(value.register, stages);
            let duty = Duty::Write { statement, loops: inner, value };
            match groups.iter_mut().find(|group| group.entry >= entry && group.over == over) {
                Some(group) => group.duties.push(duty),
                None => groups.push(Group { entry, over, folds: Vec::new(), duties: vec![duty] }),
            }
        }
        groups
    }
}
