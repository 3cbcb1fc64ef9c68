//! What the formulas of a system say about each generated function, and what the functions give.

use super::formula::{Combination, Evaluation, NoValue, Sides, Texts};
use super::jet::{First, Jet, Second, Sized};
use super::machine::{Machine, Results};
use super::point::{Directions, Point};
use crate::internal::internal;
use crate::model::Model;
use crate::program::{self, DegeneratePrograms, Programs, RegularPrograms};
use crate::routine::Routine;
use crate::symbolic::{Graph, Index, Weight};
use crate::syntax::{Attribute, Constrained, Kind};

/// The formulas as written, with what their names stand for.
#[derive(Clone, Copy)]
pub(super) struct System<'a> {
    pub(super) model: &'a Model,
    pub(super) attribute: &'a Attribute,
    pub(super) texts: &'a Texts,
}

/// What is evaluated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Part {
    All,
    /// L, or α·v where it is declared apart from H.
    Form,
}

/// The generated functions.
pub(super) enum Functions<'a> {
    Degenerate(&'a DegeneratePrograms),
    Regular(&'a RegularPrograms),
}

/// What is compared.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Quantity {
    Lagrangian,
    /// ∂L/∂q and ∂L/∂v
    Lq,
    Lv,
    /// The weighted sum of second derivatives.
    Hessian,
    Hamiltonian,
    HamiltonianGradient,
    OneForm,
    FlowSource,
    TimeRate,
    Untransformed,
    MomentumRate,
    AppliedForce,
    OneFormJacobian,
    Energy,
    Force,
    Momentum(usize),
    MomentumGradient(usize),
    Constraint,
    ConstraintJacobian,
    ConstraintRate,
    ConstraintCurvature,
    VelocityConstraint,
    VelocityConstraintJacobian,
    VelocityConstraintRate,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Output {
    pub(super) function: &'static str,
    quantity: Quantity,
    pub(super) is_matrix: bool,
}

/// The values of the formulas at a point.
pub(super) struct Outputs {
    /// L = α·v − H
    lagrangian: Jet,
    pub(super) form: Jet,
    hamiltonian: Jet,
    /// ρ, and H before the transformation.
    time: Option<[Jet; 2]>,
    /// The forces times the displacements along both directions.
    work: [Jet; 2],
    constraints: Option<Combination>,
    momenta: Vec<Jet>,
    pub(super) sides: Sides,
    is_delicate: bool,
    /// The operations that it took.
    pub(super) cost: u64,
}

impl System<'_> {
    /// # Errors
    /// Where the formulas cannot be evaluated.
    pub(super) fn outputs(
        &self,
        point: &Point,
        along: Directions,
        part: Part,
        budget: u64,
    ) -> Result<Outputs, NoValue> {
        let Self { model, attribute, texts } = *self;
        let mut evaluation = Evaluation::new(model, texts, point, along, budget);
        let zero = Jet::number(0.0);
        let (lagrangian, form, hamiltonian) = match (&attribute.lagrangian, &attribute.one_form) {
            (Some(lagrangian), _) => {
                let moving = evaluation.number(lagrangian)?;
                if model.kind == Kind::Regular {
                    (moving, zero.clone(), zero)
                } else {
                    evaluation.is_still = true;
                    let still = evaluation.number(lagrangian)?;
                    evaluation.is_still = false;
                    (moving.clone(), moving.minus(still.clone()), still.scaled(-1.0))
                }
            }
            (None, Some(one_form)) => {
                let form = match one_form {
                    syn::Expr::Array(list) => evaluation.components(list)?,
                    _ => evaluation.number(one_form)?,
                };
                let Some(hamiltonian) = &attribute.hamiltonian else { internal("no Hamiltonian") };
                let hamiltonian = match part {
                    Part::All => evaluation.number(hamiltonian)?,
                    Part::Form => zero,
                };
                (form.clone().minus(hamiltonian.clone()), form, hamiltonian)
            }
            (None, None) => internal("no dynamics"),
        };
        let transform = attribute.time_transform.as_ref().zip(model.extended);
        let time = transform.map(|(transform, extended)| {
            Ok((evaluation.number(&transform.rate)?, evaluation.conjugates(extended)?))
        });
        let time = time.transpose()?;
        let untransformed = hamiltonian.clone();
        let (lagrangian, form, hamiltonian) = match &time {
            None => (lagrangian, form, hamiltonian),
            Some((rate, [velocity, energy])) => {
                let form = form.minus(energy.times(velocity));
                let hamiltonian = rate.times(&hamiltonian.minus(energy.clone()));
                (form.clone().minus(hamiltonian.clone()), form, hamiltonian)
            }
        };
        let time = time.map(|(rate, _)| [rate, untransformed]);
        let (lagrangian, form, hamiltonian) = match attribute.gauge() {
            None => (lagrangian, form, hamiltonian),
            Some(gauge) => {
                let [moving, still] = evaluation.rates(gauge)?;
                (lagrangian.plus(&moving), form.plus(&moving).minus(still.clone()), hamiltonian.minus(still))
            }
        };
        let work = evaluation.work(&attribute.forces)?;
        let constraints = match (part, attribute.constraints.as_slice()) {
            (Part::Form, _) | (Part::All, []) => None,
            (Part::All, declared) => Some(evaluation.constraints(declared)?),
        };
        let momenta = attribute
            .momenta
            .iter()
            .filter(|_| part == Part::All)
            .map(|momentum| evaluation.number(&momentum.formula));
        let momenta = momenta.collect::<Result<_, _>>()?;
        let cost = budget - evaluation.budget;
        let Evaluation { sides, is_delicate, .. } = evaluation;
        Ok(Outputs {
            lagrangian,
            form,
            hamiltonian,
            time,
            work,
            constraints,
            momenta,
            sides,
            is_delicate,
            cost,
        })
    }
}

