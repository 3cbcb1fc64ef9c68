//! Magnetic field lines: Poincaré plots of two fields by a one-step scheme.
//!
//! A field line is the flow of a degenerate Lagrangian whose Ω is the flux of the field. A scheme that
//! preserves Ω keeps the flux through each loop that is carried along, and with it the surfaces, islands and
//! chaotic layers of the field.

use std::f64::consts::{PI, TAU};

use anyhow::Result;
use dvi_core::ProperlyDegenerate;
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use crate::claim::{BEYOND, Bound, Claim, larger};
use crate::deviation::Deviation;
use crate::figure::{
    Axis, BLUE, Corner, Figure, INK, Panel, SEQUENCE, Stroke, VERMILLION, at_most, scientific,
};
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{Abc, AbcState, PerturbedTokamak, PerturbedTokamakState};
use crate::output::{Table, number};

pub const EXPERIMENT: Experiment = Experiment {
    name: "field-lines",
    title: "Magnetic field lines of an ABC flow and of a perturbed tokamak",
    share: 4.0,
    run,
};

const ABC: Abc = Abc { a: 0.08, b: 0.3, c: 0.3, uniform: 1.0 };
const TOKAMAK: PerturbedTokamak = PerturbedTokamak { iota: 0.95, shear: 8.0, epsilon: [1e-3, 6e-3] };
/// Steps for each turn, after which the field is the same.
const STEPS: u64 = 24;
/// Turns of the beginning, with which the whole is compared.
const EARLY: u64 = 1000;
/// The line of the unperturbed field that is followed for long: its distance from the axis.
const RHO: f64 = 0.25;
/// Points on a loop, and the turns for which it is carried.
const POINTS: usize = 256;
const CARRIED: usize = 8;

/// A point of the plane in which the lines are seen.
type Place = [f64; 2];

/// A field whose lines return to the same plane after each turn.
trait Field: ProperlyDegenerate {
    fn state(place: Place) -> Self::State<f64>;
}

impl Field for Abc {
    fn state([x, y]: Place) -> AbcState {
        AbcState { x, y }
    }
}

impl Field for PerturbedTokamak {
    fn state([r, z]: Place) -> PerturbedTokamakState {
        PerturbedTokamakState { r, z }
    }
}

/// The Poincaré map: where the line through `place` is after one turn of `steps` steps.
fn turned<F: Field, M: Method<F, f64>>(field: &F, method: M, steps: u64, place: Place) -> Result<Place> {
    let mut run = Integrator::new(field, method, TAU / steps as f64, F::state(place))?;
    run.take_steps(steps)?;
    Ok([run.q()[0], run.q()[1]])
}

/// The same after each of `count` turns.
fn section<F: Field>(job: &Job<'_>, field: &F, start: Place, count: u64) -> Result<Vec<Place>> {
    let (mut place, mut places) = (start, Vec::new());
    for _ in 0..count {
        if job.is_stopping() {
            job.cut_short();
            break;
        }
        place = turned(field, OneStep::midpoint(), STEPS, place)?;
        places.push(place);
        job.proceed(STEPS);
    }
    Ok(places)
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let turns = job.choose(100_000, 4000);
    let shown = job.choose(1500, 120);
    let [abc, tokamak] = starts();
    job.expect(STEPS * (2 * turns + shown * (abc.len() + tokamak.len()) as u64));
    let abc = abc.into_iter().map(|start| section(job, &ABC, start, shown));
    let abc = abc.collect::<Result<Vec<_>>>()?;
    let tokamak = tokamak.into_iter().map(|start| section(job, &TOKAMAK, start, shown));
    let tokamak = tokamak.collect::<Result<Vec<_>>>()?;
    let surfaces = [
        surface(job, "one step, midpoint", OneStep::midpoint(), turns)?,
        surface(job, "RK4", RungeKutta::classical(), turns)?,
    ];
    let loops = [fluxes(OneStep::midpoint())?, fluxes(RungeKutta::classical())?];
    let claims = vec![on_surfaces(&surfaces), keep_flux(&loops), where_islands_are()?, order()?];
    let table = table(&abc, &tokamak, &surfaces)?;
    job.publish(EXPERIMENT.name, figure(abc, tokamak, &surfaces, turns), table)?;
    Ok(Outcome { claims, references: vec![], notes: vec![] })
}

