//! What cannot begin is refused, by the name of what is wrong.

use dvi_core::prelude::*;
use dvi_core::{IndexError, LengthError};
use dvi_tests::configurations::quasi_periodic;
use dvi_tests::refused_option;
use dvi_tests::systems::*;
use dvi_tests::zoo::regular::{Kepler, KeplerState};

use super::Outcome;

#[test]
fn a_step_that_is_none_or_too_short_or_too_long_is_refused() -> Outcome {
    fn refused<S: Lagrangian, M: dvi_core::methods::Method<S, f64>>(
        system: &S,
        method: impl Fn() -> M,
        start: S::State<f64>,
    ) -> Outcome {
        let none = [0.0, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
        // 1/h overflows for the first three; so does the time, for the others: in a step that is among the
        // first 2⁶³.
        for h in [5e-324, 1e-310, -2e-308, 2e289, 1e300, f64::MAX, -f64::MAX].into_iter().chain(none) {
            let Some(StartError::Step { h: found }) =
                Integrator::new(system, method(), h, start.clone()).err()
            else {
                return Err(format!("{h:e} is no error").into());
            };
            assert_eq!(found.to_bits(), h.to_bits());
        }
        // The next number after 2⁵³ = 9.007e15 is larger by 2; a half of that is rounded away.
        let found = Integrator::new_at(system, method(), 2.0_f64.powi(53), 1.0, start.clone()).err();
        assert_eq!(found, Some(StartError::Step { h: 1.0 }));
        for (t, h) in [(0.0, 2.3e-308), (0.0, -1e289), (2.0_f64.powi(53), 4.0), (1e-300, 1e-300)] {
            let run = Integrator::new_at(system, method(), t, h, start.clone());
            // Steps that are too long for the method may fail; they are none that no step could have.
            assert!(!matches!(run, Err(StartError::Step { .. })), "{h:e}");
            let Ok(mut run) = run else { continue };
            let taken = run.take_steps(3);
            assert!(taken.is_ok() || h.abs() > 1.0, "{h:e}: {taken:?}");
            assert!(run.time().is_finite() && run.q().iter().all(|q| q.is_finite()), "{h:e}");
        }
        Ok(())
    }
    let start = KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 };
    refused(&Kepler { mu: 1.0 }, Variational::midpoint, start)?;
    refused(&Kepler { mu: 1.0 }, Variational::trapezoid, start)?;
    refused(&Kepler { mu: 1.0 }, Gauss::<2>::new, start)?;
    let (vortices, start) = quasi_periodic();
    refused(&vortices, Sigma::midpoint, start)?;
    refused(&vortices, Sigma::leapfrog, start)
}

#[test]
fn a_step_control_does_not_begin_with_a_step_that_is_too_short() {
    let start = KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 };
    for h in [0.0, 1e-310, f64::NAN, f64::INFINITY] {
        let control = ErrorControl::new(1e-9, h);
        let found = Integrator::controlled(&Kepler { mu: 1.0 }, Gauss::<2>::new(), control, start).err();
        assert!(matches!(found, Some(StartError::Step { h: found }) if found.to_bits() == h.to_bits()));
    }
    // ρ = 1 at the start: its steps have the length ε, in which no number has all digits.
    let control = Reversible::power(1e-310, 1.5);
    let run = Integrator::controlled(&Kepler { mu: 1.0 }, Variational::midpoint(), control, start);
    let found = run.map(|mut run| run.advance().map_err(|error| error.failure));
    assert!(matches!(found, Ok(Err(StepFailure::StepLength { h })) if h == 1e-310), "{found:?}");
}

