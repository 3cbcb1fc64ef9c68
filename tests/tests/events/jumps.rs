//! Events of steps in which a velocity jumps, against parabolas.

use approx::assert_abs_diff_eq;
use dvi_core::prelude::*;
use dvi_tests::Outcome;
use dvi_tests::zoo::impacts::{Ball, BallState, BallStateOf};
use num_dual::{Dual64, DualNum};

const BALL: Ball = Ball { m: 1.0 };

/// Steps of these methods are exact in free fall.
fn method(restitution: f64) -> Impacts<Variational<Unfitted, Trapezoid>> {
    Impacts { restitution, ..Impacts::reflecting(Variational::trapezoid()) }
}

#[track_caller]
fn assert_close(found: Dual64, exact: Dual64, [value, derivative]: [f64; 2]) {
    assert_abs_diff_eq!(found.re, exact.re, epsilon = value);
    assert_abs_diff_eq!(found.eps, exact.eps, epsilon = derivative);
}

/// Where y + kẏ = level up to a time, by the height of the start, of a ball that begins at `y` with `v`: on
/// its way between impacts, and at these if the speed jumps across.
fn met(restitution: f64, [mut y, mut v]: [Dual64; 2], [k, level, end]: [f64; 3]) -> Vec<Dual64> {
    let (mut found, mut begun) = (Vec::new(), Dual64::from(0.0));
    loop {
        let landing = v + (v * v + y * 2.0).sqrt();
        // y + vs − ½s² + k (v − s) − level = c + bs − ½s²
        let (c, b) = (y + v * k - level, v - k);
        let there = (b * b + c * 2.0).sqrt();
        found.extend(
            [b - there, b + there]
                .into_iter()
                .filter(|s| s.re > 0.0 && s.re < landing.re)
                .map(|s| begun + s),
        );
        (begun, y, v) = (begun + landing, Dual64::from(0.0), (landing - v) * restitution);
        if begun.re > end {
            found.retain(|time| time.re <= end);
            return found;
        }
        let sides = [v / -restitution, v].map(|v| v.re * k < level);
        found.extend((sides[0] != sides[1]).then_some(begun));
    }
}

#[test]
fn a_condition_is_met_before_an_impact_behind_it_and_there() -> Outcome {
    for i in 0..70 {
        // Numbers that fill a cube evenly: the fractional parts of multiples.
        let [a, b, c, d, e] = [0.8191725, 0.6710436, 0.5497004, 0.4503, 0.3689]
            .map(|irrational| (0.5 + f64::from(i) * irrational).fract());
        // Some of the steps have a dozen impacts.
        let (h, end) = if i % 30 == 0 { (30.0, 30.0) } else { (0.02 + 0.6 * a, 3.3) };
        let (y, v, restitution) = (0.8 + 0.7 * b, c - 0.5, if i % 3 == 0 { 1.0 } else { 0.7 + 0.3 * d });
        for (k, level) in
            [(0.0, 1e-9), (0.0, 1e-6), (0.0, 1e-2), (0.0, e), (0.4 * e, 1e-7), (0.4 * e, -1e-3)]
        {
            let start = [Dual64::from(y).derivative(), Dual64::from(v)];
            let mut expected = met(restitution, start, [k, level, end]).into_iter();
            let case = format!("h = {h}, from {y}, {v}, e = {restitution}, k = {k}, level {level}");
            let mut plain = Integrator::new(&BALL, method(restitution), h, BallState { y, dot_y: v })?;
            let mut plain =
                plain.events([Direction::Either], |_, ball| [ball.y + k * ball.dot_y - level])?;
            let start = BallStateOf::<Dual64> { y: start[0], dot_y: start[1] };
            let mut dual = Integrator::new(&BALL, method(restitution), h.into(), start)?;
            let mut dual = dual.events([Direction::Either], |_, ball| [ball.y + ball.dot_y * k - level])?;
            while let Some(event) = dual.next_until(end.into())? {
                let exact = expected.next().ok_or(format!("{event:?} of none: {case}"))?;
                assert_close(event.time, exact, [1e-10, 1e-7]);
                let event = plain.next_until(end)?.ok_or(format!("none at {exact}: {case}"))?;
                assert_abs_diff_eq!(event.time, exact.re, epsilon = 1e-10);
            }
            assert!(expected.next().is_none() && plain.next_until(end)?.is_none(), "{case}");
        }
    }
    Ok(())
}

/// By the height of the start.
#[test]
fn a_state_at_a_jump_is_that_behind_it() -> Outcome {
    let (y, dot_y) = (Dual64::from(1.2753).derivative(), Dual64::from(-0.2));
    let speed = (dot_y * dot_y + y * 2.0).sqrt();
    for h in [0.02, 0.176, 0.5, 1.1] {
        let start = BallStateOf::<Dual64> { y, dot_y };
        let mut run = Integrator::new(&BALL, method(1.0), Dual64::from(h), start)?;
        let mut events = run.events([Direction::Rising], |_, ball| [ball.dot_y])?;
        let Event { time, state, .. } = events.next_until(Dual64::from(3.0))?.ok_or("it bounces")?;
        for (found, exact) in [(time, dot_y + speed), (state.dot_y, speed), (state.y, Dual64::from(0.0))] {
            assert_close(found, exact, [1e-12, 1e-12]);
        }
    }
    Ok(())
}

