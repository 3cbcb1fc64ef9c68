//! Interior displacements: orders, the equations that a step solves, and what it preserves.

use core::f64::consts::{PI, TAU};
use dvi_core::prelude::*;
use dvi_core::{FrequencyIn, Method, PreservedForm, Space, State, Statistics, Unfitted};
use dvi_tests::oracle::displaced_lagrangian;
use dvi_tests::zoo::regular::*;
use num_dual::Dual64;

type Outcome = Result<(), Box<dyn core::error::Error>>;

const KEPLER: Kepler = Kepler { mu: 1.0 };

/// At the pericentre of an orbit with period 2π.
fn pericentre(e: f64) -> KeplerState {
    KeplerState { x: 1.0 - e, y: 0.0, dot_x: 0.0, dot_y: ((1.0 + e) / (1.0 - e)).sqrt() }
}

fn double_pendulum() -> (DoublePendulum, DoublePendulumState) {
    let system = DoublePendulum { mass: [1.0, 0.7], length: [1.0, 0.8], g: 9.81 };
    (system, DoublePendulumState { a: 1.1, b: -0.4, dot_a: 0.3, dot_b: 0.9 })
}

fn spherical() -> (SphericalPendulum, SphericalPendulumState) {
    (
        SphericalPendulum { g: 1.0 },
        SphericalPendulumState { theta: 1.2, phi: 0.3, dot_theta: 0.4, dot_phi: 0.8 },
    )
}

fn magnetic() -> (MagneticParticle, MagneticParticleState) {
    let start = MagneticParticleState { x: 0.3, y: -0.2, z: 0.5, dot_x: 0.4, dot_y: 0.7, dot_z: -0.3 };
    (MagneticParticle { m: 1.0, b: 2.0 }, start)
}

fn relativistic() -> (Relativistic, RelativisticState) {
    (Relativistic { m: 1.0 }, RelativisticState { x: 0.8, y: 0.1, dot_x: -0.2, dot_y: 0.6 })
}

fn growing() -> (GrowingMass, GrowingMassState) {
    (GrowingMass {}, GrowingMassState { x: 0.8, y: -0.6, dot_x: 0.3, dot_y: 0.4 })
}

fn driven() -> (DrivenOscillator, DrivenOscillatorState) {
    (DrivenOscillator { depth: 0.3, omega: 1.7 }, DrivenOscillatorState { x: 0.8, dot_x: 0.3 })
}

