//! How the energy error of a rolling disc grows in long runs: on average over many starts, the largest
//! |E − E(0)| up to time t.

use super::disc::{MAGNET, PLACE, RATES, SPRINGS};
use super::sleigh::{H, midpoint};
use crate::vocabulary::*;

/// The end of the beginning, and of runs with half the step.
const EARLY: f64 = 100.0;
const HALVED: f64 = 1e4;
/// How many directions there are to start in.
pub const STARTS: u64 = 8;

/// The errors at times at equal ratios, as the path of a series.
type Growth = Series<0>;

/// With a magnet, with half the step and by RK4, and on springs, also by RK4.
pub struct Errors([Growth; 5]);

impl Errors {
    pub fn new(job: &Job<'_>) -> Result<Self> {
        let (end, half) = job.choose((5e4, HALVED), (500.0, 500.0));
        job.expect((STARTS as f64 * (4.0 * end / H + 2.0 * half / H)) as u64);
        let constrained = |named, disc: &'static RollingDisc, h, end| {
            growth(job, named, disc, [h, end], |begin| {
                let mut run = Problem::new(disc, begin).run(midpoint(), h)?;
                Ok(move || {
                    run.advance()?;
                    Ok(run.energy())
                })
            })
        };
        // On the numbers that the constraints leave free.
        let by_rk4 = |named, disc: &'static RollingDisc| {
            growth(job, named, disc, [H, end], |begin| {
                let state =
                    |&[x, y, phi, theta, turning]: &[f64; 5]| disc.rolling([x, y], phi, [theta, turning]);
                let free = |of: RollingDiscState| [of.x, of.y, of.phi, of.dot_theta, of.dot_phi];
                let mut now = free(begin);
                Ok(move || {
                    now = try_rk4(&now, H, |now| disc.vector_field(0.0, &state(now)).map(free))?;
                    Ok(disc.energy_at(0.0, &state(&now))?)
                })
            })
        };
        Ok(Self([
            constrained(("magnet", solid(VERMILLION)), &MAGNET, H, end)?,
            constrained(("magnet", solid(AMBER)), &MAGNET, H / 2.0, half)?,
            by_rk4(("magnet, RK4", dashed(VERMILLION)), &MAGNET)?,
            constrained(("springs", solid(BLUE)), &SPRINGS, H, end)?,
            by_rk4(("springs, RK4", dashed(BLUE)), &SPRINGS)?,
        ]))
    }

    pub fn table(&self) -> Result<Table> {
        let curves = self.0.iter().map(|growth| ([&growth.name], [growth.h], growth.path.iter().copied()));
        curve_table("series,h,t,largest_energy_error", curves)
    }

    pub fn panel(&self) -> Panel {
        let lines = self.0.iter().map(|Growth { name, h, stroke, path, .. }| {
            let name = if *h == H { name.clone() } else { format!("{name}, *h* = {h}") };
            (name, *stroke, path.clone())
        });
        let (time, error) = (Axis::logarithmic("time *t*"), Axis::logarithmic("largest |*E* − *E*(0)|"));
        Panel::new("Energy", time, error).lines(lines).legend_at(Corner::Beside).weight(1.4)
    }

    pub fn claims(&self, job: &Job<'_>) -> [Claim; 2] {
        let [whole, half, by_rk4, constrained, rk4] = &self.0;
        let growth = |of: &Growth| last(of) / up_to(of, EARLY);
        let over_all = format!("largest |ΔE| over all / up to t = {EARLY}");
        let over = |other: f64| job.only_full(last(whole) / other);
        let halved = job.only_full(up_to(half, HALVED) / up_to(whole, HALVED));
        let by_half = format!("magnet: largest |ΔE| up to t = {HALVED} with half the step / with the whole");
        let late = whole.path.iter().filter(|point| point[0] >= 0.999 * EARLY);
        let power = job.only_full(order(late.map(|&[t, error]| (t, error))));
        let magnet = "with a magnet that energy wanders away, by an amount of the order h², and RK4 with \
                      steps of the same length keeps it better";
        [
            beyond(format!(
                "on equal springs the energy error of constrained steps, on average over {STARTS} starts, \
                 does not grow, that of RK4 does"
            ))
            .at_most("constrained: largest |ΔE|", last(constrained), 1.2e-3)
            .at_most(format!("constrained: {over_all}"), growth(constrained), 1.02)
            .at_least("RK4: largest |ΔE|", job.only_full(last(rk4)), 1.2e-3)
            .at_least(format!("RK4: {over_all}"), job.only_full(growth(rk4)), 100.0),
            beyond(magnet)
                .at_least("magnet: largest |ΔE|", over(1.0), 0.1)
                .at_least("magnet: largest |ΔE| / on springs", over(last(constrained)), 100.0)
                .at_least(format!("magnet: {over_all}"), over(up_to(whole, EARLY)), 10.0)
                .within(format!("magnet: power of t by which it grows, from t = {EARLY}"), power, [0.4, 0.7])
                .within(by_half, halved, [0.15, 0.35])
                .at_least("magnet: largest |ΔE| / that of RK4", over(last(by_rk4)), 5.0),
        ]
    }
}

/// Of runs whose steps `begun` takes, each of which returns the energy after it.
fn growth<F: FnMut() -> Result<f64>>(
    job: &Job<'_>,
    named: Named<'_>,
    disc: &RollingDisc,
    [h, end]: [f64; 2],
    begun: impl Fn(RollingDiscState) -> Result<F>,
) -> Result<Growth> {
    let decades = end.log10();
    // Eight in a factor of ten.
    let count = (8.0 * decades).round().max(1.0);
    let times = (0..=count as u32).map(|k| 10f64.powf(f64::from(k) / count * decades));
    let mut points: Vec<[f64; 2]> = times.map(|t| [t, 0.0]).collect();
    for k in 0..STARTS {
        let begin = disc.rolling(PLACE, 0.3 + k as f64 * TAU / STARTS as f64, RATES);
        let (first, mut step) = (disc.energy_at(0.0, &begin)?, begun(begin)?);
        let (mut largest, mut steps, mut next) = (0.0, 0_u64, 0);
        job.repeat((end / h).round() as u64, || {
            largest = larger(largest, (step()? - first).abs());
            steps += 1;
            while next < points.len() && (steps as f64 + 0.5) * h > points[next][0] {
                points[next][1] += largest / STARTS as f64;
                next += 1;
            }
            anyhow::Ok(())
        })?;
    }
    Ok(Series { path: points, ..Series::new(named, h, []) })
}

/// Up to the last of the times that is not after `t`.
fn up_to(growth: &Growth, t: f64) -> f64 {
    let before = growth.path.iter().take_while(|point| point[0] <= 1.001 * t);
    before.last().map_or(f64::NAN, |point| point[1])
}

fn last(growth: &Growth) -> f64 {
    up_to(growth, f64::INFINITY)
}
