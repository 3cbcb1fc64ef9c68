//! Several impacts in a step, and several surfaces.

use approx::{assert_abs_diff_eq, assert_relative_eq};
use dvi_core::prelude::*;
use dvi_tests::apart;
use dvi_tests::zoo::impacts::*;

use super::Outcome;

/// The place of a free particle between walls at 0 and 1 that would be at x without them.
fn folded(x: f64) -> f64 {
    let x = x.rem_euclid(2.0);
    if x > 1.0 { 2.0 - x } else { x }
}

#[test]
fn a_particle_between_two_walls() -> Outcome {
    for method in [Impacts::new(Variational::midpoint()), Impacts::reflecting(Variational::midpoint())] {
        let mut run = Integrator::new(&Channel, method, 1.0, ChannelState { x: 0.25, dot_x: 7.3 })?;
        for _ in 0..100 {
            let before = run.time();
            run.advance()?;
            let expected = folded(0.25 + 7.3 * run.time());
            assert_abs_diff_eq!(run.state().x, expected, epsilon = 1e-11);
            let impacts = run.memory().impacts();
            let walls = |t: f64| (0.25 + 7.3 * t).floor() as i64;
            assert_eq!(impacts.len() as i64, walls(run.time()) - walls(before));
            // The walls take turns, and the last velocity is that of the run.
            assert!(impacts.windows(2).all(|two| two[0].surface != two[1].surface));
            assert!(impacts.last().is_none_or(|last| (last.v[0] - run.state().dot_x).abs() < 1e-12));
        }
    }
    Ok(())
}

#[test]
fn a_corner_turns_a_particle_around() -> Outcome {
    // Into the corner itself, and near it on either side.
    for (y, surfaces) in [(1.0_f64, 2), (1.0 + 1e-9, 2), (1.0 - 1e-9, 2), (1.2, 2), (0.9, 2)] {
        for method in [Impacts::new(Variational::trapezoid()), Impacts::reflecting(Variational::trapezoid())]
        {
            let start = CornerState { x: 1.0, y, dot_x: -1.0, dot_y: -1.0 };
            let mut run = Integrator::new(&Corner, method, 3.0, start)?;
            run.advance()?;
            assert_eq!(run.memory().impacts().len(), surfaces);
            let CornerState { x, y: height, dot_x, dot_y } = run.state();
            let (found, expected) = ([x, height, dot_x, dot_y], [2.0, 3.0 - y, 1.0, 1.0]);
            assert!(apart(&found, &expected) < 1e-12, "{found:?} for {expected:?}");
        }
    }
    Ok(())
}

/// Of equal masses the velocities change places, so that those of the balls in their order are sorted in the
/// end.
#[test]
fn balls_of_equal_mass_exchange_their_velocities() -> Outcome {
    let n = 6;
    let velocities = [1.0, 0.3, -0.2, 0.5, -1.0, 0.1];
    let x: Vec<f64> = (0..n).map(|i| 1.3 * i as f64).collect();
    let free = |t: f64| {
        // Points that pass through each other, in order, and the room that the balls take.
        let mut points: Vec<f64> = (0..n).map(|i| x[i] - i as f64 + velocities[i] * t).collect();
        points.sort_by(f64::total_cmp);
        points.into_iter().enumerate().map(|(i, point)| point + i as f64).collect::<Vec<f64>>()
    };
    for h in [0.01, 0.3, 5.0] {
        let start = BallsState { x: x.clone(), dot_x: velocities.to_vec() };
        let balls = Balls { m: vec![1.0; n] };
        let mut run = Integrator::new(&balls, Impacts::new(Variational::trapezoid()), h, start)?;
        while run.time() < 5.0 {
            run.advance()?;
            assert_abs_diff_eq!(&run.state().x[..], &free(run.time())[..], epsilon = 1e-11);
        }
    }
    Ok(())
}

#[test]
fn balls_of_unequal_mass_keep_momentum_and_energy() -> Outcome {
    let start = BallsState { x: vec![0.0_f64, 1.5, 3.0, 4.5], dot_x: vec![2.0, 0.1, -0.3, -1.7] };
    let balls = Balls { m: vec![1.0, 0.02, 30.0, 2.0] };
    let mut run = Integrator::new(&balls, Impacts::reflecting(Variational::trapezoid()), 0.1, start)?;
    let [energy, momentum] = [run.energy(), run.momentum(0).ok_or("declared")?];
    run.take_steps(200)?;
    assert!(run.memory().total() > 5, "{}", run.memory().total());
    assert_relative_eq!(run.energy(), energy, epsilon = 0.0, max_relative = 1e-13);
    assert_abs_diff_eq!(run.momentum(0).ok_or("declared")?, momentum, epsilon = 1e-12);
    Ok(())
}

/// It meets the disc and has left it again at the end of the step, where no gap is negative.
#[test]
fn a_surface_that_is_left_within_the_step_is_seen() -> Outcome {
    for height in [0.3_f64, 0.9, 0.99, 0.9999] {
        for h in [0.5, 2.0, 8.0] {
            let start = DiscState { x: -1.3, y: height, dot_x: 1.0, dot_y: 0.0 };
            let mut run = Integrator::new(&Disc, Impacts::reflecting(Variational::trapezoid()), h, start)?;
            while run.time() < 8.0 {
                run.advance()?;
            }
            assert_eq!(run.memory().total(), 1, "at {height} by {h}");
            // The normal at the impact is (−cos, height): the path turns by twice the angle.
            let cosine = (1.0 - height * height).sqrt();
            let along = 2.0 * cosine;
            let [u, w] = [1.0 - along * cosine, along * height];
            let DiscState { x, y, dot_x, dot_y } = run.state();
            let left = run.time() - (1.3 - cosine);
            let (found, expected) = ([x, y, dot_x, dot_y], [u * left - cosine, height + w * left, u, w]);
            assert!(apart(&found, &expected) < 1e-11, "{found:?} for {expected:?} at {height} by {h}");
        }
    }
    Ok(())
}
