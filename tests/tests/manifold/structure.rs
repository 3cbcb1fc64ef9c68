//! What the steps keep: manifolds, momenta, the canonical form; and that they can be taken back.

use dvi_core::discrete::Rule;
use dvi_core::prelude::*;
use dvi_core::rotations;
use dvi_examples::models::{SphericalPendulum, SphericalPendulumStateOf};
use dvi_tests::apart;
use dvi_tests::zoo::manifold::{
    Body, BodyStateOf, COUPLED, FREE, NotSeparable, NotSeparableState, Separable, SeparableState, UNEVEN,
    coupled, cross, dot,
};
use num_dual::Dual64;

#[test]
fn symmetric_steps_can_be_taken_back() {
    for rule in [Quadrature::trapezoid(), Quadrature::midpoint(), Quadrature::simpson()] {
        let start = coupled();
        let mut run = Integrator::new(&COUPLED, Geodesic::new(rule), 0.05, start)
            .expect("a step that is short enough");
        run.take_steps(100).expect("a step that is short enough");
        let back = run.checkpoint().with_step_size(-0.05);
        let mut run =
            Integrator::resume(&COUPLED, Geodesic::new(rule), &back).expect("a step that is short enough");
        run.take_steps(100).expect("a step that is short enough");
        let end = run.state();
        let [end, start] =
            [&end, &start].map(|state| [&state.R[..], &state.s, &state.x, &state.dot_x].concat());
        let difference = apart(&end, &start);
        assert!(difference < 1e-12, "{difference:e}");
    }
}

/// A step from (R exp(ε η̂), 𝕀(ω + ε δω)): R1ᵀδR1 as a vector, and δp1.
fn body_step(
    body: Body,
    method: Geodesic<impl Rule>,
    h: f64,
    [eta, change]: [[f64; 3]; 2],
) -> [[f64; 3]; 3] {
    let (R, omega) = (rotations::exp([0.4, -0.3, 0.2].map(Dual64::from)), [0.7, 1.1, 0.9]);
    let turned = rotations::product(&R, &rotations::exp(eta.map(|eta| Dual64::new(0.0, eta))));
    let omega = [0, 1, 2].map(|k| Dual64::new(omega[k], change[k]));
    let start = BodyStateOf { R: turned, omega_R: omega };
    let mut run =
        Integrator::new(&body, method, Dual64::from(h), start).expect("a step that is short enough");
    run.take_steps(1).expect("a step that is short enough");
    let (end, p) = (run.state().R, run.memory().p());
    // (RᵀδR)ᵢⱼ
    let entry = |i: usize, j: usize| (0..3).map(|k| end[3 * k + i].re * end[3 * k + j].eps).sum::<f64>();
    let eta = [entry(2, 1), entry(0, 2), entry(1, 0)];
    [eta, [p[0].eps, p[1].eps, p[2].eps], [p[0].re, p[1].re, p[2].re]]
}

/// dθ with θ = p·η, in the frame of the body: δp₁·η₂ − δp₂·η₁ − p·(η₁ × η₂).
fn form([first, second]: [[[f64; 3]; 2]; 2], p: [f64; 3]) -> f64 {
    let [[eta1, p1], [eta2, p2]] = [first, second];
    dot(p1, eta2) - dot(p2, eta1) - dot(p, cross(eta1, eta2))
}

/// The six directions of a state of a body.
fn directions() -> Vec<[[f64; 3]; 2]> {
    let unit = |k: usize| core::array::from_fn(|i| if i == k % 3 { 1.0 } else { 0.0 });
    (0..6).map(|k| if k < 3 { [unit(k), [0.0; 3]] } else { [[0.0; 3], unit(k)] }).collect()
}

