//! What the experiment claims.

use super::orbit::Orbit;
use super::{COMPARED, H, LONG, Measured, ORBITS, REVERSED};
use crate::claim::{BEYOND, Bound, Claim, larger};
use crate::job::Job;

pub(super) fn claims(job: &Job<'_>, measured: &Measured) -> Vec<Claim> {
    vec![ellipse(job, measured), square(job, measured), laws(measured)]
}

fn most(orbits: &[Orbit], of: impl Fn(&Orbit) -> f64) -> f64 {
    orbits.iter().map(of).fold(0.0, larger)
}

fn ellipse(job: &Job<'_>, measured: &Measured) -> Claim {
    let text = format!(
        "{ORBITS} orbits in an ellipse keep the product of the angular momenta about its foci over 10⁵ impacts, with steps of length {H} \
         and with steps of length {LONG}, in which there are several"
    );
    let Measured { ellipse, long, impacts, .. } = measured;
    Claim::new(BEYOND, text)
        .check("impacts of each orbit", job.only_full(*impacts as f64), Bound::AtLeast(1e5))
        .check("largest change of the product", most(ellipse, |orbit| orbit.product), Bound::AtMost(1e-11))
        .check("the same by long steps", most(long, |orbit| orbit.product), Bound::AtMost(1e-11))
        .check(
            "the most impacts in a long step",
            long.iter().map(|orbit| orbit.in_a_step).max().map(|most| most as f64),
            Bound::AtLeast(3.0),
        )
        .check("largest change of the energy", most(ellipse, |orbit| orbit.energy), Bound::AtMost(1e-12))
        .check("largest |g| at an impact", most(ellipse, |orbit| orbit.gap), Bound::AtMost(1e-14))
}

fn square(job: &Job<'_>, measured: &Measured) -> Claim {
    let text = "in x⁴ + y⁴ = 1 the energy is kept too, orbits of one energy fill a region of the section, and the way back is the way there";
    let spread = measured.square.iter().map(Orbit::filled).fold(0.0, larger);
    Claim::new(BEYOND, text)
        .check(
            "largest change of the energy",
            most(&measured.square, |orbit| orbit.energy),
            Bound::AtMost(1e-12),
        )
        .check("largest |g| at an impact", most(&measured.square, |orbit| orbit.gap), Bound::AtMost(1e-14))
        .check("squares of the section that one orbit visits", job.only_full(spread), Bound::AtLeast(0.5))
        .check(
            "the same in the ellipse",
            measured.ellipse.iter().map(Orbit::filled).fold(0.0, larger),
            Bound::AtMost(0.3),
        )
        .check(
            format!("distance from the start after {REVERSED} impacts there and back"),
            measured.there_and_back,
            Bound::AtMost(1e-10),
        )
}

fn laws(measured: &Measured) -> Claim {
    let text = format!(
        "between impacts the discrete energy of a free particle is its energy, so that both laws of impact give one orbit, over {COMPARED} \
         impacts in the ellipse"
    );
    Claim::new(BEYOND, text).check("largest distance", measured.of_laws, Bound::AtMost(1e-8))
}
