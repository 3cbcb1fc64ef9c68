//! Constraints of the velocities: what is generated for them, against closed forms and num-dual.

use dvi_core::prelude::*;
use dvi_core::{
    ConstrainedSystem, Fixed, NondegenerateLagrangian, NonholonomicLagrangian, RunTime, Space, System,
    Varied,
};
use dvi_tests::filling;
use num_dual::Dual64;

use super::Outcome;
use super::declarations::{close, point};
use super::systems::{Number, surface};

/// A system and its a, written a second time.
trait ByHand: NonholonomicLagrangian + NondegenerateLagrangian<Dual64> {
    fn by_hand<D: Number>(&self, q: &[D], v: &[D], t: D) -> Vec<D>;
}

/// A blade on an inclined plane, which does not slip to the side.
#[lagrangian(
    coordinates(x, y, theta),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2) + inertia * dot(theta).powi(2)) / 2.0 + slope * x,
    nonholonomic = dot(x) * theta.sin() - dot(y) * theta.cos(),
)]
#[derive(Clone, Debug)]
struct KnifeEdge {
    inertia: f64,
    slope: f64,
}

impl ByHand for KnifeEdge {
    fn by_hand<D: Number>(&self, q: &[D], v: &[D], _: D) -> Vec<D> {
        vec![v[0] * q[2].sin() - v[1] * q[2].cos()]
    }
}

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

impl ByHand for Disc<f64> {
    fn by_hand<D: Number>(&self, q: &[D], v: &[D], _: D) -> Vec<D> {
        vec![v[0] - v[2] * q[3].cos() * self.radius, v[1] - v[2] * q[3].sin() * self.radius]
    }
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

impl ByHand for Train {
    fn by_hand<D: Number>(&self, q: &[D], v: &[D], t: D) -> Vec<D> {
        let n = self.headings.len();
        let (w, dot_w) = (q[2 * n], v[2 * n]);
        let heading = |i: usize| t * w + self.headings[i];
        let mut a: Vec<D> = (0..n).map(|i| v[i] * heading(i).sin() - v[n + i] * heading(i).cos()).collect();
        a.push(dot_w - (0..n).map(|j| q[j] * v[n + j] - t * t * j as f64).sum::<D>());
        a.extend(
            (1..n.max(1) - 1)
                .map(|k| (q[k] - q[k - 1]) * (v[k] - v[k - 1]) + t * dot_w * q[n + k + 1].exp()),
        );
        a
    }
}

/// As many constraints as particles, of const number.
#[lagrangian(
    coordinates(x[N], y[N]),
    lagrangian = sum(0..N, |i| dot(x[i]).powi(2) + dot(y[i]).powi(2)) / 2.0,
    nonholonomic(i in 0..N) = if x[i] > 0.0 { dot(y[i]) - x[i] * dot(x[(i + 1) % N]) } else { dot(x[i]) + t },
)]
#[derive(Clone, Debug)]
struct Ring<const N: usize>;

impl<const N: usize> ByHand for Ring<N> {
    fn by_hand<D: Number>(&self, q: &[D], v: &[D], t: D) -> Vec<D> {
        let one = |i: usize| if q[i].re() > 0.0 { v[N + i] - q[i] * v[(i + 1) % N] } else { v[i] + t };
        (0..N).map(one).collect()
    }
}

/// a, the weighted Jacobian and the rate of a system, as they are generated.
struct Generated {
    a: Vec<f64>,
    jacobian: Vec<f64>,
    rate: Vec<f64>,
}

fn generated<S: NonholonomicLagrangian>(
    system: &S,
    q: &[f64],
    v: &[f64],
    t: f64,
    weights: [f64; 2],
) -> Generated {
    let (n, m) = (q.len(), system.multipliers().dimension());
    let (mut a, mut again, mut rate) = (vec![7.0; m], vec![7.0; m], vec![7.0; m]);
    let mut jacobian = vec![0.0; n * m];
    system.velocity_constraint(q, v, t, &mut a);
    system.velocity_constraint_jacobian(q, v, t, weights, &mut again, &mut filling(&mut jacobian, n));
    system.velocity_constraint_rate(q, v, t, &mut rate);
    close(&again, &a, "a beside its derivatives");
    Generated { a, jacobian, rate }
}

