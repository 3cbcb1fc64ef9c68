//! Stability on z' = λz (Rowley & Marsden 2002, section 4.1), found by running and without use of formulas.
//!
//! For σ = ½ the region is the closed left half plane. For every other σ it is a part of the imaginary axis,
//! |λh| < 1/|1 − 2σ|, and nothing beside it: where λ damps, the parasitic root grows.

use crate::vocabulary::*;

/// σ = ½ has no limit and is tested apart.
#[rustfmt::skip]
const SIGMAS: [f64; 18] = [
    0.0, 0.1, 0.2, 0.3, 0.4, 0.45, 0.47, 0.48, 0.49, 0.51, 0.52, 0.53, 0.55, 0.6, 0.7, 0.8, 0.9, 1.0,
];
/// A mode that grows reaches this size, unless the growth is linear, as at the limit itself.
const LARGE: f64 = 1e8;
/// λh that damp, the first of which is drawn.
const DAMPED: [[f64; 2]; 5] = [[-1.0, 1.0], [-1.0, 0.0], [-0.1, 0.5], [-0.1, 0.3], [-10.0, 3.0]];
const FEW: usize = 1000;

/// The limit of |λh| on the imaginary axis.
fn formula(sigma: f64) -> f64 {
    1.0 / (1.0 - 2.0 * sigma).abs()
}

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(40_000, 8_000);
    let measured = SIGMAS.par_iter().map(|&s| Ok([s, limit(s, steps)?])).collect::<Result<Points>>()?;
    let [once, twice] = each([steps, 2 * steps], |steps| largest_amplitude(0.5, 1e3, steps))?;
    let damped = SIGMAS.into_iter().chain([0.5]).flat_map(|sigma| DAMPED.map(|lambda| (sigma, lambda)));
    let damped = damped.map(|(sigma, lambda)| Damped::new(sigma, lambda)).collect::<Result<Vec<_>>>()?;
    let right = Damped::new(0.5, [0.01, 1.0])?.factor;
    let limits = measured.iter().map(|&[sigma, at]| (["limit"], [sigma, 0.0, at, at, formula(sigma)]));
    let growths = damped.iter().map(|&Damped { sigma, lambda: [x, y], factor, .. }| {
        (["growth per step"], [sigma, x, y, factor, root(sigma, [x, y])])
    });
    let columns = "quantity,sigma,lambda_h_real,lambda_h_imaginary,measured,formula";
    job.publish(figure(&measured, &damped), Table::of(columns, limits.chain(growths)))?;

    let (half, others): (Vec<_>, Vec<_>) = damped.iter().partition(|run| run.sigma == 0.5);
    let away = others.iter().map(|run| (run.factor - root(run.sigma, run.lambda)).abs());
    let from_formula = "largest relative deviation of the limit from the formula, 18 values of σ";
    let smallest = "smallest growth per step of 18 values of σ ≠ ½, five λ with negative real part";
    let bounded = "largest |z|, five λ with negative real part, both modes of size one";
    claims([
        says("section 4.1", "stable only when λ is imaginary, with |λh| < 1/|1 − 2σ|")
            .at_most(from_formula, deviation(&measured), job.choose(1e-4, 1e-3))
            .at_least(smallest, least(others.iter().map(|run| run.factor)), 1.0 + 1e-6)
            .at_most("largest deviation of that growth from the root of the recursion", largest(away), 1e-3)
            .at_least("the root for σ = ¼, λh = −1 + i", root(0.25, DAMPED[0]), 1.3),
        says("section 4.1", "for σ = ½ the region of stability is the closed left half plane")
            .at_most("growth of max|z| from step N to step 2N, λh = 1000i", twice / once, 1.001)
            .at_most(bounded, largest(half.iter().map(|run| run.largest)), 4.0)
            .at_least("growth per step to the right of it, λh = 0.01 + i", right, 1.001),
    ])
}

fn deviation(measured: &[[f64; 2]]) -> f64 {
    largest(measured.iter().map(|[sigma, limit]| (limit * (1.0 - 2.0 * sigma).abs() - 1.0).abs()))
}

/// The largest ω at which runs with h = 1 stay bounded.
fn limit(sigma: f64, steps: u64) -> Result<f64> {
    let is_stable = |omega: f64| anyhow::Ok(largest_amplitude(sigma, omega, steps)? < LARGE);
    let (mut low, mut high) = (0.0, 0.5);
    while is_stable(high)? {
        (low, high) = (high, 2.0 * high);
    }
    while high - low > 1e-9 * high {
        let middle = 0.5 * (low + high);
        if is_stable(middle)? { low = middle } else { high = middle }
    }
    Ok(0.5 * (low + high))
}