impl Output {
    fn new(function: &'static str, quantity: Quantity) -> Self {
        let is_matrix = matches!(
            quantity,
            Quantity::Hessian
                | Quantity::OneFormJacobian
                | Quantity::ConstraintJacobian
                | Quantity::VelocityConstraintJacobian
        );
        Self { function, quantity, is_matrix }
    }

    /// Whether it has an entry, or a row, for each constraint.
    pub(super) fn is_by_constraint(&self) -> bool {
        matches!(
            self.quantity,
            Quantity::Constraint
                | Quantity::ConstraintJacobian
                | Quantity::ConstraintRate
                | Quantity::ConstraintCurvature
                | Quantity::VelocityConstraint
                | Quantity::VelocityConstraintJacobian
                | Quantity::VelocityConstraintRate
        )
    }

    /// Its name, or that of an entry of it.
    pub(super) fn quantity(&self, entry: Option<&str>) -> String {
        let name = match self.quantity {
            Quantity::Lagrangian => "L",
            Quantity::Lq => "∂L/∂q + F",
            Quantity::Lv => "∂L/∂v",
            Quantity::Hessian => "the weighted second derivative of L, or first one of F",
            Quantity::Hamiltonian => "H",
            Quantity::HamiltonianGradient => "∇H − F",
            Quantity::OneForm => "α",
            Quantity::FlowSource => "∇H − F + ∂α/∂t",
            Quantity::TimeRate => "ρ",
            Quantity::Untransformed => "H before the time transformation",
            Quantity::MomentumRate => "∂²L/∂t∂v",
            Quantity::AppliedForce => "F",
            Quantity::OneFormJacobian => "a Dα + b (Dα)ᵀ",
            Quantity::Energy => "E",
            Quantity::Force => "the force",
            Quantity::Momentum(_) => "J",
            Quantity::MomentumGradient(_) => "∇J",
            Quantity::Constraint => "g",
            Quantity::ConstraintJacobian => "∂g/∂q",
            Quantity::ConstraintRate => "dg/dt",
            Quantity::ConstraintCurvature => "d²g/dt² without acceleration",
            Quantity::VelocityConstraint => "a",
            Quantity::VelocityConstraintJacobian => "the weighted sum of ∂a/∂q and ∂a/∂v",
            Quantity::VelocityConstraintRate => "da/dt without acceleration",
        };
        entry.map_or_else(|| name.to_string(), |entry| format!("{name} at {entry}"))
    }
}

impl Outputs {
    /// Whether everything is finite, and nothing on the way decided by rounding.
    pub(super) fn is_moderate(&self) -> bool {
        let jets = [&self.lagrangian, &self.form, &self.hamiltonian];
        let mut jets =
            jets.into_iter().chain(&self.momenta).chain(self.time.iter().flatten()).chain(&self.work);
        let constraints = self.constraints.as_ref().is_none_or(Combination::is_moderate);
        !self.is_delicate && constraints && jets.all(Jet::is_moderate)
    }

    /// a Dα + b (Dα)ᵀ between the two directions.
    pub(super) fn form_jacobian(&self, point: &Point) -> Sized {
        let [a, b] = [Weight::A, Weight::B].map(|weight| point.weight(weight));
        let (direct, transposed) = (First::V, First::Q);
        self.form.both(direct, Second::Q).times(a).plus(self.form.both(transposed, Second::V).times(b))
    }

    /// ∂α/∂t along the second direction.
    pub(super) fn form_rate(&self) -> Sized {
        self.form.both(First::T, Second::V)
    }

    /// ∂²L/∂v∂v between the two directions.
    pub(super) fn mass(&self) -> Sized {
        self.lagrangian.both(First::V, Second::V)
    }

