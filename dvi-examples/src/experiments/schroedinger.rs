//! A discrete breather: an excitation of a lattice that stays where it is.
//!
//! The discrete nonlinear Schrödinger equation has solutions ψ_n = u_n e^{iωt} that are large at one site
//! only (MacKay & Aubry 1994). With α = p·dq the one-step midpoint scheme is the implicit midpoint rule. It
//! keeps the norm, which is quadratic, and it has the same breathers with another frequency.

use std::f64::consts::SQRT_2;

use crate::models::{SchroedingerLattice, SchroedingerLatticeState, breather};
use crate::vocabulary::*;

const SITES: usize = 15;
const OMEGA: f64 = 4.0;
/// Steps for each period 2π/ω.
const STEPS: u64 = 24;
const H: f64 = TAU / (OMEGA * STEPS as f64);
/// Periods of the beginning, with which the whole is compared.
const EARLY: u64 = 100;
/// By what the breather is too large at its centre at the start, and the amplitude of a weak excitation of
/// one site.
const EXCESS: f64 = 1.05;
const WEAK: f64 = 0.5;

type Amplitudes = [f64; SITES];
const LATTICE: SchroedingerLattice<SITES> = SchroedingerLattice {};

/// What one run leaves.
struct Excitation {
    name: &'static str,
    /// |ψ_n|² at the start and at the end.
    profiles: [Amplitudes; 2],
    /// (Σ|ψ|²)²/Σ|ψ|⁴ over time: the number of sites that are excited. And the relative changes of the norm
    /// and of the energy.
    sites: Deviation,
    norm: Deviation,
    energy: Deviation,
}

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let periods = job.choose(10_000, 200);
    job.expect(3 * periods * STEPS);
    let (mut start, mut weak) = (breather(OMEGA), [0.0; SITES]);
    start[SITES / 2] *= EXCESS;
    weak[SITES / 2] = WEAK;
    let all = [
        Excitation::new(job, "one step, midpoint", OneStep::midpoint(), start, periods)?,
        Excitation::new(job, "RK4", RungeKutta::classical(), start, periods)?,
        Excitation::new(job, "weak excitation", OneStep::midpoint(), weak, periods)?,
    ];
    let rows = all.iter().flat_map(|Excitation { name, sites, norm, energy, .. }| {
        let of = [("sites", sites), ("ΔN/N", norm), ("ΔH/H", energy)].into_iter();
        of.flat_map(|(quantity, kept)| ranges([*name, quantity], &kept.envelope))
    });
    let table = Table::of(&["series", "quantity", "period", "lowest", "mean", "highest"], rows)?;
    job.publish(figure(&all, periods), table)?;
    let [one_step, rk4, weak] = &all;
    let kept =
        "the one-step midpoint scheme keeps the norm to rounding errors, and the energy error does not grow";
    let most = "(Σ|ψ|²)²/Σ|ψ|⁴";
    Ok(vec![
        beyond(kept)
            .at_most("one step: largest relative change of the norm", one_step.norm.largest, 1e-11)
            .at_least("RK4: largest relative change of the norm", rk4.norm.largest, 1e-3)
            .at_most("one step: max|ΔH| over all / over 100 periods", one_step.energy.growth(), 1.02),
        beyond("a breather that is disturbed stays at its site, and a weak excitation spreads")
            .at_most(format!("breather: most sites {most} that are excited"), one_step.sites.largest, 1.5)
            .at_least("weak excitation: most sites that are excited", weak.sites.largest, 5.0),
        own_breather()?,
    ]
    .into())
}

/// ψ = u, real.
fn state(u: Amplitudes) -> SchroedingerLatticeState<SITES> {
    SchroedingerLatticeState { q: u.map(|u| SQRT_2 * u), p: [0.0; SITES] }
}

/// |ψ_n|² of a state in flat form.
fn densities(q: &[f64]) -> Amplitudes {
    std::array::from_fn(|n| (q[n] * q[n] + q[n + SITES] * q[n + SITES]) / 2.0)
}

