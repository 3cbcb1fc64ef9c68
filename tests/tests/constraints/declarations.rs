//! How constraints are declared, what is generated for them, and what is said of them.

use dvi_core::prelude::*;
use dvi_core::{
    ConstrainedSystem, Fixed, IndexError, NonholonomicLagrangian, RunTime, ScalarField, Space, Varied,
};
use dvi_tests::filling;
use num_dual::Dual64;

use super::Outcome;
use super::systems::{Beads, Chain, Disc, Driven, Hung, Linked, Ring, Three, Train, surface};
use dvi_tests::zoo::constrained::Pendulum;
use dvi_tests::zoo::nonholonomic::KnifeEdge;

const PENDULUM: Pendulum = Pendulum { m: 1.0, g: 9.81, length: 1.3 };

/// Numbers that have nothing to do with each other.
fn point(n: usize, seed: f64) -> Vec<f64> {
    (0..n).map(|i| 0.9 * (seed + 1.7 * i as f64).sin() + 0.05).collect()
}

/// g and d²g/dt² of a system, as they are generated.
fn generated<S: HolonomicLagrangian>(system: &S, q: &[f64], v: &[f64], t: f64) -> [Vec<f64>; 2] {
    let (n, m) = (q.len(), system.multipliers().dimension());
    let set = || vec![7.0; m];
    let (mut g, mut again, mut curvature) = (set(), set(), set());
    system.constraint(q, t, &mut g);
    system.constraint_jacobian(q, t, &mut again, &mut filling(&mut vec![0.0; n * m], n));
    system.constraint_curvature(q, v, t, &mut curvature);
    close(&again, &g, "g beside ∂g/∂q");
    [g, curvature]
}

fn close(found: &[f64], expected: &[f64], what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}");
    for (k, (found, expected)) in found.iter().zip(expected).enumerate() {
        let off = (found - expected).abs();
        assert!(off <= 1e-12 * (1.0 + expected.abs()), "{what} {k}: {found} {expected}");
    }
}

fn is<S: ConstrainedSystem<Multipliers = M, Augmented = A>, M: Space, A: Space>(_: &S, _: M, _: A) {}

#[test]
fn spaces_are_fixed_where_stable_rust_can_count() {
    is(&PENDULUM, Fixed::<1, 1>::new(), Fixed::<1, 3>::new());
    is(&Three, Fixed::<1, 2>::new(), Fixed::<1, 8>::new());
    is(&Linked::<5>, Fixed::<3, 5, 2, _>::new(), Fixed::<6, 5, 3, _>::new());
    let run_time = |dimension: usize| RunTime { dimension };
    let chain = Chain::<4> { rods: vec![1.0; 3] };
    is(&chain, run_time(3), run_time(11));
    let system = Hung { rods: vec![1.0; 4] };
    assert_eq!((system.multipliers(), system.augmented()), (run_time(1 + 4 + 2 + 2 + 1), run_time(20)));
    let system = Hung { rods: vec![1.0] };
    assert_eq!((system.multipliers(), system.augmented()), (run_time(5), run_time(9)));
    // Of velocities.
    is(&KnifeEdge { m: 1.0, inertia: 1.0, slope: 0.0 }, Fixed::<1, 1>::new(), Fixed::<1, 4>::new());
    is(&Disc { radius: 1.0 }, Fixed::<1, 2>::new(), Fixed::<1, 6>::new());
    is(&Ring::<5>, Fixed::<1, 5, 0, _>::new(), Fixed::<3, 5, 0, _>::new());
    let train = |sledges: usize| Train { headings: vec![0.0; sledges] };
    is(&train(4), run_time(4 + 1 + 2), run_time(16));
    assert_eq!(train(1).multipliers(), run_time(1 + 1));
}

#[test]
fn a_constraint_outside_of_its_table_is_seen() -> Outcome {
    let system = Beads { surface: surface()? };
    assert_eq!(system.surface.domain()[0], (-1.0, 1.0));
    assert!(system.outside(&[0.3, 0.2, 0.0], &[0.0; 3], 0.0).is_none());
    let outside = system.outside(&[0.3, 1.2, 0.0], &[0.0; 3], 0.0).ok_or("it is outside")?;
    assert_eq!((outside.bound, outside.value), (1.0, 1.2));
    Ok(())
}

#[test]
fn indices_of_constraints_are_checked_against_their_arrays() {
    assert_eq!(Chain::<4> { rods: vec![1.0; 3] }.check(), Ok(()));
    let error = Chain::<4> { rods: vec![1.0; 2] }.check();
    assert_eq!(error, Err(IndexError { array: "rods", index: 2, len: 2 }));
}

