//! The symplectic-energy-momentum scheme: steps of such a length that the discrete energy stays the same.
//!
//! The scheme of Kane, Marsden & Ortiz 1999 with the variational midpoint rule, on a spring that stiffens
//! and on a Kepler orbit, beside the same rule with steps of one length: discrete energy, energy, angular
//! momentum, lengths of the steps and distance from the motion. With the trapezoidal rule the scheme ends
//! where its equation has no solution.

use anyhow::bail;

use crate::models::{Kepler, Orbit, StiffeningSpring, StiffeningSpringState};
use crate::vocabulary::*;

const START: StiffeningSpringState = StiffeningSpringState { x: 1.0, y: 0.3, dot_x: 0.0, dot_y: 0.5 };
const ORBIT: Orbit = Orbit { e: 0.5 };
/// The lengths of the first steps, the longest first.
const ON_SPRING: [f64; 4] = [0.1, 0.05, 0.025, 0.0125];
const ON_ORBIT: [f64; 4] = [0.02, 0.01, 0.005, 0.0025];
/// The time up to which runs are compared with the motion.
const COMPARED: f64 = 50.0;
/// The time between two points of the reference.
const FINE: f64 = 0.02;
/// The time up to which each step is drawn, and the lengths up to which the step equation is.
const BEGINNING: f64 = 15.0;
const SHOWN: f64 = 0.25;
/// The most steps with the trapezoidal rule, the lengths that are tried there, up to so many times that of
/// the step before, which is as far as the control seeks, and how many.
const MOST: u64 = 1000;
const REACH: f64 = 4.0;
const POINTS: u32 = 4000;

/// A system with a start and with what is known of it.
struct Motion<'a, S: RegularLagrangian<f64>> {
    system: &'a S,
    start: fn() -> S::State<f64>,
    /// V as a function of r².
    potential: fn(f64) -> f64,
    /// Where the particle is at a time.
    position: &'a dyn Fn(f64) -> [f64; 2],
}

/// What one run leaves.
struct Steps {
    steps: u64,
    /// The time that they have taken.
    end: f64,
    /// Over the number of the step: E_d − e, E − E(0), l − l(0), and the length of the step.
    kept: [Deviation; 4],
    /// The times that the first and the last tenth of the steps take.
    tenths: [f64; 2],
    /// The largest distance from the motion at times up to [`COMPARED`].
    distance: f64,
    /// Evaluations of first and second derivatives.
    work: u64,
    /// The time at the end of a step of the beginning, its length, and E − E(0) there.
    beginning: Vec<[f64; 3]>,
}

/// The runs that belong to one length of the first step: with steps that keep the discrete energy, with as
/// many steps of one length, the mean of those, and with steps of one length and at most as many evaluations
/// of derivatives in the same time as with those of the first kind.
struct Runs {
    kept: Steps,
    mean: Steps,
    work: Steps,
}

