//! Arrays of rotations and unit vectors: sizes of each kind against single names, what is conserved, and
//! what knows of the entries.

use approx::assert_abs_diff_eq;
use dvi_core::prelude::*;
use dvi_core::record::Recorder;
use dvi_core::rotations;

use dvi_tests::{Outcome, apart};

/// A chain of spherical pendulums, where m_ij are the masses below both joints, times lengths; beside each a
/// body that turns about its centre, is drawn to it and to the axes of the bodies before it; and a number.
macro_rules! turning {
    ($name:ident $(<$constant:ident>)?, $size:expr, $m:ty, $g:ty, $inertia:ty) => {
        #[lagrangian(
            coordinates(x, s[$size]: S2, R[$size]: SO3),
            lagrangian = sum(0..$size, |i| sum(0..$size, |j| m[i][j] * dot(s[i]).dot(dot(s[j])))) / 2.0
                - sum(0..$size, |i| g[i] * s[i][2])
                + sum(0..$size, |i| inertia[i][0] * omega(R[i])[0].powi(2)
                    + inertia[i][1] * omega(R[i])[1].powi(2)
                    + inertia[i][2] * omega(R[i])[2].powi(2)) / 2.0
                + dot(x).powi(2) / 2.0 - x * x
                - sum_pairs(0..$size, |i, j| pull * R[i].column(0).dot(R[j].column(1)))
                - sum(0..$size, |i| x * R[i][2][2] + pull * s[i].dot(R[i].column(2))),
            momenta(vertical = sum(0..$size, |i| sum(0..$size, |j| m[i][j] * s[i].cross(dot(s[j]))))[2]
                + sum(0..$size, |i| inertia[i][0] * omega(R[i])[0] * R[i][2][0]
                    + inertia[i][1] * omega(R[i])[1] * R[i][2][1]
                    + inertia[i][2] * omega(R[i])[2] * R[i][2][2])),
            events(upright = R[1][2][2] - 0.5),
        )]
        #[derive(Debug)]
        struct $name$(<const $constant: usize>)? {
            m: $m,
            g: $g,
            inertia: $inertia,
            pull: f64,
        }
    };
}

turning!(Fixed<N>, N, [[f64; N]; N], [f64; N], [[f64; 3]; N]);
turning!(Listed, g.len(), Vec<Vec<f64>>, Vec<f64>, Vec<[f64; 3]>);

/// Two of them by name.
#[lagrangian(
    coordinates(x, s0: S2, s1: S2, R0: SO3, R1: SO3),
    lagrangian = (m[0][0] * dot(s0).norm_squared() + m[1][1] * dot(s1).norm_squared()) / 2.0
        + m[0][1] * dot(s0).dot(dot(s1))
        - g[0] * s0[2] - g[1] * s1[2]
        + (inertia[0][0] * omega(R0)[0].powi(2) + inertia[0][1] * omega(R0)[1].powi(2)
            + inertia[0][2] * omega(R0)[2].powi(2) + inertia[1][0] * omega(R1)[0].powi(2)
            + inertia[1][1] * omega(R1)[1].powi(2) + inertia[1][2] * omega(R1)[2].powi(2)) / 2.0
        + dot(x).powi(2) / 2.0 - x * x - x * R0[2][2] - x * R1[2][2]
        - pull * (R0.column(0).dot(R1.column(1)) + s0.dot(R0.column(2)) + s1.dot(R1.column(2))),
)]
#[derive(Debug)]
struct Named {
    m: [[f64; 2]; 2],
    g: [f64; 2],
    inertia: [[f64; 3]; 2],
    pull: f64,
}

const M: [[f64; 2]; 2] = [[3.0, 1.0], [1.0, 1.0]];
const G: [f64; 2] = [3.0, 1.0];
const INERTIA: [[f64; 3]; 2] = [[1.0, 2.0, 2.5], [0.7, 1.0, 0.5]];
const PULL: f64 = 0.7;
const FIXED: Fixed<2> = Fixed { m: M, g: G, inertia: INERTIA, pull: PULL };

fn start() -> FixedState<2> {
    FixedState {
        x: 0.4,
        s: [[0.6, 0.0, -0.8], [0.0, 0.6, -0.8]],
        R: [rotations::exp([0.1, 0.5, 0.3]), rotations::exp([0.7, -0.5, 0.3])],
        dot_x: -0.2,
        dot_s: [[0.0, 0.5, 0.0], [0.3, 0.0, 0.0]],
        omega_R: [[0.3, 0.5, 1.0], [-0.3, 0.2, 1.1]],
    }
}

fn listed() -> (Listed, ListedState) {
    let FixedState { x, s, R, dot_x, dot_s, omega_R } = start();
    let system = Listed { m: M.map(Vec::from).into(), g: G.into(), inertia: INERTIA.into(), pull: PULL };
    let [s, dot_s, omega_R] = [s, dot_s, omega_R].map(Vec::from);
    (system, ListedState { x, s, R: R.into(), dot_x, dot_s, omega_R })
}

/// By a method that is one type for all rules.
fn trapezoid() -> Geodesic<Quadrature> {
    Geodesic::new(Quadrature::trapezoid())
}