#[test]
fn structure_is_that_of_the_lagrangian_and_the_time_in_a_constraint_is_seen() {
    const { assert!(<Pendulum as NondegenerateLagrangian>::SEPARABLE) };
    const { assert!(<KnifeEdge as NondegenerateLagrangian>::SEPARABLE) };
    const { assert!(!<Driven as NondegenerateLagrangian>::CONSTANT_MASS) };
    const { assert!(!<Train as NondegenerateLagrangian>::CONSTANT_MASS) };
    const { assert!(Pendulum::AUTONOMOUS && Three::AUTONOMOUS && KnifeEdge::AUTONOMOUS) };
    const { assert!(!Driven::AUTONOMOUS && !Hung::AUTONOMOUS && Disc::<f64>::AUTONOMOUS) };
    const { assert!(!Train::AUTONOMOUS && !Ring::<3>::AUTONOMOUS) };
}

#[test]
fn reports_name_the_constraints() {
    fn says(report: &dvi_core::Report, lines: &[&str]) {
        let text = report.to_string();
        assert!(lines.iter().all(|line| text.contains(line)), "{lines:?}\n{text}");
    }
    says(
        &Pendulum::REPORT,
        &["constraint g[0] = ", "∂g[0]/∂x = 2·x", "1 holonomic constraint g(q, t) = 0."],
    );
    says(
        &Chain::<2>::REPORT,
        &["constraint g[i] = ", "  for i in 0..N - 1", "∂g[i]/∂x[i + 1] = ", "N - 1 holonomic constraints"],
    );
    let empty = "2·rods.len() + 2 holonomic constraints g(q, t) = 0, where no range is empty.";
    says(&Hung::REPORT, &[empty]);
    says(&Linked::<2>::REPORT, &["constraint g[i + 2] = ", "N + 2 holonomic constraints"]);
    assert!(!Linked::<2>::REPORT.to_string().contains("Variational::trapezoid"));
    says(
        &KnifeEdge::REPORT,
        &[
            "constraint a[0] = ",
            "∂a[0]/∂angle = dot(x)·cos(angle) + dot(y)·sin(angle)",
            "∂a[0]/∂dot(x) = sin(angle)",
            "1 nonholonomic constraint a(q, v, t) = 0.",
            "Begin with `Constrained::new(Midpoint)`",
        ],
    );
    says(&Train::REPORT, &["  for i in 0..headings.len()", "2·headings.len() - 1 nonholonomic constraints"]);
}

/// A rod whose length is a parameter of any type of numbers.
#[lagrangian(coordinates(x, y), lagrangian = dot(x).powi(2) + dot(y).powi(2), constraint = x * x + y * y - length * length)]
struct Rod<P> {
    length: P,
}

#[test]
fn constraints_have_derivatives_by_parameters() {
    let system = Rod { length: Varied(Dual64::from_re(1.5).derivative()) };
    let mut g = [Dual64::from_re(0.0)];
    let q = [Dual64::from_re(2.0), Dual64::from_re(1.0)];
    system.constraint(&q, Dual64::from_re(0.0), &mut g);
    assert_eq!((g[0].re, g[0].eps), (2.75, -3.0));

    let system = Disc { radius: Varied(Dual64::from_re(1.5).derivative()) };
    let mut a = [Dual64::from_re(0.0); 2];
    let v = [0.0, 0.0, 2.0, 0.0].map(Dual64::from_re);
    system.velocity_constraint(&[0.0; 4].map(Dual64::from_re), &v, Dual64::from_re(0.0), &mut a);
    assert_eq!((a[0].re, a[0].eps, a[1].re), (-3.0, -2.0, 0.0));
}

/// Neither a loop of its own nor those of the sums in it run where a family is empty.
#[lagrangian(
    coordinates(x[n]),
    lagrangian = sum(0..n, |j| dot(x[j]).powi(2)),
    constraint(i in 0..n - 4) = x[i + 4] - x[i] * sum(i..i + 4, |j| x[j]),
    constraint = x[0],
)]
struct Loose {
    n: usize,
}

#[test]
fn an_empty_family_reads_nothing_and_takes_no_place() {
    for n in [1, 3, 4] {
        let system = Loose { n };
        assert_eq!((system.check(), system.multipliers().dimension()), (Ok(()), 1));
        assert_eq!(system.augmented().dimension(), n + 1);
        let found = generated(&system, &point(n, 0.2), &point(n, 0.7), 0.0);
        assert_eq!(found, [vec![point(n, 0.2)[0]], vec![0.0]]);
    }
    assert_eq!(Loose { n: 6 }.multipliers().dimension(), 3);
}