/// Where the lines of the two plots begin.
fn starts() -> [Vec<Place>; 2] {
    let up = PI / 2.0;
    let around = |y: f64, offsets: &[f64]| -> Vec<Place> {
        let x = if y > 0.0 { 0.0 } else { PI };
        offsets.iter().map(|offset| [x, y + offset]).collect()
    };
    let abc = [
        around(up, &[0.3, 0.6, 0.9, 1.2, 1.5, 1.8]),
        around(-up, &[0.2, 0.6, 0.9, 1.2]),
        vec![[0.0, 0.05 - up]],
    ];
    let (two, three) = (TOKAMAK.resonance(1.0 / 2.0), TOKAMAK.resonance(2.0 / 3.0));
    let inner = [0.05, 0.1, 0.15, 0.2].map(|rho| [1.0 + rho, 0.0]);
    let islands = [0.004, 0.012, 0.02].map(|x| [[1.0 + two + x, 0.0], [1.0 + three + x, 0.0]]);
    // The points between two islands.
    let between = [[1.0, two], [1.0 - three, 0.0]];
    let outer = [[1.4, 0.0], [1.43, 0.0]];
    [abc.concat(), [&inner[..], &islands.concat(), &between, &outer].concat()]
}

/// How well a line of the unperturbed tokamak stays on its surface.
struct Surface {
    name: &'static str,
    /// (ψ − ψ(0))/ψ(0) after each step.
    error: Deviation,
}

fn unperturbed() -> PerturbedTokamak {
    PerturbedTokamak { epsilon: [0.0; 2], ..TOKAMAK }
}

fn surface<M: Method<PerturbedTokamak, f64>>(
    job: &Job<'_>,
    name: &'static str,
    method: M,
    turns: u64,
) -> Result<Surface> {
    let field = unperturbed();
    let start = PerturbedTokamak::state([1.0 + RHO, 0.0]);
    let mut run = Integrator::new(&field, method, TAU / STEPS as f64, start)?;
    let error = Deviation::new(turns as f64, 400, EARLY as f64);
    let mut surface = Surface { name, error };
    job.repeat(turns * STEPS, || {
        run.advance()?;
        let rho = (run.q()[0] - 1.0).hypot(run.q()[1]);
        surface.error.push(run.time() / TAU, field.flux(rho) / field.flux(RHO) - 1.0);
        Ok(())
    })?;
    Ok(surface)
}

fn on_surfaces(surfaces: &[Surface; 2]) -> Claim {
    let text = "lines stay on their surfaces: the flux function is no further off in all turns than in the first 1000";
    let [midpoint, runge_kutta] = surfaces;
    let name = |surface: &Surface| format!("{}: max|Δψ| over all / over 1000 turns", surface.name);
    Claim::new(BEYOND, text).check(name(midpoint), midpoint.error.growth(), Bound::AtMost(1.001)).check(
        name(runge_kutta),
        runge_kutta.error.growth(),
        Bound::AtLeast(3.0),
    )
}

/// The largest relative change of the flux ∮A·dx through loops that are carried along, in the two fields.
fn fluxes<M: Method<Abc, f64> + Method<PerturbedTokamak, f64> + Copy>(method: M) -> Result<[f64; 2]> {
    Ok([flux_change(&ABC, method, [0.3, 1.2], 0.8)?, flux_change(&TOKAMAK, method, [1.15, 0.0], 0.06)?])
}

fn flux_change<F: Field, M: Method<F, f64> + Copy>(
    field: &F,
    method: M,
    [x, y]: Place,
    radius: f64,
) -> Result<f64> {
    let angle = |k: usize| TAU * k as f64 / POINTS as f64;
    let mut circle: Vec<Place> =
        (0..POINTS).map(|k| [x + radius * angle(k).cos(), y + radius * angle(k).sin()]).collect();
    let before = flux(field, &circle);
    let mut largest = 0.0;
    for _ in 0..CARRIED {
        for place in &mut circle {
            *place = turned(field, method, STEPS, *place)?;
        }
        largest = larger(largest, (flux(field, &circle) / before - 1.0).abs());
    }
    Ok(largest)
}

/// ∮A·dx, with the derivative of the trigonometric polynomial through all points: exact for what they
/// resolve.
fn flux<F: Field>(field: &F, circle: &[Place]) -> f64 {
    let derivative = |j: usize| {
        let others = (0..POINTS).filter(|&k| k != j);
        others.fold([0.0; 2], |[x, y], k| {
            let sign = if (j + k).is_multiple_of(2) { 1.0 } else { -1.0 };
            let weight = sign / ((j as f64 - k as f64) * PI / POINTS as f64).tan() * PI / POINTS as f64;
            [x + weight * circle[k][0], y + weight * circle[k][1]]
        })
    };
    let along = |j: usize| {
        let (mut form, [x, y]) = ([0.0; 2], derivative(j));
        field.one_form(&circle[j], 0.0, &mut form);
        form[0] * x + form[1] * y
    };
    (0..POINTS).map(along).sum()
}

