//! A mass matrix that becomes singular ends a run: no step goes over to the other side. Masses and two-forms
//! of a lower rank are refused in any units.

use dvi_core::prelude::*;
use dvi_tests::{Numbers, Outcome, failing};

/// A mass x, which the motion takes to zero.
#[lagrangian(coordinates(x), lagrangian = x * dot(x).powi(2) / 2.0)]
#[derive(Clone, Debug)]
struct Melting;

/// The same, coupled to a second coordinate.
#[lagrangian(
    coordinates(x, y),
    lagrangian = x * dot(x).powi(2) / 2.0 + 0.1 * dot(x) * dot(y) + dot(y).powi(2) / 2.0,
)]
#[derive(Clone, Debug)]
struct MeltingPair;

/// Whether the run ends because the mass has changed its sign; it may find no solution there instead.
fn melts<S: RegularLagrangian, M: Method<S, f64> + core::fmt::Debug>(
    system: &S,
    method: M,
    h: f64,
    start: S::State<f64>,
) -> Outcome<bool> {
    let name = format!("{method:?}, h = {h}");
    let (run, error) = failing(system, method, h, start)?;
    assert!(run.q()[0] > 0.0, "{name}: {:?}", run.q());
    match error.failure {
        StepFailure::Orientation { matrix, before, after } => {
            assert!(matrix == "the mass matrix" && before > 0.0 && after < 0.0, "{name}: {error}");
            Ok(true)
        }
        _ => Ok(false),
    }
}

#[test]
fn no_step_goes_over_a_mass_of_zero() -> Outcome {
    // x^(3/2) = 1 − 3t/2.
    let start = MeltingState { x: 1.0, dot_x: -1.0 };
    let pair = MeltingPairState { x: 1.0, y: 0.0, dot_x: -1.0, dot_y: 0.0 };
    let mut found = 0;
    for h in [1.0, 0.9, 0.7, 0.5, 0.3, 0.07] {
        for rule in
            [Quadrature::gauss(1)?, Quadrature::gauss(2)?, Quadrature::lobatto(2)?, Quadrature::sigma(0.0)]
        {
            found += u32::from(melts(&Melting, Variational::new(rule), h, start)?);
            found += u32::from(melts(&MeltingPair, Variational::new(rule), h, pair)?);
        }
        found += u32::from(melts(&Melting, Galerkin::<3>::new(), h, start)?);
    }
    assert!(found > 5, "{found}");
    Ok(())
}

/// Two masses that vanish together, at t = 1.
#[lagrangian(coordinates(x, y), lagrangian = (1 - t) * (dot(x).powi(2) + dot(y).powi(2)) / 2)]
#[derive(Clone, Debug)]
struct Vanishing;

/// The same two, coupled so that the matrix is not diagonal.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (1 - t) * (dot(x).powi(2) + dot(x) * dot(y) + dot(y).powi(2)) / 2,
)]
#[derive(Clone, Debug)]
struct VanishingPair;

#[test]
fn two_masses_that_change_their_sign_together_end_a_run() -> Outcome {
    fn check<S: RegularLagrangian>(system: &S, start: &S::State<f64>) -> Outcome {
        for h in [0.3, 0.35, 0.7] {
            for rule in [Quadrature::gauss(1)?, Quadrature::gauss(2)?, Quadrature::lobatto(2)?] {
                let (run, error) = failing(system, Variational::new(rule), h, start.clone())?;
                assert!(run.time() < 1.0, "h = {h}: {}", run.time());
                let StepFailure::Orientation { matrix: "the mass matrix", before, after } = error.failure
                else {
                    return Err(format!("h = {h}: {error}").into());
                };
                assert!(before > 0.0 && after < 0.0, "{error}");
            }
        }
        Ok(())
    }
    check(&Vanishing, &VanishingState { x: 0.0, y: 0.0, dot_x: 1.0, dot_y: 0.5 })?;
    check(&VanishingPair, &VanishingPairState { x: 0.0, y: 0.0, dot_x: 1.0, dot_y: 0.5 })
}

/// A body on a spring.
#[lagrangian(coordinates(x), lagrangian = m * dot(x).powi(2) / 2 - x * x / 2)]
#[derive(Clone, Debug)]
struct Body {
    m: f64,
}

