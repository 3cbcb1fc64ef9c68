//! Arrays of rotations and unit vectors: sizes of each kind against single names, motion by hand, what is
//! conserved, and what knows of the entries.

use approx::assert_abs_diff_eq;
use dvi_core::error::StepFailure;
use dvi_core::prelude::*;
use dvi_core::record::Recorder;
use dvi_core::rotations;

use dvi_tests::{Outcome, apart};

/// A chain of spherical pendulums, of any number: m_ij are the masses below both joints, times lengths.
macro_rules! chain {
    ($name:ident $(<$constant:ident>)?, $size:expr, $m:ty, $g:ty) => {
        #[lagrangian(
            coordinates(s[$size]: S2),
            lagrangian = sum(0..$size, |i| sum(0..$size, |j| m[i][j] * dot(s[i]).dot(dot(s[j])))) / 2.0
                - sum(0..$size, |i| g[i] * s[i][2]),
            momenta(vertical = sum(0..$size, |i| sum(0..$size, |j| m[i][j] * s[i].cross(dot(s[j]))))[2]),
        )]
        #[derive(Debug)]
        struct $name$(<const $constant: usize>)? {
            m: $m,
            g: $g,
        }
    };
}

chain!(Fixed<N>, N, [[f64; N]; N], [f64; N]);
chain!(Listed, g.len(), Vec<Vec<f64>>, Vec<f64>);

/// Three of them by name.
#[lagrangian(
    coordinates(s0: S2, s1: S2, s2: S2),
    lagrangian = (m[0][0] * dot(s0).norm_squared() + m[1][1] * dot(s1).norm_squared() + m[2][2] * dot(s2).norm_squared()) / 2.0
        + m[0][1] * dot(s0).dot(dot(s1)) + m[0][2] * dot(s0).dot(dot(s2)) + m[1][2] * dot(s1).dot(dot(s2))
        - g[0] * s0[2] - g[1] * s1[2] - g[2] * s2[2],
)]
#[derive(Debug)]
struct Named {
    m: [[f64; 3]; 3],
    g: [f64; 3],
}

const MASSES: [[f64; 3]; 3] = [[3.0, 2.0, 1.0], [2.0, 2.0, 1.0], [1.0, 1.0, 1.0]];
const WEIGHTS: [f64; 3] = [3.0, 2.0, 1.0];
const S: [[f64; 3]; 3] = [[0.6, 0.0, -0.8], [0.0, 0.6, -0.8], [0.48, -0.6, -0.64]];
const DOT_S: [[f64; 3]; 3] = [[0.0, 0.5, 0.0], [0.3, 0.0, 0.0], [0.6, 0.48, 0.0]];

fn listed() -> (Listed, ListedState) {
    let m = MASSES.iter().map(|row| row.to_vec()).collect();
    (Listed { m, g: WEIGHTS.to_vec() }, ListedState { s: S.to_vec(), dot_s: DOT_S.to_vec() })
}

#[test]
fn a_chain_of_any_size_moves_as_one_with_names() -> Outcome {
    for rule in [Quadrature::trapezoid(), Quadrature::midpoint(), Quadrature::simpson()] {
        let method = Geodesic::new(rule);
        let (m, g) = (MASSES, WEIGHTS);
        let start = NamedState {
            s0: S[0],
            s1: S[1],
            s2: S[2],
            dot_s0: DOT_S[0],
            dot_s1: DOT_S[1],
            dot_s2: DOT_S[2],
        };
        let mut named = Integrator::new(Named { m, g }, method, 0.05, start)?;
        let mut fixed = Integrator::new(Fixed { m, g }, method, 0.05, FixedState { s: S, dot_s: DOT_S })?;
        let (system, start) = listed();
        let mut listed = Integrator::new(system, method, 0.05, start)?;
        named.take_steps(50)?;
        fixed.take_steps(50)?;
        listed.take_steps(50)?;
        let NamedState { s0, s1, s2, dot_s0, dot_s1, dot_s2 } = named.state();
        let expected = [s0, s1, s2, dot_s0, dot_s1, dot_s2].concat();
        let fixed = fixed.state();
        let listed = listed.state();
        for found in [
            [fixed.s.as_flattened(), fixed.dot_s.as_flattened()].concat(),
            [listed.s.as_flattened(), listed.dot_s.as_flattened()].concat(),
        ] {
            let difference = apart(&found, &expected);
            assert!(difference < 1e-12, "{rule:?}: {difference:e}");
        }
    }
    Ok(())
}

