//! The laws can be broken: mistakes that a scheme can have, and the law that sees each. A midpoint rule
//! with one of them stands in for a scheme; without any it keeps all laws.

use dvi_core::discrete::{Midpoint, Unfitted};
use dvi_core::error::CheckpointError;
use dvi_core::methods::{Carries, Here, Method, PreservedForm, Scheme, Step};
use dvi_core::prelude::*;
use dvi_core::state::{Memory, Record};
use dvi_core::{Real, Vector};
use dvi_laws::equations::{Equations, Nodes};
use dvi_laws::systems::{FusedSeparable, Shaken, real};
use dvi_laws::{Case, Fused, Options, on};

use super::checkpoint::runs_go_on;
use super::equations::steps_solve_their_equations;
use super::failure::a_failed_step_leaves_no_trace;
use super::order::errors_have_the_order;
use super::reversal::steps_back_undo_steps;
use super::structure::forms_are_preserved;

#[derive(Clone, Copy, Debug, PartialEq)]
enum Mistake {
    None,
    /// Of the step, by 10⁻⁹.
    Coefficient,
    /// Of the increment, which is taken back and once more.
    Sign,
    /// Every step begins at t = 0.
    Time,
    /// Where a step fails, the point has moved.
    MovedByFailure,
    /// What steps depend on is not written down.
    NotSaved,
    /// What steps depend on is not copied.
    NotCopied,
}

type Inner = Variational<Unfitted, Midpoint>;

#[derive(Clone, Copy, Debug)]
struct Mistaken(Mistake);

impl Scheme for Mistaken {
    fn order(&self) -> usize {
        2
    }
    fn is_symmetric(&self) -> bool {
        true
    }
    fn preserved_form(&self) -> PreservedForm {
        PreservedForm::Canonical
    }
}

/// What the rule carries, and a length that changes from step to step where that is to be forgotten.
struct Kept<M, T> {
    inner: M,
    length: [T; 1],
    mistake: Mistake,
}

impl<M: Memory<T>, T: Real> Memory<T> for Kept<M, T> {
    fn restore(&mut self, from: &Self) {
        self.inner.restore(&from.inner);
        if self.mistake != Mistake::NotCopied {
            self.length = from.length;
        }
    }
    fn save(&self, record: &mut Record<T>) {
        self.inner.save(record);
        if self.mistake != Mistake::NotSaved {
            record.numbers(&self.length);
        }
    }
    fn load(&mut self, record: &mut Record<T>) -> Result<(), CheckpointError> {
        self.inner.load(record)?;
        if self.mistake == Mistake::NotSaved { Ok(()) } else { record.read(&mut self.length) }
    }
}

impl<S: System, T: Real> Carries<S, T> for Mistaken {
    type Memory = Kept<<Inner as Carries<S, T>>::Memory, T>;
}

impl<S: RegularLagrangian<T>, T: Real> Method<S, T> for Mistaken {
    type Suited<M> = M;

    fn begin(&self, system: &S, q: &Vector<S, T>, v: &[T], t: T, h: T) -> Result<Self::Memory, StartError> {
        let inner = Variational::midpoint().begin(system, q, v, t, h)?;
        Ok(Kept { inner, length: [T::lift(1.0)], mistake: self.0 })
    }

    fn step(&self, step: Step<'_, S, T>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        let Step { system, q, t, h, statistics } = step;
        let before = q.to_vec();
        let t = if self.0 == Mistake::Time { T::lift(0.0) } else { t };
        let h = if self.0 == Mistake::Coefficient { h * T::lift(1.0 + 1e-9) } else { h * memory.length[0] };
        let step = Step { system, q: &mut *q, t, h, statistics };
        let taken = Variational::midpoint().step(step, &mut memory.inner);
        match self.0 {
            Mistake::Sign => q.iter_mut().zip(before).for_each(|(q, before)| *q = before + before - *q),
            Mistake::NotSaved | Mistake::NotCopied => memory.length[0] *= T::lift(0.999),
            Mistake::MovedByFailure if taken.is_err() => q[0] += T::lift(1e-3),
            _ => {}
        }
        taken
    }

    fn velocity(&self, here: Here<'_, S, T>, memory: &Self::Memory, v: &mut [T]) -> Result<(), StepFailure> {
        Variational::midpoint().velocity(here, &memory.inner, v)
    }
}

fn case(mistake: Mistake) -> Case {
    let (system, subject) = on(Shaken { depth: 0.4 }, [&[0.5, -0.2], &[0.4, -0.3]], 0.06);
    let equations = Equations::Discrete(Nodes::new(&[0.5], &[1.0]));
    let method = Mistaken(mistake);
    Case::new(system, &subject, Options::default(), (method, method), (equations, None))
}

fn fused(mistake: Mistake) -> Fused {
    Fused::new(&FusedSeparable, [&[0.5, -0.2], &[0.4, -0.3]], [-0.7, 0.1], Mistaken(mistake))
}

#[test]
fn without_a_mistake_all_laws_hold() {
    super::ask(&[case(Mistake::None)], |case| {
        steps_solve_their_equations(case)?;
        errors_have_the_order(case)?;
        forms_are_preserved(case)?;
        steps_back_undo_steps(case)?;
        runs_go_on(case)
    });
    super::ask(&[fused(Mistake::None)], a_failed_step_leaves_no_trace);
}

#[test]
fn each_mistake_is_seen() {
    for mistake in [Mistake::Coefficient, Mistake::Sign, Mistake::Time] {
        assert!(steps_solve_their_equations(&case(mistake)).is_err(), "{mistake:?}");
    }
    for mistake in [Mistake::Sign, Mistake::Time] {
        assert!(errors_have_the_order(&case(mistake)).is_err(), "{mistake:?}");
    }
    assert!(forms_are_preserved(&case(Mistake::Sign)).is_err());
    for mistake in [Mistake::NotSaved, Mistake::NotCopied] {
        assert!(runs_go_on(&case(mistake)).is_err(), "{mistake:?}");
    }
    assert!(a_failed_step_leaves_no_trace(&fused(Mistake::MovedByFailure)).is_err());
}

/// What a scheme says of itself is not believed either.
#[test]
fn each_claim_is_seen() {
    let mut claims = case(Mistake::None);
    for order in [1, 3] {
        claims.order = order;
        assert!(errors_have_the_order(&claims).is_err(), "order {order}");
    }
    claims.order = 2;
    claims.form = PreservedForm::Nothing;
    assert!(forms_are_preserved(&claims).is_err());
    // Of a conjugate form in other coordinates than those that it is preserved in.
    let newmark = |beta: f64| {
        let (system, subject) = on(Shaken { depth: 0.4 }, [&[0.5, -0.2], &[0.4, -0.3]], 0.06);
        let methods = (Newmark::new(0.25), Newmark::new(real(0.25)));
        Case::new(system, &subject, Options::default(), methods, (Equations::Newmark(beta), None))
    };
    assert!(forms_are_preserved(&newmark(0.25)).is_ok() && forms_are_preserved(&newmark(0.24)).is_err());
    assert!(steps_back_undo_steps(&case(Mistake::Sign)).is_err());
}