    /// What couples positions and velocities in L.
    pub(super) fn coupling(&self) -> [Sized; 2] {
        [self.lagrangian.both(First::Q, Second::V), self.lagrangian.both(First::V, Second::Q)]
    }

    /// ∂²a/∂v∂v of constraints of the velocities.
    pub(super) fn constraint_bend(&self) -> Option<Sized> {
        self.constraints.as_ref().map(Combination::bend)
    }

    /// ∂F/∂v between the two directions.
    pub(super) fn friction(&self) -> Sized {
        let [work, _] = &self.work;
        work.second(Second::V)
    }

    /// α along the first direction.
    pub(super) fn form_along(&self) -> Sized {
        self.form.first(First::V)
    }

    /// ∂L/∂v along the first direction.
    pub(super) fn momentum_along(&self) -> Sized {
        self.lagrangian.first(First::V)
    }

    pub(super) fn expected(&self, output: &Output, point: &Point) -> Sized {
        let Self { lagrangian, form, hamiltonian, work: [first_work, second_work], momenta, .. } = self;
        let minus = |value: Sized, other: Sized| value.plus(other.times(-1.0));
        let time = |part: usize| match &self.time {
            Some(time) => time[part].value(),
            None => internal("no time transformation"),
        };
        let constraints = || match &self.constraints {
            Some(constraints) => constraints,
            None => internal("no constraints"),
        };
        match output.quantity {
            Quantity::Lagrangian => lagrangian.value(),
            Quantity::Lq | Quantity::Force => lagrangian.first(First::Q).plus(first_work.value()),
            Quantity::AppliedForce => first_work.value(),
            Quantity::Lv => lagrangian.first(First::V),
            Quantity::Hessian => {
                let blocks = [
                    (Weight::Qq, First::Q, Second::Q),
                    (Weight::Qv, First::Q, Second::V),
                    (Weight::Vq, First::V, Second::Q),
                    (Weight::Vv, First::V, Second::V),
                ];
                let weighted =
                    |(weight, first, second)| lagrangian.both(first, second).times(point.weight(weight));
                let forces = [(Weight::Qq, Second::Q), (Weight::Qv, Second::V)]
                    .map(|(weight, second)| first_work.second(second).times(point.weight(weight)));
                blocks.into_iter().map(weighted).chain(forces).fold(Sized::default(), Sized::plus)
            }
            Quantity::Hamiltonian => hamiltonian.value(),
            Quantity::HamiltonianGradient => minus(hamiltonian.first(First::Q), first_work.value()),
            Quantity::OneForm => form.first(First::V),
            Quantity::FlowSource => {
                minus(hamiltonian.second(Second::Q), second_work.value()).plus(form.both(First::T, Second::V))
            }
            Quantity::TimeRate => time(0),
            Quantity::Untransformed => time(1),
            Quantity::MomentumRate => lagrangian.both(First::T, Second::V),
            Quantity::OneFormJacobian => self.form_jacobian(point),
            Quantity::Energy => lagrangian.first(First::Stretch).plus(lagrangian.value().times(-1.0)),
            Quantity::Momentum(number) => momenta[number].value(),
            Quantity::MomentumGradient(number) => momenta[number].first(First::Q),
            Quantity::Constraint | Quantity::VelocityConstraint => constraints().value(),
            Quantity::ConstraintJacobian => constraints().along_positions(),
            Quantity::VelocityConstraintJacobian => {
                let [by_positions, by_velocities] = [Weight::Q, Weight::V].map(|weight| point.weight(weight));
                let constraints = constraints();
                let along = constraints.along_positions().times(by_positions);
                along.plus(constraints.along_velocities().times(by_velocities))
            }
            Quantity::ConstraintRate | Quantity::VelocityConstraintRate => constraints().rate(),
            Quantity::ConstraintCurvature => constraints().curvature(),
        }
    }

    /// The difference in units of the sum of the absolute terms.
    pub(super) fn difference(&self, output: &Output, found: f64, point: &Point) -> f64 {
        difference(self.expected(output, point), found)
    }
}

/// Of smaller numbers the squares and cubes are not numbers any more.
const SMALLEST: f64 = 1e-100;

/// The difference in units of the sum of the absolute terms; infinite where `found` is no number.
pub(super) fn difference(expected: Sized, found: f64) -> f64 {
    let off = (found - expected.value).abs();
    if off == 0.0 || (expected.size < SMALLEST && found.abs() < SMALLEST) {
        0.0
    } else if off.is_nan() || expected.size == 0.0 {
        f64::INFINITY
    } else {
        off / expected.size
    }
}