fn keep_flux([midpoint, runge_kutta]: &[[f64; 2]; 2]) -> Claim {
    let text = "the flux through a loop that is carried along is kept to rounding errors";
    let names = ["ABC", "tokamak"];
    names.iter().enumerate().fold(Claim::new(BEYOND, text), |claim, (i, name)| {
        let change = |method: &str| format!("{name}, {CARRIED} turns, {method}: largest relative change");
        claim.check(change("one step, midpoint"), midpoint[i], Bound::AtMost(1e-11)).check(
            change("RK4"),
            runge_kutta[i],
            Bound::AtLeast(1e-8),
        )
    })
}

/// 2/1 islands are around lines that close after two turns; without perturbation all lines with q = 2 do.
fn where_islands_are() -> Result<Claim> {
    let text = "lines with q = 2 close after two turns, and with weak perturbations islands are around them";
    let gauss = OneStepGauss::<3>::new();
    let twice = |field: &PerturbedTokamak, place| {
        turned(field, gauss, 2 * STEPS, turned(field, gauss, 2 * STEPS, place)?)
    };
    let rho = TOKAMAK.resonance(0.5);
    let mut gap = 0.0;
    for angle in [0.0f64, 1.0, 2.0, 3.0, 4.0, 5.0] {
        let (sin, cos) = angle.sin_cos();
        let place = [1.0 + rho * cos, rho * sin];
        let [r, z] = twice(&unperturbed(), place)?;
        gap = larger(gap, (r - place[0]).hypot(z - place[1]));
    }
    let mut distances = Vec::new();
    let mut trace = 0.0;
    for part in [1.0 / 8.0, 1.0 / 16.0, 1.0 / 32.0, 1.0 / 64.0] {
        let field = PerturbedTokamak { epsilon: TOKAMAK.epsilon.map(|epsilon| part * epsilon), ..TOKAMAK };
        // R − Z is reversed with φ, so that a line that closes in the plane φ = 0 has Z = 0.
        let height = |x: f64| -> Result<f64> { Ok(twice(&field, [1.0 + x, 0.0])?[1]) };
        let [mut a, mut b] = [rho - 1e-3, rho + 1e-3];
        for _ in 0..8 {
            let [at_a, at_b] = [height(a)?, height(b)?];
            if at_a != at_b {
                (a, b) = (b, b - at_b * (b - a) / (at_b - at_a));
            }
        }
        distances.push((part, (b - rho).abs()));
        let d = 1e-5;
        let [right, left] = [twice(&field, [1.0 + b + d, 0.0])?, twice(&field, [1.0 + b - d, 0.0])?];
        let [above, below] = [twice(&field, [1.0 + b, d])?, twice(&field, [1.0 + b, -d])?];
        trace = larger(trace, ((right[0] - left[0] + above[1] - below[1]) / (2.0 * d)).abs());
    }
    Ok(Claim::new(BEYOND, text)
        .check("unperturbed: largest distance from the start after two turns", gap, Bound::AtMost(1e-7))
        .check(
            "order in ε of the distance of the O-point from q = 2",
            convergence_order(&distances),
            Bound::Near(1.0, 0.1),
        )
        .check("largest |trace| of the map around it, four ε", trace, Bound::AtMost(2.0 - 1e-5)))
}

/// Against Gauss's method of order eight with steps of a tenth, over five turns.
fn order() -> Result<Claim> {
    fn of<F: Field>(field: &F, start: Place) -> Result<Option<f64>> {
        let after =
            |method: &dyn Fn(Place) -> Result<Place>| (0..5).try_fold(start, |place, _| method(place));
        let [x, y] = after(&|place| turned(field, Gauss::<4>::new(), 10 * STEPS, place))?;
        let mut errors = Vec::new();
        for steps in [2 * STEPS, 3 * STEPS, 4 * STEPS] {
            let found = after(&|place| turned(field, OneStep::midpoint(), steps, place))?;
            errors.push((1.0 / steps as f64, (found[0] - x).hypot(found[1] - y)));
        }
        Ok(convergence_order(&errors))
    }
    Ok(Claim::new(BEYOND, "the one-step midpoint scheme is of second order on both fields")
        .check("ABC: order after five turns", of(&ABC, [0.0, 2.2])?, Bound::Near(2.0, 0.05))
        .check("tokamak: order after five turns", of(&TOKAMAK, [1.2, 0.0])?, Bound::Near(2.0, 0.05)))
}

