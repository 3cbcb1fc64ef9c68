//! The energy of a bouncing particle as a random walk, over many starts.

use super::bounces::{FLOOR, LAWS, START, STEPS};
use crate::vocabulary::*;

/// Numbers of bounces, each twice the one before, after which the change of the energy is looked at.
const BOUNCES: [u64; 9] = [8, 16, 32, 64, 128, 256, 512, 1024, 2048];

/// The root mean square of E − E(0): by the discrete energy, with half the step, by the energy.
pub struct Walks([Vec<[f64; 2]>; 3]);

impl Walks {
    pub fn new(job: &Job<'_>) -> Result<Self> {
        let ([coarse, fine], [discrete, at_impact]) = (STEPS, LAWS);
        let walk = |(law, h)| walk(job, law, h);
        Ok(Self(each([(discrete, coarse), (discrete, fine), (at_impact, coarse)], walk)?))
    }

    pub fn check(&self, job: &Job<'_>, claim: Claim) -> Claim {
        let [variational, half, reflecting] = &self.0;
        let exponent = |walk: &[[f64; 2]]| job.only_full(order(walk.iter().map(|&[n, rms]| (n, rms))));
        let last = |walk: &[[f64; 2]]| walk.last().map_or(f64::NAN, |point| point[1]);
        let over = |other| job.only_full(last(variational) / last(other));
        let square = "root mean square after 2048 bounces, over that";
        claim
            .near("exponent of the root mean square of ΔE", exponent(variational), [0.5, 0.1])
            .at_most("the same where the energy is kept", exponent(reflecting), 0.2)
            .at_least(format!("{square} where the energy is kept"), over(reflecting), 20.0)
            .near(format!("{square} with half the step"), over(half), [4.0, 1.2])
    }

    pub fn panel(&self) -> Panel {
        let ([discrete, half, at_impact], [h, shorter]) = (self.0.clone(), STEPS);
        let scale = discrete.first().map_or(f64::NAN, |[n, deviation]| 2.0 * deviation / n.sqrt());
        let guide = [8.0_f64, 2048.0].map(|n| [n, scale * n.sqrt()]).to_vec();
        let mean = Axis::logarithmic("root mean square of *E* − *E*(0)");
        let panel = Panel::new("Many starts", Axis::logarithmic("bounces"), mean).lines([
            (format!("discrete energy, *h* = {h}"), solid(BLUE), discrete),
            (format!("discrete energy, *h* = {shorter}"), dashed(SKY), half),
            (format!("energy at the impact, *h* = {h}"), solid(GREEN), at_impact),
            ("square root of the number of bounces".into(), dashed(SLATE).width(1.0), guide),
        ]);
        panel.legend_at(Corner::Beside)
    }
}

fn walk(job: &Job<'_>, law: Collision, h: f64) -> Result<Vec<[f64; 2]>> {
    let (starts, mut squares) = (job.choose(60, 6), BOUNCES.map(|_| 0.0));
    for k in 0..starts {
        let start = BouncerState { x: 0.3 + 0.011 * f64::from(k), ..START };
        let mut run = Integrator::new(&FLOOR, trapezoid(law), h, start)?;
        let begin = run.energy();
        for (bounces, square) in BOUNCES.into_iter().zip(&mut squares) {
            while run.memory().total() < bounces {
                run.advance()?;
            }
            *square += (run.energy() - begin).powi(2) / f64::from(starts);
        }
    }
    Ok(BOUNCES.into_iter().zip(squares).map(|(n, square): (_, f64)| [n as f64, square.sqrt()]).collect())
}
