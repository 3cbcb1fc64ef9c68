//! States are computed again bit for bit, and runs go on where their archives end.

use std::time::Duration;

use dvi_core::methods::VariableStep;
use dvi_examples::osculating::Osculating;
use dvi_tests::Numbers;
use dvi_tests::configurations::leapfrogging;

use super::*;
use crate::checkpoints::{Edge, EdgeState};

/// Asks the archive of a run of `steps` steps, in two parts, for its state at random times and after random
/// numbers of steps.
fn check<H, M, C>(
    name: &str,
    every: Every,
    steps: u64,
    begin: impl Fn() -> Result<Integrator<H, M, f64, C>, StartError>,
) -> Outcome
where
    H: Held<System: Lagrangian> + Clone,
    M: Method<H::System, f64> + Clone + core::fmt::Debug,
    C: StepControl<H::System, f64> + Clone,
{
    let path = file(name)?;
    Archive::new(&path, begin()?, every)?.take_steps(steps / 3)?;
    let mut archive = Archive::new(&path, begin()?, every)?;
    archive.take_steps(steps - archive.run().steps())?;
    let mut run = begin()?;
    let mut trace = vec![(run.time(), place(&run))];
    for _ in 0..steps {
        run.advance()?;
        trace.push((run.time(), place(&run)));
    }
    assert_eq!(place(archive.run()), trace[steps as usize].1, "{name}");
    let mut numbers = Numbers(17);
    let mut within = |length: f64| 0.5 * (1.0 + numbers.next()) * length;
    let (start, end) = (trace[0].0, run.time());
    let is_reached = |time: f64, t: f64| if end > start { time <= t } else { time >= t };
    for _ in 0..100 {
        let t = start + within(end - start);
        let last = trace.iter().rposition(|(time, _)| is_reached(*time, t)).ok_or("no such step")?;
        assert_eq!(place(&archive.run_at(t)?), trace[last].1, "{name} at t = {t}");
        let steps = within(steps as f64) as usize;
        assert_eq!(place(&archive.run_after(steps as u64)?), trace[steps].1, "{name} after {steps} steps");
        // At the time of a step it is that step.
        assert_eq!(place(&archive.run_at(trace[steps].0)?), trace[steps].1, "{name}");
    }
    Ok(())
}

#[test]
fn states_are_computed_again_bit_for_bit() -> Outcome {
    fn of<M>(name: &str, method: M, h: f64) -> Outcome
    where
        M: VariableStep<Kepler, f64> + Clone + core::fmt::Debug,
    {
        let start = KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.8 };
        let begin = || Integrator::new_at(Kepler { mu: 1.0 }, method.clone(), 0.3, h, start);
        check(name, Every::Steps(16), 250, begin)
    }
    of("verlet", Variational::trapezoid(), 0.05)?;
    of("backwards", Variational::trapezoid(), -0.05)?;
    of("compensated", Gauss::<4>::new(), 0.2)?;
    of("composition", Composition::kahan_li_8(Variational::midpoint()), 0.3)?;
    let (vortices, start) = leapfrogging();
    let begin = || Integrator::new(&vortices, Sigma::new(0.4), 0.05, start);
    check("sigma", Every::Steps(100), 500, begin)?;
    let noise = Langevin { friction: 0.1, temperature: 0.01, seed: 5 };
    let start = KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.8 };
    check("noise", Every::Steps(70), 300, || Integrator::new(Kepler { mu: 1.0 }, noise, 0.01, start))
}

#[test]
fn so_are_those_of_controlled_steps() -> Outcome {
    fn of<M, C>(name: &str, every: u64, (method, control): (M, C), x: f64, dot_y: f64) -> Outcome
    where
        M: VariableStep<Kepler, f64> + Clone + core::fmt::Debug,
        C: StepControl<Kepler, f64> + Clone,
    {
        let start = KeplerState { x, y: 0.0, dot_x: 0.0, dot_y };
        let begin = || Integrator::controlled(Kepler { mu: 1.0 }, method.clone(), control.clone(), start);
        check(name, Every::Steps(every), 5 * every, begin)
    }
    let verlet = Variational::trapezoid();
    of("reversible", 80, (verlet, Reversible::power(0.05, 1.5)), 0.2, 3.0)?;
    of("energy-momentum", 35, (Variational::midpoint(), EnergyMomentum::new(0.05)), 1.0, 0.8)?;
    of("error-control", 40, (Gauss::<4>::new().in_lanes(), ErrorControl::new(1e-8, 0.01)), 0.2, 3.0)?;
    let limited = EnergyLimit { method: Gauss::<2>::new(), limit: 1.0 };
    of("limited", 40, (limited, ErrorControl::new(1e-5, 0.5)), 0.5, 3.0_f64.sqrt())?;
    let fitted = Variational::simpson().phase_fitted(Curvature(Reading::LeftFrozen));
    of("osculating", 40, (fitted, Osculating::new(1e-3, 0.01)), 0.5, 3.0_f64.sqrt())
}

