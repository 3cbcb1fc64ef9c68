//! What a system says at one state: names and entries, and where it has no answer.

use dvi_core::prelude::*;
use dvi_tests::Outcome;
use dvi_tests::configurations::quasi_periodic;
use dvi_tests::systems::*;
use dvi_tests::zoo::regular::*;

/// The entries of a state.
fn entries<S: System>(system: &S, state: &S::State<f64>) -> Result<Vec<f64>, dvi_core::LengthError> {
    Ok(system.values(state)?.collect())
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
    assert!(matches!(kepler.vector_field(0.0, &origin), Err(StartError::Undefined { .. })));
    assert!(matches!(kepler.energy_at(0.0, &origin), Err(StartError::Undefined { .. })));
    let nowhere = KeplerState { x: f64::NAN, ..origin };
    assert!(matches!(kepler.lagrangian_at(0.0, &nowhere), Err(StartError::NotFinite { .. })));
    // The form of the sphere, z dφ, is regular; one that is zero at a point is not.
    let singular = Curved { kappa: -1.0 / 3.0 };
    let at = CurvedState { x: 1.0, y: 1.0 };
    assert!(matches!(singular.vector_field(0.0, &at), Err(StartError::Singular { matrix: "Ω = −dα", .. })));
    assert!(singular.energy_at(0.0, &at).is_ok());
}

/// A literal is a state of `f64`, whose numbers have methods without a type written anywhere, and is printed
/// by the name that it was written with; other numbers are asked for by the second name.
#[test]
fn states_are_of_f64_unless_another_name_is_written() {
    let start = KeplerState { x: -0.5, y: 0.0, dot_x: 0.0, dot_y: 1.0 };
    assert_eq!(start.x.abs().sqrt(), 0.5_f64.sqrt());
    assert_eq!(format!("{start:?}"), "KeplerState { x: -0.5, y: 0.0, dot_x: 0.0, dot_y: 1.0 }");
    let narrow = KeplerStateOf { x: -0.5_f32, y: 0.0, dot_x: 0.0, dot_y: 1.0 };
    assert_eq!(Kepler { mu: 1.0 }.energy_at(0.0, &narrow).ok(), Some(-1.5_f32));
    assert_eq!(Kepler { mu: 1.0 }.energy_at(0.0, &start).ok(), Some(-1.5));
}
