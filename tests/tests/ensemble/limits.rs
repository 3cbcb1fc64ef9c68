//! Where members end: at limits, beside closed forms, whatever the length of a step.

use std::time::Duration;

use approx::assert_abs_diff_eq;
use dvi_core::ensemble::{Ensemble, Member, Outcome};
use dvi_core::prelude::*;
use dvi_tests::zoo::regular::{SPRING, SpringState};

use crate::ensemble::{Checked, Kepler, KeplerState, bytes, file};

/// A body that falls with unit acceleration.
#[lagrangian(
    coordinates(x, z),
    lagrangian = (dot(x).powi(2) + dot(z).powi(2)) / 2.0 - z,
    momenta(across = dot(x)),
)]
#[derive(Debug, PartialEq)]
struct Body;

fn exited(reason: &str) -> Outcome {
    Outcome::Exited { reason: reason.into() }
}

fn ends<'m>(member: &'m Member, reason: &str, time: f64, state: &[f64]) -> &'m Member {
    assert_eq!(member.outcome, exited(reason));
    assert_abs_diff_eq!(member.time, time, epsilon = 1e-10);
    assert_abs_diff_eq!(member.state[..], state[..], epsilon = 1e-10);
    member
}

/// Parabolas, of which the trapezoid is exact: on the ground, and under a ceiling that only a part of one
/// step is above. Of several limits the one that comes first counts, not the first in the list.
#[test]
fn bodies_end_where_parabolas_do() -> Checked {
    let state = |z, dot_z| BodyState { x: 0.0, z, dot_x: 1.0, dot_z };
    let starts = [state(0.5, 0.0), state(0.0, 1.4), state(0.0, 1.0), state(0.1, 0.0), state(2.0, -1.0)];
    let ceiling = 0.97;
    let ensemble = || {
        Ensemble::new(&Body, Variational::trapezoid(), 0.4, starts)
            .until(["ground", "ceiling"], |_, body, _| [-body.z, body.z - ceiling])
            .stride(3)
    };
    let results = ensemble().take_steps(20)?;
    let [falls, high, low, short, above] = results.members() else { return Err("there are five".into()) };
    ends(falls, "ground", 1.0, &[1.0, 0.0, 1.0, -1.0]);
    // Its top is at 0.98, and the ends of the step that leads over it are at 0.96.
    let root = (1.4_f64 * 1.4 - 2.0 * ceiling).sqrt();
    assert!([1.2, 1.6].iter().all(|t| 1.4 * t - t * t / 2.0 < ceiling));
    ends(high, "ceiling", 1.4 - root, &[1.4 - root, ceiling, 1.0, root]);
    // It begins on the ground, and ends when it comes back.
    ends(low, "ground", 2.0, &[2.0, 0.0, 1.0, -1.0]);
    assert_eq!(low.momenta, [[1.0, 1.0]]);
    let time = 0.2_f64.sqrt();
    ends(short, "ground", time, &[time, 0.0, 1.0, -time]);
    // Beyond a limit from the start.
    ends(above, "ceiling", 0.0, &[0.0, 2.0, 1.0, -1.0]);
    assert_eq!((above.steps, above.energy.largest_error), (0, 0.0));

    let path = file("limits.ckpt");
    let interrupted = ensemble().stride(3).checkpoints(&path, Duration::ZERO).take_steps(20)?;
    assert_eq!(bytes(&interrupted)?, bytes(&results)?);
    Ok(())
}

