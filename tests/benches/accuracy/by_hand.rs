//! Methods by hand, on right-hand sides by hand: the classical Runge–Kutta method, and compositions of
//! Verlet's steps.

use std::hint::black_box;

use crate::fields::{Field, Forces};
use crate::problem::{Method, Run, Scale, Seen, Watch};

/// The composition of Kahan & Li 1997 of order 8, up to the middle one of its 17 coefficients.
const KAHAN_LI_8: [f64; 9] = [
    0.130_202_483_088_890_07,
    0.561_162_981_775_108_4,
    -0.389_474_962_644_847_27,
    0.158_841_906_555_155_6,
    -0.395_903_894_133_237_57,
    0.184_539_640_978_315_7,
    0.258_374_387_686_322_04,
    0.295_011_723_609_310_3,
    -0.605_508_533_830_034_6,
];

/// RK4 up to `end`.
pub(crate) fn rk4<const N: usize>(
    field: impl Field<N>,
    start: [f64; N],
    end: f64,
    scale: Scale,
    counts: Vec<u64>,
) -> Method {
    let run = |steps: u64| {
        let (alone, watched, h) = (field.clone(), field.clone(), end / steps as f64);
        Run::new(
            steps as f64,
            move || {
                let mut y = black_box(start);
                (0..steps).for_each(|_| y = step(&alone, &y, h));
                black_box(y)[0].is_finite()
            },
            move || {
                let (mut y, mut watch) = (start, Watch::new(watched.energy(&start), scale));
                for _ in 0..steps {
                    y = step(&watched, &y, h);
                    watch.note(watched.energy(&y));
                }
                Some(watch.seen(4 * steps))
            },
        )
    };
    Method { name: "RK4 by hand".into(), runs: counts.into_iter().map(run).collect() }
}

#[inline(always)]
fn step<const N: usize>(field: &impl Field<N>, y: &[f64; N], h: f64) -> [f64; N] {
    let moved = |by: f64, slope: &[f64; N]| std::array::from_fn(|i| y[i] + by * slope[i]);
    let first = field.slope(y);
    let second = field.slope(&moved(0.5 * h, &first));
    let third = field.slope(&moved(0.5 * h, &second));
    let fourth = field.slope(&moved(h, &third));
    std::array::from_fn(|i| y[i] + h / 6.0 * (first[i] + 2.0 * (second[i] + third[i]) + fourth[i]))
}

/// Kahan–Li 8 of Verlet's steps up to `end`, one force for each of the 17, with compensated sums.
pub(crate) fn kahan_li<const N: usize>(
    forces: impl Forces<N>,
    start: [[f64; N]; 2],
    end: f64,
    scale: Scale,
    counts: Vec<u64>,
) -> Method {
    let run = |steps: u64| {
        let (alone, watched, h) = (forces.clone(), forces.clone(), end / steps as f64);
        Run::new(
            steps as f64,
            move || {
                let mut at = Point::new(&alone, black_box(start));
                (0..steps).for_each(|_| at.step(&alone, h));
                black_box(at.q.sum)[0].is_finite()
            },
            move || -> Option<Seen> {
                let mut at = Point::new(&watched, start);
                let mut watch = Watch::new(watched.energy(&start[0], &start[1]), scale);
                for _ in 0..steps {
                    at.step(&watched, h);
                    watch.note(watched.energy(&at.q.sum, &at.v.sum));
                }
                Some(watch.seen(17 * steps + 1))
            },
        )
    };
    Method { name: "Kahan–Li 8 of Verlet by hand".into(), runs: counts.into_iter().map(run).collect() }
}

/// Where a run is.
struct Point<const N: usize> {
    q: Sum<N>,
    v: Sum<N>,
    a: [f64; N],
}

impl<const N: usize> Point<N> {
    fn new(forces: &impl Forces<N>, [q, v]: [[f64; N]; 2]) -> Self {
        Self { a: forces.acceleration(&q), q: Sum::new(q), v: Sum::new(v) }
    }

    #[inline(always)]
    fn step(&mut self, forces: &impl Forces<N>, h: f64) {
        let mirrored = KAHAN_LI_8.iter().chain(KAHAN_LI_8.iter().rev().skip(1));
        for gamma in mirrored {
            let h = gamma * h;
            self.v.add(0.5 * h, &self.a);
            let velocity = self.v.sum;
            self.q.add(h, &velocity);
            self.a = forces.acceleration(&self.q.sum);
            self.v.add(0.5 * h, &self.a);
        }
    }
}

/// Sums with what rounding has left out of them (Kahan 1965).
struct Sum<const N: usize> {
    sum: [f64; N],
    rest: [f64; N],
}

impl<const N: usize> Sum<N> {
    fn new(sum: [f64; N]) -> Self {
        Self { sum, rest: [0.0; N] }
    }

    #[inline(always)]
    fn add(&mut self, by: f64, slope: &[f64; N]) {
        for i in 0..N {
            let term = by * slope[i] + self.rest[i];
            let sum = self.sum[i] + term;
            self.rest[i] = term - (sum - self.sum[i]);
            self.sum[i] = sum;
        }
    }
}