#[test]
fn steps_of_bodies_preserve_the_canonical_form() {
    for (body, rule) in [
        (FREE, Quadrature::midpoint()),
        (UNEVEN, Quadrature::trapezoid()),
        (UNEVEN, Quadrature::simpson()),
        (UNEVEN, Quadrature::sigma(0.2)),
    ] {
        let h = 0.4;
        let momentum = |omega: [f64; 3]| core::array::from_fn(|k| body.inertia[k] * omega[k]);
        let before: Vec<[[f64; 3]; 2]> =
            directions().iter().map(|&[eta, change]| [eta, momentum(change)]).collect();
        let after: Vec<[[f64; 3]; 3]> =
            directions().iter().map(|&along| body_step(body, Geodesic::new(rule), h, along)).collect();
        let p0 = momentum([0.7, 1.1, 0.9]);
        for (i, j) in (0..6).flat_map(|i| (0..i).map(move |j| (i, j))) {
            let now = form([i, j].map(|k| [after[k][0], after[k][1]]), after[i][2]);
            let difference = form([before[i], before[j]], p0) - now;
            assert!(difference.abs() < 2e-13, "{rule:?} ({i}, {j}): {difference:e}");
        }
    }
}

#[test]
fn steps_on_the_sphere_preserve_the_canonical_form() {
    let pendulum = SphericalPendulum { gravity: 2.0 };
    let (s, v) = ([0.48, -0.6, 0.64], [0.8, 0.64, 0.0]);
    // Tangent vectors of the space of states: δs along s × w, and δv with s·δv = −v·δs.
    let tangents: Vec<[[f64; 3]; 2]> = [[1.0, 0.0, 0.2], [0.0, 1.0, -0.4]]
        .into_iter()
        .flat_map(|w: [f64; 3]| {
            let along = cross(s, w);
            let back = -dot(v, along);
            [[along, s.map(|s| back * s)], [[0.0; 3], along]]
        })
        .collect();
    let form = |[a, b]: [&[[f64; 3]; 2]; 2]| dot(a[0], b[1]) - dot(a[1], b[0]);
    for rule in
        [Quadrature::trapezoid(), Quadrature::midpoint(), Quadrature::simpson(), Quadrature::sigma(0.7)]
    {
        let after: Vec<[[f64; 3]; 2]> = tangents
            .iter()
            .map(|&[along, change]| {
                let start = SphericalPendulumStateOf {
                    s: [0, 1, 2].map(|k| Dual64::new(s[k], along[k])),
                    dot_s: [0, 1, 2].map(|k| Dual64::new(v[k], change[k])),
                };
                let mut run = Integrator::new(&pendulum, Geodesic::new(rule), Dual64::from(0.4), start)
                    .expect("a step that is short enough");
                run.take_steps(1).expect("a step that is short enough");
                let (end, p) = (run.state().s, run.memory().p());
                // p = (s × p) × s
                let turned = |i: usize, j: usize| p[i] * end[j] - p[j] * end[i];
                let p = [turned(1, 2), turned(2, 0), turned(0, 1)];
                [end.map(|s| s.eps), p.map(|p| p.eps)]
            })
            .collect();
        for (i, j) in (0..4).flat_map(|i| (0..i).map(move |j| (i, j))) {
            let difference = form([&tangents[i], &tangents[j]]) - form([&after[i], &after[j]]);
            assert!(difference.abs() < 2e-14, "{rule:?} ({i}, {j}): {difference:e}");
        }
    }
}

