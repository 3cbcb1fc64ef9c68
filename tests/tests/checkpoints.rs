//! What runs go on from, beside what the law of checkpoints asks of every scheme and archives of step
//! controls.

use dvi_core::error::CheckpointError;
use dvi_core::field::{Axis, Spline};
use dvi_core::methods::Method;
use dvi_core::prelude::*;
use dvi_examples::osculating::Osculating;
use dvi_tests::Outcome;
use dvi_tests::configurations::leapfrogging;
use dvi_tests::systems::*;
use dvi_tests::zoo::constrained::{Pendulum, PendulumState};
use dvi_tests::zoo::regular::{KEPLER, KeplerState, KeplerStateOf, RunTimeChain};

/// As a text, and back.
fn written_and_read(checkpoint: &Checkpoint) -> Result<Checkpoint, serde_json::Error> {
    let read = serde_json::from_str(&serde_json::to_string(checkpoint)?)?;
    assert_eq!(&read, checkpoint);
    Ok(read)
}

/// A start of the leapfrog takes a step, beyond the end of the table too; a checkpoint needs none, with a
/// limit of the energy either.
#[test]
fn runs_go_on_from_the_end_of_a_table() -> Outcome {
    #[degenerate_lagrangian(
        coordinates(q, p),
        one_form = (p * d(q) - q * d(p)) / 2.0,
        hamiltonian = (p * p + q * q) / 2.0 - q * push(t),
    )]
    struct Pushed {
        push: Spline<1>,
    }
    fn check<M: Method<Pushed, f64> + Copy>(system: &Pushed, method: M) -> Outcome {
        let mut run = Integrator::new(system, method, 0.125, PushedState { q: 1.0, p: 0.0 })?;
        run.take_steps(8)?;
        let again = Integrator::resume(system, method, &run.checkpoint())?;
        assert_eq!((again.state(), again.checkpoint()), (run.state(), run.checkpoint()));
        assert_eq!(run.dense()?.state_at(1.0)?, again.state());
        Ok(())
    }
    let push = Spline::sample([Axis::uniform([0.0, 1.0], 11)?], |[t]| t.sin())?;
    let system = Pushed { push };
    check(&system, Sigma::leapfrog())?;
    check(&system, EnergyLimit { method: Sigma::leapfrog(), limit: 1.0 })
}

/// A pendulum, whose steps leave as much of its constraint as their tolerance allows.
const PENDULUM: Pendulum = Pendulum { m: 1.0, g: 9.8, length: 1.0 };

#[test]
fn constrained_runs_of_a_loose_tolerance_go_on_from_everywhere() -> Outcome {
    fn check<M: Method<Pendulum, f64> + Copy>(method: M, h: f64) -> Outcome {
        let start = PendulumState { x: 0.6, y: -0.8, dot_x: 0.8, dot_y: 0.6 };
        let mut run = Integrator::new(&PENDULUM, method, h, start)?;
        for _ in 0..100 {
            run.advance()?;
            let mut again = Integrator::resume(&PENDULUM, method, &run.checkpoint())?;
            let before = run.checkpoint();
            run.advance()?;
            again.advance()?;
            assert_eq!(again.checkpoint(), run.checkpoint());
            run = Integrator::resume(&PENDULUM, method, &before)?;
        }
        // A start that is farther away is not one.
        let away = PendulumState { x: 0.61, y: -0.8, dot_x: 0.8, dot_y: 0.6 };
        let refused = Integrator::new(&PENDULUM, method, h, away).err();
        assert!(matches!(refused, Some(StartError::OffConstraint { .. })), "{refused:?}");
        Ok(())
    }
    for tolerance in [1e-4, 1e-6, 1e-8, 1e-12] {
        let stopping = Stopping { tolerance, ..Stopping::default() };
        for h in [0.03, 0.1, 0.2] {
            check(Rattle { stopping, ..Rattle::default() }, h)
                .map_err(|error| format!("RATTLE, {tolerance:e}, {h}: {error}"))?;
            let constrained = Constrained { stopping, ..Constrained::new(Midpoint) };
            check(constrained, h).map_err(|error| format!("{tolerance:e}, {h}: {error}"))?;
        }
    }
    Ok(())
}

