//! What is compared, and how it is called in a message.

use crate::syntax::Constrained;

/// What is compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Quantity {
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
    /// g, and its derivatives by q, v and t.
    Event(usize),
    EventLq(usize),
    EventLv(usize),
    EventByTime(usize),
    Constraint(Constrained),
    ConstraintJacobian(Constrained),
    ConstraintRate(Constrained),
    ConstraintCurvature,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Output {
    pub(super) function: &'static str,
    pub(super) quantity: Quantity,
    pub(super) is_matrix: bool,
}

impl Output {
    pub(super) fn new(function: &'static str, quantity: Quantity) -> Self {
        let is_matrix = matches!(
            quantity,
            Quantity::Hessian | Quantity::OneFormJacobian | Quantity::ConstraintJacobian(_)
        );
        Self { function, quantity, is_matrix }
    }

    /// Whether it has an entry, or a row, for each constraint.
    pub(super) fn is_by_constraint(&self) -> bool {
        matches!(
            self.quantity,
            Quantity::Constraint(_)
                | Quantity::ConstraintJacobian(_)
                | Quantity::ConstraintRate(_)
                | Quantity::ConstraintCurvature
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
            Quantity::Event(_) => "the event g",
            Quantity::EventLq(_) => "∂g/∂q of the event",
            Quantity::EventLv(_) => "∂g/∂v of the event",
            Quantity::EventByTime(_) => "∂g/∂t of the event",
            Quantity::Constraint(of) => of.words().letter,
            Quantity::ConstraintJacobian(Constrained::Velocities) => "the weighted sum of ∂a/∂q and ∂a/∂v",
            Quantity::ConstraintJacobian(_) => "∂g/∂q",
            Quantity::ConstraintRate(Constrained::Velocities) => "da/dt without acceleration",
            Quantity::ConstraintRate(_) => "dg/dt",
            Quantity::ConstraintCurvature => "d²g/dt² without acceleration",
        };
        entry.map_or_else(|| name.to_string(), |entry| format!("{name} at {entry}"))
    }
}
