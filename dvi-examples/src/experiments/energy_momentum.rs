//! The symplectic-energy-momentum scheme: steps of such a length that the discrete energy stays the same.
//!
//! The scheme of Kane, Marsden & Ortiz 1999 with the variational midpoint rule, on a spring that stiffens
//! and on a Kepler orbit, beside the same rule with steps of one length: discrete energy, energy, angular
//! momentum, lengths of the steps and distance from the motion.

use super::energy_steps::*;
use crate::vocabulary::*;

pub const START: StiffeningSpringState = StiffeningSpringState { x: 1.0, y: 0.3, dot_x: 0.0, dot_y: 0.5 };
const ORBIT: Orbit = Orbit { e: 0.5 };
/// The lengths of the first steps, the longest first.
pub const ON_SPRING: [f64; 4] = [0.1, 0.05, 0.025, 0.0125];
const ON_ORBIT: [f64; 4] = [0.02, 0.01, 0.005, 0.0025];
/// The time between two points of the reference.
const FINE: f64 = 0.02;

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(100_000, 10_000);
    let [fine, double] = each([FINE, 2.0 * FINE], reference)?;
    let spring = Motion {
        system: &StiffeningSpring {},
        start: START,
        potential: |r2| r2 / 2.0 + r2 * r2 / 4.0,
        position: &|t| position(&fine, t),
    };
    let kepler = Motion {
        system: &Kepler {},
        start: ORBIT.pericentre(),
        potential: |r2| -1.0 / r2.sqrt(),
        position: &|t| ORBIT.position(t),
    };
    let all = [spring.runs(job, "spring", ON_SPRING, steps)?, kepler.runs(job, "Kepler", ON_ORBIT, steps)?];
    let between = largest(fine.iter().step_by(2).zip(&double).map(|(a, b)| (a.x - b.x).hypot(a.y - b.y)));
    let none = NoStep::new()?;
    job.publish(figure(&all, &none), table(&all, &none))?;
    outcome(&all, between, &none)
}

/// Points of the motion of the spring at multiples of a time.
fn reference(every: f64) -> Result<Vec<StiffeningSpringState>> {
    let mut run = Integrator::new(&StiffeningSpring {}, Gauss::<4>::new(), every, START)?;
    Ok(course(&mut run, (COMPARED / every).round() as u64, |run| run.state())?)
}

/// By one step from the last point before; not a number beyond the end.
fn position(states: &[StiffeningSpringState], t: f64) -> [f64; 2] {
    let index = (t / FINE).floor();
    // A rest below zero is one of rounding.
    let rest = (t - index * FINE).max(1e-12);
    let place = |state| {
        let mut run = Integrator::new(&StiffeningSpring {}, Gauss::<4>::new(), rest, state).ok()?;
        run.advance().ok().map(|()| place(&run))
    };
    states.get(index as usize).copied().and_then(place).unwrap_or([f64::NAN; 2])
}

