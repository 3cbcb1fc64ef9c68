//! What is read of runs, and runs that several experiments take.

use crate::vocabulary::*;

/// What `of` reads of a run, at its start and after each of so many steps.
pub fn course<R: Run, T>(run: &mut R, steps: u64, mut of: impl FnMut(&R) -> T) -> Result<Vec<T>, StepError> {
    let mut course = vec![of(run)];
    for _ in 0..steps {
        run.advance()?;
        course.push(of(run));
    }
    Ok(course)
}

/// The place of a run in the plane of its first two coordinates.
pub fn place<R: Run<Scalar = f64>>(run: &R) -> [f64; 2] {
    [run.q()[0], run.q()[1]]
}

pub type AnyRun<'a, S> = Box<dyn Run<System = S, Scalar = f64> + 'a>;

/// A motion that several methods compute: its system, and where it begins.
pub struct Problem<'a, S: System> {
    system: &'a S,
    start: S::State<f64>,
}

impl<'a, S: Lagrangian> Problem<'a, S> {
    pub fn new(system: &'a S, start: impl Into<S::State<f64>>) -> Self {
        Self { system, start: start.into() }
    }

    pub fn run<M: Method<S, f64>>(&self, method: M, h: f64) -> Result<Integrator<&'a S, M>> {
        Ok(Integrator::new(self.system, method, h, self.start.clone())?)
    }

    /// A run beside others of other methods.
    pub fn any(&self, method: impl Method<S, f64> + 'a, h: f64) -> Result<AnyRun<'a, S>> {
        Ok(Box::new(self.run(method, h)?))
    }

    pub fn up_to(&self, method: impl Method<S, f64>, h: f64, end: f64) -> Result<S::State<f64>> {
        let mut run = self.run(method, h)?;
        run.take_steps((end / h).round() as u64)?;
        Ok(run.state())
    }

    /// The largest difference of a coordinate or velocity from the start, after steps there and as many
    /// back.
    pub fn there_and_back(&self, by: impl Method<S, f64> + Copy, h: f64, steps: u64) -> Result<f64> {
        let mut there = self.run(by, h)?;
        there.take_steps(steps)?;
        let mut back = Integrator::new_at(self.system, by, there.time(), -h, there.state())?;
        back.take_steps(steps)?;
        self.apart(&back.state(), &self.start)
    }

    /// The largest difference of a coordinate or velocity of two states.
    pub fn apart(&self, one: &S::State<f64>, other: &S::State<f64>) -> Result<f64> {
        let values = |state| Ok(self.system.values(state)?.collect::<Vec<f64>>());
        let [one, other] = each([one, other], values)?;
        Ok(apart(&one, &other))
    }

    /// Iterations of a step, on average over so many of them.
    pub fn iterations(&self, method: impl Method<S, f64>, h: f64, steps: u64) -> Result<f64> {
        let mut run = self.run(method, h)?;
        run.take_steps(steps)?;
        Ok(run.statistics().iterations as f64 / steps as f64)
    }

    /// The errors of the coordinates at time `end`, of runs with so many steps.
    pub fn errors<E: Fn(&[f64]) -> f64>(self, end: f64, counts: &[u64], error: E) -> Convergence<'a, S, E> {
        Convergence { problem: self, end, counts: counts.into(), error }
    }
}

/// What shows the order of methods: the errors of a motion at a time, of runs with so many steps.
pub struct Convergence<'a, S: System, E> {
    problem: Problem<'a, S>,
    end: f64,
    counts: Vec<u64>,
    error: E,
}

impl<'a, S: Lagrangian, E: Fn(&[f64]) -> f64> Convergence<'a, S, E> {
    /// The lengths of the steps of a method, each with the error.
    pub fn of(&self, method: impl Method<S, f64> + Clone) -> Result<Vec<(f64, f64)>> {
        let error = |&steps: &u64| {
            let mut run = self.problem.run(method.clone(), self.end / steps as f64)?;
            run.take_steps(steps)?;
            Ok((self.end / steps as f64, (self.error)(run.q())))
        };
        self.counts.iter().map(error).collect()
    }

