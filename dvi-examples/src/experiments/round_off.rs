//! How rounding errors add up over many steps, with plain and with compensated sums.
//!
//! What each run should conserve exactly is looked at: the energy of an oscillator with σ = ½; p² + ω²(1 −
//! (ωh/2)²)q² of an oscillator with Störmer and Verlet's method; ½ΣΓ|z|² of vortices with σ = ½; the angular
//! momentum of a Kepler orbit with Störmer and Verlet's. Errors of independent roundings grow as √n (Brouwer
//! 1937). A plain sum rounds the coordinates, in units of ε|q|; a compensated one the increments, in units
//! of εh|q'|.

use crate::vocabulary::*;

const H: f64 = 0.1;
/// Runs from different points, over which the square of the error is averaged.
const RUNS: [usize; 4] = [0, 1, 2, 3];
/// An odd number of steps from look to look, so that no phase of the motion is preferred.
const STRIDE: u64 = 37;
const PER_DECADE: f64 = 8.0;

/// What is conserved but for rounding, with its title, and the share of the steps that are taken. The first
/// two are energies.
const CASES: [(&str, &str, f64); 4] = [
    ("oscillator, σ = ½", "Energy of an oscillator, σ = ½", 1.0),
    ("oscillator, Verlet", "Energy of an oscillator, Störmer–Verlet", 1.0),
    ("vortices, σ = ½", "ΣΓ|*z*|² of four vortices, σ = ½", 0.1),
    ("Kepler, Verlet", "Angular momentum on a Kepler orbit, Störmer–Verlet", 1.0),
];

/// The root mean square of the relative error over several runs, with plain and with compensated sums.
type Pair = [Points; 2];

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(100_000_000, 1_000_000_u64);
    let of_case = |case: usize| (steps as f64 * CASES[case].2) as u64 / STRIDE;
    job.expect((0..4).map(|case| (2 * RUNS.len()) as u64 * of_case(case)).sum());
    let pairs: [Pair; 4] = side_by_side([0, 1, 2, 3], |case| {
        side_by_side([Summation::Plain, Summation::Compensated], |summation| {
            let runs = side_by_side(RUNS, |run| errors(job, case, summation, run, of_case(case)))?;
            // As far as all of them have come.
            let len = runs.iter().map(Vec::len).min().unwrap_or(0);
            let square = |k: usize| runs.iter().map(|run| run[k][1] * run[k][1]).sum::<f64>() / 4.0;
            Ok((0..len).map(|k| [runs[0][k][0], square(k).sqrt()]).collect())
        })
    })?;
    let curves = CASES.iter().zip(&pairs).flat_map(|((name, ..), pair)| {
        ["plain", "compensated"].into_iter().zip(pair).map(move |(sums, of)| ([*name, sums], [], of.clone()))
    });
    job.publish(figure(&pairs, steps as f64), curve_table("quantity,sums,steps,error", curves))?;
    let cases = || CASES.iter().zip(&pairs);
    let growth = "with compensated sums the errors of the energy of oscillators grow with √n over 10⁸ \
                  steps, as independent ones do";
    let fifth = "with compensated sums they are at most a fifth of those of plain sums";
    let claims = vec![
        beyond(growth).each(cases().take(2), |claim, ((name, ..), [_, compensated])| {
            claim.of(name).within("exponent of growth", job.only_full(exponent(compensated)), [0.3, 0.7])
        }),
        beyond(fifth).each(cases(), |claim, ((name, ..), [plain, compensated])| {
            let ratio = plain.last().zip(compensated.last()).map(|(plain, other)| other[1] / plain[1]);
            claim.of(name).at_most("compensated/plain, at the end", ratio, 0.2)
        }),
    ];
    Ok(Outcome { claims, references: vec![], notes: notes(&pairs) })
}

