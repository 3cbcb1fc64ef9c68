//! A step solves the equations that define its scheme, forwards and backwards, at t ≠ 0, however it is
//! solved and added up. Their derivatives are those of the Lagrangian by dual numbers.
//!
//! - p0 + D₁L_d + F⁻ = 0 and p1 = D₂L_d + F⁺ of a discrete Lagrangian, where it is stationary in
//!   interior displacements; up to multiples of the gradients of constraints, which both ends fulfil, and the
//!   middle of the step where they are of velocities.
//! - D₂L_d(q0, q1) + D₁L_d(q1, q2) = 0 if states have no momenta.
//! - M(x1 − x0)/h = p0 + h[(½ − β)F0 + βF1] and p1 = p0 + (h/2)(F0 + F1) of Newmark's method.
//! - Gauss collocation: ∂L/∂v = p + h Σ aᵢⱼ (∂L/∂q + F) at the stages of a regular system, and d/dt
//!   ∂L/∂v = ∂L/∂q + F at those of a degenerate one, solved here with matrices of differences.

use dvi_laws::equations::{Equations, Nodes, Tableau};
use dvi_laws::formula::dual;
use dvi_laws::subject::{Subject, defect, size};
use dvi_laws::{Case, NOT_STIFF, STIFF, stiff};
use dvi_tests::{larger, oracle};
use nalgebra::DVector;

use super::{Outcome, ask, below, of_every_kind};

/// A step between coordinates and velocities.
struct Step<'a> {
    subject: &'a Subject,
    t: f64,
    h: f64,
    ends: [&'a [f64]; 2],
}

