//! Runs with many impacts: momenta, the energy, and no impact where there is none.

use dvi_core::methods::FreeFlight;
use dvi_core::prelude::*;
use dvi_examples::models::{EllipseBilliard, EllipseBilliardState};
use dvi_tests::Outcome;
use dvi_tests::larger;
use dvi_tests::zoo::impacts::{Circle, CircleState, Wavy, WavyState};

fn angular_momentum<M: FreeFlight<Circle, f64>>(method: Impacts<M>) -> Outcome {
    let start = CircleState { x: 0.3, y: -0.2, dot_x: 1.1, dot_y: 1.6 };
    let mut run = Integrator::new(&Circle, method, 0.05, start)?;
    let begin = run.momentum(0).ok_or("declared")?;
    let mut largest = 0.0;
    while run.memory().total() < 5000 {
        run.advance()?;
        largest = larger(largest, (run.momentum(0).ok_or("declared")? - begin).abs());
    }
    assert!(largest < 1e-12, "{largest:e}");
    Ok(())
}

#[test]
fn the_angular_momentum_in_a_circle_is_kept() -> Outcome {
    angular_momentum(Impacts::new(Variational::trapezoid()))?;
    angular_momentum(Impacts::new(Variational::midpoint()))?;
    angular_momentum(Impacts::reflecting(Variational::trapezoid()))?;
    angular_momentum(Impacts::reflecting(Galerkin::<3>::new()))
}

/// The energy at the point of impact is kept by one, the discrete energies by the other, whose steps change
/// the energy by an amount of order h² at each impact.
#[test]
fn reflections_keep_the_energy_for_many_bounces() -> Outcome {
    let start = WavyState { x: 0.3, y: 1.5, dot_x: 0.4, dot_y: 0.0 };
    let [mut early, mut late] = [[0.0_f64; 2]; 2];
    let system = Wavy { a: 0.6 };
    for (k, method) in
        [Impacts::reflecting(Variational::trapezoid()), Impacts::new(Variational::trapezoid())]
            .into_iter()
            .enumerate()
    {
        let mut run = Integrator::new(&system, method, 0.02, start)?;
        let begin = run.energy();
        while run.memory().total() < 50_000 {
            run.advance()?;
            let change = f64::abs(run.energy() - begin);
            let of = if run.memory().total() < 5000 { &mut early } else { &mut late };
            of[k] = larger(of[k], change);
        }
    }
    assert!(late[0] < 1.5 * early[0] && late[0] < 2e-4, "{early:?} {late:?}");
    assert!(late[1] > 10.0 * late[0] && late[1] < 2e-2, "{early:?} {late:?}");
    Ok(())
}

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
