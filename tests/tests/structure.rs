//! What the schemes preserve, and how far they are stable.

use approx::assert_abs_diff_eq;
use dvi_core::DegenerateLagrangian;
use dvi_core::discrete::Interval;
use dvi_core::methods::Method;
use dvi_core::prelude::*;
use dvi_examples::alternating::AlternatingComponent;
use dvi_tests::Outcome;
use dvi_tests::configurations::{chaotic, leapfrogging, quasi_periodic};
use dvi_tests::systems::*;
use dvi_tests::zoo::regular::{
    DoublePendulum, Gravity, Kepler, MagneticParticle, Relativistic, RunTimeChain,
};
use dvi_tests::{apart, larger};

const SIGMAS: [f64; 6] = [0.0, 0.25, 0.211_324_865_405_187_1, 0.5, 0.75, 1.0];

/// The largest deviation of each momentum from its first value.
fn drift<M: Method<PointVortices<4>, f64>>(
    mut run: Integrator<&PointVortices<4>, M>,
    steps: u64,
) -> Result<[f64; 3], StepError> {
    let value =
        |run: &Integrator<&PointVortices<4>, M>| [0, 1, 2].map(|i| run.momentum(i).unwrap_or(f64::NAN));
    let (first, mut largest) = (value(&run), [0.0_f64; 3]);
    for _ in 0..steps {
        run.advance()?;
        let now = value(&run);
        largest = core::array::from_fn(|i| larger(largest[i], (now[i] - first[i]).abs()));
    }
    Ok(largest)
}

#[test]
fn the_centre_of_vorticity_stays() -> Outcome {
    for (system, start) in [quasi_periodic(), chaotic(), leapfrogging()] {
        for sigma in SIGMAS {
            let [x, y, _] = drift(Integrator::new(&system, Sigma::new(sigma), 0.02, start)?, 500)?;
            assert!(x < 1e-12 && y < 1e-12, "sigma = {sigma}: {x:e} {y:e}");
        }
    }
    Ok(())
}

#[test]
fn the_angular_impulse_stays_with_the_midpoint_rule_only() -> Outcome {
    let (system, start) = quasi_periodic();
    let [.., angular] = drift(Integrator::new(&system, Sigma::midpoint(), 0.1, start)?, 1000)?;
    assert!(angular < 1e-12, "{angular:e}");
    let [.., angular] = drift(Integrator::new(&system, Gauss::<3>::new(), 0.1, start)?, 1000)?;
    assert!(angular < 1e-12, "{angular:e}");
    let [.., angular] = drift(Integrator::new(&system, Sigma::new(0.25), 0.02, start)?, 100)?;
    assert!(angular > 1e-8, "{angular:e}");
    let [.., angular] = drift(Integrator::new(&system, RungeKutta::classical(), 0.1, start)?, 1000)?;
    assert!(angular > 1e-8, "{angular:e}");
    Ok(())
}

#[test]
fn discrete_momenta_stay_for_every_sigma() -> Outcome {
    for (system, start) in [quasi_periodic(), leapfrogging()] {
        for sigma in SIGMAS {
            let mut run = Integrator::new(&system, Sigma::new(sigma), 0.02, start)?;
            let momenta = |run: &Integrator<&_, Sigma>| -> Result<[f64; 3], StepFailure> {
                let mut values = [f64::NAN; 3];
                for (i, value) in values.iter_mut().enumerate() {
                    *value = run.discrete_momentum(i)?.unwrap_or(f64::NAN);
                }
                Ok(values)
            };
            let first = momenta(&run)?;
            for step in 0..500 {
                run.advance()?;
                let drift = apart(&momenta(&run)?, &first);
                assert!(drift < 1e-12, "sigma = {sigma}, step {step}: {drift:e}");
            }
        }
    }
    Ok(())
}

#[test]
fn an_undeclared_momentum_is_none() -> Outcome {
    let (system, start) = quasi_periodic();
    let run = Integrator::new(&system, Sigma::midpoint(), 0.1, start)?;
    assert_eq!(run.momentum(3), None);
    assert_eq!(run.discrete_momentum(3)?, None);
    let names: Vec<_> = run.momenta().map(|(name, _)| name).collect();
    assert_eq!(names, ["impulse_x", "impulse_y", "angular"]);
    Ok(())
}

