//! Newmark's method on a chain of stiff and soft springs: energies over a long time, and how fast the stiff
//! springs exchange theirs.
//!
//! With γ = ½ the method is variational (Kane, Marsden, Ortiz & West 2000), so that its energy does not
//! drift. In the motion the sum of the energies of the stiff springs is an adiabatic invariant, and they
//! exchange energy on the time scale ω (Hairer, Lubich & Wanner 2006, section I.5.1 and chapter XIII).
//! Newmark's method keeps that sum with the stiffness sω², s = 1 + (β − ¼)(hω)², which it conserves on an
//! oscillator. But it changes the speed of the exchange. With x = z(t)e^{iω̃t} and z slow, a soft force that
//! is linear in x, −gx, turns z at the rate g/(2ω) in the motion. With δ² the second difference, the method
//! is (1 + βh²ω²)δ²x = −h²ω²x − h²(1 + βδ²)gx. There the rate is g/(2ω) times
//!
//! 1 / ((1 + β(hω)²) √(1 + (β − ¼)(hω)²)),
//!
//! which is 1 + O((hω)⁴) for β = 1/12 only.

mod claims;
mod exchange;
mod picture;
mod series;

use anyhow::Result;
use dvi_core::methods::Method;
use dvi_core::prelude::*;

use crate::claim::larger;
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::SpringChain;
use exchange::{Exchange, speed};
use series::Series;

pub const EXPERIMENT: Experiment = Experiment {
    name: "spring-chain",
    title: "Newmark's method on a chain of stiff and soft springs, beside RK4",
    share: 5.0,
    run,
};

const OMEGA: f64 = 50.0;
const CHAIN: SpringChain = SpringChain { m: 3, omega: OMEGA };
const BETAS: [f64; 4] = [0.0, 1.0 / 12.0, 1.0 / 6.0, 0.25];
const NAMES: [&str; 4] = ["β = 0", "β = 1/12", "β = 1/6", "β = 1/4"];
/// The step, with hω = 1, and a long one, with hω = 5.
const H: f64 = 1.0 / OMEGA;
const LONG: f64 = 5.0 / OMEGA;
/// The step of the reference.
const FINE: f64 = 0.1 / OMEGA;
/// Where the centre of the first pair begins; all but the first are for means.
const CENTRES: [f64; 8] = [1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3];
/// The time over which speeds are compared, and that of the references.
const COMPARED: f64 = 150.0;
const FOLLOWED: f64 = 220.0;
/// The time at which the order is measured, and the steps.
const ORDER_TIME: f64 = 1.0;
const ORDER_STEPS: [f64; 4] = [0.002, 0.001, 0.0005, 0.00025];

