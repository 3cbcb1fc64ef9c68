//! The formulas of a system as expressions; reports everything that is missing or wrong.

use syn::Expr as Syntax;

use super::Stages;
use crate::formulas::{DeclaredConstraints, DegenerateFormulas, RegularFormulas, TimeTransform};
use crate::internal::internal;
use crate::lower::{Lowering, Role, all};
use crate::model::Extended;
use crate::structure::gauge::{self, Effort, Search};
use crate::symbolic::{Atom, Coordinate, Expr, Fold, Graph, Index, Node};
use crate::syntax::{self, Attribute, Gauge, Named};

impl Stages {
    /// α·v, H, the momenta and the events.
    pub(super) fn degenerate_formulas(&mut self) -> Option<DegenerateFormulas> {
        let clean = self.check_coordinates()?;
        let mut lowering = Lowering::new(&mut self.graph, &mut self.model, &mut self.errors);
        lowering.share(&self.attribute);
        let pair = one_form_and_hamiltonian(&self.attribute, &mut lowering, clean);
        let momenta = named(&self.attribute.momenta, Role::Momentum, &mut lowering);
        let events = named(&self.attribute.events, Role::Event, &mut lowering);
        let force = lowering.forces(&self.attribute.forces);
        let time = time_transform(&self.attribute, &mut lowering, pair.map(|(_, hamiltonian)| hamiltonian));
        let gauge = self.attribute.gauge().map(|formula| lowering.formula(formula, Role::Gauge));
        let seams = lowering.seams;
        let pair = pair.zip(time).map(|(pair, time)| match time {
            Some(time) => self.extended(pair.0, time),
            None => pair,
        });
        let gauge = self.gauge(pair.map(|(one_form, _)| one_form), gauge);
        let (declared, momenta, events, force, gauge, time) =
            (pair?, momenta?, events?, force?, gauge?, time?);
        let (one_form, hamiltonian) = match gauge {
            Some(gauge) => self.with_gauge(declared, gauge),
            None => declared,
        };
        Some(DegenerateFormulas {
            one_form,
            hamiltonian,
            gauge,
            declared: declared.0,
            time,
            force,
            momenta,
            events,
            seams,
        })
    }

    /// F, `written` or found; `None` inside if there is none.
    fn gauge(&mut self, one_form: Option<Expr>, written: Option<Option<Expr>>) -> Option<Option<Expr>> {
        let gauge = match (&self.attribute.gauge, written) {
            (None, _) => return Some(None),
            (Some(_), Some(written)) => written?,
            (Some(Gauge::Auto(word)), None) => {
                let word = word.clone();
                if !self.errors.is_empty() {
                    return None;
                }
                // What is wrong with an odd number of coordinates is said elsewhere.
                if self.model.dimension().as_literal().is_some_and(|dimension| dimension % 2 != 0) {
                    return Some(None);
                }
                match gauge::search(&self.graph, &self.model, one_form?, Effort::Asked) {
                    Search::NotNeeded => return Some(None),
                    Search::Found(found) => {
                        let mut lowering = Lowering::new(&mut self.graph, &mut self.model, &mut self.errors);
                        let gauge = lowering.formula(&found.formula, Role::Gauge)?;
                        self.attribute.gauge = Some(Gauge::Formula(found.formula));
                        gauge
                    }
                    Search::None(reason) => {
                        let message = format!(
                            "no gauge was found that brings the one-form into the class of one-step schemes: {reason}; \
                             write `gauge = F` with a function of your own, or leave it out and take `Gauss`"
                        );
                        return self.errors.refuse(word, message);
                    }
                }
            }
            (Some(Gauge::Formula(_)), None) => internal("a gauge that was not read"),
        };
        self.can_be_gauge(gauge)?;
        Some(Some(gauge))
    }

    /// Reports a gauge without coordinates, or with functions that have too few derivatives.
    fn can_be_gauge(&mut self, gauge: Expr) -> Option<()> {
        let formula = self.attribute.gauge()?;
        if !self.graph.depends(gauge.node, Node::is_position) {
            let message = "a gauge without coordinates in it changes nothing: write a function of the coordinates, or \
                           leave it out";
            return self.errors.refuse(formula, message);
        }
        let blocks = &self.model.blocks;
        let is_of_spinor =
            |node: &Node| matches!(node, Node::Coordinate(of) if blocks[of.block as usize].is_spinor());
        if self.graph.depends(gauge.node, is_of_spinor) {
            let message = "unit vectors stand in no gauge: the one-form `area(s)` is in no class of one-step schemes, and \
                           the other methods do as well without a gauge";
            return self.errors.refuse(formula, message);
        }
        for (number, function) in self.model.functions.iter().enumerate() {
            let calls = |node: &Node| matches!(node, Node::Call(known, ..) if *known as usize == number);
            if !self.model.has_third_derivative(number as u32) && self.graph.depends(gauge.node, calls) {
                let name = &function.name;
                let message = format!(
                    "a gauge is differentiated three times, and the function `{name}` stands in it: declare its third \
                     derivative too, as in `{name} = [f, df, d2f, d3f]`"
                );
                return self.errors.refuse(formula, message);
            }
        }
        if let Some(field) = self.graph.scalar_field_below(gauge) {
            let name = &self.model.scalar_fields[field as usize].text;
            let message = format!(
                "a gauge is differentiated three times, and `{name}`, which stands in it, has two derivatives: no function \
                 that implements `ScalarField` stands in a gauge"
            );
            return self.errors.refuse(formula, message);
        }
        Some(())
    }

