//! A disc that rolls upright on a plane, and a sleigh on a blade: constraints of velocities.
//!
//! A step solves the discrete equations of Lagrange and d'Alembert (Cortés & Martínez 2001). It is
//! reversible, as the motion is, but neither is symplectic. So the energy of a step need not stay near that
//! of the beginning: it does in regular motions, which the reversal takes into themselves, and wanders in
//! others (Modin & Verdier 2020). The sleigh ends in straight motion, to which no symplectic map could lead.

use dvi_core::discrete::{Midpoint, Unfitted};

use super::rk4::{rk4, rk4_up_to};
use crate::models::{ChaplyginSleigh, ChaplyginSleighState, RollingDisc, RollingDiscState};
use crate::vocabulary::*;

const FREE: RollingDisc = RollingDisc { radius: 1.0, stiffness: [0.0; 2], field: [0.0; 2], gradient: 0.0 };
/// On springs that are the same in all directions, and on springs that are not, with a magnet.
const SPRINGS: RollingDisc = RollingDisc { stiffness: [1.0; 2], ..FREE };
const MAGNET: RollingDisc =
    RollingDisc { radius: 1.0, stiffness: [1.0, 1.7], field: [0.3, 0.1], gradient: 0.3 };
const SLEIGH: ChaplyginSleigh = ChaplyginSleigh { inertia: 1.0, a: 0.5 };
/// Where all discs begin, and the rates of θ and φ.
const PLACE: [f64; 2] = [0.5, 0.2];
const RATES: [f64; 2] = [1.2, 0.4];
/// v and ω of the sleigh at the start: backwards and in rotation.
const SLIDING: [f64; 2] = [-1.0, 2.0];
const H: f64 = 0.1;
/// The time at which the order is measured, the steps, and that of the reference.
const ORDER_TIME: f64 = 8.0;
const ORDER_STEPS: [f64; 4] = [H, H / 2.0, H / 4.0, H / 8.0];
const FINE: f64 = 0.00125;
/// The end of the beginning of long runs, and of runs with half the step.
const EARLY: f64 = 100.0;
const HALVED: f64 = 1e4;
/// How long the run of the disc is that is reversed.
const REVERSED: u64 = 200;
/// The time at which the sleigh has turned around, and that of straight motion.
const TURNED: f64 = 8.0;
const STRAIGHT: f64 = 24.0;
/// How many starts there are for the growth of the energy error, in equally spaced directions from one place,
/// and times in a factor of ten at which it is noted.
const STARTS: u64 = 8;
const PER_DECADE: f64 = 8.0;

/// A line in the figure of the growth of the energy error, with the step.
type Line = (&'static str, f64, Stroke, Growth);

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let (end, end_half) = job.choose((5e4, HALVED), (500.0, 500.0));
    job.expect((STARTS as f64 * (4.0 * end / H + 2.0 * end_half / H)) as u64);
    let (solid, dashed) = (Stroke::solid, Stroke::dashed);
    let all = [
        ("magnet", H, solid(VERMILLION), Growth::constrained(job, &MAGNET, H, end)?),
        ("magnet", H / 2.0, solid(AMBER), Growth::constrained(job, &MAGNET, H / 2.0, end_half)?),
        ("magnet, RK4", H, dashed(VERMILLION), Growth::rk4(job, &MAGNET, H, end)?),
        ("springs", H, solid(BLUE), Growth::constrained(job, &SPRINGS, H, end)?),
        ("springs, RK4", H, dashed(BLUE), Growth::rk4(job, &SPRINGS, H, end)?),
    ];
    let sleigh = Sleigh::new()?;
    let rows = all.iter().flat_map(|(name, h, _, Growth(points))| {
        points.iter().map(move |[t, error]| ([*name], [*h, *t, *error]))
    });
    job.publish(figure(&all, &sleigh)?, Table::of(&["series", "h", "t", "largest_energy_error"], rows)?)?;
    let of_disc = there_and_back(&MAGNET, midpoint(), H, &begin(&MAGNET), REVERSED)?;
    let of_sleigh = there_and_back(&SLEIGH, midpoint(), H, &sliding(), (TURNED / H).round() as u64)?;
    Ok(vec![
        free(job)?,
        order_of_places(&sleigh)?,
        beyond(format!("steps are undone by as many steps of length −{H}"))
            .at_most(
                format!("disc with a magnet, {REVERSED} steps: largest difference from the start"),
                of_disc,
                1e-12,
            )
            .at_most("sleigh: largest difference from the start", of_sleigh, 1e-12),
        springs(job, &all, end),
        magnet(job, &all, end),
        sleigh.claim(),
    ]
    .into())
}

