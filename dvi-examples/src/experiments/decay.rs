//! How energy and angular momentum of a particle decay by friction, in the motion and in runs: by
//! variational methods, by RK4, and by the average acceleration method, Newmark's with β = ¼ and γ = ½.

use crate::vocabulary::*;

pub const GAMMA: f64 = 1e-3;
pub const START: RadialFrictionState = RadialFrictionState { x: 1.2, y: 0.0, dot_x: 0.0, dot_y: 0.5 };
/// The steps, the longest first; the reference has the last.
pub const STEPS: [f64; 4] = [0.2, 0.1, 0.05, 0.025];
pub const FINE: f64 = STEPS[3];
/// The length of time over which deviations of the energy are averaged: some twenty turns.
pub const WINDOW: f64 = 50.0;

#[derive(Clone, Copy)]
pub struct Case {
    pub gamma: f64,
    pub h: f64,
    pub end: f64,
}

impl Case {
    pub fn steps(self) -> u64 {
        (self.end / self.h).round() as u64
    }

    pub fn system(self) -> RadialFriction {
        RadialFriction { gamma: self.gamma }
    }

    pub fn run<M: Method<RadialFriction, f64>>(self, method: M) -> Result<Integrator<RadialFriction, M>> {
        Ok(Integrator::new(self.system(), method, self.h, START)?)
    }
}

/// The energy at multiples of [`FINE`], from the first on, and the largest relative deviation of the angular
/// momentum from l(0) e^{−γt}.
pub struct Reference {
    pub energies: Vec<f64>,
    pub momentum: f64,
}

impl Reference {
    pub fn new(job: &Job<'_>, method: impl Method<RadialFriction, f64>, case: Case) -> Result<Self> {
        let mut run = case.run(method)?;
        let (mut energies, [begin], mut momentum) = (Vec::new(), momenta(&run), 0.0);
        job.follow(&mut run, case.steps(), |run| {
            energies.push(run.energy());
            let ([l], decayed) = (momenta(run), begin * (-case.gamma * run.time()).exp());
            momentum = larger(momentum, (l / decayed - 1.0).abs());
        })?;
        Ok(Self { energies, momentum })
    }

    /// The energy at time `t`; not a number if the reference was interrupted before.
    pub fn energy(&self, t: f64) -> f64 {
        let index = ((t / FINE).round() as usize).checked_sub(1);
        index.and_then(|index| self.energies.get(index)).copied().unwrap_or(f64::NAN)
    }
}

/// What one run leaves: E, drawn in tenths of a window; with the energy E' of the reference at the same
/// time, E/E' − 1; and l/(l(0) e^{−γt}) − 1.
pub struct Decay {
    pub name: &'static str,
    pub case: Case,
    pub energy: Envelope,
    pub error: Deviation,
    pub momentum: Deviation,
    /// The time at which the energy is twice that of the start, and why it ended early.
    pub doubled: Option<f64>,
    lost: Option<StepError>,
}

/// Runs with one step: midpoint, trapezoid, Newmark and RK4.
pub type Runs = [Decay; 4];

#[derive(Clone, Copy)]
pub struct Setting<'a> {
    pub job: &'a Job<'a>,
    pub case: Case,
    pub reference: &'a Reference,
}

