//! A method from whose runs one can go on at some steps only: they are interrupted there, and the results
//! are the same.

use std::time::Duration;

use dvi_core::ensemble::Ensemble;
use dvi_core::error::{CheckpointError, StepFailure};
use dvi_core::methods::{Carries, Here, Method, PreservedForm, Step};
use dvi_core::prelude::*;
use dvi_core::state::{Memory, Record};
use dvi_core::{Lagrangian, System, Vector};

use crate::ensemble::{Checked, HenonHeiles, bytes, file, wells};

/// Another method, with a number that is infinite at most steps, which no checkpoint may have.
#[derive(Clone, Copy, Debug)]
struct Marked<M>(M);

struct Mark<M> {
    inner: M,
    mark: f64,
}

impl<M: Memory<f64>> Memory<f64> for Mark<M> {
    fn restore(&mut self, from: &Self) {
        self.inner.restore(&from.inner);
        self.mark = from.mark;
    }
    fn save(&self, record: &mut Record<f64>) {
        self.inner.save(record);
        record.numbers(&[self.mark]);
    }
    fn load(&mut self, record: &mut Record<f64>) -> Result<(), CheckpointError> {
        self.inner.load(record)?;
        record.read(std::slice::from_mut(&mut self.mark))
    }
}

impl<M: Scheme> Scheme for Marked<M> {
    fn order(&self) -> usize {
        self.0.order()
    }
    fn is_symmetric(&self) -> bool {
        self.0.is_symmetric()
    }
    fn preserved_form(&self) -> PreservedForm {
        self.0.preserved_form()
    }
}

impl<S: System, M: Carries<S, f64>> Carries<S, f64> for Marked<M> {
    type Memory = Mark<M::Memory>;
}

impl<S: Lagrangian, M: Method<S, f64>> Method<S, f64> for Marked<M> {
    type Suited<X> = X;

    fn begin(
        &self,
        system: &S,
        q: &Vector<S, f64>,
        v: &[f64],
        t: f64,
        h: f64,
    ) -> Result<Self::Memory, StartError> {
        Ok(Mark { inner: self.0.begin(system, q, v, t, h)?, mark: f64::INFINITY })
    }

    fn step(&self, step: Step<'_, S, f64>, memory: &mut Self::Memory) -> Result<(), StepFailure> {
        let steps = step.statistics.steps;
        self.0.step(step, &mut memory.inner)?;
        memory.mark = if steps % 5 == 4 { 0.0 } else { f64::INFINITY };
        Ok(())
    }

    fn velocity(
        &self,
        here: Here<'_, S, f64>,
        memory: &Self::Memory,
        v: &mut [f64],
    ) -> Result<(), StepFailure> {
        self.0.velocity(here, &memory.inner, v)
    }
}

#[test]
fn members_are_left_where_they_can_go_on() -> Checked {
    let method = Marked(Variational::trapezoid());
    let ensemble = || Ensemble::new(&HenonHeiles, method, 0.05, wells(3)).stride(1);
    let (plain, path) = (ensemble().take_steps(48)?, file("left-later.ckpt"));
    let mut told = Vec::new();
    let interrupted =
        ensemble().checkpoints(&path, Duration::ZERO).on_progress(|p| told.push(p.steps)).take_steps(48)?;
    assert!(bytes(&interrupted)? == bytes(&plain)?);
    // Two members at least are interrupted on the way, and at these steps only; the last ends at 48.
    assert!(told.iter().any(|&steps| steps > 0 && steps % 48 != 0), "{told:?}");
    assert!(
        told.iter().all(
            |steps| (0..=3).any(|ended| steps.checked_sub(48 * ended).is_some_and(|rest| rest % 5 == 0))
        )
    );
    Ok(())
}
