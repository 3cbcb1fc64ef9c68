//! What a generated function does: its statements, the instructions that compute their values, and the
//! loops in which these run. Printing, counting and the self-check read the same routine.

use crate::instructions::Instructions;
use crate::schedule::{Step, schedule};
use crate::select::select;
use crate::statement::Statement;
use crate::symbolic::Graph;

#[derive(Debug)]
pub(crate) struct Routine {
    pub(crate) statements: Vec<Statement>,
    pub(crate) code: Instructions,
    pub(crate) steps: Vec<Step>,
}

impl Routine {
    pub(crate) fn new(graph: &mut Graph, statements: Vec<Statement>) -> Self {
        let (code, values) = select(graph, &statements);
        let steps = schedule(&code, &statements, &values);
        Self { statements, code, steps }
    }
}