    pub fn order(&self, method: impl Method<S, f64> + Clone) -> Result<Option<f64>> {
        Ok(order(self.of(method)?))
    }
}

/// A member of the σ-family whose second point comes from RK2, as in the paper.
pub fn begun_by_rk2(sigma: f64) -> Sigma {
    Sigma { start: Start::RungeKutta(RungeKutta::midpoint()), ..Sigma::new(sigma) }
}

/// The same scheme, whatever becomes of its parasitic mode.
pub fn unwatched(scheme: Sigma) -> Sigma {
    Sigma { parasitic_limit: None, ..scheme }
}

/// The first of the momenta of a run; not numbers if it has not as many.
pub fn momenta<const N: usize>(run: &impl Run<Scalar = f64>) -> [f64; N] {
    std::array::from_fn(|k| run.momentum(k).unwrap_or(f64::NAN))
}

/// One if a run is lost within so many steps, and zero if not: if its energy grows by that factor, no number
/// is left of it, or a step fails.
pub fn is_lost(run: &mut impl Run<Scalar = f64>, steps: u64, factor: f64) -> f64 {
    let begin = run.energy();
    let grown = |energy: f64| energy.is_nan() || energy > factor * begin;
    f64::from((0..steps).any(|_| run.advance().is_err() || grown(run.energy())))
}

/// A time, a colour, and the shape then.
pub type Shape = (f64, Colour, Points);

/// The shapes of what begins at the origin, at six times up to the end of so many steps.
pub fn shapes<S: System>(
    mut run: impl Run<System = S, Scalar = f64>,
    steps: f64,
    of: impl Fn(S::State<f64>) -> Points,
) -> Result<[Shape; 6]> {
    each([0, 2, 3, 5, 6, 7], |colour: usize| {
        if colour > 0 {
            run.take_steps(steps as u64 / 5)?;
        }
        Ok((run.time(), SEQUENCE[colour], [[0.0; 2]].into_iter().chain(of(run.state())).collect()))
    })
}

/// Steps of the trapezoidal rule that are divided at impacts.
pub type Bouncing = Impacts<Variational<Unfitted, Trapezoid>>;

/// With that law of impact.
pub fn trapezoid(collision: Collision) -> Bouncing {
    Impacts { collision, ..Impacts::new(Variational::trapezoid()) }
}

/// The state after as many steps back as a run has taken.
pub fn back<S: Lagrangian, M: Method<S, f64>>(by: M, run: &Integrator<&S, M>) -> Result<S::State<f64>> {
    let back = run.checkpoint().with_step_size(-run.step_size());
    let mut back = Integrator::resume(run.system(), by, &back)?;
    back.take_steps(run.steps())?;
    Ok(back.state())
}

/// The largest relative deviation of rods from their length, and the largest velocity of their ends along
/// them, from the place and velocity of one end as seen from the other.
pub fn stretched(length: f64, rods: impl IntoIterator<Item = [[f64; 2]; 2]>) -> [f64; 2] {
    rods.into_iter().fold([0.0; 2], |[deviation, along], [place, velocity]| {
        let found = place[0].hypot(place[1]);
        let rate = dot(place, velocity) / found;
        [larger(deviation, (found / length - 1.0).abs()), larger(along, rate.abs())]
    })
}

/// The entry of Ω of a system in the plane.
pub fn omega<S: DegenerateLagrangian>(system: &S, place: [f64; 2]) -> f64 {
    let mut entries = system.space().matrix();
    system.one_form_jacobian(&place, 0.0, -1.0, 1.0, &mut entries);
    entries[1]
}

pub fn points(x: &[f64], y: &[f64]) -> Points {
    x.iter().zip(y).map(|(&x, &y)| [x, y]).collect()
}
