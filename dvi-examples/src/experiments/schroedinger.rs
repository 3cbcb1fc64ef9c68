//! A discrete breather: an excitation of a lattice that stays where it is.
//!
//! The discrete nonlinear Schrödinger equation has solutions ψ_n = u_n e^{iωt} that are large at one site
//! only (MacKay & Aubry 1994). With α = p·dq the one-step midpoint scheme is the implicit midpoint rule. It
//! keeps the norm, which is quadratic, and it has the same breathers with another frequency.

use crate::vocabulary::*;

const SITES: usize = 15;
const OMEGA: f64 = 4.0;
/// Steps for each period 2π/ω.
const STEPS: u64 = 24;
const H: f64 = TAU / (OMEGA * STEPS as f64);

type Amplitudes = [f64; SITES];
const LATTICE: SchroedingerLattice<SITES> = SchroedingerLattice {};

/// (Σ|ψ|²)²/Σ|ψ|⁴, the number of sites that are excited, and the relative changes of norm and energy over
/// time in periods; |ψ_n|² at the start and at the end.
type Excitation = (Series<3>, [Amplitudes; 2]);

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let periods = job.choose(10_000, 200);
    job.expect(3 * periods * STEPS);
    let (mut start, mut weak) = (breather(OMEGA), [0.0; SITES]);
    // The breather is too large at its centre; the weak excitation is one of one site.
    (start[SITES / 2], weak[SITES / 2]) = (1.05 * start[SITES / 2], 0.5);
    let runs = [
        (("one step, midpoint", solid(BLUE)), begin(start).any(OneStep::midpoint(), H)?),
        (("RK4", dashed(VERMILLION)), begin(start).any(RungeKutta::classical(), H)?),
        (("weak excitation", solid(GREEN)), begin(weak).any(OneStep::midpoint(), H)?),
    ];
    let sum = |values: &Amplitudes| values.iter().sum::<f64>();
    let all = each(runs, |(named, mut run)| -> Result<Excitation> {
        let (energy, mut profiles) = (run.energy(), [densities(run.q()); 2]);
        let mut kept = Span { end: periods as f64, early: 100.0, intervals: 400 }.envelopes();
        job.follow(&mut run, periods * STEPS, |run| {
            let densities = densities(run.q());
            let sites = sum(&densities).powi(2) / sum(&densities.map(|density| density * density));
            let norm = sum(&densities) / sum(&profiles[0]) - 1.0;
            note(&mut kept, run.time() * OMEGA / TAU, [sites, norm, run.energy() / energy - 1.0]);
            profiles[1] = densities;
        })?;
        Ok((Series::new(named, H, kept), profiles))
    })?;
    let (series, quantities) = (all.iter().map(|(series, _)| series), ["sites", "ΔN/N", "ΔH/H"]);
    job.publish(figure(&all, periods as f64), range_table("series,quantity,period", &quantities, series))?;
    let [[sites, norm, energy], [_, of_rk4, _], [weak, ..]] = all.each_ref().map(|(series, _)| &series.kept);
    let kept =
        "the one-step midpoint scheme keeps the norm to rounding errors, and the energy error does not grow";
    let most = "(Σ|ψ|²)²/Σ|ψ|⁴";
    claims([
        beyond(kept)
            .at_most("one step: largest relative change of the norm", norm.largest, 1e-11)
            .at_least("RK4: largest relative change of the norm", of_rk4.largest, 1e-3)
            .at_most("one step: max|ΔH| over all / over 100 periods", energy.growth(), 1.02),
        beyond("a breather that is disturbed stays at its site, and a weak excitation spreads")
            .at_most(format!("breather: most sites {most} that are excited"), sites.largest, 1.5)
            .at_least("weak excitation: most sites that are excited", weak.largest, 5.0),
        own_breather()?,
    ])
}

fn begin(u: Amplitudes) -> Problem<'static, SchroedingerLattice<SITES>> {
    Problem::new(&LATTICE, SchroedingerLatticeState { q: u.map(|u| SQRT_2 * u), p: [0.0; SITES] })
}

/// |ψ_n|² of a state in flat form.
fn densities(q: &[f64]) -> Amplitudes {
    std::array::from_fn(|n| (q[n] * q[n] + q[n + SITES] * q[n + SITES]) / 2.0)
}

/// At the middle of a step the scheme solves ω u = u_{n+1} − 2u_n + u_{n−1} + u³ with ω = (2/h) tan ½θ if it
/// turns by θ.
fn own_breather() -> Result<Claim> {
    let angle = 2.0 * (OMEGA * H / 2.0).atan();
    let start = breather(OMEGA).map(|u| u / (angle / 2.0).cos());
    let (mut run, mut largest) = (begin(start).run(OneStep::midpoint(), H)?, 0.0);
    for k in 1..=1000 {
        run.advance()?;
        let (sin, cos) = (angle * f64::from(k)).sin_cos();
        for (n, u) in start.iter().enumerate() {
            let apart = (run.q()[n] - SQRT_2 * u * cos).hypot(run.q()[n + SITES] - SQRT_2 * u * sin);
            largest = larger(largest, apart);
        }
    }
    let text = "the scheme has the breathers of the equation, larger by 1/cos ½θ, that turn by θ = 2 arctan \
                ½ωh a step";
    Ok(beyond(text).at_most("largest distance from that in 1000 steps", largest, 1e-10))
}

fn figure(all: &[Excitation; 3], periods: f64) -> Figure {
    let at_sites = |values: &Amplitudes| -> Points {
        values.iter().zip(0..).map(|(value, n)| [f64::from(n - SITES as i32 / 2), *value]).collect()
    };
    let [(one_step, [begin, _]), (rk4, _), (weak, _)] = all;
    let (title, site) = ("Profile at the start and at the end", ("site *n*", [-7.7, 7.7]));
    let profile = Panel::semilog(title, site, ("|*ψ*ₙ|²", [1e-10, 1e5]))
        .lines([("start", solid(SLATE).width(4.0).opacity(0.4), at_sites(begin))])
        .lines(all.iter().map(|(series, [_, end])| series.line(at_sites(end))))
        .legend_at(Corner::TopLeft);
    let time = ("time *t*   [periods 2π/*ω*]", [0.0, periods]);
    let sites = ("(Σ|*ψ*|²)² / Σ|*ψ*|⁴, mean of each interval", [0.0, SITES as f64]);
    let sites = Panel::linear("Excited sites", time, sites)
        .lines([one_step, weak].map(|series| series.line(series.kept[0].mean())));
    let error = ("largest relative error of each interval", [1e-16, 10.0]);
    let errors = Panel::semilog("Errors of the norm and of the energy", time, error).lines([
        ("one step: *H*", solid(BLUE), one_step.kept[2].magnitude()),
        ("one step: norm", dashed(BLUE), one_step.kept[1].magnitude()),
        ("RK4: *H*", solid(VERMILLION), rk4.kept[2].magnitude()),
        ("RK4: norm", dashed(AMBER), rk4.kept[1].magnitude()),
    ]);
    Figure::of(format!(
        "{SITES} sites on a ring, *ω* = {OMEGA}, {STEPS} steps a period, disturbed by 5 % at its centre"
    ))
    .row(380.0, vec![profile, sites])
    .row(330.0, vec![errors.legend_at(Corner::Beside)])
}
