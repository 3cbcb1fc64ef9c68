//! Runs with steps that keep the discrete energy, beside runs with steps of one length, and where that ends:
//! with the trapezoidal rule on a spring that stiffens a run comes to a state from which no step has the
//! discrete energy.

use super::energy_momentum::{ON_SPRING, START};
use crate::vocabulary::*;

/// The time up to which runs are compared with the motion, and that up to which each step is drawn.
pub const COMPARED: f64 = 50.0;
pub const BEGINNING: f64 = 15.0;

/// A system with its start, V as a function of r², and where the particle is at a time.
pub struct Motion<'a, S: RegularLagrangian<f64>> {
    pub system: &'a S,
    pub start: S::State<f64>,
    pub potential: fn(f64) -> f64,
    pub position: &'a dyn Fn(f64) -> [f64; 2],
}

pub struct Steps {
    /// Over the number of the step: E_d − e, E − E(0), l − l(0), and the length of the step.
    pub kept: [Envelope; 4],
    /// The mean length of the steps, and that of their last tenth over that of the first.
    pub length: f64,
    pub lengthening: f64,
    /// The evaluations of first and second derivatives in a step.
    pub work: f64,
    /// The largest distance from the motion at times up to [`COMPARED`].
    pub distance: f64,
    /// The time at the end of a step of the beginning, its length, and E − E(0) there.
    pub beginning: Vec<[f64; 3]>,
}

/// Runs with steps that keep the discrete energy, with as many of one length, the mean of those, and with
/// steps of one length and at most as many evaluations of derivatives in the same time.
pub struct Runs {
    pub name: &'static str,
    pub kept: [Steps; 4],
    pub mean: [Steps; 4],
    pub work: [Steps; 4],
}

impl<S: RegularLagrangian<f64>> Motion<'_, S> {
    pub fn runs(&self, job: &Job<'_>, name: &'static str, first: [f64; 4], steps: u64) -> Result<Runs> {
        let rule = Variational::midpoint();
        let begin = || self.start.clone();
        let plain = |h: f64, steps| self.steps(job, Integrator::new(self.system, rule, h, begin())?, steps);
        let kept = each(first, |h| {
            let run = Integrator::controlled(self.system, rule, EnergyMomentum::new(h), begin())?;
            self.steps(job, run, steps)
        })?;
        let mean = each(kept.each_ref(), |kept| plain(kept.length, steps))?;
        let work = each([0, 1, 2, 3], |i| {
            let h = mean[i].length * mean[i].work / kept[i].work;
            plain(h, (COMPARED / h).ceil() as u64)
        })?;
        Ok(Runs { name, kept, mean, work })
    }

    fn steps(&self, job: &Job<'_>, mut run: impl Run<Scalar = f64>, wanted: u64) -> Result<Steps> {
        let span = Span { end: wanted as f64, early: wanted as f64 / 10.0, intervals: 100 };
        let (mut kept, mut tenths, mut farthest) = (span.envelopes(), [0.0; 2], 0.0);
        let (mut end, mut beginning, tenth) = (0.0, Vec::new(), wanted / 10);
        let (energy, [momentum]) = (run.energy(), momenta(&run));
        let (mut before, mut first) = (place(&run), None);
        job.follow(&mut run, wanted, |run| {
            let (step, h, t, after) = (run.steps(), run.step_size(), run.time(), place(run));
            // The discrete energy of a step of the midpoint rule.
            let velocity = [0, 1].map(|i: usize| (after[i] - before[i]) / h);
            let middle = [0, 1].map(|i: usize| 0.5 * (before[i] + after[i]));
            let discrete = 0.5 * dot(velocity, velocity) + (self.potential)(dot(middle, middle));
            let defect = discrete - *first.get_or_insert(discrete);
            let (change, [now]) = (run.energy() - energy, momenta(run));
            note(&mut kept, step as f64, [defect, change, now - momentum, h]);
            tenths[0] += if step <= tenth { h } else { 0.0 };
            tenths[1] += if step > wanted - tenth { h } else { 0.0 };
            if t < BEGINNING {
                beginning.push([t, t - end, change]);
            }
            if t <= COMPARED {
                farthest = larger(farthest, distance(after, (self.position)(t)));
            }
            (before, end) = (after, t);
        })?;
        let (steps, statistics) = (run.steps() as f64, run.statistics());
        let work = (statistics.gradients + statistics.linearizations).max(1) as f64 / steps;
        Ok(Steps {
            kept,
            length: end / steps,
            lengthening: tenths[1] / tenths[0],
            work,
            distance: farthest,
            beginning,
        })
    }
}

pub fn order_in_length(runs: &[Steps; 4], value: impl Fn(&Steps) -> f64) -> Option<f64> {
    order(runs.iter().map(|steps| (steps.length, value(steps))))
}

