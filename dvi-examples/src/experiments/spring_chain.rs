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

use crate::models::SpringChain;
use crate::vocabulary::*;

const OMEGA: f64 = 50.0;
const CHAIN: SpringChain = SpringChain { m: 3, omega: OMEGA };
const BETAS: [(f64, &str, Colour); 4] = [
    (0.0, "β = 0", BLUE),
    (1.0 / 12.0, "β = 1/12", GREEN),
    (1.0 / 6.0, "β = 1/6", AMBER),
    (0.25, "β = 1/4", PURPLE),
];
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

/// E − E(0) and I − I(0), where I is the sum of the energies of the stiff springs with the stiffness of the
/// method; and I/I(0) at t = 20.
type Kept = (Series<2>, f64);

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(1e4, 100.0);
    let starts = job.choose(CENTRES.len(), 1);
    job.expect(5 * (end / H).round() as u64);
    let newmark = each(BETAS, |(beta, name, colour)| {
        kept(job, name, colour, Newmark::new(beta), stiffness(beta, H), end)
    })?;
    let rk4 = kept(job, "RK4", VERMILLION, RungeKutta::classical(), 1.0, end)?;
    let motion = Exchange::new(Gauss::<4>::new(), CENTRES[0], FINE, FOLLOWED)?;
    let exchanges = each(BETAS, |(beta, ..)| Exchange::new(Newmark::new(beta), CENTRES[0], H, COMPARED))?;
    let long = Exchange::new(Newmark::new(0.25), CENTRES[0], LONG, COMPARED)?;
    let series = || [&rk4].into_iter().chain(&newmark).map(|(series, _)| series);
    let figure = figure(&series().collect::<Vec<_>>(), &motion, &exchanges, &long, end);
    let over_time = series().flat_map(|series| {
        let errors = series.kept[0].envelope.magnitude().into_iter();
        errors.map(|[t, error]| ([&series.name], vec![Some(H), Some(t), Some(error), None, None, None]))
    });
    let named = BETAS.iter().zip(&exchanges).map(|((_, name, _), exchange)| (*name, H, exchange));
    let exchanged = named.chain([("motion", 0.0, &motion), (BETAS[3].1, LONG, &long)]);
    let exchanged: Vec<_> = exchanged.map(|(name, h, exchange)| (name.to_owned(), h, exchange)).collect();
    let of_springs = exchanged.iter().flat_map(|(name, h, Exchange(means))| {
        let rows = means.iter().enumerate().map(move |(k, mean)| {
            let [first, second, third] = mean.map(Some);
            vec![Some(*h), Some(k as f64 + 0.5), None, first, second, third]
        });
        rows.map(move |row| ([name], row))
    });
    let columns = ["series", "h", "t", "energy_error", "first", "second", "third"];
    job.publish(figure, Table::of(&columns, over_time.chain(of_springs))?)?;
    Ok(vec![
        energy(job, &newmark),
        sum(job, &newmark),
        beyond("RK4 with steps of the same length takes all energy from the stiff springs")
            .at_most("RK4: I/I(0) at t = 20", rk4.1, 1e-3)
            .at_least("RK4: largest |ΔE|, of 2", rk4.0.kept[0].largest, 0.9),
        speeds(job, starts)?,
        long_steps(&motion, &long)?,
        stability()?,
        order_of_coordinates()?,
    ]
    .into())
}

/// The factor of the stiffness in the energy that the method conserves on an oscillator.
fn stiffness(beta: f64, h: f64) -> f64 {
    1.0 + (beta - 0.25) * (h * OMEGA).powi(2)
}

/// The speed of the exchange over that of the motion, by the formula above.
fn expected_speed(beta: f64, h: f64) -> f64 {
    1.0 / ((1.0 + beta * (h * OMEGA).powi(2)) * stiffness(beta, h).sqrt())
}

fn kept(
    job: &Job<'_>,
    name: &str,
    colour: Colour,
    method: impl Method<SpringChain, f64>,
    stiffness: f64,
    end: f64,
) -> Result<Kept> {
    let mut run = Integrator::new(&CHAIN, method, H, CHAIN.first_pair(CENTRES[0]))?;
    let sum = |state| CHAIN.oscillatory(&state, stiffness).iter().sum::<f64>();
    let (energy, begin, mut left) = (run.energy(), sum(run.state()), f64::NAN);
    let span = Span { end, early: 0.01 * end, intervals: 300 };
    let kept = job.keep(&mut run, (end / H).round() as u64, span, |run| {
        let now = sum(run.state());
        if run.steps() == (20.0 / H).round() as u64 {
            left = now / begin;
        }
        [run.energy() - energy, now - begin]
    })?;
    Ok((Series::new(name, Stroke::solid(colour), kept), left))
}