impl Step<'_> {
    fn q(&self) -> [&[f64]; 2] {
        self.ends.map(|values| &values[..self.subject.dimension()])
    }

    fn v(&self) -> [&[f64]; 2] {
        self.ends.map(|values| &values[self.subject.dimension()..])
    }

    fn times(&self) -> [f64; 2] {
        [self.t, self.t + self.h]
    }

    /// ∂L/∂v at both ends.
    fn momenta(&self) -> [Vec<f64>; 2] {
        let ([q0, q1], [v0, v1], [t0, t1]) = (self.q(), self.v(), self.times());
        [self.subject.momenta(q0, v0, t0), self.subject.momenta(q1, v1, t1)]
    }

    /// D₁L_d + F⁻ and D₂L_d + F⁺, where L_d is stationary in the displacements.
    fn slots(&self, nodes: &Nodes) -> Outcome<[Vec<f64>; 2]> {
        let (subject, [q0, q1], n) = (self.subject, self.q(), self.subject.dimension());
        let value = |a, b, x: &[f64], direction| {
            let ends = [&dual(q0, a)[..], &dual(q1, b)];
            let lagrangian = |q: &[_], v: &[_], t: num_dual::Dual64| subject.lagrangian(q, v, t.re);
            nodes.discrete_lagrangian(lagrangian, [self.t, self.h], ends, &dual(x, direction)).eps
        };
        let unknowns = n * nodes.displaced.len();
        // A force acts on a displacement at its node, beside the derivative of L_d.
        let work = |x: &[f64]| {
            nodes.discrete_forces(|q, v, t| subject.force(q, v, t), [self.t, self.h], [q0, q1], x)
        };
        let gradient = |x: &DVector<f64>| {
            let [_, _, inside] = work(x.as_slice());
            DVector::from_fn(unknowns, |i, _| value(None, None, x.as_slice(), Some(i)) + inside[i])
        };
        let x = oracle::root(DVector::zeros(unknowns), 1e-4, gradient).ok_or("a regular matrix")?;
        let (x, [left, right, _]) = (x.as_slice(), work(x.as_slice()));
        Ok([
            (0..n).map(|i| value(Some(i), None, x, None) + left[i]).collect(),
            (0..n).map(|i| value(None, Some(i), x, None) + right[i]).collect(),
        ])
    }

    /// What is left of a covector without the part along the gradients of the constraints.
    fn off_constraints(&self, end: usize, mut covector: Vec<f64>) -> Vec<f64> {
        let rows = self.subject.constraint_rows(self.q()[end], self.times()[end]);
        if rows.nrows() > 0 {
            let given = DVector::from_vec(covector.clone());
            let along = (&rows * rows.transpose()).lu().solve(&(&rows * &given));
            let rest = along.map_or(given.clone() * f64::NAN, |along| given - rows.transpose() * along);
            covector.copy_from_slice(rest.as_slice());
        }
        covector
    }

    /// The defect of the equations of a discrete Lagrangian, over the size of their terms.
    fn of_lagrangian(&self, nodes: &Nodes) -> Outcome<f64> {
        let ([p0, p1], [left, right]) = (self.momenta(), self.slots(nodes)?);
        let scale = 1.0 + size(&p0) + size(&p1) + size(self.q()[1]) / self.h.abs();
        let sum = |a: &[f64], sign: f64, b: &[f64]| a.iter().zip(b).map(|(a, b)| a + sign * b).collect();
        let ends =
            [self.off_constraints(0, sum(&p0, 1.0, &left)), self.off_constraints(1, sum(&p1, -1.0, &right))];
        let [g, rate, _] = self.subject.constraint_rates(self.q()[1], self.v()[1], self.times()[1]);
        let (q0, q1) = (self.q()[0], self.q()[1]);
        let [middle, mean]: [Vec<f64>; 2] = [
            q0.iter().zip(q1).map(|(a, b)| (a + b) / 2.0).collect(),
            q0.iter().zip(q1).map(|(a, b)| (b - a) / self.h).collect(),
        ];
        let slips = self.subject.slips(&middle, &mean, self.t + self.h / 2.0);
        let on = larger(larger(size(&g), size(&rate)), size(&slips));
        Ok(larger(larger(size(&ends[0]), size(&ends[1])) / scale, on))
    }

    fn of_newmark(&self, beta: f64) -> f64 {
        let ([q0, q1], [t0, t1], h, rest) =
            (self.q(), self.times(), self.h, vec![0.0; self.subject.dimension()]);
        let [p0, p1] = self.momenta();
        let mean: Vec<f64> = q0.iter().zip(q1).map(|(x0, x1)| (x1 - x0) / h).collect();
        let carried = self.subject.momenta(q0, &mean, t0);
        let [f0, f1] = [self.subject.pull(q0, &rest, t0), self.subject.pull(q1, &rest, t1)];
        let of = |i: usize| {
            let position = carried[i] - p0[i] - h * ((0.5 - beta) * f0[i] + beta * f1[i]);
            let kick = p1[i] - p0[i] - h / 2.0 * (f0[i] + f1[i]);
            larger(position.abs(), kick.abs()) / (1.0 + p0[i].abs() + q1[i].abs() / h.abs())
        };
        (0..q0.len()).map(of).fold(0.0, larger)
    }

    fn of_collocation(&self, stages: usize) -> Outcome<f64> {
        let solved = Stages { step: self, tableau: Tableau::gauss(stages), p: self.start_momenta() }.solve();
        let [q, p] = solved.ok_or("the matrix is regular")?;
        let mut off = defect(self.q()[1], -1.0, &q) / (1.0 + size(&q));
        if self.subject.regular {
            let [_, found] = self.momenta();
            off = larger(off, defect(&found, -1.0, &p) / (1.0 + size(&p)));
        }
        Ok(off)
    }

    fn start_momenta(&self) -> Vec<f64> {
        if self.subject.regular { self.momenta()[0].clone() } else { vec![0.0; self.subject.dimension()] }
    }
}

/// The stages of a step of Gauss collocation, whose unknowns are their velocities.
struct Stages<'a> {
    step: &'a Step<'a>,
    tableau: Tableau,
    p: Vec<f64>,
}