fn chain() -> (RunTimeChain, RunTimeChainState) {
    let system = RunTimeChain { mass: vec![1.0, 1.5, 0.7], coupling: 0.2 };
    let start =
        RunTimeChainState { q: vec![0.1, -0.2, 0.4], wall: 0.3, dot_q: vec![0.5, 0.0, -0.1], dot_wall: 0.2 };
    (system, start)
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// The coordinates at `time`.
fn run<S: Lagrangian, M: Method<S, f64>>(
    system: &S,
    method: M,
    start: S::State<f64>,
    time: f64,
    steps: u64,
) -> Result<Vec<f64>, Box<dyn core::error::Error>> {
    let mut run = Integrator::new(system, method, time / steps as f64, start)?;
    run.advance_by(steps)?;
    Ok(run.q().to_vec())
}

fn observed<S: Lagrangian, M: Method<S, f64> + Copy>(
    (system, start): (&S, &S::State<f64>),
    method: M,
    time: f64,
    steps: [u64; 4],
    reference: &[f64],
) -> Result<f64, Box<dyn core::error::Error>> {
    let mut errors = Vec::new();
    for steps in steps {
        errors
            .push((time / steps as f64, apart(&run(system, method, start.clone(), time, steps)?, reference)));
    }
    convergence_order(&errors).ok_or_else(|| "no slope".into())
}

#[test]
fn orders_are_four_six_and_eight_on_kepler() -> Outcome {
    let (start, reference, time) = (pericentre(0.3), [0.7, 0.0], 4.0 * TAU);
    let at = (&KEPLER, &start);
    let three = observed(at, Galerkin::<3>::new(), time, [800, 1000, 1200, 1600], &reference)?;
    let four = observed(at, Galerkin::<4>::new(), time, [320, 400, 480, 640], &reference)?;
    let five = observed(at, Galerkin::<5>::new(), time, [160, 180, 200, 240], &reference)?;
    for (found, order) in [(three, 4.0), (four, 6.0), (five, 8.0)] {
        assert!((found - order).abs() < 0.2, "{found}, not {order}");
    }
    let orders = [Galerkin::<3>::new().order(), Galerkin::<4>::new().order(), Galerkin::<5>::new().order()];
    assert_eq!(orders, [4, 6, 8]);
    Ok(())
}

#[test]
fn fitted_interpolation_keeps_the_orders() -> Outcome {
    let (start, reference, time) = (pericentre(0.3), [0.7, 0.0], 4.0 * TAU);
    let at = (&KEPLER, &start);
    for omega in [0.7, 1.3] {
        let frequency = Constant(omega);
        let three = observed(
            at,
            Galerkin::<3>::new().phase_fitted(frequency),
            time,
            [800, 1000, 1200, 1600],
            &reference,
        )?;
        let four = observed(
            at,
            Galerkin::<4>::new().phase_fitted(frequency),
            time,
            [320, 400, 480, 640],
            &reference,
        )?;
        let five = observed(
            at,
            Galerkin::<5>::new().phase_fitted(frequency),
            time,
            [160, 180, 200, 240],
            &reference,
        )?;
        for (found, order) in [(three, 4.0), (four, 6.0), (five, 8.0)] {
            assert!((found - order).abs() < 0.2, "omega = {omega}: {found}, not {order}");
        }
    }
    let averaged = Galerkin::<3>::new().phase_fitted(Radial(Reading::Averaged));
    let found = observed(at, averaged, time, [200, 240, 280, 320], &reference)?;
    assert!((found - 4.0).abs() < 0.2, "averaged: {found}");
    Ok(())
}

fn check_order<const S: usize>(steps: [u64; 4], reference: &[f64]) -> Outcome {
    let (system, start) = double_pendulum();
    let found = observed((&system, &start), Galerkin::<S>::new(), 1.0, steps, reference)?;
    assert!((found - (2 * S - 2) as f64).abs() < 0.2, "{S} nodes: {found}");
    Ok(())
}

#[test]
fn orders_are_four_six_and_eight_on_the_double_pendulum() -> Outcome {
    let (system, start) = double_pendulum();
    let reference = run(&system, Galerkin::<5>::new(), start, 1.0, 400)?;
    // Another method, extrapolated, agrees with it.
    let midpoint = |steps| run(&system, Variational::midpoint(), start, 1.0, steps);
    let (coarse, fine) = (midpoint(4000)?, midpoint(8000)?);
    let extrapolated: Vec<f64> = coarse.iter().zip(&fine).map(|(c, f)| f + (f - c) / 3.0).collect();
    assert!(apart(&reference, &extrapolated) < 1e-10, "{reference:?} {extrapolated:?}");
    check_order::<3>([32, 48, 64, 96], &reference)?;
    check_order::<4>([16, 24, 32, 48], &reference)?;
    check_order::<5>([48, 56, 64, 80], &reference)
}

fn dual(x: &[f64], direction: Option<usize>) -> Vec<Dual64> {
    let unit = |i| if Some(i) == direction { 1.0 } else { 0.0 };
    x.iter().enumerate().map(|(i, &x)| Dual64::new(x, unit(i))).collect()
}

/// The displacements of the interior nodes that make L_d(q0, q1) stationary, by Newton with differences of
/// derivatives that dual numbers give.
fn stationary<S: Lagrangian, const NODES: usize>(
    system: &S,
    u: f64,
    [t, h]: [f64; 2],
    ends: [&[f64]; 2],
) -> Vec<f64> {
    let [q0, q1] = ends.map(|q| dual(q, None));
    let size = q0.len() * (NODES - 2);
    let gradient = |x: &[f64]| -> nalgebra::DVector<f64> {
        nalgebra::DVector::from_fn(size, |i, _| {
            displaced_lagrangian::<S, Dual64, NODES>(system, u, [t, h], [&q0, &q1], &dual(x, Some(i))).eps
        })
    };
    let mut x = vec![0.0; size];
    for _ in 0..20 {
        let jacobian = nalgebra::DMatrix::from_fn(size, size, |i, j| {
            let shifted = |by: f64| {
                let mut x = x.clone();
                x[j] += by;
                gradient(&x)[i]
            };
            (shifted(1e-4) - shifted(-1e-4)) / 2e-4
        });
        let Some(change) = jacobian.lu().solve(&gradient(&x)) else { return x };
        x.iter_mut().zip(change.iter()).for_each(|(x, change)| *x -= change);
    }
    x
}

/// The largest residual of p0 = −D₁L_d and p1 = D₂L_d, from the value of L alone.
fn check_equations<S: RegularLagrangian, const NODES: usize>(
    (system, start): (S, S::State<f64>),
    omega: f64,
) -> Outcome {
    let h = 0.1;
    for solver in [Solver::Automatic, Solver::Newton] {
        let method = Galerkin { solver, ..Galerkin::<NODES>::new() }.phase_fitted(Constant(omega));
        let mut run = Integrator::new(&system, method, h, start.clone())?;
        for step in 0..4 {
            let (q0, p0, t) = (run.q().to_vec(), run.memory().p().to_vec(), run.time());
            run.advance()?;
            let (q1, p1) = (run.q().to_vec(), run.memory().p().to_vec());
            let x = stationary::<S, NODES>(&system, omega * h, [t, h], [&q0, &q1]);
            let value = |a: Option<usize>, b: Option<usize>| {
                let ends = [&dual(&q0, a)[..], &dual(&q1, b)];
                displaced_lagrangian::<S, Dual64, NODES>(&system, omega * h, [t, h], ends, &dual(&x, None))
                    .eps
            };
            for i in 0..q0.len() {
                let residual = (p0[i] + value(Some(i), None)).abs().max((p1[i] - value(None, Some(i))).abs());
                let size = p0.iter().chain(&p1).fold(1.0, |m: f64, p| m.max(p.abs()));
                let name = S::REPORT.system;
                assert!(
                    residual < 4e-14 * size / h,
                    "{name}, {NODES} nodes, {solver:?}, step {step}: {residual:e}"
                );
            }
        }
    }
    Ok(())
}

fn check_all_nodes<S: RegularLagrangian + Clone>((system, start): (S, S::State<f64>)) -> Outcome {
    for omega in [0.0, 1.3] {
        check_equations::<S, 3>((system.clone(), start.clone()), omega)?;
        check_equations::<S, 4>((system.clone(), start.clone()), omega)?;
        check_equations::<S, 5>((system.clone(), start.clone()), omega)?;
    }
    Ok(())
}

#[test]
fn steps_of_separable_systems_solve_their_equations() -> Outcome {
    check_all_nodes((KEPLER, pericentre(0.3)))?;
    check_all_nodes(driven())?;
    check_all_nodes(chain())
}

#[test]
fn steps_of_other_systems_solve_their_equations() -> Outcome {
    check_all_nodes(double_pendulum())?;
    check_all_nodes(spherical())?;
    check_all_nodes(magnetic())?;
    check_all_nodes(relativistic())?;
    check_all_nodes(growing())
}

#[test]
fn all_solvers_find_the_same_steps() -> Outcome {
    fn check<F: FrequencyIn<f64> + Copy>(frequency: F) -> Outcome {
        let by = |solver| {
            let method = Galerkin { solver, ..Galerkin::<4>::new() }.phase_fitted(frequency);
            run(&KEPLER, method, pericentre(0.3), 6.0, 60)
        };
        let automatic = by(Solver::Automatic)?;
        assert!(apart(&automatic, &by(Solver::FixedPoint)?) < 1e-12, "{frequency:?}");
        assert!(apart(&automatic, &by(Solver::Newton)?) < 1e-12, "{frequency:?}");
        Ok(())
    }
    check(Unfitted)?;
    check(Constant(1.1))?;
    check(Radial(Reading::Averaged))?;
    check(Curvature(Reading::Averaged))
}

/// Entry by entry, (q, p) and its derivative in the direction of entry `direction` of (q, v), at the start and
/// after some steps.
fn tangents<S: RegularLagrangian, M: Method<S, Dual64> + Copy>(
    system: &S,
    start: &S::State<f64>,
    method: M,
    momentum: impl Fn(&M::Memory) -> &[Dual64],
) -> Result<[Vec<Vec<f64>>; 2], Box<dyn core::error::Error>> {
    let n = Space::dimension(system.space());
    let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
    let len = |block| system.block_len(block);
    start.write(len, &mut q, &mut v)?;
    let start = [q, v].concat();
    let [mut first, mut last] = [Vec::new(), Vec::new()];
    for direction in 0..2 * n {
        let varied = dual(&start, Some(direction));
        let state = S::State::<Dual64>::read(len, &varied[..n], &varied[n..]);
        let mut run = Integrator::new(system, method, Dual64::from_re(0.1), state)?;
        let column = |run: &Integrator<'_, S, M, Dual64>| {
            run.q().iter().chain(momentum(run.memory())).map(|x| x.eps).collect::<Vec<_>>()
        };
        first.push(column(&run));
        run.advance_by(3)?;
        last.push(column(&run));
    }
    Ok([first, last])
}