/// Bodies that turn about their centres, each drawn to the axes of those before it, beside a number.
macro_rules! bodies {
    ($name:ident $(<$constant:ident>)?, $size:expr, $inertia:ty) => {
        #[lagrangian(
            coordinates(x, R[$size]: SO3),
            lagrangian = sum(0..$size, |i| inertia[i][0] * omega(R[i])[0].powi(2) + inertia[i][1] * omega(R[i])[1].powi(2)
                    + inertia[i][2] * omega(R[i])[2].powi(2)) / 2.0 + dot(x).powi(2) / 2.0 - x * x
                - sum_pairs(0..$size, |i, j| pull * R[i].column(0).dot(R[j].column(1)))
                - sum(0..$size, |i| x * R[i][2][2]),
            momenta(vertical = sum(0..$size, |i| inertia[i][0] * omega(R[i])[0] * R[i][2][0]
                + inertia[i][1] * omega(R[i])[1] * R[i][2][1] + inertia[i][2] * omega(R[i])[2] * R[i][2][2])),
            events(upright = R[1][2][2] - 0.5),
        )]
        #[derive(Debug)]
        struct $name$(<const $constant: usize>)? {
            inertia: $inertia,
            pull: f64,
        }
    };
}

bodies!(Bodies<N>, N, [[f64; 3]; N]);
bodies!(ListedBodies, inertia.len(), Vec<[f64; 3]>);

#[lagrangian(
    coordinates(x, R0: SO3, R1: SO3),
    lagrangian = (inertia[0][0] * omega(R0)[0].powi(2) + inertia[0][1] * omega(R0)[1].powi(2) + inertia[0][2] * omega(R0)[2].powi(2)
            + inertia[1][0] * omega(R1)[0].powi(2) + inertia[1][1] * omega(R1)[1].powi(2) + inertia[1][2] * omega(R1)[2].powi(2)) / 2.0
        + dot(x).powi(2) / 2.0 - x * x - pull * R0.column(0).dot(R1.column(1)) - x * R0[2][2] - x * R1[2][2],
)]
#[derive(Debug)]
struct NamedBodies {
    inertia: [[f64; 3]; 2],
    pull: f64,
}

const INERTIA: [[f64; 3]; 2] = [[1.0, 2.0, 2.5], [0.7, 1.0, 0.5]];
const OMEGA: [[f64; 3]; 2] = [[0.3, 0.5, 1.0], [-0.3, 0.2, 1.1]];

fn turned() -> [[f64; 9]; 2] {
    [rotations::exp([0.1, 0.5, 0.3]), rotations::exp([0.7, -0.5, 0.3])]
}

#[test]
fn bodies_of_any_number_move_as_those_with_names() -> Outcome {
    let (R, omega_R, pull) = (turned(), OMEGA, 0.7);
    let (x, dot_x) = (0.4, -0.2);
    for rule in [Quadrature::trapezoid(), Quadrature::midpoint(), Quadrature::simpson()] {
        let method = Geodesic::new(rule);
        let [R0, R1] = R;
        let start = NamedBodiesState { x, R0, R1, dot_x, omega_R0: omega_R[0], omega_R1: omega_R[1] };
        let mut named = Integrator::new(NamedBodies { inertia: INERTIA, pull }, method, 0.05, start)?;
        let start = BodiesState { x, R, dot_x, omega_R };
        let mut fixed = Integrator::new(Bodies { inertia: INERTIA, pull }, method, 0.05, start)?;
        let start = ListedBodiesState { x, R: R.to_vec(), dot_x, omega_R: omega_R.to_vec() };
        let system = ListedBodies { inertia: INERTIA.to_vec(), pull };
        let mut listed = Integrator::new(system, method, 0.05, start)?;
        let vertical = fixed.momentum(0);
        named.take_steps(50)?;
        fixed.take_steps(50)?;
        listed.take_steps(50)?;
        assert_abs_diff_eq!(fixed.momentum(0).unwrap_or(0.0), vertical.unwrap_or(1.0), epsilon = 1e-13);
        let NamedBodiesState { x, R0, R1, dot_x, omega_R0, omega_R1 } = named.state();
        let expected = [&[x, dot_x], &R0[..], &R1, &omega_R0, &omega_R1].concat();
        let (fixed, listed) = (fixed.state(), listed.state());
        for found in [
            [&[fixed.x, fixed.dot_x], fixed.R.as_flattened(), fixed.omega_R.as_flattened()].concat(),
            [&[listed.x, listed.dot_x], listed.R.as_flattened(), listed.omega_R.as_flattened()].concat(),
        ] {
            let difference = apart(&found, &expected);
            assert!(difference < 1e-12, "{rule:?}: {difference:e}");
        }
        assert!(fixed.R.iter().all(|R| rotations::defect(R) < 1e-14));
    }
    Ok(())
}