fn energy(job: &Job<'_>, newmark: &[Kept; 4]) -> Claim {
    let energies = newmark.each_ref().map(|(series, _)| &series.kept[0]);
    let growth = job.only_full(largest(energies.map(Deviation::growth)));
    let ratio = energies[0].largest / energies[3].largest;
    beyond(format!(
        "hω = {}: the energy of Newmark's method does not drift; its error is the smaller, the nearer β is \
         to 1/4",
        H * OMEGA
    ))
    .each(
        BETAS.into_iter().zip(energies).zip([0.2, 0.13, 0.06, 1.5e-3]),
        |claim, (((_, name, _), energy), bound)| {
            claim.of(name).at_most("largest |ΔE|", energy.largest, bound)
        },
    )
    .at_least("β = 0: largest |ΔE| / that with β = 1/4", ratio, 100.0)
    .at_most("largest |ΔE| over all / in the first hundredth", growth, 1.1)
}

fn sum(job: &Job<'_>, newmark: &[Kept; 4]) -> Claim {
    let all =
        |value: fn(&Deviation) -> f64| largest(newmark.iter().map(|(series, _)| value(&series.kept[1])));
    let trend = job.only_full(all(|sum| sum.drift().abs()));
    beyond("the sum I of the energies of the stiff springs, with the stiffness of the method, has no trend")
        .at_most("all β: largest |I − I(0)|, of 1", all(|sum| sum.largest), 0.12)
        .at_most(
            "all β: difference of the means of I in the last and the first tenth of the run",
            trend,
            0.001,
        )
}

