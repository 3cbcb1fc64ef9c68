//! Crossings of a section, beside closed forms: as accurate as the run, whatever the length of a step.

use core::f64::consts::{FRAC_PI_2, PI, TAU};

use dvi_core::ensemble::{Draws, Ensemble, Outcome};
use dvi_core::prelude::*;
use dvi_tests::zoo::regular::{SPRING, SpringState};

use crate::ensemble::Checked;

/// cos(t + φ)
fn spring(phase: f64) -> SpringState {
    SpringState { x: phase.cos(), dot_x: -phase.sin() }
}

const LONG: f64 = 0.6;

/// How often cos rises through `level` in (0, `end`], from the phase `phase` on; back in time it falls there.
fn rises(level: f64, phase: f64, end: f64) -> u64 {
    // At −arccos(level) + 2πk.
    let turns = |t: f64| ((t + phase + level.acos()) / TAU).floor();
    (turns(end) - turns(0.0)).abs() as u64
}

/// Steps of 0.6 lead over both crossings of a level near the turn of a spring, and a step of 2 over more than
/// a quarter of a period.
#[test]
fn none_is_lost_within_long_steps() -> Checked {
    for h in [LONG, -LONG, 2.0] {
        for level in [-0.99, -0.4, 0.0, 0.5, 0.95, 0.999, 0.999_999] {
            let phases: Vec<f64> = Draws::new(5).take(6, |draw| draw.uniform(0.1, TAU - 0.1)).collect();
            // Where x rises in time, and where it falls: where −x rises.
            let end = 20.0 * h;
            let up = |phase: f64| rises(level, phase, end);
            let down = |phase: f64| rises(-level, phase + PI, end);
            for direction in [Direction::Rising, Direction::Falling, Direction::Either] {
                let results =
                    Ensemble::new(&SPRING, Gauss::<8>::new(), h, phases.iter().copied().map(spring))
                        .section(direction, move |_, state| state.x - level)
                        .take_steps(20)?;
                for (member, &phase) in results.members().iter().zip(&phases) {
                    let expected = match direction {
                        Direction::Rising => {
                            if h > 0.0 {
                                up(phase)
                            } else {
                                down(phase)
                            }
                        }
                        Direction::Falling => {
                            if h > 0.0 {
                                down(phase)
                            } else {
                                up(phase)
                            }
                        }
                        Direction::Either => up(phase) + down(phase),
                    };
                    assert_eq!(member.crossings, expected, "{direction:?}, {h}, {level}, {phase}");
                }
            }
        }
    }
    Ok(())
}

/// A crossing 1e-9 before the end of the last step counts, and one 1e-9 after it does not.
#[test]
fn they_are_as_accurate_as_the_run() -> Checked {
    let end = 1000.0 * LONG;
    let phase = |early: f64| (3.0 * FRAC_PI_2 - end + early).rem_euclid(TAU);
    let counted = |early: f64| {
        Ensemble::new(&SPRING, Gauss::<8>::new(), LONG, [spring(phase(early))])
            .section(Direction::Rising, |_, state| state.x)
            .take_steps(1000)
    };
    let [after, before] = [counted(-1e-9)?, counted(1e-9)?].map(|results| results.members()[0].crossings);
    assert_eq!((after, before), (95, 96));
    Ok(())
}

/// Where a member ends within a step, what comes before counts, and what comes after does not.
#[test]
fn they_count_up_to_a_limit() -> Checked {
    for (level, expected) in [(0.5, 1), (-0.5, 0)] {
        let results = Ensemble::new(&SPRING, Gauss::<8>::new(), 2.2, [spring(0.0)])
            .until(["half way"], |_, state, _| [-state.x])
            .section(Direction::Falling, move |_, state| state.x - level)
            .take_steps(5)?;
        let member = &results.members()[0];
        assert_eq!((member.steps, member.crossings), (1, expected));
        assert!((member.time - FRAC_PI_2).abs() < 1e-9, "{}", member.time);
    }
    Ok(())
}

#[test]
fn a_section_that_is_no_number_is_a_failure() -> Checked {
    let results = Ensemble::new(&SPRING, Gauss::<2>::new(), 0.1, [spring(0.5)])
        .section(Direction::Rising, |_, state| state.x.sqrt())
        .take_steps(100)?;
    let member = &results.members()[0];
    assert!(matches!(member.outcome, Outcome::Failed { .. }), "{:?}", member.outcome);
    // cos(t + 0.5) is zero at 1.07.
    assert_eq!(member.steps, 11);
    Ok(())
}
