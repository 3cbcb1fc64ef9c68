//! Runs that own their system or share it, and runs whose method is chosen when the program runs: each is,
//! bit for bit, the run that borrows.

use std::rc::Rc;
use std::sync::Arc;
use std::thread;

use dvi_core::methods::VariableStep;
use dvi_core::prelude::*;
use dvi_tests::configurations::leapfrogging;
use dvi_tests::zoo::regular::{KEPLER, Kepler, KeplerState};
use dvi_tests::{Outcome, bits};

use crate::together::held_together;

const STEPS: u64 = 100;
const START: KeplerState = KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.8 };

/// The end of a run, as a checkpoint, which has all of it, and the state.
type End<S> = (Checkpoint, S);

fn end<R: Run<Scalar = f64>>(mut run: R) -> Result<End<<R::System as System>::State<f64>>, StepError> {
    run.take_steps(STEPS)?;
    Ok((run.checkpoint(), run.state()))
}

/// What a struct needs that is to hold a run of any method, and of which a thread is made.
struct Simulation<M: Method<Kepler, f64>> {
    run: Integrator<Kepler, M>,
}

impl<M: Method<Kepler, f64, Memory: Send> + Send + 'static> Simulation<M> {
    fn on_a_thread(self) -> Outcome<End<KeplerState>> {
        Ok(thread::spawn(move || end(self.run)).join().expect("no panic")?)
    }
}

fn check<M: Method<Kepler, f64, Memory: Send> + Clone + Send + 'static>(method: M) -> Outcome {
    let expected = end(Integrator::new(&KEPLER, method.clone(), 0.05, START)?)?;
    let simulation = Simulation { run: Integrator::new(KEPLER, method.clone(), 0.05, START)? };
    assert_eq!(simulation.on_a_thread()?, expected);
    assert_eq!(end(Integrator::new(Box::new(KEPLER), method.clone(), 0.05, START)?)?, expected);
    assert_eq!(end(Integrator::new(Rc::new(KEPLER), method.clone(), 0.05, START)?)?, expected);
    // From the middle on, as its own.
    let mut half = Integrator::new(&KEPLER, method.clone(), 0.05, START)?;
    half.take_steps(STEPS / 2)?;
    let mut again = Integrator::resume(KEPLER, method, &half.checkpoint())?;
    again.take_steps(STEPS - STEPS / 2)?;
    assert_eq!(again.checkpoint(), expected.0);
    Ok(())
}

#[test]
fn a_run_that_owns_its_system_is_the_run_that_borrows_it() -> Outcome {
    fn goes_to_threads<M: Method<Kepler, f64, Memory: Send>>(_: M) {}
    goes_to_threads(Variational::simpson().phase_fitted(Constant(0.5)));
    goes_to_threads(Galerkin::<4>::new());
    goes_to_threads(Gauss::<2>::new());
    goes_to_threads(Composition::kahan_li_8(Variational::midpoint()));
    check(Variational::trapezoid())
}

#[test]
fn so_is_a_run_of_a_degenerate_system() -> Outcome {
    let (vortices, start) = leapfrogging();
    for method in [Sigma::leapfrog(), Sigma::midpoint()] {
        let expected = end(Integrator::new(&vortices, method, 0.05, start)?)?;
        let own = Integrator::new(vortices.clone(), method, 0.05, start)?;
        assert_eq!(thread::spawn(move || end(own)).join().expect("no panic")?, expected);
        let second = expected.1;
        let between = |step| Integrator::from_two_points(&vortices, method, step, start, second);
        let owned = Integrator::from_two_points(vortices.clone(), method, 0.05, start, second);
        assert_eq!(end(owned?)?.0, end(between(0.05)?)?.0);
    }
    Ok(())
}

#[test]
fn so_is_a_controlled_run() -> Outcome {
    fn check<C: StepControl<Kepler, f64, Memory: Send> + Clone + Send + 'static>(
        method: impl VariableStep<Kepler, f64, Memory: Send> + Clone + Send + 'static,
        control: C,
    ) -> Outcome {
        let borrowed = Integrator::controlled(&KEPLER, method.clone(), control.clone(), START)?;
        let own = Integrator::controlled(KEPLER, method, control, START)?;
        assert_eq!(thread::spawn(move || end(own)).join().expect("no panic")?, end(borrowed)?);
        Ok(())
    }
    check(Variational::trapezoid(), Reversible::power(0.05, 1.5))?;
    check(Gauss::<3>::new(), ErrorControl::new(1e-8, 0.01))
}

/// Threads each have a run on one system, which is gone when the last of them is.
#[test]
fn runs_share_a_system() -> Outcome {
    let kepler = Arc::new(Kepler { mu: 2.0 });
    let start = |j: u32| KeplerState { dot_y: 0.8 + 0.1 * f64::from(j), ..START };
    let begin = |j| Integrator::new(Arc::clone(&kepler), Variational::trapezoid(), 0.05, start(j));
    let runs = (0..4).map(begin).collect::<Result<Vec<_>, _>>()?;
    assert_eq!(Arc::strong_count(&kepler), 5);
    let threads: Vec<_> = runs.into_iter().map(|run| thread::spawn(move || end(run))).collect();
    for (j, thread) in (0..).zip(threads) {
        let expected = end(Integrator::new(&*kepler, Variational::trapezoid(), 0.05, start(j))?)?;
        assert_eq!(thread.join().expect("no panic")?, expected);
    }
    assert_eq!(Arc::strong_count(&kepler), 1);
    Ok(())
}

