//! Kosmas & Vlachos, Fig. 4: the frequency of a Kepler orbit with e = 0.95 over ten periods.
//!
//! ω = |q' × q''|/|q'|² (eq. 19), the angular velocity of the osculating circle, beside √(|q''|/|q|), the
//! frequency of the oscillator with the same acceleration at the same place. On an orbit of semi-major axis
//! 1 they are √(1 − e²)/(2r² − r³) and r^(−3/2).

use crate::claim::larger;
use std::f64::consts::TAU;

use anyhow::Result;
use dvi_core::discrete::FrequencyIn;
use dvi_core::prelude::*;

use crate::claim::{BEYOND, Bound, Claim};
use crate::figure::{Axis, BLUE, Corner, Figure, Panel, Stroke, VERMILLION};
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{Kepler, Orbit};
use crate::output::Table;

pub const EXPERIMENT: Experiment = Experiment {
    name: "kepler-frequency",
    title: "The frequency of a Kepler orbit, e = 0.95",
    share: 1.0,
    run,
};

const ORBIT: Orbit = Orbit { e: 0.95 };
const PERIODS: u64 = 10;
const STEPS: u64 = 20_000;

/// What is read at one point of the run.
#[derive(Clone, Copy, Debug)]
struct Reading {
    t: f64,
    r: f64,
    curvature: f64,
    radial: f64,
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    job.expect(PERIODS * STEPS);
    let readings = readings(job)?;
    job.publish(EXPERIMENT.name, figure(&readings), table(&readings)?)?;
    Ok(Outcome { claims: claims(&readings), references: vec![], notes: vec![] })
}

/// Both frequencies along a phase-fitted run.
fn readings(job: &Job<'_>) -> Result<Vec<Reading>> {
    let averaged = dvi_core::discrete::Reading::Averaged;
    let method = Variational::simpson().phase_fitted(Radial(averaged));
    let mut run = Integrator::new(&Kepler {}, method, TAU / STEPS as f64, ORBIT.pericentre())?;
    let mut readings = Vec::with_capacity((PERIODS * STEPS) as usize);
    job.repeat(PERIODS * STEPS, || {
        run.advance()?;
        let (q, v) = (run.q(), run.memory().p());
        let r = q[0].hypot(q[1]);
        let a = [-q[0] / r.powi(3), -q[1] / r.powi(3)];
        let curvature = Curvature(averaged).at(q, v, &a);
        readings.push(Reading { t: run.time(), r, curvature, radial: Radial(averaged).at(q, v, &a) });
        Ok(())
    })?;
    Ok(readings)
}

/// Equation (19) on an orbit of semi-major axis 1.
fn formula(r: f64) -> f64 {
    (1.0 - ORBIT.e * ORBIT.e).sqrt() / (r * r * (2.0 - r))
}

fn claims(readings: &[Reading]) -> Vec<Claim> {
    let largest = readings.iter().map(|reading| reading.curvature).fold(0.0, larger);
    let share = |condition: &dyn Fn(&Reading) -> bool| {
        readings.iter().filter(|reading| condition(reading)).count() as f64 / readings.len() as f64
    };
    let relative = |value: f64, exact: f64| (value / exact - 1.0).abs();
    let curvature = readings.iter().map(|x| relative(x.curvature, formula(x.r))).fold(0.0, larger);
    let radial = readings.iter().map(|x| relative(x.radial, x.r.powf(-1.5))).fold(0.0, larger);
    let [near, far] = [1.0 - ORBIT.e, 1.0 + ORBIT.e].map(formula);
    let lowest = readings.iter().map(|reading| reading.curvature).fold(f64::INFINITY, f64::min);
    vec![
        Claim::new("Fig. 4", "the frequency is smooth almost everywhere except at the perihelion")
            .check(
                "share of time with ω above half its peak",
                share(&|x| x.curvature > 0.5 * largest),
                Bound::AtMost(0.01),
            )
            .check("share of time with ω below 2", share(&|x| x.curvature < 2.0), Bound::AtLeast(0.9))
            .check(
                "peak of ω / √(1 − e²)/(2r² − r³) at the pericentre",
                largest / near,
                Bound::Near(1.0, 1e-3),
            ),
        Claim::new(BEYOND, "(19) is √(1 − e²)/(2r² − r³) in closed form, and √(|q''|/|q|) is r^(−3/2)")
            .check("(19): largest relative deviation", curvature, Bound::AtMost(2e-3))
            .check("√(|q''|/|q|): largest relative deviation", radial, Bound::AtMost(1e-12)),
        Claim::new(BEYOND, "(19) rises again at the apocentre, where the motion is slowest").check(
            "ω at the apocentre / lowest ω",
            far / lowest,
            // 2r² − r³ is largest at r = 4/3, where it is 32/27.
            Bound::Near(far / formula(4.0 / 3.0), 1e-3),
        ),
    ]
}

fn figure(readings: &[Reading]) -> Figure {
    let frequency = || Axis::logarithmic("frequency ω   [√(μ/*a*³)]").within(0.1, 200.0);
    let panel = |title: &str, from: f64, to: f64| {
        let time = Axis::linear("time *t*   [periods]").within(from, to);
        let inside = readings.iter().filter(|x| (from..=to).contains(&(x.t / TAU)));
        let points = |of: fn(&Reading) -> f64| inside.clone().map(|x| [x.t / TAU, of(x)]).collect();
        Panel::new(title, time, frequency())
            .line(points(|x| x.curvature), Stroke::solid(BLUE))
            .labelled("|*q*' × *q*''|/|*q*'|²  (19)")
            .line(points(|x| x.radial), Stroke::solid(VERMILLION))
            .labelled("√(|*q*''|/|*q*|) = *r*^(−3/2)")
    };
    Figure::new(
        format!("Two frequencies of a Kepler orbit with *e* = {}, over {PERIODS} periods", ORBIT.e),
        format!("Read along a phase-fitted run of {STEPS} steps per period; *a*: the semi-major axis"),
    )
    .row(
        430.0,
        vec![
            panel("Ten periods", 0.0, PERIODS as f64).without_legend().weight(1.3),
            panel("One period", 0.5, 1.5).legend_at(Corner::TopRight),
        ],
    )
    .footer("After Kosmas & Vlachos, Fig. 4.")
}

fn table(readings: &[Reading]) -> Result<Table> {
    let mut table = Table::new(&["t", "r", "omega_curvature", "omega_radial"])?;
    for Reading { t, r, curvature, radial } in readings.iter().step_by(20) {
        table.row([t, r, curvature, radial])?;
    }
    Ok(table)
}
