//! The same unfriendliness for regular systems, whose states hold velocities.

use dvi_core::{RegularLagrangian, Space, State};

use crate::shadowed;

/// Fields with the names of what generated code might use.
mod fields {
    use dvi_core::lagrangian;

    /// A system.
    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) * T + dot(y).powi(2) * self_) / 2.0 - core * x * y + dot_x * q * v
            - Ok * x * x + dot * vector * y + w * t * x,
        momenta(energy = T * dot(x), force = x, r#match = dot(y)),
    )]
    #[derive(Clone, Debug, Default)]
    #[allow(non_snake_case)]
    pub struct Fields {
        pub(super) self_: f64,
        pub(super) T: f64,
        pub(super) core: f64,
        pub(super) Ok: f64,
        pub(super) q: f64,
        pub(super) v: f64,
        pub(super) w: f64,
        pub(super) dot: f64,
        pub(super) dot_x: f64,
        pub(super) vector: f64,
    }
}

/// Coordinates with such names.
mod coordinates {
    use dvi_core::lagrangian;

    /// A system.
    #[lagrangian(
        coordinates(q, v[2], t, r#type, PI, dot, dot_q_, None),
        lagrangian = dot(q).powi(2) + sum(0..2, |j| dot(v[j]).powi(2)) + dot(t).powi(2)
            + dot(r#type).powi(2) * (2.0 + t.sin()) + dot(PI).powi(2) + dot(dot).powi(2) + dot(dot_q_).powi(2)
            + dot(None).powi(2) - PI * r#type,
    )]
    #[derive(Clone, Debug)]
    #[allow(non_snake_case)]
    pub struct Coordinates;
}

/// E at a point where all coordinates are one half and all velocities one quarter, by way of a state.
fn energy<S: RegularLagrangian>(system: &S) -> f64 {
    assert!(system.check().is_ok());
    let n = system.space().dimension();
    let state = S::State::<f64>::read(&|block| system.block_len(block), &vec![0.5; n], &vec![0.25; n]);
    let (mut q, mut v) = (vec![f64::NAN; n], vec![f64::NAN; n]);
    assert!(state.write(&|block| system.block_len(block), &mut q, &mut v).is_ok());
    assert!(q.iter().all(|q| q.to_bits() == 0.5_f64.to_bits()));
    assert!(v.iter().all(|v| v.to_bits() == 0.25_f64.to_bits()));
    let mut force = vec![f64::NAN; n];
    system.force(&q, &v, 0.0, &mut force);
    assert!(force.iter().all(|force| force.is_finite()));
    system.energy(&q, &v, 0.0)
}

#[test]
fn regular_systems_with_unfriendly_names_work() {
    let fields = fields::Fields { self_: 1.0, T: 1.0, ..fields::Fields::default() };
    assert!(energy(&fields).is_finite());
    assert!(energy(&coordinates::Coordinates).is_finite());
    assert!(energy(&shadowed::Masses { mass: vec![1.0; 3] }).is_finite());
}

#[test]
fn states_hold_coordinates_then_velocities() {
    let state = fields::FieldsState { x: 1.0, y: 2.0, dot_x: 3.0, dot_y: 4.0 };
    let tuple: (f64, f64, f64, f64) = state.into();
    assert_eq!(format!("{tuple:?}"), "(1.0, 2.0, 3.0, 4.0)");
    assert_eq!(fields::FieldsState::from(tuple), state);
    let lengths = shadowed::MassesState { x: vec![1.0; 3], u: 0.0, dot_x: vec![1.0; 2], dot_u: 0.0 };
    let result = lengths.write(&|block| if block == 0 { 3 } else { 1 }, &mut [0.0; 4], &mut [0.0; 4]);
    assert_eq!(result.map_err(|error| error.array), Err("dot_x"));
}

/// Constants with the names of arguments.
mod constants {
    #![allow(non_upper_case_globals, dead_code)]
    use dvi_core::lagrangian;

    const q: f64 = 2.0;
    const out: f64 = 1.0;
    const index: usize = 1;
    static v: f64 = 1.0;
    static t: f64 = 1.0;

    /// A system beside them.
    #[lagrangian(
        coordinates(x, y[2]),
        lagrangian = dot(x).powi(2) / 2.0 + sum(0..2, |j| dot(y[j]).powi(2)) - self::q * x * y[0],
        momenta(p = dot(x)),
    )]
    #[derive(Clone, Debug)]
    pub struct Beside;
}