/// Where an impact ends a step to the last bit its time is as good as any.
#[test]
fn an_impact_at_the_end_of_a_step_has_derivatives() -> Outcome {
    for (h, y, dot_y) in [(0.125, 0.5, 0.0), (1.0, 0.5, 0.0), (0.25, 0.0, -1.0)] {
        let start = BallStateOf::<Dual64> { y: Dual64::from(y).derivative(), dot_y: dot_y.into() };
        let landing = start.dot_y + (start.dot_y * start.dot_y + start.y * 2.0).sqrt();
        let mut run = Integrator::new(&BALL, method(1.0), Dual64::from(h), start)?;
        let time = run.events([Direction::Rising], |_, ball| [ball.dot_y])?.next_until(2.0.into())?;
        assert_eq!(time.map(|event| (event.time.re, event.time.eps)), Some((landing.re, landing.eps)));
        let later = run.time() + 0.25;
        let after = later - landing;
        let BallStateOf { y, dot_y } = run.dense()?.state_at(later)?;
        let speed = landing - start.dot_y;
        for (found, exact) in [(y, speed * after - after * after * 0.5), (dot_y, speed - after)] {
            assert_close(found, exact, [1e-13, 1e-12]);
        }
    }
    Ok(())
}

#[test]
fn a_gap_is_met_at_each_impact_and_on_one_side() -> Outcome {
    for h in [0.013, 0.1, 0.37, 2.9] {
        let run = || Integrator::new(&BALL, method(1.0), h, BallState { y: 0.7, dot_y: 0.1 });
        for (direction, expected) in
            [(Direction::Falling, 20), (Direction::Either, 20), (Direction::Rising, 0)]
        {
            let (mut run, mut met) = (run()?, 0);
            let mut events = run.events([direction], |_, ball| [ball.y])?;
            // The first flight takes 1.3, each other one 2.4.
            while let Some(event) = events.next_until(48.0)? {
                assert!(event.state.y.abs() < 1e-12 && event.state.dot_y > 0.0, "{event:?}");
                met += 1;
            }
            assert_eq!(met, expected, "h = {h}, {direction:?}");
        }
        let start = BallStateOf::<Dual64> { y: 0.7.into(), dot_y: Dual64::from(0.1).derivative() };
        let mut run = Integrator::new(&BALL, method(1.0), h.into(), start)?;
        let event = run.events([Direction::Falling], |_, ball| [ball.y])?.next_until(2.0.into())?;
        let Event { time, state, .. } = event.ok_or("it bounces")?;
        let speed = (start.dot_y * start.dot_y + start.y * 2.0).sqrt();
        for (found, exact) in [(time, start.dot_y + speed), (state.dot_y, speed)] {
            assert_close(found, exact, [1e-12, 1e-11]);
        }
    }
    Ok(())
}

#[test]
fn events_of_an_impact_are_handed_out_when_the_state_is_set_and_when_the_next_step_fails() -> Outcome {
    let start = BallState { y: 0.5, dot_y: 0.0 };
    let mut run = Integrator::new(&BALL, method(1.0), 0.1, start)?;
    let mut events = run.events([Direction::Rising; 2], |_, ball| [ball.dot_y, ball.dot_y - 0.1])?;
    let Event { index, time, state } = events.next_until(1.5)?.ok_or("it bounces")?;
    events.set_state(time, state)?;
    let next = events.next_until(1.5)?.map(|event| (event.index, event.time));
    assert_eq!((index, next), (0, Some((1, time))));

    // Impacts accumulate at t = 3.
    let mut run = Integrator::new(&BALL, method(0.5), 0.3, start)?;
    let events = run.events([Direction::Rising], |_, ball| [ball.dot_y])?;
    let last = events.map_while(Result::ok).last().map(|event| event.state.dot_y);
    assert_abs_diff_eq!(last.ok_or("it bounces in the last good step")?, 0.125, epsilon = 1e-12);
    Ok(())
}

/// Impacts accumulate at t = 3.
#[test]
fn states_within_the_last_good_step_are_known_when_one_on_the_way_fails() -> Outcome {
    let run = || Integrator::new(&BALL, method(0.5), 0.3, BallState { y: 0.5, dot_y: 0.0 });
    let [mut at_once, mut one_by_one] = [Dense::new(run()?)?, Dense::new(run()?)?];
    assert!(at_once.advance_to(10.0).is_err());
    while one_by_one.advance().is_ok() {}
    let time = at_once.time() - 0.1;
    assert_eq!(at_once.state_at(time)?, one_by_one.state_at(time)?);
    assert!(at_once.state_at(time - 0.3).is_err());
    Ok(())
}

/// Long flights, of which some begin and end at a wall: states right behind an impact are found as the run
/// has found it.
#[test]
fn states_right_behind_an_impact_are_known_in_long_steps() -> Outcome {
    let mut looked_at = 0;
    for i in 0..200 {
        let [a, b] = [0.8191725, 0.6710436].map(|irrational| (0.5 + f64::from(i) * irrational).fract());
        let (h, y) = (2.5 + 2.5 * a, 0.4 + 0.4 * b);
        let mut run = Dense::new(Integrator::new(&BALL, method(1.0), h, BallState { y, dot_y: 0.0 })?)?;
        let flight = (2.0 * y).sqrt();
        run.advance_to(20.0)?;
        // The last impact in the last step, or where the one before it has ended.
        let count = ((run.time() / flight - 1.0) / 2.0).floor();
        let impact = flight * (1.0 + 2.0 * count);
        for after in [1e-12, 1e-10, 1e-8, 1e-6] {
            if impact > run.time() - h && impact + after < run.time() {
                let BallState { y, .. } = run.state_at(impact + after)?;
                assert_abs_diff_eq!(y, flight * after, epsilon = 1e-12);
                looked_at += 1;
            }
        }
    }
    assert!(looked_at > 700, "{looked_at}");
    Ok(())
}
