//! How rounding errors add up over many steps, with plain and with compensated sums.
//!
//! What each run should conserve exactly is looked at: the energy of an oscillator with σ = ½; p² + ω²(1 −
//! (ωh/2)²)q² of an oscillator with Störmer and Verlet's method; ½ΣΓ|z|² of vortices with σ = ½; the angular
//! momentum of a Kepler orbit with Störmer and Verlet's. Errors of independent roundings grow as √n (Brouwer
//! 1937). A plain sum rounds the coordinates, in units of ε|q|; a compensated one the increments, in units
//! of εh|q'|.

use rayon::prelude::*;

use crate::models::{self, Case, Kepler, Orbit, Rotation, RotationState, Spring, SpringState};
use crate::vocabulary::*;

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

/// The root mean square of the relative error over several runs, with plain and with compensated sums.
type Pair = [Rows; 2];

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(100_000_000, 1_000_000_u64);
    let of_case = |case: &Conserved| (steps as f64 * case.share) as u64;
    job.expect(CASES.iter().map(|case| 2 * RUNS as u64 * (of_case(case) / STRIDE)).sum());
    // Two sums of each case, and so many runs of each sum.
    let one = |number: usize| {
        let (case, run) = (&CASES[number / (2 * RUNS)], number % RUNS);
        let summation = [Summation::Plain, Summation::Compensated][number / RUNS % 2];
        (case.errors)(job, summation, run, of_case(case))
    };
    let all = (0..2 * RUNS * CASES.len()).into_par_iter().map(one).collect::<Result<Vec<Rows>>>()?;
    let pairs = each([0, 1, 2, 3], |case| {
        Ok([2 * case, 2 * case + 1].map(|sum| mean(&all[RUNS * sum..RUNS * (sum + 1)])))
    })?;
    let rows = CASES.iter().zip(&pairs).flat_map(|(case, pair)| {
        let both = ["plain", "compensated"].into_iter().zip(pair);
        both.flat_map(move |(sums, rows)| rows.iter().map(move |row| ([case.name, sums], *row)))
    });
    job.publish(figure(&pairs, steps as f64), Table::of(&["quantity", "sums", "steps", "error"], rows)?)?;
    Ok(Outcome { claims: claims(job, &pairs), references: vec![], notes: notes(&pairs) })
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
    let (initial, mut rows, mut interval) = (value(&run), Vec::new(), (STRIDE as f64).log10() * PER_DECADE);
    let (mut squares, mut looks) = (0.0, 0_u64);
    job.repeat(steps / STRIDE, || {
        run.take_steps(STRIDE)?;
        let error = (value(&run) - initial) / initial;
        squares += error * error;
        looks += 1;
        if (run.steps() as f64).log10() * PER_DECADE >= interval {
            rows.push([run.steps() as f64, (squares / looks as f64).sqrt()]);
            (squares, looks, interval) = (0.0, 0, interval + 1.0);
        }
        Ok(())
    })?;
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

/// The exponent of the growth with the number of steps, by least squares.
fn exponent(rows: &Rows) -> Option<f64> {
    order(rows.iter().filter(|[n, error]| *n >= FIRST && *error > 0.0).map(|&[n, error]| (n, error)))
}

fn claims(job: &Job<'_>, pairs: &[Pair; 4]) -> Vec<Claim> {
    let cases = || CASES.iter().zip(pairs);
    let growth = "with compensated sums the errors of the energy of oscillators grow with √n over 10⁸ \
                  steps, as independent ones do";
    let energies = cases().filter(|(case, _)| case.is_energy);
    let smaller = beyond("with compensated sums they are at most a fifth of those of plain sums");
    vec![
        beyond(growth).each(energies, |claim, (case, [_, compensated])| {
            let exponent = job.only_full(exponent(compensated));
            claim.of(case.name).within("exponent of growth", exponent, [0.3, 0.7])
        }),
        smaller.each(cases(), |claim, (case, [plain, compensated])| {
            let ratio = plain.last().zip(compensated.last()).map(|(plain, other)| other[1] / plain[1]);
            claim.of(case.name).at_most("compensated/plain, at the end", ratio, 0.2)
        }),
    ]
}

fn notes(pairs: &[Pair; 4]) -> Vec<String> {
    let note = |(case, [plain, compensated]): (&Conserved, &Pair)| {
        let (plain, by_compensation) = (exponent(plain)?, exponent(compensated)?);
        let &[n, error] = compensated.last()?;
        Some(format!(
            "{}: errors grow as n^{plain:.2} with plain and as n^{by_compensation:.2} with compensated \
             sums; what is left after {} steps is {:.2} εh√n.",
            case.name,
            scientific(n),
            error / (f64::EPSILON * H * n.sqrt())
        ))
    };
    let what_is_left = "What compensation leaves are the roundings of the increments and of the forces in \
                        them, each some εh; a plain sum rounds coordinates, by some ε, and where these \
                        roundings do not cancel in the mean, as where an implicit equation is solved from \
                        one side, their sum grows with n and not with √n.";
    CASES.iter().zip(pairs).filter_map(note).chain([what_is_left.to_owned()]).collect()
}

fn figure(pairs: &[Pair; 4], steps: f64) -> Figure {
    let at = |n: f64| [n, 0.1 * f64::EPSILON * H * n.powf(0.5)];
    let panel = |(case, [plain, compensated]): (&Conserved, &Pair)| {
        let x = Axis::logarithmic("number of steps *n*").within(100.0, steps);
        let y = Axis::logarithmic("relative error, root mean square").within(1e-17, 1e-10);
        Panel::new(case.title, x, y)
            .line(plain.clone(), Stroke::solid(VERMILLION))
            .labelled("plain sums")
            .line(compensated.clone(), Stroke::solid(BLUE))
            .labelled("compensated sums")
            .line(vec![at(100.0), at(steps)], Stroke::dashed(SLATE).width(1.2))
            .labelled("0.1 ε*h*√*n*")
            .legend_at(Corner::TopLeft)
    };
    let panels = || CASES.iter().zip(pairs).map(panel);
    Figure::of(format!(
        "root mean square over {RUNS} runs from different points, in intervals of the logarithm of *n*"
    ))
    .row(330.0, panels().take(2).collect())
    .row(330.0, panels().skip(2).collect())
}
