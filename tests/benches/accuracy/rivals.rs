//! The crate `ode_solvers` on the right-hand sides by hand.
//!
//! It keeps the state after each step, which is an addition to a list, and no other output is asked for. The
//! energies are computed from this list where the time is not measured.

use ode_solvers::dop_shared::OutputType;
use ode_solvers::{Dop853, SVector, System};

use crate::fields::Field;
use crate::problem::{Method, Run, Scale, Watch};
use crate::problems::REFERENCE;

/// A run that takes more steps has got stuck at a tolerance below rounding errors, and is lost.
const MOST_STEPS: u32 = 200_000;

/// A field as the crate wants it.
struct Equations<F>(F);

impl<F: Field<N>, const N: usize> System<f64, SVector<f64, N>> for Equations<F> {
    #[inline]
    fn system(&self, _t: f64, y: &SVector<f64, N>, slope: &mut SVector<f64, N>) {
        let [y] = &y.data.0;
        slope.data.0 = [self.0.slope(y)];
    }
}

/// A field with a start, the time at which runs end, and how errors are measured.
#[derive(Clone)]
pub(crate) struct Task<F, const N: usize> {
    pub(crate) field: F,
    pub(crate) start: [f64; N],
    pub(crate) end: f64,
    pub(crate) scale: Scale,
    /// The absolute tolerance, in units of the relative one.
    pub(crate) absolute: f64,
}

impl<F: Field<N>, const N: usize> Task<F, N> {
    /// Dop853 over tolerances.
    pub(crate) fn method(&self, tolerances: &[f64]) -> Method {
        let run = |&tolerance: &f64| {
            let (alone, watched) = (self.clone(), self.clone());
            Run::new(
                move || alone.solved(tolerance, |_| ()).is_some(),
                move || {
                    let field = &watched.field;
                    let mut watch = Watch::new(field.energy(&watched.start), watched.scale);
                    let evaluations = watched.solved(tolerance, |y| watch.note(field.energy(y)))?;
                    Some(watch.seen(evaluations))
                },
            )
        };
        Method { name: REFERENCE.to_owned(), runs: tolerances.iter().map(run).collect() }
    }

    /// Solves it to a tolerance, shows the state after each step, and returns the number of evaluations.
    fn solved(&self, tolerance: f64, mut show: impl FnMut(&[f64; N])) -> Option<u64> {
        let (start, absolute) = (SVector::from(self.start), tolerance * self.absolute);
        let (safety, beta, smallest, largest, first) = (0.9, 0.0, 0.333, 6.0, 0.0);
        let mut run = Dop853::from_param(
            Equations(self.field.clone()),
            0.0,
            self.end,
            self.end,
            start,
            tolerance,
            absolute,
            safety,
            beta,
            smallest,
            largest,
            self.end,
            first,
            MOST_STEPS,
            1000,
            OutputType::Sparse,
        );
        let statistics = run.integrate().ok()?;
        run.y_out().iter().for_each(|y| show(&y.data.0[0]));
        Some(statistics.num_eval.into())
    }
}