fn figure(abc: Vec<Vec<Place>>, tokamak: Vec<Vec<Place>>, surfaces: &[Surface; 2], turns: u64) -> Figure {
    let dots = |panel: Panel, lines: Vec<Vec<Place>>| {
        lines
            .into_iter()
            .enumerate()
            .fold(panel, |panel, (i, line)| panel.dots(line, 0.7, SEQUENCE[3 * i % SEQUENCE.len()]))
    };
    let angle = |label, low| Axis::linear(label).within(low, low + TAU);
    let plane = Panel::new(
        "ABC flow and a uniform field, plane *z* = 0",
        angle("*x*", -PI / 2.0),
        angle("*y*", -PI),
    );
    // The field is periodic in x and y. The one-form of the scheme is not, and so neither are its errors:
    // lines are folded into one period here and not as they run.
    let folded = |[x, y]: Place| [(x + PI / 2.0).rem_euclid(TAU) - PI / 2.0, (y + PI).rem_euclid(TAU) - PI];
    let abc = abc.into_iter().map(|line| line.into_iter().map(folded).collect());
    let abc = dots(plane.equal(), abc.collect());
    let plane = Panel::new(
        "Perturbed tokamak, plane *φ* = 0",
        Axis::linear("*R*").within(0.53, 1.47),
        Axis::linear("*Z*").within(-0.47, 0.47),
    );
    let circle = |turns: f64| -> Vec<Place> {
        let rho = TOKAMAK.resonance(turns);
        let angles = (0..=180).map(|k| TAU * f64::from(k) / 180.0);
        angles.map(|angle| [1.0 + rho * angle.cos(), rho * angle.sin()]).collect()
    };
    let plane = [2.0 / 3.0, 0.5]
        .map(circle)
        .into_iter()
        .fold(plane.equal(), |plane, circle| plane.line(circle, Stroke::solid(INK).width(0.8)));
    let tokamak = dots(plane.labelled("*q* = 3/2 and *q* = 2"), tokamak);
    let [midpoint, runge_kutta] = surfaces;
    let flux = Panel::new(
        "Distance of a line from its surface, without perturbations",
        Axis::linear("turns around the torus").within(0.0, turns as f64),
        Axis::logarithmic("largest |Δ*ψ*/*ψ*| of each interval").within(1e-5, 1.0),
    )
    .line(midpoint.error.envelope.magnitude(), Stroke::solid(BLUE))
    .labelled(midpoint.name)
    .line(runge_kutta.error.envelope.magnitude(), Stroke::dashed(VERMILLION))
    .labelled(runge_kutta.name);
    Figure::new(
        "Magnetic field lines: Poincaré plots by the one-step midpoint scheme",
        format!("{STEPS} steps a turn; colours tell lines apart. Tokamak: islands at *q* = 2 and *q* = 3/2, *ε* = 10⁻³ and 6·10⁻³"),
    )
    .row(560.0, vec![abc, tokamak])
    .row(280.0, vec![flux.legend_at(Corner::BottomRight)])
    .footer(format!(
        "Largest |Δ*ψ*/*ψ*|: one step {}, RK4 at the end {}.",
        at_most(midpoint.error.largest),
        scientific(runge_kutta.error.largest)
    ))
}

fn table(abc: &[Vec<Place>], tokamak: &[Vec<Place>], surfaces: &[Surface; 2]) -> Result<Table> {
    let mut table =
        Table::new(&["series", "line", "turn", "x or R", "y or Z", "lowest Δψ/ψ", "highest Δψ/ψ"])?;
    for (name, lines) in [("ABC", abc), ("tokamak", tokamak)] {
        for (i, line) in lines.iter().enumerate() {
            for (turn, [x, y]) in line.iter().enumerate() {
                let cells = [name.to_owned(), i.to_string(), (turn + 1).to_string(), number(*x), number(*y)];
                table.row(cells.into_iter().chain([String::new(), String::new()]))?;
            }
        }
    }
    for Surface { name, error, .. } in surfaces {
        for [turn, low, _, high] in error.envelope.rows() {
            let empty = String::new;
            table.row([
                (*name).to_owned(),
                empty(),
                number(turn),
                empty(),
                empty(),
                number(low),
                number(high),
            ])?;
        }
    }
    Ok(table)
}
