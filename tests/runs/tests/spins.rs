//! Spins over a million steps: lengths, the total spin and the energy.

use dvi_core::prelude::*;
use dvi_tests::{Outcome, apart, larger};

/// A ring of spins, by Heisenberg.
#[degenerate_lagrangian(
    coordinates(s[N]: S2),
    one_form    = sum(0..N, |i| area(s[i])),
    hamiltonian = -sum(0..N, |i| s[i].dot(s[(i + 1) % N])),
    momenta(
        total_x = sum(0..N, |i| s[i])[0],
        total_y = sum(0..N, |i| s[i])[1],
        total_z = sum(0..N, |i| s[i])[2],
    ),
)]
struct Ring<const N: usize>;

fn start() -> RingState<6> {
    let spin = |i: usize| {
        let ((sin, cos), azimuth) = ((0.3 + 0.45 * i as f64).sin_cos(), 2.0 * i as f64);
        [sin * azimuth.cos(), sin * azimuth.sin(), cos]
    };
    RingState { s: core::array::from_fn(spin) }
}

/// By how much lengths, total spin and energy have changed at most, in the first tenth and in all of a
/// million steps.
fn changes(method: impl Method<Ring<6>, f64>) -> Outcome<[[f64; 3]; 2]> {
    let mut run = Integrator::new(&Ring, method, 0.1, start())?;
    let total = |run: &Integrator<_, _>| run.momenta().map(|(_, value)| value).collect::<Vec<f64>>();
    let (energy, before) = (run.energy(), total(&run));
    let (mut largest, mut early) = ([0.0; 3], [0.0; 3]);
    for part in 0..1000 {
        run.take_steps(1000)?;
        let lengths = run.state().s.map(|[x, y, z]| ((x * x + y * y + z * z).sqrt() - 1.0).abs());
        let off = lengths.into_iter().fold(0.0, larger);
        let found = [off, apart(&before, &total(&run)), (run.energy() - energy).abs()];
        largest = core::array::from_fn(|k| larger(largest[k], found[k]));
        if part == 99 {
            early = largest;
        }
    }
    Ok([early, largest])
}

#[test]
fn what_is_quadratic_in_spinors_is_kept_to_rounding() -> Outcome {
    let kept = |[early, largest]: [[f64; 3]; 2], rounding: f64| {
        let [length, total, energy] = largest;
        // The total is one of six.
        assert!(length < rounding && total < rounding * 6_f64.sqrt(), "{length:e} {total:e}");
        assert!(energy < 1.6 * early[2] && early[2] < 5e-3, "{energy:e}");
    };
    // The sum of a million steps with one rounding error each, of random sign.
    let walk = f64::EPSILON * 1e6_f64.sqrt();
    kept(changes(Sigma::midpoint())?, walk);
    // Smaller where errors are those of increments.
    let compensated = Sigma { summation: Summation::Compensated, ..Sigma::midpoint() };
    kept(changes(compensated)?, walk / 4.0);
    kept(changes(Gauss::<2>::new())?, walk / 4.0);
    Ok(())
}
