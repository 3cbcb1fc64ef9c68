//! What a system says at one state: names and entries, rates of change, energy and Lagrangian, against the
//! equations of motion put together from hyper-dual evaluations of L alone.

use approx::{abs_diff_eq, assert_abs_diff_eq};
use dvi_core::mechanics::Rates;
use dvi_core::prelude::*;
use dvi_core::{Scalar, Space};
use dvi_tests::Outcome;
use dvi_tests::configurations::quasi_periodic;
use dvi_tests::systems::*;
use dvi_tests::zoo::regular::*;
use nalgebra::{DMatrix, DVector};
use num_dual::HyperDual64;

/// L(q, v, t) and its derivatives by the arguments `first` and `second`, counted through q, v and t:
/// [L, ∂₁L, ∂₂L, ∂₁∂₂L].
fn derivatives<S: Lagrangian<HyperDual64>>(
    system: &S,
    [q, v]: [&[f64]; 2],
    t: f64,
    [first, second]: [usize; 2],
) -> [f64; 4] {
    let arguments = q.iter().chain(v).chain([&t]).enumerate().map(|(k, &x)| {
        let seed = |along: usize| if k == along { 1.0 } else { 0.0 };
        HyperDual64::new(x, seed(first), seed(second), 0.0)
    });
    let arguments: Vec<HyperDual64> = arguments.collect();
    let (q, rest) = arguments.split_at(q.len());
    let value = system.lagrangian(q, &rest[..v.len()], rest[v.len()]);
    [value.re, value.eps1, value.eps2, value.eps1eps2]
}

/// The acceleration from ∂²L/∂v∂v a = ∂L/∂q − ∂²L/∂v∂q v − ∂²L/∂v∂t.
fn acceleration<S: Lagrangian<HyperDual64>>(system: &S, [q, v]: [&[f64]; 2], t: f64) -> DVector<f64> {
    let n = q.len();
    let second = |i: usize, j: usize| derivatives(system, [q, v], t, [i, j])[3];
    let mass = DMatrix::from_fn(n, n, |i, j| second(n + i, n + j));
    let right = DVector::from_fn(n, |i, _| {
        let transport: f64 = (0..n).map(|j| second(n + i, j) * v[j]).sum();
        derivatives(system, [q, v], t, [i, i])[1] - transport - second(n + i, 2 * n)
    });
    mass.lu().solve(&right).unwrap_or_else(|| DVector::repeat(n, f64::NAN))
}

/// The entries of a state.
fn entries<S: System>(system: &S, state: &S::State<f64>) -> Result<Vec<f64>, dvi_core::LengthError> {
    Ok(system.values(state)?.collect())
}

fn check_regular<S: Lagrangian<HyperDual64> + AtState + System<Kind: Rates<S, f64>>>(
    system: &S,
    state: S::State<f64>,
) -> Outcome {
    let name = S::REPORT.system;
    let n = system.space().dimension();
    let point = entries(system, &state)?;
    assert_eq!(system.names().count(), 2 * n);
    assert_eq!(point.len(), 2 * n);
    for t in [0.0, 0.7] {
        let (q, v) = point.split_at(n);
        let rates = entries(system, &system.at_time(t).vector_field(&state)?)?;
        assert_eq!(&rates[..n], v, "{name}");
        let expected = acceleration(system, [q, v], t);
        let off = (DVector::from_column_slice(&rates[n..]) - &expected).amax();
        assert!(off <= 1e-12 * (1.0 + expected.amax()), "{name} at {t}: {rates:?}, not {expected}");
        let [value, ..] = derivatives(system, [q, v], t, [0, 0]);
        let energy: f64 =
            (0..n).map(|i| v[i] * derivatives(system, [q, v], t, [n + i, 0])[1]).sum::<f64>() - value;
        let found = [system.at_time(t).lagrangian(&state)?, system.at_time(t).energy(&state)?];
        for (found, expected) in found.into_iter().zip([value, energy]) {
            assert!(
                abs_diff_eq!(found, expected, epsilon = 1e-12 * (1.0 + expected.abs())),
                "{name} at {t}: {found}"
            );
        }
    }
    assert_eq!(system.energy_at(&state)?, system.at_time(0.0).energy(&state)?);
    Ok(())
}