/// The density that a run carries is not the one that it would begin with: near the centre that is not even
/// positive.
#[test]
fn controlled_runs_go_on_from_everywhere() -> Outcome {
    let start = KeplerState { x: 1.95, y: 0.0, dot_x: 0.0, dot_y: (0.05_f64 / 1.95).sqrt() };
    let control = Reversible { start: Some(1.95_f64.powf(-1.5)), ..Reversible::power(0.02, 1.5) };
    let mut run = Integrator::controlled(&KEPLER, Variational::trapezoid(), control, start)?;
    for step in 0..600 {
        run.advance()?;
        let mut again =
            Integrator::resume_controlled(&KEPLER, Variational::trapezoid(), control, &run.checkpoint())
                .map_err(|error| format!("after step {step}: {error}"))?;
        again.advance()?;
    }
    Ok(())
}

/// The step of a run is halved on the way: its time goes on, and its energy stays where a run of such steps
/// has it.
#[test]
fn a_run_goes_on_with_another_step() -> Outcome {
    let start = KeplerState { x: 0.5, y: 0.0, dot_x: 0.0, dot_y: 3.0_f64.sqrt() };
    let mut run = Integrator::new(&KEPLER, Variational::trapezoid(), 0.01, start)?;
    run.take_steps(100)?;
    let checkpoint = run.checkpoint().with_step_size(0.005);
    let mut slow = Integrator::resume(&KEPLER, Variational::trapezoid(), &checkpoint)?;
    assert_eq!((slow.q(), slow.time(), slow.steps()), (run.q(), run.time(), 100));
    slow.take_steps(200)?;
    assert_eq!(slow.time(), 2.0);
    let mut same = Integrator::new_at(&KEPLER, Variational::trapezoid(), run.time(), 0.005, run.state())?;
    same.take_steps(200)?;
    let distance = |a: &[f64], b: &[f64]| (a[0] - b[0]).abs() + (a[1] - b[1]).abs();
    assert!(distance(slow.q(), same.q()) < 1e-13);
    Ok(())
}

#[test]
fn a_checkpoint_of_another_run_is_refused() -> Outcome {
    let refused = |error: Option<StartError>| match error {
        Some(StartError::Checkpoint(error)) => Ok(error),
        other => Err(format!("{other:?}")),
    };
    let start = KeplerState { x: 0.5, y: 0.0, dot_x: 0.0, dot_y: 3.0_f64.sqrt() };
    let checkpoint = Integrator::new(&KEPLER, Variational::trapezoid(), 0.01, start)?.checkpoint();
    let other = Integrator::resume(&KEPLER, Galerkin::<3>::new(), &checkpoint).err();
    assert_eq!(refused(other)?, CheckpointError::Short);
    let fuller = Integrator::new(&KEPLER, Galerkin::<3>::new(), 0.01, start)?.checkpoint();
    let other = Integrator::resume(&KEPLER, Variational::trapezoid(), &fuller).err();
    assert!(matches!(refused(other)?, CheckpointError::Long { more } if more > 0));
    let chain = RunTimeChain { mass: vec![1.0, 2.0, 3.0], coupling: 0.125 };
    let other = Integrator::resume(&chain, Variational::trapezoid(), &checkpoint).err();
    assert_eq!(refused(other)?, CheckpointError::Size { what: "coordinates", expected: 4, found: 2 });
    // A control carries more than steps of one length do.
    let control = Reversible::power(0.01, 1.5);
    let other = Integrator::resume_controlled(&KEPLER, Variational::trapezoid(), control, &checkpoint).err();
    assert_eq!(refused(other)?, CheckpointError::Short);
    let of_gauss = Integrator::new(&KEPLER, Gauss::<2>::new(), 0.01, start)?.checkpoint();
    let control = ErrorControl::new(1e-9, 0.01);
    let other = Integrator::resume_controlled(&KEPLER, Gauss::<2>::new(), control, &of_gauss).err();
    assert_eq!(refused(other)?, CheckpointError::Short);
    // Steps of no length, and those that do not move the time.
    let mut run = Integrator::resume(&KEPLER, Variational::trapezoid(), &checkpoint)?;
    run.take_steps(100)?;
    for h in [0.0, 1e-17] {
        let checkpoint = run.checkpoint().with_step_size(h);
        let beyond = Integrator::resume(&KEPLER, Variational::trapezoid(), &checkpoint).err();
        assert!(matches!(beyond, Some(StartError::Step { .. })), "{beyond:?}");
    }
    Ok(())
}

