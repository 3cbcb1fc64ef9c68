//! Two billiards: the section of an integrable one and of a chaotic one.
//!
//! Between impacts a particle is free, and steps of any length follow its straight path. What is computed is
//! where and when the path meets the curve, within each step. In an ellipse the product of the angular
//! momenta about the foci is a constant of the motion, so that each orbit has a curve in the section
//! (Birkhoff 1927). In the curve x⁴ + y⁴ = 1 some orbits fill regions of it.

mod claims;
mod orbit;
mod picture;

use anyhow::Result;
use dvi_core::prelude::*;
use rayon::prelude::*;

use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{EllipseBilliard, RoundedSquareBilliard};
use orbit::{Orbit, distance_of_laws, there_and_back};

pub const EXPERIMENT: Experiment = Experiment {
    name: "billiard",
    title: "Billiards in an ellipse and in a rounded square: sections by impacts",
    share: 7.0,
    run,
};

const ELLIPSE: EllipseBilliard = EllipseBilliard { a: 1.25, b: 0.8 };
/// The length of the steps; the particle has speed 1, and crosses the curves in about twenty.
const H: f64 = 0.1;
/// Steps in which there are several impacts.
const LONG: f64 = 5.0;
/// The number of orbits, from points on the x axis upwards to the right.
const ORBITS: u32 = 14;
/// So many impacts are followed there and back.
const REVERSED: u64 = 12;
/// The number of impacts up to which runs with both laws are compared.
const COMPARED: u64 = 1000;

/// All that is measured.
struct Measured {
    impacts: u64,
    ellipse: Vec<Orbit>,
    square: Vec<Orbit>,
    /// The same orbits in the ellipse by long steps.
    long: Vec<Orbit>,
    /// The largest distance of runs in the ellipse with the two laws of impact.
    of_laws: f64,
    there_and_back: f64,
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let impacts = job.choose(100_000, 500);
    job.expect(3 * u64::from(ORBITS) * impacts);
    let all = |orbit: &(dyn Fn(u32) -> Result<Orbit> + Sync)| -> Result<Vec<Orbit>> {
        (0..ORBITS).into_par_iter().map(orbit).collect()
    };
    let measured = Measured {
        impacts,
        ellipse: all(&|number| Orbit::in_ellipse(job, number, H, impacts))?,
        square: all(&|number| Orbit::in_square(job, number, H, impacts))?,
        long: all(&|number| Orbit::in_ellipse(job, number, LONG, impacts))?,
        of_laws: distance_of_laws()?,
        there_and_back: there_and_back()?,
    };
    job.publish(EXPERIMENT.name, picture::figure(&measured), picture::table(&measured)?)?;
    Ok(Outcome { claims: claims::claims(job, &measured), references: vec![], notes: vec![] })
}

type Method = Impacts<Variational<dvi_core::discrete::Unfitted, dvi_core::discrete::Trapezoid>>;

fn method(collision: Collision) -> Method {
    Impacts { collision, ..Impacts::new(Variational::trapezoid()) }
}