/// The step by kicks, and the general one, of a system that is the same but for a term of the size zero.
/// Where nothing is coupled, and a ball turns as easily about each axis, nothing is solved.
#[test]
fn steps_by_kicks_are_those_of_the_general_equations() {
    const {
        assert!(<Separable as NondegenerateLagrangian>::SEPARABLE);
        assert!(!<NotSeparable as NondegenerateLagrangian>::SEPARABLE);
    }
    let (R, omega_R) = (rotations::exp([0.4, -0.3, 0.2]), [0.5, -0.8, 0.9]);
    let (s, dot_s) = ([0.48, -0.6, 0.64], [0.8, 0.64, 0.0]);
    let start = SeparableState { R, s, x: 0.3, omega_R, dot_s, dot_x: -0.4 };
    let same = NotSeparableState { R, s, x: 0.3, omega_R, dot_s, dot_x: -0.4 };
    for (inertia, coupling) in
        [([1.0, 2.0, 2.4], 1.0), ([1.3; 3], 1.0), ([1.3, 1.3, 1.5], 0.0), ([1.3; 3], 0.0)]
    {
        let is_free = coupling == 0.0 && inertia == [inertia[0]; 3];
        let separable = Separable { inertia, coupling, zero: 0.0 };
        let general = NotSeparable { inertia, coupling, zero: 0.0 };
        for rule in [Quadrature::trapezoid(), Quadrature::sigma(0.0), Quadrature::sigma(1.0)] {
            let mut by_kicks = Integrator::new(&separable, Geodesic::new(rule), 0.1, start).expect("begins");
            let mut by_all = Integrator::new(&general, Geodesic::new(rule), 0.1, same).expect("begins");
            for _ in 0..50 {
                by_kicks.take_steps(1).expect("a short step");
                by_all.take_steps(1).expect("a short step");
                let (a, b) = (by_kicks.state(), by_all.state());
                let (a, b) = (
                    [&a.R[..], &a.s, &a.omega_R, &a.dot_s, &[a.x]].concat(),
                    [&b.R[..], &b.s, &b.omega_R, &b.dot_s, &[b.x]].concat(),
                );
                let difference = apart(&a, &b);
                assert!(difference < 2e-13, "{rule:?}: {difference:e}");
            }
            let statistics = by_kicks.statistics();
            assert_eq!((statistics.gradients, statistics.linearizations), (50, 0));
            assert_eq!(statistics.iterations == 0, is_free);
        }
    }
}

/// A body on a spring, of whose coordinates the first rests where it is zero.
#[lagrangian(
    coordinates(x[2], R: SO3),
    lagrangian = (1.0 + 0.2 * x[1].powi(2)) * (dot(x[0]).powi(2) + dot(x[1]).powi(2)) / 2.0
        + (omega(R)[0].powi(2) + 2.0 * omega(R)[1].powi(2) + 3.0 * omega(R)[2].powi(2)) / 2.0
        - x[0].powi(2) - x[1].powi(4) - R[2][2] * x[1],
)]
struct Sprung;

/// Of an array the largest coordinate is the unit of all.
#[test]
fn a_number_that_rests_at_zero_beside_a_rotation_is_no_task_of_its_own() {
    let R = rotations::exp([0.3, 0.0, 0.0]);
    let start = SprungState { x: [0.0, 1.3], R, dot_x: [0.0, 0.2], omega_R: [0.1, 0.2, 3.0] };
    let mut run = Integrator::new(&Sprung, Geodesic::midpoint(), 0.02, start).expect("begins");
    let begin = run.energy();
    run.take_steps(500).expect("short steps");
    assert_eq!(run.state().x[0], 0.0);
    assert!((run.energy() - begin).abs() < 1e-2, "{:e}", run.energy() - begin);
}

/// A body that turns, and a weight that slides on it to the place u x.
#[lagrangian(
    coordinates(x, R: SO3),
    lagrangian = (omega(R)[0].powi(2) + 2.0 * omega(R)[1].powi(2) + 3.0 * omega(R)[2].powi(2)) / 2.0
        + u * dot(x) * (u * dot(x) / 2.0 + coupling * omega(R)[0]) - u * x * (u * x + R[2][2]),
)]
struct Slider {
    u: f64,
    coupling: f64,
}

#[test]
fn the_unit_of_a_number_beside_a_rotation_does_not_matter() {
    let end = |u: f64, coupling: f64| {
        let R = rotations::exp([0.1, 0.2, 0.3]);
        let start = SliderState { x: 0.25 / u, R, dot_x: 0.1 / u, omega_R: [0.1, 0.5, 0.3] };
        let slider = Slider { u, coupling };
        let mut run = Integrator::new(&slider, Geodesic::midpoint(), 0.05, start).expect("begins");
        run.take_steps(50).expect("short steps");
        let state = run.state();
        (u * state.x, state.R)
    };
    for coupling in [0.0, 0.3] {
        for exponent in [80, 20, -20, -60, -80] {
            assert_eq!(end(2_f64.powi(exponent), coupling), end(1.0, coupling), "2^{exponent}");
        }
    }
}
