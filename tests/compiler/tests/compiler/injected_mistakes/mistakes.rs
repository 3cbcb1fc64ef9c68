//! Mistakes of the kinds that compilers make: a sign, a factor, a condition, an order, a name.

/// An expression of the compiler, and a wrong one that stands in its place.
pub(crate) struct Mistake {
    pub(crate) file: &'static str,
    /// Text that stands once in the file. The expression is what is between « and », or all of it.
    pub(crate) place: &'static str,
    pub(crate) wrong: &'static str,
}

impl Mistake {
    /// What stands before the expression, the expression, and what stands behind it.
    pub(crate) fn parts(&self) -> [&'static str; 3] {
        let Some((before, rest)) = self.place.split_once('«') else { return ["", self.place, ""] };
        let (right, after) = rest.split_once('»').expect("« and »");
        [before, right, after]
    }
}

const fn mistake(file: &'static str, place: &'static str, wrong: &'static str) -> Mistake {
    Mistake { file, place, wrong }
}

pub(crate) const MISTAKES: &[Mistake] = &[
    // The derivatives of an event.
    mistake("program.rs", "first_derivatives(graph, value, Output::Lq, «Output::Lv»)", "Output::Lq"),
    mistake("program.rs", "let by_time = result(«graph.derivative(value, time)»);", "value"),
    // A seam is another number, or is forgotten.
    mistake("program.rs", "let difference = «graph.subtract(a, b)»;", "a"),
    mistake("lower/blocks.rs", "self.note_seam(left, «right»);", "left"),
    mistake("lower/calls.rs", "self.note_seam(x, «Expr::ZERO»);", "x"),
    // A factor enters a sum that it depends on.
    mistake("select.rs", "self.depth(*factor) > «over.depth»", "64"),
    mistake("select.rs", "self.multiplied(&[a, «b»])", "a"),
    mistake(
        "select.rs",
        "Instruction::Divide(numerator, divisor)",
        "Instruction::Multiply(numerator, divisor)",
    ),
    mistake("select.rs", "let negative = expr.scale < «0.0»;", "-1.0"),
    mistake("select.rs", "if «f64::from_bits(key.0) != 1.0» {", "f64::from_bits(key.0) > 1.0"),
    // The factors of a product that is not in the table.
    mistake("select.rs", "None => «self.expand(key)»,", "Vec::new()"),
    // A loop runs before the sum that its terms use.
    mistake(
        "schedule.rs",
        "self.code.reachable([register], &[]).iter().map(|below| stages[below.0 as usize]).max()\
         .unwrap_or(0)",
        "stages[register.0 as usize].min(0)",
    ),
    // Sums over different ranges share a loop.
    mistake("schedule.rs", "group.entry == entry && group.over == over", "group.entry == entry"),
    mistake("schedule.rs", "group.entry >= entry && group.over == over", "group.over == over"),
    mistake("symbolic/simplify.rs", "known.scale += term.scale", "known.scale = term.scale"),
    mistake("symbolic/simplify.rs", "*known = «whole(known.checked_add(exponent))»", "exponent"),
    mistake(
        "symbolic/simplify.rs",
        "Node::Reciprocal(inner) => «Expr { scale, node: *inner }»",
        "Expr { scale: 1.0, node: *inner }",
    ),
    mistake("symbolic/simplify.rs", "Expr::from(node).scaled(«sign»)", "sign.abs()"),
    mistake("symbolic/factored.rs", "self.product(&kept).scaled(term.scale)", "self.product(&kept)"),
    mistake("symbolic/factored.rs", "part.scaled(constant.scale)", "*part"),
    mistake(
        "symbolic/derivative.rs",
        "let (then, otherwise) = «(self.derivative(then, by), self.derivative(otherwise, by))»;",
        "(self.derivative(otherwise, by), self.derivative(then, by))",
    ),
    // Pairs of variables of one family, or of two, are dropped or counted twice.
    mistake("symbolic/derivative.rs", "if «row <= column» {", "row < column"),
    mistake("symbolic/derivative.rs", "mirrored: «row < column»,", "true"),
    mistake("symbolic/derivative.rs", "let mut factor = «self.multiply(outer.factor, partial)»;", "partial"),
    mistake("symbolic/derivative.rs", "range.without(Index::open(depth))", "range.clone()"),
    mistake("symbolic/derivative.rs", "let range = «outer.range.as_written()»;", "outer.range.clone()"),
    mistake(
        "symbolic/functions.rs",
        "«graph.unary(Unary::Sin, u).negated()»;",
        "graph.unary(Unary::Sin, u)",
    ),
    // An index takes the name of that of a sum inside.
    mistake(
        "symbolic/graph.rs",
        "(rest.and(range.free()), height + 1)",
        "if *height > 9 { (rest.and(range.free()), height + 1) } else { (inside, highest) }",
    ),
    // A gauge: its rate has the wrong sign, two components are one, one is lost.
    mistake("expand/formulas.rs", "graph.subtract(hamiltonian, rate)", "graph.add(hamiltonian, rate)"),
    mistake(
        "symbolic/differential.rs",
        "known.target == part.target && known.loops == part.loops",
        "known.target == part.target",
    ),
    mistake("symbolic/differential.rs", "values.push(part.value)", "values[0] = part.value"),
    // What is multiplied out loses its coefficients.
    mistake("symbolic/polynomial.rs", "self.monomial(monomial).scaled(*value)", "self.monomial(monomial)"),
    // A function of several variables: a mixed derivative along one axis, the wrong number of an expansion,
    // arguments in the wrong order.
    mistake(
        "symbolic/partial.rs",
        "Self::Second(first.min(axis), first.max(axis))",
        "Self::Second(first, first)",
    ),
    mistake("symbolic/derivative.rs", "partial.along(«axis»)", "0"),
    mistake("select.rs", "Instruction::Part(expansion, «partial»)", "crate::symbolic::Partial::Value"),
    mistake(
        "lower/calls.rs",
        "self.graph.scalar_field(field, Partial::Value, «at»)",
        "at.into_iter().rev().collect()",
    ),
    // A time transformation: the energy has the wrong sign, or the time no conjugate.
    mistake("expand/formulas.rs", "graph.subtract(hamiltonian, energy)", "graph.add(hamiltonian, energy)"),
    mistake("expand/formulas.rs", "graph.subtract(one_form, conjugate)", "graph.add(one_form, conjugate)"),
    // Forces: without their derivatives, in the wrong rows, with the sign of the Hamiltonian, in the place of
    // what is there, on another block, and a step that is taken for explicit.
    mistake(
        "program.rs",
        "let by_forces = «force_derivatives(graph, force)»;",
        "{ force_derivatives(graph, force); Vec::new() }",
    ),
    mistake(
        "program.rs",
        "«found»\n}",
        "found.into_iter().map(|by| SecondContribution { row: by.column, column: by.row, ..by }).collect()",
    ),
    mistake("program/degenerate.rs", "value: «part.value.negated()»", "part.value"),
    mistake("symbolic/derivative.rs", "known.value = «self.add(known.value, other.value)»", "other.value"),
    mistake("lower/components.rs", "self.along(«blocks», formula, Role::Force)", "0..1"),
    mistake(
        "structure/mass.rs",
        "constant && !formulas.force.iter().any(|part| graph.has_velocity(part.value.node))",
        "constant",
    ),
    // Constraints: the second rate of the constraints themselves, a rate without the time or with sums that
    // are not added up, entries of the Jacobian in the rows of another constraint or of another member, a family
    // that begins too late.
    mistake("program/constraints.rs", "let curvatures = changes(graph, «&rates»);", "constraints"),
    mistake("symbolic/differential.rs", "let mut terms = «vec![self.derivative(of, time)]»;", "Vec::new()"),
    mistake("symbolic/differential.rs", "part.loops.into_iter().skip(«loops.len()»)", "loops.len() + 1"),
    mistake("symbolic/differential.rs", "part.target = «self.velocity_of(part.target)»;", "part.target"),
    mistake(
        "program/constraints.rs",
        "Place::ConstraintDerivative(row(«number», constraint), column.clone())",
        "0",
    ),
    mistake(
        "program/constraints.rs",
        "constraint: number as u32, member: «constraint.member()»",
        "crate::symbolic::Index::literal(0).into()",
    ),
    // Vectors.
    mistake("lower/vectors.rs", "minor(a2, a0, «b2», b0)", "b0"),
    mistake("lower/vectors.rs", "let term = self.graph.multiply(*a, «*b»);", "*a"),
    mistake(
        "lower/names.rs",
        "self.coordinate_node(«first + number», index.clone())",
        "first + axis.of - 1 - number",
    ),
    mistake(
        "symbolic/count.rs",
        "Index::open(over.depth).plus(&over.range.lower, -1)",
        "Index::open(over.depth)",
    ),
    mistake(
        "symbolic/count.rs",
        "Self { rows: «Some(Rows::of(place(outer), outer, inner))», rest: place(inner) }",
        "None",
    ),
    // Constraints of the velocities: derivatives with the weights of others, or without themselves, and
    // without those by velocities in families and sums.
    mistake("program/constraints.rs", "Variable::Position => «Weight::Q»,", "Weight::V"),
    mistake("program/constraints.rs", "Variable::Velocity => «Weight::V»,", "Weight::Q"),
    mistake("program/constraints.rs", "weighted(graph, *variable, «statement.value»)", "Expr::ONE"),
    mistake(
        "program/constraints.rs",
        "«entries.push((by, Statement { loops, place, value }))»;",
        "if by == Variable::Position || loops.is_empty() { entries.push((by, Statement { loops, place, value })) }",
    ),
];