/// The runs by the length of the first step, on the spring and on the orbit.
type All = [(&'static str, [Runs; 4]); 2];

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(100_000, 10_000);
    job.expect(2 * steps * (ON_SPRING.len() + ON_ORBIT.len()) as u64);
    let [fine, double] = each([FINE, 2.0 * FINE], reference)?;
    let spring = Motion {
        system: &StiffeningSpring {},
        start: || START,
        potential: |r2| r2 / 2.0 + r2 * r2 / 4.0,
        position: &|t| position(&fine, t),
    };
    let kepler = Motion {
        system: &Kepler {},
        start: || ORBIT.pericentre(),
        potential: |r2| -1.0 / r2.sqrt(),
        position: &|t| ORBIT.position(t),
    };
    let all = [
        ("spring", each(ON_SPRING, |h| Runs::new(job, &spring, h, steps))?),
        ("Kepler", each(ON_ORBIT, |h| Runs::new(job, &kepler, h, steps))?),
    ];
    let pairs = fine.iter().step_by(2).zip(&double);
    let between = largest(pairs.map(|(a, b)| (a.x - b.x).hypot(a.y - b.y)));
    let ending = Ending::new()?;
    job.publish(figure(&all, &ending), table(&all, &ending)?)?;
    Ok(vec![
        discrete_energy(&all),
        momentum(&all),
        energy(&all),
        lengths(&all),
        accuracy(&all, between),
        ending.claim(),
    ]
    .into())
}

/// Points of the motion of the spring at multiples of a time.
fn reference(every: f64) -> Result<Vec<StiffeningSpringState>> {
    let mut run = Integrator::new(&StiffeningSpring {}, Gauss::<4>::new(), every, START)?;
    Ok(course(&mut run, (COMPARED / every).round() as u64, |run| run.state())?)
}

/// By one step from the last point before; not a number beyond the end.
fn position(states: &[StiffeningSpringState], t: f64) -> [f64; 2] {
    let index = (t / FINE).floor();
    let Some(&state) = states.get(index as usize) else { return [f64::NAN; 2] };
    let system = StiffeningSpring {};
    // A rest below zero is one of rounding.
    let rest = (t - index * FINE).max(1e-12);
    let Ok(mut run) = Integrator::new(&system, Gauss::<4>::new(), rest, state) else { return [f64::NAN; 2] };
    run.advance().map_or([f64::NAN; 2], |()| place(&run))
}

impl Runs {
    fn new<S: RegularLagrangian<f64>>(
        job: &Job<'_>,
        motion: &Motion<'_, S>,
        h: f64,
        steps: u64,
    ) -> Result<Self> {
        let (system, rule, start) = (motion.system, Variational::midpoint(), motion.start);
        let run = ControlledIntegrator::new(system, rule, EnergyMomentum::new(h), start())?;
        let kept = Steps::new(job, motion, run, steps)?;
        // A run that was interrupted at its beginning has no mean length.
        let usable = |length: f64| if length > 0.0 && length.is_finite() { length } else { h };
        let h = usable(kept.mean_length());
        let mean = Steps::new(job, motion, Integrator::new(system, rule, h, start())?, steps)?;
        let usable = |length: f64| if length > 0.0 && length.is_finite() { length } else { h };
        let h = usable(h * mean.work_of_a_step() / kept.work_of_a_step());
        let steps = (COMPARED / h).ceil() as u64;
        job.expect(steps);
        let work = Steps::new(job, motion, Integrator::new(system, rule, h, start())?, steps)?;
        Ok(Self { kept, mean, work })
    }
}

fn square([x, y]: [f64; 2]) -> f64 {
    x * x + y * y
}

impl Steps {
    fn new<S: RegularLagrangian<f64>>(
        job: &Job<'_>,
        motion: &Motion<'_, S>,
        mut run: impl Run<Scalar = f64>,
        wanted: u64,
    ) -> Result<Self> {
        let span = Span { end: wanted as f64, early: wanted as f64 / 10.0, intervals: 100 };
        let (mut kept, mut tenths, mut farthest) = (span.deviations(), [0.0; 2], 0.0);
        let (mut end, mut beginning, tenth) = (0.0, Vec::new(), wanted / 10);
        let [energy, momentum] = [run.energy(), run.momentum(0).unwrap_or(f64::NAN)];
        let (mut before, mut first) = (place(&run), None);
        job.follow(&mut run, wanted, |run| {
            let (step, h, t, after) = (run.steps(), run.step_size(), run.time(), place(run));
            // The discrete energy of a step of the midpoint rule.
            let velocity: [f64; 2] = std::array::from_fn(|i| (after[i] - before[i]) / h);
            let middle: [f64; 2] = std::array::from_fn(|i| 0.5 * (before[i] + after[i]));
            let discrete = 0.5 * square(velocity) + (motion.potential)(square(middle));
            let defect = discrete - *first.get_or_insert(discrete);
            let change = run.energy() - energy;
            note(
                &mut kept,
                step as f64,
                [defect, change, run.momentum(0).unwrap_or(f64::NAN) - momentum, h],
            );
            if step <= tenth {
                tenths[0] += h;
            }
            if step > wanted - tenth {
                tenths[1] += h;
            }
            if t < BEGINNING {
                beginning.push([t, t - end, change]);
            }
            if t <= COMPARED {
                farthest = larger(farthest, distance(after, (motion.position)(t)));
            }
            (before, end) = (after, t);
        })?;
        let (steps, statistics) = (run.steps(), run.statistics());
        let work = statistics.gradients + statistics.linearizations;
        Ok(Self { steps, end, kept, tenths, distance: farthest, work, beginning })
    }

    fn mean_length(&self) -> f64 {
        self.end / self.steps as f64
    }

    fn work_of_a_step(&self) -> f64 {
        self.work as f64 / self.steps as f64
    }

    fn discrete(&self) -> &Deviation {
        &self.kept[0]
    }

    fn energy(&self) -> &Deviation {
        &self.kept[1]
    }
}

/// The largest over the four lengths of the first step.
fn most(runs: &[Runs; 4], value: impl Fn(&Runs) -> f64) -> f64 {
    largest(runs.iter().map(value))
}

/// The order in the mean length of the steps.
fn order_in_length(runs: &[Runs; 4], of: fn(&Runs) -> &Steps, value: fn(&Steps) -> f64) -> Option<f64> {
    order(runs.iter().map(of).map(|steps| (steps.mean_length(), value(steps))))
}

fn discrete_energy(all: &All) -> Claim {
    let text = "the steps keep the discrete energy to rounding, and steps of one length up to terms of the \
                second order";
    let bounds = [(1.5e-14, [3.141e-3, 5e-6]), (5e-14, [1.053e-2, 2e-5])];
    beyond(text).each(all.iter().zip(bounds), |claim, ((name, runs), (kept, varies))| {
        let width = |steps: &Steps| steps.discrete().width();
        let growth = most(runs, |runs| runs.kept.discrete().growth());
        let of_all = most(runs, |runs| runs.kept.discrete().largest);
        let order = order_in_length(runs, |runs| &runs.mean, width);
        claim
            .of(name)
            .at_most("largest |E_d − e| of all runs", of_all, kept)
            .at_most("the same over all steps / over the first tenth", growth, 2.0)
            .of(format!("{name}, steps of one length"))
            .near("largest difference of two E_d", width(&runs[0].mean), varies)
            .near("order of that in h", order, [2.0, 0.02])
    })
}

fn momentum(all: &All) -> Claim {
    beyond("both keep the angular momentum to rounding").each(all, |claim, (name, runs)| {
        let largest = |of: fn(&Runs) -> &Steps| most(runs, |runs| of(runs).kept[2].largest);
        let claim =
            claim.of(name).at_most("largest |l − l(0)| of all runs", largest(|runs| &runs.kept), 2e-13);
        claim.of(format!("{name}, steps of one length")).at_most(
            "the same",
            largest(|runs| &runs.mean),
            2e-13,
        )
    })
}

fn energy(all: &All) -> Claim {
    let text = "the energy at the points of the run varies by terms of the second order, on the spring a \
                little more than with steps of one length, on the orbit a third as much";
    beyond(text).each(all.iter().zip([[1.04, 1.07], [0.3, 0.32]]), |claim, ((name, runs), range)| {
        let width = |steps: &Steps| steps.energy().width();
        let kept = order_in_length(runs, |runs| &runs.kept, width);
        let mean = order_in_length(runs, |runs| &runs.mean, width);
        let ratio = width(&runs[0].kept) / width(&runs[0].mean);
        let claim = claim.of(name).near("order of the largest difference of two E in h", kept, [2.0, 0.02]);
        let claim =
            claim.of(format!("{name}, steps of one length")).near("the same", mean, [2.0, 0.02]).of(name);
        claim.within("largest difference of two E / that with steps of one length", ratio, range)
    })
}

fn lengths(all: &All) -> Claim {
    let known = [(ON_SPRING[0], 1.34, 5e-4), (ON_ORBIT[0], 5.09, 2e-3)];
    let text = "the lengths of the steps stay within limits and do not drift";
    beyond(text).each(all.iter().zip(known), |claim, ((name, runs), (first, most, drift))| {
        let ([low, high], tenths) = (runs[0].kept.kept[3].range(), runs[0].kept.tenths);
        let lengthens = tenths[1] / tenths[0] - 1.0;
        claim
            .of(name)
            .within("smallest length / that of the first step", low / first, [0.999, 1.0])
            .near("largest length / that of the first step", high / first, [most, 0.01])
            .near("mean length of the last tenth of the steps / of the first − 1", lengthens, [0.0, drift])
    })
}

fn accuracy(all: &All, between_references: f64) -> Claim {
    let text = "up to t = 50 the run is closer to the motion than one with as many steps of one length, \
                and farther than one of the same work";
    let references = "spring: largest distance of the reference from one with steps twice as long";
    let bounds = [([0.94, 0.96], 20.0), ([0.3, 0.5], 5.0)];
    let claim = beyond(text).at_most(references, between_references, 1e-12);
    claim.each(all.iter().zip(bounds), |claim, ((name, runs), (closer, farther))| {
        let Runs { kept, mean, work } = &runs[0];
        let rate = |steps: &Steps| steps.work_of_a_step() / steps.mean_length();
        let [ratio, .., shortest] = runs.each_ref().map(|runs| runs.kept.distance / runs.work.distance);
        let order = order_in_length(runs, |runs| &runs.kept, |steps| steps.distance);
        let closeness = kept.distance / mean.distance;
        let in_a_step = kept.work_of_a_step() / mean.work_of_a_step();
        claim
            .of(name)
            .near("order of the largest distance in h", order, [2.0, 0.03])
            .within("largest distance / that with as many steps of one length", closeness, closer)
            .at_least("evaluations of derivatives in a step / in one of steps of one length", in_a_step, 4.0)
            .at_most(
                "evaluations in a time, the run of the same work / this one",
                rate(work) / rate(kept),
                1.0,
            )
            .at_least("largest distance / that with the same work", ratio, farther)
            .at_least("the same with the shortest first step", shortest, farther)
    })
}

/// A state at which a length is sought, and E_d − e over the lengths.
struct Sought {
    state: StiffeningSpringState,
    energy: f64,
    curve: Vec<[f64; 2]>,
}

/// The last step of the run with the trapezoidal rule, and the one that it cannot take.
struct Ending {
    steps: u64,
    time: f64,
    last: Sought,
    failed: Sought,
    /// The length of the last step.
    length: f64,
    /// The length that the control has found to be the best, with its defect.
    best: [f64; 2],
}

impl Ending {
    fn new() -> Result<Self> {
        let (rule, control) = (Variational::trapezoid(), EnergyMomentum::new(ON_SPRING[0]));
        let mut run = ControlledIntegrator::new(&StiffeningSpring {}, rule, control, START)?;
        let mut before = None;
        let ended = (0..MOST).try_for_each(|_| {
            let sought = (run.state(), run.step_size());
            run.advance()?;
            before = Some(sought);
            Ok::<(), StepError>(())
        });
        let failure = ended.err().context("the run with the trapezoidal rule has not ended")?.failure;
        let StepFailure::EnergyStep { h, defect } = failure else { bail!(failure) };
        let energy = run.control_memory().discrete_energy().context("no step was taken")?;
        let (state, length) = before.context("no step was taken")?;
        let (last, failed) =
            (Sought::new(state, energy, length), Sought::new(run.state(), energy, run.step_size()));
        let (steps, time, length) = (run.steps(), run.time(), run.step_size());
        Ok(Self { steps, time, last, failed, length, best: [h, defect] })
    }

    fn claim(&self) -> Claim {
        let Self { steps, last, failed, length, best: [h, defect], .. } = self;
        let smallest =
            failed.curve.iter().map(|[_, defect]| *defect).fold(f64::INFINITY, |a, b| -larger(-a, -b));
        let difference = defect - failed.defect(*h);
        let of_lengths = format!("smallest E_d − e of lengths up to {REACH} times the last, by hand");
        beyond(
            "with the trapezoidal rule on the spring the scheme ends, because no length within reach of \
                the last has the discrete energy e",
        )
        .near("steps that it takes", *steps as f64, [3.0, 0.0])
        .at_most("|E_d − e| of the last of them, by hand", last.defect(*length).abs(), 5e-14)
        .near(of_lengths, smallest, [2.758e-3, 1e-6])
        .near(
            "that of the best length that the control has found, less that by hand",
            difference,
            [0.0, 1e-13],
        )
    }
}

impl Sought {
    /// With `before`, the length of the step before.
    fn new(state: StiffeningSpringState, energy: f64, before: f64) -> Self {
        let mut sought = Self { state, energy, curve: Vec::new() };
        let lengths = (1..=POINTS).map(|k| REACH * before * f64::from(k) / f64::from(POINTS));
        sought.curve = lengths.map(|h| [h, sought.defect(h)]).collect();
        sought
    }

    /// E_d − e of a step of length `h`: q1 = q + h(p − ½h∇V(q)), and E_d = ½|Δ/h|² + ½(V(q) + V(q1)).
    fn defect(&self, h: f64) -> f64 {
        let StiffeningSpringState { x, y, dot_x, dot_y } = self.state;
        let (q, p) = ([x, y], [dot_x, dot_y]);
        let slope = 1.0 + square(q);
        let velocity: [f64; 2] = std::array::from_fn(|i| p[i] - 0.5 * h * slope * q[i]);
        let q1: [f64; 2] = std::array::from_fn(|i| q[i] + h * velocity[i]);
        let potential = |q: [f64; 2]| 0.5 * square(q) + 0.25 * square(q).powi(2);
        0.5 * square(velocity) + 0.5 * (potential(q) + potential(q1)) - self.energy
    }
}

/// The runs that are drawn: those with the longest steps.
fn drawn([(spring, on_spring), (kepler, on_orbit)]: &All) -> [(String, &Steps, Stroke); 4] {
    let (on_spring, on_orbit) = (&on_spring[0], &on_orbit[0]);
    [
        (format!("{spring}, one length"), &on_spring.mean, Stroke::solid(VERMILLION)),
        (format!("{kepler}, one length"), &on_orbit.mean, Stroke::solid(PURPLE)),
        (format!("{spring}, energy-momentum"), &on_spring.kept, Stroke::solid(BLUE)),
        (format!("{kepler}, energy-momentum"), &on_orbit.kept, Stroke::solid(GREEN)),
    ]
}

/// A number of each step of the beginning: its length, or E − E(0).
fn over_steps(steps: &Steps, column: usize) -> Vec<[f64; 2]> {
    steps.beginning.iter().map(|step| [step[0], step[column]]).collect()
}

fn figure(all: &All, ending: &Ending) -> Figure {
    let lines = |points: &dyn Fn(&Steps) -> Vec<[f64; 2]>| {
        drawn(all).map(|(name, steps, stroke)| (name, stroke, points(steps)))
    };
    let axis = Axis::logarithmic("largest |*E*_d − *e*| of many steps").within(1e-16, 1.0);
    let discrete = Panel::new("Discrete energy", Axis::linear("number of the step"), axis)
        .lines(lines(&|steps| steps.discrete().envelope.magnitude()));
    let time = || Axis::time(BEGINNING);
    let energy = Panel::new("Energy at the points of the run", time(), Axis::linear("*E* − *E*(0)"))
        .lines(lines(&|steps| over_steps(steps, 2)));
    let lengths = Panel::new("Length of the steps", time(), Axis::linear("*h*").within(0.0, 0.22))
        .lines(lines(&|steps| over_steps(steps, 1)));
    Figure::new(
        "Steps of such a length that the discrete energy stays the same",
        format!(
            "variational midpoint rule; a spring with *V* = *r*²/2 + *r*⁴/4, first step {}, and a Kepler \
             orbit of eccentricity {}, first step {}; “one length” is the mean of the other run",
            ON_SPRING[0], ORBIT.e, ON_ORBIT[0]
        ),
    )
    .row(370.0, vec![discrete.without_legend(), energy.without_legend()])
    .row(350.0, vec![lengths, equation(ending)])
    .footer(format!(
        "The scheme of Kane, Marsden & Ortiz 1999. With the trapezoidal rule on the spring it ends after \
         {} steps, at *t* = {:.2}: no length within reach gives the discrete energy *e* of the first step.",
        ending.steps, ending.time
    ))
}

fn equation(ending: &Ending) -> Panel {
    let Ending { last, failed, length, best, .. } = ending;
    let thousandfold = |[h, defect]: [f64; 2]| [h, 1e3 * defect];
    let within =
        |curve: &[[f64; 2]]| curve.iter().copied().filter(|[h, _]| *h <= SHOWN).map(thousandfold).collect();
    let axis = Axis::linear("10³ (*E*_d(*h*) − *e*)").within(-10.0, 16.0);
    Panel::new("The equation for *h*, trapezoidal rule", Axis::linear("*h*").within(0.0, SHOWN), axis)
        .line(vec![[0.0, 0.0], [SHOWN, 0.0]], Stroke::solid(SLATE).width(1.0))
        .line(within(&last.curve), Stroke::dashed(BLUE))
        .labelled("at the last step")
        .discs(vec![[*length, 0.0]], BLUE, Fill::Solid)
        .labelled(format!("its length, {length:.3}"))
        .line(within(&failed.curve), Stroke::solid(VERMILLION))
        .labelled("where the run ends")
        .discs(vec![thousandfold(*best)], VERMILLION, Fill::Hollow)
        .labelled(format!("nearest to zero, {}", scientific(best[1])))
        .legend_at(Corner::TopLeft)
}

fn table(all: &All, ending: &Ending) -> Result<Table> {
    let of_runs = drawn(all).into_iter().flat_map(|(name, steps, _)| {
        let curves = [
            ("largest_discrete_energy_defect", "step", steps.discrete().envelope.magnitude()),
            ("energy_change", "t", over_steps(steps, 2)),
            ("length", "t", over_steps(steps, 1)),
        ];
        curves.map(|(quantity, over, points)| ([name.clone(), quantity.to_owned(), over.to_owned()], points))
    });
    let of_ending = [("trapezoid, last step", &ending.last), ("trapezoid, no step", &ending.failed)];
    let of_ending = of_ending.into_iter().map(|(name, sought)| {
        let names = [name, "discrete_energy_defect", "h"].map(str::to_owned);
        (names, sought.curve.iter().copied().step_by(20).collect())
    });
    let rows = of_runs.chain(of_ending).flat_map(|(names, points): ([String; 3], Vec<_>)| {
        points.into_iter().map(move |point| (names.clone(), point))
    });
    Table::of(&["run", "quantity", "over", "at", "value"], rows)
}