#[test]
fn what_has_no_mass_or_no_circulation_is_refused_by_its_name() {
    #[lagrangian(
        coordinates(x, z[3]),
        lagrangian = dot(x).powi(2) / 2.0 + sum(0..3, |j| m[j] * dot(z[j]).powi(2) / 2.0 - z[j].powi(2)),
    )]
    struct Bodies {
        m: [f64; 3],
    }
    #[lagrangian(coordinates(x), lagrangian = (x * dot(x)).powi(2) / 2.0 - x)]
    struct Rising;
    fn named<S: Lagrangian, M: dvi_core::methods::Method<S, f64>>(
        (system, start, matrix, name): (&S, S::State<f64>, &'static str, &str),
        method: M,
    ) {
        let found = Integrator::new(system, method, 0.1, start).err();
        let Some(StartError::Singular { matrix: found, entry, size: 0.0 }) = found else {
            panic!("{found:?}")
        };
        assert_eq!((found, &*entry.to_string()), (matrix, name));
    }
    let start = BodiesState { x: 1.0, z: [0.5; 3], dot_x: 0.0, dot_z: [0.1; 3] };
    let bodies = Bodies { m: [1.0, 0.0, 2.0] };
    let of_bodies = (&bodies, start, "the mass matrix", "z[1]");
    named(of_bodies, Variational::midpoint());
    named(of_bodies, Variational::trapezoid());
    named(of_bodies, Galerkin::<3>::new());
    named(of_bodies, Gauss::<2>::new());
    named(of_bodies, RungeKutta::classical());
    for dot_x in [0.0, 1.0] {
        let of_rising = (&Rising, RisingState { x: 0.0, dot_x }, "the mass matrix", "x");
        named(of_rising, Variational::midpoint());
        named(of_rising, Variational::trapezoid());
        named(of_rising, Galerkin::<3>::new());
    }
    let vortices = PointVortices { gamma: [1.0, 1.0, 0.0] };
    let collinear = PointVorticesState { x: [0.5, 0.0, -1.0], y: [0.25, 0.0, 0.0] };
    let of_vortices = (&vortices, collinear, "Ω = −dα", "x[2]");
    // `Sigma::leapfrog` says so too, and does not advise `Sigma::midpoint`, which fails.
    for sigma in [0.0, 0.3, 0.5, 1.0] {
        named(of_vortices, Sigma::new(sigma));
    }
    named(of_vortices, Gauss::<2>::new());
    named(of_vortices, RungeKutta::classical());
    named(of_vortices, Projected::symmetric());
    let start = SphereFormState { phi: 0.4, z: 0.3 };
    named((&SphereForm { gamma: 0.0 }, start, "Ω = −dα", "phi"), OneStep::midpoint());
    let message = vortices.vector_field(0.0, &collinear).err().map(|error| error.to_string());
    let expected = "Ω = −dα is singular at the initial state: its row for `x[2]` has the size 0e0, so that \
                    nothing determines the motion of this coordinate";
    assert_eq!(message.as_deref(), Some(expected));
}

#[test]
fn a_start_that_is_not_finite_is_refused() {
    let (system, mut start) = quasi_periodic();
    start.y[1] = f64::NAN;
    let error = Integrator::new(&system, Sigma::midpoint(), 0.1, start).err();
    assert!(
        matches!(error, Some(StartError::NotFinite { entry, value }) if value.is_nan() && entry.to_string() == "y[1]")
    );
    start.y[1] = f64::INFINITY;
    let error = Integrator::new(&system, RungeKutta::classical(), 0.1, start).err();
    let message = error.map(|error| error.to_string());
    assert_eq!(message.as_deref(), Some("y[1] = inf in the state"));
    let error = Integrator::new_at(&system, Sigma::midpoint(), f64::INFINITY, 0.1, quasi_periodic().1).err();
    assert_eq!(error, Some(StartError::Parameter { name: "t", value: f64::INFINITY, range: "finite" }));
}

#[test]
fn options_out_of_range_are_refused() {
    let (system, start) = quasi_periodic();
    for sigma in [-0.1, 1.1, f64::NAN] {
        assert_eq!(refused_option(Integrator::new(&system, Sigma::new(sigma), 0.1, start)), "sigma");
    }
    let (kepler, planet) = (Kepler { mu: 1.0 }, KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 1.0 });
    for beta in [-0.1, 0.6, f64::NAN] {
        assert_eq!(refused_option(Integrator::new(&kepler, Newmark::new(beta), 0.1, planet)), "beta");
    }
    for limit in [0.0, -1.0, f64::NAN] {
        let limited = EnergyLimit { method: Variational::trapezoid(), limit };
        assert_eq!(refused_option(Integrator::new(&kepler, limited, 0.01, planet)), "limit");
    }
    for sigma in [0.0, 1.0] {
        let method = Sigma { summation: Summation::Compensated, ..Sigma::new(sigma) };
        assert_eq!(refused_option(Integrator::new(&system, method, 0.1, start)), "Summation::Compensated");
    }
    for (tolerance, max_iterations, name) in
        [(-1.0, 10, "tolerance"), (f64::NAN, 10, "tolerance"), (1e-10, 0, "max_iterations")]
    {
        let stopping = Stopping { tolerance, max_iterations };
        let (sigma, gauss) =
            (Sigma { stopping, ..Sigma::midpoint() }, Gauss { stopping, ..Gauss::<2>::new() });
        assert_eq!(refused_option(Integrator::new(&system, sigma, 0.1, start)), name);
        assert_eq!(refused_option(Integrator::new(&system, gauss, 0.1, start)), name);
    }
}

