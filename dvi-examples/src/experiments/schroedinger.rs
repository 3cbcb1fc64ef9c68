//! A discrete breather: an excitation of a lattice that stays where it is.
//!
//! The discrete nonlinear Schrödinger equation has solutions ψ_n = u_n e^{iωt} that are large at one site
//! only (MacKay & Aubry 1994). With α = p·dq the one-step midpoint scheme is the implicit midpoint rule. It
//! keeps the norm, which is quadratic, and it has the same breathers with another frequency.

use std::f64::consts::{SQRT_2, TAU};

use anyhow::Result;
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use crate::claim::{BEYOND, Bound, Claim, larger};
use crate::deviation::Deviation;
use crate::figure::{
    AMBER, Axis, BLUE, Corner, Envelope, Figure, GREEN, Panel, SLATE, Stroke, VERMILLION, at_most,
    scientific,
};
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{SchroedingerLattice, SchroedingerLatticeState, breather};
use crate::output::{Table, number};

pub const EXPERIMENT: Experiment =
    Experiment {
        name: "breather", title: "A discrete breather of a Schrödinger lattice", share: 11.0, run
    };

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
struct Series {
    name: &'static str,
    /// |ψ_n|² at the start and at the end.
    profiles: [Amplitudes; 2],
    /// (Σ|ψ|²)²/Σ|ψ|⁴ over time: the number of sites that are excited.
    participation: Envelope,
    norm: Deviation,
    energy: Deviation,
    most_sites: f64,
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let periods = job.choose(10_000, 200);
    job.expect(3 * periods * STEPS);
    let mut start = breather(OMEGA);
    start[SITES / 2] *= EXCESS;
    let mut weak = [0.0; SITES];
    weak[SITES / 2] = WEAK;
    let all = [
        series(job, "one step, midpoint", OneStep::midpoint(), start, periods)?,
        series(job, "RK4", RungeKutta::classical(), start, periods)?,
        series(job, "weak excitation", OneStep::midpoint(), weak, periods)?,
    ];
    let claims = vec![kept(&all), localised(&all), own_breather()?];
    job.publish(EXPERIMENT.name, figure(&all, periods), table(&all)?)?;
    Ok(Outcome { claims, references: vec![], notes: vec![] })
}

/// ψ = u, real.
fn state(u: Amplitudes) -> SchroedingerLatticeState<SITES> {
    SchroedingerLatticeState { q: u.map(|u| SQRT_2 * u), p: [0.0; SITES] }
}

/// |ψ_n|² of a state in flat form.
fn densities(q: &[f64]) -> Amplitudes {
    std::array::from_fn(|n| (q[n] * q[n] + q[n + SITES] * q[n + SITES]) / 2.0)
}

fn series<M: Method<SchroedingerLattice<SITES>, f64>>(
    job: &Job<'_>,
    name: &'static str,
    method: M,
    start: Amplitudes,
    periods: u64,
) -> Result<Series> {
    let mut run = Integrator::new(&LATTICE, method, H, state(start))?;
    let sum = |values: &Amplitudes| values.iter().sum::<f64>();
    let (energy, norm) = (run.energy(), sum(&densities(run.q())));
    let empty = || Deviation::new(periods as f64, 400, EARLY as f64);
    let mut series = Series {
        name,
        profiles: [densities(run.q()); 2],
        participation: Envelope::new(periods as f64, 400),
        norm: empty(),
        energy: empty(),
        most_sites: 0.0,
    };
    job.repeat(periods * STEPS, || {
        run.advance()?;
        let (period, densities) = (run.time() * OMEGA / TAU, densities(run.q()));
        let sites = sum(&densities).powi(2) / sum(&densities.map(|density| density * density));
        series.participation.push(period, sites);
        series.norm.push(period, sum(&densities) / norm - 1.0);
        series.energy.push(period, run.energy() / energy - 1.0);
        series.most_sites = larger(series.most_sites, sites);
        series.profiles[1] = densities;
        Ok(())
    })?;
    Ok(series)
}

fn kept([one_step, runge_kutta, _]: &[Series; 3]) -> Claim {
    Claim::new(
        BEYOND,
        "the one-step midpoint scheme keeps the norm to rounding errors, and the energy error does not grow",
    )
    .check("one step: largest relative change of the norm", one_step.norm.largest, Bound::AtMost(1e-11))
    .check("RK4: largest relative change of the norm", runge_kutta.norm.largest, Bound::AtLeast(1e-3))
    .check(
        "one step: max|ΔH| over all / over 100 periods",
        one_step.energy.growth(),
        Bound::AtMost(1.02),
    )
}

fn localised([one_step, _, weak]: &[Series; 3]) -> Claim {
    Claim::new(BEYOND, "a breather that is disturbed stays at its site, and a weak excitation spreads")
        .check(
            "breather: most sites (Σ|ψ|²)²/Σ|ψ|⁴ that are excited",
            one_step.most_sites,
            Bound::AtMost(1.5),
        )
        .check("weak excitation: most sites that are excited", weak.most_sites, Bound::AtLeast(5.0))
}