/// The largest change of dq ∧ dp, evaluated on the variations of the start.
fn defect<S: RegularLagrangian, F: FrequencyIn<Dual64> + Copy, const NODES: usize>(
    system: &S,
    start: &S::State<f64>,
    method: Galerkin<NODES, F>,
) -> Result<f64, Box<dyn core::error::Error>> {
    let [first, last] = tangents(system, start, method, |memory| memory.p())?;
    let two_form = |a: &[f64], b: &[f64]| {
        let n = a.len() / 2;
        (0..n).map(|i| a[i] * b[n + i] - a[n + i] * b[i]).sum::<f64>()
    };
    let mut largest: f64 = 0.0;
    for i in 0..first.len() {
        for j in 0..i {
            largest = largest.max((two_form(&last[i], &last[j]) - two_form(&first[i], &first[j])).abs());
        }
    }
    Ok(largest)
}

fn check_symplectic<S: RegularLagrangian>((system, start): (S, S::State<f64>)) -> Outcome {
    for solver in [Solver::Automatic, Solver::Newton] {
        let defects = [
            defect(&system, &start, Galerkin { solver, ..Galerkin::<3>::new() })?,
            defect(&system, &start, Galerkin { solver, ..Galerkin::<4>::new() })?,
            defect(&system, &start, Galerkin { solver, ..Galerkin::<5>::new() })?,
            defect(&system, &start, Galerkin::<4>::new().phase_fitted(Constant(1.3)))?,
        ];
        assert!(
            defects.iter().all(|&defect| defect < 1e-11),
            "{}, {solver:?}: {defects:?}",
            S::REPORT.system
        );
    }
    Ok(())
}

