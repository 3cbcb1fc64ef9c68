//! Poincaré sections: the points at which a run crosses g(q) = 0.
//!
//! With steps of one length the points of a run lie on one smooth orbit, that of the method's modified equation. The
//! polynomial of degree seven through the eight points around a crossing follows it to O(h⁸), and the zero of g on
//! the polynomial is found to rounding: sections stay crisp at steps at which the orbit differs visibly
//! from the exact one. Where the lengths of the steps follow the motion smoothly, so does the orbit. A parasitic mode,
//! where there is one, is not smooth and is not followed.
//! Interpolation in barycentric form: Berrut & Trefethen 2004, eq. 4.2.

use crate::error::StepError;
use crate::run::Run;
use crate::scalar::norm::larger;
use crate::system::Smooth;
use crate::{Real, Scalar, Space, State, System, Vector};

const WINDOW: usize = 8;
/// The interval of the window in which crossings are looked for.
const CENTRE: usize = WINDOW / 2 - 1;

/// The crossings that a section keeps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Direction {
    /// g increases along the run.
    #[default]
    Rising,
    /// g decreases.
    Falling,
    /// Both.
    Either,
}

impl Direction {
    /// Whether a function that goes from `a` to `b` crosses zero in this direction.
    pub(crate) fn crosses<T: Real>(self, a: T, b: T) -> bool {
        let zero = T::lift(0.0);
        match self {
            Self::Rising => a < zero && b >= zero,
            Self::Falling => a > zero && b <= zero,
            Self::Either => (a < zero && b >= zero) || (a > zero && b <= zero),
        }
    }
}

/// A point of a section.
#[derive(Clone, Debug)]
pub struct Crossing<S, T> {
    /// The time of the crossing.
    pub time: T,
    /// The state at the crossing, with named coordinates. The velocities of a regular system are those of the interpolant.
    pub state: S,
}

/// A [`Crossing`] of a run `R`.
pub type CrossingOf<R> =
    Crossing<<<R as Run>::System as System>::State<<R as Run>::Scalar>, <R as Run>::Scalar>;

/// The crossings of a run with g(q) = 0, as an iterator that takes as many steps as it must.
///
/// It looks for sign changes between consecutive points, so a run that crosses twice within a step
/// passes unseen. The run is four steps ahead of the interval that is searched: crossings in the last
/// four steps before a failure are not reported.
pub struct Section<'r, R: Run, G> {
    run: &'r mut R,
    g: G,
    direction: Direction,
    points: [Vector<R::System, R::Scalar>; WINDOW],
    values: [R::Scalar; WINDOW],
    /// The lengths of the steps that led to the points.
    steps: [R::Scalar; WINDOW],
    /// The place of the oldest point.
    oldest: usize,
    filled: usize,
    /// The next interval to search; past the centre, a step is due.
    interval: usize,
    probe: Vector<R::System, R::Scalar>,
    /// The velocity at `probe`, if the system is regular.
    velocity: Vector<R::System, R::Scalar>,
    failed: bool,
}

impl<R: Run + core::fmt::Debug, G> core::fmt::Debug for Section<'_, R, G> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { run, direction, values, .. } = self;
        f.debug_struct("Section")
            .field("run", run)
            .field("direction", direction)
            .field("values", values)
            .finish_non_exhaustive()
    }
}

