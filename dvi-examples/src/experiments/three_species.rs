//! Three species that eat each other in a circle: an odd number of coordinates, and two invariants.
//!
//! x' = x(y − z), y' = y(z − x), z' = z(x − y) keeps x + y + z and xyz. It is a Poisson system of rank two
//! and has no one-form in x, y and z. In w = ln xyz, which commutes with everything, and a coordinate s
//! conjugate to it, it has one, in the class of one-step schemes; s' = z then says that s counts the third
//! species.

use anyhow::Result;
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use crate::claim::{BEYOND, Bound, Claim, larger};
use crate::deviation::Deviation;
use crate::figure::{
    AMBER, Axis, BLUE, Corner, Figure, GREEN, Panel, SEQUENCE, Stroke, VERMILLION, at_most, scientific,
};
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{ThreeSpecies, ThreeSpeciesReduced, ThreeSpeciesReducedState, ThreeSpeciesState};
use crate::output::{Table, number};

pub const EXPERIMENT: Experiment =
    Experiment { name: "three-species", title: "Lotka–Volterra with three species", share: 1.5, run };

/// x, y and z at the start; the paths in the figure begin at others too.
const START: Species = [0.3, 0.7, 2.0];
const OTHERS: [Species; 3] = [[0.1, 0.9, 2.0], [0.6, 0.9, 1.5], [0.85, 1.0, 1.15]];
const H: f64 = 0.1;
/// Steps of the beginning, with which the whole is compared.
const EARLY: u64 = 2000;

type Species = [f64; 3];

/// What one long run leaves.
struct Series {
    name: &'static str,
    /// Relative changes of x + y + z and of xyz.
    sum: Deviation,
    product: Deviation,
}

impl Series {
    fn new(name: &'static str, steps: u64) -> Self {
        let empty = || Deviation::new(steps as f64 * H, 400, EARLY as f64 * H);
        Self { name, sum: empty(), product: empty() }
    }
}

fn sum(species: Species) -> f64 {
    species.iter().sum()
}

fn product(species: Species) -> f64 {
    species.iter().product()
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(1_000_000, 20_000);
    job.expect(2 * steps);
    let all = [one_step(job, steps)?, runge_kutta(job, steps)?];
    let claims = vec![kept(&all), same_motion()?, means()?];
    let [early, paths] = [vec![START], [&[START][..], &OTHERS].concat()].map(|starts| {
        starts.into_iter().map(|start| orbit(OneStep::midpoint(), start, H, 300)).collect::<Result<Vec<_>>>()
    });
    job.publish(EXPERIMENT.name, figure(&all, &early?[0], paths?, steps as f64 * H), table(&all)?)?;
    Ok(Outcome { claims, references: vec![], notes: vec![] })
}

fn state(species: Species) -> ThreeSpeciesState {
    ThreeSpeciesState { x: species[0], s: 0.0, y: species[1], w: product(species).ln() }
}

/// x, y and z of x, s, y and w.
fn species(q: &[f64]) -> Species {
    [q[0], q[2], q[3].exp() / (q[0] * q[2])]
}

/// The species at each step.
fn orbit<M: Method<ThreeSpecies, f64>>(
    method: M,
    start: Species,
    h: f64,
    steps: u64,
) -> Result<Vec<Species>> {
    let mut run = Integrator::new(&ThreeSpecies {}, method, h, state(start))?;
    let mut orbit = vec![start];
    for _ in 0..steps {
        run.advance()?;
        orbit.push(species(run.q()));
    }
    Ok(orbit)
}

fn one_step(job: &Job<'_>, steps: u64) -> Result<Series> {
    let mut series = Series::new("one step, midpoint", steps);
    let mut run = Integrator::new(&ThreeSpecies {}, OneStep::midpoint(), H, state(START))?;
    job.repeat(steps, || {
        run.advance()?;
        series.sum.push(run.time(), run.energy() / sum(START) - 1.0);
        series.product.push(run.time(), (run.q()[3] - product(START).ln()).exp_m1());
        Ok(())
    })?;
    Ok(series)
}

