//! Poincaré sections: the points at which a run crosses g(q) = 0.
//!
//! Between two points of a run its state is that of the step between them, taken again in part. On this
//! curve, which leads from point to point, the zero of g is found to rounding. So a crossing has the error
//! of the run and that of one step of its method more, whatever the length of its steps.
//!
//! A step that begins and ends on one side may cross twice. Whether it does is looked at in its middle and,
//! as long as the parabola through three values of g comes close to zero, at its vertex. A value on the
//! other side counts if it is larger than what two steps over that place miss the end of the step by.

use crate::error::{StartError, StepError, StepFailure};
use crate::run::{PartialStep, PartialStepOf, Run};
use crate::scalar::norm::larger;
use crate::system::Smooth;
use crate::system::start::step_error;
use crate::{Real, Scalar, System};

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
    pub fn crosses<T: Real>(self, a: T, b: T) -> bool {
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
    /// The state at the crossing, with named coordinates and, of a regular system, velocities.
    pub state: S,
}

/// A [`Crossing`] of a run `R`.
type CrossingOf<R> = Crossing<<<R as Run>::System as System>::State<<R as Run>::Scalar>, <R as Run>::Scalar>;

/// The crossings of a run with g(q) = 0, as an iterator that takes as many steps as it must.
///
/// A crossing lies on the step that leads over it, taken again from its beginning as a shorter one, by the
/// method of the run: it is as accurate as the points of the run are, with the error of one step more, and g
/// vanishes there to rounding. A method of order p has this error at the order h<sup>p+1</sup>. The points
/// of the run are the same, bit for bit, as without a section. A crossing costs some eight steps. A run that
/// begins on the section does not cross it there.
///
/// A step that begins and ends on one side of the section and crosses it twice in between is seen if g turns
/// once on the way, so far that a parabola through three of its values tells, and by more than the error of
/// the step. That is looked for in steps that are near enough to the section, as the changes of g in the
/// steps before say. What crosses more often within one step, or touches the section, may pass unseen.
pub struct Section<'r, R: Run, G> {
    run: &'r mut R,
    g: G,
    direction: Direction,
    step: PartialStepOf<R>,
    /// Values of g in the step at hand: where it begins, perhaps in between, and where it ends.
    marks: [Mark<R::Scalar>; 3],
    /// The next interval between two marks to search; past the last, a step is due.
    interval: usize,
    /// How fast g has changed in the last steps, once there is one.
    rate: Option<R::Scalar>,
    failed: bool,
}

/// g at a time of a step, in parts of the step.
#[derive(Clone, Copy, Debug)]
struct Mark<T> {
    part: T,
    g: T,
}

/// There are so many intervals between marks.
const INTERVALS: usize = 2;
/// Of the rate at which g changes, what is kept from step to step.
const FORGETTING: f64 = 0.9;
/// The largest rate within a step, in units of the mean rates of the last steps.
const MARGIN: f64 = 2.0;
/// Where g is looked at in a step that may cross twice, at most.
const LOOKS: usize = 6;

impl<R: Run + core::fmt::Debug, G> core::fmt::Debug for Section<'_, R, G> {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { run, direction, marks, .. } = self;
        f.debug_struct("Section")
            .field("run", run)
            .field("direction", direction)
            .field("marks", marks)
            .finish_non_exhaustive()
    }
}

