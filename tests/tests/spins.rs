//! Unit vectors of degenerate systems: spins and vortices against closed forms, and where a chart ends.

use core::f64::consts::TAU;

use dvi_core::ensemble::Ensemble;
use dvi_core::prelude::*;
use dvi_tests::zoo::manifold::{cross, dot};
use dvi_tests::{Outcome, apart, larger, oracle};
use num_dual::{Dual64, DualNum as _};

type Vector = [f64; 3];

/// A spin in a field: κ ṡ = s × ∂H/∂s = b × s, so that it turns around b with the rate |b|/κ.
#[degenerate_lagrangian(coordinates(s: S2), one_form = kappa * area(s), hamiltonian = -b.dot(s))]
struct InField {
    kappa: f64,
    b: [f64; 3],
}

/// A ring of spins of different lengths, with an easy axis.
#[degenerate_lagrangian(
    coordinates(s[N]: S2),
    one_form    = sum(0..N, |i| length[i] * area(s[i])),
    hamiltonian = -sum(0..N, |i| s[i].dot(s[(i + 1) % N]) + anisotropy / 2.0 * s[i][2].powi(2)),
    momenta(
        axial = sum(0..N, |i| length[i] * s[i][2]),
        across = sum(0..N, |i| length[i] * s[i])[0],
    ),
    events(level = s[0][2]),
)]
struct Ring<const N: usize> {
    length: [f64; N],
    anisotropy: f64,
}

/// Point vortices on the sphere, any number of them.
#[degenerate_lagrangian(
    coordinates(s[gamma.len()]: S2),
    one_form    = sum(0..gamma.len(), |j| gamma[j] * area(s[j])),
    hamiltonian = sum_pairs(0..gamma.len(), |j, k| gamma[j] * gamma[k] * (s[j] - s[k]).norm_squared().ln()) / (4.0 * PI),
)]
struct Vortices {
    gamma: Vec<f64>,
}

/// A spin that an oscillator drives, as L with two kinds of coordinates.
#[degenerate_lagrangian(
    coordinates(x, n: S2, p),
    lagrangian = p * dot(x) - area(n) - (p * p + x * x) / 2.0 - coupling * x * n[0] - n[2],
)]
struct Driven {
    coupling: f64,
}

fn plus(a: Vector, factor: f64, b: Vector) -> Vector {
    core::array::from_fn(|k| a[k] + factor * b[k])
}

fn length(v: Vector) -> f64 {
    dot(v, v).sqrt()
}

/// `v` turned around an axis by an angle (Rodrigues).
fn turned(v: Vector, axis: Vector, angle: f64) -> Vector {
    let k = axis.map(|x| x / length(axis));
    let (sin, cos) = angle.sin_cos();
    plus(plus(v.map(|x| x * cos), sin, cross(k, v)), dot(k, v) * (1.0 - cos), k)
}

fn spin(polar: f64, azimuth: f64) -> Vector {
    [polar.sin() * azimuth.cos(), polar.sin() * azimuth.sin(), polar.cos()]
}

/// Spins in all directions.
fn spins<const N: usize>() -> [Vector; N] {
    core::array::from_fn(|i| spin(0.4 + 2.3 * i as f64 / N as f64, 2.4 * i as f64))
}

const RING: Ring<5> = Ring { length: [1.0, 0.7, 1.3, 0.9, 1.1], anisotropy: 0.4 };

/// max ||s| − 1|
fn off(vectors: &[Vector]) -> f64 {
    vectors.iter().map(|s| (length(*s) - 1.0).abs()).fold(0.0, larger)
}

/// ṡ = s × ∂H/∂s over the length of the spin, by hand.
fn rates(ring: &Ring<5>, s: [Vector; 5]) -> [Vector; 5] {
    core::array::from_fn(|i| {
        let neighbours = plus(s[(i + 4) % 5], 1.0, s[(i + 1) % 5]);
        let field = plus(neighbours, ring.anisotropy * s[i][2], [0.0, 0.0, 1.0]);
        cross(field, s[i]).map(|rate| rate / ring.length[i])
    })
}

#[test]
fn a_member_of_an_ensemble_is_the_run_alone() -> Outcome {
    let system = InField { kappa: 0.7, b: [0.3, -0.4, 0.8] };
    let starts: Vec<_> =
        (0..6).map(f64::from).map(|k| InFieldState { s: spin(0.2 + 0.4 * k, 0.5 * k) }).collect();
    let results = Ensemble::new(&system, Sigma::midpoint(), 0.02, starts.clone()).take_steps(50)?;
    for (member, start) in results.members().iter().zip(starts) {
        let mut run = Integrator::new(&system, Sigma::midpoint(), 0.02, start)?;
        run.take_steps(50)?;
        assert_eq!(member.state, run.state().s);
    }
    Ok(())
}

