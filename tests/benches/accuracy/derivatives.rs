//! Residual and Jacobian of a step on four vortices: generated, by hand, and by dual numbers at run time.

use std::f64::consts::PI;
use std::hint::black_box;

use cpu_time::ThreadTime;
use nalgebra::SVector;
use num_dual::{DualNum, partial_hessian};

use crate::alternatives::Alternatives;
use dvi_kernels as kernels;

const STEPS: u64 = 20_000;
const ROUNDS: usize = 15;
const H: f64 = 0.1;
/// The place of these kernels in their list.
const RESIDUAL_AND_MATRIX: usize = 5;

/// L_d(q1, q2) of the midpoint rule for vortices of strength one, ½(x dy − y dx) − H dt.
fn discrete_lagrangian<D: DualNum<Primitive = f64> + Copy>(q1: &[D], q2: &[D]) -> D {
    let middle: [D; 8] = std::array::from_fn(|i| (q1[i] + q2[i]) * 0.5);
    let mut action = D::from(0.0);
    for j in 0..4 {
        action += (middle[j] * (q2[4 + j] - q1[4 + j]) - middle[4 + j] * (q2[j] - q1[j])) * 0.5;
        for k in j + 1..4 {
            let (dx, dy) = (middle[j] - middle[k], middle[4 + j] - middle[4 + k]);
            action -= (dx * dx + dy * dy).ln() * (H / (4.0 * PI));
        }
    }
    action
}

/// p + D₁L_d(q1, q2) and D₂D₁L_d(q1, q2).
fn by_dual_numbers([p, q1, q2]: &[SVector<f64, 8>; 3]) -> f64 {
    let both = |(q1, q2): (SVector<_, 8>, SVector<_, 8>)| discrete_lagrangian(q1.as_slice(), q2.as_slice());
    let (_, slope, _, matrix) = partial_hessian(both, (q1, q2));
    black_box((p + slope, matrix)).1[(0, 5)]
}

/// Computes them many times, and returns how often.
type Way = Box<dyn Fn() -> u64>;

/// Prints nanoseconds of each way, medians of interleaved measurements.
pub(crate) fn print(alternatives: &Alternatives) {
    let q = [0.0, 0.01, 0.02].map(|shift| SVector::<f64, 8>::from_fn(|i, _| ((i * i) as f64).sin() + shift));
    let dual = move || {
        (0..STEPS / 20).for_each(|_| {
            black_box(by_dual_numbers(black_box(&q)));
        });
        STEPS / 20
    };
    let [generated, by_hand] = kernels::KERNELS[RESIDUAL_AND_MATRIX];
    let kernel = |name: &'static str| {
        move || {
            black_box(kernels::run(name, STEPS));
            STEPS
        }
    };
    let ways: [(&str, Way); 3] = [
        ("generated", Box::new(kernel(generated))),
        ("by hand", Box::new(kernel(by_hand))),
        ("num-dual at run time", Box::new(dual)),
    ];
    let mut times = [(); 3].map(|()| Vec::new());
    for _ in 0..ROUNDS {
        for ((_, way), times) in ways.iter().zip(&mut times) {
            let begin = ThreadTime::now();
            let count = way();
            times.push(1e9 * begin.elapsed().as_secs_f64() / count as f64);
        }
    }
    println!("\n| residual and Jacobian of a midpoint step, four vortices | ns |\n|---|---|");
    for ((name, _), times) in ways.iter().zip(&mut times) {
        times.sort_by(f64::total_cmp);
        println!("| {name} | {:.1} |", times[ROUNDS / 2]);
    }
    for point in alternatives.of("derivatives") {
        println!("| {} | {:.1} |", point.method, 1e6 * point.milliseconds);
    }
}