#[test]
fn the_canonical_two_form_is_preserved() -> Outcome {
    assert_eq!(Galerkin::<3>::new().preserved_form(), PreservedForm::Canonical);
    check_symplectic((KEPLER, pericentre(0.3)))?;
    check_symplectic(driven())?;
    check_symplectic(chain())?;
    check_symplectic(double_pendulum())?;
    check_symplectic(spherical())?;
    check_symplectic(magnetic())
}

#[test]
fn a_frequency_held_constant_does_not_preserve_it() -> Outcome {
    let method = Galerkin::<3>::new().phase_fitted(Radial(Reading::Averaged));
    assert_eq!(method.preserved_form(), PreservedForm::Nothing);
    let found = defect(&KEPLER, &pericentre(0.3), method)?;
    assert!(found > 1e-9, "{found:e}");
    Ok(())
}

fn check_reversal<S: RegularLagrangian, F, const NODES: usize>(
    (system, start): (S, S::State<f64>),
    method: Galerkin<NODES, F>,
) -> Outcome
where
    F: FrequencyIn<f64> + Copy,
{
    let mut forth = Integrator::new(&system, method, 0.1, start)?;
    for _ in 0..5 {
        let first = forth.q().to_vec();
        let momentum = forth.memory().p().to_vec();
        forth.advance()?;
        let mut back = Integrator::new_at(&system, method, forth.time(), -0.1, forth.state())?;
        back.advance()?;
        let error = apart(back.q(), &first).max(apart(back.memory().p(), &momentum));
        assert!(error < 1e-12, "{}, {method:?}: {error:e}", S::REPORT.system);
    }
    Ok(())
}