/// V falls without bound at x = 1, where the energy is finite.
#[lagrangian(coordinates(x), lagrangian = dot(x) * dot(x) / 2.0 + (1.0 - x * x).sqrt() + 2.0 * x)]
#[derive(Clone, Debug)]
pub(crate) struct Edge;

#[test]
fn where_a_force_is_infinite_no_run_goes_on_and_that_is_said() -> Outcome {
    let control = ErrorControl::new(1e-8, 0.05);
    let start = EdgeState { x: -0.5, dot_x: 0.0 };
    let mut run = Integrator::controlled(&Edge, Gauss::<4>::new(), control, start)?;
    assert!(run.take_steps(1000).is_err());
    assert_eq!(run.q(), [1.0]);
    let error = Integrator::resume_controlled(&Edge, Gauss::<4>::new(), control, &run.checkpoint()).err();
    let Some(StartError::Undefined { quantity, value, .. }) = error else { panic!("{error:?}") };
    assert_eq!((quantity, value), ("the force ∂L/∂q", f64::NEG_INFINITY));
    Ok(())
}

#[test]
fn a_checkpoint_has_the_velocities_of_a_regular_system() -> Outcome {
    let start = KeplerState { x: 0.5, y: 0.0, dot_x: 0.0, dot_y: 3.0_f64.sqrt() };
    let checkpoint = Integrator::new(&KEPLER, Variational::trapezoid(), 0.01, start)?.checkpoint();
    assert_eq!((checkpoint.q(), checkpoint.v()), (&[0.5, 0.0][..], &[0.0, 3.0_f64.sqrt()][..]));
    Ok(())
}