/// The equations of x, y and z as they are.
fn rates([x, y, z]: Species) -> Species {
    [x * (y - z), y * (z - x), z * (x - y)]
}

/// A step of the classical Runge–Kutta method on x, y and z.
fn classical(species: Species, h: f64) -> Species {
    let moved = |k: Species, c: f64| std::array::from_fn(|i| species[i] + c * h * k[i]);
    let k1 = rates(species);
    let k2 = rates(moved(k1, 0.5));
    let k3 = rates(moved(k2, 0.5));
    let k4 = rates(moved(k3, 1.0));
    std::array::from_fn(|i| species[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]))
}

fn runge_kutta(job: &Job<'_>, steps: u64) -> Result<Series> {
    let mut series = Series::new("RK4", steps);
    let (mut species, mut step) = (START, 0u32);
    job.repeat(steps, || {
        species = classical(species, H);
        step += 1;
        let t = f64::from(step) * H;
        series.sum.push(t, sum(species) / sum(START) - 1.0);
        series.product.push(t, product(species) / product(START) - 1.0);
        Ok(())
    })?;
    Ok(series)
}

fn kept([one_step, runge_kutta]: &[Series; 2]) -> Claim {
    let text = "one step keeps xyz to rounding errors, and its error of x + y + z is no larger in the whole run than in its beginning; RK4 keeps the sum, which is linear, and loses the product";
    Claim::new(BEYOND, text)
        .check("one step: largest relative change of xyz", one_step.product.largest, Bound::AtMost(1e-10))
        .check(
            format!("one step: max|Δ(x + y + z)| over all / over {EARLY} steps"),
            one_step.sum.growth(),
            Bound::AtMost(1.001),
        )
        .check("RK4: largest relative change of x + y + z", runge_kutta.sum.largest, Bound::AtMost(1e-10))
        .check(
            format!("RK4: max|Δ(xyz)| over all / over {EARLY} steps"),
            runge_kutta.product.growth(),
            Bound::AtLeast(5.0),
        )
}

/// The four coordinates against the two of x and y with xyz as a parameter, and against RK4 on x, y and z
/// with small steps.
fn same_motion() -> Result<Claim> {
    const END: f64 = 20.0;
    let apart = |a: Species, b: Species| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, larger);
    let reduced = ThreeSpeciesReduced { product: product(START) };
    let mut run = Integrator::new(
        &reduced,
        OneStep::midpoint(),
        H,
        ThreeSpeciesReducedState { x: START[0], y: START[1] },
    )?;
    let mut difference = 0.0;
    for [x, y, _] in orbit(OneStep::midpoint(), START, H, 1000)? {
        difference = larger(difference, larger((run.q()[0] - x).abs(), (run.q()[1] - y).abs()));
        run.advance()?;
    }
    let exact = (0..20_000).fold(START, |species, _| classical(species, END / 20_000.0));
    let mut errors = Vec::new();
    for steps in [400, 600, 800] {
        let h = END / steps as f64;
        let end = orbit(OneStep::midpoint(), START, h, steps)?.pop().unwrap_or(START);
        errors.push((h, apart(end, exact)));
    }
    Ok(Claim::new(
        BEYOND,
        "with w and s, or with xyz as a parameter, the motion is that of the three species",
    )
    .check("largest difference of the two in 1000 steps", difference, Bound::AtMost(1e-11))
    .check(
        "order of the difference from x, y, z at t = 20",
        convergence_order(&errors),
        Bound::Near(2.0, 0.05),
    ))
}

/// (ln x)' = y − z, and so on around the circle: over a closed orbit the means of all species are the same.
fn means() -> Result<Claim> {
    const STEPS: u64 = 20_000;
    let mut run = Integrator::new(&ThreeSpecies {}, OneStep::midpoint(), H, state(START))?;
    let mut total = 0.0;
    for _ in 0..STEPS {
        let before = run.q()[0];
        run.advance()?;
        total += 0.5 * (before + run.q()[0]);
    }
    let means = [total / STEPS as f64, run.q()[1] / (STEPS as f64 * H)];
    Ok(Claim::new(BEYOND, "s counts the third species, whose mean is that of the first").check(
        "s/t over the mean of x, at t = 2000",
        means[1] / means[0],
        Bound::Near(1.0, 3e-3),
    ))
}