impl Setting<'_> {
    pub fn runs(self) -> Result<Runs> {
        let (case, mut steps) = (self.case, 0);
        let mut newmark = AverageAcceleration::new(case, START);
        let newmark = self.decay("Newmark, *β* = ¼", newmark.integrals(), || {
            newmark.step();
            steps += 1;
            Ok((f64::from(steps) * case.h, newmark.integrals()))
        });
        let midpoint = self.by("variational midpoint", Variational::midpoint())?;
        let trapezoid = self.by("variational trapezoid", Variational::trapezoid())?;
        let runs = [midpoint, trapezoid, newmark, self.by("RK4", RungeKutta::classical())?];
        match runs.iter().find_map(|run| run.lost) {
            Some(error) => bail!(error),
            None => Ok(runs),
        }
    }

    pub fn by(self, name: &'static str, method: impl Method<RadialFriction, f64>) -> Result<Decay> {
        let mut run = self.case.run(method)?;
        let integrals = |run: &Integrator<_, _>| {
            let [l] = momenta(run);
            [run.energy(), l]
        };
        Ok(self.decay(name, integrals(&run), || {
            run.advance()?;
            Ok((run.time(), integrals(&run)))
        }))
    }

    /// From E and l at the start, with the time and those after each step.
    fn decay<F>(self, name: &'static str, begin: [f64; 2], mut step: F) -> Decay
    where
        F: FnMut() -> Result<(f64, [f64; 2]), StepError>,
    {
        let Self { job, case, reference } = self;
        let (windows, end) = ((case.end / WINDOW).round() as usize, case.end);
        let [mut error, mut momentum] = Span { end, early: WINDOW, intervals: windows }.deviations();
        let (mut energy, mut doubled) = (Envelope::new(end, 10 * windows), None);
        let ended = job.repeat(case.steps(), || {
            let (t, [e, l]) = step()?;
            energy.push(t, e);
            error.push(t, e / reference.energy(t) - 1.0);
            momentum.push(t, l / (begin[1] * (-case.gamma * t).exp()) - 1.0);
            if e > 2.0 * begin[0] {
                doubled.get_or_insert(t);
            }
            Ok(())
        });
        Decay { name, case, energy, error, momentum, doubled, lost: ended.err() }
    }
}

impl Decay {
    /// The relative deviation of the energy in the first and in the last window, on average over each.
    pub fn means(&self) -> [f64; 2] {
        let means = self.error.envelope.mean();
        [means.first(), means.last()].map(|point| point.map_or(f64::NAN, |[_, mean]| *mean))
    }

    /// The largest magnitude of the deviation of the energy, on average over a window.
    pub fn largest_mean(&self) -> f64 {
        largest(self.error.envelope.mean().iter().map(|[_, mean]| mean.abs()))
    }

    /// By how much faster the energy decays than it should, from first to last window, in units of γ.
    pub fn excess(&self) -> f64 {
        let [first, last] = self.means();
        ((1.0 + first) / (1.0 + last)).ln() / (GAMMA * (self.case.end - WINDOW))
    }
}

