//! Smooth orbits of the two-step map: how little of the parasitic mode a start along one leaves, what a run gains by it, and
//! what reinitialisation does to the energy and to the preserved two-form.

use dvi_core::prelude::*;
use dvi_tests::configurations::{chaotic, leapfrogging};
use dvi_tests::larger;
use dvi_tests::systems::*;
use num_dual::Dual64;

type Outcome = Result<(), Box<dyn core::error::Error>>;
type Measured = Result<f64, Box<dyn core::error::Error>>;

const RUNGE_KUTTA: fn() -> Start = || Start::RungeKutta(RungeKutta::midpoint());

const PREY: LotkaVolterra = LotkaVolterra { a: [1.0, 1.0], b: [-1.0, -2.0] };

/// A one-form and a Hamiltonian that depend on time.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = (1.0 + 0.3 * t.sin() + 0.2 * x * x) * (x * d(y) - y * d(x)) / 2.0,
    hamiltonian = (x * x + y * y) / 2.0 + 0.1 * x * t.cos(),
)]
struct Driven;

/// What the central difference of order 16 leaves of the first 17 points of a run: of a smooth orbit, (h/2)¹⁶ times a
/// derivative. The library looks at differences of order 4 and 8.
fn first_amplitude<S: DegenerateLagrangian>(
    system: &S,
    method: Sigma,
    h: f64,
    start: &S::State<f64>,
) -> Measured {
    let mut run = Integrator::new(system, Sigma { parasitic_limit: None, ..method }, h, start.clone())?;
    let mut sums = vec![0.0; run.q().len()];
    // (−1)ʲ (16 over j)/2¹⁶
    let mut weight = 1.0 / 65536.0;
    for j in 0..=16_u8 {
        for (sum, q) in sums.iter_mut().zip(run.q()) {
            *sum += weight * q;
        }
        weight *= -(16.0 - f64::from(j)) / (f64::from(j) + 1.0);
        run.advance()?;
    }
    Ok(sums.iter().fold(0.0, |largest: f64, sum| larger(largest, sum.abs())))
}

/// The amplitudes that the three starts leave at h and at h/2 fall with these powers of h.
fn falls<S: DegenerateLagrangian>(
    system: &S,
    start: &S::State<f64>,
    sigma: f64,
    h: f64,
    [others, smooth]: [[f64; 2]; 2],
) -> Outcome {
    let mut finest = [0.0; 3];
    for (i, (second, [least, most])) in
        [(Start::Consistent, others), (RUNGE_KUTTA(), others), (Start::Smooth, smooth)]
            .into_iter()
            .enumerate()
    {
        let method = Sigma { start: second, ..Sigma::new(sigma) };
        let amplitude = |h: f64| first_amplitude(system, method, h, start);
        let (coarse, fine) = (amplitude(h)?, amplitude(h / 2.0)?);
        let slope = (coarse / fine).log2();
        let name = format!("{}, σ = {sigma}, {second:?}: {coarse:e}, {fine:e}", S::REPORT.system);
        assert!(slope > least && slope < most, "{name}: {slope}");
        finest[i] = fine;
    }
    let [consistent, runge_kutta, smooth] = finest;
    assert!(smooth < 1e-5 * consistent.min(runge_kutta), "{}, σ = {sigma}: {finest:?}", S::REPORT.system);
    Ok(())
}

#[test]
fn a_smooth_start_leaves_a_mode_of_ninth_or_tenth_order() -> Outcome {
    let (vortices, start) = chaotic();
    let (third, ninth, tenth) = ([2.8, 3.6], [8.5, 9.6], [9.3, 10.7]);
    falls(&vortices, &start, 0.0, 0.2, [third, ninth])?;
    falls(&vortices, &start, 0.25, 0.2, [third, ninth])?;
    falls(&vortices, &start, 1.0, 0.2, [third, ninth])?;
    falls(&PREY, &LotkaVolterraState { x: 1.3, y: 1.6 }, 0.5, 0.1, [third, tenth])?;
    falls(&Curved { kappa: 0.3 }, &CurvedState { x: 0.8, y: 0.3 }, 0.5, 0.1, [third, tenth])?;
    falls(&Driven, &DrivenState { x: 0.8, y: 0.3 }, 0.5, 0.2, [third, tenth])?;
    // Where the mode is not just reversed from step to step, the starts by a step of the exact flow leave one of second order.
    falls(&Oblique, &ObliqueState { x: 0.8, y: 0.3 }, 0.25, 0.2, [[1.9, 2.7], ninth])?;
    // The parasitic solutions of α = −z dφ are multiplied by −1/3 and −3 in a step.
    falls(&SphereForm { gamma: 1.0 }, &SphereFormState { phi: 0.8, z: 0.3 }, 0.25, 0.05, [[1.5, 2.2], ninth])
}