    /// α + ∂F/∂q and H − ∂F/∂t: L with dF/dt added to it.
    fn with_gauge(&mut self, (one_form, hamiltonian): (Expr, Expr), gauge: Expr) -> (Expr, Expr) {
        let graph = &mut self.graph;
        let time = graph.intern(Node::Time);
        let rate = graph.derivative(gauge, time);
        (graph.with_differential(one_form, gauge), graph.subtract(hamiltonian, rate))
    }

    /// α·q' − energy·t' and ρ (H − energy): L in the extended phase space, with t' = ρ.
    fn extended(
        &mut self,
        one_form: Expr,
        TimeTransform { rate, hamiltonian }: TimeTransform<Expr>,
    ) -> (Expr, Expr) {
        let Some(Extended { time, energy }) = self.model.extended else {
            internal("a time transformation without its coordinates")
        };
        let graph = &mut self.graph;
        let [time, energy] =
            [time, energy].map(|block| Coordinate { block: block as u32, index: Index::literal(0) });
        let velocity = graph.intern(Node::Velocity(time)).into();
        let energy = graph.intern(Node::Coordinate(energy)).into();
        let conjugate = graph.multiply(energy, velocity);
        let difference = graph.subtract(hamiltonian, energy);
        (graph.subtract(one_form, conjugate), graph.multiply(rate, difference))
    }

    /// L, the forces, the constraints, the momenta and the events.
    pub(super) fn regular_formulas(&mut self) -> Option<RegularFormulas> {
        let clean = self.check_coordinates()?;
        let mut lowering = Lowering::new(&mut self.graph, &mut self.model, &mut self.errors);
        lowering.share(&self.attribute);
        let lagrangian = match &self.attribute.lagrangian {
            Some(lagrangian) => lowering.formula(lagrangian, Role::Lagrangian),
            None if clean => {
                lowering.errors.refuse(&lowering.model.item.ident, "no dynamics: write `lagrangian = …`")
            }
            None => None,
        };
        let momenta = named(&self.attribute.momenta, Role::Momentum, &mut lowering);
        let events = named(&self.attribute.events, Role::Event, &mut lowering);
        let force = lowering.forces(&self.attribute.forces);
        let dissipation = match &self.attribute.dissipation {
            Some(function) => lowering.dissipation(function),
            None => Some(Vec::new()),
        };
        let constraints = self.attribute.constrained.map(|of| {
            let list = lowering.constraints(of, &self.attribute.constraints)?;
            Some(DeclaredConstraints { of, list })
        });
        let lagrangian = lagrangian?;
        let quadratic = lowering.is_quadratic(lagrangian);
        let (force, constraints, momenta, events) =
            (force?, constraints.map_or(Some(None), |declared| declared.map(Some))?, momenta?, events?);
        let force = lowering.graph.added(force, dissipation?.into_iter());
        let seams = lowering.seams;
        Some(RegularFormulas { lagrangian, quadratic, force, constraints, momenta, events, seams })
    }

    /// Whether no mistake was found so far; `None` without coordinates, over which formulas would only
    /// repeat that error.
    fn check_coordinates(&mut self) -> Option<bool> {
        if self.attribute.coordinates.is_empty() && self.errors.is_empty() {
            let message =
                "no coordinates: write `coordinates(x, y)`, or `coordinates(x[N], y[N])` for arrays";
            self.errors.push(&self.model.item.ident, message);
        }
        (!self.model.blocks.is_empty()).then(|| self.errors.is_empty())
    }
}

/// ρ and H; `None` inside if the time is not transformed.
fn time_transform(
    attribute: &Attribute,
    lowering: &mut Lowering<'_>,
    hamiltonian: Option<Expr>,
) -> Option<Option<TimeTransform<Expr>>> {
    let Some(syntax::TimeTransform { rate: formula, .. }) = &attribute.time_transform else {
        return Some(None);
    };
    let rate = lowering.formula(formula, Role::TimeTransform)?;
    if rate.as_number().is_some_and(|rate| rate <= 0.0) {
        return lowering
            .errors
            .refuse(formula, "a time transformation is positive: it is how fast the time passes");
    }
    if !attribute.forces.is_empty() {
        let message = "a system with forces keeps its time: without `time_transform` all methods step it, with steps of equal \
                       length";
        return lowering.errors.refuse(formula, message);
    }
    // Where its coordinates have no names, that is an error of its own.
    lowering.model.extended?;
    Some(Some(TimeTransform { rate, hamiltonian: hamiltonian? }))
}