/// At the middle of a step the scheme solves ω u = u_{n+1} − 2u_n + u_{n−1} + u³ with ω = (2/h) tan ½θ if it
/// turns by θ.
fn own_breather() -> Result<Claim> {
    const COUNT: u64 = 1000;
    let angle = 2.0 * (OMEGA * H / 2.0).atan();
    let start = breather(OMEGA).map(|u| u / (angle / 2.0).cos());
    let mut run = Integrator::new(&LATTICE, OneStep::midpoint(), H, state(start))?;
    let mut largest = 0.0;
    for k in 1..=COUNT {
        run.advance()?;
        let (sin, cos) = (angle * k as f64).sin_cos();
        for (n, u) in start.iter().enumerate() {
            let apart = (run.q()[n] - SQRT_2 * u * cos).hypot(run.q()[n + SITES] - SQRT_2 * u * sin);
            largest = larger(largest, apart);
        }
    }
    Ok(Claim::new(BEYOND, "the scheme has the breathers of the equation, larger by 1/cos ½θ, that turn by θ = 2 arctan ½ωh a step")
        .check("largest distance from that in 1000 steps", largest, Bound::AtMost(1e-10)))
}

fn figure(all: &[Series; 3], periods: u64) -> Figure {
    let [one_step, runge_kutta, weak] = all;
    let at_sites = |values: &Amplitudes| -> Vec<[f64; 2]> {
        let place = |n: usize| n as f64 - (SITES / 2) as f64;
        values.iter().enumerate().map(|(n, value)| [place(n), *value]).collect()
    };
    let profile = Panel::new(
        "Profile at the start and at the end",
        Axis::linear("site *n*"),
        Axis::logarithmic("|*ψ*ₙ|²").within(1e-10, 1e5),
    )
    .line(at_sites(&one_step.profiles[0]), Stroke::solid(SLATE).width(4.0).opacity(0.4))
    .labelled("start")
    .line(at_sites(&one_step.profiles[1]), Stroke::solid(BLUE))
    .labelled("one step, midpoint")
    .line(at_sites(&runge_kutta.profiles[1]), Stroke::dashed(VERMILLION))
    .labelled("RK4")
    .line(at_sites(&weak.profiles[1]), Stroke::solid(GREEN))
    .labelled("weak excitation");
    let time = || Axis::linear("time *t*   [periods 2π/*ω*]").within(0.0, periods as f64);
    let sites = Panel::new(
        "Excited sites",
        time(),
        Axis::linear("(Σ|*ψ*|²)² / Σ|*ψ*|⁴, mean of each interval").within(0.0, SITES as f64),
    )
    .line(one_step.participation.mean(), Stroke::solid(BLUE))
    .labelled("breather")
    .line(weak.participation.mean(), Stroke::solid(GREEN))
    .labelled("weak excitation");
    let errors = Panel::new(
        "Errors of the norm and of the energy",
        time(),
        Axis::logarithmic("largest relative error of each interval").within(1e-16, 10.0),
    )
    .line(one_step.energy.envelope.magnitude(), Stroke::solid(BLUE))
    .labelled("one step: *H*")
    .line(one_step.norm.envelope.magnitude(), Stroke::dashed(BLUE))
    .labelled("one step: norm")
    .line(runge_kutta.energy.envelope.magnitude(), Stroke::solid(VERMILLION))
    .labelled("RK4: *H*")
    .line(runge_kutta.norm.envelope.magnitude(), Stroke::dashed(AMBER))
    .labelled("RK4: norm");
    Figure::new(
        "A discrete breather: where it is, and what two methods keep of it",
        format!("{SITES} sites on a ring, *ω* = {OMEGA}, {STEPS} steps a period, disturbed by {:.0} % at its centre", 100.0 * (EXCESS - 1.0)),
    )
    .row(380.0, vec![profile.legend_at(Corner::TopLeft), sites.legend_at(Corner::TopRight)])
    .row(330.0, vec![errors.legend_at(Corner::Beside)])
    .footer(format!(
        "Largest relative change of the norm: one step {}, RK4 {}.",
        at_most(one_step.norm.largest),
        scientific(runge_kutta.norm.largest)
    ))
}

fn table(all: &[Series; 3]) -> Result<Table> {
    let mut table = Table::new(&["series", "quantity", "period", "lowest", "mean", "highest"])?;
    for Series { name, participation, norm, energy, .. } in all {
        for (quantity, envelope) in
            [("sites", participation), ("ΔN/N", &norm.envelope), ("ΔH/H", &energy.envelope)]
        {
            for row in envelope.rows() {
                let names = [(*name).to_owned(), quantity.to_owned()];
                table.row(names.into_iter().chain(row.map(number)))?;
            }
        }
    }
    Ok(table)
}