fn outcome(all: &[Runs; 2], between_references: f64, none: &NoStep) -> Result<Outcome> {
    let plain = |of: &Runs| format!("{}, steps of one length", of.name);
    let (second, width) = ([2.0, 0.02], |steps: &Steps, k: usize| steps.kept[k].width());
    let discrete = "the steps keep the discrete energy to rounding, and steps of one length up to terms of \
                    the second order";
    let bounds = [(1.5e-14, [3.141e-3, 5e-6]), (5e-14, [1.053e-2, 2e-5])];
    let discrete = beyond(discrete).each(all.iter().zip(bounds), |claim, (of, (rounding, varies))| {
        let defect = most(&of.kept, |steps| steps.kept[0].largest);
        let growth = most(&of.kept, |steps| steps.kept[0].growth());
        let claim = claim.of(of.name).at_most("largest |E_d − e| of all runs", defect, rounding);
        let claim = claim.at_most("the same over all steps / over the first tenth", growth, 2.0);
        let claim = claim.of(plain(of)).near("largest difference of two E_d", width(&of.mean[0], 0), varies);
        claim.near("order of that in h", order_in_length(&of.mean, |steps| width(steps, 0)), second)
    });
    let momentum = beyond("both keep the angular momentum to rounding").each(all, |claim, of| {
        let [kept, mean] = [&of.kept, &of.mean].map(|runs| most(runs, |steps| steps.kept[2].largest));
        let claim = claim.of(of.name).at_most("largest |l − l(0)| of all runs", kept, 2e-13);
        claim.of(plain(of)).at_most("the same", mean, 2e-13)
    });
    let energy = "the energy at the points of the run varies by terms of the second order, on the spring a \
                  little more than with steps of one length, on the orbit a third as much";
    let ratios = [[1.04, 1.07], [0.3, 0.32]];
    let energy = beyond(energy).each(all.iter().zip(ratios), |claim, (of, range)| {
        let [kept, mean] = [&of.kept, &of.mean].map(|runs| order_in_length(runs, |steps| width(steps, 1)));
        let claim = claim.of(of.name).near("order of the largest difference of two E in h", kept, second);
        let claim = claim.of(plain(of)).near("the same", mean, second).of(of.name);
        let ratio = width(&of.kept[0], 1) / width(&of.mean[0], 1);
        claim.within("largest difference of two E / that with steps of one length", ratio, range)
    });
    let known = [(ON_SPRING[0], 1.34, 5e-4), (ON_ORBIT[0], 5.09, 2e-3)];
    let lengths = beyond("the lengths of the steps stay within limits and do not drift");
    let lengths = lengths.each(all.iter().zip(known), |claim, (of, (first, most, drift))| {
        let ([low, high], lengthens) = (of.kept[0].kept[3].range(), of.kept[0].lengthening - 1.0);
        let claim = claim.of(of.name);
        let claim = claim.within("smallest length / that of the first step", low / first, [0.999, 1.0]);
        let claim = claim.near("largest length / that of the first step", high / first, [most, 0.01]);
        claim.near("mean length of the last tenth of the steps / of the first − 1", lengthens, [0.0, drift])
    });
    let text = "up to t = 50 the run is closer to the motion than one with as many steps of one length, \
                and farther than one of the same work";
    let references = "spring: largest distance of the reference from one with steps twice as long";
    let bounds = [([0.94, 0.96], 20.0), ([0.3, 0.5], 5.0)];
    let close = beyond(text).at_most(references, between_references, 1e-12);
    let close = close.each(all.iter().zip(bounds), |claim, (Runs { name, kept, mean, work }, bounds)| {
        let (closer, farther) = bounds;
        let rate = |steps: &Steps| steps.work / steps.length;
        let behind = |i: usize| kept[i].distance / work[i].distance;
        let closeness = "largest distance / that with as many steps of one length";
        let in_a_step = "evaluations of derivatives in a step / in one of steps of one length";
        let in_a_time = "evaluations in a time, the run of the same work / this one";
        let order = order_in_length(kept, |steps| steps.distance);
        claim
            .of(name)
            .near("order of the largest distance in h", order, [2.0, 0.03])
            .within(closeness, kept[0].distance / mean[0].distance, closer)
            .at_least(in_a_step, kept[0].work / mean[0].work, 4.0)
            .at_most(in_a_time, rate(&work[0]) / rate(&kept[0]), 1.0)
            .at_least("largest distance / that with the same work", behind(0), farther)
            .at_least("the same with the shortest first step", behind(3), farther)
    });
    claims([discrete, momentum, energy, lengths, close, none.claim()])
}

/// The largest defect of E_d over the number of the step, and E − E(0) and h over time.
type Drawn = (String, Stroke, [Points; 3]);

fn drawn([spring, kepler]: &[Runs; 2]) -> [Drawn; 4] {
    let one_length = |on: &Runs| format!("{}, one length", on.name);
    let varying = |on: &Runs| format!("{}, energy-momentum", on.name);
    [
        (one_length(spring), VERMILLION, &spring.mean[0]),
        (one_length(kepler), PURPLE, &kepler.mean[0]),
        (varying(spring), BLUE, &spring.kept[0]),
        (varying(kepler), GREEN, &kepler.kept[0]),
    ]
    .map(|(name, colour, steps)| {
        let [lengths, energy] = [1, 2].map(|k| steps.beginning.iter().map(|of| [of[0], of[k]]).collect());
        (name, solid(colour), [steps.kept[0].magnitude(), energy, lengths])
    })
}

fn figure(all: &[Runs; 2], none: &NoStep) -> Figure {
    let panel = |k: usize, title, x: Axis, y: Axis| {
        let lines = drawn(all).map(|(name, stroke, curves)| (name, stroke, curves[k].clone()));
        Panel::new(title, x, y).lines(lines)
    };
    let (step, time) = (Axis::linear("number of the step"), || Axis::time(BEGINNING));
    let defect = Axis::logarithmic("largest |*E*_d − *e*| of many steps").within([1e-16, 1.0]);
    let discrete = panel(0, "Discrete energy", step, defect);
    let energy = panel(1, "Energy at the points of the run", time(), Axis::linear("*E* − *E*(0)"));
    let lengths = panel(2, "Length of the steps", time(), Axis::linear("*h*").within([0.0, 0.22]));
    Figure::of(format!(
        "midpoint rule; a spring with *V* = *r*²/2 + *r*⁴/4, first step {}, and a Kepler orbit of \
         eccentricity {}, first step {}; “one length” is the mean of the other run",
        ON_SPRING[0], ORBIT.e, ON_ORBIT[0]
    ))
    .row(370.0, vec![discrete.without_legend(), energy.without_legend()])
    .row(350.0, vec![lengths, none.panel()])
}

fn table(all: &[Runs; 2], none: &NoStep) -> Result<Table> {
    let quantities = [("largest_discrete_energy_defect", "step"), ("energy_change", "t"), ("length", "t")];
    let of_runs = drawn(all).into_iter().flat_map(|(name, _, curves)| {
        let named = quantities.map(|(quantity, over)| [name.clone(), quantity.to_owned(), over.to_owned()]);
        named.into_iter().zip(curves)
    });
    let curves = of_runs.chain(none.curves()).map(|(names, points)| (names, [], points));
    curve_table("run,quantity,over,at,value", curves)
}