/// When the limit ends a run.
fn end<S: DegenerateLagrangian>(
    system: &S,
    method: Sigma,
    h: f64,
    start: &S::State<f64>,
) -> Result<f64, Box<dyn core::error::Error>> {
    let mut run = Integrator::new(system, method, h, start.clone())?;
    let Err(StepError { time, failure, .. }) = run.take_steps(1_000_000) else {
        return Err("the run goes on".into());
    };
    assert!(matches!(failure, StepFailure::ParasiticMode { limit: 0.5, .. }), "{failure}");
    Ok(time)
}

/// A mode that grows at a rate takes longer from a smaller beginning, by the logarithm of the ratio over the rate.
#[test]
fn a_smaller_mode_takes_longer_to_grow() -> Outcome {
    let (vortices, start) = chaotic();
    let prey = LotkaVolterraState { x: 2.5, y: 2.0 };
    let neighbours = {
        let mut run = Integrator::new(&vortices, Sigma::midpoint(), 0.05, start)?;
        let mut growth = LyapunovExponent::new(&run);
        for _ in 0..10_000 {
            growth.advance(&mut run)?;
        }
        growth.growth() / growth.elapsed()
    };
    let mut previous = None;
    for h in [0.1, 0.05] {
        let rate = |times: [f64; 2], amplitudes: [f64; 2]| {
            (amplitudes[0] / amplitudes[1]).ln() / (times[1] - times[0])
        };
        let methods = [RUNGE_KUTTA(), Start::Smooth].map(|start| Sigma { start, ..Sigma::leapfrog() });
        let [early, late] = methods.map(|method| end(&vortices, method, h, &start));
        let [large, small] = methods.map(|method| first_amplitude(&vortices, method, h, &start));
        let (times, amplitudes) = ([early?, late?], [large?, small?]);
        assert!(times[0] < 50.0 && times[1] > 250.0, "h = {h}: {times:?}");
        // Like the distance of neighbouring trajectories, which grows at times faster and at times more slowly.
        let rate_of_vortices = rate(times, amplitudes) / neighbours;
        assert!(rate_of_vortices > 0.3 && rate_of_vortices < 1.5, "h = {h}: {rate_of_vortices}");

        let methods = [Start::Consistent, Start::Smooth].map(|start| Sigma { start, ..Sigma::midpoint() });
        let [early, late] = methods.map(|method| end(&PREY, method, h, &prey));
        let [large, small] = methods.map(|method| first_amplitude(&PREY, method, h, &prey));
        let (times, amplitudes) = ([early?, late?], [large?, small?]);
        assert!(times[0] < 8.0 && times[1] > 25.0, "h = {h}: {times:?}");
        let rate = rate(times, amplitudes);
        // The same for both steps.
        let last = *previous.get_or_insert(rate);
        assert!((rate - last).abs() < 0.1 * last, "{rate}, {last}");
    }
    Ok(())
}

/// How a run goes: the largest |H − H(0)| in each half of it, and how often it was reinitialised.
struct Course {
    halves: [f64; 2],
    reinitialisations: u64,
    time: f64,
    error: Option<StepError>,
}

fn course<S: DegenerateLagrangian>(
    system: &S,
    method: Sigma,
    h: f64,
    start: &S::State<f64>,
    end: f64,
) -> Result<Course, Box<dyn core::error::Error>> {
    let mut run = Integrator::new(system, method, h, start.clone())?;
    let (initial, steps) = (run.energy(), (end / h).round() as u64);
    let (mut halves, mut error) = ([0.0; 2], None);
    for step in 0..steps {
        error = run.advance().err();
        if error.is_some() {
            break;
        }
        let half = &mut halves[usize::from(2 * step >= steps)];
        *half = larger(*half, (run.energy() - initial).abs());
    }
    Ok(Course { halves, reinitialisations: run.reinitialisations(), time: run.time(), error })
}

