//! What the formulas of a system say about each generated function.

use super::formula::{Combination, Evaluation, NoValue, Sides, Texts};
use super::jet::{First, Jet, Second, Sized};
use super::output::{Output, Quantity};
use super::point::{Directions, Point};
use crate::internal::internal;
use crate::model::Model;
use crate::symbolic::Weight;
use crate::syntax::{Attribute, Constrained, Kind, Named};

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
    events: Vec<Jet>,
    /// At whose zeros L or a force is not smooth, as far as they do not stand in sums.
    pub(super) seams: Vec<Jet>,
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
        along: Directions<'_>,
        part: Part,
        budget: u64,
    ) -> Result<Outputs, NoValue> {
        let Self { model, attribute, .. } = *self;
        let mut evaluation = Evaluation::new(*self, point, along, budget);
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
        // A gauge changes no motion.
        let seams = std::mem::take(&mut evaluation.seams);
        let (lagrangian, form, hamiltonian) = match attribute.gauge() {
            None => (lagrangian, form, hamiltonian),
            Some(gauge) => {
                let [moving, still] = evaluation.rates(gauge)?;
                (lagrangian.plus(&moving), form.plus(&moving).minus(still.clone()), hamiltonian.minus(still))
            }
        };
        evaluation.seams = seams;
        let work = evaluation.work(attribute)?;
        let seams = std::mem::take(&mut evaluation.seams);
        let constraints = match (part, attribute.constraints.as_slice()) {
            (Part::Form, _) | (Part::All, []) => None,
            (Part::All, declared) => Some(evaluation.constraints(declared)?),
        };
        let mut named = |declared: &[Named]| {
            let declared = if part == Part::All { declared } else { &[] };
            declared.iter().map(|named| evaluation.number(&named.formula)).collect::<Result<_, _>>()
        };
        let (momenta, events) = (named(&attribute.momenta)?, named(&attribute.events)?);
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
            events,
            seams,
            sides,
            is_delicate,
            cost,
        })
    }
}

impl Outputs {
    /// Whether everything is finite, and nothing on the way decided by rounding.
    pub(super) fn is_moderate(&self) -> bool {
        let jets = [&self.lagrangian, &self.form, &self.hamiltonian];
        let mut jets = jets
            .into_iter()
            .chain(&self.momenta)
            .chain(&self.events)
            .chain(self.time.iter().flatten())
            .chain(&self.work);
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
        self.constraints.as_ref().map(|constraints| constraints.value.both(First::V, Second::V))
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
        let Self { lagrangian, form, hamiltonian, work: [first_work, second_work], momenta, events, .. } =
            self;
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
            Quantity::FlowSource => minus(hamiltonian.second(Second::Q), second_work.value())
                .plus(form.both(First::T, Second::V)),
            Quantity::TimeRate => time(0),
            Quantity::Untransformed => time(1),
            Quantity::MomentumRate => lagrangian.both(First::T, Second::V),
            Quantity::OneFormJacobian => self.form_jacobian(point),
            Quantity::Energy => lagrangian.first(First::Stretch).plus(lagrangian.value().times(-1.0)),
            Quantity::Momentum(number) => momenta[number].value(),
            Quantity::MomentumGradient(number) => momenta[number].first(First::Q),
            Quantity::Event(number) => events[number].value(),
            Quantity::EventLq(number) => events[number].first(First::Q),
            Quantity::EventLv(number) => events[number].first(First::V),
            Quantity::EventByTime(number) => events[number].first(First::T),
            Quantity::Constraint(_) => constraints().value.value(),
            Quantity::ConstraintJacobian(Constrained::Velocities) => {
                let [by_positions, by_velocities] =
                    [Weight::Q, Weight::V].map(|weight| point.weight(weight));
                let along = |second| constraints().value.second(second);
                along(Second::Q).times(by_positions).plus(along(Second::V).times(by_velocities))
            }
            Quantity::ConstraintJacobian(_) => constraints().value.second(Second::Q),
            Quantity::ConstraintRate(_) => constraints().rate.value(),
            // The first direction of positions is the velocity.
            Quantity::ConstraintCurvature => {
                let rate = &constraints().rate;
                rate.first(First::Q).plus(rate.first(First::T))
            }
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
