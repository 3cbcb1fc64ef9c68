//! How fast the stiff springs of a chain exchange their energies, in the motion and by Newmark's method.
//!
//! With x = z(t)e^{iω̃t} and z slow, a soft force that is linear in x, −gx, turns z at the rate g/(2ω) in
//! the motion. With δ² the second difference, the method is (1 + βh²ω²)δ²x = −h²ω²x − h²(1 + βδ²)gx. There
//! the rate is g/(2ω) times
//!
//! 1 / ((1 + β(hω)²) √(1 + (β − ¼)(hω)²)),
//!
//! which is 1 + O((hω)⁴) for β = 1/12 only.

use crate::vocabulary::*;

pub const OMEGA: f64 = 50.0;
pub const CHAIN: SpringChain = SpringChain { m: 3, omega: OMEGA };
pub const BETAS: [(f64, &str, Colour); 4] = [
    (0.0, "β = 0", BLUE),
    (1.0 / 12.0, "β = 1/12", GREEN),
    (1.0 / 6.0, "β = 1/6", AMBER),
    (0.25, "β = 1/4", PURPLE),
];
pub const H: f64 = 1.0 / OMEGA;
/// Where the centre of the first pair begins; all but the first are for means.
pub const CENTRES: [f64; 8] = [1.0, 0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3];
/// The time over which speeds are compared.
pub const COMPARED: u64 = 150;

/// The factor of the stiffness in the energy that the method conserves on an oscillator.
pub fn stiffness(beta: f64, h: f64) -> f64 {
    1.0 + (beta - 0.25) * (h * OMEGA).powi(2)
}

/// The speed of the exchange over that of the motion, by the formula above.
pub fn expected_speed(beta: f64, h: f64) -> f64 {
    1.0 / ((1.0 + beta * (h * OMEGA).powi(2)) * stiffness(beta, h).sqrt())
}

pub fn speeds(job: &Job<'_>) -> Result<Claim> {
    let (mut speeds, starts) = ([0.0; 4], job.choose(CENTRES.len(), 1));
    for &centre in &CENTRES[..starts] {
        let motion = Exchange::motion(centre)?;
        for (speed, (beta, ..)) in speeds.iter_mut().zip(BETAS) {
            *speed += Exchange::newmark(beta, centre, H)?.speed(&motion) / starts as f64;
        }
    }
    let text = format!(
        "the stiff springs exchange their energies at 1/((1 + β(hω)²)√(1 + (β − ¼)(hω)²)) times the speed \
         of the motion, on average over {} starts",
        CENTRES.len()
    );
    Ok(beyond(text).each(BETAS.into_iter().zip(speeds), |claim, ((beta, name, _), speed)| {
        let expected = (1e4 * expected_speed(beta, H)).round() / 1e4;
        let quantity = "speed of the exchange / that of the motion";
        claim.of(name).near(quantity, job.only_full(speed), [expected, 0.04])
    }))
}

/// The energy of each stiff spring, on average over each unit of time.
pub struct Exchange(pub Vec<[f64; 3]>);

impl Exchange {
    pub fn motion(centre: f64) -> Result<Self> {
        Self::new(Gauss::<4>::new(), centre, 0.1 / OMEGA, 220)
    }

    pub fn newmark(beta: f64, centre: f64, h: f64) -> Result<Self> {
        Self::new(Newmark::new(beta), centre, h, COMPARED)
    }

    fn new(method: impl Method<SpringChain, f64>, centre: f64, h: f64, end: u64) -> Result<Self> {
        let mut run = Problem::new(&CHAIN, CHAIN.first_pair(centre)).run(method, h)?;
        let of_unit = (1.0 / h).round() as u64;
        let mut means = vec![[0.0; 3]; end as usize];
        for mean in &mut means {
            for _ in 0..of_unit {
                run.advance()?;
                let energies = mean.iter_mut().zip(CHAIN.oscillatory(&run.state(), 1.0));
                energies.for_each(|(mean, energy)| *mean += energy / of_unit as f64);
            }
        }
        Ok(Self(means))
    }

    /// [t, energy] of stiff spring `j`, at the middle of each unit of time.
    fn points(&self, j: usize) -> Vec<[f64; 2]> {
        self.0.iter().enumerate().map(|(k, mean)| [k as f64 + 0.5, mean[j]]).collect()
    }

    fn at(&self, t: f64) -> Option<[f64; 3]> {
        let place = (t - 0.5).max(0.0);
        let (k, part) = (place.floor() as usize, place.fract());
        let [before, after] = [self.0.get(k)?, self.0.get(k + 1)?];
        Some([0, 1, 2].map(|j: usize| before[j] + part * (after[j] - before[j])))
    }

    /// The mean square of the difference from those of `motion` at times that are `speed` times as long.
    fn apart(&self, motion: &Self, speed: f64) -> f64 {
        mean(self.0.iter().enumerate().map(|(k, mean)| match motion.at(speed * (k as f64 + 0.5)) {
            Some(other) => mean.iter().zip(other).map(|(a, b)| (a - b).powi(2)).sum::<f64>(),
            None => f64::INFINITY,
        }))
    }

    /// How many times as fast as in `motion` the exchange is, by the least mean square of differences.
    pub fn speed(&self, motion: &Self) -> f64 {
        let factors = (0..=1000).map(|i| 0.4 + 0.001 * f64::from(i));
        let apart = factors.map(|factor| (factor, self.apart(motion, factor)));
        apart.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(f64::NAN, |(factor, _)| factor)
    }

    pub fn panel(&self, motion: &Self, title: String) -> Panel {
        let springs = [("first", BLUE), ("second", GREEN), ("third", VERMILLION)].into_iter().zip(0..);
        let (time, energies) = (("time *t*", [0.0, COMPARED as f64]), "energies of the stiff springs");
        Panel::linear(title, time, (energies, [0.0, 1.7]))
            .each(0..3, |panel, j| panel.line(motion.points(j), solid(SLATE).width(3.0).opacity(0.35)))
            .lines(springs.map(|((name, colour), j)| (name, solid(colour).width(1.4), self.points(j))))
    }
}
