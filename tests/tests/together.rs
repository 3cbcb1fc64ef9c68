//! Runs taken together in lanes are the runs alone, bit for bit, whatever becomes of the others.

mod parameters;

use dvi_core::methods::InStep;
use dvi_core::prelude::*;
use dvi_tests::configurations::{chaotic, quasi_periodic};
use dvi_tests::systems::*;
use dvi_tests::zoo::regular::*;
use dvi_tests::{Outcome, bits};

/// Takes the steps of `strides` with runs together in packs of `W`, which have room for those of as many
/// coordinates as the first, and with the same runs alone. Returns the errors.
pub(crate) fn held_together<const W: usize, H, S, M>(
    begin: impl Fn() -> Outcome<Vec<Integrator<H, M>>>,
    strides: &[u64],
) -> Outcome<Vec<Option<StepError>>>
where
    H: Held<System = S>,
    S: Lagrangian + PartialEq,
    M: InStep<W, S> + PartialEq,
{
    let (mut together, mut alone) = (begin()?, begin()?);
    let mut packs = Together::<W, _, _>::new(&together[0]);
    let mut errors = vec![None; together.len()];
    for &count in strides {
        let results = packs.take_steps(&mut together, count);
        for (j, (run, result)) in alone.iter_mut().zip(results).enumerate() {
            // No number is equal to itself.
            assert_eq!(format!("{:?}", run.take_steps(count)), format!("{result:?}"), "run {j}");
            errors[j] = errors[j].or(result.err());
        }
        for (j, (one, other)) in alone.iter().zip(&together).enumerate() {
            let name = S::REPORT.system;
            // A run that has ended holds points beyond its end, which it tried.
            if errors[j].is_none() {
                assert_eq!(one.checkpoint(), other.checkpoint(), "{name}, run {j} of {W} lanes");
            }
            assert_eq!(one.statistics(), other.statistics(), "{name}, run {j} of {W} lanes");
            assert_eq!(bits(one.q()), bits(other.q()), "{name}, run {j} of {W} lanes");
        }
    }
    Ok(errors)
}

/// The same of runs of one method and one step, on each system from each start.
pub(crate) fn same_as_alone<
    const W: usize,
    S: Lagrangian + PartialEq,
    M: InStep<W, S> + PartialEq + Clone,
>(
    runs: &[(&S, S::State<f64>)],
    method: &M,
    h: f64,
    strides: &[u64],
) -> Outcome<Vec<Option<StepError>>> {
    let begin = |(system, start): &(_, S::State<f64>)| {
        Integrator::new(*system, method.clone(), h, start.clone()).map_err(Into::into)
    };
    held_together::<W, _, _, _>(|| runs.iter().map(begin).collect(), strides)
}

const STRIDES: [u64; 7] = [1, 2, 5, 300, 1, 150, 3];

/// In packs that fill registers, of which the last is not full.
fn in_lanes<S: Lagrangian + PartialEq, M>(
    system: &S,
    method: &M,
    h: f64,
    starts: &[S::State<f64>],
) -> Outcome<Vec<Option<StepError>>>
where
    M: InStep<8, S> + PartialEq + Clone,
{
    let runs: Vec<_> = starts.iter().map(|start| (system, start.clone())).collect();
    same_as_alone::<8, _, _>(&runs, method, h, &STRIDES)
}

fn vortices(count: usize) -> Vec<PointVorticesState<4>> {
    let (_, start) = quasi_periodic();
    let moved = |j: usize| {
        let mut start = start;
        start.x[0] += 0.01 * j as f64;
        start.y[2] -= 0.003 * j as f64;
        start
    };
    (0..count).map(moved).collect()
}

