//! Compositions of the implicit midpoint rule: orders, reversal, and failures that leave no trace.

use approx::abs_diff_eq;
use dvi_core::error::{CheckpointError, StepFailure};
use dvi_core::methods::{Carries, Composition, Method, Scheme, VariableStep};
use dvi_core::prelude::*;
use dvi_core::state::{Memory, Reader, Record, Statistics};
use dvi_tests::larger;
use dvi_tests::systems::{PointVortices, PointVorticesState};

type Outcome = Result<(), Box<dyn core::error::Error>>;

/// Predators y and prey x; leaves its domain where x or y is negative.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = y.ln() / x * d(x),
    hamiltonian = x + y - x.ln() - 2.0 * y.ln(),
)]
#[derive(Debug)]
pub(crate) struct LotkaVolterra {}

fn compositions<const S: usize>() -> [Composition<Gauss<S>>; 6] {
    let method = Gauss::<S>::new();
    [
        Composition::triple_jump(method),
        Composition::suzuki(method),
        Composition::yoshida(method),
        Composition::kahan_li_6(method),
        Composition::suzuki_umeno(method),
        Composition::kahan_li_8(method),
    ]
}

fn lotka_volterra<M: Method<LotkaVolterra, f64>>(
    method: M,
    (time, steps): (f64, u64),
) -> Result<[f64; 2], Box<dyn core::error::Error>> {
    let system = LotkaVolterra {};
    let start = LotkaVolterraState { x: 1.0, y: 1.0 };
    let mut run = Integrator::new(&system, method, time / steps as f64, start)?;
    run.take_steps(steps)?;
    Ok([run.q()[0], run.q()[1]])
}

/// By regression over errors between those of long steps and rounding, against Gauss collocation of order
/// sixteen.
#[test]
fn the_midpoint_rule_gains_the_order_of_the_composition() -> Outcome {
    let steps = [(1.0, 24), (1.0, 24), (1.0, 12), (1.0, 8), (3.0, 12), (3.0, 12)];
    for (method, (time, steps)) in compositions::<1>().into_iter().zip(steps) {
        let reference = lotka_volterra(Gauss::<8>::new(), (time, 160))?;
        let mut errors = Vec::new();
        for steps in [steps, steps * 5 / 4, steps * 3 / 2, 2 * steps] {
            let end = lotka_volterra(method, (time, steps))?;
            let error = larger((end[0] - reference[0]).abs(), (end[1] - reference[1]).abs());
            errors.push((time / steps as f64, error));
        }
        let (order, name) = (convergence_order(&errors).ok_or("no slope")?, method.name());
        assert!(abs_diff_eq!(order, method.order() as f64, epsilon = 0.1), "{name}: {order}, {errors:?}");
    }
    Ok(())
}

#[test]
fn a_step_back_undoes_a_step() -> Outcome {
    let system = LotkaVolterra {};
    let start = LotkaVolterraState { x: 1.0, y: 1.0 };
    for method in compositions::<1>() {
        let mut there = Integrator::new(&system, method, 0.05, start)?;
        there.take_steps(20)?;
        let mut back = Integrator::new(&system, method, -0.05, there.state())?;
        back.take_steps(20)?;
        let end: LotkaVolterraState = back.state();
        assert!(larger((end.x - 1.0).abs(), (end.y - 1.0).abs()) < 1e-13, "{}: {end:?}", method.name());
    }
    Ok(())
}

/// Fails at a chosen step, and else is the method within.
#[derive(Clone, Copy, Debug)]
struct Failing {
    method: Gauss<1>,
    at: u64,
}

const FAILURE: StepFailure = StepFailure::Singular { column: 7, pivot: 0.0 };

impl Scheme for Failing {
    fn order(&self) -> usize {
        2
    }
    fn is_symmetric(&self) -> bool {
        true
    }
    fn preserved_form(&self) -> dvi_core::methods::PreservedForm {
        self.method.preserved_form()
    }
}

type Gauss1Memory = <Gauss<1> as Carries<LotkaVolterra, f64>>::Memory;
type Point = dvi_core::Vector<LotkaVolterra, f64>;

