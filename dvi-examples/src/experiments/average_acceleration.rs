//! Newmark's method with β = ¼ and γ = ½, the average acceleration method, written by hand for linear
//! friction.

use super::decay::{Case, START};
use crate::vocabulary::*;

/// A point with its velocity and acceleration.
#[derive(Clone, Debug)]
pub struct AverageAcceleration {
    system: RadialFriction,
    h: f64,
    q: [f64; 2],
    v: [f64; 2],
    a: [f64; 2],
}

/// Newton's method needs about four.
const ITERATIONS: usize = 20;

impl AverageAcceleration {
    pub fn new(system: RadialFriction, h: f64, start: RadialFrictionState) -> Self {
        let RadialFrictionState { x, y, dot_x, dot_y } = start;
        let (q, v) = ([x, y], [dot_x, dot_y]);
        let slope = system.slope(&q);
        let a = std::array::from_fn(|i| -slope * q[i] - system.gamma * v[i]);
        Self { system, h, q, v, a }
    }

    /// Solves a1 + γ v1 + ∇V(q1) = 0 for q1 by Newton's method, with the acceleration ½(a0 + a1) over the
    /// whole step.
    pub fn step(&mut self) {
        let Self { system, h, q, v, a } = self;
        let (h, gamma) = (*h, system.gamma);
        let mut next: [f64; 2] = std::array::from_fn(|i| q[i] + h * (v[i] + 0.5 * h * a[i]));
        for _ in 0..ITERATIONS {
            let slope = system.slope(&next);
            let (v1, a1) = rates(h, [*q, *v, *a], next);
            let residual: [f64; 2] = std::array::from_fn(|i| a1[i] + gamma * v1[i] + slope * next[i]);
            // The matrix is m + c q1 q1ᵀ, and its inverse is that of Sherman and Morrison.
            let r2 = dot(next, next);
            let (m, c) = (4.0 / (h * h) + 2.0 * gamma / h + slope, 24.0 * r2 - 16.0);
            let along = c * dot(next, residual) / (m + c * r2);
            let correction: [f64; 2] = std::array::from_fn(|i| (residual[i] - along * next[i]) / m);
            next = std::array::from_fn(|i| next[i] - correction[i]);
            if dot(correction, correction) < 1e-31 {
                break;
            }
        }
        (*v, *a) = rates(h, [*q, *v, *a], next);
        *q = next;
    }

    /// q − ½h v and v − ½h a.
    pub fn half_a_step_back(&self) -> RadialFrictionState {
        let [x, y] = std::array::from_fn(|i| self.q[i] - 0.5 * self.h * self.v[i]);
        let [dot_x, dot_y] = std::array::from_fn(|i| self.v[i] - 0.5 * self.h * self.a[i]);
        RadialFrictionState { x, y, dot_x, dot_y }
    }

    pub fn energy(&self) -> f64 {
        let r2 = dot(self.q, self.q);
        0.5 * dot(self.v, self.v) + r2 * (r2 - 1.0).powi(2)
    }

    pub fn angular_momentum(&self) -> f64 {
        self.q[0] * self.v[1] - self.q[1] * self.v[0]
    }
}

/// With z' = F(z) Newmark's method is z1 − ½hF(z1) = z0 + ½hF(z0). So the points z − ½hF(z) are those of the
/// implicit midpoint rule, which is what the variational midpoint rule is for this Lagrangian and these
/// forces.
pub fn is_midpoint(job: &Job<'_>, case: Case) -> Result<Claim> {
    let mut newmark = AverageAcceleration::new(case.system(), case.h, START);
    let mut run =
        Integrator::new(case.system(), Variational::midpoint(), case.h, newmark.half_a_step_back())?;
    let entries = |RadialFrictionState { x, y, dot_x, dot_y }| [x, y, dot_x, dot_y];
    let mut most = 0.0;
    job.follow(&mut run, case.steps(), |run| {
        newmark.step();
        most = larger(most, apart(&entries(run.state()), &entries(newmark.half_a_step_back())));
    })?;
    let text =
        "Newmark's method with β = ¼ is the variational midpoint rule half a step back, with friction too";
    Ok(beyond(text).at_most("largest difference of a coordinate or a velocity", most, 1e-10))
}

/// Velocity and acceleration at `next`.
fn rates(h: f64, [q, v, a]: [[f64; 2]; 3], next: [f64; 2]) -> ([f64; 2], [f64; 2]) {
    let mean: [f64; 2] = std::array::from_fn(|i| (next[i] - q[i]) / h);
    (
        std::array::from_fn(|i| 2.0 * mean[i] - v[i]),
        std::array::from_fn(|i| 4.0 / h * (mean[i] - v[i]) - a[i]),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_satisfies_the_equations_of_newmark() {
        let system = RadialFriction { gamma: 0.3 };
        let start = RadialFrictionState { x: 1.2, y: 0.1, dot_x: -0.3, dot_y: 0.5 };
        let before = AverageAcceleration::new(system, 0.2, start);
        let mut after = before.clone();
        after.step();
        let slope = after.system.slope(&after.q);
        for i in 0..2 {
            let moved = 0.2 * before.v[i] + 0.01 * (before.a[i] + after.a[i]);
            assert!((after.q[i] - before.q[i] - moved).abs() < 1e-15);
            let faster = 0.1 * (before.a[i] + after.a[i]);
            assert!((after.v[i] - before.v[i] - faster).abs() < 1e-14);
            assert!((after.a[i] + 0.3 * after.v[i] + slope * after.q[i]).abs() < 1e-12);
        }
    }
}