#[test]
fn a_vortex_alone_rests() -> Outcome {
    let start = PointVorticesState { x: [0.3], y: [-0.2] };
    for sigma in SIGMAS {
        let system = PointVortices { gamma: [1.0] };
        let mut run = Integrator::new(&system, Sigma::new(sigma), 0.1, start)?;
        run.take_steps(50)?;
        assert!(apart(run.q(), &[0.3, -0.2]) < 1e-15, "sigma = {sigma}");
    }
    Ok(())
}

/// Three consecutive points of a run, after some steps.
fn three_points<S: DegenerateLagrangian>(
    run: &mut Integrator<&S, Sigma>,
    steps: u64,
) -> Result<[Vec<f64>; 3], StepError> {
    while run.steps() < steps {
        run.advance()?;
    }
    let first = run.q().to_vec();
    run.advance()?;
    let second = run.q().to_vec();
    run.advance()?;
    Ok([first, second, run.q().to_vec()])
}

/// Whatever becomes of the parasitic mode.
fn unlimited(sigma: f64) -> Sigma {
    Sigma { parasitic_limit: None, ..Sigma::new(sigma) }
}

#[test]
fn the_tangent_maps_preserve_their_two_forms() -> Outcome {
    let h = 0.02;
    let vortices = chaotic();
    let curved = (Curved { kappa: 0.2 }, CurvedState { x: 0.6, y: -0.4 });
    for sigma in SIGMAS {
        let method = unlimited(sigma);
        let [vortex_points, curved_points] = [
            three_points(&mut Integrator::new(&vortices.0, method, h, vortices.1)?, 10)?,
            three_points(&mut Integrator::new(&curved.0, method, h, curved.1)?, 10)?,
        ];
        for (defect, name) in [
            (defects(&vortices.0, sigma, h, &vortex_points)?, "vortices"),
            (defects(&curved.0, sigma, h, &curved_points)?, "curved"),
        ] {
            let [discrete, canonical] = defect;
            assert!(discrete < 1e-12, "{name}, sigma = {sigma}: {discrete:e}");
            assert!(canonical < 1e-12, "{name}, sigma = {sigma}: {canonical:e}");
        }
    }
    Ok(())
}

fn defects<S: DegenerateLagrangian>(
    system: &S,
    sigma: f64,
    h: f64,
    [q0, q1, q2]: &[Vec<f64>; 3],
) -> Result<[f64; 2], StepFailure> {
    let (method, interval) = (Sigma::new(sigma), Interval { t: 0.0, h });
    let [mut before, mut map] = [(); 2].map(|()| TangentMap::new(system, &method));
    before.evaluate(system, interval, q0, q1)?;
    map.evaluate(system, Interval { t: h, h }, q1, q2)?;
    Ok([map.two_form_defect(&before, system), before.symplectic_defect(system)])
}

#[test]
fn the_tangent_map_agrees_with_differences_of_steps() -> Outcome {
    let (system, start) = quasi_periodic();
    let (h, epsilon) = (0.1, 1e-6);
    for sigma in [0.0, 0.25, 0.5, 1.0] {
        let mut run = Integrator::new(&system, Sigma::new(sigma), h, start)?;
        let [q0, q1, q2] = three_points(&mut run, 5)?;
        let [mut before, mut map] = [(); 2].map(|()| TangentMap::new(&system, run.method()));
        before.evaluate(&system, Interval { t: 0.0, h }, &q0, &q1)?;
        map.evaluate(&system, Interval { t: h, h }, &q1, &q2)?;
        let state = |q: &[f64]| PointVorticesState {
            x: core::array::from_fn(|j| q[j]),
            y: core::array::from_fn(|j| q[4 + j]),
        };
        for direction in 0..16 {
            let third = |sign: f64| -> Outcome<Vec<f64>> {
                let mut points = [q0.clone(), q1.clone()];
                points[direction / 8][direction % 8] += sign * epsilon;
                let [a, b] = points;
                let mut run =
                    Integrator::from_two_points(&system, Sigma::new(sigma), h, state(&a), state(&b))?;
                run.advance()?;
                run.advance()?;
                Ok(run.q().to_vec())
            };
            let (plus, minus) = (third(1.0)?, third(-1.0)?);
            let difference: Vec<_> =
                plus.iter().zip(&minus).map(|(a, b)| (a - b) / (2.0 * epsilon)).collect();
            let mut dq: [_; 2] = core::array::from_fn(|_| dvi_core::Space::vector(system.space()));
            dq[direction / 8][direction % 8] = 1.0;
            let [dq0, dq1] = &mut dq;
            map.apply_after(&before, dq0, dq1);
            assert!(apart(dq1, &difference) < 1e-7, "sigma = {sigma}, direction {direction}");
        }
    }
    Ok(())
}