fn figure(all: &[Series; 2], early: &[Species], paths: Vec<Vec<Species>>, end: f64) -> Figure {
    // The plane x + y + z = 3, with the corners at which one species is left.
    let flat = |[x, y, z]: Species| [(y - x) / 2.0f64.sqrt(), (2.0 * z - x - y) / 6.0f64.sqrt()];
    let corners = [[3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 3.0], [3.0, 0.0, 0.0]].map(flat);
    let plane = Panel::new(
        "Paths in the plane *x* + *y* + *z* = 3",
        Axis::linear("(*y* − *x*) / √2").within(-2.3, 2.3),
        Axis::linear("(2*z* − *x* − *y*) / √6").within(-1.5, 2.7),
    );
    let plane = plane.equal().line(corners.to_vec(), Stroke::solid(AMBER).width(1.2));
    let plane = paths.into_iter().zip([0, 2, 4, 6]).fold(plane, |plane, (path, colour)| {
        plane.line(path.into_iter().map(flat).collect(), Stroke::solid(SEQUENCE[colour]).width(1.4))
    });
    let over_time =
        |i: usize| early.iter().enumerate().map(|(k, species)| [k as f64 * H, species[i]]).collect();
    let species = [("*x*", BLUE), ("*y*", GREEN), ("*z*", VERMILLION)].into_iter().enumerate().fold(
        Panel::new(
            "Species",
            Axis::linear("time *t*").within(0.0, 20.0),
            Axis::linear("number").within(0.0, 3.0),
        ),
        |panel, (i, (name, colour))| panel.line(over_time(i), Stroke::solid(colour)).labelled(name),
    );
    let [one_step, runge_kutta] = all;
    let errors = Panel::new(
        "Errors of the invariants",
        Axis::linear("time *t*").within(0.0, end),
        Axis::logarithmic("largest relative error").within(1e-16, 10.0),
    )
    .line(one_step.sum.envelope.magnitude(), Stroke::solid(BLUE))
    .labelled("one step: *x* + *y* + *z*")
    .line(runge_kutta.sum.envelope.magnitude(), Stroke::solid(VERMILLION))
    .labelled("RK4: *x* + *y* + *z*")
    .line(runge_kutta.product.envelope.magnitude(), Stroke::dashed(VERMILLION))
    .labelled("RK4: *xyz*");
    Figure::new(
        "Three species that eat each other in a circle",
        format!("*x*′ = *x*(*y* − *z*), *y*′ = *y*(*z* − *x*), *z*′ = *z*(*x* − *y*); one-step midpoint scheme, *h* = {H}"),
    )
    .row(430.0, vec![plane, species.weight(1.2).legend_at(Corner::TopRight)])
    .row(300.0, vec![errors.legend_at(Corner::Beside)])
    .footer(format!(
        "Largest relative change of *x* + *y* + *z*: one step {}, RK4 {}; of *xyz*: one step {}, RK4 {}.",
        at_most(one_step.sum.largest),
        at_most(runge_kutta.sum.largest),
        at_most(one_step.product.largest),
        scientific(runge_kutta.product.largest)
    ))
}

fn table(all: &[Series; 2]) -> Result<Table> {
    let mut table = Table::new(&["method", "invariant", "t", "lowest", "mean", "highest"])?;
    for Series { name, sum, product } in all {
        for (invariant, change) in [("x + y + z", sum), ("xyz", product)] {
            for row in change.envelope.rows() {
                let names = [(*name).to_owned(), invariant.to_owned()];
                table.row(names.into_iter().chain(row.map(number)))?;
            }
        }
    }
    Ok(table)
}