fn midpoint() -> Constrained<Variational<Unfitted, Midpoint>> {
    Constrained::new(Variational::midpoint())
}

fn begin(disc: &RollingDisc) -> RollingDiscState {
    disc.rolling(PLACE, 0.3, RATES)
}

fn sliding() -> ChaplyginSleighState {
    ChaplyginSleigh::sliding(SLIDING[0], SLIDING[1])
}

/// Where a free disc is: on a circle of radius Rθ̇/φ̇.
fn on_circle(t: f64) -> [f64; 2] {
    let RollingDiscState { x, y, phi, dot_theta, dot_phi, .. } = begin(&FREE);
    let (radius, after) = (FREE.radius * dot_theta / dot_phi, phi + dot_phi * t);
    [x + radius * (after.sin() - phi.sin()), y - radius * (after.cos() - phi.cos())]
}

/// A run without a potential.
fn free(job: &Job<'_>) -> Result<Claim> {
    fn momenta<R: Run<Scalar = f64>>(run: &R) -> [f64; 2] {
        [0, 1].map(|k| run.momentum(k).unwrap_or(f64::NAN))
    }
    let steps: u64 = job.choose(100_000, 2_000);
    let mut run = Integrator::new(&FREE, midpoint(), H, begin(&FREE))?;
    let (energy, before, mut across) = (run.energy(), momenta(&run), 0.0);
    job.expect(steps);
    let span = Span { end: steps as f64 * H, early: 0.0, intervals: 1 };
    let [energy, rolling, turning] = job.keep(&mut run, steps, span, |run| {
        let RollingDiscState { phi, dot_x, dot_y, dot_theta, .. } = run.state();
        let speed = FREE.radius * dot_theta;
        // |ẋ − Rθ̇ cos φ| and |ẏ − Rθ̇ sin φ|
        across = largest([across, (dot_x - speed * phi.cos()).abs(), (dot_y - speed * phi.sin()).abs()]);
        let [rolling, turning] = momenta(run);
        [run.energy() / energy, rolling / before[0], turning / before[1]].map(|ratio| ratio - 1.0)
    })?;
    let text = format!(
        "without a potential, h = {H}: energy and momenta are kept to rounding, which grows with the angle θ"
    );
    Ok(beyond(text)
        .at_least("θ at the end", job.only_full(run.state().theta), 1e4)
        .at_most("largest |E/E(0) − 1|", energy.largest, 5e-11)
        .at_most("largest relative change of the momentum of rolling", rolling.largest, 3e-11)
        .at_most("largest relative change of the momentum of turning", turning.largest, 1e-13)
        .at_most("largest velocity against the constraints", across, 1e-15))
}

fn order_of_places(sleigh: &Sleigh) -> Result<Claim> {
    // With a magnet, by RK4.
    let [fine, double] = [FINE, 2.0 * FINE].map(|h| {
        let [x, y, ..] = rk4_up_to(begin(&MAGNET).reduced(), ORDER_TIME, h, |y| MAGNET.reduced(y));
        [x, y]
    });
    fn of(
        disc: &RollingDisc,
        method: impl Method<RollingDisc, f64> + Clone,
        expected: [f64; 2],
    ) -> Result<Option<f64>> {
        order_of(ORDER_STEPS, |h| {
            let RollingDiscState { x, y, .. } = up_to(disc, method.clone(), h, begin(disc), ORDER_TIME)?;
            Ok((h, distance([x, y], expected)))
        })
    }
    let (free, magnet) = (of(&FREE, midpoint(), on_circle(ORDER_TIME))?, of(&MAGNET, midpoint(), fine)?);
    let composed = of(&MAGNET, Composition::suzuki(midpoint()), fine)?;
    let sleigh = order(ORDER_STEPS.into_iter().zip(sleigh.errors));
    Ok(beyond(
        "places are of second order: against the circle of a free disc, and against RK4 on equations \
               without constraints",
    )
    .at_most("distance of two references with a magnet", distance(fine, double), 1e-9)
    .near(format!("free disc: order at t = {ORDER_TIME}"), free, [2.0, 0.01])
    .near(format!("disc with a magnet: order at t = {ORDER_TIME}"), magnet, [2.0, 0.05])
    .near("the same by Suzuki's composition: order", composed, [4.0, 0.1])
    .near("sleigh: order when it has turned", sleigh, [2.0, 0.05]))
}

