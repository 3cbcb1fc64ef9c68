//! Newmark's method with β = ¼ and γ = ½, written by hand for linear friction, and which method it is.

use super::decay::{Case, START};
use crate::vocabulary::*;

/// A point with its velocity and acceleration.
#[derive(Clone)]
pub struct AverageAcceleration {
    system: RadialFriction,
    h: f64,
    q: [f64; 2],
    v: [f64; 2],
    a: [f64; 2],
}

impl AverageAcceleration {
    pub fn new(case: Case, RadialFrictionState { x, y, dot_x, dot_y }: RadialFrictionState) -> Self {
        let (system, h, q, v) = (case.system(), case.h, [x, y], [dot_x, dot_y]);
        Self { a: acceleration(&system, q, v), system, h, q, v }
    }

    /// Solves a1 + γ v1 + ∇V(q1) = 0 by iteration, with the acceleration ½(a0 + a1) over the whole step.
    pub fn step(&mut self) {
        let Self { system, h, q, v, a } = self.clone();
        // It needs about twenty.
        for _ in 0..100 {
            let mean = [0, 1].map(|i: usize| 0.5 * (a[i] + self.a[i]));
            self.v = moved(v, h, mean);
            self.q = moved(moved(q, h, v), 0.5 * h * h, mean);
            let next = acceleration(&system, self.q, self.v);
            let change = length(difference(next, self.a));
            self.a = next;
            if change < 1e-15 {
                break;
            }
        }
    }

    /// q − ½h v and v − ½h a.
    pub fn half_a_step_back(&self) -> RadialFrictionState {
        let Self { h, q, v, a, .. } = *self;
        let ([x, y], [dot_x, dot_y]) = (moved(q, -0.5 * h, v), moved(v, -0.5 * h, a));
        RadialFrictionState { x, y, dot_x, dot_y }
    }

    pub fn integrals(&self) -> [f64; 2] {
        let Self { system, q, v, .. } = self;
        [system.energy(q, v, 0.0), system.momentum(0, q, v, 0.0)]
    }
}

/// With z' = F(z) Newmark's method is z1 − ½hF(z1) = z0 + ½hF(z0). So the points z − ½hF(z) are those of the
/// implicit midpoint rule, which is what the variational midpoint rule is for this Lagrangian and these
/// forces.
pub fn is_midpoint(job: &Job<'_>, case: Case) -> Result<Claim> {
    let (mut newmark, midpoint) = (AverageAcceleration::new(case, START), Variational::midpoint());
    let mut run = Integrator::new(case.system(), midpoint, case.h, newmark.half_a_step_back())?;
    let entries = |RadialFrictionState { x, y, dot_x, dot_y }| [x, y, dot_x, dot_y];
    let mut most = 0.0;
    job.follow(&mut run, case.steps(), |run| {
        newmark.step();
        most = larger(most, apart(&entries(run.state()), &entries(newmark.half_a_step_back())));
    })?;
    let text = "Newmark's method with β = ¼ is the variational midpoint rule half a step back, with \
                friction too";
    Ok(beyond(text).at_most("largest difference of a coordinate or a velocity", most, 1e-10))
}

fn acceleration(system: &RadialFriction, q: [f64; 2], v: [f64; 2]) -> [f64; 2] {
    [0, 1].map(|i: usize| -system.slope(&q) * q[i] - system.gamma * v[i])
}
