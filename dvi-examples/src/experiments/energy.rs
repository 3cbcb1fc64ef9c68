//! Rowley & Marsden 2002, Fig. 2: H(t) − H(0) of two leapfrogging pairs.
//!
//! The explicit variational scheme (VE2, σ = 0) at h = 2 against the Runge–Kutta method of the same order
//! (RK2, explicit midpoint) at half the step.

use std::hint::black_box;
use std::time::Instant;

use crate::models::{self, Case, FourVortices};
use crate::vocabulary::*;

/// How much of the beginning the right panel shows.
const CLOSE_UP: f64 = 400.0;
/// Runs of each scheme that are timed.
const TIMINGS: u32 = 15;

/// What a run leaves of H − H(0).
struct Motion {
    /// The beginning is the first tenth of the time.
    error: Deviation,
    beginning: Vec<[f64; 2]>,
    /// At t = 10⁴ and t = 5·10⁴, if the run gets there.
    landmarks: [Option<f64>; 2],
    evaluations: u64,
}

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(2e5, 2e4);
    job.expect((end / 2.0) as u64 + end as u64);
    let ve2 = follow(job, starting_with_rk2(), 2.0, end)?;
    let rk2 = follow(job, RungeKutta::midpoint(), 1.0, end)?;
    let rows = ranges(["VE2 h=2"], &ve2.error.envelope).chain(ranges(["RK2 h=1"], &rk2.error.envelope));
    let table = Table::of(&["scheme", "t", "lowest", "mean", "highest"], rows)?;
    job.publish(figure(&ve2, &rk2, end), table)?;
    // A time is no number that two runs share: short runs, which are compared, do without.
    let times = job.choose(Some(()), None).map(|()| time_ratios(job)).transpose()?;
    // Numbers of independent programs.
    let references = vec![
        Check::new("max|ΔH| of VE2", job.only_full(ve2.error.largest), Bound::Near(3.268_824e-3, 1e-8)),
        Check::new("ΔH of RK2 at t = 10⁴", rk2.landmarks[0], Bound::Near(8.510_481_2e-3, 1e-9)),
        Check::new("ΔH of RK2 at t = 5·10⁴", rk2.landmarks[1], Bound::Near(0.035_429_685, 1e-8)),
        Check::new("ΔH of RK2 at t = 2·10⁵", job.only_full(rk2.error.last), Bound::Within(0.05, 0.13)),
    ];
    Ok(Outcome { claims: claims(job, &ve2, &rk2, times), references, notes: vec![] })
}

fn follow(job: &Job<'_>, method: impl Method<FourVortices, f64>, h: f64, end: f64) -> Result<Motion> {
    let Case { vortices, start } = models::leapfrogging();
    let mut run = Integrator::new(&vortices, method, h, start)?;
    let (initial, mut error) = (run.energy(), Deviation::new(end, 500, 0.1 * end));
    let (mut beginning, mut landmarks) = (vec![[0.0, 0.0]], [None; 2]);
    job.follow(&mut run, (end / h) as u64, |run| {
        let (t, change) = (run.time(), run.energy() - initial);
        error.push(t, change);
        if t <= CLOSE_UP {
            beginning.push([t, change]);
        }
        for (landmark, _) in landmarks.iter_mut().zip([1e4, 5e4]).filter(|(_, time)| t == *time) {
            *landmark = Some(change);
        }
    })?;
    Ok(Motion { error, beginning, landmarks, evaluations: run.statistics().gradients })
}