impl Excitation {
    fn new(
        job: &Job<'_>,
        name: &'static str,
        method: impl Method<SchroedingerLattice<SITES>, f64>,
        start: Amplitudes,
        periods: u64,
    ) -> Result<Self> {
        let mut run = Integrator::new(&LATTICE, method, H, state(start))?;
        let sum = |values: &Amplitudes| values.iter().sum::<f64>();
        let (energy, norm) = (run.energy(), sum(&densities(run.q())));
        let mut profiles = [densities(run.q()); 2];
        let mut kept = Span { end: periods as f64, early: EARLY as f64, intervals: 400 }.deviations();
        job.follow(&mut run, periods * STEPS, |run| {
            let densities = densities(run.q());
            let sites = sum(&densities).powi(2) / sum(&densities.map(|density| density * density));
            let values = [sites, sum(&densities) / norm - 1.0, run.energy() / energy - 1.0];
            note(&mut kept, run.time() * OMEGA / TAU, values);
            profiles[1] = densities;
        })?;
        let [sites, norm, energy] = kept;
        Ok(Self { name, profiles, sites, norm, energy })
    }
}

/// At the middle of a step the scheme solves ω u = u_{n+1} − 2u_n + u_{n−1} + u³ with ω = (2/h) tan ½θ if it
/// turns by θ.
fn own_breather() -> Result<Claim> {
    let angle = 2.0 * (OMEGA * H / 2.0).atan();
    let start = breather(OMEGA).map(|u| u / (angle / 2.0).cos());
    let mut run = Integrator::new(&LATTICE, OneStep::midpoint(), H, state(start))?;
    let mut largest = 0.0;
    for k in 1..=1000 {
        run.advance()?;
        let (sin, cos) = (angle * f64::from(k)).sin_cos();
        for (n, u) in start.iter().enumerate() {
            let apart = (run.q()[n] - SQRT_2 * u * cos).hypot(run.q()[n + SITES] - SQRT_2 * u * sin);
            largest = larger(largest, apart);
        }
    }
    Ok(beyond(
        "the scheme has the breathers of the equation, larger by 1/cos ½θ, that turn by θ = 2 arctan \
               ½ωh a step",
    )
    .at_most("largest distance from that in 1000 steps", largest, 1e-10))
}

fn figure([one_step, rk4, weak]: &[Excitation; 3], periods: u64) -> Figure {
    let at_sites = |values: &Amplitudes| -> Vec<[f64; 2]> {
        let place = |n: usize| n as f64 - (SITES / 2) as f64;
        values.iter().enumerate().map(|(n, value)| [place(n), *value]).collect()
    };
    let density = Axis::logarithmic("|*ψ*ₙ|²").within(1e-10, 1e5);
    let profile = Panel::new("Profile at the start and at the end", Axis::linear("site *n*"), density)
        .lines([
            ("start", Stroke::solid(SLATE).width(4.0).opacity(0.4), at_sites(&one_step.profiles[0])),
            ("one step, midpoint", Stroke::solid(BLUE), at_sites(&one_step.profiles[1])),
            ("RK4", Stroke::dashed(VERMILLION), at_sites(&rk4.profiles[1])),
            ("weak excitation", Stroke::solid(GREEN), at_sites(&weak.profiles[1])),
        ]);
    let time = || Axis::linear("time *t*   [periods 2π/*ω*]").within(0.0, periods as f64);
    let sites = Axis::linear("(Σ|*ψ*|²)² / Σ|*ψ*|⁴, mean of each interval").within(0.0, SITES as f64);
    let sites = Panel::new("Excited sites", time(), sites).lines([
        ("breather", Stroke::solid(BLUE), one_step.sites.envelope.mean()),
        ("weak excitation", Stroke::solid(GREEN), weak.sites.envelope.mean()),
    ]);
    let error = Axis::logarithmic("largest relative error of each interval").within(1e-16, 10.0);
    let errors = Panel::new("Errors of the norm and of the energy", time(), error).lines([
        ("one step: *H*", Stroke::solid(BLUE), one_step.energy.envelope.magnitude()),
        ("one step: norm", Stroke::dashed(BLUE), one_step.norm.envelope.magnitude()),
        ("RK4: *H*", Stroke::solid(VERMILLION), rk4.energy.envelope.magnitude()),
        ("RK4: norm", Stroke::dashed(AMBER), rk4.norm.envelope.magnitude()),
    ]);
    let excess = 100.0 * (EXCESS - 1.0);
    Figure::new(
        "A discrete breather: where it is, and what two methods keep of it",
        format!(
            "{SITES} sites on a ring, *ω* = {OMEGA}, {STEPS} steps a period, disturbed by {excess:.0} \
                 % at its centre"
        ),
    )
    .row(380.0, vec![profile.legend_at(Corner::TopLeft), sites])
    .row(330.0, vec![errors.legend_at(Corner::Beside)])
    .footer(format!(
        "Largest relative change of the norm: one step {}, RK4 {}.",
        at_most(one_step.norm.largest),
        scientific(rk4.norm.largest)
    ))
}
