//! Impacts that are hard to see: within a step, at its end, behind other surfaces, near the end of the
//! domain of L.

use approx::{abs_diff_eq, assert_abs_diff_eq, assert_relative_eq};
use dvi_core::prelude::*;
use dvi_tests::zoo::impacts::{Ball, BallState};

use super::Outcome;

/// A free particle beside a round post, whose gap is the distance from it, with a wall behind.
#[lagrangian(
    coordinates(x, y),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0,
    impact = [(x * x + y * y).sqrt() - r, wall - x],
)]
struct Post {
    r: f64,
    wall: f64,
}

/// Head-on, the distance has its kink in the post.
#[test]
fn a_post_is_not_passed() -> Outcome {
    for (r, h) in [(0.1, 0.5), (0.01, 0.5), (0.5, 4.0), (0.1, 4.0)] {
        for wall in [0.7, 0.3, 9.0] {
            let post = Post { r, wall };
            let start = PostState { x: -1.3, y: 0.0, dot_x: 1.0, dot_y: 0.0 };
            let mut run = Integrator::new(&post, Impacts::reflecting(Variational::trapezoid()), h, start)?;
            while run.time() < 8.0 {
                run.advance()?;
            }
            assert_eq!(run.memory().total(), 1, "{r} by {h} before {wall}");
            let expected = -r - (run.time() - (1.3 - r));
            assert_abs_diff_eq!(run.state().x, expected, epsilon = 1e-12);
        }
    }
    Ok(())
}

/// Elastic bounces that fall on the end of a step, but for rounding.
#[test]
fn a_bounce_at_the_end_of_a_step_is_one() -> Outcome {
    for k in (0..1000).step_by(7) {
        for parts in [1.0, 2.0, 5.0, 10.0] {
            let height = 0.1 + f64::from(k) * 0.00137;
            let ball = Ball { m: 1.0 };
            let h = (2.0 * height).sqrt() / parts;
            let method = Impacts::reflecting(Variational::trapezoid());
            let mut run = Integrator::new(&ball, method, h, BallState { y: height, dot_y: 0.0 })?;
            run.take_steps(10 * parts as u64)?;
            assert_relative_eq!(run.energy(), height, epsilon = 0.0, max_relative = 1e-12);
            assert_relative_eq!(run.state().y, height, epsilon = 0.0, max_relative = 1e-7);
        }
    }
    Ok(())
}

/// An attraction that has no bound behind the surface, and steps of which none is short there.
#[test]
fn the_place_of_an_impact_is_on_the_surface() -> Outcome {
    #[lagrangian(coordinates(r), lagrangian = dot(r).powi(2) / 2.0 + 1.0 / r, impact = r - 0.1)]
    struct Falling;
    for method in [Impacts::new(Variational::trapezoid()), Impacts::reflecting(Variational::trapezoid())] {
        for k in 0..200 {
            let start = FallingState { r: 0.3 + 0.002 * f64::from(k), dot_r: 0.0 };
            let mut run = Integrator::new(&Falling, method, 0.03, start)?;
            for _ in 0..200 {
                run.advance()?;
                assert!(run.state().r > 0.1 - 1e-14, "{}", run.state().r);
                for impact in run.memory().impacts() {
                    assert!(abs_diff_eq!(impact.q[0], 0.1, epsilon = 1e-14), "{:?}", impact.q);
                }
            }
        }
    }
    Ok(())
}

#[test]
fn a_surface_before_the_end_of_the_domain_is_met() -> Outcome {
    #[lagrangian(
        coordinates(y),
        lagrangian = dot(y).powi(2) / 2.0 - 0.001 * y.sqrt(),
        impact = y - d,
    )]
    struct Rooted {
        d: f64,
    }
    for d in [0.5, 0.3, 0.1, 0.01] {
        let system = Rooted { d };
        let start = RootedState { y: 1.0, dot_y: -1.0 };
        let mut run = Integrator::new(&system, Impacts::reflecting(Variational::trapezoid()), 1.2, start)?;
        run.advance()?;
        assert_eq!(run.memory().impacts().len(), 1, "{d}");
        let expected = d + (1.2 - (1.0 - d));
        assert_abs_diff_eq!(run.state().y, expected, epsilon = 1e-2);
    }
    Ok(())
}

/// Nothing presses them on each other.
#[test]
fn free_balls_that_touch_stay_together() -> Outcome {
    #[lagrangian(
        coordinates(x[n]),
        lagrangian = sum(0..n, |i| dot(x[i]).powi(2) / 2.0),
        impact(i in 1..n) = x[i] - x[i - 1] - d,
    )]
    struct Cradle {
        n: usize,
        d: f64,
    }
    for d in [0.1, 0.3, 1.0] {
        let cradle = Cradle { n: 5, d };
        for speed in [0.0, 0.7] {
            let x = (0..5).map(|i| f64::from(i) * d).collect();
            let start = CradleState { x, dot_x: vec![speed; 5] };
            let method = Impacts::reflecting(Variational::trapezoid());
            let mut run = Integrator::new(&cradle, method, 0.1, start)?;
            run.take_steps(1000)?;
            for (i, &x) in run.state().x.iter().enumerate() {
                let expected = i as f64 * d + 100.0 * speed;
                assert_abs_diff_eq!(x, expected, epsilon = 1e-10);
            }
        }
        // One ball comes in, and one goes out.
        let mut x: Vec<f64> = (0..5).map(|i| f64::from(i) * d).collect();
        x[0] = -1.0;
        let start = CradleState { x, dot_x: vec![1.0, 0.0, 0.0, 0.0, 0.0] };
        let method = Impacts::reflecting(Variational::trapezoid());
        let mut run = Integrator::new(&cradle, method, 0.1, start)?;
        run.take_steps(30)?;
        for (found, expected) in run.state().dot_x.iter().zip([0.0, 0.0, 0.0, 0.0, 1.0]) {
            assert_abs_diff_eq!(*found, expected, epsilon = 1e-12);
        }
    }
    Ok(())
}

#[test]
fn the_discrete_energy_is_kept_in_single_precision() -> Outcome {
    #[lagrangian(
        coordinates(x, y),
        lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 - y - 0.3 * x * x * y - 0.1 * x.powi(4),
        impact = [y - 0.3 * x.cos(), 1.2 - y, x + 1.0, 1.0 - x],
    )]
    struct Room;
    let start: RoomStateOf<f32> = RoomStateOf { x: 0.7286, y: 0.2475, dot_x: -0.9299, dot_y: -1.0997 };
    for h in [0.1, 0.02, 0.005_f32] {
        let mut run = Integrator::new(&Room, Impacts::new(Variational::midpoint()), h, start)?;
        run.take_steps((100.0 / h) as u64)?;
        assert!(run.memory().total() > 50);
        assert_eq!(run.memory().grazing(), 0, "by {h}");
    }
    Ok(())
}
