//! Poincaré sections: the points at which a run crosses g(q) = 0.
//!
//! The points of a run lie on one smooth orbit, that of the method's modified equation. The polynomial
//! of degree seven through the eight points around a crossing follows it to O(h⁸), and the zero of g on
//! the polynomial is found to rounding: sections stay crisp at steps at which the orbit differs visibly
//! from the exact one. A parasitic mode, where there is one, is not smooth and is not followed.
//! Interpolation in barycentric form: Berrut & Trefethen 2004, eq. 4.2.

use crate::error::StepError;
use crate::{Carries, Integrator, Lagrangian, Method, Real, Scalar, Space, State, Vector};

const WINDOW: usize = 8;
/// The interval of the window in which crossings are looked for.
const CENTRE: usize = WINDOW / 2 - 1;
/// Barycentric weights of equidistant nodes: (−1)ʲ times binomial coefficients.
const WEIGHTS: [f64; WINDOW] = [1.0, -7.0, 21.0, -35.0, 35.0, -21.0, 7.0, -1.0];

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

/// A point of a section.
#[derive(Clone, Debug)]
pub struct Crossing<S, T> {
    /// When.
    pub time: T,
    /// Where, with named coordinates. The velocities of a regular system are those of the interpolant.
    pub state: S,
}

/// The crossings of a run with g(q) = 0, as an iterator that takes as many steps as it must.
///
/// It looks for sign changes between consecutive points, so a run that crosses twice within a step
/// passes unseen. The run is four steps ahead of the interval that is searched: crossings in the last
/// four steps before a failure are not reported.
pub struct Section<'r, 'a, S: Lagrangian, M: Carries<S, T>, T: Real, G> {
    run: &'r mut Integrator<'a, S, M, T>,
    g: G,
    direction: Direction,
    points: [Vector<S, T>; WINDOW],
    values: [T; WINDOW],
    /// The place of the oldest point.
    oldest: usize,
    filled: usize,
    /// The next interval to search; past the centre, a step is due.
    interval: usize,
    probe: Vector<S, T>,
    /// The velocity at `probe`, if the system is regular.
    velocity: Vector<S, T>,
    failed: bool,
}

impl<S, M, T, G> core::fmt::Debug for Section<'_, '_, S, M, T, G>
where
    S: Lagrangian,
    M: Method<S, T> + core::fmt::Debug,
    T: Real,
{
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { run, direction, values, .. } = self;
        f.debug_struct("Section")
            .field("run", run)
            .field("direction", direction)
            .field("values", values)
            .finish_non_exhaustive()
    }
}

