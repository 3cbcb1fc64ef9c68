//! What the generated functions give: their scheduled instructions, carried out.

use super::machine::{Machine, Results};
use super::output::{Output, Quantity};
use super::point::{Directions, Point};
use crate::model::Model;
use crate::program::{DegeneratePrograms, Programs, RegularPrograms};
use crate::routine::Routine;
use crate::statement;
use crate::structure::{MassMatrix, OneForm};
use crate::symbolic::{Count, Graph};

/// The generated functions, and what is said of their structure.
pub(crate) enum Functions<'a> {
    Degenerate(&'a DegeneratePrograms, &'a OneForm),
    Regular(&'a RegularPrograms, &'a MassMatrix),
}

impl Functions<'_> {
    fn shared(&self) -> &Programs {
        match self {
            Self::Degenerate(programs, _) => &programs.shared,
            Self::Regular(programs, _) => &programs.shared,
        }
    }

    /// How many members each declared constraint has.
    pub(super) fn constraint_lengths(&self) -> &[Count] {
        self.shared().constraints.as_ref().map_or(&[], |constraints| &constraints.lengths)
    }

    /// Whether an instruction reads an entry that is not there: one side of a choice may need sizes that the
    /// other does not, and the generated check asks for both.
    pub(super) fn reads_outside(&self, graph: &Graph, model: &Model, point: &Point) -> bool {
        let machine = Machine { graph, model, point, directions: Directions::ALL, conjugates: None };
        let shared = self.shared();
        shared.dynamics().chain(shared.observed()).any(|routine| machine.run(routine).reads_outside)
    }

    /// The numbers at whose zeros L or a force is not smooth.
    pub(super) fn seams(&self, graph: &Graph, model: &Model, point: &Point) -> Vec<f64> {
        let machine = Machine { graph, model, point, directions: Directions::ALL, conjugates: None };
        self.shared().seams.iter().map(|seam| machine.run(seam).value).collect()
    }

    /// Each output of each function, along these directions.
    pub(super) fn carried_out(
        &self,
        graph: &Graph,
        model: &Model,
        point: &Point,
        directions: Directions<'_>,
    ) -> Vec<(Output, f64)> {
        let machine = Machine { graph, model, point, directions, conjugates: None };
        let mut found = Vec::new();
        let mut add = |function, quantity, value| found.push((Output::new(function, quantity), value));
        let value = |routine: &Routine| machine.run(routine).value;
        let vector = |routine: &Routine| machine.run(routine).along_first(statement::Output::Vector);
        let shared = self.shared();
        add("lagrangian", Quantity::Lagrangian, value(&shared.lagrangian));
        for (function, routine) in [("gradient", &shared.gradient), ("linearize", &shared.linearize)] {
            let results: Results = machine.run(routine);
            add(function, Quantity::Lq, results.along_first(statement::Output::Lq));
            add(function, Quantity::Lv, results.along_first(statement::Output::Lv));
            if function == "linearize" {
                add(function, Quantity::Hessian, results.matrix);
            }
        }
        if let Some(forces) = &shared.forces {
            add("applied_force", Quantity::AppliedForce, vector(forces));
        }
        if let Some(constraints) = &shared.constraints {
            let along = |routine: &Routine| machine.run(routine).constraints;
            let (of, jacobian) = (constraints.of, machine.run(&constraints.jacobian));
            let [value_of, jacobian_of, rate_of] = of.words().generated;
            add(value_of, Quantity::Constraint(of), along(&constraints.value));
            add(jacobian_of, Quantity::Constraint(of), jacobian.constraints);
            add(jacobian_of, Quantity::ConstraintJacobian(of), jacobian.matrix);
            add(rate_of, Quantity::ConstraintRate(of), along(&constraints.rate));
            if let Some(curvature) = &constraints.curvature {
                add("constraint_curvature", Quantity::ConstraintCurvature, along(curvature));
            }
        }
        for (number, momentum) in shared.momenta.iter().enumerate() {
            add("momentum", Quantity::Momentum(number), value(momentum));
        }
        for (number, event) in shared.events.iter().enumerate() {
            add("event", Quantity::Event(number), value(&event.value));
            let gradient = machine.run(&event.gradient);
            let function = "event_gradient";
            add(function, Quantity::EventLq(number), gradient.along_first(statement::Output::Lq));
            add(function, Quantity::EventLv(number), gradient.along_first(statement::Output::Lv));
            add(function, Quantity::EventByTime(number), value(&event.by_time));
        }
        match self {
            Self::Degenerate(programs, _) => {
                add("hamiltonian", Quantity::Hamiltonian, value(&programs.hamiltonian));
                let gradient = vector(&programs.hamiltonian_gradient);
                add("hamiltonian_gradient", Quantity::HamiltonianGradient, gradient);
                add("one_form", Quantity::OneForm, vector(&programs.one_form));
                let source = machine.run(&programs.flow_source).along_second(statement::Output::Vector);
                add("flow_source", Quantity::FlowSource, source);
                if let Some(time) = &programs.time {
                    add("time_transform", Quantity::TimeRate, value(&time.rate));
                    add("time_transform", Quantity::Untransformed, value(&time.hamiltonian));
                }
                if let Some(pairs) = &programs.pairs {
                    add("rest_energy", Quantity::Hamiltonian, value(&pairs.together));
                    let gradient = vector(&pairs.together_vector);
                    add("rest_hamiltonian_gradient", Quantity::HamiltonianGradient, gradient);
                }
                let jacobian = machine.run(&programs.one_form_jacobian).matrix;
                add("one_form_jacobian", Quantity::OneFormJacobian, jacobian);
                for (number, gradient) in programs.momentum_gradients.iter().enumerate() {
                    add("momentum_gradient", Quantity::MomentumGradient(number), vector(gradient));
                }
            }
            Self::Regular(programs, _) => {
                add("energy", Quantity::Energy, value(&programs.energy));
                add("force", Quantity::Force, vector(&programs.force));
                add("conjugate_momentum", Quantity::Lv, vector(&programs.momentum));
                let rate = machine.run(&programs.momentum_rate).along_second(statement::Output::Vector);
                add("momentum_rate", Quantity::MomentumRate, rate);
                if let Some(pairs) = &programs.pairs {
                    add("rest_energy", Quantity::Energy, value(&pairs.together));
                    add("rest_force", Quantity::Force, vector(&pairs.together_vector));
                }
            }
        }
        found
    }
}