/// The checksum of a checkpoint, computed once more: from the offset of FNV on, each word is multiplied by
/// 2⁶⁴ over the golden ratio, and 53 bits are kept.
fn checksum(written: &serde_json::Value) -> Option<u64> {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    let mut take = |word: u64| {
        hash = (hash ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        hash ^= hash >> 32;
    };
    let list = |place: &str| written.pointer(place)?.as_array();
    let ends = vec![written["time"].clone(), written["step_size"].clone()];
    for list in [list("/q")?, list("/v")?, &ends, list("/record/numbers")?] {
        take(list.len() as u64);
        list.iter().try_for_each(|number| number.as_f64().map(|number| take(number.to_bits())))?;
    }
    take(written["velocities"].as_u64()?);
    let statistics = ["steps", "rejected", "iterations", "gradients", "linearizations", "factorisations"];
    let counts = statistics.iter().map(|name| &written["statistics"][name]).chain(list("/record/counts")?);
    counts.map(serde_json::Value::as_u64).try_for_each(|count| count.map(&mut take))?;
    Some(hash >> 11)
}

/// Resumes from a checkpoint with one number or count after the other damaged, and tells how many were
/// refused; of the others all that can be said is that they end. Each damage is seen before that, unless its
/// checksum is forged.
fn damaged(
    whole: &Checkpoint,
    resume: impl Fn(&Checkpoint) -> Result<(), StartError>,
) -> Result<[usize; 2], serde_json::Error> {
    let whole = serde_json::to_value(whole)?;
    assert_eq!(whole["checksum"].as_u64(), checksum(&whole));
    let (mut tried, mut refused) = (0, 0);
    let mut attempt = |place: &str, value: serde_json::Value| -> Result<(), serde_json::Error> {
        let mut broken = whole.clone();
        if let Some(entry) = broken.pointer_mut(place) {
            *entry = value;
        }
        if broken != whole {
            let seen = serde_json::from_value::<Checkpoint>(broken.clone()).map(drop);
            assert!(seen.is_err_and(|error| error.to_string() == CheckpointError::Changed.to_string()));
        }
        broken["checksum"] = checksum(&broken).into();
        tried += 1;
        let forged = serde_json::from_value::<Checkpoint>(broken)?;
        refused += usize::from(resume(&forged).is_err());
        Ok(())
    };
    let length = |name: &str| whole["record"][name].as_array().map_or(0, Vec::len);
    for place in 0..length("counts") {
        for count in [3, 1_000_000_007, (1 << 32) + 3, u64::MAX] {
            attempt(&format!("/record/counts/{place}"), count.into())?;
        }
    }
    for place in 0..length("numbers") {
        for number in [-1.0, 0.0, 1e300] {
            attempt(&format!("/record/numbers/{place}"), number.into())?;
        }
    }
    attempt("/velocities", u64::MAX.into())?;
    for name in ["steps", "iterations", "gradients", "linearizations", "factorisations"] {
        attempt(&format!("/statistics/{name}"), u64::MAX.into())?;
    }
    for name in ["time", "step_size"] {
        attempt(&format!("/{name}"), 7.5.into())?;
    }
    Ok([tried, refused])
}

/// With another step it is a checkpoint as before, in double and in single precision, and numbers that JSON
/// cannot write are errors.
#[test]
fn a_changed_step_can_be_written() -> Outcome {
    let start = KeplerStateOf { x: 0.7_f32, y: 0.2, dot_x: 0.3, dot_y: 1.1 };
    let mut run = Integrator::new(&KEPLER, Gauss::<2>::new(), 0.05, start)?;
    run.take_steps(7)?;
    let checkpoint = run.checkpoint().with_step_size(0.1);
    let text = serde_json::to_string(&checkpoint)?;
    assert_eq!(serde_json::from_str::<Checkpoint<f32>>(&text)?, checkpoint);
    // The decimal fraction that stands for a number in single precision is another number in double
    // precision.
    assert!(serde_json::from_str::<Checkpoint>(&text).is_err(), "{text}");
    let text = serde_json::to_string(&checkpoint.with_step_size(f32::NAN))?;
    assert!(serde_json::from_str::<Checkpoint<f32>>(&text).is_err(), "{text}");
    Ok(())
}

fn check_damaged<R: Run<Scalar = f64>>(
    mut run: R,
    [steps, least]: [u64; 2],
    resume: impl Fn(&Checkpoint) -> Result<R, StartError>,
) -> Outcome {
    run.take_steps(steps)?;
    let [tried, refused] = damaged(&run.checkpoint(), |checkpoint| {
        resume(checkpoint)?.take_steps(30).ok();
        Ok(())
    })?;
    assert!(refused as u64 >= least && refused < tried, "{refused} of {tried}");
    Ok(())
}

#[test]
fn a_damaged_checkpoint_is_no_panic() -> Outcome {
    let (pairs, start) = leapfrogging();
    // Five counts of cost and the time at least.
    const LEAST: [u64; 2] = [300, 6];
    for method in [Sigma::leapfrog(), Sigma::new(0.25), Sigma::midpoint()] {
        let run = Integrator::new(&pairs, method, 0.05, start)?;
        check_damaged(run, LEAST, |checkpoint| Integrator::resume(&pairs, method, checkpoint))?;
    }
    let planet = KeplerState { x: 0.7, y: 0.2, dot_x: 0.3, dot_y: 1.1 };
    let run = Integrator::new(&KEPLER, Variational::simpson(), 0.05, planet)?;
    check_damaged(run, LEAST, |checkpoint| Integrator::resume(&KEPLER, Variational::simpson(), checkpoint))?;
    let (verlet, control) = (Variational::trapezoid(), Osculating::new(1e-3, 0.01));
    let start = KeplerState { x: 0.5, y: 0.0, dot_x: 0.0, dot_y: 3.0_f64.sqrt() };
    let run = Integrator::controlled(&KEPLER, verlet, control, start)?;
    let resume = |checkpoint: &_| Integrator::resume_controlled(&KEPLER, verlet, control, checkpoint);
    check_damaged(run, [50, 12], resume)
}

/// On a straight path the relative size of the parasitic mode is no number, and is written all the same.
#[test]
fn a_run_on_a_straight_path_can_be_written() -> Outcome {
    let pair = PointVortices { gamma: [1.0, -1.0] };
    let start = PointVorticesState { x: [0.0, 0.0], y: [0.5, -0.5] };
    for sigma in [0.0, 0.25] {
        let mut run = Integrator::new(&pair, Sigma::new(sigma), 0.125, start)?;
        for _ in 0..2000 {
            run.advance()?;
            written_and_read(&run.checkpoint())?;
        }
    }
    Ok(())
}

#[test]
fn a_system_with_velocities_does_not_go_on_from_a_checkpoint_without_any() -> Outcome {
    let (oscillator, start) = (Oscillator { omega: 1.0 }, OscillatorState { x: 0.5, y: 1.0 });
    let run = Integrator::new(&oscillator, RungeKutta::classical(), 0.1, start)?;
    let error = Integrator::resume(&KEPLER, RungeKutta::classical(), &run.checkpoint()).err();
    let expected = CheckpointError::Size { what: "velocities", expected: 2, found: 0 };
    assert_eq!(error, Some(StartError::Checkpoint(expected)));
    Ok(())
}