impl<'r, R: Run, G: FnMut(&[R::Scalar]) -> R::Scalar> Section<'r, R, G> {
    /// The crossings of `run`, from its current state on, with g(q) = 0 in the given direction. All
    /// memory is allocated here.
    ///
    /// # Errors
    /// [`StartError`] if no run of this method can begin at the current state.
    pub fn new(run: &'r mut R, direction: Direction, mut g: G) -> Result<Self, StartError>
    where
        <R::System as System>::Kind: Smooth,
    {
        let step = PartialStep::new(run)?;
        let mark = Mark { part: R::Scalar::lift(1.0), g: g(run.q()) };
        Ok(Self {
            g,
            direction,
            step,
            marks: [mark; 3],
            interval: INTERVALS,
            rate: None,
            failed: false,
            run,
        })
    }

    /// The run, at the end of the step that is searched.
    pub fn run(&self) -> &R {
        self.run
    }

    /// Takes one step at most and returns the crossing that it brought to light, if there is one. For
    /// runs that may never cross again, where the iterator would not end.
    ///
    /// # Errors
    /// [`StepError`] of the run, or of a part of its last step.
    pub fn advance(&mut self) -> Result<Option<CrossingOf<R>>, StepError> {
        if self.interval == INTERVALS {
            self.step()?;
        }
        while self.interval < INTERVALS {
            let [a, b] = [self.interval, self.interval + 1].map(|i| self.marks[i]);
            self.interval += 1;
            if self.direction.crosses(a.g, b.g) {
                return self.locate(a, b).map(Some).map_err(|failure| self.error(failure));
            }
        }
        Ok(None)
    }

    /// Takes a step, and marks it.
    fn step(&mut self) -> Result<(), StepError> {
        let [zero, one] = [0.0, 1.0].map(R::Scalar::lift);
        self.step.begin(self.run);
        self.run.advance()?;
        let begin = Mark { part: zero, g: self.marks[INTERVALS].g };
        let end = Mark { part: one, g: (self.g)(self.run.q()) };
        self.marks = [begin, end, end];
        self.interval = 0;
        if let Some(turn) = self.turn(begin, end).map_err(|failure| self.error(failure))? {
            self.marks[1] = turn;
        }
        Ok(())
    }

    #[cold]
    fn error(&self, failure: StepFailure) -> StepError {
        step_error(self.run.system(), self.run.steps() - 1, self.step.begun(), failure)
    }

    /// g at a part of the step.
    fn look(&mut self, part: R::Scalar) -> Result<Mark<R::Scalar>, StepFailure> {
        self.step.reach(self.run, part)?;
        Ok(Mark { part, g: (self.g)(self.step.q()) })
    }

    /// Where g has the other sign than at both ends of the step, if such a time is found.
    fn turn(
        &mut self,
        mut a: Mark<R::Scalar>,
        mut b: Mark<R::Scalar>,
    ) -> Result<Option<Mark<R::Scalar>>, StepFailure> {
        let [zero, half, two] = [0.0, 0.5, 2.0].map(R::Scalar::lift);
        let h = Scalar::abs(self.run.step_size());
        let mean = Scalar::abs(b.g - a.g) / h;
        let rate = self.rate.map(|before| larger(mean, R::Scalar::lift(FORGETTING) * before));
        self.rate = rate.or(Some(mean));
        let (side, end) = (a.g > zero, b.g);
        let distance = Scalar::abs(a.g) + Scalar::abs(b.g);
        let is_far = rate.is_some_and(|rate| distance > R::Scalar::lift(MARGIN) * rate * h);
        if a.g == zero || b.g == zero || side != (b.g > zero) || is_far {
            return Ok(None);
        }
        let mut part = half;
        let mut between: Option<Mark<R::Scalar>> = None;
        for _ in 0..LOOKS {
            let mark = self.look(part)?;
            if mark.g != zero && (mark.g > zero) != side {
                // What is not more than the error of the step is no crossing of the motion.
                self.step.go_on(self.run, part)?;
                let error = Scalar::abs((self.g)(self.step.q()) - end);
                return Ok((error < Scalar::abs(mark.g)).then_some(mark));
            }
            // The lowest of all stays between two others.
            let lowest = match between {
                None => mark,
                Some(known) => {
                    let is_lower = Scalar::abs(mark.g) < Scalar::abs(known.g);
                    let [lowest, other] = if is_lower { [mark, known] } else { [known, mark] };
                    let side = if other.part < lowest.part { &mut a } else { &mut b };
                    *side = other;
                    lowest
                }
            };
            between = Some(lowest);
            let [left, right] = [lowest.part - a.part, b.part - lowest.part];
            let [falls, rises] = [(lowest.g - a.g) / left, (b.g - lowest.g) / right];
            let steepest = larger(Scalar::abs(falls), Scalar::abs(rises)) / h;
            self.rate = self.rate.map(|rate| larger(rate, steepest));
            let curvature = (rises - falls) / (left + right);
            let slope = (falls * right + rises * left) / (left + right);
            part = lowest.part - slope / (two * curvature);
            let vertex = lowest.g - slope * slope / (two * two * curvature);
            let is_promising = part > a.part
                && part < b.part
                && part != lowest.part
                && ((vertex > zero) != side || Scalar::abs(vertex) < half * Scalar::abs(lowest.g));
            if !is_promising {
                return Ok(None);
            }
        }
        Ok(None)
    }

    /// The crossing between `a` and `b`, by regula falsi with the damping of Anderson & Björck (1973), and
    /// by bisection where that is slow.
    fn locate(
        &mut self,
        mut a: Mark<R::Scalar>,
        mut b: Mark<R::Scalar>,
    ) -> Result<CrossingOf<R>, StepFailure> {
        let [zero, half, one] = [0.0, 0.5, 1.0].map(R::Scalar::lift);
        let resolution = PartialStepOf::<R>::resolution();
        // b is always the newest, and the last one that was reached.
        self.look(b.part)?;
        for iteration in 0..100 {
            if b.g == zero || Scalar::abs(b.part - a.part) <= resolution {
                break;
            }
            let secant = b.part - b.g * (b.part - a.part) / (b.g - a.g);
            let c = self.look(if iteration % 8 == 7 { (a.part + b.part) * half } else { secant })?;
            if (c.g > zero) != (b.g > zero) {
                a = b;
            } else {
                let damping = one - c.g / b.g;
                a.g *= if damping > zero { damping } else { half };
            }
            if c.part == b.part {
                break;
            }
            b = c;
        }
        let (time, state) = self.step.state(self.run)?;
        Ok(Crossing { time, state })
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