/// The memory of the method within, and how often a step was asked for, which no restoring takes back.
struct FailingMemory(Gauss1Memory, u64);

impl Memory<f64> for FailingMemory {
    fn restore(&mut self, from: &Self) {
        self.0.restore(&from.0);
    }
    fn save(&self, record: &mut Record<f64>) {
        self.0.save(record);
    }
    fn load(&mut self, reader: &mut Reader<'_, f64>) -> Result<(), CheckpointError> {
        self.0.load(reader)
    }
}

impl Carries<LotkaVolterra, f64> for Failing {
    type Memory = FailingMemory;
}

impl Method<LotkaVolterra, f64> for Failing {
    fn begin(
        &self,
        system: &LotkaVolterra,
        q: &Point,
        v: &[f64],
        t: f64,
        h: f64,
    ) -> Result<Self::Memory, dvi_core::error::StartError> {
        Ok(FailingMemory(self.method.begin(system, q, v, t, h)?, 0))
    }

    fn step(
        &self,
        system: &LotkaVolterra,
        memory: &mut Self::Memory,
        q: &mut Point,
        t: f64,
        h: f64,
        statistics: &mut Statistics,
    ) -> Result<(), StepFailure> {
        memory.1 += 1;
        if memory.1 == self.at {
            Err(FAILURE)
        } else {
            self.method.step(system, &mut memory.0, q, t, h, statistics)
        }
    }
}

impl VariableStep<LotkaVolterra, f64> for Failing {}

#[test]
fn a_failure_on_the_way_leaves_no_trace() -> Outcome {
    let (system, start) = (LotkaVolterra {}, LotkaVolterraState { x: 1.0, y: 1.0 });
    // The first step takes seven; the second fails at each of its own in turn, and is tried again.
    for at in 8..=14 {
        let failing = Failing { method: Gauss::new(), at };
        let mut tried = Integrator::new(&system, Composition::yoshida(failing), 0.1, start)?;
        let mut smooth = Integrator::new(&system, Composition::yoshida(Gauss::<1>::new()), 0.1, start)?;
        tried.advance()?;
        smooth.advance()?;
        assert_eq!(tried.advance().map_err(|error| error.failure), Err(FAILURE));
        assert_eq!((tried.q(), tried.steps()), (smooth.q(), 1));
        tried.advance()?;
        smooth.advance()?;
        // Bit by bit, which the guesses of the iteration enter too.
        assert_eq!(tried.q(), smooth.q(), "{at}");
    }
    Ok(())
}

/// Time enters: H = −½ (x² + y²) cos t turns the plane by the angle sin t.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form    = y * d(x),
    hamiltonian = 0.5 * (x * x + y * y) * t.cos(),
)]
#[derive(Debug)]
pub(crate) struct Swing {}

#[test]
fn every_part_of_a_step_begins_at_its_own_time() -> Outcome {
    let (system, angle) = (Swing {}, 2.0_f64.sin());
    for method in compositions::<1>() {
        let start = SwingState { x: 1.0, y: 0.0 };
        let mut run = Integrator::new(&system, method, 0.02, start)?;
        run.take_steps(100)?;
        let end: SwingState = run.state();
        let error = larger((end.x - angle.cos()).abs(), (end.y.abs() - angle.sin().abs()).abs());
        assert!(error < 1e-5, "{}: {error:e}", method.name());
    }
    Ok(())
}

#[test]
fn compositions_nest() -> Outcome {
    let (system, start): (PointVortices<4>, PointVorticesState<4>) = dvi_tests::configurations::chaotic();
    let nested = Composition::suzuki(Composition::triple_jump(Gauss::<1>::new()));
    let flat = Composition::kahan_li_8(Gauss::<1>::new());
    let mut fine = Integrator::new(&system, nested, 0.002, start)?;
    let mut coarse = Integrator::new(&system, flat, 0.01, start)?;
    fine.take_steps(500)?;
    coarse.take_steps(100)?;
    for (a, b) in fine.q().iter().zip(coarse.q()) {
        assert!(abs_diff_eq!(a, b, epsilon = 1e-7), "{a} {b}");
    }
    Ok(())
}