#[test]
fn sigma_is_the_same_in_lanes() -> Outcome {
    let (system, _) = quasi_periodic();
    let starts = vortices(11);
    for method in [
        Sigma::leapfrog(),
        Sigma { parasitic_limit: None, ..Sigma::leapfrog() },
        Sigma { start: Start::RungeKutta(RungeKutta::midpoint()), ..Sigma::leapfrog() },
        Sigma::midpoint(),
        Sigma { start: Start::RungeKutta(RungeKutta::midpoint()), ..Sigma::midpoint() },
        Sigma { stopping: Stopping { tolerance: 1e-9, ..Stopping::default() }, ..Sigma::midpoint() },
        // Those without lanes.
        Sigma { summation: Summation::Compensated, ..Sigma::midpoint() },
        Sigma { solver: Solver::Newton, ..Sigma::midpoint() },
        Sigma::new(0.3),
        Sigma::new(1.0),
    ] {
        in_lanes(&system, &method, 0.05, &starts)?;
    }
    // In packs of one, and of such as fill no register.
    let runs: Vec<_> = starts.iter().map(|start| (&system, *start)).collect();
    for method in [Sigma::leapfrog(), Sigma::midpoint()] {
        same_as_alone::<1, _, _>(&runs, &method, 0.05, &STRIDES)?;
        same_as_alone::<3, _, _>(&runs, &method, 0.05, &STRIDES)?;
    }
    // A Newton step now and then, and a Dα that is not antisymmetric.
    in_lanes(&system, &Sigma::midpoint(), 0.9, &starts)?;
    let oblique = |j: u32| ObliqueState { x: 1.0 + 0.1 * f64::from(j), y: 0.3 };
    let starts: Vec<ObliqueState> = (0..5).map(oblique).collect();
    in_lanes(&Oblique, &Sigma::midpoint(), 0.1, &starts)?;
    let curved = |j: u32| CurvedState { x: 0.4 + 0.02 * f64::from(j), y: 0.1 };
    in_lanes(&Curved { kappa: 0.3 }, &Sigma::midpoint(), 0.05, &(0..4).map(curved).collect::<Vec<_>>())?;
    Ok(())
}

/// Two vortices are too near one another for the step, the parasitic mode takes over, a force is no number:
/// each on its own.
#[test]
fn one_that_fails_does_not_disturb_the_others() -> Outcome {
    let (system, _) = quasi_periodic();
    let mut starts = vortices(10);
    starts[5].x[1] = starts[5].x[0] + 1e-3;
    starts[5].y[1] = starts[5].y[0];
    let method = Sigma { solver: Solver::FixedPoint, ..Sigma::midpoint() };
    let errors = in_lanes(&system, &method, 0.1, &starts)?;
    let failed: Vec<usize> = errors.iter().enumerate().filter_map(|(j, error)| error.map(|_| j)).collect();
    assert_eq!(failed, [5], "{errors:?}");
    // The mode of the chaotic ones takes over at different times.
    let (system, start) = chaotic();
    let moved = |j: u32| {
        let mut start = start;
        start.x[0] += 0.01 * f64::from(j);
        start
    };
    let starts: Vec<_> = (0..7).map(moved).collect();
    let method = Sigma { start: Start::RungeKutta(RungeKutta::midpoint()), ..Sigma::leapfrog() };
    let errors = in_lanes(&system, &method, 0.1, &starts)?;
    assert!(errors.iter().flatten().count() > 0, "{errors:?}");
    // One is so fast that a step leads it to where the force is no number.
    #[lagrangian(coordinates(x), lagrangian = dot(x).powi(2) / 2.0 + (1.0 - x).sqrt())]
    #[derive(PartialEq)]
    struct Slope;
    let fast = |j: u32| SlopeState { x: 0.0, dot_x: if j == 3 { 5.0 } else { 0.1 * f64::from(j) } };
    let starts: Vec<SlopeState> = (0..9).map(fast).collect();
    let errors = in_lanes(&Slope, &Variational::trapezoid(), 0.05, &starts)?;
    let failed: Vec<usize> = errors.iter().enumerate().filter_map(|(j, error)| error.map(|_| j)).collect();
    assert_eq!(failed, [3], "{errors:?}");
    Ok(())
}