#[test]
fn a_step_back_undoes_a_step() -> Outcome {
    check_reversal((KEPLER, pericentre(0.3)), Galerkin::<3>::new())?;
    check_reversal((KEPLER, pericentre(0.3)), Galerkin::<5>::new().phase_fitted(Radial(Reading::Averaged)))?;
    check_reversal(
        (KEPLER, pericentre(0.3)),
        Galerkin::<4>::new().phase_fitted(Curvature(Reading::Averaged)),
    )?;
    check_reversal(driven(), Galerkin::<4>::new().phase_fitted(Constant(1.3)))?;
    check_reversal(double_pendulum(), Galerkin::<3>::new())?;
    check_reversal(spherical(), Galerkin::<4>::new())?;
    check_reversal(growing(), Galerkin::<5>::new())
}

#[test]
fn momentum_maps_are_preserved() -> Outcome {
    fn check<S: RegularLagrangian, F: FrequencyIn<f64>, const NODES: usize>(
        (system, start): (S, S::State<f64>),
        method: Galerkin<NODES, F>,
    ) -> Outcome {
        let mut run = Integrator::new(&system, method, 0.05, start)?;
        let first = run.momentum(0).ok_or("no momentum")?;
        for _ in 0..500 {
            run.advance()?;
            let drift = (run.momentum(0).ok_or("no momentum")? - first).abs();
            assert!(drift < 1e-12, "{}: {drift:e}", S::REPORT.system);
        }
        Ok(())
    }
    check((KEPLER, pericentre(0.3)), Galerkin::<3>::new())?;
    check((KEPLER, pericentre(0.3)), Galerkin::<4>::new().phase_fitted(Constant(1.1)))?;
    check((KEPLER, pericentre(0.3)), Galerkin::<5>::new().phase_fitted(Radial(Reading::Averaged)))?;
    check(spherical(), Galerkin::<3>::new())?;
    check(spherical(), Galerkin::<4>::new())
}

#[test]
fn on_the_fitted_oscillator_three_nodes_have_their_closed_form() -> Outcome {
    // With q0 = E − O, q1 = E + O, L_d is (h/2)(λ E² + μ O²), and cos θ = (μ + λ)/(μ − λ). Without displacement
    // λ = −u²S/cos²(u/2), μ = u²S/sin²(u/2), S = (2 + cos u)/3, which would be exact; the displacement of the
    // middle node sees E only, and takes g²/H from λ.
    let start = SpringState { x: 0.6, dot_x: 0.9 };
    for u in [0.1, 0.5, 1.0, 1.5] {
        let half: f64 = u / 2.0;
        let s = (2.0 + u.cos()) / 3.0;
        let g = (4.0 * u * half.sin() - 2.0 * u * u) / (3.0 * half.cos());
        let lambda = -s * (u / half.cos()).powi(2) - g * g / (16.0 / 3.0 - 2.0 / 3.0 * u * u);
        let mu = s * (u / half.sin()).powi(2);
        let cosine = (mu + lambda) / (mu - lambda);
        let method = Galerkin::<3>::new().phase_fitted(Constant(2.0));
        let system = Spring { stiffness: 4.0 };
        let mut run = Integrator::new(&system, method, u / 2.0, start)?;
        let mut window = [run.q()[0]; 3];
        for step in 0..200 {
            run.advance()?;
            window = [window[1], window[2], run.q()[0]];
            let residual = window[0] - 2.0 * cosine * window[1] + window[2];
            assert!(step == 0 || residual.abs() < 2e-14, "u = {u}, step {step}: {residual:e}");
        }
    }
    Ok(())
}

/// The error of the angle of one step on the oscillator.
fn phase_error<F: FrequencyIn<f64>, const NODES: usize>(
    method: Galerkin<NODES, F>,
    u: f64,
) -> Result<f64, Box<dyn core::error::Error>> {
    let system = Spring { stiffness: 1.0 };
    let mut run = Integrator::new(&system, method, u, SpringState { x: 1.0, dot_x: 0.3 })?;
    let first = run.q()[0];
    run.advance()?;
    let second = run.q()[0];
    run.advance()?;
    Ok((((first + run.q()[0]) / (2.0 * second)).acos() - u).abs())
}