#[test]
fn rates_of_regular_systems() -> Outcome {
    check_regular(&Kepler { mu: 1.3 }, KeplerState { x: 0.7, y: 0.2, dot_x: 0.3, dot_y: 1.1 })?;
    let pendulum = DoublePendulum { mass: [1.0, 0.7], length: [0.9, 1.2], g: 9.81 };
    check_regular(&pendulum, DoublePendulumState { a: 1.1, b: -0.4, dot_a: 0.8, dot_b: 2.1 })?;
    check_regular(&Relativistic { m: 1.5 }, RelativisticState { x: 0.3, y: -1.1, dot_x: 0.6, dot_y: -0.5 })?;
    check_regular(
        &DrivenOscillator { depth: 0.3, omega: 1.7 },
        DrivenOscillatorState { x: 0.8, dot_x: 0.3 },
    )?;
    check_regular(&GrowingMass {}, GrowingMassState { x: 0.8, y: 0.4, dot_x: 0.3, dot_y: -0.9 })?;
    let magnetic = MagneticParticleState { x: 0.3, y: -0.2, z: 0.5, dot_x: 1.0, dot_y: 0.4, dot_z: -0.8 };
    check_regular(&MagneticParticle { m: 1.2, b: 2.0 }, magnetic)?;
    let tangled = TangledState { x: [0.3, -0.5, 0.8], u: 0.4, dot_x: [0.2, 0.9, -0.3], dot_u: 0.6 };
    check_regular(&Tangled { g: 0.2 }, tangled)?;
    let chain = RunTimeChain { mass: vec![1.0, 2.0, 3.0], coupling: 0.125 };
    let state =
        RunTimeChainState { q: vec![0.1, 0.5, -0.2], wall: 0.3, dot_q: vec![0.3, 0.1, -0.4], dot_wall: 0.2 };
    check_regular(&chain, state)
}

/// Ω q' = ∇H from hyper-dual evaluations of L = α·v − H.
#[test]
fn rates_of_degenerate_systems() -> Outcome {
    fn check<S: Lagrangian<HyperDual64> + AtState + System<Kind: Rates<S, f64>>>(
        system: &S,
        state: S::State<f64>,
    ) -> Outcome {
        let q = entries(system, &state)?;
        let n = q.len();
        assert_eq!(system.names().count(), n);
        let rest = vec![0.0; n];
        let second = |i: usize, j: usize| derivatives(system, [&q, &rest], 0.0, [i, j])[3];
        // ∂αⱼ/∂qⁱ − ∂αᵢ/∂qʲ
        let omega = DMatrix::from_fn(n, n, |i, j| second(n + j, i) - second(n + i, j));
        let gradient = DVector::from_fn(n, |i, _| -derivatives(system, [&q, &rest], 0.0, [i, i])[1]);
        let expected = omega.lu().solve(&gradient).ok_or("singular")?;
        let found = entries(system, &system.vector_field(&state)?)?;
        let off = (DVector::from_column_slice(&found) - &expected).amax();
        assert!(off <= 1e-12 * (1.0 + expected.amax()), "{}: {found:?}, not {expected}", S::REPORT.system);
        let energy = -derivatives(system, [&q, &rest], 0.0, [0, 0])[0];
        assert_abs_diff_eq!(system.energy_at(&state)?, energy, epsilon = 1e-13);
        let along = derivatives(system, [&q, &found], 0.0, [0, 0])[0];
        assert_abs_diff_eq!(system.lagrangian_at(&state)?, along, epsilon = 1e-12);
        Ok(())
    }
    let (vortices, start) = quasi_periodic();
    check(&vortices, start)?;
    check(&LotkaVolterra { a: [1.0, 1.0], b: [-1.0, -2.0] }, LotkaVolterraState { x: 1.2, y: 0.7 })?;
    check(&Curved { kappa: 0.3 }, CurvedState { x: 0.4, y: 0.1 })?;
    let many = ManyVortices { gamma: vortices.gamma.to_vec() };
    check(&many, ManyVorticesState { x: start.x.to_vec(), y: start.y.to_vec() })
}

