//! Magnetic field lines: Poincaré plots of two fields by a one-step scheme.
//!
//! A field line is the flow of a degenerate Lagrangian whose Ω is the flux of the field. A scheme that
//! preserves Ω keeps the flux through each loop that is carried along, and with it the surfaces, islands and
//! chaotic layers of the field.

use super::poincare_map::{Field, Place, STEPS, flux_changes, turned, where_islands_are};
use crate::vocabulary::*;

const ABC: Abc = Abc { a: 0.08, b: 0.3, c: 0.3, uniform: 1.0 };
pub const TOKAMAK: PerturbedTokamak = PerturbedTokamak { iota: 0.95, shear: 8.0, epsilon: [1e-3, 6e-3] };
pub const UNPERTURBED: PerturbedTokamak = PerturbedTokamak { epsilon: [0.0; 2], ..TOKAMAK };
/// The line of the unperturbed field that is followed for long: its distance from the axis.
const RHO: f64 = 0.25;

/// The places at which lines meet the plane in which they are seen.
type Lines = Vec<Vec<Place>>;

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let (turns, shown) = (job.choose(100_000, 4000), job.choose(1500, 120));
    let [abc, tokamak] = starts();
    let (abc, tokamak) = (lines(&ABC, abc, shown)?, lines(&TOKAMAK, tokamak, shown)?);
    // How well a line of the unperturbed tokamak stays on its surface: (ψ − ψ(0))/ψ(0) after each step.
    let line = Problem::new(&UNPERTURBED, (1.0 + RHO, 0.0));
    let runs = [
        (("one step, midpoint", solid(BLUE)), line.any(OneStep::midpoint(), TAU / STEPS as f64)?),
        (("RK4", dashed(VERMILLION)), line.any(RungeKutta::classical(), TAU / STEPS as f64)?),
    ];
    let surfaces = each(runs, |(named, mut run)| {
        let mut kept = Span { end: turns as f64, early: 1000.0, intervals: 400 }.envelopes();
        job.follow(&mut run, turns * STEPS, |run| {
            let rho = (run.q()[0] - 1.0).hypot(run.q()[1]);
            note(&mut kept, run.time() / TAU, [UNPERTURBED.flux(rho) / UNPERTURBED.flux(RHO) - 1.0]);
        })?;
        Ok(Series::new(named, run.step_size(), kept))
    })?;
    let table = table(&abc, &tokamak, &surfaces);
    job.publish(figure(abc, tokamak, &surfaces, turns), table)?;
    let [midpoint, rk4] = surfaces.each_ref().map(|series: &Series<1>| series.kept[0].growth());
    let growth = "max|Δψ| over all / over 1000 turns";
    let stay = "lines stay on their surfaces: the flux function is no further off in all turns than in the \
                first 1000";
    let changes = [
        ("ABC", flux_changes(&ABC, [0.3, 1.2], 0.8)?),
        ("tokamak", flux_changes(&TOKAMAK, [1.15, 0.0], 0.06)?),
    ];
    let flux = beyond("the flux through a loop that is carried along is kept to rounding errors");
    let change = |name, method| format!("{name}, 8 turns, {method}: largest relative change");
    claims([
        beyond(stay)
            .of("one step, midpoint")
            .at_most(growth, midpoint, 1.001)
            .of("RK4")
            .at_least(growth, rk4, 3.0),
        flux.each(changes, |claim, (name, [midpoint, runge_kutta])| {
            let claim = claim.at_most(change(name, "one step, midpoint"), midpoint, 1e-11);
            claim.at_least(change(name, "RK4"), runge_kutta, 1e-8)
        }),
        where_islands_are()?,
        beyond("the one-step midpoint scheme is of second order on both fields")
            .near("ABC: order after five turns", order_on(&ABC, [0.0, 2.2])?, [2.0, 0.05])
            .near("tokamak: order after five turns", order_on(&TOKAMAK, [1.2, 0.0])?, [2.0, 0.05]),
    ])
}

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
    [abc.concat(), [&inner[..], &islands.concat(), &between, &[[1.4, 0.0], [1.43, 0.0]]].concat()]
}

