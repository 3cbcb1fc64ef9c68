//! How rounding errors add up over many steps, with plain and with compensated sums.
//!
//! What each run should conserve exactly is looked at: the energy of an oscillator with σ = ½; p² + ω²(1 −
//! (ωh/2)²)q² of an oscillator with Störmer and Verlet's method; ½ΣΓ|z|² of vortices with σ = ½; the angular
//! momentum of a Kepler orbit with Störmer and Verlet's. Errors of independent roundings grow as √n (Brouwer
//! 1937). A plain sum rounds the coordinates, in units of ε|q|; a compensated one the increments, in units
//! of εh|q'|.

use anyhow::Result;
use dvi_core::prelude::*;
use rayon::prelude::*;

use crate::claim::{BEYOND, Bound, Claim};
use crate::figure::{Axis, BLUE, Corner, Figure, Panel, SLATE, Stroke, VERMILLION, scientific};
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{self, Case, Kepler, Orbit, Rotation, RotationState, Spring, SpringState};
use crate::output::{Table, number};

pub const EXPERIMENT: Experiment = Experiment {
    name: "round-off",
    title: "Rounding errors of long runs, with plain and with compensated sums",
    share: 150.0,
    run,
};

/// [steps, error] in intervals of the logarithm of the steps.
type Rows = Vec<[f64; 2]>;

const H: f64 = 0.1;
/// Runs from different points, over which the square of the error is averaged.
const RUNS: usize = 4;
/// An odd number of steps from look to look, so that no phase of the motion is preferred.
const STRIDE: u64 = 37;
const PER_DECADE: f64 = 8.0;
/// From here on growth is measured.
const FIRST: f64 = 1e4;