fn claims(job: &Job<'_>, ve2: &Motion, rk2: &Motion, times: Option<[f64; 2]>) -> Vec<Claim> {
    let grown = rk2.landmarks[0].zip(rk2.landmarks[1]).map(|(early, late)| late / early);
    let [read, bulk] = [0, 1].map(|i| times.map(|times| times[i]));
    let [when_read, in_bulk] = ["every state read", "every hundredth state read"]
        .map(|how| format!("time of RK2 / time of VE2, {how}, least of {TIMINGS} runs each"));
    let evaluations = rk2.evaluations as f64 / ve2.evaluations as f64;
    let growth = job.only_full(ve2.error.growth());
    // Rounding breaks the mirror symmetry at t ≈ 54000, and runs of RK2 differ from there on.
    let over = job.only_full(rk2.error.last / ve2.error.largest);
    vec![
        Claim::new("Fig. 2", "with VE2 the Hamiltonian remains close to its initial value, t ≤ 2·10⁵")
            .at_most("max|ΔH| over all / over the first tenth", growth, 1.02),
        Claim::new("Fig. 2", "RK2 shows a secular drift in the Hamiltonian")
            .at_least("ΔH of RK2 at t = 5·10⁴ / at t = 10⁴", grown, 3.0)
            .at_least("ΔH of RK2 at the end / max|ΔH| of VE2", over, 10.0),
        Claim::new("section 5", "RK2 takes approximately four times the computational time of VE2")
            .near(&when_read, read, [4.0, 1.0])
            .near(&in_bulk, bulk, [4.0, 1.0])
            .instead(
                "it takes four times the evaluations of ∇H; the ratio of times depends on how often the \
                 states are read",
            )
            .at_least(when_read, read, 1.2)
            .at_least(in_bulk, bulk, 2.0)
            .near("evaluations of ∇H, RK2 / VE2", evaluations, [4.0, 0.01]),
    ]
}

/// The time that RK2 takes for the run of Fig. 2 over the time that VE2 takes: each state being read, and
/// none.
fn time_ratios(job: &Job<'_>) -> Result<[f64; 2]> {
    let mut least = [[f64::INFINITY; 2]; 2];
    for _ in 0..TIMINGS {
        if job.is_stopping() {
            job.cut_short();
            break;
        }
        for (stride, least) in [1, 100].into_iter().zip(&mut least) {
            let seconds =
                [timed(starting_with_rk2(), 2.0, stride)?, timed(RungeKutta::midpoint(), 1.0, stride)?];
            *least = [0, 1].map(|i| least[i].min(seconds[i]));
        }
    }
    Ok(least.map(|[ve2, rk2]| rk2 / ve2))
}

/// The seconds of a run to t = 2·10⁴ whose state is read after every `stride` steps.
fn timed(method: impl Method<FourVortices, f64>, h: f64, stride: u64) -> Result<f64> {
    let Case { vortices, start } = models::leapfrogging();
    let mut run = Integrator::new(&vortices, method, h, start)?;
    let begin = Instant::now();
    for _ in 0..(2e4 / h) as u64 / stride {
        run.take_steps(stride)?;
        black_box(run.q());
    }
    Ok(begin.elapsed().as_secs_f64())
}

/// The scheme VE2 as the paper starts it.
fn starting_with_rk2() -> Sigma {
    Sigma { start: Start::RungeKutta(RungeKutta::midpoint()), ..Sigma::leapfrog() }
}

fn figure(ve2: &Motion, rk2: &Motion, end: f64) -> Figure {
    let energy = || Axis::linear("*H*(*t*) − *H*(0)   [Γ²]");
    let time = || Axis::linear("time *t*   [*L*²/Γ]");
    let whole = Panel::new("The whole run (range and mean)", time().within(0.0, end), energy())
        .band(ve2.error.envelope.band(), BLUE)
        .band(rk2.error.envelope.band(), VERMILLION)
        .line(ve2.error.envelope.mean(), Stroke::solid(BLUE))
        .labelled("VE2 (σ = 0), *h* = 2")
        .line(rk2.error.envelope.mean(), Stroke::solid(VERMILLION))
        .labelled("RK2 (midpoint), *h* = 1")
        .legend_at(Corner::TopLeft)
        .weight(1.25);
    let beginning = Panel::new("The beginning", time().within(0.0, CLOSE_UP), energy())
        .line(ve2.beginning.clone(), Stroke::solid(BLUE).width(1.3))
        .line(rk2.beginning.clone(), Stroke::solid(VERMILLION).width(1.3));
    Figure::new(
        "Two leapfrogging pairs: the error of the Hamiltonian, VE2 against RK2 at half the step",
        format!(
            "max|Δ*H*| up to *t* = {}: VE2 {}, RK2 {}; VE2 takes one evaluation of ∇*H* per step, RK2 two",
            scientific(ve2.error.envelope.end()),
            at_most(ve2.error.largest),
            at_most(rk2.error.largest)
        ),
    )
    .row(430.0, vec![whole, beginning])
    .footer("After Rowley & Marsden 2002, Fig. 2. Γ and *L*: units of circulation and length.")
}