#[test]
fn a_state_of_the_wrong_length_is_refused() {
    let system = ManyVortices { gamma: vec![1.0; 3] };
    for (x, y, array, found) in [(2, 3, "x", 2), (3, 4, "y", 4)] {
        let start = ManyVorticesState { x: vec![0.5; x], y: vec![0.5; y] };
        let error = Integrator::new(&system, Sigma::midpoint(), 0.1, start).err();
        assert_eq!(error, Some(StartError::Length(LengthError { array, row: None, expected: 3, found })));
    }
}

#[test]
fn index_errors_of_a_system_end_in_the_start_error() {
    let inner = IndexError { array: "gamma", index: -1, len: 3 };
    assert_eq!(StartError::from(inner), StartError::Index(inner));
}

#[test]
fn a_start_in_a_collision_is_refused_by_every_method() {
    let system = PointVortices { gamma: [1.0; 3] };
    let start = PointVorticesState { x: [0.5, 0.5, -1.0], y: [0.25, 0.25, 0.0] };
    // The gradient of ln r at r = 0.
    let expected = |error: Option<StartError>| {
        let quantity = "the gradient of H";
        matches!(error, Some(StartError::Undefined { quantity: found, coordinate: Some(x), value })
            if found == quantity && x.to_string() == "x[0]" && value.is_nan())
    };
    for solver in [Solver::Automatic, Solver::FixedPoint, Solver::Newton] {
        let run = Integrator::new(&system, Sigma { solver, ..Sigma::midpoint() }, 0.1, start);
        assert!(expected(run.err()), "{solver:?}");
    }
    for sigma in [0.0, 0.3, 1.0] {
        assert!(expected(Integrator::new(&system, Sigma::new(sigma), 0.1, start).err()));
    }
    assert!(expected(Integrator::new(&system, RungeKutta::classical(), 0.1, start).err()));
    assert!(expected(Integrator::new(&system, Gauss::<2>::new(), 0.1, start).err()));
}

#[test]
fn a_form_that_is_not_antisymmetric_goes_with_one_half_alone() {
    fn check<S: DegenerateLagrangian>(system: &S, start: S::State<f64>) {
        for sigma in [0.0, 0.3, 1.0] {
            let error = Integrator::new(system, Sigma::new(sigma), 0.1, start.clone()).err();
            let Some(StartError::Unsupported { option: "a sigma that is not 1/2", reason }) = error else {
                panic!("sigma = {sigma}: {error:?}")
            };
            assert!(reason.contains("OneStep"), "{reason}");
        }
        assert!(Integrator::new(system, Sigma::midpoint(), 0.1, start).is_ok());
    }
    check(&SphereForm { gamma: 1.0 }, SphereFormState { phi: 0.4, z: 0.3 });
    check(&Oblique, ObliqueState { x: 0.8, y: 0.3 });
    check(&Curved { kappa: 0.3 }, CurvedState { x: 0.8, y: 0.3 });
}

/// Its gradient exists where its value does not.
#[dvi_core::degenerate_lagrangian(
    coordinates(x, y),
    one_form    = (x * d(y) - y * d(x)) / 2.0,
    hamiltonian = x.ln() + y * y / 2.0,
)]
#[derive(Clone, Debug)]
struct Bounded;

#[test]
fn parameters_that_are_not_numbers_are_refused_and_so_are_starts_outside_of_the_domain() {
    let (mut system, start) = quasi_periodic();
    system.gamma[2] = f64::NAN;
    let error = Integrator::new(&system, Sigma::midpoint(), 0.1, start).err();
    let message = error.map(|error| error.to_string()).unwrap_or_default();
    assert!(message.starts_with("the one-form α along `x[2]` is NaN at the initial state: "), "{message}");
    let prey = LotkaVolterra { a: [1.0, f64::INFINITY], b: [-1.0, -2.0] };
    let inside = LotkaVolterraState { x: 1.3, y: 1.6 };
    let error = Integrator::new(&prey, Gauss::<1>::new(), 0.1, inside).err();
    let message = error.map(|error| error.to_string()).unwrap_or_default();
    assert!(message.starts_with("the gradient of H along `y` is -inf at"), "{message}");
    // α has no logarithm; H alone has none.
    let prey = LotkaVolterra { a: [1.0, 1.0], b: [-1.0, -2.0] };
    let outside = LotkaVolterraState { x: -1.3, y: 1.6 };
    let error = Integrator::new(&prey, Sigma::midpoint(), 0.1, outside).err();
    assert!(
        matches!(error, Some(StartError::Undefined { quantity: "the one-form α", coordinate: Some(y), .. })
            if y.to_string() == "y"),
        "{error:?}"
    );
    let error = Integrator::new(&Bounded, Sigma::midpoint(), 0.1, BoundedState { x: -1.0, y: 0.5 }).err();
    let Some(StartError::Undefined { quantity: "the Hamiltonian", coordinate: None, value }) = error else {
        panic!("{error:?}")
    };
    assert!(value.is_nan());
}
