//! A sleigh on a blade, which turns around and ends in straight motion: to that no symplectic map could
//! lead.

use crate::vocabulary::*;

const SLEIGH: ChaplyginSleigh = ChaplyginSleigh { inertia: 1.0, a: 0.5 };
/// At the origin in the direction of x, backwards and in rotation.
const START: ChaplyginSleighState =
    ChaplyginSleighState { x: 0.0, y: 0.0, theta: 0.0, dot_x: -1.0, dot_y: 0.0, dot_theta: 2.0 };
/// The steps, of which the first is drawn, and that of the motion.
pub const STEPS: [f64; 4] = [0.1, 0.1 / 2.0, 0.1 / 4.0, 0.1 / 8.0];
pub const H: f64 = STEPS[0];
const FINE: f64 = 0.00125;
/// Times at which it has turned around, up to which its rotation is drawn, and of straight motion.
const TURNED: f64 = 8.0;
const DRAWN: f64 = 12.0;
const STRAIGHT: f64 = 24.0;

pub fn midpoint() -> Constrained<Midpoint> {
    Constrained::new(Midpoint)
}

/// Time, state and energy from step to step, for each of [`STEPS`]; and the motion at multiples of [`FINE`],
/// by RK4.
pub struct Sleigh {
    runs: [Vec<(f64, ChaplyginSleighState, f64)>; 4],
    motion: Vec<ChaplyginSleighState>,
}

fn steps(t: f64, h: f64) -> usize {
    (t / h).round() as usize
}

fn begin() -> Problem<'static, ChaplyginSleigh> {
    Problem::new(&SLEIGH, START)
}

impl Sleigh {
    pub fn new() -> Result<Self> {
        let runs = each(STEPS, |h| {
            let mut run = begin().run(midpoint(), h)?;
            let all = |run: &Integrator<_, _>| (run.time(), run.state(), run.energy());
            Ok(course(&mut run, steps(STRAIGHT, h) as u64, all)?)
        })?;
        let (mut fine, mut motion) = (Accelerations::new(&SLEIGH, FINE, &START)?, vec![START]);
        for _ in 0..steps(DRAWN, FINE) {
            fine.step()?;
            motion.push(fine.state());
        }
        Ok(Self { runs, motion })
    }

    /// The order of its place when it has turned.
    pub fn order(&self) -> Option<f64> {
        let ChaplyginSleighState { x, y, .. } = self.motion[steps(TURNED, FINE)];
        order(STEPS.into_iter().zip(&self.runs).map(|(h, run)| {
            let (_, ChaplyginSleighState { x: at, y: up, .. }, _) = run[steps(TURNED, h)];
            (h, distance([at, up], [x, y]))
        }))
    }

    /// How far a run is from its start after its steps up to [`TURNED`], there and back.
    pub fn undone() -> Result<f64> {
        begin().there_and_back(midpoint(), H, steps(TURNED, H) as u64)
    }

    pub fn claim(&self) -> Claim {
        let [whole, ..] = &self.runs;
        let [(_, before, turned), (_, after, _)] = [TURNED, STRAIGHT].map(|t| &whole[steps(t, H)]);
        let late = largest(whole[steps(TURNED, H)..].iter().map(|(.., e)| (e / turned - 1.0).abs()));
        let rate = SLEIGH.a * after.dot_x.hypot(after.dot_y) / (SLEIGH.inertia + SLEIGH.a.powi(2));
        let decay = (before.dot_theta / after.dot_theta).abs().ln() / ((STRAIGHT - TURNED) * rate);
        let turns =
            whole[steps(DRAWN, H)].1.dot_theta.abs() / self.motion[steps(DRAWN, FINE)].dot_theta.abs();
        let changes = self.runs.each_ref().map(|run| (run[run.len() - 1].2 / run[0].2 - 1.0).abs());
        beyond(format!(
            "the sleigh ends straight ahead, h = {H}: its energy changes while it turns, by a term of the \
             order h², and then no more"
        ))
        .near("rate at which ω decays / av/(I + a²)", decay, [1.0, 0.002])
        .near("|ω| at t = 12 / that of the motion", turns, [1.0, 0.02])
        .at_most(format!("|E/E(0) − 1| at t = {STRAIGHT}"), changes[0], 5e-3)
        .near("order of that", order(STEPS.into_iter().zip(changes)), [2.0, 0.05])
        .at_most("largest relative change of E when it has turned", late, 1e-13)
    }

    pub fn panels(&self) -> [Panel; 2] {
        let grey = solid(SLATE).width(1.2);
        let path = self.motion.iter().take((7.0 / FINE) as usize).map(|state| [state.x, state.y]);
        let places = self.runs[0].iter().take((7.0 / H) as usize).map(|(_, state, _)| [state.x, state.y]);
        let slid = Panel::plane("Sleigh", "*x*", "*y*")
            .lines([("motion", grey, path.collect())])
            .dots(places.collect(), 2.0, PURPLE)
            .labelled("steps")
            .legend_at(Corner::BottomRight);
        let turning =
            self.motion.iter().zip(0..).map(|(state, k)| [f64::from(k) * FINE, state.dot_theta.abs()]);
        let rates = self.runs[0][..=steps(DRAWN, H)].iter().map(|(t, state, _)| [*t, state.dot_theta.abs()]);
        let (time, rate) = (Axis::linear("time *t*"), Axis::logarithmic("|*ω*|"));
        let turning = Panel::new("Rate of rotation of the sleigh", time, rate)
            .lines([("motion", grey, turning.collect())])
            .dots(rates.collect(), 2.0, PURPLE)
            .labelled(format!("steps, *h* = {H}"));
        [slid, turning]
    }
}