/// The entries of the state after some steps, which keep the momentum that is declared.
fn moved<S: ManifoldLagrangian>(system: &S, rule: Quadrature, start: S::State<f64>) -> Outcome<Vec<f64>> {
    let mut run = Integrator::new(system, Geodesic::new(rule), 0.05, start)?;
    let before = run.momentum(0);
    run.take_steps(50)?;
    assert_abs_diff_eq!(run.momentum(0).unwrap_or(0.0), before.unwrap_or(0.0), epsilon = 1e-13);
    Ok(system.values(&run.state())?.collect())
}

#[test]
fn arrays_of_any_size_move_as_single_names() -> Outcome {
    let FixedState { x, s: [s0, s1], R: [R0, R1], dot_x, dot_s: [dot_s0, dot_s1], omega_R } = start();
    let [omega_R0, omega_R1] = omega_R;
    let begin = NamedState { x, s0, s1, R0, R1, dot_x, dot_s0, dot_s1, omega_R0, omega_R1 };
    let named = Named { m: M, g: G, inertia: INERTIA, pull: PULL };
    let (system, list) = listed();
    for rule in [Quadrature::trapezoid(), Quadrature::midpoint(), Quadrature::simpson()] {
        let expected = moved(&named, rule, begin)?;
        for found in [moved(&FIXED, rule, start())?, moved(&system, rule, list.clone())?] {
            let difference = apart(&found, &expected);
            assert!(difference < 1e-12, "{rule:?}: {difference:e}");
            // Two rotations behind a number and two unit vectors.
            let is_rotation =
                |entries: &[f64]| entries.try_into().is_ok_and(|R: [f64; 9]| rotations::defect(&R) < 1e-14);
            assert!(found[7..25].chunks(9).all(is_rotation), "{rule:?}: {found:?}");
        }
    }
    Ok(())
}

#[test]
fn entries_have_names_and_places() -> Outcome {
    let FixedState { x, s, R, dot_x, dot_s, omega_R } = start();
    let names: Vec<String> = FIXED.names().map(|name| name.to_string()).collect();
    let found = [5, 16, 31, 35].map(|place| &names[place][..]);
    assert_eq!((names.len(), found), (38, ["s[1].y", "R[1][0]", "dot_s[1].z", "omega_R[1].x"]));
    let values: Vec<f64> = FIXED.values(&start())?.collect();
    let [s, dot_s, omega_R] = [s, dot_s, omega_R].map(|vectors| vectors.concat());
    assert_eq!(values, [&[x], &s[..], R.as_flattened(), &[dot_x], &dot_s, &omega_R].concat());
    let (system, list) = listed();
    assert!(system.names().map(|name| name.to_string()).eq(names));
    assert_eq!(system.values(&list)?.collect::<Vec<f64>>(), values);
    assert_eq!(crate::records::read_again(&FIXED, &start())?, [start()]);
    assert!(Fixed::<2>::REPORT.to_string().contains("  x\n  s[N]: S2\n  R[N]: SO3\n"));
    assert!(Listed::REPORT.to_string().contains("  s[g.len()]: S2\n"));

    let found = crate::records::bodies(&Recorder::new(&system).finish())?;
    assert_eq!(found.len(), 8);
    assert_eq!((&found[1].0[..], found[1].1.join(" ")), ("s[1]", "s[1].x s[1].y s[1].z".into()));
    assert_eq!((&found[6].0[..], found[6].1.join(" ")), ("R[1], axis 2", "R[1][1] R[1][4] R[1][7]".into()));
    Ok(())
}

#[test]
fn failures_name_the_entry() {
    let (system, mut start) = listed();
    start.s[1] = [0.0, 0.6, -0.7];
    let error = Integrator::new(&system, trapezoid(), 0.1, start).err();
    let Some(StartError::OffManifold { block: "s", index: Some(1), .. }) = error else {
        panic!("a vector that is too short: {error:?}")
    };
    assert!(error.is_some_and(|error| error.to_string().starts_with("`s[1]` is off by ")));

    let (_, mut start) = listed();
    start.dot_s.pop();
    let error = Integrator::new(&system, trapezoid(), 0.1, start).err();
    assert!(matches!(error, Some(StartError::Length(_))), "{error:?}");

    let (_, mut start) = listed();
    start.dot_s[1] = [40.0, 0.0, 0.0];
    let mut run = Integrator::new(&system, trapezoid(), 0.1, start).expect("begins");
    let error = run.take_steps(1).expect_err("a step of four radians");
    assert!(matches!(error.failure, StepFailure::HalfTurn { block: "s", index: Some(1), .. }), "{error}");
    assert!(error.to_string().contains("`s[1]` would turn by "), "{error}");
}

#[test]
fn runs_go_on_from_checkpoints_and_stop_at_events() -> Outcome {
    let (system, start) = listed();
    let mut run = Integrator::new(&system, trapezoid(), 0.05, start.clone())?;
    run.take_steps(50)?;
    let kept = run.checkpoint();
    run.take_steps(50)?;
    let mut resumed = Integrator::resume(&system, trapezoid(), &kept)?;
    resumed.take_steps(50)?;
    assert_eq!(resumed.state(), run.state());

    let mut run = Integrator::new(&system, trapezoid(), 0.05, start)?;
    let (mut events, mut count) = (run.declared_events([Direction::Either])?, 0);
    while let Some(event) = events.next_until(30.0)? {
        assert_abs_diff_eq!(event.state.R[1][8], 0.5, epsilon = 1e-12);
        assert!(event.state.R.iter().all(|R| rotations::defect(R) < 1e-12));
        count += 1;
    }
    assert!(count > 2, "{count}");
    Ok(())
}