impl Functions<'_> {
    fn shared(&self) -> &Programs {
        match self {
            Self::Degenerate(programs) => &programs.shared,
            Self::Regular(programs) => &programs.shared,
        }
    }

    /// How many members each declared constraint has.
    pub(super) fn constraint_lengths(&self) -> &[Index] {
        self.shared().constraints.as_ref().map_or(&[], |constraints| &constraints.lengths)
    }

    /// Whether an instruction reads an entry that is not there: one side of a choice may need sizes that the
    /// other does not, and the generated check asks for both.
    pub(super) fn reads_outside(&self, graph: &Graph, model: &Model, point: &Point) -> bool {
        let machine = Machine { graph, model, point, directions: Directions::ALL, conjugates: None };
        let shared = self.shared();
        shared.dynamics().chain(&shared.momenta).any(|routine| machine.run(routine).reads_outside)
    }

    /// Each output of each function, along these directions.
    pub(super) fn carried_out(
        &self,
        graph: &Graph,
        model: &Model,
        point: &Point,
        directions: Directions,
    ) -> Vec<(Output, f64)> {
        let machine = Machine { graph, model, point, directions, conjugates: None };
        let mut found = Vec::new();
        let mut add = |function, quantity, value| found.push((Output::new(function, quantity), value));
        let value = |routine: &Routine| machine.run(routine).value;
        let vector = |routine: &Routine| machine.run(routine).along_first(program::Output::Vector);
        let shared = self.shared();
        add("lagrangian", Quantity::Lagrangian, value(&shared.lagrangian));
        for (function, routine) in [("gradient", &shared.gradient), ("linearize", &shared.linearize)] {
            let results: Results = machine.run(routine);
            add(function, Quantity::Lq, results.along_first(program::Output::Lq));
            add(function, Quantity::Lv, results.along_first(program::Output::Lv));
            if function == "linearize" {
                add(function, Quantity::Hessian, results.matrix);
            }
        }
        if let Some(forces) = &shared.forces {
            add("applied_force", Quantity::AppliedForce, vector(forces));
        }
        if let Some(constraints) = &shared.constraints {
            let along = |routine: &Routine| machine.run(routine).constraints;
            let (value, rate) = (along(&constraints.value), along(&constraints.rate));
            let jacobian = machine.run(&constraints.jacobian);
            match (constraints.of, &constraints.curvature) {
                (Constrained::Gaps, _) => {
                    add("gap", Quantity::Constraint, value);
                    add("gap_jacobian", Quantity::Constraint, jacobian.constraints);
                    add("gap_jacobian", Quantity::ConstraintJacobian, jacobian.matrix);
                    add("gap_rate", Quantity::ConstraintRate, rate);
                }
                (_, Some(curvature)) => {
                    add("constraint", Quantity::Constraint, value);
                    add("constraint_jacobian", Quantity::Constraint, jacobian.constraints);
                    add("constraint_jacobian", Quantity::ConstraintJacobian, jacobian.matrix);
                    add("constraint_rate", Quantity::ConstraintRate, rate);
                    add("constraint_curvature", Quantity::ConstraintCurvature, along(curvature));
                }
                (_, None) => {
                    let function = "velocity_constraint_jacobian";
                    add("velocity_constraint", Quantity::VelocityConstraint, value);
                    add(function, Quantity::VelocityConstraint, jacobian.constraints);
                    add(function, Quantity::VelocityConstraintJacobian, jacobian.matrix);
                    add("velocity_constraint_rate", Quantity::VelocityConstraintRate, rate);
                }
            }
        }
        for (number, momentum) in shared.momenta.iter().enumerate() {
            add("momentum", Quantity::Momentum(number), value(momentum));
        }
        match self {
            Self::Degenerate(programs) => {
                add("hamiltonian", Quantity::Hamiltonian, value(&programs.hamiltonian));
                let gradient = vector(&programs.hamiltonian_gradient);
                add("hamiltonian_gradient", Quantity::HamiltonianGradient, gradient);
                add("one_form", Quantity::OneForm, vector(&programs.one_form));
                let source = machine.run(&programs.flow_source).along_second(program::Output::Vector);
                add("flow_source", Quantity::FlowSource, source);
                if let Some(time) = &programs.time {
                    add("time_transform", Quantity::TimeRate, value(&time.rate));
                    add("time_transform", Quantity::Untransformed, value(&time.hamiltonian));
                }
                let jacobian = machine.run(&programs.one_form_jacobian).matrix;
                add("one_form_jacobian", Quantity::OneFormJacobian, jacobian);
                for (number, gradient) in programs.momentum_gradients.iter().enumerate() {
                    add("momentum_gradient", Quantity::MomentumGradient(number), vector(gradient));
                }
            }
            Self::Regular(programs) => {
                add("energy", Quantity::Energy, value(&programs.energy));
                add("force", Quantity::Force, vector(&programs.force));
                let rate = machine.run(&programs.momentum_rate).along_second(program::Output::Vector);
                add("momentum_rate", Quantity::MomentumRate, rate);
            }
        }
        found
    }
}