/// Where the lines through `starts` meet the plane after each of `count` turns.
fn lines(field: &impl Field, starts: Vec<Place>, count: u64) -> Result<Lines> {
    let line = |mut place| {
        let turn = |_| {
            place = turned(field, OneStep::midpoint(), STEPS, place)?;
            Ok(place)
        };
        (0..count).map(turn).collect()
    };
    starts.into_iter().map(line).collect()
}

/// Against Gauss's method of order eight with steps of a tenth, over five turns.
fn order_on(field: &impl Field, start: Place) -> Result<Option<f64>> {
    let after = |turn: &dyn Fn(Place) -> Result<Place>| (0..5).try_fold(start, |place, _| turn(place));
    let exact = after(&|place| turned(field, Gauss::<4>::new(), 10 * STEPS, place))?;
    order_of([2 * STEPS, 3 * STEPS, 4 * STEPS], |steps| {
        let found = after(&|place| turned(field, OneStep::midpoint(), steps, place))?;
        Ok((1.0 / steps as f64, distance(found, exact)))
    })
}

fn figure(abc: Lines, tokamak: Lines, surfaces: &[Series<1>; 2], turns: u64) -> Figure {
    let dots = |panel: Panel, lines: Lines| {
        let colours = SEQUENCE.into_iter().cycle().step_by(3);
        panel.each(lines.into_iter().zip(colours), |panel, (line, colour)| panel.dots(line, 0.7, colour))
    };
    let period = |low| [low, low + TAU];
    let (x, y) = (("*x*", period(-FRAC_PI_2)), ("*y*", period(-PI)));
    let plane = Panel::window("ABC flow and a uniform field, plane *z* = 0", x, y);
    // The field is periodic in x and y. The one-form of the scheme is not, and so neither are its errors:
    // lines are folded into one period here and not as they run.
    let fold = |[x, y]: Place| [(x + FRAC_PI_2).rem_euclid(TAU) - FRAC_PI_2, (y + PI).rem_euclid(TAU) - PI];
    let abc = abc.into_iter().map(|line| line.into_iter().map(fold).collect());
    let abc = dots(plane, abc.collect());
    let (r, z) = (("*R*", [0.53, 1.47]), ("*Z*", [-0.47, 0.47]));
    let plane = Panel::window("Perturbed tokamak, plane *φ* = 0", r, z);
    let plane = plane.each([2.0 / 3.0, 0.5], |plane, turns| {
        plane.line(circle([1.0, 0.0], TOKAMAK.resonance(turns)), solid(INK).width(0.8))
    });
    let tokamak = dots(plane.labelled("*q* = 3/2 and *q* = 2"), tokamak);
    let title = "Distance of a line from its surface, without perturbations";
    let time = ("turns around the torus", [0.0, turns as f64]);
    let flux = Panel::semilog(title, time, ("largest |Δ*ψ*/*ψ*| of each interval", [1e-5, 1.0]));
    let flux = flux.lines(magnitudes(surfaces, 0)).legend_at(Corner::BottomRight);
    let subtitle = "24 steps a turn; colours tell lines apart. Tokamak: islands at *q* = 2 and *q* = 3/2, \
                    *ε* = 10⁻³ and 6·10⁻³";
    Figure::of(subtitle).row(560.0, vec![abc, tokamak]).row(280.0, vec![flux])
}

fn table(abc: &Lines, tokamak: &Lines, surfaces: &[Series<1>; 2]) -> Result<Table> {
    let lines = [("ABC", abc), ("tokamak", tokamak)].into_iter().flat_map(|(name, lines)| {
        lines.iter().zip(0..).flat_map(move |(line, i)| {
            line.iter().zip(1..).map(move |(&[x, y], turn)| {
                let [i, turn] = [i, turn].map(|n| Some(f64::from(n)));
                (name, [i, turn, Some(x), Some(y), None, None])
            })
        })
    });
    let flux = surfaces.iter().flat_map(|Series { name, kept, .. }| {
        let row = |[turn, low, _, high]: [f64; 4]| [None, Some(turn), None, None, Some(low), Some(high)];
        kept[0].rows().into_iter().map(move |of| (name.as_str(), row(of)))
    });
    let rows = lines.chain(flux).map(|(name, row)| ([name], row));
    Table::of("series,line,turn,x or R,y or Z,lowest Δψ/ψ,highest Δψ/ψ", rows)
}