/// All that is measured.
struct Measured {
    end: f64,
    /// With each of [`BETAS`].
    newmark: [Series; 4],
    rk4: Series,
    /// Of the first of [`CENTRES`]: in the motion, with each of [`BETAS`], and with β = 1/4 and the long
    /// step.
    motion: Exchange,
    exchanges: [Exchange; 4],
    long: Exchange,
    /// The largest |E − E(0)| of the long step.
    long_energy: f64,
    /// The mean over the starts of the speed of the exchange over that of the motion, for each of [`BETAS`].
    speeds: [f64; 4],
    /// Whether a run is lost that has 0.97 and 1.03 times the longest stable step, for each of [`BETAS`] but
    /// the last.
    lost: [[bool; 2]; 3],
    /// The distances from the reference at [`ORDER_TIME`], for each of [`BETAS`] and [`ORDER_STEPS`].
    errors: [[f64; 4]; 4],
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(1e4, 100.0);
    let starts = job.choose(CENTRES.len(), 1);
    job.expect(5 * (end / H).round() as u64);
    let long = Newmark::new(0.25);
    let mut measured = Measured {
        end,
        newmark: series(job, end)?,
        rk4: Series::new(job, "RK4", RungeKutta::classical(), 1.0, end)?,
        motion: Exchange::new(Gauss::<4>::new(), CENTRES[0], FINE, FOLLOWED)?,
        exchanges: [Exchange::default(), Exchange::default(), Exchange::default(), Exchange::default()],
        long: Exchange::new(long, CENTRES[0], LONG, COMPARED)?,
        long_energy: Series::largest_energy(long, LONG, COMPARED)?,
        speeds: [0.0; 4],
        lost: lost()?,
        errors: errors()?,
    };
    for (start, &centre) in CENTRES.iter().take(starts).enumerate() {
        let motion = Exchange::new(Gauss::<4>::new(), centre, FINE, FOLLOWED)?;
        for (k, beta) in BETAS.into_iter().enumerate() {
            let exchange = Exchange::new(Newmark::new(beta), centre, H, COMPARED)?;
            measured.speeds[k] += speed(&exchange, &motion) / starts as f64;
            if start == 0 {
                measured.exchanges[k] = exchange;
            }
        }
    }
    job.publish(EXPERIMENT.name, picture::figure(&measured), picture::table(&measured)?)?;
    Ok(Outcome { claims: claims::claims(job, &measured), references: vec![], notes: vec![] })
}

fn series(job: &Job<'_>, end: f64) -> Result<[Series; 4]> {
    let of = |k: usize| Series::new(job, NAMES[k], Newmark::new(BETAS[k]), stiffness(BETAS[k], H), end);
    Ok([of(0)?, of(1)?, of(2)?, of(3)?])
}

/// The factor of the stiffness in the energy that the method conserves on an oscillator.
fn stiffness(beta: f64, h: f64) -> f64 {
    1.0 + (beta - 0.25) * (h * OMEGA).powi(2)
}

/// The speed of the exchange over that of the motion, by the formula above.
fn expected_speed(beta: f64, h: f64) -> f64 {
    1.0 / ((1.0 + beta * (h * OMEGA).powi(2)) * stiffness(beta, h).sqrt())
}

/// Whether runs just below and just above (¼ − β)(hω)² = 1 are lost.
fn lost() -> Result<[[bool; 2]; 3]> {
    let mut lost = [[false; 2]; 3];
    for (lost, beta) in lost.iter_mut().zip(BETAS) {
        let limit = 1.0 / (OMEGA * (0.25 - beta).sqrt());
        for (lost, part) in lost.iter_mut().zip([0.97, 1.03]) {
            let h = part * limit;
            let mut run = Integrator::new(&CHAIN, Newmark::new(beta), h, CHAIN.first_pair(CENTRES[0]))?;
            let begin = run.energy();
            // A factor of 10³ is more than the energy of the longest stable steps varies by.
            let grown = |energy: f64| energy.is_nan() || energy > 1e3 * begin;
            *lost = (0..(200.0 / h) as u64).any(|_| run.advance().is_err() || grown(run.energy()));
        }
    }
    Ok(lost)
}

fn errors() -> Result<[[f64; 4]; 4]> {
    fn place<M: Method<SpringChain, f64>>(method: M, h: f64) -> Result<Vec<f64>> {
        let mut run = Integrator::new(&CHAIN, method, h, CHAIN.first_pair(CENTRES[0]))?;
        run.take_steps((ORDER_TIME / h).round() as u64)?;
        Ok(run.state().q)
    }
    let expected = place(Gauss::<4>::new(), ORDER_STEPS[0])?;
    let mut errors = [[f64::NAN; 4]; 4];
    for (errors, beta) in errors.iter_mut().zip(BETAS) {
        for (error, h) in errors.iter_mut().zip(ORDER_STEPS) {
            let found = place(Newmark::new(beta), h)?;
            *error = found.iter().zip(&expected).map(|(a, b)| (a - b).abs()).fold(0.0, larger);
        }
    }
    Ok(errors)
}