/// On the ground a body that is thrown up comes back, and one that falls, or is let go, ends at once; back
/// in time up is down.
#[test]
fn bodies_that_leave_a_limit_outwards_end_at_once() -> Checked {
    for (h, back) in [(0.4, 2.0), (-0.4, -2.0)] {
        let up = back / 2.0;
        let starts = [up, -up, 0.0].map(|dot_z| BodyState { x: 0.0, z: 0.0, dot_x: 1.0, dot_z });
        let results = Ensemble::new(&Body, Variational::trapezoid(), h, starts)
            .until(["ceiling", "ground"], |_, body, _| [body.z - 3.0, -body.z])
            .take_steps(20)?;
        let [thrown, falls, rests] = results.members() else { return Err("there are three".into()) };
        ends(thrown, "ground", back, &[back, 0.0, 1.0, -up]);
        for (member, dot_z) in [(falls, -up), (rests, 0.0)] {
            assert_eq!((member.time, member.steps), (0.0, 0));
            assert_eq!(
                (&member.outcome, &member.state[..]),
                (&exited("ground"), &[0.0, 0.0, 1.0, dot_z][..])
            );
        }
    }
    Ok(())
}

/// A limit that moves: the time of a member is that of its run.
#[test]
fn limits_may_move() -> Checked {
    let start = BodyState { x: 0.0, z: 1.0, dot_x: 0.0, dot_z: 0.0 };
    let results = Ensemble::new(&Body, Variational::trapezoid(), 0.3, [start])
        .until(["met"], |_, body, t| [t / 2.0 - body.z])
        .take_steps(20)?;
    // 1 - t²/2 = t/2 at t = 1.
    ends(&results.members()[0], "met", 1.0, &[0.0, 0.5, 0.0, -1.0]);
    Ok(())
}

/// Members that never come to a limit end as without, with the same numbers; and each that does ends where
/// the events of its run say.
#[test]
fn members_end_at_events_of_their_runs() -> Checked {
    let system = Kepler { mu: 1.0 };
    let states =
        || (0..8).map(|k| KeplerState { x: 1.0, y: 0.0, dot_x: 0.0, dot_y: 0.8 + 0.1 * f64::from(k) });
    let ensemble = || Ensemble::new(&system, Variational::trapezoid(), 0.05, states()).stride(10);
    let (free, limited) = (
        ensemble().take_steps(500)?,
        ensemble().until(["far"], |_, state, _| [state.x.hypot(state.y) - 3.0]).take_steps(500)?,
    );
    for ((free, limited), state) in free.members().iter().zip(limited.members()).zip(states()) {
        let mut run = Integrator::new(&system, Variational::trapezoid(), 0.05, state)?;
        let far = |_, state: &KeplerState| [state.x.hypot(state.y) - 3.0];
        let Some(event) = run.events([Direction::Rising], far)?.next_until(25.0)? else {
            assert_eq!((&limited.state, limited.energy), (&free.state, free.energy));
            assert_eq!((&limited.outcome, limited.time), (&Outcome::Finished, free.time));
            continue;
        };
        let values: Vec<f64> = system.values(&event.state)?.collect();
        assert_eq!((limited.time, &limited.state, limited.steps), (event.time, &values, run.steps()));
        assert_eq!(limited.outcome, exited("far"));
        let KeplerState { x, y, dot_x, dot_y } = event.state;
        assert_abs_diff_eq!(limited.momenta[0][1], x * dot_y - y * dot_x, epsilon = 1e-15);
    }
    let exited = |member: &&Member| member.outcome == exited("far");
    assert!((2..7).contains(&limited.members().iter().filter(exited).count()));
    Ok(())
}

#[test]
fn a_limit_that_is_no_number_is_a_failure() -> Checked {
    let starts = [0.5, -1.0].map(|x| SpringState { x, dot_x: 0.0 });
    let results = Ensemble::new(&SPRING, Gauss::<2>::new(), 0.1, starts)
        .until(["small"], |_, state, _| [-1.0 - state.x.sqrt()])
        .take_steps(100)?;
    for (member, steps) in results.members().iter().zip([16, 0]) {
        let Outcome::Failed { error } = &member.outcome else { panic!("{:?}", member.outcome) };
        assert!(error.contains("condition 0"), "{error}");
        assert_eq!(member.steps, steps);
    }
    Ok(())
}
