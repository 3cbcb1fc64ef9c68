//! Magnetic field lines: Poincaré plots of two fields by a one-step scheme.
//!
//! A field line is the flow of a degenerate Lagrangian whose Ω is the flux of the field. A scheme that
//! preserves Ω keeps the flux through each loop that is carried along, and with it the surfaces, islands and
//! chaotic layers of the field.

use std::f64::consts::FRAC_PI_2;

use dvi_core::ProperlyDegenerate;

use crate::models::{Abc, PerturbedTokamak};
use crate::vocabulary::*;

const ABC: Abc = Abc { a: 0.08, b: 0.3, c: 0.3, uniform: 1.0 };
const TOKAMAK: PerturbedTokamak = PerturbedTokamak { iota: 0.95, shear: 8.0, epsilon: [1e-3, 6e-3] };
const UNPERTURBED: PerturbedTokamak = PerturbedTokamak { epsilon: [0.0; 2], ..TOKAMAK };
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

/// The places at which lines meet that plane.
type Lines = Vec<Vec<Place>>;

/// The Poincaré map: where the line through `place` is after one turn of `steps` steps.
fn turned<F>(field: &F, method: impl Method<F, f64>, steps: u64, [x, y]: Place) -> Result<Place>
where
    F: ProperlyDegenerate<State<f64>: From<(f64, f64)>>,
{
    let mut run = Integrator::new(field, method, TAU / steps as f64, (x, y).into())?;
    run.take_steps(steps)?;
    Ok(place(&run))
}

