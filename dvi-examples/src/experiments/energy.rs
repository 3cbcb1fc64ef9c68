//! Rowley & Marsden 2002, Fig. 2: H(t) − H(0) of two leapfrogging pairs.
//!
//! The explicit variational scheme (VE2, σ = 0) at h = 2 against the Runge–Kutta method of the same order
//! (RK2, explicit midpoint) at half the step.

use std::hint::black_box;
use std::time::Instant;

use crate::vocabulary::*;

const CLOSE_UP: f64 = 400.0;
const TIMINGS: u32 = 15;

/// H − H(0), of which the first tenth is the beginning; at t = 10⁴ and t = 5·10⁴, if the run gets there; and
/// evaluations of ∇H.
type Motion = (Series<1>, [Option<f64>; 2], u64);

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(2e5, 2e4);
    let Case { vortices, start } = models::leapfrogging();
    let pairs = Problem::new(&vortices, start);
    let runs = [
        (("VE2 h=2", solid(BLUE)), pairs.any(begun_by_rk2(0.0), 2.0)?),
        (("RK2 h=1", solid(VERMILLION)), pairs.any(RungeKutta::midpoint(), 1.0)?),
    ];
    let span = Span { end, early: 0.1 * end, intervals: 500 };
    let all = each(runs, |(named, mut run)| -> Result<Motion> {
        let (initial, mut landmarks) = (run.energy(), [None; 2]);
        let error = job.series(named, &mut run, span, |run, beginning| {
            let (t, change) = (run.time(), run.energy() - initial);
            if t <= CLOSE_UP {
                beginning.push([t, change]);
            }
            for (landmark, _) in landmarks.iter_mut().zip([1e4, 5e4]).filter(|(_, time)| t == *time) {
                *landmark = Some(change);
            }
            [change]
        });
        Ok((error.whole()?, landmarks, run.statistics().gradients))
    })?;
    let table = range_table("scheme,t", &[""], all.iter().map(|(series, ..)| series));
    job.publish(figure(&all, end), table)?;
    let [(ve2, _, of_ve2), (rk2, landmarks, of_rk2)] = &all;
    let ([ve2], [rk2]) = (&ve2.kept, &rk2.kept);
    // Numbers of independent programs.
    let references = vec![
        Check::new("max|ΔH| of VE2", job.only_full(ve2.largest), Bound::Near(3.268_824e-3, 1e-8)),
        Check::new("ΔH of RK2 at t = 10⁴", landmarks[0], Bound::Near(8.510_481_2e-3, 1e-9)),
        Check::new("ΔH of RK2 at t = 5·10⁴", landmarks[1], Bound::Near(0.035_429_685, 1e-8)),
        Check::new("ΔH of RK2 at t = 2·10⁵", job.only_full(rk2.last), Bound::Within(0.05, 0.13)),
    ];
    let grown = landmarks[0].zip(landmarks[1]).map(|(early, late)| late / early);
    // Rounding breaks the mirror symmetry at t ≈ 54000, and runs of RK2 differ from there on.
    let over = job.only_full(rk2.last / ve2.largest);
    // A time is no number that two runs share: short runs, which are compared, do without.
    let times = job.choose(Some(()), None).map(|()| time_ratios()).transpose()?;
    let [read, bulk] = [0, 1].map(|i| times.map(|times| times[i]));
    let [when_read, in_bulk] = ["every state read", "every hundredth state read"]
        .map(|how| format!("time of RK2 / time of VE2, {how}, least of {TIMINGS} runs each"));
    let depends = "it takes four times the evaluations of ∇H; the ratio of times depends on how often the \
                   states are read";
    let claims =
        vec![
            says("Fig. 2", "with VE2 the Hamiltonian remains close to its initial value, t ≤ 2·10⁵")
                .at_most("max|ΔH| over all / over the first tenth", job.only_full(ve2.growth()), 1.02),
            says("Fig. 2", "RK2 shows a secular drift in the Hamiltonian")
                .at_least("ΔH of RK2 at t = 5·10⁴ / at t = 10⁴", grown, 3.0)
                .at_least("ΔH of RK2 at the end / max|ΔH| of VE2", over, 10.0),
            says("section 5", "RK2 takes approximately four times the computational time of VE2")
                .near(&when_read, read, [4.0, 1.0])
                .near(&in_bulk, bulk, [4.0, 1.0])
                .instead(depends)
                .at_least(when_read, read, 1.2)
                .at_least(in_bulk, bulk, 2.0)
                .near("evaluations of ∇H, RK2 / VE2", *of_rk2 as f64 / *of_ve2 as f64, [4.0, 0.01]),
        ];
    Ok(Outcome { claims, references, notes: vec![] })
}

/// The time of RK2 for the run of Fig. 2 over that of VE2, with each state read, and with few.
fn time_ratios() -> Result<[f64; 2]> {
    let mut least = [[f64::INFINITY; 2]; 2];
    for k in 0..2 * TIMINGS as usize {
        let (stride, least) = ([1, 100][k % 2], &mut least[k % 2]);
        least[0] = least[0].min(timed(begun_by_rk2(0.0), 2.0, stride)?);
        least[1] = least[1].min(timed(RungeKutta::midpoint(), 1.0, stride)?);
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

fn figure([(ve2, ..), (rk2, ..)]: &[Motion; 2], end: f64) -> Figure {
    let energy = || Axis::linear("*H*(*t*) − *H*(0)   [Γ²]");
    let time = || Axis::linear("time *t*   [*L*²/Γ]");
    let whole = Panel::new("The whole run (range and mean)", time().within([0.0, end]), energy())
        .ranges([
            ("VE2 (σ = 0), *h* = 2", BLUE, ve2.kept[0].rows()),
            ("RK2 (midpoint), *h* = 1", VERMILLION, rk2.kept[0].rows()),
        ])
        .legend_at(Corner::TopLeft)
        .weight(1.25);
    let beginning = Panel::new("The beginning", time().within([0.0, CLOSE_UP]), energy())
        .line(ve2.path.clone(), solid(BLUE).width(1.3))
        .line(rk2.path.clone(), solid(VERMILLION).width(1.3));
    Figure::of("VE2 takes one evaluation of ∇*H* per step, RK2 two")
        .row(430.0, vec![whole, beginning])
        .footer("After Rowley & Marsden 2002, Fig. 2. Γ and *L*: units of circulation and length.")
}