/// How often checkpoints are kept, and in how many parts steps are taken, changes no bit.
#[test]
fn a_clock_keeps_them_too() -> Outcome {
    check("each", Every::Time(Duration::ZERO), 50, planet)?;
    check("none", Every::Time(Duration::from_secs(3600)), 50, planet)?;
    check("often", Every::Time(Duration::from_micros(50)), 3000, planet)?;
    check("step", Every::Steps(0), 50, planet)?;
    let [path, other] = [file("kept")?, file("once")?];
    let mut archive = Archive::new(&path, planet()?, Every::Steps(100))?;
    for _ in 0..250 {
        archive.take_steps(1)?;
    }
    assert_eq!(kept(&archive), [0, 100, 200]);
    archive.keep()?;
    archive.keep()?;
    assert_eq!(kept(&archive), [0, 100, 200, 250]);
    let mut once = Archive::new(&other, planet()?, Every::Steps(100))?;
    once.take_steps(250)?;
    once.keep()?;
    assert!(std::fs::read(other)? == std::fs::read(path)?);
    Ok(())
}

#[test]
fn what_the_run_has_not_seen_is_an_error() -> Outcome {
    let mut archive = Archive::new(file("unseen")?, planet()?, Every::Steps(10))?;
    archive.take_steps(25)?;
    assert_eq!(place(&archive.run_at(1.249)?), alone(planet()?, 24)?);
    // 1.15 is the time of 23 steps of 0.05, to their rounding, which is behind it.
    for steps in 1..=25 {
        assert_eq!(place(&archive.run_at(steps as f64 / 20.0)?), alone(planet()?, steps)?, "{steps} steps");
    }
    for t in [-0.01, 1.26, f64::NAN, f64::INFINITY] {
        assert!(matches!(archive.run_at(t), Err(ArchiveError::Time { .. })), "{t}");
    }
    assert!(matches!(archive.run_after(26), Err(ArchiveError::Steps { steps: 26, reached: 25 })));
    Ok(())
}

/// A planet that falls into the sun, but for what its archive has.
#[test]
fn a_step_that_fails_leaves_the_archive() -> Outcome {
    let begin = || {
        let start = KeplerState { x: 1.0, y: 0.0, dot_x: -1.0, dot_y: 0.0 };
        let limited = EnergyLimit { method: Variational::trapezoid(), limit: 1e-3 };
        Integrator::new(Kepler { mu: 1.0 }, limited, 0.01, start)
    };
    let path = file("fallen")?;
    let mut archive = Archive::new(&path, begin()?, Every::Steps(10))?;
    let Err(ArchiveError::Step(error)) = archive.take_steps(1000) else { return Err("no error".into()) };
    let kept = kept(&archive);
    assert_eq!(error.step, archive.run().steps());
    assert_eq!(kept.last(), Some(&(error.step / 10 * 10)));
    assert_eq!(place(&archive.run_after(error.step)?), alone(begin()?, error.step)?);
    drop(archive);
    assert_eq!(Archive::new(&path, begin()?, Every::Steps(10))?.run().steps(), error.step / 10 * 10);
    Ok(())
}

#[test]
fn a_run_that_ends_where_none_begins_is_there_again() -> Outcome {
    let path = file("edge")?;
    let start = EdgeState { x: -0.5, dot_x: 0.0 };
    let begin = || Integrator::controlled(&Edge, Gauss::<4>::new(), ErrorControl::new(1e-8, 0.05), start);
    let mut archive = Archive::new(&path, begin()?, Every::Steps(1))?;
    let error = archive.take_steps(1000).err().ok_or("it comes to x = 1")?;
    let (steps, end) = (archive.run().steps(), bits(archive.run().q()));
    assert!(matches!(error, ArchiveError::Step { .. }), "{error}");
    assert_eq!(bits(archive.run_after(steps)?.q()), end);
    drop(archive);
    let mut again = Archive::new(&path, begin()?, Every::Steps(1))?;
    assert_eq!(again.run().steps() + 1, steps);
    assert!(again.take_steps(1000).is_err());
    assert_eq!((again.run().steps(), bits(again.run().q())), (steps, end));
    Ok(())
}
