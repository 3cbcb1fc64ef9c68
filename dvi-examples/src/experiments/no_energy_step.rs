//! Where the symplectic-energy-momentum scheme ends: with the trapezoidal rule on a spring that stiffens it
//! comes to a state from which no step has the discrete energy.

use anyhow::bail;

use super::energy_momentum::{ON_SPRING, START};
use crate::vocabulary::*;

/// Lengths are tried up to so many times that of the step before, which is as far as the control seeks.
const REACH: f64 = 4.0;
/// Those up to this one are drawn.
const SHOWN: f64 = 0.25;

/// The last step of the run, and the one that it cannot take.
pub struct NoStep {
    pub steps: u64,
    /// E_d − e over the length of the step, of both.
    curves: [Vec<[f64; 2]>; 2],
    /// The length of the last step, with its defect by hand.
    last: [f64; 2],
    /// The best length that the control has found, with its defect, and that by hand.
    best: [f64; 3],
}

impl NoStep {
    pub fn new() -> Result<Self> {
        let (rule, control) = (Variational::trapezoid(), EnergyMomentum::new(ON_SPRING[0]));
        let mut run = ControlledIntegrator::new(&StiffeningSpring {}, rule, control, START)?;
        let mut before = None;
        let ended = (0..1000).try_for_each(|_| {
            let sought = (run.state(), run.step_size());
            run.advance()?;
            before = Some(sought);
            Ok::<(), StepError>(())
        });
        let failure = ended.err().context("the run with the trapezoidal rule has not ended")?.failure;
        let StepFailure::EnergyStep { h, defect } = failure else { bail!(failure) };
        let energy = run.control_memory().discrete_energy().context("no step was taken")?;
        let (last, before) = before.context("no step was taken")?;
        let (failed, length) = (run.state(), run.step_size());
        let curves = [(last, before), (failed, length)].map(|(state, before)| {
            let lengths = (1..=4000).map(|k| REACH * before * f64::from(k) / 4000.0);
            lengths.map(|h| [h, energy_of_step(state, h) - energy]).collect()
        });
        Ok(Self {
            steps: run.steps(),
            curves,
            last: [length, energy_of_step(last, length) - energy],
            best: [h, defect, energy_of_step(failed, h) - energy],
        })
    }

    pub fn claim(&self) -> Claim {
        let ([_, failed], [_, found, by_hand]) = (&self.curves, self.best);
        let smallest = least(failed.iter().map(|[_, defect]| *defect));
        let of_lengths = format!("smallest E_d − e of lengths up to {REACH} times the last, by hand");
        let difference = "that of the best length that the control has found, less that by hand";
        beyond(
            "with the trapezoidal rule on the spring the scheme ends, because no length within reach of \
                the last has the discrete energy e",
        )
        .near("steps that it takes", self.steps as f64, [3.0, 0.0])
        .at_most("|E_d − e| of the last of them, by hand", self.last[1].abs(), 5e-14)
        .near(of_lengths, smallest, [2.758e-3, 1e-6])
        .near(difference, found - by_hand, [0.0, 1e-13])
    }

    pub fn panel(&self) -> Panel {
        let ([length, _], [h, defect, _]) = (self.last, self.best);
        let [last, failed] = self.curves.each_ref().map(|curve| {
            curve.iter().filter(|[h, _]| *h <= SHOWN).map(|[h, defect]| [*h, 1e3 * defect]).collect()
        });
        let defects = ("10³ (*E*_d(*h*) − *e*)", [-10.0, 16.0]);
        Panel::linear("The equation for *h*, trapezoidal rule", ("*h*", [0.0, SHOWN]), defects)
            .line(vec![[0.0, 0.0], [SHOWN, 0.0]], Stroke::solid(SLATE).width(1.0))
            .line(last, Stroke::dashed(BLUE))
            .labelled("at the last step")
            .discs(vec![[length, 0.0]], BLUE, Fill::Solid)
            .labelled(format!("its length, {length:.3}"))
            .line(failed, Stroke::solid(VERMILLION))
            .labelled("where the run ends")
            .discs(vec![[h, 1e3 * defect]], VERMILLION, Fill::Hollow)
            .labelled(format!("nearest to zero, {}", scientific(defect)))
            .legend_at(Corner::TopLeft)
    }

    /// The curves of that panel by their run, their quantity, and what it is over.
    pub fn curves(&self) -> impl Iterator<Item = ([String; 3], Vec<[f64; 2]>)> {
        ["trapezoid, last step", "trapezoid, no step"].into_iter().zip(&self.curves).map(|(name, curve)| {
            let names = [name, "discrete_energy_defect", "h"].map(str::to_owned);
            (names, curve.iter().copied().step_by(20).collect())
        })
    }
}

/// E_d of a step of length `h`: q1 = q + h(p − ½h∇V(q)), and E_d = ½|Δ/h|² + ½(V(q) + V(q1)).
fn energy_of_step(StiffeningSpringState { x, y, dot_x, dot_y }: StiffeningSpringState, h: f64) -> f64 {
    let (q, p) = ([x, y], [dot_x, dot_y]);
    let slope = 1.0 + dot(q, q);
    let velocity = [0, 1].map(|i: usize| p[i] - 0.5 * h * slope * q[i]);
    let q1 = [0, 1].map(|i: usize| q[i] + h * velocity[i]);
    let potential = |q: [f64; 2]| 0.5 * dot(q, q) + 0.25 * dot(q, q).powi(2);
    0.5 * dot(velocity, velocity) + 0.5 * (potential(q) + potential(q1))
}