/// A quantity that a method conserves but for rounding.
struct Conserved {
    name: &'static str,
    title: &'static str,
    is_energy: bool,
    /// Fewer steps where they are dear: the share of the most that are taken.
    share: f64,
    errors: fn(&Job<'_>, Summation, usize, u64) -> Result<Rows>,
}

#[rustfmt::skip]
const CASES: [Conserved; 4] = [
    Conserved { name: "oscillator, σ = ½",  title: "Energy of an oscillator, σ = ½", is_energy: true, share: 1.0, errors: rotation },
    Conserved { name: "oscillator, Verlet", title: "Energy of an oscillator, Störmer–Verlet", is_energy: true, share: 1.0, errors: spring },
    Conserved { name: "vortices, σ = ½",    title: "ΣΓ|*z*|² of four vortices, σ = ½", is_energy: false, share: 0.1, errors: vortices },
    Conserved { name: "Kepler, Verlet",     title: "Angular momentum on a Kepler orbit, Störmer–Verlet", is_energy: false, share: 1.0, errors: kepler },
];

/// The root mean square of the relative error over several runs.
struct Series {
    case: usize,
    summation: Summation,
    rows: Rows,
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(100_000_000, 1_000_000_u64);
    let of_case = |case: &Conserved| (steps as f64 * case.share) as u64;
    job.expect(CASES.iter().map(|case| 2 * RUNS as u64 * of_case(case)).sum());
    let mut all: Vec<(usize, Summation, usize)> = Vec::new();
    for case in 0..CASES.len() {
        for summation in [Summation::Plain, Summation::Compensated] {
            all.extend((0..RUNS).map(|run| (case, summation, run)));
        }
    }
    let one = |&(case, summation, run): &(usize, Summation, usize)| {
        (CASES[case].errors)(job, summation, run, of_case(&CASES[case]))
    };
    let errors: Vec<Rows> = all.par_iter().map(one).collect::<Result<_>>()?;
    let series: Vec<Series> = all
        .chunks(RUNS)
        .zip(errors.chunks(RUNS))
        .map(|(keys, runs)| Series { case: keys[0].0, summation: keys[0].1, rows: mean(runs) })
        .collect();
    job.publish(EXPERIMENT.name, figure(&series, steps as f64), table(&series)?)?;
    Ok(Outcome { claims: claims(job, &series), references: vec![], notes: notes(&series) })
}

/// The root of the mean square over runs, as far as all of them have come.
fn mean(runs: &[Rows]) -> Rows {
    let len = runs.iter().map(Vec::len).min().unwrap_or(0);
    let square = |k: usize| runs.iter().map(|run| run[k][1] * run[k][1]).sum::<f64>() / runs.len() as f64;
    (0..len).map(|k| [runs[0][k][0], square(k).sqrt()]).collect()
}

/// The root mean square of (f − f(0))/f(0) in each interval of the logarithm of the number of steps.
fn follow<R: Run<Scalar = f64>>(
    job: &Job<'_>,
    mut run: R,
    steps: u64,
    value: impl Fn(&R) -> f64,
) -> Result<Rows> {
    let (initial, mut rows) = (value(&run), Vec::new());
    let (mut squares, mut looks, mut interval) = (0.0, 0_u64, (STRIDE as f64).log10() * PER_DECADE);
    let mut reported = 0;
    while run.steps() + STRIDE <= steps {
        if job.is_stopping() {
            job.cut_short();
            break;
        }
        run.take_steps(STRIDE)?;
        let error = (value(&run) - initial) / initial;
        squares += error * error;
        looks += 1;
        if (run.steps() as f64).log10() * PER_DECADE >= interval {
            rows.push([run.steps() as f64, (squares / looks as f64).sqrt()]);
            (squares, looks, interval) = (0.0, 0, interval + 1.0);
        }
        if run.steps() - reported >= 1_000_000 {
            job.proceed(run.steps() - reported);
            reported = run.steps();
        }
    }
    job.proceed(steps - reported);
    Ok(rows)
}

/// The angle at which run number `run` begins.
fn phase(run: usize) -> f64 {
    0.2 + 1.1 * run as f64
}

fn rotation(job: &Job<'_>, summation: Summation, run: usize, steps: u64) -> Result<Rows> {
    let (y, x) = phase(run).sin_cos();
    let method = Sigma { summation, ..Sigma::midpoint() };
    let run = Integrator::new(&Rotation { omega: 1.0 }, method, H, RotationState { x, y })?;
    follow(job, run, steps, |run| run.energy())
}

fn spring(job: &Job<'_>, summation: Summation, run: usize, steps: u64) -> Result<Rows> {
    let (dot_x, x) = phase(run).sin_cos();
    let method = Variational { summation, ..Variational::trapezoid() };
    let run = Integrator::new(&Spring { k: 1.0 }, method, H, SpringState { x, dot_x })?;
    follow(job, run, steps, |run| {
        let (q, p) = (run.q()[0], run.memory().p()[0]);
        p * p + (1.0 - H * H / 4.0) * q * q
    })
}

fn vortices(job: &Job<'_>, summation: Summation, run: usize, steps: u64) -> Result<Rows> {
    const ANGULAR: usize = 2;
    let Case { vortices, mut start } = models::quasi_periodic();
    let (sin, cos) = phase(run).sin_cos();
    for (x, y) in start.x.iter_mut().zip(start.y.iter_mut()) {
        (*x, *y) = (cos * *x - sin * *y, sin * *x + cos * *y);
    }
    let run = Integrator::new(&vortices, Sigma { summation, ..Sigma::midpoint() }, H, start)?;
    follow(job, run, steps, |run| run.momentum(ANGULAR).unwrap_or(f64::NAN))
}

fn kepler(job: &Job<'_>, summation: Summation, run: usize, steps: u64) -> Result<Rows> {
    let start = Orbit { e: 0.1 + 0.1 * run as f64 }.pericentre();
    let method = Variational { summation, ..Variational::trapezoid() };
    let run = Integrator::new(&Kepler {}, method, H, start)?;
    follow(job, run, steps, |run| run.momentum(0).unwrap_or(f64::NAN))
}

impl Series {
    /// The exponent of the growth with the number of steps, by least squares.
    fn exponent(&self) -> Option<f64> {
        let rows = self.rows.iter().filter(|[n, error]| *n >= FIRST && *error > 0.0);
        convergence_order(&rows.map(|&[n, error]| (n, error)).collect::<Vec<_>>())
    }

