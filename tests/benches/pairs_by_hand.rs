//! The gradient of H of many vortices by hand, eight at a time.

use std::f64::consts::PI;

const LANES: usize = 8;
type Pack = [f64; LANES];

/// Adds ∇H to `gradient`, each pair once: of each vortex with eight others at a time, by the widest
/// instructions of the processor.
pub(crate) fn add_in_lanes(gamma: &[f64], q: &[f64], gradient: &mut [f64]) {
    pulp::Arch::new().dispatch(InLanes { gamma, q, gradient });
}

struct InLanes<'a> {
    gamma: &'a [f64],
    q: &'a [f64],
    gradient: &'a mut [f64],
}

impl pulp::WithSimd for InLanes<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _simd: S) {
        let Self { gamma, q, gradient } = self;
        let n = gamma.len();
        let (x, y) = q.split_at(n);
        let (of_x, of_y) = gradient.split_at_mut(n);
        for i in 0..n {
            let strength = -gamma[i] / (2.0 * PI);
            let first = (i + 1).next_multiple_of(LANES).min(n);
            let mut sums = [0.0; 2];
            for j in i + 1..first {
                let apart = [x[i] - x[j], y[i] - y[j]];
                let factor = strength * gamma[j] / (apart[0] * apart[0] + apart[1] * apart[1]);
                let force = [factor * apart[0], factor * apart[1]];
                sums = [sums[0] + force[0], sums[1] + force[1]];
                of_x[j] -= force[0];
                of_y[j] -= force[1];
            }
            let mut packs = [[0.0; LANES]; 2];
            for j in (first..n).step_by(LANES) {
                let at = j..j + LANES;
                add_eight(
                    [x[i], y[i], strength],
                    [&x[at.clone()], &y[at.clone()], &gamma[at.clone()]],
                    &mut packs,
                    [&mut of_x[at.clone()], &mut of_y[at]],
                );
            }
            of_x[i] += sums[0] + sum(&packs[0]);
            of_y[i] += sums[1] + sum(&packs[1]);
        }
    }
}

#[inline(always)]
fn add_eight(
    [x, y, strength]: [f64; 3],
    [xs, ys, gammas]: [&[f64]; 3],
    sums: &mut [Pack; 2],
    others: [&mut [f64]; 2],
) {
    let mut forces = [[0.0; LANES]; 2];
    for lane in 0..LANES {
        let apart = [x - xs[lane], y - ys[lane]];
        let factor = strength * gammas[lane] / (apart[0] * apart[0] + apart[1] * apart[1]);
        forces[0][lane] = factor * apart[0];
        forces[1][lane] = factor * apart[1];
    }
    for ((sums, forces), others) in sums.iter_mut().zip(&forces).zip(others) {
        for lane in 0..LANES {
            sums[lane] += forces[lane];
            others[lane] -= forces[lane];
        }
    }
}

/// Out of line, as it is called once for a vortex: else the compiler takes the lanes of the sums apart in
/// the loop.
#[inline(never)]
fn sum(pack: &Pack) -> f64 {
    pack.iter().sum()
}