fn springs(job: &Job<'_>, [.., (_, _, _, constrained), (_, _, _, rk4)]: &[Line; 5], end: f64) -> Claim {
    let growth = |of: &Growth| of.up_to(end) / of.up_to(EARLY);
    let over_all = format!("largest |ΔE| over all / up to t = {EARLY}");
    beyond(format!(
        "on equal springs the energy error of constrained steps, on average over {STARTS} starts, does not \
         grow, that of RK4 does"
    ))
    .at_most("constrained: largest |ΔE|", constrained.up_to(end), 1.2e-3)
    .at_most(format!("constrained: {over_all}"), growth(constrained), 1.02)
    .at_least("RK4: largest |ΔE|", job.only_full(rk4.up_to(end)), 1.2e-3)
    .at_least(format!("RK4: {over_all}"), job.only_full(growth(rk4)), 100.0)
}

fn magnet(job: &Job<'_>, all: &[Line; 5], end: f64) -> Claim {
    let [whole, half, rk4, springs, _] = all.each_ref().map(|(.., growth)| growth);
    let of = |other: f64| job.only_full(whole.up_to(end) / other);
    let halved = job.only_full(half.up_to(HALVED) / whole.up_to(HALVED));
    let power = job.only_full(whole.exponent(EARLY));
    beyond(
        "with a magnet that energy wanders away, by an amount of the order h², and RK4 with steps of \
            the same length keeps it better",
    )
    .at_least("magnet: largest |ΔE|", job.only_full(whole.up_to(end)), 0.1)
    .at_least("magnet: largest |ΔE| / on springs", of(springs.up_to(end)), 100.0)
    .at_least(format!("magnet: largest |ΔE| over all / up to t = {EARLY}"), of(whole.up_to(EARLY)), 10.0)
    .within(format!("magnet: power of t by which it grows, from t = {EARLY}"), power, [0.4, 0.7])
    .within(
        format!("magnet: largest |ΔE| up to t = {HALVED} with half the step / with the whole"),
        halved,
        [0.15, 0.35],
    )
    .at_least("magnet: largest |ΔE| / that of RK4", of(rk4.up_to(end)), 5.0)
}

/// The mean, over the starts, of the largest |E − E(0)| up to time t, for times t at equal ratios.
struct Growth(Vec<[f64; 2]>);

impl Growth {
    fn constrained(job: &Job<'_>, disc: &RollingDisc, h: f64, end: f64) -> Result<Self> {
        Self::of(job, disc, h, end, |begin| {
            let mut run = Integrator::new(disc, midpoint(), h, begin)?;
            Ok(move || {
                run.advance()?;
                Ok(run.energy())
            })
        })
    }

    /// By RK4 on the equations without constraints.
    fn rk4(job: &Job<'_>, disc: &RollingDisc, h: f64, end: f64) -> Result<Self> {
        Self::of(job, disc, h, end, |begin| {
            let mut y = begin.reduced();
            Ok(move || {
                y = rk4(&y, h, |y| disc.reduced(y));
                Ok(disc.energy_of(&y))
            })
        })
    }