/// Compares the three functions with what num-dual makes of the constraints as they are written by hand.
fn compare<S: ByHand>(system: &S) {
    let n = system.space().dimension();
    let (m, both) = (system.multipliers().dimension(), system.augmented().dimension());
    for (seed, weights) in [(0.3, [1.0, 0.0]), (1.1, [0.0, 1.0]), (2.7, [-0.7, 1.3])] {
        let (q, v, t) = (point(n, seed), point(n, seed + 5.0), 0.4 + seed);
        let found = generated(system, &q, &v, t, weights);
        let along = |by_q: &[f64], by_v: &[f64], by_t: f64| {
            let seeded = |x: &[f64], a: &[f64]| x.iter().zip(a).map(|(x, a)| Dual64::new(*x, *a)).collect();
            let (q, v): (Vec<Dual64>, Vec<Dual64>) = (seeded(&q, by_q), seeded(&v, by_v));
            system.by_hand(&q, &v, Dual64::new(t, by_t))
        };
        let still = vec![0.0; n];
        let moving = along(&v, &still, 1.0);
        assert_eq!((m, both), (moving.len(), n + moving.len()));
        let rates = |a: &[Dual64]| a.iter().map(|a| a.eps).collect::<Vec<_>>();
        close(&found.a, &moving.iter().map(|a| a.re).collect::<Vec<_>>(), "a");
        close(&found.rate, &rates(&moving), "da/dt");
        for j in 0..n {
            let unit = |weight: f64| (0..n).map(|i| if i == j { weight } else { 0.0 }).collect::<Vec<_>>();
            let column: Vec<f64> = (0..m).map(|k| found.jacobian[k * n + j]).collect();
            close(&column, &rates(&along(&unit(weights[0]), &unit(weights[1]), 0.0)), "∂a");
        }
    }
}

#[test]
fn generated_functions_are_those_of_the_formulas() {
    compare(&KnifeEdge { inertia: 0.3, slope: 0.2 });
    compare(&Disc { radius: 0.7 });
    for sledges in [1, 2, 3, 6] {
        compare(&Train { headings: point(sledges, 0.4) });
    }
    compare(&Ring::<1>);
    compare(&Ring::<5>);
}

fn is<S: ConstrainedSystem<Multipliers = M, Augmented = A>, M: Space, A: Space>(_: &S, _: M, _: A) {}

#[test]
fn members_are_numbered_in_the_order_of_declaration() {
    is(&KnifeEdge { inertia: 1.0, slope: 0.0 }, Fixed::<1, 1>::new(), Fixed::<1, 4>::new());
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
fn indices_are_checked_against_their_arrays() {
    assert_eq!(Train { headings: vec![0.0; 3] }.check(), Ok(()));
    assert_eq!(Listed { n: 3, slopes: vec![0.5; 2] }.check().map_err(|error| error.array), Err("slopes"));
}

/// A parameter for each constraint.
#[lagrangian(
    coordinates(x[n], y[n]),
    lagrangian = sum(0..n, |i| dot(x[i]).powi(2) + dot(y[i]).powi(2)),
    nonholonomic(i in 0..n) = dot(y[i]) - slopes[i] * dot(x[i]),
)]
struct Listed {
    n: usize,
    slopes: Vec<f64>,
}

/// A blade whose heading is given by a table.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    nonholonomic = dot(y) - slope(x, y) * dot(x),
)]
struct Steered<S> {
    slope: S,
}

#[test]
fn functions_of_the_user_stand_in_constraints() -> Outcome {
    let system = Steered { slope: surface()? };
    let ([x, y], v) = ([0.3, -0.2], [2.0, 3.0]);
    let found = generated(&system, &[x, y], &v, 0.0, [1.0, 10.0]);
    let (slope, by) = (x * y * (1.0 + x), [y * (1.0 + 2.0 * x), x * (1.0 + x)]);
    close(&found.a, &[v[1] - slope * v[0]], "a");
    close(&found.jacobian, &[-by[0] * v[0] - 10.0 * slope, -by[1] * v[0] + 10.0], "∂a");
    close(&found.rate, &[-(by[0] * v[0] + by[1] * v[1]) * v[0]], "da/dt");
    assert!(system.outside(&[x, y], &v, 0.0).is_none());
    let outside = system.outside(&[x, 1.2], &v, 0.0).ok_or("it is outside")?;
    assert_eq!((outside.bound, outside.value), (1.0, 1.2));
    Ok(())
}

#[test]
fn reports_name_the_constraints() {
    let text = KnifeEdge::REPORT.to_string();
    for line in [
        "constraint a[0] = ",
        "∂a[0]/∂theta = dot(x)·cos(theta) + dot(y)·sin(theta)",
        "∂a[0]/∂dot(x) = sin(theta)",
        "1 nonholonomic constraint a(q, v, t) = 0.",
        "Begin with `Constrained`",
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