fn speeds(job: &Job<'_>, starts: usize) -> Result<Claim> {
    let mut speeds = [0.0; 4];
    for &centre in &CENTRES[..starts] {
        let motion = Exchange::new(Gauss::<4>::new(), centre, FINE, FOLLOWED)?;
        for (speed, (beta, ..)) in speeds.iter_mut().zip(BETAS) {
            *speed += Exchange::new(Newmark::new(beta), centre, H, COMPARED)?.speed(&motion) / starts as f64;
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

fn long_steps(motion: &Exchange, long: &Exchange) -> Result<Claim> {
    let mut run = Integrator::new(&CHAIN, Newmark::new(0.25), LONG, CHAIN.first_pair(CENTRES[0]))?;
    let (begin, mut most) = (run.energy(), 0.0);
    for _ in 0..(COMPARED / LONG).round() as u64 {
        run.advance()?;
        most = larger(most, (run.energy() - begin).abs());
    }
    let [motion, long] =
        [motion, long].map(|of| of.0.get(COMPARED as usize - 1).map_or(f64::NAN, |mean| mean[0]));
    let first = format!("energy of the first stiff spring at t = {COMPARED}");
    Ok(beyond(format!(
        "hω = {}: with β = 1/4 the energy does not drift, but there is next to no exchange: the step is \
         stable and the motion another",
        LONG * OMEGA
    ))
    .at_most("long step: largest |ΔE|", most, 0.02)
    .at_most(format!("motion: {first}"), motion, 0.05)
    .at_least(format!("long step: {first}"), long, 0.7))
}

/// Whether runs just below and just above (¼ − β)(hω)² = 1 are lost.
fn stability() -> Result<Claim> {
    let mut claim = beyond("the longest stable step is that of an oscillator: (¼ − β)(hω)² < 1");
    for (beta, name, _) in &BETAS[..3] {
        for part in [0.97, 1.03] {
            let h = part * (1.0 / (OMEGA * (0.25 - beta).sqrt()));
            let mut run = Integrator::new(&CHAIN, Newmark::new(*beta), h, CHAIN.first_pair(CENTRES[0]))?;
            let begin = run.energy();
            // A factor of 10³ is more than the energy of the longest stable steps varies by.
            let grown = |energy: f64| energy.is_nan() || energy > 1e3 * begin;
            let lost =
                indicator((0..(200.0 / h) as u64).any(|_| run.advance().is_err() || grown(run.energy())));
            let quantity = format!("{name}: runs lost of one with {part} times that step");
            claim = if part < 1.0 {
                claim.at_most(quantity, lost, 0.0)
            } else {
                claim.at_least(quantity, lost, 1.0)
            };
        }
    }
    Ok(claim)
}

fn order_of_coordinates() -> Result<Claim> {
    fn place(method: impl Method<SpringChain, f64>, h: f64) -> Result<Vec<f64>> {
        Ok(up_to(&CHAIN, method, h, CHAIN.first_pair(CENTRES[0]), ORDER_TIME)?.q)
    }
    let expected = place(Gauss::<4>::new(), ORDER_STEPS[0])?;
    let orders = each(BETAS, |(beta, ..)| {
        order_of(ORDER_STEPS, |h| Ok((h, apart(&place(Newmark::new(beta), h)?, &expected))))
    })?;
    Ok(beyond(format!("the coordinates at t = {ORDER_TIME} are of second order for all β"))
        .each(BETAS.into_iter().zip(orders), |claim, ((_, name, _), order)| {
            claim.of(name).near("order", order, [2.0, 0.05])
        }))
}

/// The energy of each stiff spring, on average over each unit of time.
struct Exchange(Vec<[f64; 3]>);

impl Exchange {
    fn new(method: impl Method<SpringChain, f64>, centre: f64, h: f64, end: f64) -> Result<Self> {
        let mut run = Integrator::new(&CHAIN, method, h, CHAIN.first_pair(centre))?;
        let of_unit = (1.0 / h).round() as u64;
        let mut means = Vec::new();
        for _ in 0..end.round() as u64 {
            let mut mean = [0.0; 3];
            for _ in 0..of_unit {
                run.advance()?;
                for (mean, energy) in mean.iter_mut().zip(CHAIN.oscillatory(&run.state(), 1.0)) {
                    *mean += energy / of_unit as f64;
                }
            }
            means.push(mean);
        }
        Ok(Self(means))
    }

    /// [t, energy] of stiff spring `j`, at the middle of each unit of time.
    fn points(&self, j: usize) -> Vec<[f64; 2]> {
        self.0.iter().enumerate().map(|(k, mean)| [k as f64 + 0.5, mean[j]]).collect()
    }

    /// Between the means.
    fn at(&self, t: f64) -> Option<[f64; 3]> {
        let place = (t - 0.5).max(0.0);
        let (k, part) = (place.floor() as usize, place.fract());
        let [before, after] = [self.0.get(k)?, self.0.get(k + 1)?];
        Some(std::array::from_fn(|j| before[j] + part * (after[j] - before[j])))
    }

    /// The mean square of the difference from those of `motion` at times that are `speed` times as long.
    fn apart(&self, motion: &Self, speed: f64) -> f64 {
        let pairs = self.0.iter().enumerate();
        let squares = pairs.map(|(k, mean)| match motion.at(speed * (k as f64 + 0.5)) {
            Some(other) => mean.iter().zip(other).map(|(a, b)| (a - b).powi(2)).sum::<f64>(),
            None => f64::INFINITY,
        });
        squares.sum::<f64>() / self.0.len() as f64
    }

    /// How many times as fast as in `motion` the energies are exchanged: the factor of time with the least
    /// mean square of differences.
    fn speed(&self, motion: &Self) -> f64 {
        let factors = (0..=1000).map(|i| 0.4 + 0.001 * f64::from(i));
        let apart = factors.map(|factor| (factor, self.apart(motion, factor)));
        apart.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(f64::NAN, |(factor, _)| factor)
    }
}

fn figure(
    all: &[&Series<2>],
    motion: &Exchange,
    exchanges: &[Exchange; 4],
    long: &Exchange,
    end: f64,
) -> Figure {
    let springs = [("first", BLUE), ("second", GREEN), ("third", VERMILLION)];
    let exchange = |shown: &Exchange, title: String| {
        let energies = Axis::linear("energies of the stiff springs").within(0.0, 1.7);
        let grey = Stroke::solid(SLATE).width(3.0).opacity(0.35);
        Panel::new(title, Axis::time(COMPARED), energies)
            .each(0..3, |panel, j| panel.line(motion.points(j), grey))
            .lines(
                springs
                    .iter()
                    .enumerate()
                    .map(|(j, (name, colour))| (*name, Stroke::solid(*colour).width(1.4), shown.points(j))),
            )
    };
    let titled = |k: usize| {
        let (beta, name, _) = BETAS[k];
        exchange(&exchanges[k], format!("{name} ({:.2})", expected_speed(beta, H)))
    };
    let long = exchange(long, format!("β = 1/4, *h* = {LONG}")).without_legend();
    let energy = over_time(["Energy", "largest |*E* − *E*(0)|"], end, [1e-4, 10.0], all.iter().copied(), 0);
    let labels = ["Sum *I* of the energies of the stiff springs", "largest |*I* − *I*(0)|"];
    let sum = over_time(labels, end, [1e-2, 10.0], all.iter().copied(), 1);
    Figure::new(
        format!("Newmark's method on a chain of {} stiff springs, ω = {OMEGA}, between soft ones", CHAIN.m),
        format!(
            "Masses are 1; at the start all energy is in the first pair, *E* ≈ 2. *h* = {H}, so that \
                 *hω* = {}.",
            H * OMEGA
        ),
    )
    .row(300.0, vec![titled(0), titled(1).without_legend(), titled(3).without_legend(), long])
    .row(330.0, vec![energy.without_legend(), sum.legend_at(Corner::Beside).weight(1.25)])
    .footer(
        "Above: energies of the three stiff springs, means over units of time, on those of the motion \
         (grey, Gauss's method of order 8). In brackets: the speed of the exchange by the formula.",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_speed_of_a_slowed_exchange_is_found() {
        let of = |rate: f64, end: u32| {
            let energy = |k: u32| [0.0, 1.0, 2.0].map(|j| (rate * 0.05 * (f64::from(k) + 0.5) + j).sin());
            Exchange((0..end).map(energy).collect())
        };
        let found = of(0.8, 100).speed(&of(1.0, 200));
        assert!((found - 0.8).abs() < 0.002, "{found}");
    }
}