    /// Of runs whose steps `begun` takes, each of which returns the energy after it.
    fn of<F: FnMut() -> Result<f64, StepError>>(
        job: &Job<'_>,
        disc: &RollingDisc,
        h: f64,
        end: f64,
        begun: impl Fn(RollingDiscState) -> Result<F>,
    ) -> Result<Self> {
        let decades = end.log10();
        let count = (PER_DECADE * decades).round().max(1.0);
        let times = (0..=count as u32).map(|k| 10f64.powf(f64::from(k) / count * decades));
        let mut points: Vec<[f64; 2]> = times.map(|t| [t, 0.0]).collect();
        for k in 0..STARTS {
            let begin = disc.rolling(PLACE, 0.3 + k as f64 * TAU / STARTS as f64, RATES);
            let (first, mut step) = (disc.energy_of(&begin.reduced()), begun(begin)?);
            let (mut largest, mut steps, mut next) = (0.0, 0_u64, 0);
            job.repeat((end / h).round() as u64, || {
                largest = larger(largest, (step()? - first).abs());
                steps += 1;
                while next < points.len() && (steps as f64 + 0.5) * h > points[next][0] {
                    points[next][1] += largest / STARTS as f64;
                    next += 1;
                }
                Ok(())
            })?;
        }
        Ok(Self(points))
    }

    /// Up to the last of the times that is not after `t`.
    fn up_to(&self, t: f64) -> f64 {
        let before = self.0.iter().take_while(|point| point[0] <= 1.001 * t);
        before.last().map_or(f64::NAN, |point| point[1])
    }

    /// The slope in a double logarithmic picture from time `from` on: of the line of least squares.
    fn exponent(&self, from: f64) -> Option<f64> {
        order(self.0.iter().filter(|point| point[0] >= 0.999 * from).map(|point| (point[0], point[1])))
    }
}

/// The sleigh, which turns around, and ends straight ahead: runs with each of [`ORDER_STEPS`].
struct Sleigh {
    /// Places and |ω| at multiples of the longest step, and in the motion, by RK4 at multiples of [`FINE`].
    path: Vec<[f64; 2]>,
    turning: Vec<[f64; 2]>,
    motion: Vec<[f64; 2]>,
    turning_of_motion: Vec<[f64; 2]>,
    /// The distances from the motion at [`TURNED`].
    errors: [f64; 4],
    /// E/E(0) − 1 when it moves straight ahead.
    energies: [f64; 4],
    /// The largest relative difference of two energies after [`TURNED`], with the longest step.
    late: f64,
    /// The rate at which ω decays between the two times with the longest step, over av/(I + a²) for the
    /// speed v at the end.
    decay: f64,
}

impl Sleigh {
    fn new() -> Result<Self> {
        let mut y = [0.0, 0.0, 0.0, SLIDING[0], SLIDING[1]];
        let drawn = TURNED + 4.0;
        let begun = || (vec![[0.0; 2]], vec![[0.0, SLIDING[1].abs()]]);
        let ((mut motion, mut turning_of_motion), (mut path, mut turning)) = (begun(), begun());
        for step in 1..=(drawn / FINE).round() as u32 {
            y = rk4(&y, FINE, |y| SLEIGH.reduced(y));
            motion.push([y[0], y[1]]);
            turning_of_motion.push([f64::from(step) * FINE, y[4].abs()]);
        }
        let expected = motion[(TURNED / FINE).round() as usize];
        let (mut late, mut decay) = (0.0, f64::NAN);
        let ends = each(ORDER_STEPS, |h| {
            let mut run = Integrator::new(&SLEIGH, midpoint(), h, sliding())?;
            let energy = run.energy();
            run.take_steps((TURNED / h).round() as u64)?;
            let (turned, state) = (run.energy(), run.state());
            let error = distance([state.x, state.y], expected);
            for _ in 0..((STRAIGHT - TURNED) / h).round() as u64 {
                run.advance()?;
                if h == H {
                    late = larger(late, (run.energy() / turned - 1.0).abs());
                }
            }
            let end = run.state();
            let rate = SLEIGH.a * end.dot_x.hypot(end.dot_y) / (SLEIGH.inertia + SLEIGH.a.powi(2));
            if h == H {
                decay = (state.dot_theta / end.dot_theta).abs().ln() / ((STRAIGHT - TURNED) * rate);
            }
            Ok([error, run.energy() / energy - 1.0])
        })?;
        let mut run = Integrator::new(&SLEIGH, midpoint(), H, sliding())?;
        for _ in 0..(drawn / H).round() as u64 {
            run.advance()?;
            let ChaplyginSleighState { x, y, dot_theta, .. } = run.state();
            path.push([x, y]);
            turning.push([run.time(), dot_theta.abs()]);
        }
        let (errors, energies) = (ends.map(|end| end[0]), ends.map(|end| end[1]));
        Ok(Self { path, turning, motion, turning_of_motion, errors, energies, late, decay })
    }