#[test]
fn verlet_is_the_same_in_lanes() -> Outcome {
    let planet = |j: u32| KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.7 + 0.05 * f64::from(j) };
    let starts: Vec<KeplerState> = (0..9).map(planet).collect();
    let kepler = Kepler { mu: 1.0 };
    in_lanes(&kepler, &Variational::trapezoid(), 0.05, &starts)?;
    let runs: Vec<_> = starts.iter().map(|start| (&kepler, *start)).collect();
    same_as_alone::<1, _, _>(&runs, &Variational::trapezoid(), 0.05, &STRIDES)?;
    same_as_alone::<3, _, _>(&runs, &Variational::trapezoid(), 0.05, &STRIDES)?;
    // Those without lanes.
    in_lanes(&kepler, &Variational::midpoint(), 0.05, &starts)?;
    let compensated = Variational { summation: Summation::Compensated, ..Variational::trapezoid() };
    in_lanes(&kepler, &compensated, 0.05, &starts)?;
    // With time, with a full mass matrix, and at run time.
    let driven = DrivenOscillator { depth: 0.4, omega: 1.3 };
    let starts =
        (0..5).map(|j| DrivenOscillatorState { x: 0.1 * f64::from(j), dot_x: 0.2 }).collect::<Vec<_>>();
    in_lanes(&driven, &Variational::trapezoid(), 0.1, &starts)?;
    let chain = RunTimeChain { mass: vec![1.0, 1.5, 0.8], coupling: 0.2 };
    let state = |j: u32| RunTimeChainState {
        q: vec![0.1 * f64::from(j), 0.3, -0.2],
        wall: 0.4,
        dot_q: vec![0.2, -0.1, 0.3],
        dot_wall: 0.0,
    };
    in_lanes(&chain, &Variational::trapezoid(), 0.05, &(0..3).map(state).collect::<Vec<_>>())?;
    let free = RunTimeChain { coupling: 0.0, ..chain };
    in_lanes(&free, &Variational::trapezoid(), 0.05, &(0..6).map(state).collect::<Vec<_>>())?;
    Ok(())
}

/// Runs of other systems, methods, steps or times share no lanes with the others.
#[test]
fn runs_that_are_not_in_step_are_taken_alone() -> Outcome {
    let (one, other) = (Kepler { mu: 1.0 }, Kepler { mu: 2.0 });
    let start = KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.9 };
    held_together::<4, _, _, _>(
        || {
            let compensated = Variational { summation: Summation::Compensated, ..Variational::trapezoid() };
            let mut ahead = Integrator::new(&one, Variational::trapezoid(), 0.05, start)?;
            ahead.take_steps(3)?;
            Ok(vec![
                Integrator::new(&one, Variational::trapezoid(), 0.05, start)?,
                Integrator::new(&other, Variational::trapezoid(), 0.05, start)?,
                Integrator::new(&one, Variational::trapezoid(), 0.04, start)?,
                Integrator::new(&one, compensated, 0.05, start)?,
                ahead,
                Integrator::new_at(&one, Variational::trapezoid(), 1.0, 0.05, start)?,
            ])
        },
        &[400],
    )?;
    Ok(())
}

#[test]
fn runs_of_other_sizes_are_taken_alone() -> Outcome {
    for sizes in [[2, 3, 3, 5], [3, 3, 5, 2], [5, 2, 3, 3]] {
        let systems = sizes.map(|n| Springs { k: vec![1.5; n] });
        let state = |n: usize| SpringsState { x: vec![0.3; n], dot_x: vec![0.1; n] };
        let runs: Vec<_> = systems.iter().map(|system| (system, state(system.k.len()))).collect();
        let errors = same_as_alone::<4, _, _>(&runs, &Variational::trapezoid(), 0.1, &[40])?;
        assert!(errors.iter().all(Option::is_none), "{errors:?}");
    }
    Ok(())
}
