//! The same unfriendliness for systems with constraints.

use approx::assert_abs_diff_eq;
use dvi_core::{
    ConstrainedSystem, HolonomicLagrangian, Lagrangian, ManifoldSystem, NonholonomicLagrangian, Space,
    System, UnilateralLagrangian,
};
use dvi_tests::filling;

use crate::shadowed;

/// Fields and indices with the names of what generated code might use.
mod names {
    use dvi_core::lagrangian;

    /// A system.
    #[lagrangian(
        coordinates(q, out[3], constraint),
        lagrangian = dot(q).powi(2) + sum(0..3, |j| dot(out[j]).powi(2)) + dot(constraint).powi(2),
        constraint(q in 0..3) = out[q] * g - row0 * (q as f64),
        constraint = constraint * sink - g0[1] * rest - q,
        momenta(constraint = g * dot(constraint)),
    )]
    #[derive(Clone, Debug)]
    pub struct Names {
        pub(super) g: f64,
        pub(super) g0: [f64; 2],
        pub(super) row0: f64,
        pub(super) rest: f64,
        pub(super) sink: f64,
    }
}

/// dg/dt where all coordinates are one half and all velocities one quarter.
fn rate<S: HolonomicLagrangian>(system: &S) -> Vec<f64> {
    assert!(system.check().is_ok());
    let (n, m) = (system.space().dimension(), system.multipliers().dimension());
    let mut rate = vec![f64::NAN; m];
    system.constraint_rate(&vec![0.5; n], &vec![0.25; n], 0.0, &mut rate);
    rate
}

#[test]
fn systems_with_constraints_and_unfriendly_names_work() {
    let names = names::Names { g: 2.0, g0: [3.0, 4.0], row0: 5.0, rest: 6.0, sink: 7.0 };
    assert_eq!(rate(&names), [0.5, 0.5, 0.5, 1.5]);
    assert_eq!(rate(&shadowed::Linked { mass: vec![2.0, 3.0] }), [-0.25]);
    assert_eq!(rate(&shadowed::Linked { mass: Vec::new() }), [0.0; 0]);
}

#[test]
fn systems_with_constraints_of_velocities_and_unfriendly_names_work() {
    let rolling = shadowed::Rolling { weights: vec![2.0, 3.0], g0: 4.0, sink: 5.0 };
    assert!(rolling.check().is_ok());
    let m = rolling.multipliers().dimension();
    let (mut a, mut jacobian) = (vec![f64::NAN; m], vec![0.0; 3 * m]);
    let (q, v, weights) = ([0.5; 3], [0.25; 3], [1.0, 10.0]);
    rolling.velocity_constraint_jacobian(&q, &v, 0.0, weights, &mut a, &mut filling(&mut jacobian, 3));
    assert_eq!(a, [-0.5, -0.25, -4.875]);
    assert_eq!(jacobian, [18.0, 0.0, -2.0, 0.0, 28.0, -2.0, 0.0, 0.0, 5.25]);
}

#[test]
fn systems_with_impacts_and_unfriendly_names_work() {
    let walled = shadowed::Walled { n: 2, weights: vec![2.0, 3.0], g0: 4.0, sink: 5.0 };
    assert!(walled.check().is_ok());
    let (m, q, v, t) = (walled.multipliers().dimension(), [0.5; 3], [0.25; 3], 1.0);
    let (mut gap, mut rate, mut jacobian) = (vec![f64::NAN; m], vec![f64::NAN; m], vec![0.0; 3 * m]);
    walled.gap_jacobian(&q, t, &mut gap, &mut filling(&mut jacobian, 3));
    walled.gap_rate(&q, &v, t, &mut rate);
    assert_eq!(gap, [-1.0, -0.5, -4.75]);
    assert_eq!(rate, [-0.5, -0.25, -4.75]);
    assert_eq!(jacobian, [2.0, 0.0, -4.0, 0.0, 3.0, -4.0, 0.0, 0.0, 1.0]);
    let mut again = vec![f64::NAN; m];
    walled.gap(&q, t, &mut again);
    assert_eq!(again, gap);
}

#[test]
fn systems_with_rotations_and_unfriendly_names_work() {
    let turning = shadowed::Turning { weights: vec![2.0, 3.0], omega: 4.0, tangent: 5.0 };
    assert!(turning.check().is_ok());
    assert_eq!((turning.space().dimension(), turning.tangent().dimension()), (14, 7));
    let names: Vec<String> = turning.names().map(|name| name.to_string()).collect();
    assert_eq!((&names[1][..], &names[14][..], &names[17][..]), ("type[1]", "omega_type[0]", "dot_dot[0]"));
    let (q, v) = ([0.5; 14], [0.25; 14]);
    let value: f64 = turning.lagrangian(&q, &v, 0.0);
    assert_abs_diff_eq!(value, (5.0 / 16.0 + 3.0 / 16.0 + 0.75 - 1.25), epsilon = 1e-15);
}