#[test]
fn a_ring_moves_by_the_equation_of_landau_and_lifshitz() -> Outcome {
    let s = spins();
    let found = RING.vector_field(0.0, &RingState { s })?.s;
    assert!(apart(found.as_flattened(), rates(&RING, s).as_flattened()) < 1e-15);
    // At the poles too, where charts end.
    let s = [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], spin(1.0, 0.2), [0.0, 0.0, -1.0], [0.0, -1.0, 0.0]];
    let found = RING.vector_field(0.0, &RingState { s })?.s;
    assert!(apart(found.as_flattened(), rates(&RING, s).as_flattened()) < 1e-15);
    Ok(())
}

/// The order of a method between two steps, at t = 4.
fn order<M: Method<Ring<5>, f64> + Copy>(method: M, exact: &[f64], steps: u64) -> Outcome<f64> {
    let error = |steps: u64| -> Outcome<f64> {
        let mut run = Integrator::new(&RING, method, 4.0 / steps as f64, RingState { s: spins() })?;
        run.take_steps(steps)?;
        assert!(off(&run.state().s) < 1e-14, "{:e}", off(&run.state().s));
        Ok(apart(run.state().s.as_flattened(), exact))
    };
    Ok((error(steps)? / error(2 * steps)?).log2())
}

#[test]
fn methods_have_their_orders_and_keep_the_lengths() -> Outcome {
    // By the rates by hand, in short steps.
    let by_hand = |y: &[f64], _| {
        rates(&RING, core::array::from_fn(|i| [y[3 * i], y[3 * i + 1], y[3 * i + 2]])).concat()
    };
    let steps = (0..4_000).map(|_| [0.0, 4.0 / 4_000.0]);
    let exact = steps.fold(spins::<5>().concat(), |y, step| oracle::runge_kutta(by_hand, &y, step));
    for (expected, found) in [
        (2.0, order(Sigma::midpoint(), &exact, 160)?),
        (2.0, order(Projected::symmetric(), &exact, 160)?),
        (4.0, order(Gauss::<2>::new(), &exact, 40)?),
    ] {
        assert!((found - expected).abs() < 0.1, "{found} and not {expected}");
    }
    Ok(())
}

/// A pair turns around its moment M = Σ Γ s at the rate |M|/2πl², with its distance l (Polvani & Dritschel
/// 1993). Here the first of them starts at the pole.
#[test]
fn a_vortex_passes_over_the_pole() -> Outcome {
    let (gamma, places) = ([1.0, 2.0], [spin(0.2, 1.0), [0.0, 0.0, 1.0]]);
    let moment = plus(places[0], 2.0, places[1]);
    let distance = length(plus(places[0], -1.0, places[1]));
    let rate = length(moment) / (TAU * distance * distance);
    let start = VorticesState { s: places.into() };
    let system = Vortices { gamma: gamma.into() };
    let steps = 400;
    let mut run = Integrator::new(&system, Gauss::<4>::new(), TAU / rate / f64::from(steps), start)?;
    for step in 1..=2 * steps {
        run.advance()?;
        let angle = TAU * f64::from(step) / f64::from(steps);
        for (s, place) in run.state().s.iter().zip(places) {
            assert!(apart(s, &turned(place, moment, angle)) < 1e-11, "{s:?} after {step} steps");
        }
    }
    // After two turns, over 800 steps, the second is on the pole again.
    assert!(run.state().s[1][2] > 1.0 - 1e-14);
    Ok(())
}

/// x' = p, p' = −x − c n_x and −ṅ = n × ∂H/∂n, by hand.
#[test]
fn a_spin_and_an_oscillator_are_one_system() -> Outcome {
    let (system, start) = (Driven { coupling: 0.3 }, DrivenState { x: 0.4, n: spin(1.1, 0.5), p: -0.2 });
    let DrivenState { x, n, p } = system.vector_field(0.0, &start)?;
    let by_hand = cross([0.3 * start.x, 0.0, 1.0], start.n);
    assert!(apart(&[x, p], &[start.p, -start.x - 0.3 * start.n[0]]) < 1e-15 && apart(&n, &by_hand) < 1e-15);
    let names: Vec<String> = system.names().map(|name| name.to_string()).collect();
    assert_eq!(names, ["x", "n.x", "n.y", "n.z", "p"]);
    let mut run = Integrator::new(&system, Gauss::<3>::new(), 0.1, start)?;
    let energy = run.energy();
    run.take_steps(1000)?;
    assert!((run.energy() - energy).abs() < 1e-8 && off(&[run.state().n]) < 1e-14);
    Ok(())
}