    fn claim(&self) -> Claim {
        let last = |curve: &[[f64; 2]]| curve.last().map_or(f64::NAN, |point| point[1]);
        let turns = last(&self.turning) / last(&self.turning_of_motion);
        let order = order(ORDER_STEPS.into_iter().zip(self.energies.map(f64::abs)));
        beyond(format!(
            "the sleigh ends straight ahead, h = {H}: its energy changes while it turns, by a term of the \
             order h², and then no more"
        ))
        .near("rate at which ω decays / av/(I + a²)", self.decay, [1.0, 0.002])
        .near("|ω| at t = 12 / that of the motion", turns, [1.0, 0.02])
        .at_most(format!("|E/E(0) − 1| at t = {STRAIGHT}"), self.energies[0].abs(), 5e-3)
        .near("order of that", order, [2.0, 0.05])
        .at_most("largest relative change of E when it has turned", self.late, 1e-13)
    }
}

/// The places of a disc.
fn path(disc: &RollingDisc, end: f64) -> Result<Vec<[f64; 2]>> {
    let mut run = Integrator::new(disc, midpoint(), H, begin(disc))?;
    Ok(course(&mut run, (end / H).round() as u64, place)?)
}

fn figure(all: &[Line; 5], sleigh: &Sleigh) -> Result<Figure> {
    let exact = (0..=400).map(|i| on_circle(f64::from(i) * 0.04)).collect();
    let grey = Stroke::solid(SLATE).width(1.2);
    let free = Panel::new("Free", Axis::linear("*x*"), Axis::linear("*y*").within(-1.0, 9.0))
        .equal()
        .line(exact, grey)
        .labelled("circle")
        .dots(path(&FREE, 16.0)?.into_iter().step_by(4).collect(), 2.2, GREEN)
        .labelled("every 4th step");
    let of = |title: &str, disc: &RollingDisc, colour: Colour| -> Result<Panel> {
        Ok(Panel::plane(title, "*x*", "*y*").line(path(disc, 60.0)?, Stroke::solid(colour).width(1.2)))
    };
    let (springs, magnet) =
        (of("On equal springs", &SPRINGS, BLUE)?, of("With a magnet", &MAGNET, VERMILLION)?);
    let until = |path: &[[f64; 2]], h: f64| path.iter().take((7.0 / h) as usize).copied().collect();
    let slid = Panel::plane("Sleigh", "*x*", "*y*")
        .line(until(&sleigh.motion, FINE), grey)
        .labelled("motion")
        .dots(until(&sleigh.path, H), 2.0, PURPLE)
        .labelled("steps")
        .legend_at(Corner::BottomRight);
    let lines = all.iter().map(|(name, h, stroke, Growth(points))| {
        let label = if *h == H { (*name).to_owned() } else { format!("{name}, *h* = {h}") };
        (label, *stroke, points.clone())
    });
    let energy =
        Panel::new("Energy", Axis::logarithmic("time *t*"), Axis::logarithmic("largest |*E* − *E*(0)|"));
    let energy = energy.lines(lines).legend_at(Corner::Beside).weight(1.4);
    let turning =
        Panel::new("Rate of rotation of the sleigh", Axis::linear("time *t*"), Axis::logarithmic("|*ω*|"))
            .line(sleigh.turning_of_motion.clone(), grey)
            .labelled("motion")
            .dots(sleigh.turning.clone(), 2.0, PURPLE)
            .labelled(format!("steps, *h* = {H}"));
    Ok(Figure::new(
        "A disc that rolls upright, and a sleigh on a blade: constraints of velocities",
        format!(
            "Midpoint rule with the principle of Lagrange and d'Alembert, *h* = {H}. Mass and radius are \
             1; the disc begins with *θ*' = {} and *φ*' = {}.",
            RATES[0], RATES[1]
        ),
    )
    .row(320.0, vec![free, springs, magnet, slid])
    .row(330.0, vec![energy, turning])
    .footer(format!(
        "Above: the points of contact, from *t* = 0 to 16, 60, 60 and 7. Energy: the mean over {STARTS} \
         starts of the largest |*E* − *E*(0)| up to time *t*. RK4 solves the equations from which the \
         constraints are eliminated."
    )))
}