/// A run that is reinitialised goes on to the end, with an energy error that is bounded and does not grow.
fn goes_on<S: DegenerateLagrangian>(
    system: &S,
    method: Sigma,
    h: f64,
    start: &S::State<f64>,
    end: f64,
    bound: f64,
) -> Result<u64, Box<dyn core::error::Error>> {
    let Course { halves: [early, late], reinitialisations, error, .. } =
        course(system, method, h, start, end)?;
    let name = format!("{}, σ = {}, h = {h}, {:?}", S::REPORT.system, method.sigma, method.reinitialisation);
    assert_eq!(error, None, "{name}");
    assert!(early < bound && late < 1.01 * early, "{name}: {early:e}, {late:e}");
    Ok(reinitialisations)
}

#[test]
fn reinitialised_runs_go_on_without_a_drift_of_the_energy() -> Outcome {
    let (vortices, start) = chaotic();
    let every =
        |sigma, steps| Sigma { reinitialisation: Reinitialisation::Every(steps), ..Sigma::new(sigma) };
    for (h, bound) in [(0.1, 7e-5), (0.05, 1.7e-5)] {
        // Without, |ΔH| > 0.1 by t = 250.
        for steps in [10, 100] {
            let count = goes_on(&vortices, every(0.0, steps), h, &start, 1e4, bound)?;
            assert_eq!(count, (1e4 / h).round() as u64 / steps - 1);
        }
    }
    let (pairs, start) = leapfrogging();
    goes_on(&pairs, every(0.25, 100), 0.5, &start, 5000.0, 8e-5)?;
    let prey = LotkaVolterraState { x: 2.5, y: 2.0 };
    for (h, bound) in [(0.1, 6.5e-3), (0.05, 1.5e-3)] {
        for steps in [1, 10, 30] {
            goes_on(&PREY, every(0.5, steps), h, &prey, 1000.0, bound)?;
        }
    }
    // A scheme that is not zero-stable.
    let often = Sigma { start: Start::Smooth, ..every(0.25, 10) };
    goes_on(&PREY, often, 0.05, &prey, 1000.0, 0.045)?;
    let seldom = Sigma { start: Start::Smooth, ..every(0.25, 50) };
    let Course { time, error, .. } = course(&PREY, seldom, 0.05, &prey, 1000.0)?;
    assert!(error.is_some() && time < 20.0, "{time}");
    let prey = LotkaVolterraState { x: 1.3, y: 1.6 };
    for (h, bound) in [(0.1, 4e-3), (0.05, 2.1e-3)] {
        goes_on(&PREY, Sigma { start: Start::Smooth, ..every(0.25, 10) }, h, &prey, 1000.0, bound)?;
    }
    Ok(())
}

/// The same with a run that begins anew, by the start of the method, after each so many steps.
fn restarted<S: DegenerateLagrangian>(
    system: &S,
    method: Sigma,
    h: f64,
    start: &S::State<f64>,
    end: f64,
    every: u64,
) -> Result<[f64; 2], Box<dyn core::error::Error>> {
    let initial = Integrator::new(system, method, h, start.clone())?.energy();
    let (mut state, mut halves) = (start.clone(), [0.0; 2]);
    let runs = (end / h).round() as u64 / every;
    for run in 0..runs {
        let t = h * (run * every) as f64;
        let method = Sigma { parasitic_limit: None, ..method };
        let mut part = Integrator::new_at(system, method, t, h, state)?;
        part.take_steps(every)?;
        let half = &mut halves[usize::from(2 * run >= runs)];
        *half = larger(*half, (part.energy() - initial).abs());
        state = part.state();
    }
    Ok(halves)
}