#[test]
fn fitted_interpolation_gains_two_orders_of_phase() -> Outcome {
    fn check<const NODES: usize>(u: [f64; 2]) -> Outcome {
        let (plain, fitted) =
            (Galerkin::<NODES>::new(), Galerkin::<NODES>::new().phase_fitted(Constant(1.0)));
        let ratio = (u[1] / u[0]).ln();
        let by_plain = (phase_error(plain, u[1])? / phase_error(plain, u[0])?).ln() / ratio;
        let by_fitted = (phase_error(fitted, u[1])? / phase_error(fitted, u[0])?).ln() / ratio;
        assert!((by_plain - (2 * NODES - 1) as f64).abs() < 0.2, "{NODES} nodes: {by_plain}");
        assert!((by_fitted - (2 * NODES + 1) as f64).abs() < 0.2, "{NODES} nodes: {by_fitted}");
        Ok(())
    }
    check::<3>([0.3, 0.6])?;
    check::<4>([0.6, 0.9])?;
    check::<5>([1.0, 1.3])
}

#[test]
fn what_cannot_be_done_is_refused() {
    fn refused<S: RegularLagrangian, F: FrequencyIn<f64>>(
        (system, start): (S, S::State<f64>),
        method: Galerkin<3, F>,
        expected: &str,
    ) {
        let failure = Integrator::new(&system, method, 0.1, start).err();
        assert!(
            matches!(failure, Some(StartError::Unsupported { option, .. }) if option == expected),
            "{expected}: {failure:?}"
        );
    }
    let method = Galerkin::<3>::new();
    let kepler = || (KEPLER, pericentre(0.3));
    refused(kepler(), method.phase_fitted(PerCoordinate([1.0, 2.0])), "PerCoordinate");
    for reading in [Reading::LeftFrozen, Reading::Variational] {
        refused(kepler(), method.phase_fitted(Radial(reading)), "this reading of the frequency");
    }
    refused(
        double_pendulum(),
        method.phase_fitted(Radial(Reading::Averaged)),
        "a frequency read from the motion",
    );
    refused(double_pendulum(), Galerkin { solver: Solver::FixedPoint, ..method }, "Solver::FixedPoint");
    let resonant = method.phase_fitted(Constant(PI));
    let failure = Integrator::new(&KEPLER, resonant, 1.0, pericentre(0.3)).err();
    assert!(matches!(failure, Some(StartError::Starter(StepFailure::Resonance { .. }))), "{failure:?}");
    let failure = Integrator::new(&KEPLER, method.phase_fitted(Constant(-1.0)), 1.0, pericentre(0.3)).err();
    assert!(matches!(failure, Some(StartError::Parameter { name: "omega", .. })), "{failure:?}");
    let collision = KeplerState { x: 0.0, y: 0.0, dot_x: 1.0, dot_y: 0.0 };
    let failure = Integrator::new(&KEPLER, method, 0.1, collision).err();
    assert!(matches!(failure, Some(StartError::Starter(StepFailure::NotFinite { .. }))), "{failure:?}");
}

/// The failure of a run that must fail, which keeps its last good state.
fn failure<S: RegularLagrangian>(
    (system, start): (S, S::State<f64>),
    method: Galerkin<4>,
    h: f64,
) -> Result<StepFailure, Box<dyn core::error::Error>> {
    let mut run = Integrator::new(&system, method, h, start)?;
    for _ in 0..1000 {
        let before = (run.q().to_vec(), run.memory().p().to_vec(), run.steps());
        if let Err(error) = run.advance() {
            assert_eq!((run.q().to_vec(), run.memory().p().to_vec(), run.steps()), before);
            assert_eq!(error.step, before.2);
            assert!(run.next().is_none());
            return Ok(error.failure);
        }
    }
    Err("it did not fail".into())
}

