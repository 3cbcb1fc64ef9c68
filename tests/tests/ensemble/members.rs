//! The records of members, beside runs by hand.

use approx::assert_abs_diff_eq;
use dvi_core::ensemble::{Draws, Ensemble, Outcome};
use dvi_core::prelude::*;

use crate::ensemble::{Checked, HenonHeiles, HenonHeilesState, LEFT, left, planets, wells};

#[test]
fn a_record_is_that_of_the_run() -> Checked {
    let states = wells(5);
    let results =
        Ensemble::new(&HenonHeiles, Gauss::<2>::new(), 0.05, states.clone()).stride(3).take_steps(100)?;
    for (member, state) in results.members().iter().zip(states) {
        let mut run = Integrator::new(&HenonHeiles, Gauss::<2>::new(), 0.05, state)?;
        let (first, mut largest) = (run.energy(), 0.0_f64);
        for _ in 0..33 {
            run.take_steps(3)?;
            largest = largest.max((run.energy() - first).abs());
        }
        run.take_steps(1)?;
        largest = largest.max((run.energy() - first).abs());
        let values: Vec<f64> = HenonHeiles.values(&run.state())?.collect();
        assert_eq!((&member.state, member.time, member.steps), (&values, run.time(), 100));
        assert_eq!(member.iterations, run.statistics().iterations);
        let energy = member.energy;
        assert_eq!([energy.first, energy.last, energy.largest_error], [first, run.energy(), largest]);
        assert_eq!(member.outcome, Outcome::Finished);
    }
    Ok(())
}

/// A fall into the sun ends with the error and the time that it has alone; a start in the sun is a failure
/// at time 0.
#[test]
fn failures_are_recorded() -> Checked {
    let (systems, states) = planets(6);
    let method = EnergyLimit { method: Variational::trapezoid(), limit: 0.01 };
    let results = Ensemble::with_systems(&systems, method, 0.01, states.clone()).take_steps(300)?;
    for (member, (system, state)) in results.members().iter().zip(systems.iter().zip(states)) {
        let expected = match Integrator::new(system, method, 0.01, state) {
            Err(error) => (Outcome::Failed { error: error.to_string() }, 0.0),
            Ok(mut run) => match run.take_steps(300) {
                Ok(()) => (Outcome::Finished, run.time()),
                Err(error) => (Outcome::Failed { error: error.to_string() }, run.time()),
            },
        };
        assert_eq!((member.outcome.clone(), member.time), expected);
    }
    let failed = results.members().iter().map(|member| matches!(member.outcome, Outcome::Failed { .. }));
    assert_eq!(failed.collect::<Vec<_>>(), [false, false, true, false, true, true]);
    let never = &results.members()[4];
    assert_eq!((never.state[0], never.steps, never.energy.first.is_nan()), (0.0, 0, true));
    Ok(())
}

#[test]
fn draws_depend_on_seed_and_member_alone() {
    let of = |draw: &mut dvi_core::ensemble::Draw| [draw.normal(0.0, 1.0), draw.uniform(-1.0, 3.0)];
    let draws = Draws::new(3);
    let many: Vec<_> = draws.take(20_000, of).collect();
    let few: Vec<_> = draws.take(10, of).collect();
    assert_eq!(many[..10], few);
    assert_eq!(of(&mut draws.member(12_345)), many[12_345]);
    assert_ne!(of(&mut Draws::new(4).member(0)), many[0]);
    let moment = |of: &dyn Fn(&[f64; 2]) -> f64| many.iter().map(of).sum::<f64>() / many.len() as f64;
    // Five standard errors of the means and of the mean square.
    assert!(moment(&|x| x[0]).abs() < 5.0 / 20_000_f64.sqrt());
    assert_abs_diff_eq!(moment(&|x| x[0] * x[0]), 1.0, epsilon = 5.0 * (2.0 / 20_000_f64).sqrt());
    assert_abs_diff_eq!(moment(&|x| x[1]), 1.0, epsilon = 5.0 * 4.0 / (12.0 * 20_000_f64).sqrt());
    assert!(many.iter().all(|x| (-1.0..3.0).contains(&x[1])));
}

/// Where a member is known is in order, and the counts of progress only grow.
#[test]
fn progress_is_told_in_order() -> Checked {
    let mut told = Vec::new();
    let states: Vec<HenonHeilesState> = wells(30);
    let results = Ensemble::new(&HenonHeiles, Variational::trapezoid(), 0.05, states)
        .until(LEFT, left)
        .on_progress(|progress| told.push(*progress))
        .take_steps(5000)?;
    assert!(told.is_sorted_by_key(|p| (p.steps, p.ended)));
    let (Some(first), Some(last)) = (told.first(), told.last()) else { return Err("it was told".into()) };
    assert_eq!((first.steps, first.ended, last.ended, last.members), (0, 0, 30, 30));
    assert_eq!(last.steps, results.members().iter().map(|member| u128::from(member.steps)).sum());
    assert!(results.members().iter().map(|member| member.number).eq(0..30));
    Ok(())
}