fn named(declared: &[Named], role: Role, lowering: &mut Lowering<'_>) -> Option<Vec<Expr>> {
    all(declared.iter().map(|named| lowering.formula(&named.formula, role)))
}

/// α·v and H, declared as they are, or split from L; `clean` if no mistake was found before.
fn one_form_and_hamiltonian(
    attribute: &Attribute,
    lowering: &mut Lowering<'_>,
    clean: bool,
) -> Option<(Expr, Expr)> {
    match (&attribute.lagrangian, &attribute.one_form, &attribute.hamiltonian) {
        (Some(lagrangian), None, None) => {
            let lagrangian = lowering.formula(lagrangian, Role::Lagrangian);
            lagrangian.map(|lagrangian| split(lowering.graph, lagrangian))
        }
        (None, Some(one_form), Some(hamiltonian)) => {
            let one_form = lower_one_form(lowering, one_form);
            let hamiltonian = lowering.formula(hamiltonian, Role::Hamiltonian);
            one_form.zip(hamiltonian)
        }
        (Some(_), one_form, hamiltonian) => {
            let message = "give either `lagrangian`, or `one_form` and `hamiltonian`, not both";
            lowering.errors.refuse(one_form.as_ref().or(hamiltonian.as_ref())?, message)
        }
        (None, one_form, hamiltonian) => {
            one_form.as_ref().and_then(|one_form| lower_one_form(lowering, one_form));
            hamiltonian.as_ref().and_then(|hamiltonian| lowering.formula(hamiltonian, Role::Hamiltonian));
            if clean {
                let missing = match (one_form, hamiltonian) {
                    (Some(_), None) => "no Hamiltonian: write `hamiltonian = …`",
                    (None, Some(_)) => "no one-form: write `one_form = … * d(x) + …`",
                    _ => "no dynamics: write `one_form = …` and `hamiltonian = …`, or `lagrangian = …`",
                };
                lowering.errors.push(&lowering.model.item.ident, missing);
            }
            None
        }
    }
}

fn lower_one_form(lowering: &mut Lowering<'_>, one_form: &Syntax) -> Option<Expr> {
    match one_form {
        Syntax::Array(components) => lowering.components(components),
        Syntax::Tuple(list) => lowering
            .errors
            .refuse(list, "components of a one-form are listed in brackets: `one_form = [a, b]`"),
        _ => {
            let value = lowering.formula(one_form, Role::OneForm)?;
            let (stray, _) = split_parts(lowering.graph, value);
            if !stray.is_zero() {
                return lowering
                    .errors
                    .refuse(one_form, "this one-form has no d(·): write `… * d(x)` for a coordinate x");
            }
            Some(value)
        }
    }
}

/// L = α·v − H: −H is what is left at v = 0.
fn split(graph: &mut Graph, lagrangian: Expr) -> (Expr, Expr) {
    let (rest, one_form) = split_parts(graph, lagrangian);
    (one_form, rest.negated())
}

/// An affine expression as (its value at v = 0, what is linear in v).
fn split_parts(graph: &mut Graph, value: Expr) -> (Expr, Expr) {
    let rest = graph.at_rest(value);
    let linear = match graph.node(value.node).clone() {
        // Term by term, so that what has no velocity disappears instead of being subtracted.
        Node::Sum(terms) => {
            let parts: Vec<Expr> = terms.iter().map(|term| split_parts(graph, *term).1).collect();
            graph.sum(&parts).scaled(value.scale)
        }
        _ if rest.is_zero() => value,
        Node::Reduce { fold: Fold::Sum, height, range, body } => {
            let (_, body) = split_parts(graph, body);
            graph.fold(Fold::Sum, Atom::Bound(height), range, body).scaled(value.scale)
        }
        Node::Product(factors) => {
            let (moving, others): (Vec<_>, Vec<_>) =
                factors.into_iter().partition(|(factor, _)| graph.has_velocity(*factor));
            let [(affine, 1)] = moving[..] else { return (rest, graph.subtract(value, rest)) };
            let mut parts: Vec<Expr> =
                others.into_iter().map(|(factor, exponent)| graph.power(factor.into(), exponent)).collect();
            parts.push(split_parts(graph, affine.into()).1);
            graph.product(&parts).scaled(value.scale)
        }
        _ => graph.subtract(value, rest),
    };
    (rest, linear)
}
