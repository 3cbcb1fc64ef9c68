//! Newmark's method on a chain of stiff and soft springs: energies over a long time, and how fast the stiff
//! springs exchange theirs.
//!
//! With γ = ½ the method is variational (Kane, Marsden, Ortiz & West 2000), so that its energy does not
//! drift. In the motion the sum of the energies of the stiff springs is an adiabatic invariant, and they
//! exchange energy on the time scale ω (Hairer, Lubich & Wanner 2006, section I.5.1 and chapter XIII).
//! Newmark's method keeps that sum with the stiffness sω², s = 1 + (β − ¼)(hω)², which it conserves on an
//! oscillator. But it changes the speed of the exchange.

use super::exchange::*;
use crate::vocabulary::*;

const LONG: f64 = 5.0 / OMEGA;

/// E − E(0) and I − I(0), where I is the sum of the energies of the stiff springs with the stiffness of the
/// method; and I/I(0) at t = 20.
type Kept = (Series<2>, f64);

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(1e4, 100.0);
    job.expect(5 * (end / H).round() as u64);
    let newmark = each(BETAS, |(beta, name, colour)| {
        kept(job, (name, solid(colour)), first().any(Newmark::new(beta), H)?, stiffness(beta, H), end)
    })?;
    let rk4 = kept(job, ("RK4", solid(VERMILLION)), first().any(RungeKutta::classical(), H)?, 1.0, end)?;
    let motion = Exchange::motion(CENTRES[0])?;
    let exchanges = each(BETAS, |(beta, ..)| Exchange::newmark(beta, CENTRES[0], H))?;
    let long = Exchange::newmark(0.25, CENTRES[0], LONG)?;
    let series: Vec<&Series<2>> = [&rk4].into_iter().chain(&newmark).map(|(series, _)| series).collect();
    let over_time = series.iter().flat_map(|series| {
        let errors = series.kept[0].magnitude().into_iter();
        errors.map(|[t, error]| (&*series.name, [Some(H), Some(t), Some(error), None, None, None]))
    });
    let named = BETAS.iter().zip(&exchanges).map(|((_, name, _), exchange)| (*name, H, exchange));
    let named = named.chain([("motion", 0.0, &motion), (BETAS[3].1, LONG, &long)]);
    let of_springs = named.flat_map(|(name, h, Exchange(means))| {
        means.iter().enumerate().map(move |(k, mean)| {
            let [first, second, third] = mean.map(Some);
            (name, [Some(h), Some(k as f64 + 0.5), None, first, second, third])
        })
    });
    let rows = over_time.chain(of_springs).map(|(name, numbers)| ([name], numbers));
    let table = Table::of("series,h,t,energy_error,first,second,third", rows);
    job.publish(figure(&series, &motion, &exchanges, &long, end), table)?;
    let [energies, sums] = [0, 1].map(|k: usize| newmark.each_ref().map(|(series, _)| &series.kept[k]));
    let growth = job.only_full(largest(energies.map(Envelope::growth)));
    let trend = job.only_full(largest(sums.map(|sum| sum.drift().abs())));
    let trends = "all β: difference of the means of I in the last and the first tenth of the run";
    let flat = "hω = 1: the energy of Newmark's method does not drift; its error is the smaller, the nearer \
                β is to 1/4";
    let sum =
        "the sum I of the energies of the stiff springs, with the stiffness of the method, has no trend";
    let (bounds, ratio) = ([0.2, 0.13, 0.06, 1.5e-3], energies[0].largest / energies[3].largest);
    claims([
        beyond(flat)
            .each(BETAS.into_iter().zip(energies).zip(bounds), |claim, (((_, name, _), energy), bound)| {
                claim.of(name).at_most("largest |ΔE|", energy.largest, bound)
            })
            .at_least("β = 0: largest |ΔE| / that with β = 1/4", ratio, 100.0)
            .at_most("largest |ΔE| over all / in the first hundredth", growth, 1.1),
        beyond(sum)
            .at_most("all β: largest |I − I(0)|, of 1", largest(sums.map(|sum| sum.largest)), 0.12)
            .at_most(trends, trend, 0.001),
        beyond("RK4 with steps of the same length takes all energy from the stiff springs")
            .at_most("RK4: I/I(0) at t = 20", rk4.1, 1e-3)
            .at_least("RK4: largest |ΔE|, of 2", rk4.0.kept[0].largest, 0.9),
        speeds(job)?,
        long_steps(&motion, &long)?,
        stability()?,
        order_of_coordinates()?,
    ])
}