/// The errors of the run of a case that begins at its own angle, with so many looks.
fn errors(job: &Job<'_>, case: usize, summation: Summation, run: usize, looks: u64) -> Result<Points> {
    let (sin, cos) = (0.2 + 1.1 * run as f64).sin_cos();
    let midpoint = Sigma { summation, ..Sigma::midpoint() };
    let verlet = Variational { summation, ..Variational::trapezoid() };
    match case {
        0 => {
            let start = RotationState { x: cos, y: sin };
            let run = Integrator::new(&Rotation { omega: 1.0 }, midpoint, H, start)?;
            watch(job, run, looks, |run| run.energy())
        }
        1 => {
            let run = Integrator::new(&Spring { k: 1.0 }, verlet, H, SpringState { x: cos, dot_x: sin })?;
            watch(job, run, looks, |run| {
                let (q, p) = (run.q()[0], run.memory().p()[0]);
                p * p + (1.0 - H * H / 4.0) * q * q
            })
        }
        2 => {
            let Case { vortices, mut start } = models::quasi_periodic();
            for (x, y) in start.x.iter_mut().zip(&mut start.y) {
                (*x, *y) = (cos * *x - sin * *y, sin * *x + cos * *y);
            }
            let run = Integrator::new(&vortices, midpoint, H, start)?;
            watch(job, run, looks, |run| run.momentum(2).unwrap_or(f64::NAN))
        }
        _ => {
            let start = Orbit { e: 0.1 + 0.1 * run as f64 }.pericentre();
            let run = Integrator::new(&Kepler {}, verlet, H, start)?;
            watch(job, run, looks, |run| run.momentum(0).unwrap_or(f64::NAN))
        }
    }
}

/// The root mean square of (f − f(0))/f(0) in each interval of the logarithm of the number of steps.
fn watch<R: Run<Scalar = f64>>(job: &Job<'_>, mut run: R, n: u64, of: impl Fn(&R) -> f64) -> Result<Points> {
    let (initial, mut rows, mut interval) = (of(&run), Vec::new(), (STRIDE as f64).log10() * PER_DECADE);
    let (mut squares, mut count) = (0.0, 0_u64);
    job.repeat(n, || {
        run.take_steps(STRIDE)?;
        squares += ((of(&run) - initial) / initial).powi(2);
        count += 1;
        if (run.steps() as f64).log10() * PER_DECADE >= interval {
            rows.push([run.steps() as f64, (squares / count as f64).sqrt()]);
            (squares, count, interval) = (0.0, 0, interval + 1.0);
        }
        anyhow::Ok(())
    })?;
    Ok(rows)
}

/// The exponent of the growth with the number of steps, by least squares.
fn exponent(rows: &Points) -> Option<f64> {
    order(rows.iter().filter(|[n, error]| *n >= 1e4 && *error > 0.0).map(|&[n, error]| (n, error)))
}

fn notes(pairs: &[Pair; 4]) -> Vec<String> {
    let note = |((name, ..), [plain, compensated]): (&(&str, &str, f64), &Pair)| {
        let (plain, by_compensation) = (exponent(plain)?, exponent(compensated)?);
        let &[n, error] = compensated.last()?;
        Some(format!(
            "{name}: errors grow as n^{plain:.2} with plain and as n^{by_compensation:.2} with compensated \
             sums; what is left after {} steps is {:.2} εh√n.",
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
    let n = ("number of steps *n*", [100.0, steps]);
    let panel = |((_, title, _), [plain, compensated]): (&(&str, &str, f64), &Pair)| {
        Panel::loglog(*title, n, ("relative error, root mean square", [1e-17, 1e-10]))
            .lines([
                ("plain sums", solid(VERMILLION), plain.clone()),
                ("compensated sums", solid(BLUE), compensated.clone()),
            ])
            .guide([at(100.0), at(steps)], "0.1 ε*h*√*n*")
            .legend_at(Corner::TopLeft)
    };
    let panels = || CASES.iter().zip(pairs).map(panel);
    Figure::of("*h* = 0.1; root mean square over four runs, in intervals of the logarithm of *n*")
        .row(330.0, panels().take(2).collect())
        .row(330.0, panels().skip(2).collect())
}