/// The same after each of `count` turns.
fn section<F>(job: &Job<'_>, field: &F, start: Place, count: u64) -> Result<Vec<Place>>
where
    F: ProperlyDegenerate<State<f64>: From<(f64, f64)>>,
{
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

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let turns = job.choose(100_000, 4000);
    let shown = job.choose(1500, 120);
    let [abc, tokamak] = starts();
    job.expect(STEPS * (2 * turns + shown * (abc.len() + tokamak.len()) as u64));
    let abc = abc.into_iter().map(|start| section(job, &ABC, start, shown)).collect::<Result<Lines>>()?;
    let tokamak = tokamak.into_iter().map(|start| section(job, &TOKAMAK, start, shown));
    let tokamak = tokamak.collect::<Result<Lines>>()?;
    let surfaces = [
        surface(job, "one step, midpoint", Stroke::solid(BLUE), OneStep::midpoint(), turns)?,
        surface(job, "RK4", Stroke::dashed(VERMILLION), RungeKutta::classical(), turns)?,
    ];
    let table = table(&abc, &tokamak, &surfaces)?;
    job.publish(figure(abc, tokamak, &surfaces, turns), table)?;
    let [midpoint, rk4] = surfaces.each_ref().map(|series| series.kept[0].growth());
    let growth = "max|Δψ| over all / over 1000 turns";
    let text = "lines stay on their surfaces: the flux function is no further off in all turns than in the \
                first 1000";
    Ok(vec![
        beyond(text).at_most(format!("one step, midpoint: {growth}"), midpoint, 1.001).at_least(
            format!("RK4: {growth}"),
            rk4,
            3.0,
        ),
        keep_flux()?,
        where_islands_are()?,
        order_on_both()?,
    ]
    .into())
}

/// Where the lines of the two plots begin.
fn starts() -> [Vec<Place>; 2] {
    let around = |y: f64, offsets: &[f64]| -> Vec<Place> {
        let x = if y > 0.0 { 0.0 } else { PI };
        offsets.iter().map(|offset| [x, y + offset]).collect()
    };
    let abc = [
        around(FRAC_PI_2, &[0.3, 0.6, 0.9, 1.2, 1.5, 1.8]),
        around(-FRAC_PI_2, &[0.2, 0.6, 0.9, 1.2]),
        vec![[0.0, 0.05 - FRAC_PI_2]],
    ];
    let (two, three) = (TOKAMAK.resonance(1.0 / 2.0), TOKAMAK.resonance(2.0 / 3.0));
    let inner = [0.05, 0.1, 0.15, 0.2].map(|rho| [1.0 + rho, 0.0]);
    let islands = [0.004, 0.012, 0.02].map(|x| [[1.0 + two + x, 0.0], [1.0 + three + x, 0.0]]);
    // The points between two islands.
    let between = [[1.0, two], [1.0 - three, 0.0]];
    let outer = [[1.4, 0.0], [1.43, 0.0]];
    [abc.concat(), [&inner[..], &islands.concat(), &between, &outer].concat()]
}

/// How well a line of the unperturbed tokamak stays on its surface: (ψ − ψ(0))/ψ(0) after each step.
fn surface(
    job: &Job<'_>,
    name: &str,
    stroke: Stroke,
    method: impl Method<PerturbedTokamak, f64>,
    turns: u64,
) -> Result<Series<1>> {
    let mut run = Integrator::new(&UNPERTURBED, method, TAU / STEPS as f64, (1.0 + RHO, 0.0).into())?;
    let mut kept = Span { end: turns as f64, early: EARLY as f64, intervals: 400 }.deviations();
    job.follow(&mut run, turns * STEPS, |run| {
        let rho = (run.q()[0] - 1.0).hypot(run.q()[1]);
        note(&mut kept, run.time() / TAU, [UNPERTURBED.flux(rho) / UNPERTURBED.flux(RHO) - 1.0]);
    })?;
    Ok(Series::new(name, stroke, kept))
}

/// The largest relative change of the flux ∮A·dx through a loop that is carried along.
fn flux_change<F>(field: &F, method: impl Method<F, f64> + Copy, [x, y]: Place, radius: f64) -> Result<f64>
where
    F: ProperlyDegenerate<State<f64>: From<(f64, f64)>>,
{
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
fn flux<F: ProperlyDegenerate>(field: &F, circle: &[Place]) -> f64 {
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

fn keep_flux() -> Result<Claim> {
    let (one_step, rk4, abc, tokamak) =
        (OneStep::midpoint(), RungeKutta::classical(), [0.3, 1.2], [1.15, 0.0]);
    let changes = [
        ("ABC", flux_change(&ABC, one_step, abc, 0.8)?, flux_change(&ABC, rk4, abc, 0.8)?),
        (
            "tokamak",
            flux_change(&TOKAMAK, one_step, tokamak, 0.06)?,
            flux_change(&TOKAMAK, rk4, tokamak, 0.06)?,
        ),
    ];
    let text = "the flux through a loop that is carried along is kept to rounding errors";
    Ok(beyond(text).each(changes, |claim, (name, midpoint, runge_kutta)| {
        let change = |method: &str| format!("{name}, {CARRIED} turns, {method}: largest relative change");
        claim.at_most(change("one step, midpoint"), midpoint, 1e-11).at_least(
            change("RK4"),
            runge_kutta,
            1e-8,
        )
    }))
}

/// 2/1 islands are around lines that close after two turns; without perturbation all lines with q = 2 do.
fn where_islands_are() -> Result<Claim> {
    let gauss = OneStepGauss::<3>::new();
    let twice = |field: &PerturbedTokamak, place| {
        turned(field, gauss, 2 * STEPS, turned(field, gauss, 2 * STEPS, place)?)
    };
    let rho = TOKAMAK.resonance(0.5);
    let gaps = each([0.0f64, 1.0, 2.0, 3.0, 4.0, 5.0], |angle| {
        let place = [1.0 + rho * angle.cos(), rho * angle.sin()];
        Ok(distance(twice(&UNPERTURBED, place)?, place))
    })?;
    let mut trace = 0.0;
    let order = order_of([1.0 / 8.0, 1.0 / 16.0, 1.0 / 32.0, 1.0 / 64.0], |part| {
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
        let d = 1e-5;
        let [right, left] = each([d, -d], |d| twice(&field, [1.0 + b + d, 0.0]))?;
        let [above, below] = each([d, -d], |d| twice(&field, [1.0 + b, d]))?;
        trace = larger(trace, ((right[0] - left[0] + above[1] - below[1]) / (2.0 * d)).abs());
        Ok((part, (b - rho).abs()))
    })?;
    Ok(beyond("lines with q = 2 close after two turns, and with weak perturbations islands are around them")
        .at_most("unperturbed: largest distance from the start after two turns", largest(gaps), 1e-7)
        .near("order in ε of the distance of the O-point from q = 2", order, [1.0, 0.1])
        .at_most("largest |trace| of the map around it, four ε", trace, 2.0 - 1e-5))
}

/// Against Gauss's method of order eight with steps of a tenth, over five turns.
fn order_on_both() -> Result<Claim> {
    fn of<F: ProperlyDegenerate<State<f64>: From<(f64, f64)>>>(
        field: &F,
        start: Place,
    ) -> Result<Option<f64>> {
        let after = |turn: &dyn Fn(Place) -> Result<Place>| (0..5).try_fold(start, |place, _| turn(place));
        let exact = after(&|place| turned(field, Gauss::<4>::new(), 10 * STEPS, place))?;
        order_of([2 * STEPS, 3 * STEPS, 4 * STEPS], |steps| {
            let found = after(&|place| turned(field, OneStep::midpoint(), steps, place))?;
            Ok((1.0 / steps as f64, distance(found, exact)))
        })
    }
    Ok(beyond("the one-step midpoint scheme is of second order on both fields")
        .near("ABC: order after five turns", of(&ABC, [0.0, 2.2])?, [2.0, 0.05])
        .near("tokamak: order after five turns", of(&TOKAMAK, [1.2, 0.0])?, [2.0, 0.05]))
}

fn figure(abc: Lines, tokamak: Lines, surfaces: &[Series<1>; 2], turns: u64) -> Figure {
    let dots = |panel: Panel, lines: Lines| {
        panel.each(lines.into_iter().enumerate(), |panel, (i, line)| {
            panel.dots(line, 0.7, SEQUENCE[3 * i % SEQUENCE.len()])
        })
    };
    let angle = |label, low| Axis::linear(label).within(low, low + TAU);
    let plane = Panel::new(
        "ABC flow and a uniform field, plane *z* = 0",
        angle("*x*", -FRAC_PI_2),
        angle("*y*", -PI),
    );
    // The field is periodic in x and y. The one-form of the scheme is not, and so neither are its errors:
    // lines are folded into one period here and not as they run.
    let folded =
        |[x, y]: Place| [(x + FRAC_PI_2).rem_euclid(TAU) - FRAC_PI_2, (y + PI).rem_euclid(TAU) - PI];
    let abc = abc.into_iter().map(|line| line.into_iter().map(folded).collect());
    let abc = dots(plane.equal(), abc.collect());
    let (r, z) = (Axis::linear("*R*").within(0.53, 1.47), Axis::linear("*Z*").within(-0.47, 0.47));
    let plane = Panel::new("Perturbed tokamak, plane *φ* = 0", r, z).equal().each(
        [2.0 / 3.0, 0.5],
        |plane, turns| {
            plane.line(circle([1.0, 0.0], TOKAMAK.resonance(turns)), Stroke::solid(INK).width(0.8))
        },
    );
    let tokamak = dots(plane.labelled("*q* = 3/2 and *q* = 2"), tokamak);
    let time = Axis::linear("turns around the torus").within(0.0, turns as f64);
    let axis = Axis::logarithmic("largest |Δ*ψ*/*ψ*| of each interval").within(1e-5, 1.0);
    let flux = Panel::new("Distance of a line from its surface, without perturbations", time, axis);
    let flux = flux.lines(magnitudes(surfaces, 0)).legend_at(Corner::BottomRight);
    let [midpoint, rk4] = surfaces.each_ref().map(|series| series.kept[0].largest);
    Figure::new(
        "Magnetic field lines: Poincaré plots by the one-step midpoint scheme",
        format!(
            "{STEPS} steps a turn; colours tell lines apart. Tokamak: islands at *q* = 2 and *q* = \
                 3/2, *ε* = 10⁻³ and 6·10⁻³"
        ),
    )
    .row(560.0, vec![abc, tokamak])
    .row(280.0, vec![flux])
    .footer(format!(
        "Largest |Δ*ψ*/*ψ*|: one step {}, RK4 at the end {}.",
        at_most(midpoint),
        scientific(rk4)
    ))
}

fn table(abc: &Lines, tokamak: &Lines, surfaces: &[Series<1>; 2]) -> Result<Table> {
    let lines = [("ABC", abc), ("tokamak", tokamak)].into_iter().flat_map(|(name, lines)| {
        lines.iter().enumerate().flat_map(move |(i, line)| {
            let row = move |(turn, &[x, y]): (usize, &Place)| {
                [Some(i as f64), Some((turn + 1) as f64), Some(x), Some(y), None, None]
            };
            line.iter().enumerate().map(row).map(move |row| ([name.to_owned()], row))
        })
    });
    let flux = surfaces.iter().flat_map(|series| {
        let rows = ranges([&series.name], &series.kept[0].envelope);
        rows.map(|(name, [turn, low, _, high])| {
            (name, [None, Some(turn), None, None, Some(low), Some(high)])
        })
    });
    let columns = ["series", "line", "turn", "x or R", "y or Z", "lowest Δψ/ψ", "highest Δψ/ψ"];
    Table::of(&columns, lines.chain(flux))
}