/// Restarts by a Runge–Kutta step are a one-step method that is not conjugate to a symplectic one.
#[test]
fn restarts_that_leave_a_mode_of_third_order_make_the_energy_drift() -> Outcome {
    let (vortices, start) = chaotic();
    let method = Sigma { start: RUNGE_KUTTA(), ..Sigma::leapfrog() };
    let mut drifts = Vec::new();
    for h in [0.1, 0.05] {
        let [early, late] = restarted(&vortices, method, h, &start, 2000.0, 10)?;
        assert!(late > 1.5 * early, "h = {h}: {early:e}, {late:e}");
        drifts.push(late);
        let smooth = Sigma { reinitialisation: Reinitialisation::Every(10), ..method };
        let Course { halves: [_, late], .. } = course(&vortices, smooth, h, &start, 2000.0)?;
        assert!(10.0 * late < drifts[drifts.len() - 1], "h = {h}: {late:e}, {drifts:?}");
    }
    let slope = (drifts[0] / drifts[1]).log2();
    assert!(slope > 2.5 && slope < 4.0, "{slope}");
    let prey = LotkaVolterraState { x: 2.5, y: 2.0 };
    for start in [Start::Consistent, RUNGE_KUTTA()] {
        let [early, late] = restarted(&PREY, Sigma { start, ..Sigma::midpoint() }, 0.1, &prey, 1000.0, 10)?;
        assert!(early > 0.02 && late > 1.5 * early, "{start:?}: {early:e}, {late:e}");
    }
    Ok(())
}

#[test]
fn reinitialisation_above_a_threshold_keeps_the_energy_where_it_was() -> Outcome {
    let (vortices, start) = chaotic();
    let prey = LotkaVolterraState { x: 2.5, y: 2.0 };
    let above = |threshold, method| Sigma { reinitialisation: Reinitialisation::Above(threshold), ..method };
    // Below 0.01 nothing of the mode is seen in the energy; what a larger one leaves is of the size of the usual error.
    for (threshold, factor) in [(0.01, 1.1), (0.1, 2.0)] {
        for (h, usual) in [(0.1, 6.6e-5), (0.05, 1.65e-5)] {
            let method = above(threshold, Sigma::leapfrog());
            let Course { halves, reinitialisations, error, .. } = course(&vortices, method, h, &start, 1e4)?;
            assert_eq!(error, None, "h = {h}");
            assert!(halves.iter().all(|&largest| largest < factor * usual), "h = {h}: {halves:?}");
            assert!(reinitialisations > 20 && reinitialisations < 50, "h = {h}: {reinitialisations}");
        }
        for (h, usual) in [(0.1, 5.8e-3), (0.05, 1.4e-3)] {
            let method = above(threshold, Sigma::midpoint());
            let Course { halves: [early, late], reinitialisations, error, .. } =
                course(&PREY, method, h, &prey, 1000.0)?;
            assert_eq!(error, None, "h = {h}");
            assert!(early < 1.3 * usual && late < 1.03 * early, "h = {h}: {early:e}, {late:e}");
            // A threshold that the smooth motion reaches is passed again and again.
            assert_eq!(reinitialisations > 500, threshold == 0.01, "h = {h}: {reinitialisations}");
        }
    }
    // Without, the run to which nobody sets a limit is lost.
    let free = Sigma { parasitic_limit: None, ..Sigma::midpoint() };
    let Course { time, error, .. } = course(&PREY, free, 0.1, &prey, 1000.0)?;
    assert!(error.is_some() && time < 6.0, "{time}");
    let free = Sigma { parasitic_limit: None, ..Sigma::leapfrog() };
    let Course { halves, .. } = course(&vortices, free, 0.1, &start, 500.0)?;
    assert!(halves[0] > 0.1, "{halves:?}");
    Ok(())
}

fn dual(x: f64) -> Dual64 {
    Dual64::from_re(x)
}

/// A family of initial points, one coordinate varied, and the columns δ(q, p) of its run.
struct Family<'a, S: System> {
    system: &'a S,
    at: fn(&[Dual64]) -> S::State<Dual64>,
    q: &'a [f64],
    sigma: f64,
    h: f64,
    /// The amplitude of the parasitic part that is put in.
    amplitude: f64,
}

