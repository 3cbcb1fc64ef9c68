//! The equations of a long step have several solutions, and that of the motion is the one that is reached
//! from a step of no length without a jump. Random systems and discs with light wheels, against that
//! continuation.

use core::f64::consts::PI;

use dvi_core::NonholonomicLagrangian;
use dvi_core::prelude::*;
use dvi_core::space::Sink;
use dvi_tests::zoo::nonholonomic::Bundle;
use dvi_tests::{Numbers, Outcome, larger};
use nalgebra::{DMatrix, DVector};

use crate::continuation::continued;

/// A disc that rolls upright, whose wheel is light.
#[lagrangian(
    coordinates(x, y, heading, roll),
    lagrangian = (dot(x).powi(2) + dot(y).powi(2)) / 2.0 + 0.25 * dot(heading).powi(2) / 2.0 + inertia * dot(roll).powi(2) / 2.0,
    nonholonomic = [dot(x) - heading.cos() * dot(roll), dot(y) - heading.sin() * dot(roll)],
)]
#[derive(Clone, Copy, Debug)]
struct Disc {
    inertia: f64,
}

/// w₀ ∂a/∂q + w₁ A at (`q`, `v`), and a.
fn linearised<S: NonholonomicLagrangian>(
    system: &S,
    q: &[f64],
    v: &[f64],
    weights: [f64; 2],
) -> (Vec<f64>, DMatrix<f64>) {
    struct Entries(DMatrix<f64>);
    impl Sink<f64> for Entries {
        fn add(&mut self, row: usize, column: usize, entry: f64) {
            self.0[(row, column)] += entry;
        }
    }
    let (mut out, mut entries) = (vec![0.0; 2], Entries(DMatrix::zeros(2, 4)));
    system.velocity_constraint_jacobian(q, v, 0.0, weights, &mut out, &mut entries);
    (out, entries.0)
}

/// The velocity Δ/h of a step by continuation in its length; `None` where solutions meet on the way.
fn velocity<S: NonholonomicLagrangian>(
    system: &S,
    m: [f64; 4],
    q: &[f64],
    v: &[f64],
    h: f64,
) -> Option<Vec<f64>> {
    let (_, before) = linearised(system, q, v, [0.0, 1.0]);
    let start = DVector::from_fn(6, |i, _| if i < 4 { v[i] } else { 0.0 });
    let unknowns = continued((h, 100, 4), start, |h, unknowns| {
        let w = &unknowns.as_slice()[..4];
        let middle: Vec<f64> = (0..4).map(|i| q[i] + h / 2.0 * w[i]).collect();
        let (a, rows) = linearised(system, &middle, w, [h / 2.0, 1.0]);
        let residual = DVector::from_fn(6, |i, _| match i {
            0..4 => m[i] * (w[i] - v[i]) - (0..2).map(|k| before[(k, i)] * unknowns[4 + k]).sum::<f64>(),
            k => a[k - 4],
        });
        let matrix = DMatrix::from_fn(6, 6, |i, j| match (i < 4, j < 4) {
            (true, true) if i == j => m[i],
            (true, false) => -before[(j - 4, i)],
            (false, true) => rows[(i - 4, j)],
            _ => 0.0,
        });
        (residual, matrix)
    })?;
    Some(unknowns.as_slice()[..4].to_vec())
}

/// Of steps: how many end where the continuation does, how many at another place, and how many fail although
/// there is such an end.
#[derive(Debug, Default)]
struct Tally {
    agree: usize,
    differ: usize,
    lost: usize,
}

impl Tally {
    /// One step from near `q` and `v`.
    fn add<S: OnConstraints + NonholonomicLagrangian>(
        &mut self,
        system: &S,
        m: [f64; 4],
        [q, v]: [[f64; 4]; 2],
        h: f64,
    ) -> Outcome {
        let start = S::State::read(&|block| system.block_len(block), &q, &v);
        let Ok(start) = system.projected(0.0, &start) else { return Ok(()) };
        let mut run = Integrator::new(system, Constrained::new(Midpoint), h, start)?;
        let v: Vec<f64> = system.values(&run.state())?.skip(4).collect();
        let expected = velocity(system, m, &q, &v, h);
        match (run.advance().is_ok(), expected) {
            (true, Some(w)) => {
                let apart = (0..4).map(|i| ((run.q()[i] - q[i]) / h - w[i]).abs() / (1.0 + w[i].abs()));
                if apart.fold(0.0, larger) < 1e-7 { self.agree += 1 } else { self.differ += 1 }
            }
            (true, None) => self.differ += 1,
            (false, Some(_)) => self.lost += 1,
            (false, None) => {}
        }
        Ok(())
    }
}

/// Steps with h up to `longest` of systems whose coefficients are of order one, with masses from e⁻ˢ to eˢ
/// for a `spread` s.
fn of_bundles(spread: f64, affine: f64, longest: f64) -> Outcome<Tally> {
    let (mut tally, mut numbers) = (Tally::default(), Numbers(3));
    for _ in 0..2000 {
        let m = core::array::from_fn(|_| (spread * numbers.next()).exp());
        let a = core::array::from_fn(|_| core::array::from_fn(|_| numbers.next()));
        let b = core::array::from_fn(|_| core::array::from_fn(|_| core::array::from_fn(|_| numbers.next())));
        let c = core::array::from_fn(|_| affine * numbers.next());
        let [q, v] = core::array::from_fn(|_| core::array::from_fn(|_| numbers.next()));
        let h = longest * (0.505 + 0.495 * numbers.next());
        tally.add(&Bundle { m, a, b, c }, m, [q, v], h)?;
    }
    Ok(tally)
}

/// Steps in which a disc turns by up to three radians.
fn of_discs(inertia: f64) -> Outcome<Tally> {
    let (mut tally, mut numbers) = (Tally::default(), Numbers(3));
    for _ in 0..1000 {
        let [x, y, heading, roll] = [0, 1, 2, 3].map(|_| PI * numbers.next());
        let (turn, speed, h) = (3.0 * numbers.next(), 3.0 * numbers.next(), 0.505 + 0.495 * numbers.next());
        let v = [heading.cos() * speed, heading.sin() * speed, turn, speed];
        tally.add(&Disc { inertia }, [1.0, 1.0, 0.25, inertia], [[x, y, heading, roll], v], h)?;
    }
    Ok(tally)
}

/// Steps end where the motion leads, but for a few of those in which coefficients change by as much as they
/// are.
#[test]
fn steps_end_on_the_branch_of_the_motion() -> Outcome {
    for affine in [0.0, 1.0] {
        for tally in [of_bundles(0.0, affine, 0.3)?, of_bundles(5.0, affine, 0.3)?] {
            assert!(tally.agree > 1800 && tally.differ <= 1 && tally.lost <= 2, "{tally:?}");
        }
        for (tally, rare) in [(of_bundles(0.0, affine, 2.0)?, 150), (of_bundles(5.0, affine, 2.0)?, 60)] {
            assert!(tally.agree > 1300 && rare * tally.differ < tally.agree, "{tally:?}");
        }
    }
    for inertia in [1.0, 1e-3, 1e-6] {
        let tally = of_discs(inertia)?;
        assert!(tally.agree == 1000, "{tally:?}");
    }
    Ok(())
}