/// Whether a run on the oscillator stays bounded for many steps.
fn is_stable(sigma: f64, omega_h: f64) -> Outcome<bool> {
    let system = Oscillator { omega: 1.0 };
    let (first, second) =
        (OscillatorState { x: 1.0, y: 0.0 }, OscillatorState { x: omega_h.cos(), y: omega_h.sin() });
    // Newton solves linear equations in one step at any h, where the fixed point would diverge.
    let method = Sigma { solver: Solver::Newton, ..unlimited(sigma) };
    let mut run = Integrator::from_two_points(&system, method, omega_h, first, second)?;
    let mut largest: f64 = 0.0;
    for _ in 0..4000 {
        run.advance()?;
        largest = run.q().iter().fold(largest, |m, q| larger(m, q.abs()));
    }
    Ok(largest < 1e3)
}

#[test]
fn the_linear_stability_limit_is_where_the_theory_puts_it() -> Outcome {
    for sigma in [0.0, 0.25, 0.4, 0.7, 1.0] {
        let limit = 1.0 / f64::abs(1.0 - 2.0 * sigma);
        assert!(is_stable(sigma, limit * 0.999)?, "sigma = {sigma}");
        assert!(!is_stable(sigma, limit * 1.001)?, "sigma = {sigma}");
    }
    assert!(is_stable(0.5, 1000.0)?);
    Ok(())
}

#[test]
fn an_alternating_component_is_measured_and_a_smooth_one_is_not() -> Outcome {
    let (system, start) = quasi_periodic();
    // With σ = ½ a start off the constraint alternates with constant amplitude.
    let method = Sigma { start: Start::RungeKutta(RungeKutta::midpoint()), ..Sigma::midpoint() };
    for (method, alternates) in [(method, true), (Sigma::midpoint(), false)] {
        let mut run = Integrator::new(&system, method, 0.02, start)?;
        let first = run.memory().parasitic_amplitude();
        let mut filter = AlternatingComponent::default();
        let mut amplitudes = Vec::new();
        for _ in 0..200 {
            amplitudes.extend(filter.amplitude(run.q()));
            run.advance()?;
        }
        assert_eq!(amplitudes.len(), 196);
        assert_abs_diff_eq!(run.memory().parasitic_amplitude(), first, epsilon = 1e-18);
        assert_eq!(first > 0.0, alternates);
        // Γ = 1: p = α + c, and an alternating part a of q has |c| = |a|, up to the smooth remainder.
        let smooth = 1e-6;
        for amplitude in amplitudes {
            assert!(amplitude < first + smooth);
        }
    }
    Ok(())
}

#[test]
fn the_filter_passes_alternating_sequences_and_stops_cubics() {
    let mut filter = AlternatingComponent::default();
    let cubic = |k: f64| 0.5 + k - 0.25 * k * k + 0.125 * k * k * k;
    for k in 0..12 {
        let (x, sign) = (f64::from(k), if k % 2 == 0 { 1.0 } else { -1.0 });
        let filtered = filter.push(&[cubic(x) + 0.75 * sign, cubic(x)]);
        // The window is centred two steps back, where the sign is the same.
        let expected = (k >= 4).then(|| vec![0.75 * sign, 0.0]);
        assert_eq!(filtered, expected);
    }
}