impl<S: DegenerateLagrangian<Dual64>> Family<'_, S> {
    /// By how much Σ δq ∧ δp on the tangent vectors of the initial points, each on its smooth orbit or the same vector beside
    /// it, changes in the last step of a run to time `end`, which may begin with a reinitialisation.
    fn change(&self, reinitialised: bool, end: f64) -> Measured {
        let (steps, dimension) = ((end / self.h).round() as u64, self.q.len());
        let (mut before, mut after) = (Vec::new(), Vec::new());
        for varied in 0..dimension {
            let coordinate = |k: usize| {
                let x = dual(self.q[k]);
                if k == varied { x.derivative() } else { x }
            };
            let first: Vec<Dual64> = (0..dimension).map(coordinate).collect();
            let smooth =
                Sigma { start: Start::Smooth, parasitic_limit: None, ..Sigma::new(dual(self.sigma)) };
            let mut run = Integrator::new(self.system, smooth, dual(self.h), (self.at)(&first))?;
            run.advance()?;
            let beside = |(k, &x): (usize, &Dual64)| x - dual(2.0 * self.amplitude * (1.0 + k as f64).cos());
            let second: Vec<Dual64> = run.q().iter().enumerate().map(beside).collect();
            let reinitialisation =
                if reinitialised { Reinitialisation::Every(steps) } else { Reinitialisation::Never };
            let method = Sigma { reinitialisation, ..smooth };
            let points = [&first, &second].map(|q| (self.at)(q));
            let [first, second] = points;
            let mut run = Integrator::from_two_points(self.system, method, dual(self.h), first, second)?;
            run.take_steps(steps)?;
            before.push(self.column(&run));
            run.advance()?;
            assert_eq!(run.reinitialisations(), u64::from(reinitialised));
            after.push(self.column(&run));
        }
        let changes = form(&before).into_iter().zip(form(&after)).map(|(a, b)| (a - b).abs());
        Ok(changes.fold(0.0, larger))
    }

    fn column(&self, run: &Integrator<'_, S, Sigma<Dual64>, Dual64>) -> [Vec<f64>; 2] {
        let mut alpha = run.q().to_vec();
        self.system.one_form(run.q(), run.time(), &mut alpha);
        let p = alpha.iter().zip(run.memory().defect()).map(|(&alpha, &c)| (alpha + c).eps);
        [run.q().iter().map(|q| q.eps).collect(), p.collect()]
    }
}

/// Σ δq ∧ δp on all pairs of columns.
fn form(columns: &[[Vec<f64>; 2]]) -> Vec<f64> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let pair = |u: &[Vec<f64>; 2], w: &[Vec<f64>; 2]| dot(&u[0], &w[1]) - dot(&w[0], &u[1]);
    columns.iter().flat_map(|u| columns.iter().map(move |w| pair(u, w))).collect()
}

fn vortices(q: &[Dual64]) -> PointVorticesState<4, Dual64> {
    PointVorticesState { x: core::array::from_fn(|j| q[j]), y: core::array::from_fn(|j| q[4 + j]) }
}

fn prey(q: &[Dual64]) -> LotkaVolterraState<Dual64> {
    LotkaVolterraState { x: q[0], y: q[1] }
}

/// Checks the changes of the two-form at h, by powers of h and of the amplitude.
fn changes<S: DegenerateLagrangian<Dual64>>(family: &Family<'_, S>, by_amplitude: f64) -> Outcome {
    let change = |h: f64, amplitude: f64| Family { h, amplitude, ..*family }.change(true, 8.0 * family.h);
    let name = format!("{}, σ = {}", S::REPORT.system, family.sigma);
    let h = family.h;
    for amplitude in [0.0, 1e-4] {
        let kept = Family { amplitude, ..*family }.change(false, 8.0 * h)?;
        assert!(kept < 1e-14, "{name}: {kept:e}");
    }
    // On smooth orbits.
    let [coarse, fine] = [change(h, 0.0)?, change(h / 2.0, 0.0)?];
    let slope = (coarse / fine).log2();
    assert!(slope > 9.3 && slope < 12.5, "{name}: {slope}, {coarse:e}, {fine:e}");
    // Beside them.
    let h = h / 4.0;
    let [large, small] = [change(h, 1e-5)?, change(h, 1e-6)?];
    let power = (large / small).log10();
    assert!((power - by_amplitude).abs() < 0.1, "{name}: {power}, {large:e}, {small:e}");
    Ok(())
}