#[test]
fn states_are_vectors_wherever_they_are_seen() -> Outcome {
    let names: Vec<String> = RING.names().map(|name| name.to_string()).collect();
    assert_eq!(names[..4], ["s[0].x", "s[0].y", "s[0].z", "s[1].x"]);
    let start = RingState { s: spins() };
    let values: Vec<f64> = RING.values(&start)?.collect();
    assert!(values.len() == 15 && apart(&values, start.s.as_flattened()) < 4e-16);
    let read = crate::records::read_again(&RING, &start)?;
    assert!(read.len() == 1 && apart(read[0].s.as_flattened(), start.s.as_flattened()) < 4e-16);
    let mut run = Integrator::new(&RING, Sigma::midpoint(), 0.05, start)?;
    let event =
        run.declared_events([Direction::Either])?.next_until(20.0)?.ok_or("it passes the equator")?;
    assert!(event.state.s[0][2].abs() < 1e-14 && off(&event.state.s) < 1e-14);
    // A checkpoint has the spinors themselves.
    let checkpoint = run.checkpoint();
    let mut again = Integrator::resume(&RING, Sigma::midpoint(), &checkpoint)?;
    run.take_steps(50)?;
    again.take_steps(50)?;
    assert_eq!(run.q(), again.q());
    let mut run = Integrator::new(&RING, Sigma::midpoint(), 0.05, start)?;
    let record = dvi_core::record::Recorder::new(&RING).record(&mut run, 1, 3)?;
    assert_eq!(record.numbers("s[4].z")?.len(), 4);
    assert!((record.numbers("s[4].z")?[3] - run.state().s[4][2]).abs() < 4e-16);
    Ok(())
}

#[test]
fn starts_that_are_no_unit_vectors_are_named() {
    let refused = |s: [Vector; 5]| match Integrator::new(&RING, Sigma::midpoint(), 0.1, RingState { s }) {
        Err(error) => error,
        Ok(_) => panic!("it began"),
    };
    let mut s = spins();
    s[3] = s[3].map(|x| 1.5 * x);
    let error = refused(s);
    let StartError::OffManifold { block: "s", index: Some(3), defect, .. } = error else {
        panic!("{error}")
    };
    assert!((defect - 1.25).abs() < 1e-14 && error.to_string().starts_with("`s[3]` is off by "), "{error}");
    s[3] = [0.0; 3];
    assert!(matches!(refused(s), StartError::OffManifold { index: Some(3), defect: 1.0, .. }));
    s[3] = [0.6, f64::NAN, 0.8];
    assert_eq!(refused(s).to_string(), "s[3].y = NaN in the state");
    s[3] = [0.6, 0.8, f64::INFINITY];
    assert_eq!(refused(s).to_string(), "s[3].z = inf in the state");
}

#[test]
fn methods_that_would_leave_the_sphere_are_refused() {
    fn refused<M: Method<Ring<5>, f64>>(method: M) -> bool {
        let begun = Integrator::new(&RING, method, 0.01, RingState { s: spins() }).map(|_| ());
        matches!(begun, Err(StartError::Unsupported { reason, .. }) if reason.contains("lengths of unit vectors"))
    }
    assert!(refused(Sigma::leapfrog()) && refused(Sigma::new(0.4)));
    assert!(refused(Sigma { start: Start::RungeKutta(RungeKutta::classical()), ..Sigma::midpoint() }));
    let state = RingState { s: spins() };
    let two = Integrator::from_two_points(&RING, Sigma::midpoint(), 0.01, state, state).map(|_| ());
    assert!(matches!(two, Err(StartError::Unsupported { .. })));
}

/// Numbers with derivatives, and short ones.
#[test]
fn other_numbers_are_spins_too() -> Outcome {
    let angle = Dual64::from(2.0).derivative();
    let zero = Dual64::from(0.0);
    let system = InField { kappa: 1.5, b: [0.0, 0.0, 3.0] };
    let start = InFieldStateOf { s: [angle.sin(), zero, angle.cos()] };
    let mut run = Integrator::new(&system, Gauss::<3>::new(), Dual64::from(0.01), start)?;
    run.take_steps(50)?;
    // After half a unit of time it has turned by 1.
    let [x, y, z] = run.state().s;
    let expected = [2_f64.cos() * 1_f64.cos(), 2_f64.cos() * 1_f64.sin(), -2_f64.sin()];
    assert!(apart(&[x.eps, y.eps, z.eps], &expected) < 1e-12, "{x} {y} {z}");
    let mut run =
        Integrator::new(&system, Gauss::<3>::new(), 0.01_f32, InFieldStateOf { s: [0.6_f32, 0.0, -0.8] })?;
    run.take_steps(50)?;
    assert!((run.state().s[1] - 0.6 * 1_f32.sin()).abs() < 1e-5);
    Ok(())
}
