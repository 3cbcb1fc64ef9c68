//! Other crates: `ode_solvers`, and `differential-equations`, on the right-hand sides by hand.
//!
//! Both keep the state after each step, which is an addition to a list, and no other output is asked for.
//! The energies are computed from these lists where the time is not measured. `differential-equations`
//! prepares its interpolation in each step, with three evaluations in Dop853, and has no switch for that.

use differential_equations::prelude::{ExplicitRungeKutta, IVP, ODE};
use ode_solvers::dop_shared::OutputType;
use ode_solvers::{Dop853, SVector, System};

use crate::fields::Field;
use crate::problem::{Method, Run, Scale, Seen, Watch};

/// A run that takes more steps has got stuck at a tolerance below rounding errors, and is lost.
const MOST_STEPS: u32 = 200_000;

/// A field as both crates want it.
#[derive(Clone)]
struct Equations<F>(F);

impl<F: Field<N>, const N: usize> System<f64, SVector<f64, N>> for Equations<F> {
    #[inline]
    fn system(&self, _t: f64, y: &SVector<f64, N>, slope: &mut SVector<f64, N>) {
        let [y] = &y.data.0;
        slope.data.0 = [self.0.slope(y)];
    }
}

impl<F: Field<N>, const N: usize> ODE<f64, [f64; N]> for Equations<F> {
    #[inline]
    fn diff(&self, _t: f64, y: &[f64; N], slope: &mut [f64; N]) {
        *slope = self.0.slope(y);
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

/// A program that solves a task to a tolerance, shows the state after each step, and returns the number of
/// evaluations.
type Program<F, const N: usize> = fn(&Task<F, N>, f64, &mut dyn FnMut(&[f64; N])) -> Option<u64>;

impl<F: Field<N>, const N: usize> Task<F, N> {
    /// The programs of the two crates, over tolerances.
    pub(crate) fn methods(&self, tolerances: &[f64]) -> Vec<Method> {
        let programs: [(&str, Program<F, N>); 3] = [
            ("ode_solvers Dop853", dop853),
            ("differential-equations Dop853", other_dop853),
            ("differential-equations RKV 9(8)", rkv98),
        ];
        let method = |(name, program): (&str, Program<F, N>)| Method {
            name: name.to_owned(),
            runs: tolerances.iter().map(|&tolerance| self.run(program, tolerance)).collect(),
        };
        programs.into_iter().map(method).collect()
    }

    fn run(&self, program: Program<F, N>, tolerance: f64) -> Run {
        let (alone, watched) = (self.clone(), self.clone());
        Run::new(
            tolerance,
            move || program(&alone, tolerance, &mut |_| ()).is_some(),
            move || watched.watch(program, tolerance),
        )
    }

    fn watch(&self, program: Program<F, N>, tolerance: f64) -> Option<Seen> {
        let mut watch = Watch::new(self.field.energy(&self.start), self.scale);
        let evaluations = program(self, tolerance, &mut |y| watch.note(self.field.energy(y)))?;
        Some(watch.seen(evaluations))
    }
}

fn dop853<F: Field<N>, const N: usize>(
    task: &Task<F, N>,
    tolerance: f64,
    show: &mut dyn FnMut(&[f64; N]),
) -> Option<u64> {
    let (start, absolute) = (SVector::from(task.start), tolerance * task.absolute);
    let (safety, beta, smallest, largest, first) = (0.9, 0.0, 0.333, 6.0, 0.0);
    let mut run = Dop853::from_param(
        Equations(task.field.clone()),
        0.0,
        task.end,
        task.end,
        start,
        tolerance,
        absolute,
        safety,
        beta,
        smallest,
        largest,
        task.end,
        first,
        MOST_STEPS,
        1000,
        OutputType::Sparse,
    );
    let statistics = run.integrate().ok()?;
    run.y_out().iter().for_each(|y| show(&y.data.0[0]));
    Some(statistics.num_eval.into())
}

/// A method of the crate `differential-equations` on the task.
macro_rules! solved {
    ($method:ident, $task:ident, $tolerance:ident, $show:ident) => {{
        let method = ExplicitRungeKutta::$method().rtol($tolerance).atol($tolerance * $task.absolute);
        let method = method.max_steps(MOST_STEPS as usize);
        let equations = Equations($task.field.clone());
        let solution = IVP::ode(&equations, 0.0, $task.end, $task.start).method(method).solve().ok()?;
        solution.y.iter().for_each($show);
        Some(solution.evals.function as u64)
    }};
}

fn other_dop853<F: Field<N>, const N: usize>(
    task: &Task<F, N>,
    tolerance: f64,
    show: &mut dyn FnMut(&[f64; N]),
) -> Option<u64> {
    solved!(dop853, task, tolerance, show)
}

fn rkv98<F: Field<N>, const N: usize>(
    task: &Task<F, N>,
    tolerance: f64,
    show: &mut dyn FnMut(&[f64; N]),
) -> Option<u64> {
    solved!(rkv989e, task, tolerance, show)
}