/// Lengths are tried up to so many times that of the step before, which is as far as the control seeks.
const REACH: f64 = 4.0;
const SHOWN: f64 = 0.25;

pub struct NoStep {
    steps: u64,
    /// E_d − e over the length of the last step, and of the one that the run cannot take.
    curves: [Vec<[f64; 2]>; 2],
    /// The length of the last step, with its defect by hand.
    last: [f64; 2],
    /// The best length that the control has found, with its defect, and that by hand.
    best: [f64; 3],
}

impl NoStep {
    pub fn new() -> Result<Self> {
        let (rule, control) = (Variational::trapezoid(), EnergyMomentum::new(ON_SPRING[0]));
        let mut run = Integrator::controlled(&StiffeningSpring {}, rule, control, START)?;
        let mut before = None;
        let ended = (0..1000).try_for_each(|_| {
            let sought = (run.state(), run.step_size());
            run.advance()?;
            before = Some(sought);
            Ok::<(), StepError>(())
        });
        let failure = ended.err().context("the run with the trapezoidal rule has not ended")?.failure;
        let StepFailure::EnergyStep { h, defect } = failure else { bail!(failure) };
        let energy = run.control_memory().discrete_energy().context("no step was taken")?;
        let (last, before) = before.context("no step was taken")?;
        let (failed, length) = (run.state(), run.step_size());
        let curves = [(last, before), (failed, length)].map(|(state, before)| {
            let lengths = (1..=4000).map(|k| REACH * before * f64::from(k) / 4000.0);
            lengths.map(|h| [h, energy_of_step(state, h) - energy]).collect()
        });
        Ok(Self {
            steps: run.steps(),
            curves,
            last: [length, energy_of_step(last, length) - energy],
            best: [h, defect, energy_of_step(failed, h) - energy],
        })
    }

    pub fn claim(&self) -> Claim {
        let ([_, failed], [_, found, by_hand]) = (&self.curves, self.best);
        let smallest = least(failed.iter().map(|[_, defect]| *defect));
        let of_lengths = format!("smallest E_d − e of lengths up to {REACH} times the last, by hand");
        let difference = "that of the best length that the control has found, less that by hand";
        let text = "with the trapezoidal rule on the spring the scheme ends, because no length within reach \
                    of the last has the discrete energy e";
        beyond(text)
            .near("steps that it takes", self.steps as f64, [3.0, 0.0])
            .at_most("|E_d − e| of the last of them, by hand", self.last[1].abs(), 5e-14)
            .near(of_lengths, smallest, [2.758e-3, 1e-6])
            .near(difference, found - by_hand, [0.0, 1e-13])
    }

    pub fn panel(&self) -> Panel {
        let ([length, _], [h, defect, _]) = (self.last, self.best);
        let [last, failed] = self.curves.each_ref().map(|curve| {
            curve.iter().filter(|[h, _]| *h <= SHOWN).map(|[h, defect]| [*h, 1e3 * defect]).collect()
        });
        let defects = ("10³ (*E*_d(*h*) − *e*)", [-10.0, 16.0]);
        Panel::linear("The equation for *h*, trapezoidal rule", ("*h*", [0.0, SHOWN]), defects)
            .line(vec![[0.0, 0.0], [SHOWN, 0.0]], solid(SLATE).width(1.0))
            .lines([("at the last step", dashed(BLUE), last)])
            .discs(vec![[length, 0.0]], BLUE)
            .labelled(format!("its length, {length:.3}"))
            .lines([("where the run ends", solid(VERMILLION), failed)])
            .rings(vec![[h, 1e3 * defect]], VERMILLION)
            .labelled(format!("nearest to zero, {}", scientific(defect)))
            .legend_at(Corner::TopLeft)
    }

    pub fn curves(&self) -> impl Iterator<Item = ([String; 3], Vec<[f64; 2]>)> {
        ["trapezoid, last step", "trapezoid, no step"].into_iter().zip(&self.curves).map(|(name, curve)| {
            let names = [name, "discrete_energy_defect", "h"].map(str::to_owned);
            (names, curve.iter().copied().step_by(20).collect())
        })
    }
}

/// E_d of a step of length `h`: q1 = q + h(p − ½h∇V(q)), and E_d = ½|Δ/h|² + ½(V(q) + V(q1)).
fn energy_of_step(StiffeningSpringState { x, y, dot_x, dot_y }: StiffeningSpringState, h: f64) -> f64 {
    let (q, p) = ([x, y], [dot_x, dot_y]);
    let slope = 1.0 + dot(q, q);
    let velocity = moved(p, -0.5 * h * slope, q);
    let q1 = moved(q, h, velocity);
    let potential = |q: [f64; 2]| 0.5 * dot(q, q) + 0.25 * dot(q, q).powi(2);
    0.5 * dot(velocity, velocity) + 0.5 * (potential(q) + potential(q1))
}