impl<'r, R: Run, G: FnMut(&[R::Scalar]) -> R::Scalar> Section<'r, R, G> {
    /// The crossings of `run`, from its current state on, with g(q) = 0 in the given direction. All
    /// memory is allocated here.
    pub fn new(run: &'r mut R, direction: Direction, g: G) -> Self
    where
        <R::System as System>::Kind: Smooth,
    {
        let space = run.system().space();
        Self {
            g,
            direction,
            points: space.vectors(),
            values: [R::Scalar::lift(0.0); WINDOW],
            steps: [R::Scalar::lift(0.0); WINDOW],
            oldest: 0,
            filled: 0,
            interval: 0,
            probe: space.vector(),
            velocity: space.vector(),
            failed: false,
            run,
        }
    }

    /// The run, four steps ahead of the interval that is searched.
    pub fn run(&self) -> &R {
        self.run
    }

    /// Takes one step at most and returns the crossing that it brought to light, if there is one. For
    /// runs that may never cross again, where the iterator would not end.
    ///
    /// # Errors
    /// [`StepError`] of the run.
    pub fn advance(&mut self) -> Result<Option<CrossingOf<R>>, StepError> {
        if self.filled < WINDOW || self.interval > CENTRE {
            self.step()?;
            // The first window is searched from its beginning.
            self.interval = self.interval.min(CENTRE);
            if self.filled < WINDOW {
                return Ok(None);
            }
        }
        let interval = self.interval;
        self.interval += 1;
        Ok(self.crosses(interval).then(|| self.locate(interval)))
    }

    fn push(&mut self) {
        let place = (self.oldest + self.filled) % WINDOW;
        if self.filled == WINDOW {
            self.oldest = (self.oldest + 1) % WINDOW;
        } else {
            self.filled += 1;
        }
        self.points[place].copy_from_slice(self.run.q());
        self.values[place] = (self.g)(self.run.q());
        self.steps[place] = self.run.step_size();
    }

    /// Fills the window, or moves it by one step.
    fn step(&mut self) -> Result<(), StepError> {
        if self.filled == 0 {
            self.push();
        }
        self.run.advance()?;
        self.push();
        Ok(())
    }

    fn crosses(&self, interval: usize) -> bool {
        let [a, b] = [interval, interval + 1].map(|i| self.values[(self.oldest + i) % WINDOW]);
        self.direction.crosses(a, b)
    }

    /// The times of the points since the oldest, in units of the newest step: whole numbers where all steps are alike.
    fn nodes(&self) -> [R::Scalar; WINDOW] {
        let per_h = R::Scalar::lift(1.0) / self.run.step_size();
        let mut time = R::Scalar::lift(0.0);
        core::array::from_fn(|j| {
            if j > 0 {
                time += self.steps[(self.oldest + j) % WINDOW] * per_h;
            }
            time
        })
    }

    /// Sets `probe` to the interpolant at `x`, a time in the units of the nodes.
    fn interpolate(&mut self, Interpolation { nodes, weights }: &Interpolation<R::Scalar>, x: R::Scalar) {
        let mut factors = [R::Scalar::lift(0.0); WINDOW];
        for (j, factor) in factors.iter_mut().enumerate() {
            let distance = x - nodes[j];
            if distance == R::Scalar::lift(0.0) {
                self.probe.copy_from_slice(&self.points[(self.oldest + j) % WINDOW]);
                return;
            }
            *factor = weights[j] / distance;
        }
        let total = factors.iter().fold(R::Scalar::lift(0.0), |sum, &w| sum + w);
        self.probe.fill(R::Scalar::lift(0.0));
        for (j, &factor) in factors.iter().enumerate() {
            let (factor, point) = (factor / total, &self.points[(self.oldest + j) % WINDOW]);
            for (sum, &q) in self.probe.iter_mut().zip(point.iter()) {
                *sum += factor * q;
            }
        }
    }

    /// Sets `velocity` to the time derivative of the interpolant at `x`.
    fn differentiate(&mut self, Interpolation { nodes, weights }: &Interpolation<R::Scalar>, x: R::Scalar) {
        // The product of the distances to all nodes but two.
        let without = |j: usize, m: usize| {
            let others = (0..WINDOW).filter(|&k| k != j && k != m);
            others.fold(R::Scalar::lift(1.0), |product, k| product * (x - nodes[k]))
        };
        let per_h = R::Scalar::lift(1.0) / self.run.step_size();
        self.velocity.fill(R::Scalar::lift(0.0));
        for (j, &weight) in weights.iter().enumerate() {
            let others = (0..WINDOW).filter(|&m| m != j);
            let slope = others.fold(R::Scalar::lift(0.0), |sum, m| sum + without(j, m));
            let (factor, point) = (per_h * weight * slope, &self.points[(self.oldest + j) % WINDOW]);
            for (sum, &q) in self.velocity.iter_mut().zip(point.iter()) {
                *sum += factor * q;
            }
        }
    }

    /// The crossing in `interval`, by regula falsi with the damping of Anderson & Björck (1973), and by
    /// bisection where that is slow.
    fn locate(&mut self, interval: usize) -> CrossingOf<R> {
        let interpolation = Interpolation::new(self.nodes());
        let nodes = &interpolation.nodes;
        let [mut a, mut b] = [nodes[interval], nodes[interval + 1]];
        let [mut g_a, mut g_b] = [interval, interval + 1].map(|i| self.values[(self.oldest + i) % WINDOW]);
        let resolution = interpolation.resolution();
        // b is always the newest point, and the last one at which the interpolant was taken.
        self.interpolate(&interpolation, b);
        for iteration in 0..100 {
            if g_b == R::Scalar::lift(0.0) || Scalar::abs(b - a) <= resolution {
                break;
            }
            let secant = b - g_b * (b - a) / (g_b - g_a);
            let c = if iteration % 8 == 7 { (a + b) / R::Scalar::lift(2.0) } else { secant };
            self.interpolate(&interpolation, c);
            let g_c = (self.g)(&self.probe);
            if (g_c > R::Scalar::lift(0.0)) != (g_b > R::Scalar::lift(0.0)) {
                (a, g_a) = (b, g_b);
            } else {
                let damping = R::Scalar::lift(1.0) - g_c / g_b;
                g_a *= if damping > R::Scalar::lift(0.0) { damping } else { R::Scalar::lift(0.5) };
            }
            if c == b {
                break;
            }
            (b, g_b) = (c, g_c);
        }
        if R::System::REGULAR {
            self.differentiate(&interpolation, b);
        }
        let system = self.run.system();
        let to_newest = nodes[WINDOW - 1] - b;
        Crossing {
            time: self.run.time() - to_newest * self.run.step_size(),
            state: State::read(|block| system.block_len(block), &self.probe, &self.velocity),
        }
    }
}

impl<R: Run, G: FnMut(&[R::Scalar]) -> R::Scalar> Iterator for Section<'_, R, G> {
    type Item = Result<CrossingOf<R>, StepError>;

    fn next(&mut self) -> Option<Self::Item> {
        while !self.failed {
            match self.advance() {
                Ok(Some(crossing)) => return Some(Ok(crossing)),
                Ok(None) => {}
                Err(error) => {
                    self.failed = true;
                    return Some(Err(error));
                }
            }
        }
        None
    }
}

/// The nodes of the window, and their barycentric weights 1/Πₖ(xⱼ − xₖ).
struct Interpolation<T> {
    nodes: [T; WINDOW],
    weights: [T; WINDOW],
}

impl<T: Real> Interpolation<T> {
    fn new(nodes: [T; WINDOW]) -> Self {
        let weight = |j: usize| {
            let others = (0..WINDOW).filter(|&k| k != j);
            T::lift(1.0) / others.fold(T::lift(1.0), |product, k| product * (nodes[j] - nodes[k]))
        };
        Self { nodes, weights: core::array::from_fn(weight) }
    }

    /// The rounding of a time in the window.
    fn resolution(&self) -> T {
        T::default_epsilon() * larger(self.nodes[WINDOW - 1], T::lift(WINDOW as f64))
    }
}
