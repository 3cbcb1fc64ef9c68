//! Events that are declared in the attribute: those of closures, bit for bit, and their rates.

use approx::assert_abs_diff_eq;
use dvi_core::prelude::*;
use dvi_tests::Outcome;

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 + mu / x.hypot(y),
    events(pericentre = x * dot(x) + y * dot(y), meeting = y - mu * t.sin()),
)]
#[derive(Clone, Debug)]
struct Planet<P = f64> {
    mu: P,
}

const PLANET: Planet = Planet { mu: 1.1 };
const START: PlanetState = PlanetState { x: 1.0, y: 0.1, dot_x: 0.2, dot_y: 0.9 };

#[degenerate_lagrangian(
    coordinates(x[N], y[N]),
    one_form = sum(0..N, |j| y[j].ln() / x[j] * d(x[j])),
    hamiltonian = sum(0..N, |j| x[j] + y[j] - x[j].ln() - 2.0 * y[j].ln()),
    events(balance = sum(0..N, |j| 2.0 * x[j] - y[j] * (1.0 + 0.1 * t.sin()))),
)]
struct Prey<const N: usize>;

#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - y,
    constraint = x * x + y * y - 1.0,
    events(end = dot(x) * y - x * t),
)]
struct Bob;

#[test]
fn declared_events_are_those_of_closures() -> Outcome {
    assert_eq!(Planet::<f64>::REPORT.events, ["pericentre", "meeting"]);
    let directions = [Direction::Rising, Direction::Either];
    fn compare<R: Run<System = Planet, Scalar = f64>>(
        begin: impl Fn() -> Outcome<R>,
        directions: [Direction; 2],
    ) -> Outcome {
        let closure = |t: f64, s: &PlanetState| [s.x * s.dot_x + s.y * s.dot_y, s.y - PLANET.mu * t.sin()];
        let mut run = begin()?;
        let expected = run.events(directions, closure)?.take(9).collect::<Result<Vec<_>, _>>()?;
        let mut run = begin()?;
        let found = run.declared_events(directions)?.take(9).collect::<Result<Vec<_>, _>>()?;
        assert_eq!(found, expected);
        assert!([0, 1].iter().all(|&index| found.iter().any(|event| event.index == index)));
        Ok(())
    }
    compare(|| Ok(Integrator::new(&PLANET, Gauss::<3>::new(), 0.1, START)?), directions)?;
    compare(|| Ok(Integrator::new(&PLANET, Variational::trapezoid(), -0.05, START)?), directions)?;
    let any = || Integrator::new(&PLANET, Variational::midpoint(), 0.05, START).map(Box::new);
    compare(|| Ok(any()? as Box<dyn Run<System = Planet, Scalar = f64>>), directions)
}

/// dg/dt of each event, beside a difference quotient of g along short steps of an accurate method.
fn check_rates<S: Lagrangian, M: Method<S, f64> + Clone>(
    system: &S,
    method: &M,
    start: &S::State<f64>,
    rate: impl Fn(f64, usize) -> Result<f64, StartError>,
) -> Outcome {
    let (t, short, count) = (0.7, 1e-3, S::REPORT.events.len());
    let values = |h: f64| -> Result<Vec<f64>, Box<dyn std::error::Error>> {
        let mut run = Integrator::new_at(system, method.clone(), t, h, start.clone())?;
        run.advance()?;
        Ok((0..count).map(|index| system.event(index, run.q(), &run.v(), run.time())).collect())
    };
    let [after, before, soon, just] =
        [values(2.0 * short)?, values(-2.0 * short)?, values(short)?, values(-short)?];
    for index in 0..count {
        let quotient = (8.0 * (soon[index] - just[index]) - (after[index] - before[index])) / (12.0 * short);
        assert_abs_diff_eq!(rate(t, index)?, quotient, epsilon = 1e-9);
    }
    assert!(rate(t, count)?.is_nan());
    Ok(())
}

#[test]
fn rates_are_those_along_the_motion() -> Outcome {
    check_rates(&PLANET, &Gauss::<4>::new(), &START, |t, index| PLANET.event_rate(t, index, &START))?;
    let prey = PreyState { x: [1.1, 0.8], y: [1.5, 2.2] };
    check_rates(&Prey, &Gauss::<4>::new(), &prey, |t, index| Prey.event_rate(t, index, &prey))?;
    let (sin, cos) = 0.4_f64.sin_cos();
    let bob = BobState { x: sin, y: -cos, dot_x: 0.9 * cos, dot_y: 0.9 * sin };
    let method = Composition::kahan_li_8(Constrained::new(Midpoint));
    check_rates(&Bob, &method, &bob, |t, index| Bob.event_rate(t, index, &bob))
}