/// max |z| over a run with h = 1 from 1 and from a second point that excites both modes.
fn largest_amplitude(sigma: f64, omega: f64, steps: u64) -> Result<f64> {
    let rotation = Rotation { omega };
    let [first, second] = [0.0, omega.min(1.0)].map(|a| RotationState { x: a.cos(), y: a.sin() });
    let mut run = Integrator::from_two_points(&rotation, unwatched(Sigma::new(sigma)), 1.0, first, second)?;
    let mut largest = 0.0f64;
    for _ in 0..steps {
        // Once it is large enough to be called unstable, or ended, there is no need to go on to infinity.
        if run.advance().is_err() || largest >= LARGE {
            largest = LARGE;
            break;
        }
        largest = run.q().iter().fold(largest, |largest, q| larger(q.abs(), largest));
    }
    Ok(largest)
}

/// A run with h = 1 and a λ off the imaginary axis.
struct Damped {
    sigma: f64,
    lambda: [f64; 2],
    /// What |z| is multiplied with in each step, in the second half of the run.
    factor: f64,
    largest: f64,
}

impl Damped {
    fn new(sigma: f64, lambda: [f64; 2]) -> Result<Self> {
        let [first, second] = [[1.0, 0.0], [0.0, 1.0]].map(|z| LinearState { z, w: [0.0; 2] });
        let system = Linear { real: lambda[0], imaginary: lambda[1] };
        let mut run =
            Integrator::from_two_points(&system, unwatched(Sigma::new(sigma)), 1.0, first, second)?;
        let (mut sizes, mut before) = (vec![1.0f64], 1.0f64);
        while sizes.len() <= FEW && before < 1e60 && run.advance().is_ok() {
            // Two points, so that no oscillation is mistaken for decay.
            let now = run.q()[0].hypot(run.q()[1]);
            sizes.push(larger(before, now));
            before = now;
        }
        let (middle, last) = (sizes.len() / 2, sizes.len() - 1);
        let factor = (sizes[last] / sizes[middle]).powf(1.0 / (last - middle).max(1) as f64);
        Ok(Self { sigma, lambda, factor, largest: largest(sizes) })
    }
}

/// The larger modulus of the roots of (1 − bλ)ρ² − 2(1 − b)λρ − (1 + bλ) = 0, b = 2σ(1 − σ), h = 1:
/// scheme (14) on z' = λz.
fn root(sigma: f64, [x, y]: [f64; 2]) -> f64 {
    let b = 2.0 * sigma * (1.0 - sigma);
    let square = |[x, y]: [f64; 2]| [x * x - y * y, x * y + y * x];
    // ρ = (m ± √(m² + 1 − b²λ²))/(1 − bλ) with m = (1 − b)λ.
    let m = [(1.0 - b) * x, (1.0 - b) * y];
    let (mm, ll) = (square(m), square([x, y]));
    let under = [mm[0] + 1.0 - b * b * ll[0], mm[1] - b * b * ll[1]];
    let (r, angle) = (under[0].hypot(under[1]).sqrt(), 0.5 * under[1].atan2(under[0]));
    let s = [r * angle.cos(), r * angle.sin()];
    larger((m[0] + s[0]).hypot(m[1] + s[1]), (m[0] - s[0]).hypot(m[1] - s[1])) / (1.0 - b * x).hypot(-b * y)
}

fn figure(measured: &[[f64; 2]], damped: &[Damped]) -> Figure {
    let (bottom, top, sigma) = (0.5, 200.0, ("σ", [-0.02, 1.02]));
    let sigmas = || (0..=1000).map(|i| f64::from(i) / 1000.0);
    let curve: Points = sigmas().map(|s| [s, formula(s).min(1e6)]).collect();
    let stable = curve.iter().map(|&[sigma, limit]| [sigma, bottom, limit]).collect();
    let title = "Imaginary λ: where runs turn from bounded to unbounded";
    let border = Panel::semilog(title, sigma, ("|λ*h*|", [bottom, top]))
        .band(stable, BLUE)
        .lines([("1/|1 − 2σ|", solid(BLUE), curve)])
        .rings(measured.to_vec(), VERMILLION)
        .labelled("measured by bisection")
        .note([0.5, 0.75], Anchor::Middle, BLUE, "stable")
        .note([0.1, 20.0], Anchor::Middle, SLATE, "unstable");
    let first = damped.iter().filter(|run| run.lambda == DAMPED[0]);
    let roots = sigmas().map(|s| [s, root(s, DAMPED[0])]).collect();
    let growth = Panel::linear("λ*h* = −1 + i: growth of |*z*| in a step", sigma, ("factor", [0.8, 3.8]))
        .guide([[0.0, 1.0], [1.0, 1.0]], "neither growth nor decay")
        .lines([("larger root of the recursion", solid(BLUE), roots)])
        .rings(first.map(|run| [run.sigma, run.factor]).collect(), VERMILLION)
        .labelled("measured");
    let accuracy = at_most(deviation(measured));
    Figure::of(format!(
        "Found by running the schemes; the limits on the left are those of the formula to {accuracy}"
    ))
    .row(470.0, vec![border, growth])
    .footer("Rowley & Marsden 2002, section 4.1.")
}