    fn last(&self) -> Option<[f64; 2]> {
        self.rows.last().copied()
    }
}

/// The plain and the compensated series of each case.
fn pairs(series: &[Series]) -> impl Iterator<Item = [&Series; 2]> {
    series.chunks(2).filter_map(|pair| match pair {
        [plain, compensated] => Some([plain, compensated]),
        _ => None,
    })
}

fn claims(job: &Job<'_>, series: &[Series]) -> Vec<Claim> {
    let mut growth = Claim::new(
        BEYOND,
        "with compensated sums the errors of the energy of oscillators grow with √n over 10⁸ steps, as independent ones do",
    );
    let mut gain =
        Claim::new(BEYOND, "with compensated sums they are at most a fifth of those of plain sums");
    for [plain, compensated] in pairs(series) {
        let name = CASES[plain.case].name;
        let exponent = compensated.exponent().and_then(|exponent| job.only_full(exponent));
        if CASES[plain.case].is_energy {
            growth = growth.check(format!("{name}: exponent of growth"), exponent, Bound::Within(0.3, 0.7));
        }
        let ratio = plain.last().zip(compensated.last()).map(|(plain, other)| other[1] / plain[1]);
        gain = gain.check(format!("{name}: compensated/plain, at the end"), ratio, Bound::AtMost(0.2));
    }
    vec![growth, gain]
}

fn notes(series: &[Series]) -> Vec<String> {
    let mut notes = Vec::new();
    for [plain, compensated] in pairs(series) {
        let name = CASES[plain.case].name;
        let (Some(plain), Some(exponent), Some([n, error])) =
            (plain.exponent(), compensated.exponent(), compensated.last())
        else {
            continue;
        };
        let unit = f64::EPSILON * H * n.sqrt();
        notes.push(format!(
            "{name}: errors grow as n^{plain:.2} with plain and as n^{exponent:.2} with compensated sums; what is left \
             after {} steps is {:.2} εh√n.",
            scientific(n),
            error / unit
        ));
    }
    notes.push(
        "What compensation leaves are the roundings of the increments and of the forces in them, each some εh; a plain \
         sum rounds coordinates, by some ε, and where these roundings do not cancel in the mean, as where an implicit \
         equation is solved from one side, their sum grows with n and not with √n."
            .to_owned(),
    );
    notes
}

fn figure(series: &[Series], steps: f64) -> Figure {
    let panel = |[plain, compensated]: [&Series; 2]| {
        let x = Axis::logarithmic("number of steps *n*").within(100.0, steps);
        let y = Axis::logarithmic("relative error, root mean square").within(1e-17, 1e-10);
        let guide = |exponent: f64| {
            let at = |n: f64| 0.1 * f64::EPSILON * H * n.powf(exponent);
            vec![[100.0, at(100.0)], [steps, at(steps)]]
        };
        Panel::new(CASES[plain.case].title, x, y)
            .line(plain.rows.clone(), Stroke::solid(VERMILLION))
            .labelled("plain sums")
            .line(compensated.rows.clone(), Stroke::solid(BLUE))
            .labelled("compensated sums")
            .line(guide(0.5), Stroke::dashed(SLATE).width(1.2))
            .labelled("0.1 ε*h*√*n*")
            .legend_at(Corner::TopLeft)
    };
    let mut panels: Vec<Panel> = pairs(series).map(panel).collect();
    let below = panels.split_off(2);
    Figure::new(
        "Rounding errors of what a method conserves, *h* = 0.1",
        format!(
            "root mean square over {RUNS} runs from different points, in intervals of the logarithm of *n*"
        ),
    )
    .row(330.0, panels)
    .row(330.0, below)
}

fn table(all: &[Series]) -> Result<Table> {
    let mut table = Table::new(&["quantity", "sums", "steps", "error"])?;
    for Series { case, summation, rows } in all {
        for row in rows {
            let key = [CASES[*case].name.to_owned(), format!("{summation:?}").to_lowercase()];
            table.row(key.into_iter().chain(row.map(number)))?;
        }
    }
    Ok(table)
}