/// 1/m overflows.
#[test]
fn a_mass_too_small_to_divide_by_is_singular() -> Outcome {
    fn check<M: Method<Body, f64>>(method: M) -> Outcome {
        let start = BodyState { x: 1.0, dot_x: 0.0 };
        match Integrator::new(&Body { m: 1e-320 }, method, 0.1, start).err() {
            Some(StartError::Singular { matrix: "the mass matrix", size: 1e-320, .. }) => Ok(()),
            other => Err(format!("{other:?}").into()),
        }
    }
    check(Variational::trapezoid())?;
    check(Variational::midpoint())
}

/// Two squares of three velocities.
#[lagrangian(
    coordinates(x, y, z),
    lagrangian = (dot(x) * a + dot(y) * b).powi(2) / 2.0 + (dot(x) * c + dot(y) * d - dot(z) * e).powi(2) / 2.0
        - (x * x + y * y + z * z) / 2.0,
)]
struct RankTwo {
    a: f64,
    b: f64,
    c: f64,
    d: f64,
    e: f64,
}

#[test]
fn masses_of_a_lower_rank_are_singular_whatever_rounding_leaves_of_their_pivots() -> Outcome {
    let state = RankTwoState { x: 1.0, y: 1.0, z: 1.0, dot_x: 0.0, dot_y: 0.0, dot_z: 0.0 };
    for (i, k) in (1..=20).flat_map(|i| (1..=20).map(move |k| (i, k))) {
        let system = RankTwo { a: f64::from(i) * 0.1, b: 0.4, c: f64::from(k) * 0.1, d: -0.1, e: 0.3 };
        let field = system.vector_field(0.0, &state);
        assert!(matches!(field, Err(StartError::Dependent { .. })), "{field:?}");
        let run = Integrator::new(&system, Variational::trapezoid(), 0.01, state).map(|_| ());
        let Err(StartError::Dependent { matrix: "the mass matrix", entry, .. }) = run else {
            return Err(format!("{i}, {k}: {run:?}").into());
        };
        assert!(["y", "z"].contains(&entry.to_string().as_str()), "{entry}");
    }
    Ok(())
}

/// α with Ωⱼₖ = bⱼₖ − bₖⱼ, up to the sign, and oscillators that it couples.
#[degenerate_lagrangian(
    coordinates(q[4]),
    one_form = sum(0..4, |j| sum(0..4, |k| b[j][k] * q[j] * d(q[k]))),
    hamiltonian = sum(0..4, |j| (q[j] / unit[j]).powi(2)) / 2.0,
)]
#[derive(Clone, Debug)]
struct Full {
    b: [[f64; 4]; 4],
    unit: [f64; 4],
}

impl Full {
    /// A coordinate of unit u has entries of b that are smaller by 1/u.
    fn new(b: [[f64; 4]; 4], unit: [f64; 4]) -> Self {
        let b = core::array::from_fn(|j| core::array::from_fn(|k| b[j][k] / (unit[j] * unit[k])));
        Self { b, unit }
    }

    fn start(&self) -> FullState {
        FullState { q: core::array::from_fn(|j| (1.0 + j as f64) * self.unit[j]) }
    }
}

/// Powers of two change nothing but exponents, and the choice of pivots.
const EXPONENTS: [[i32; 4]; 4] = [[0; 4], [3, -60, 60, 9], [100, 100, -100, -100], [-150, 150, 10, -10]];

/// Ω = u ∧ v has rank 2.
#[test]
fn forms_of_a_lower_rank_are_singular_whatever_rounding_leaves_of_their_pivots() {
    for (seed, exponents) in (0..100).flat_map(|seed| EXPONENTS.map(|exponents| (seed, exponents))) {
        let mut numbers = Numbers(seed);
        let [u, v]: [[f64; 4]; 2] = core::array::from_fn(|_| core::array::from_fn(|_| numbers.next()));
        let b = core::array::from_fn(|j| core::array::from_fn(|k| u[j] * v[k]));
        let system = Full::new(b, exponents.map(|exponent| f64::from(exponent).exp2()));
        let field = system.vector_field(0.0, &system.start());
        assert!(
            matches!(field, Err(StartError::Dependent { matrix: "Ω = −dα", .. })),
            "seed {seed}, {exponents:?}: {field:?}"
        );
        let run = Integrator::new(&system, RungeKutta::classical(), 0.01, system.start()).map(|_| ());
        assert!(
            matches!(run, Err(StartError::Dependent { matrix: "Ω = −dα", .. })),
            "seed {seed}, {exponents:?}: {run:?}"
        );
    }
}