#[test]
fn entries_have_flat_names() -> Outcome {
    let names = |names: &mut dyn Iterator<Item = dvi_core::system::Name>| -> Vec<String> {
        names.map(|name| name.to_string()).collect()
    };
    let (vortices, start) = quasi_periodic();
    assert_eq!(
        names(&mut vortices.names()),
        ["x[0]", "x[1]", "x[2]", "x[3]", "y[0]", "y[1]", "y[2]", "y[3]"]
    );
    assert_eq!(entries(&vortices, &start)?, [start.x, start.y].concat());
    let chain = RunTimeChain { mass: vec![1.0, 2.0], coupling: 0.125 };
    assert_eq!(names(&mut chain.names()), ["q[0]", "q[1]", "wall", "dot_q[0]", "dot_q[1]", "dot_wall"]);
    let state = RunTimeChainState { q: vec![1.0, 2.0], wall: 3.0, dot_q: vec![4.0, 5.0], dot_wall: 6.0 };
    assert_eq!(entries(&chain, &state)?, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
    #[lagrangian(
        coordinates(r#type, r#fn[2]),
        lagrangian = dot(r#type).powi(2) + dot(r#fn[0]).powi(2) + dot(r#fn[1]).powi(2),
        momenta(r#impl = dot(r#type)),
    )]
    struct Raw;
    assert_eq!(names(&mut Raw.names()), ["type", "fn[0]", "fn[1]", "dot_type", "dot_fn[0]", "dot_fn[1]"]);
    assert_eq!(Raw::REPORT.momenta, ["impl"]);
    let short = RunTimeChainState { q: vec![1.0], ..state };
    assert!(chain.values(&short).is_err());
    Ok(())
}

#[test]
fn states_without_an_answer_are_errors() {
    let origin = KeplerState { x: 0.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 };
    let kepler = Kepler { mu: 1.0 };
    assert!(matches!(kepler.vector_field(&origin), Err(StartError::Undefined { .. })));
    assert!(matches!(kepler.energy_at(&origin), Err(StartError::Undefined { .. })));
    let nowhere = KeplerState { x: f64::NAN, ..origin };
    assert!(matches!(kepler.lagrangian_at(&nowhere), Err(StartError::NotFinite { .. })));
    // The form of the sphere, z dφ, is regular; one that is zero at a point is not.
    let singular = Curved { kappa: -1.0 / 3.0 };
    let at = CurvedState { x: 1.0, y: 1.0 };
    assert!(matches!(singular.vector_field(&at), Err(StartError::Singular { matrix: "Ω = −dα", .. })));
    assert!(singular.energy_at(&at).is_ok());
}

/// An array of const-generic size beside single coordinates and an array of literal size.
#[lagrangian(
    coordinates(x[N], w, z[2]),
    lagrangian = sum(0..N, |j| dot(x[j]).powi(2)) / 2.0 + mass * dot(w).powi(2) / 2.0
        + (dot(z[0]).powi(2) + dot(z[1]).powi(2) + dot(z[0]) * dot(x[N - 1])) / 2.0
        - sum(0..N, |j| (x[j] - w).powi(4)) / 4.0 - (z[0] - x[0]).powi(2) - z[1].cosh() - w * z[1],
)]
struct Beside<const N: usize> {
    mass: f64,
}

