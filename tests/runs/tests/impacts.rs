//! Runs with many impacts, and no impact where there is none.

use dvi_core::prelude::*;
use dvi_examples::models::{EllipseBilliard, EllipseBilliardState};
use dvi_tests::Outcome;

/// A body that has left a surface is on it but for rounding.
#[test]
fn no_impact_is_followed_by_one_at_the_same_place() -> Outcome {
    let ellipse = EllipseBilliard { a: 1.25, b: 0.8 };
    for part in [0.75, 0.9] {
        let angle: f64 = 1.57 * (1.0 - 0.6 * part);
        let start = EllipseBilliardState { x: 1.18 * part, y: 0.0, dot_x: angle.cos(), dot_y: angle.sin() };
        let method = Impacts::reflecting(Variational::trapezoid());
        let mut run = Integrator::new(&ellipse, method, 5.0, start)?;
        let mut last = -1.0;
        for _ in 0..30_000 {
            run.advance()?;
            for impact in run.memory().impacts() {
                assert!(impact.impulse > 0.1, "{} at {}", impact.impulse, impact.time);
                assert!(impact.time > last + 0.05, "{} after {last}", impact.time);
                last = impact.time;
            }
        }
    }
    Ok(())
}

/// A box with three round posts, in a potential.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - depth * (0.3 * x.powi(4) + 0.2 * y.powi(4) + 0.1 * x * y),
    impact = [x + 2.0, 2.0 - x, y + 2.0, 2.0 - y],
    impact = ((x - 0.7).powi(2) + (y - 0.5).powi(2)).sqrt() - 0.4,
    impact = (x + 0.8).powi(2) + (y - 0.3).powi(2) - 0.09,
    impact = (x * x + (y + 1.0).powi(2)).sqrt() - 0.5,
)]
struct Posts {
    depth: f64,
}

/// Numbers between 0 and 1 that are spread evenly.
fn spread(k: u32, irrational: f64) -> f64 {
    (f64::from(k) * irrational).fract()
}

fn starts(posts: &Posts) -> impl Iterator<Item = PostsState> + '_ {
    let all = (1..4000).map(|k| {
        let angle = 2.0 * core::f64::consts::PI * spread(k, 0.569_840_290_998);
        let (x, y) = (4.0 * spread(k, 0.754_877_666_247) - 2.0, 4.0 * spread(k, 0.819_172_513_396) - 2.0);
        PostsState { x, y, dot_x: angle.cos(), dot_y: angle.sin() }
    });
    let is_inside = |state: &PostsState| {
        let mut gaps = [0.0; 7];
        posts.gap(&[state.x, state.y], 0.0, &mut gaps);
        gaps.iter().all(|&gap| gap > 0.0)
    };
    all.filter(is_inside).take(400)
}

#[test]
fn no_state_is_beyond_a_surface_and_no_impact_off_it() -> Outcome {
    let posts = Posts { depth: 1.0 };
    for h in [0.05, 0.2, 0.5, 1.0] {
        for method in [Impacts::new(Variational::trapezoid()), Impacts::reflecting(Variational::trapezoid())]
        {
            for start in starts(&posts) {
                let mut run = Integrator::new(&posts, method, h, start)?;
                for _ in 0..(6.0 / h) as u32 {
                    run.advance()?;
                    let mut gaps = [0.0; 7];
                    posts.gap(run.q(), run.time(), &mut gaps);
                    assert!(gaps.iter().all(|&gap| gap > -1e-13), "{gaps:?} by {h}");
                    for impact in run.memory().impacts() {
                        posts.gap(&impact.q, impact.time, &mut gaps);
                        assert!(gaps[impact.surface].abs() < 1e-12, "{gaps:?} by {h}");
                        assert!(impact.impulse > 0.0, "{} by {h}", impact.impulse);
                    }
                }
            }
        }
    }
    Ok(())
}

/// Free, the motion by long steps is that by short ones.
#[test]
fn long_steps_have_the_impacts_of_short_ones() -> Outcome {
    let posts = Posts { depth: 0.0 };
    for h in [0.5, 1.0] {
        for start in starts(&posts) {
            let method = Impacts::reflecting(Variational::trapezoid());
            let [mut long, mut short] =
                [Integrator::new(&posts, method, h, start)?, Integrator::new(&posts, method, 0.005, start)?];
            long.take_steps((6.0 / h) as u64)?;
            short.take_steps(1200)?;
            assert_eq!(long.memory().total(), short.memory().total(), "from {start:?} by {h}");
            let apart = (long.q()[0] - short.q()[0]).hypot(long.q()[1] - short.q()[1]);
            assert!(apart < 1e-6, "{apart:e} from {start:?} by {h}");
        }
    }
    Ok(())
}