/// Newmark's method with β = ¼ and γ = ½, written by hand for linear friction: a point with its velocity and
/// acceleration.
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
        let slope = system.slope(&q);
        Self { a: [0, 1].map(|i| -slope * q[i] - system.gamma * v[i]), system, h, q, v }
    }

    /// Solves a1 + γ v1 + ∇V(q1) = 0 for q1 by Newton's method, with the acceleration ½(a0 + a1) over the
    /// whole step.
    pub fn step(&mut self) {
        let Self { system, h, q, v, a } = self;
        let (h, gamma) = (*h, system.gamma);
        let mut next = [0, 1].map(|i: usize| q[i] + h * (v[i] + 0.5 * h * a[i]));
        // It needs about four.
        for _ in 0..20 {
            let slope = system.slope(&next);
            let (v1, a1) = rates(h, [*q, *v, *a], next);
            let residual = [0, 1].map(|i: usize| a1[i] + gamma * v1[i] + slope * next[i]);
            // The matrix is m + c q1 q1ᵀ, and its inverse is that of Sherman and Morrison.
            let r2 = dot(next, next);
            let (m, c) = (4.0 / (h * h) + 2.0 * gamma / h + slope, 24.0 * r2 - 16.0);
            let along = c * dot(next, residual) / (m + c * r2);
            let correction = [0, 1].map(|i: usize| (residual[i] - along * next[i]) / m);
            next = difference(next, correction);
            if dot(correction, correction) < 1e-31 {
                break;
            }
        }
        (*v, *a) = rates(h, [*q, *v, *a], next);
        *q = next;
    }

    /// q − ½h v and v − ½h a.
    pub fn half_a_step_back(&self) -> RadialFrictionState {
        let Self { h, q, v, a, .. } = *self;
        let back = |x: [f64; 2], rate: [f64; 2]| [0, 1].map(|i: usize| x[i] - 0.5 * h * rate[i]);
        let ([x, y], [dot_x, dot_y]) = (back(q, v), back(v, a));
        RadialFrictionState { x, y, dot_x, dot_y }
    }

    /// The energy and the angular momentum.
    fn integrals(&self) -> [f64; 2] {
        let ([x, y], [u, w], r2) = (self.q, self.v, dot(self.q, self.q));
        [0.5 * dot(self.v, self.v) + r2 * (r2 - 1.0).powi(2), x * w - y * u]
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

fn rates(h: f64, [q, v, a]: [[f64; 2]; 3], next: [f64; 2]) -> ([f64; 2], [f64; 2]) {
    let mean = [0, 1].map(|i: usize| (next[i] - q[i]) / h);
    let of = |rate: fn(f64, f64, f64, f64) -> f64| [0, 1].map(|i: usize| rate(h, mean[i], v[i], a[i]));
    (of(|_, mean, v, _| 2.0 * mean - v), of(|h, mean, v, a| 4.0 / h * (mean - v) - a))
}

/// The forced discrete Noether theorem: what a step takes of an angular momentum.
///
/// D₁L_d and D₂L_d are parallel to the points but for Δ/h and the forces ∓½γΔ, and so l0 = (1/h + c + ½γ)
/// q0×q1 and l1 = (1/h + c − ½γ) q0×q1. The rule of the trapezoid has c = 0, that of the midpoint ¼h V'(r)/r
/// at the middle of the step.
pub fn noether(job: &Job<'_>, case: Case, steps: &[Runs; 4]) -> Result<Claim> {
    let slope =
        |q0: [f64; 2], q1: [f64; 2]| case.system().slope(&[0, 1].map(|i: usize| 0.5 * (q0[i] + q1[i])));
    let trapezoid = defects(job, Variational::trapezoid(), case, |_, _| 0.0)?;
    let midpoint = defects(job, Variational::midpoint(), case, |q0, q1| 0.25 * case.h * slope(q0, q1))?;
    let order = |method: usize| {
        order(steps[1..].iter().map(|runs| (runs[method].case.h, runs[method].momentum.last.abs())))
    };
    let [by_midpoint, by_trapezoid, ..] = steps[0].each_ref().map(|run| run.momentum.largest);
    let text =
        "each step, h = 0.2, takes of the angular momentum what the forced discrete Noether theorem says";
    Ok(beyond(text)
        .at_most("trapezoid: relative defect of l1 = l0 (1 − γh/2)/(1 + γh/2)", trapezoid[0], 1e-12)
        .at_most("trapezoid: the same of the product over all steps", trapezoid[1], 5e-12)
        .at_most("midpoint: relative defect with 1/h + h V'(r)/(4r) in place of 1/h", midpoint[0], 1e-12)
        .at_most("midpoint: the same of the product over all steps", midpoint[1], 5e-12)
        .at_most("trapezoid: largest |l/(l(0) exp(−γt)) − 1|", by_trapezoid, 1.1e-8)
        .at_most("midpoint: largest |l/(l(0) exp(−γt)) − 1|", by_midpoint, 1e-3)
        .near("trapezoid: order of that at the end in h", order(1), [2.0, 0.05])
        .near("midpoint: order of that at the end in h", order(0), [2.0, 0.05]))
}

/// The largest relative deviations of l from that before times the factor of the step, which follows from c,
/// and from l(0) times the product of the factors of all steps.
fn defects(
    job: &Job<'_>,
    method: impl Method<RadialFriction, f64>,
    case: Case,
    c: impl Fn([f64; 2], [f64; 2]) -> f64,
) -> Result<[f64; 2]> {
    let mut run = case.run(method)?;
    let (mut before, [mut l]) = (place(&run), momenta(&run));
    let (mut product, mut of_a_step, mut of_all) = (l, 0.0, 0.0);
    job.follow(&mut run, case.steps(), |run| {
        let (after, expected) = (place(run), l);
        let inner = 1.0 / case.h + c(before, after);
        let factor = (inner - 0.5 * case.gamma) / (inner + 0.5 * case.gamma);
        (before, [l]) = (after, momenta(run));
        product *= factor;
        of_a_step = larger(of_a_step, (l / (expected * factor) - 1.0).abs());
        of_all = larger(of_all, (l / product - 1.0).abs());
    })?;
    Ok([of_a_step, of_all])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_satisfies_the_equations_of_newmark() {
        let start = RadialFrictionState { x: 1.2, y: 0.1, dot_x: -0.3, dot_y: 0.5 };
        let before = AverageAcceleration::new(Case { gamma: 0.3, h: 0.2, end: 0.0 }, start);
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