/// The same with all sizes known at run time only.
#[lagrangian(
    coordinates(x[n], w, z[2]),
    lagrangian = sum(0..n, |j| dot(x[j]).powi(2)) / 2.0 + mass * dot(w).powi(2) / 2.0
        + (dot(z[0]).powi(2) + dot(z[1]).powi(2) + dot(z[0]) * dot(x[n - 1])) / 2.0
        - sum(0..n, |j| (x[j] - w).powi(4)) / 4.0 - (z[0] - x[0]).powi(2) - z[1].cosh() - w * z[1],
)]
struct AtRunTime {
    n: usize,
    mass: f64,
}

/// A state of `Beside` lives on the stack, is `Copy`, and goes where that of the run-time system goes.
#[test]
fn single_coordinates_stand_beside_arrays_of_const_generic_size() -> Outcome {
    fn check<const N: usize>() -> Outcome {
        let (system, same) = (Beside::<N> { mass: 2.0 }, AtRunTime { n: N, mass: 2.0 });
        let x: [f64; N] = core::array::from_fn(|j| 0.3 * j as f64 - 0.2);
        let dot_x: [f64; N] = core::array::from_fn(|j| 0.5 - 0.1 * j as f64);
        let (z, dot_z) = ([0.4, -0.3], [0.2, 0.6]);
        let start = BesideState { x, w: 0.1, z, dot_x, dot_w: -0.7, dot_z };
        let twin = AtRunTimeState { x: x.to_vec(), w: 0.1, z, dot_x: dot_x.to_vec(), dot_w: -0.7, dot_z };
        assert_eq!(system.space().dimension(), N + 3);
        let (kept, moved) = (start, start);
        assert_eq!(kept, moved);
        check_regular(&system, start)?;
        macro_rules! agree {
            ($($method:expr),+ $(,)?) => {$(
                let mut run = Integrator::new(&system, $method, 0.05, start)?;
                let mut other = Integrator::new(&same, $method, 0.05, twin.clone())?;
                run.take_steps(50)?;
                other.take_steps(50)?;
                for (a, b) in run.q().iter().zip(other.q()) {
                    assert!(abs_diff_eq!(a, b, epsilon = 1e-12), "{}, N = {N}: {a} and {b}", stringify!($method));
                }
            )+};
        }
        agree!(
            Variational::trapezoid(),
            Variational { solver: Solver::Newton, ..Variational::midpoint() },
            Galerkin { solver: Solver::Newton, ..Galerkin::<3>::new() },
            Gauss::<2>::new(),
            RungeKutta::classical(),
        );
        Ok(())
    }
    check::<1>()?;
    check::<2>()?;
    check::<5>()
}

/// What is lifted is a number of the arithmetic in question.
#[test]
fn values_come_in_any_numbers() -> Outcome {
    let state = KeplerStateOf::<HyperDual64> {
        x: HyperDual64::lift(1.0),
        y: HyperDual64::lift(2.0),
        dot_x: HyperDual64::lift(3.0),
        dot_y: HyperDual64::lift(4.0),
    };
    let values: Vec<f64> = Kepler { mu: 1.0 }.values(&state)?.map(|value| value.re).collect();
    assert_eq!(values, [1.0, 2.0, 3.0, 4.0]);
    Ok(())
}

/// A literal is a state of `f64`, whose numbers have methods without a type written anywhere, and is printed
/// by the name that it was written with; other numbers are asked for by the second name.
#[test]
fn states_are_of_f64_unless_another_name_is_written() {
    let start = KeplerState { x: -0.5, y: 0.0, dot_x: 0.0, dot_y: 1.0 };
    assert_eq!(start.x.abs().sqrt(), 0.5_f64.sqrt());
    assert_eq!(format!("{start:?}"), "KeplerState { x: -0.5, y: 0.0, dot_x: 0.0, dot_y: 1.0 }");
    let narrow = KeplerStateOf { x: -0.5_f32, y: 0.0, dot_x: 0.0, dot_y: 1.0 };
    assert_eq!(Kepler { mu: 1.0 }.energy_at(&narrow).ok(), Some(-1.5_f32));
    assert_eq!(Kepler { mu: 1.0 }.energy_at(&start).ok(), Some(-1.5));
}