#[test]
fn the_report_of_a_regular_system_prints_all_of_it() {
    let expected = "\
Kepler
coordinates
  x
  y
formulas
  L = 0.5·(dot(x)^2 + dot(y)^2 + 2·mu/sqrt(x^2 + y^2))
  E = 0.5·(dot(x)^2 + dot(y)^2 - 2·mu/sqrt(x^2 + y^2))
  angular = x·dot(y) - dot(x)·y
  ∂L/∂x = -x·mu/sqrt(x^2 + y^2)^3
  ∂L/∂dot(x) = dot(x)
  ∂L/∂y = -y·mu/sqrt(x^2 + y^2)^3
  ∂L/∂dot(y) = dot(y)
structure
  L = ½ v·M v − V(q, t) with a constant diagonal mass matrix M.
  The trapezoidal (Störmer–Verlet) step is explicit: one gradient of V a step, no iteration, no factorisation.
  L is a polynomial of degree two in v: p = ∂L/∂v is affine in v.
  Begin with `Variational::trapezoid()`.
  Checked when compiled: at 2 points, every generated function agrees with the formulas as written, to 1e-15 of the sum of the absolute terms.
operations of the residual
  once: 1 addition, 7 multiplications, 1 division, 1 call
operations of residual and Jacobian
  once: 3 additions, 16 multiplications, 1 division, 1 call
entries of the Jacobian
  (x, x)
  (x, y)
  (y, x)
  (y, y)
";
    assert_eq!(Kepler::REPORT.to_string(), expected);
}

#[test]
fn reports_say_what_the_mass_matrix_is_like() {
    for (report, sentence) in [
        (Gravity::<3>::REPORT, "L = ½ v·M v − V(q, t) with a constant diagonal mass matrix M."),
        (RunTimeChain::REPORT, "L = ½ v·M v − V(q, t) with a constant full mass matrix M."),
        (
            RunTimeChain::REPORT,
            "The trapezoidal (Störmer–Verlet) step is explicit up to one factorisation for the whole run.",
        ),
        (DoublePendulum::REPORT, "The full mass matrix depends on q."),
        (DoublePendulum::REPORT, "The trapezoidal step is implicit in general."),
        (DoublePendulum::REPORT, "Begin with `Variational::midpoint()`."),
        (Relativistic::REPORT, "The full mass matrix depends on v."),
        (
            Relativistic::REPORT,
            "L is no polynomial of degree two in v: v is found from p = ∂L/∂v by iteration.",
        ),
        (MagneticParticle::REPORT, "The diagonal mass matrix is constant, but L is not ½ v·M v − V(q, t)."),
    ] {
        assert!(report.structure.contains(&sentence), "{}: {:?}", report.system, report.structure);
    }
}

/// Pendulums that do not touch, with α and H apart.
#[degenerate_lagrangian(
    coordinates(x[n], p[n]),
    one_form = sum(0..n, |i| p[i] * d(x[i])),
    hamiltonian = sum(0..n, |i| p[i].powi(2) / 2.0 - x[i].cos()),
)]
struct Apart {
    n: usize,
}

#[degenerate_lagrangian(
    coordinates(x[n], p[n]),
    lagrangian = sum(0..n, |i| p[i] * dot(x[i]) - p[i].powi(2) / 2.0 + x[i].cos()),
)]
struct InOneSum {
    n: usize,
}

#[degenerate_lagrangian(
    coordinates(x[n], p[n]),
    lagrangian = scale * sum(0..n, |i| scale * (p[i] * dot(x[i]) - p[i].powi(2) / 2.0 + x[i].cos())),
)]
struct Scaled {
    n: usize,
    scale: f64,
}

#[test]
fn a_lagrangian_in_one_sum_has_the_form_that_it_has_in_two() -> Outcome {
    fn check<S: DegenerateLagrangian>(system: &S, state: S::State<f64>) -> Outcome<Vec<f64>> {
        const { assert!(S::AFFINE && S::CANONICAL) };
        let alpha = S::REPORT.formulas.iter().find(|formula| formula.name == "α").ok_or("no α")?;
        assert!(!alpha.text.contains("cos"), "{}", alpha.text);
        let method = Sigma { summation: Summation::Compensated, ..Sigma::midpoint() };
        let mut run = Integrator::new(system, method, 0.1, state)?;
        run.take_steps(100)?;
        Ok(run.q().to_vec())
    }
    let (x, p) = (vec![0.5, 0.1, 0.2], vec![0.3; 3]);
    let in_two = check(&Apart { n: 3 }, ApartState { x: x.clone(), p: p.clone() })?;
    let in_one = check(&InOneSum { n: 3 }, InOneSumState { x: x.clone(), p: p.clone() })?;
    let scaled = check(&Scaled { n: 3, scale: 0.7 }, ScaledState { x, p })?;
    assert!(apart(&in_two, &in_one) < 1e-13 && apart(&in_two, &scaled) < 1e-13);
    Ok(())
}
