//! A sum becomes a loop, and a loop a sum: its index changes its name (see [`index`](super::index)).

use super::graph::{Coordinate, Expr, Graph, Id, Node, Parameter};
use super::index::{Atom, Index, Renaming};
use crate::internal::internal;

impl Graph {
    /// `root` with one index in place of another.
    pub(crate) fn renamed(&mut self, root: Id, renaming: &Renaming) -> Expr {
        let replace = |graph: &mut Self, id: Id| {
            let moved = |c: &Coordinate| Coordinate { block: c.block, index: c.index.renamed(renaming) };
            let node = match graph.node(id) {
                Node::Coordinate(c) => Node::Coordinate(moved(c)),
                Node::Velocity(c) => Node::Velocity(moved(c)),
                Node::Parameter(p) => Node::Parameter(Parameter {
                    field: p.field,
                    indices: p.indices.iter().map(|index| index.renamed(renaming)).collect(),
                }),
                Node::Count(index) => return Some(graph.count(index.renamed(renaming))),
                _ => return None,
            };
            Some(graph.intern(node).into())
        };
        self.rebuild_with(root, replace, |range| range.renamed(renaming))
    }

    /// The body of a fold inside a loop at `depth` that runs over its range.
    pub(crate) fn opened(&mut self, height: u32, body: Expr, depth: u32) -> Expr {
        let renaming = Renaming { from: Atom::Bound(height), to: Atom::Open(depth) };
        self.renamed(body.node, &renaming).scaled(body.scale)
    }

    /// A body whose index is called `index` as the body of a fold, with the height of that fold. The name
    /// of the index is then the lowest that no fold inside uses; names around it are higher, so nothing
    /// is captured.
    pub(super) fn closed(&mut self, index: &Atom, body: Expr) -> (u32, Expr) {
        let height = self.height(body.node);
        let to = Atom::Bound(height);
        if *index == to {
            return (height, body);
        }
        if matches!(index, Atom::Bound(own) if *own < height) {
            internal("a sum has grown while an index around it was renamed");
        }
        let own = Index::atom(index.clone()).free().bound;
        let names_inside = (2_u64 << height) - 1;
        if self.free(body.node).bound & !own & names_inside != 0 {
            internal("a sum would capture the index of another one");
        }
        let renaming = Renaming { from: index.clone(), to };
        (height, self.renamed(body.node, &renaming).scaled(body.scale))
    }
}