/// A ring of rotors with the energy J s·s′ of each two neighbours.
#[lagrangian(
    coordinates(s[N]: S2),
    lagrangian = sum(0..N, |i| dot(s[i]).norm_squared() / 2.0 - j * s[i].dot(s[(i + 1) % N])),
)]
#[derive(Debug)]
struct Rotors<const N: usize> {
    j: f64,
}

#[test]
fn entries_have_names_and_places() -> Outcome {
    let (system, start) = listed();
    let names: Vec<String> = system.names().map(|name| name.to_string()).collect();
    assert_eq!((names.len(), &names[4][..], &names[17][..]), (18, "s[1].y", "dot_s[2].z"));
    let values: Vec<f64> = system.values(&start)?.collect();
    assert_eq!(values, [S.as_flattened(), DOT_S.as_flattened()].concat());
    assert!(Listed::REPORT.to_string().contains("  s[g.len()]: S2\n"));

    let bodies = Bodies { inertia: INERTIA, pull: 0.7 };
    let names: Vec<String> = bodies.names().map(|name| name.to_string()).collect();
    assert_eq!((names.len(), &names[10][..], &names[23][..]), (26, "R[1][0]", "omega_R[1].x"));
    let start = BodiesState { x: 0.4, R: turned(), dot_x: -0.2, omega_R: OMEGA };
    let values: Vec<f64> = bodies.values(&start)?.collect();
    let expected = [&[0.4], turned().as_flattened(), &[-0.2], OMEGA.as_flattened()].concat();
    assert_eq!(values, expected);
    assert_eq!(crate::records::read_again(&bodies, &start)?, [start]);
    assert!(Bodies::<2>::REPORT.to_string().contains("  x\n  R[N]: SO3\n"));

    let found = crate::records::bodies(&Recorder::new(&bodies).finish())?;
    assert_eq!(found.len(), 6);
    assert_eq!((&found[4].0[..], found[4].1.join(" ")), ("R[1], axis 2", "R[1][1] R[1][4] R[1][7]".into()));
    let (name, position) = &crate::records::bodies(&Recorder::new(&system).finish())?[2];
    assert_eq!((&name[..], position.join(" ")), ("s[2]", "s[2].x s[2].y s[2].z".into()));
    Ok(())
}

#[test]
fn failures_name_the_entry() {
    let (system, mut start) = listed();
    start.s[1] = [0.0, 0.6, -0.7];
    let error = Integrator::new(&system, Geodesic::trapezoid(), 0.1, start).err();
    let Some(StartError::OffManifold { block: "s", index: Some(1), .. }) = error else {
        panic!("a vector that is too short: {error:?}")
    };
    assert!(error.is_some_and(|error| error.to_string().starts_with("`s[1]` is off by ")));

    let (system, mut start) = listed();
    start.dot_s.pop();
    let error = Integrator::new(&system, Geodesic::trapezoid(), 0.1, start).err();
    assert!(matches!(error, Some(StartError::Length(_))), "{error:?}");

    let mut start = RotorsState { s: [[1.0, 0.0, 0.0]; 4], dot_s: [[0.0; 3]; 4] };
    start.dot_s[2][1] = 40.0;
    let mut run = Integrator::new(Rotors { j: 0.8 }, Geodesic::midpoint(), 0.1, start).expect("begins");
    let error = run.take_steps(1).expect_err("a step of four radians");
    assert!(matches!(error.failure, StepFailure::HalfTurn { block: "s", index: Some(2), .. }), "{error}");
    assert!(error.to_string().contains("`s[2]` would turn by "), "{error}");
}

#[test]
fn runs_go_on_from_checkpoints_and_stop_at_events() -> Outcome {
    let bodies = ListedBodies { inertia: INERTIA.to_vec(), pull: 0.7 };
    let start = || ListedBodiesState { x: 0.4, R: turned().to_vec(), dot_x: -0.2, omega_R: OMEGA.to_vec() };
    let mut run = Integrator::new(&bodies, Geodesic::trapezoid(), 0.05, start())?;
    run.take_steps(50)?;
    let kept = run.checkpoint();
    run.take_steps(50)?;
    let mut resumed = Integrator::resume(&bodies, Geodesic::trapezoid(), &kept)?;
    resumed.take_steps(50)?;
    assert_eq!(resumed.state(), run.state());

    let mut run = Integrator::new(&bodies, Geodesic::trapezoid(), 0.05, start())?;
    let (mut events, mut count) = (run.declared_events([Direction::Either])?, 0);
    while let Some(event) = events.next_until(30.0)? {
        assert_abs_diff_eq!(event.state.R[1][8], 0.5, epsilon = 1e-12);
        assert!(event.state.R.iter().all(|R| rotations::defect(R) < 1e-12));
        count += 1;
    }
    assert!(count > 2, "{count}");
    Ok(())
}