#[test]
fn runs_of_their_own_systems_go_together_in_lanes() -> Outcome {
    let begin = |j: u32| {
        let start = KeplerState { dot_y: 0.8 + 0.05 * f64::from(j), ..START };
        Integrator::new(KEPLER, Variational::trapezoid(), 0.05, start).map_err(Into::into)
    };
    let errors = held_together::<4, _, _, _>(|| (0..6).map(begin).collect(), &[STEPS])?;
    assert!(errors.iter().all(Option::is_none), "{errors:?}");
    Ok(())
}

type AnyRun<'a> = Box<dyn Run<System = Kepler, Scalar = f64> + 'a>;

/// Calls a function with what begins a run, of several methods, of steps of one length and of several.
macro_rules! of_many_methods {
    ($check:ident) => {{
        $check(|| Ok(Integrator::new(&KEPLER, Variational::trapezoid(), 0.05, START)?))?;
        $check(|| Ok(Integrator::new(KEPLER, Gauss::<3>::new(), 0.05, START)?))?;
        let control = Reversible::power(0.05, 1.5);
        $check(|| Ok(Integrator::controlled(KEPLER, Variational::trapezoid(), control, START)?))?;
        $check(|| {
            Ok(Integrator::controlled(KEPLER, Gauss::<3>::new(), ErrorControl::new(1e-8, 0.01), START)?)
        })
    }};
}

/// All that can be asked of a run whatever its method is.
fn asked(run: &dyn Run<System = Kepler, Scalar = f64>) -> Outcome<(Vec<u64>, Checkpoint, KeplerState)> {
    let momentum = run.momentum(0).ok_or("a momentum")?;
    let numbers = [run.time(), run.step_size(), run.energy(), momentum];
    Ok((bits(&[run.q(), &run.v(), &numbers].concat()), run.checkpoint(), run.state()))
}

#[test]
fn a_method_that_is_chosen_at_run_time_takes_the_same_steps() -> Outcome {
    fn check<'a, R: Run<System = Kepler, Scalar = f64> + 'a>(begin: impl Fn() -> Outcome<R>) -> Outcome {
        let (mut known, mut chosen) = (begin()?, Box::new(begin()?) as AnyRun<'a>);
        known.take_steps(STEPS)?;
        known.advance()?;
        chosen.take_steps(STEPS)?;
        chosen.advance()?;
        assert_eq!(asked(&*chosen)?, asked(&known)?);
        assert_eq!((chosen.steps(), chosen.statistics()), (STEPS + 1, known.statistics()));
        Ok(())
    }
    of_many_methods!(check)
}

/// Of the run of a method that is known, and of the same run when it is not known.
#[test]
fn so_are_its_states_at_times_and_its_events() -> Outcome {
    const DIRECTIONS: [Direction; 2] = [Direction::Rising, Direction::Either];
    fn conditions(t: f64, s: &KeplerState) -> [f64; 2] {
        [s.x * s.dot_x + s.y * s.dot_y, s.y - 0.01 * t]
    }
    fn states<R: Run<System = Kepler, Scalar = f64>>(mut run: R) -> Outcome<Vec<(f64, KeplerState)>> {
        let times = (0..40).map(|k| 0.013 * f64::from(k * k));
        Ok(run.states_at(times)?.collect::<Result<_, _>>()?)
    }
    fn events<R: Run<System = Kepler, Scalar = f64>>(mut run: R) -> Outcome<Vec<Event<KeplerState, f64>>> {
        let mut events = run.events(DIRECTIONS, conditions)?;
        let mut found = Vec::new();
        while let Some(event) = events.next_until(20.0)? {
            if found.len() == 4 {
                events.set_state(event.time, KeplerState { x: event.state.x + 0.01, ..event.state })?;
            }
            found.push(event);
        }
        assert!(found.len() > 8, "{found:?}");
        Ok(found)
    }
    fn check<'a, R: Run<System = Kepler, Scalar = f64> + 'a>(begin: impl Fn() -> Outcome<R>) -> Outcome {
        let any = || Ok::<_, Box<dyn std::error::Error>>(Box::new(begin()?) as AnyRun<'a>);
        let expected = states(begin()?)?;
        assert_eq!(
            [states(any()?)?, states(&mut *any()?)?, states(&mut begin()?)?],
            [(); 3].map(|()| expected.clone())
        );
        assert_eq!(events(any()?)?, events(begin()?)?);
        assert_eq!(events(&mut *any()?)?, events(begin()?)?);
        // In one run, one after the other.
        let (mut known, mut chosen) = (begin()?, any()?);
        assert_eq!(chosen.dense()?.state_at(1.23)?, known.dense()?.state_at(1.23)?);
        let event = chosen.events(DIRECTIONS, conditions)?.next_until(9.0)?;
        assert!(event.is_some() && event == known.events(DIRECTIONS, conditions)?.next_until(9.0)?);
        assert_eq!(asked(&*chosen)?, asked(&known)?);
        Ok(())
    }
    of_many_methods!(check)
}