#[test]
fn reinitialisation_changes_the_two_form_by_what_it_removes() -> Outcome {
    let (system, start) = chaotic();
    let q = [start.x, start.y].concat();
    let of = |sigma| Family { system: &system, at: vortices, q: &q, sigma, h: 0.4, amplitude: 0.0 };
    changes(&of(0.0), 1.0)?;
    changes(&of(0.25), 1.0)?;
    let q = [1.3, 1.6];
    changes(&Family { system: &PREY, at: prey, q: &q, sigma: 0.5, h: 0.2, amplitude: 0.0 }, 1.0)?;
    // The implicit midpoint rule beside its constraint: the mode is a constant shift.
    let q = [start.x, start.y].concat();
    let midpoint = |amplitude| Family { system: &system, at: vortices, q: &q, sigma: 0.5, h: 0.1, amplitude };
    let [large, small] = [midpoint(1e-3).change(true, 1.6)?, midpoint(1e-4).change(true, 1.6)?];
    let power = (large / small).log10();
    assert!((power - 2.0).abs() < 0.1, "{power}");
    // In h, at one amplitude.
    let leapfrog = |h| Family { system: &system, at: vortices, q: &q, sigma: 0.0, h, amplitude: 1e-5 };
    let [coarse, fine] = [leapfrog(0.1).change(true, 1.6)?, leapfrog(0.05).change(true, 1.6)?];
    let slope = (coarse / fine).log2();
    assert!(slope > 1.7 && slope < 2.3, "{slope}: {coarse:e}, {fine:e}");
    Ok(())
}

#[test]
fn a_reinitialisation_costs_as_much_as_some_dozen_steps() -> Outcome {
    let (vortices, start) = chaotic();
    let every = Reinitialisation::Every(10);
    for (h, [least, most]) in [(0.4, [100.0, 200.0]), (0.1, [30.0, 60.0])] {
        let method = Sigma { start: Start::Smooth, reinitialisation: every, ..Sigma::leapfrog() };
        let mut run = Integrator::new(&vortices, method, h, start)?;
        run.take_steps(1000)?;
        let extra = (run.statistics().gradients - run.steps()) as f64 / run.reinitialisations() as f64;
        assert!(extra > least && extra < most, "h = {h}: {extra}");
    }
    let prey = LotkaVolterraState { x: 2.5, y: 2.0 };
    for h in [0.1, 0.05] {
        let gradients = |reinitialisation, steps| -> Measured {
            let method = Sigma { start: Start::Smooth, reinitialisation, ..Sigma::midpoint() };
            let mut run = Integrator::new(&PREY, method, h, prey)?;
            run.take_steps(steps)?;
            Ok(run.statistics().gradients as f64 / run.steps() as f64)
        };
        let step = gradients(Reinitialisation::Never, 200)?;
        let extra = (gradients(every, 1000)? - step) * 10.0 / step;
        // A fixed point that goes to rounding takes more gradients for each of its steps.
        assert!(extra > 30.0 && extra < 300.0, "h = {h}: {extra}");
    }
    Ok(())
}

/// A pendulum with the symmetric one-form.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = (x * d(y) - y * d(x)) / 2.0,
    hamiltonian = y * y / 2.0 - x.cos(),
)]
struct Swing;

/// How much the energy changes in a step, from the means over blocks of 500 steps.
fn drift(h: f64) -> Measured {
    let reinitialisation = Reinitialisation::Every(1);
    let method = Sigma { start: Start::Smooth, reinitialisation, ..Sigma::leapfrog() };
    let mut run = Integrator::new(&Swing, method, h, SwingState { x: 2.0, y: 0.2 })?;
    let mut means = [0.0; 4];
    for mean in &mut means {
        for _ in 0..500 {
            run.take_steps(1)?;
            *mean += run.energy() / 500.0;
        }
    }
    Ok((means[3] - means[0]) / 1500.0)
}

/// What each reinitialisation takes from a smooth orbit adds up: long steps drift, at a high power of h.
#[test]
fn a_run_that_is_reinitialised_with_long_steps_drifts() -> Outcome {
    let [coarse, fine] = [drift(0.4)?, drift(0.3)?];
    assert!((2e-5..4e-5).contains(&coarse), "{coarse:e}");
    assert!(fine > 0.0 && fine < coarse / 10.0, "{coarse:e}, {fine:e}");
    Ok(())
}