fn first() -> Problem<'static, SpringChain> {
    Problem::new(&CHAIN, CHAIN.first_pair(CENTRES[0]))
}

fn kept(job: &Job<'_>, named: Named<'_>, mut run: AnyRun<'_, SpringChain>, s: f64, t: f64) -> Result<Kept> {
    let sum = |state| CHAIN.oscillatory(&state, s).iter().sum::<f64>();
    let (energy, begin, mut left) = (run.energy(), sum(run.state()), f64::NAN);
    let span = Span { end: t, early: 0.01 * t, intervals: 300 };
    let series = job.series(named, &mut run, span, |run, _| {
        let now = sum(run.state());
        if run.steps() == (20.0 / H).round() as u64 {
            left = now / begin;
        }
        [run.energy() - energy, now - begin]
    });
    Ok((series.whole()?, left))
}

fn long_steps(motion: &Exchange, long: &Exchange) -> Result<Claim> {
    let mut run = first().run(Newmark::new(0.25), LONG)?;
    let begin = run.energy();
    let energies =
        course(&mut run, (COMPARED as f64 / LONG).round() as u64, |run| (run.energy() - begin).abs())?;
    let [motion, long] = [motion, long].map(|of| of.0.get(COMPARED as usize - 1).map_or(f64::NAN, |m| m[0]));
    let first = format!("energy of the first stiff spring at t = {COMPARED}");
    Ok(beyond(format!(
        "hω = {}: with β = 1/4 the energy does not drift, but there is next to no exchange: the step is \
         stable and the motion another",
        LONG * OMEGA
    ))
    .at_most("long step: largest |ΔE|", largest(energies), 0.02)
    .at_most(format!("motion: {first}"), motion, 0.05)
    .at_least(format!("long step: {first}"), long, 0.7))
}

/// Whether runs just below and just above (¼ − β)(hω)² = 1 are lost.
fn stability() -> Result<Claim> {
    let mut claim = beyond("the longest stable step is that of an oscillator: (¼ − β)(hω)² < 1");
    for (beta, name, _) in &BETAS[..3] {
        let of = |part: f64| -> Result<f64> {
            let h = part * (1.0 / (OMEGA * (0.25 - beta).sqrt()));
            // A factor of 10³ is more than the energy of the longest stable steps varies by.
            Ok(is_lost(&mut first().run(Newmark::new(*beta), h)?, (200.0 / h) as u64, 1e3))
        };
        claim = claim
            .of(name)
            .at_most("runs lost of one with 0.97 times that step", of(0.97)?, 0.0)
            .at_least("runs lost of one with 1.03 times that step", of(1.03)?, 1.0);
    }
    Ok(claim)
}

fn order_of_coordinates() -> Result<Claim> {
    let expected = first().up_to(Gauss::<4>::new(), 0.002, 1.0)?.q;
    let errors = first().errors(1.0, &[500, 1000, 2000, 4000], |q| apart(q, &expected));
    let orders = each(BETAS, |(beta, ..)| errors.order(Newmark::new(beta)))?;
    let claim = beyond("the coordinates at t = 1 are of second order for all β");
    Ok(claim.each(BETAS.into_iter().zip(orders), |claim, ((_, name, _), order)| {
        claim.of(name).near("order", order, [2.0, 0.05])
    }))
}

fn figure(all: &[&Series<2>], motion: &Exchange, of: &[Exchange; 4], long: &Exchange, end: f64) -> Figure {
    let titled = |k: usize| {
        let (beta, name, _) = BETAS[k];
        of[k].panel(motion, format!("{name} ({:.2})", expected_speed(beta, H)))
    };
    let long = long.panel(motion, format!("β = 1/4, *h* = {LONG}")).without_legend();
    let energy = over_time(["Energy", "largest |*E* − *E*(0)|"], end, [1e-4, 10.0], all.iter().copied(), 0);
    let labels = ["Sum *I* of the energies of the stiff springs", "largest |*I* − *I*(0)|"];
    let sum = over_time(labels, end, [1e-2, 10.0], all.iter().copied(), 1);
    Figure::of(format!(
        "ω = {OMEGA}, *h* = {H}. Above: means of the energies of three stiff springs, on those of the \
         motion in grey; in brackets the speed of the exchange by the formula."
    ))
    .row(300.0, vec![titled(0), titled(1).without_legend(), titled(3).without_legend(), long])
    .row(330.0, vec![energy.without_legend(), sum.legend_at(Corner::Beside).weight(1.25)])
}