#[test]
fn failures_are_values_and_keep_the_last_good_state() -> Outcome {
    let method = Galerkin::<4>::new();
    // At the pole the angle φ has no momentum.
    let pole = SphericalPendulumState { theta: 0.0, phi: 0.3, dot_theta: 0.0, dot_phi: 0.8 };
    let found = failure((SphericalPendulum { g: 1.0 }, pole), method, 0.1)?;
    assert!(matches!(found, StepFailure::Singular { column: 1, .. }), "{found:?}");
    // Far beyond the speed of light in the first iterate.
    let found = failure(relativistic(), method, 50.0)?;
    assert!(matches!(found, StepFailure::NotFinite { .. }), "{found:?}");
    let stopping = Stopping { max_iterations: 2, ..Stopping::default() };
    for solver in [Solver::FixedPoint, Solver::Automatic] {
        let found = failure((KEPLER, pericentre(0.3)), Galerkin { solver, stopping, ..method }, 0.5)?;
        assert!(matches!(found, StepFailure::NotConverged { iterations: 2, .. }), "{solver:?}: {found:?}");
    }
    let found = failure(double_pendulum(), Galerkin { stopping, ..method }, 0.1)?;
    assert!(matches!(found, StepFailure::NotConverged { iterations: 2, .. }), "{found:?}");
    Ok(())
}

#[test]
fn a_fixed_point_step_needs_forces_only_and_newton_stands_by() -> Outcome {
    let mut run = Integrator::new(&KEPLER, Galerkin::<4>::new(), 0.05, pericentre(0.3))?;
    run.advance_by(200)?;
    let statistics = run.statistics();
    // Two interior nodes an iteration; to finish, the same two and the end.
    assert_eq!(statistics.gradients, 2 * statistics.iterations + 3 * statistics.steps);
    assert_eq!((statistics.linearizations, statistics.factorisations), (0, 0));
    let (system, start) = (Spring { stiffness: 100.0 }, SpringState { x: 1.0, dot_x: 0.0 });
    let mut stiff = Integrator::new(&system, Galerkin::<4>::new(), 0.5, start)?;
    stiff.advance_by(20)?;
    assert!(stiff.statistics().factorisations > 0);
    Ok(())
}

/// Steps of these lengths there, and of their negatives back.
fn check_variable_steps<S: RegularLagrangian>(system: &S, [q, v]: [&[f64]; 2]) -> Outcome {
    let method = Galerkin::<4>::new();
    let mut point = Space::vector(system.space());
    point.copy_from_slice(q);
    let mut memory = method.begin(system, &point, v, 0.0, 0.1)?;
    let momentum = memory.p().to_vec();
    let mut statistics = Statistics::default();
    let (lengths, mut t) = ([0.1, 0.09, 0.1, 0.03, 0.2, 0.01], 0.0);
    let back = lengths.iter().rev().map(|h| -h);
    for h in lengths.iter().copied().chain(back) {
        method.step(system, &mut memory, &mut point, t, h, &mut statistics)?;
        t += h;
    }
    let error = apart(&point, q).max(apart(memory.p(), &momentum));
    assert!(error < 1e-12, "{}: {error:e}", S::REPORT.system);
    Ok(())
}

#[test]
fn steps_of_different_lengths_may_follow_one_another() -> Outcome {
    check_variable_steps(&KEPLER, [&[1.0, 0.1], &[-0.2, 1.1]])?;
    check_variable_steps(&double_pendulum().0, [&[1.1, -0.4], &[0.3, 0.9]])?;
    check_variable_steps(&chain().0, [&[0.1, -0.2, 0.4, 0.3], &[0.5, 0.0, -0.1, 0.2]])
}

#[test]
fn single_precision_steps_to_its_own_rounding() -> Outcome {
    let start = KeplerState { x: 1.0, y: 0.1, dot_x: -0.2, dot_y: 1.1 };
    let narrow = KeplerState { x: 1.0_f32, y: 0.1, dot_x: -0.2, dot_y: 1.1 };
    let mut single = Integrator::new(&KEPLER, Galerkin::<5>::new(), 0.1_f32, narrow)?;
    let mut double = Integrator::new(&KEPLER, Galerkin::<5>::new(), 0.1, start)?;
    single.advance_by(50)?;
    double.advance_by(50)?;
    for (a, b) in single.q().iter().zip(double.q()) {
        assert!((f64::from(*a) - b).abs() < 1e-4, "{a} and {b}");
    }
    Ok(())
}
