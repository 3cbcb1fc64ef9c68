//! Constraints of the velocities: how they are declared, and what is said of them.

use dvi_core::prelude::*;
use dvi_core::{
    ConstrainedSystem, Fixed, NondegenerateLagrangian, NonholonomicLagrangian, RunTime, Space, Varied,
};
use dvi_tests::zoo::nonholonomic::KnifeEdge;
use num_dual::Dual64;

/// A disc that rolls upright on a plane, with a force and a parameter of any type of numbers.
#[lagrangian(
    coordinates(x, y, theta, phi),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 + dot(theta).powi(2) / 4.0 + dot(phi).powi(2) / 8.0,
    force(theta) = -0.1 * dot(theta),
    nonholonomic = [dot(x) - radius * dot(theta) * phi.cos(), dot(y) - radius * dot(theta) * phi.sin()],
)]
#[derive(Clone, Debug)]
struct Disc<P> {
    radius: P,
}

/// A train of sledges on ice that turns under them: families before and behind single constraints, whose
/// sums stand in both, and the time.
#[lagrangian(
    coordinates(x[headings.len()], y[headings.len()], w),
    lagrangian = sum(0..headings.len(), |i| dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0 + (1.0 + w * w) * dot(w).powi(2),
    nonholonomic(i in 0..headings.len()) =
        dot(x[i]) * (headings[i] + t * w).sin() - dot(y[i]) * (headings[i] + t * w).cos(),
    nonholonomic = dot(w) - sum(0..headings.len(), |j| x[j] * dot(y[j]) - (j as f64) * t.powi(2)),
    nonholonomic(k in 1..headings.len() - 1) = (x[k] - x[k - 1]) * (dot(x[k]) - dot(x[k - 1])) + t * dot(w) * y[k + 1].exp(),
)]
#[derive(Clone, Debug)]
struct Train {
    headings: Vec<f64>,
}

/// As many constraints as particles, of const number.
#[lagrangian(
    coordinates(x[N], y[N]),
    lagrangian = sum(0..N, |i| dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0,
    nonholonomic(i in 0..N) = if x[i] > 0.0 { dot(y[i]) - x[i] * dot(x[(i + 1) % N]) } else { dot(x[i]) + t },
)]
#[derive(Clone, Debug)]
struct Ring<const N: usize>;

fn is<S: ConstrainedSystem<Multipliers = M, Augmented = A>, M: Space, A: Space>(_: &S, _: M, _: A) {}

#[test]
fn members_are_numbered_in_the_order_of_declaration() {
    is(&KnifeEdge { m: 1.0, inertia: 1.0, slope: 0.0 }, Fixed::<1, 1>::new(), Fixed::<1, 4>::new());
    is(&Disc { radius: 1.0 }, Fixed::<1, 2>::new(), Fixed::<1, 6>::new());
    is(&Ring::<5>, Fixed::<1, 5, 0, _>::new(), Fixed::<3, 5, 0, _>::new());
    let run_time = |dimension: usize| RunTime { dimension };
    let train = |sledges: usize| Train { headings: vec![0.0; sledges] };
    is(&train(4), run_time(7), run_time(16));
    assert_eq!((train(4).multipliers(), train(4).augmented()), (run_time(4 + 1 + 2), run_time(16)));
    assert_eq!(train(1).multipliers(), run_time(1 + 1));
}

#[test]
fn structure_is_that_of_the_lagrangian() {
    const { assert!(<KnifeEdge as NondegenerateLagrangian>::SEPARABLE) };
    const { assert!(!<Train as NondegenerateLagrangian>::CONSTANT_MASS) };
    const { assert!(KnifeEdge::AUTONOMOUS && Disc::<f64>::AUTONOMOUS) };
    const { assert!(!Train::AUTONOMOUS && !Ring::<3>::AUTONOMOUS) };
}

#[test]
fn reports_name_the_constraints() {
    let text = KnifeEdge::REPORT.to_string();
    for line in [
        "constraint a[0] = ",
        "∂a[0]/∂angle = dot(x)·cos(angle) + dot(y)·sin(angle)",
        "∂a[0]/∂dot(x) = sin(angle)",
        "1 nonholonomic constraint a(q, v, t) = 0.",
        "Begin with `Constrained::new(Midpoint)`",
    ] {
        assert!(text.contains(line), "{line}\n{text}");
    }
    let text = Train::REPORT.to_string();
    for line in ["  for i in 0..headings.len()", "2·headings.len() - 1 nonholonomic constraints"] {
        assert!(text.contains(line), "{line}\n{text}");
    }
}

#[test]
fn constraints_have_derivatives_by_parameters() {
    let system = Disc { radius: Varied(Dual64::from_re(1.5).derivative()) };
    let number = Dual64::from_re;
    let mut a = [number(0.0); 2];
    let v = [0.0, 0.0, 2.0, 0.0].map(number);
    system.velocity_constraint(&[0.0; 4].map(number), &v, number(0.0), &mut a);
    assert_eq!((a[0].re, a[0].eps, a[1].re), (-3.0, -2.0, 0.0));
}