impl Stages<'_> {
    fn moved(&self, weights: &[f64], velocities: &[f64]) -> Vec<f64> {
        let (q, n, h) = (self.step.q()[0], self.p.len(), self.step.h);
        let sum = |i: usize| weights.iter().enumerate().map(|(j, w)| w * velocities[j * n + i]).sum::<f64>();
        (0..n).map(|i| q[i] + h * sum(i)).collect()
    }

    /// The residuals at the velocities of all stages, and the forces.
    fn residuals(&self, velocities: &[f64]) -> [Vec<f64>; 2] {
        let (n, h, subject) = (self.p.len(), self.step.h, self.step.subject);
        let (mut residuals, mut forces) = (Vec::new(), Vec::new());
        for ((a, c), v) in self.tableau.a.iter().zip(&self.tableau.c).zip(velocities.chunks(n)) {
            let (q, t) = (self.moved(a, velocities), self.step.t + c * h);
            let force = subject.pull(&q, v, t);
            if subject.regular {
                residuals
                    .extend(subject.momenta(&q, v, t).iter().zip(&self.p).map(|(momentum, p)| momentum - p));
            } else {
                let rate = subject.momentum_rates(&q, v, t);
                residuals.extend(rate.iter().zip(&force).map(|(rate, force)| rate - force));
            }
            forces.extend(force);
        }
        if subject.regular {
            for (i, a) in self.tableau.a.iter().enumerate() {
                for (j, a) in a.iter().enumerate() {
                    (0..n).for_each(|k| residuals[i * n + k] -= h * a * forces[j * n + k]);
                }
            }
        }
        [residuals, forces]
    }

    /// The point at the end of the step, q and p.
    fn solve(&self) -> Option<[Vec<f64>; 2]> {
        let (n, stages, v) = (self.p.len(), self.tableau.b.len(), self.step.v()[0]);
        let guess = |i: usize| if v.is_empty() { 0.0 } else { v[i % n] };
        let residuals = |velocities: &DVector<f64>| {
            let [residuals, _] = self.residuals(velocities.as_slice());
            DVector::from_vec(residuals)
        };
        let velocities = oracle::root(DVector::from_fn(n * stages, |i, _| guess(i)), 1e-6, residuals)?;
        let [_, forces] = self.residuals(velocities.as_slice());
        let impulse =
            |i: usize| self.tableau.b.iter().enumerate().map(|(j, b)| b * forces[j * n + i]).sum::<f64>();
        let p = (0..n).map(|i| self.p[i] + self.step.h * impulse(i)).collect();
        Some([self.moved(&self.tableau.b, velocities.as_slice()), p])
    }
}

/// D₂L_d(q0, q1) + D₁L_d(q1, q2), over the size of the terms.
fn of_three_points(subject: &Subject, nodes: &Nodes, [t, h]: [f64; 2], q: [&[f64]; 3]) -> f64 {
    let step = |t: f64, ends| Step { subject, t, h, ends }.slots(nodes);
    let (Ok([_, left]), Ok([right, _])) = (step(t, [q[0], q[1]]), step(t + h, [q[1], q[2]])) else {
        return f64::NAN;
    };
    defect(&left, 1.0, &right) / (1.0 + size(&left) + size(q[2]))
}

pub(super) fn steps_solve_their_equations(case: &Case) -> Outcome {
    const STEPS: usize = 3;
    let subject = &*case.subject;
    for h in [subject.h, -subject.h] {
        let mut run = case.begin([subject.t, h], &subject.start.concat())?;
        let mut points = vec![run.values()];
        for _ in 0..STEPS {
            run.advance()?;
            points.push(run.values());
        }
        for (k, window) in points.windows(3).enumerate() {
            let t = subject.t + k as f64 * h;
            let step = Step { subject, t, h, ends: [&window[0], &window[1]] };
            let (found, bound) = match &case.equations {
                Equations::Elsewhere => return Ok(()),
                Equations::Discrete(nodes) if subject.regular => (step.of_lagrangian(nodes)?, 1e-14),
                Equations::Discrete(nodes) => {
                    let [q0, q1, q2] = [0, 1, 2].map(|i| &window[i][..]);
                    (of_three_points(subject, nodes, [t, h], [q0, q1, q2]), 2e-15)
                }
                Equations::Newmark(beta) => (step.of_newmark(*beta), 2e-14),
                Equations::Collocation(stages) => (step.of_collocation(*stages)?, 1e-13),
            };
            below(found, bound, &format!("h = {h}, step {k}"))?;
        }
    }
    Ok(())
}

of_every_kind!(steps_solve_their_equations);

/// To the rounding of forces that are large.
#[test]
fn stiff_steps_too_and_no_fixed_point_takes_them() {
    ask(&stiff(&STIFF), |case| {
        let (subject, Equations::Collocation(stages)) = (&*case.subject, &case.equations) else {
            return Err("Gauss collocation".into());
        };
        let mut run = case.run()?;
        for step in 0..3 {
            let (t, before) = (run.time(), run.values());
            run.advance()?;
            let ends = [&before[..], &run.values()];
            let found = Step { subject, t, h: subject.h, ends }.of_collocation(*stages)?;
            below(found, 1e-9, &format!("step {step}"))?;
        }
        Ok(())
    });
    ask(&stiff(&NOT_STIFF), |case| match case.run()?.take_steps(3) {
        Ok(()) => Err("a fixed point contracts".into()),
        Err(_) => Ok(()),
    });
}