impl<'r, 'a, S, M, T, G> Section<'r, 'a, S, M, T, G>
where
    S: Lagrangian,
    M: Method<S, T>,
    T: Real,
    G: FnMut(&[T]) -> T,
{
    /// The crossings of `run`, from its current state on, with g(q) = 0 in the given direction. All
    /// memory is allocated here.
    pub fn new(run: &'r mut Integrator<'a, S, M, T>, direction: Direction, g: G) -> Self {
        let space = run.system().space();
        Self {
            g,
            direction,
            points: core::array::from_fn(|_| space.vector()),
            values: [T::lift(0.0); WINDOW],
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
    pub fn run(&self) -> &Integrator<'a, S, M, T> {
        self.run
    }

    /// Takes one step at most and returns the crossing that it brought to light, if there is one. For
    /// runs that may never cross again, where the iterator would not end.
    ///
    /// # Errors
    /// [`StepError`] of the run.
    #[allow(clippy::type_complexity)]
    pub fn advance(&mut self) -> Result<Option<Crossing<S::State<T>, T>>, StepError> {
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
        self.points[place].copy_from_slice(self.run.vector());
        self.values[place] = (self.g)(self.run.q());
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
        let zero = T::lift(0.0);
        match self.direction {
            Direction::Rising => a < zero && b >= zero,
            Direction::Falling => a > zero && b <= zero,
            Direction::Either => (a < zero && b >= zero) || (a > zero && b <= zero),
        }
    }

    /// Sets `probe` to the interpolant at `x`, in steps from the oldest point.
    fn interpolate(&mut self, x: T) {
        let mut weights = [T::lift(0.0); WINDOW];
        for (j, weight) in weights.iter_mut().enumerate() {
            let distance = x - T::lift(j as f64);
            if distance == T::lift(0.0) {
                self.probe.copy_from_slice(&self.points[(self.oldest + j) % WINDOW]);
                return;
            }
            *weight = T::lift(WEIGHTS[j]) / distance;
        }
        let total = weights.iter().fold(T::lift(0.0), |sum, &w| sum + w);
        self.probe.fill(T::lift(0.0));
        for (j, &weight) in weights.iter().enumerate() {
            let (factor, point) = (weight / total, &self.points[(self.oldest + j) % WINDOW]);
            for (sum, &q) in self.probe.iter_mut().zip(point.iter()) {
                *sum += factor * q;
            }
        }
    }

    /// Sets `velocity` to the time derivative of the interpolant at `x`, in steps from the oldest point.
    fn differentiate(&mut self, x: T) {
        let node = |k: usize| x - T::lift(k as f64);
        // The product of the distances to all nodes but two.
        let without = |j: usize, m: usize| {
            let others = (0..WINDOW).filter(|&k| k != j && k != m);
            others.fold(T::lift(1.0), |product, k| product * node(k))
        };
        // The barycentric weights are those of the Lagrange polynomials times −7!.
        let scale = T::lift(-1.0 / 5040.0) / self.run.step_size();
        self.velocity.fill(T::lift(0.0));
        for (j, &weight) in WEIGHTS.iter().enumerate() {
            let others = (0..WINDOW).filter(|&m| m != j);
            let slope = others.fold(T::lift(0.0), |sum, m| sum + without(j, m));
            let (factor, point) = (scale * T::lift(weight) * slope, &self.points[(self.oldest + j) % WINDOW]);
            for (sum, &q) in self.velocity.iter_mut().zip(point.iter()) {
                *sum += factor * q;
            }
        }
    }

    /// The crossing in `interval`, by regula falsi with the damping of Anderson & Björck (1973), and by
    /// bisection where that is slow.
    fn locate(&mut self, interval: usize) -> Crossing<S::State<T>, T> {
        let [mut a, mut b] = [interval, interval + 1].map(|i| T::lift(i as f64));
        let [mut g_a, mut g_b] = [interval, interval + 1].map(|i| self.values[(self.oldest + i) % WINDOW]);
        let resolution = T::default_epsilon() * T::lift(WINDOW as f64);
        // b is always the newest point, and the last one at which the interpolant was taken.
        self.interpolate(b);
        for iteration in 0..100 {
            if g_b == T::lift(0.0) || Scalar::abs(b - a) <= resolution {
                break;
            }
            let secant = b - g_b * (b - a) / (g_b - g_a);
            let c = if iteration % 8 == 7 { (a + b) / T::lift(2.0) } else { secant };
            self.interpolate(c);
            let g_c = (self.g)(&self.probe);
            if (g_c > T::lift(0.0)) != (g_b > T::lift(0.0)) {
                (a, g_a) = (b, g_b);
            } else {
                let damping = T::lift(1.0) - g_c / g_b;
                g_a *= if damping > T::lift(0.0) { damping } else { T::lift(0.5) };
            }
            if c == b {
                break;
            }
            (b, g_b) = (c, g_c);
        }
        if S::REGULAR {
            self.differentiate(b);
        }
        let system = self.run.system();
        let to_newest = T::lift((WINDOW - 1) as f64) - b;
        Crossing {
            time: self.run.time() - to_newest * self.run.step_size(),
            state: S::State::read(|block| system.block_len(block), &self.probe, &self.velocity),
        }
    }
}

impl<S, M, T, G> Iterator for Section<'_, '_, S, M, T, G>
where
    S: Lagrangian,
    M: Method<S, T>,
    T: Real,
    G: FnMut(&[T]) -> T,
{
    type Item = Result<Crossing<S::State<T>, T>, StepError>;

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
