//! How many steps Simpson's rule, phase-fitted, and linear rules take over one period of a Kepler orbit for
//! the same energy error.

use super::kepler::*;
use crate::vocabulary::*;

/// Of a factor 1000, down to 10⁻⁴.
const BISECTIONS: u32 = 17;

/// How the steps of a run are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Steps {
    /// All of one length; phase fitting takes (19) as a part of L_d.
    Fixed,
    /// By (23) as printed; phase fitting takes (19) at the left end of a step.
    Controlled,
}
pub use Steps::{Controlled, Fixed};

/// Simpson's rule, phase-fitted, against a linear rule: the largest energy error that both have, and the
/// numbers of steps over one period.
pub struct Comparison {
    pub steps: Steps,
    pub e: f64,
    pub reference: &'static str,
    pub energy: f64,
    pub fitted: f64,
    pub linear: f64,
}

pub const SIMPSON: &str = "Simpson, linear";
pub const REFERENCES: [(&str, Quadrature, Colour); 3] = [
    ("midpoint", Quadrature::midpoint(), BLUE),
    ("trapezoid", Quadrature::trapezoid(), GREEN),
    (SIMPSON, Quadrature::simpson(), SLATE),
];

/// How fine the phase-fitted runs are: steps per period, or the reciprocal of the tolerance.
pub fn finenesses(steps: Steps, e: f64) -> [f64; 3] {
    match steps {
        Fixed if e > 0.9 => [2000.0, 8000.0, 32_000.0],
        Fixed => [500.0, 2000.0, 8000.0],
        Controlled => [1e2, 1e3, 1e4],
    }
}

pub fn equal_errors(job: &Job<'_>, steps: Steps, e: f64, fineness: f64) -> Result<Vec<Comparison>> {
    let reading = if steps == Fixed { Reading::Variational } else { Reading::LeftFrozen };
    let fitted = Variational::new(Quadrature::simpson()).phase_fitted(Curvature(reading));
    let fitted = one_period(job, steps, fitted, e, fineness);
    let fitted = fitted.with_context(|| format!("the phase-fitted run at e = {e}"))?;
    let needed = |&(reference, rule, _): &(&'static str, Quadrature, Colour)| {
        // For the same energy error, by bisection.
        let linear = Variational::new(rule).phase_fitted(Unfitted);
        let (mut low, mut high) = (fineness / 30.0, fineness * 30.0);
        for _ in 0..BISECTIONS {
            let middle = (low * high).sqrt();
            // Very coarse runs may fail: they are too coarse.
            let is_fine = |course: Course| course.energy <= fitted.energy;
            let course = one_period(job, steps, linear, e, middle);
            if course.is_ok_and(is_fine) { high = middle } else { low = middle }
        }
        let linear = one_period(job, steps, linear, e, high)?.steps;
        Ok(Comparison { steps, e, reference, energy: fitted.energy, fitted: fitted.steps, linear })
    };
    REFERENCES.iter().map(needed).collect()
}

fn one_period(job: &Job<'_>, steps: Steps, by: impl KeplerMethod, e: f64, fineness: f64) -> Result<Course> {
    let orbit = Orbit { e };
    match steps {
        Fixed => follow(job, &mut fixed(by, orbit, fineness.round())?, 1, |_| ()),
        Controlled => follow(job, &mut osculating(by, orbit, 1.0 / fineness)?, 1, |_| ()),
    }
}

impl Comparison {
    pub fn ratio(&self) -> f64 {
        self.fitted / self.linear
    }
}
