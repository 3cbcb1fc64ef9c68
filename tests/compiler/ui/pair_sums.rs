//! Systems whose pairs cannot be summed fast.

use dvi_core::fast_sum::FastSum;
use dvi_core::prelude::*;

/// Vortices whose number is known when the program is compiled.
#[degenerate_lagrangian(
    coordinates(x[N], y[N]),
    one_form = sum(0..N, |j| x[j] * d(y[j])),
    hamiltonian = sum_pairs(0..N, |j, k| ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2)).ln()),
)]
struct Few<const N: usize>;

/// Charges whose forces are not along the line between them.
#[lagrangian(
    coordinates(x[n], y[n]),
    lagrangian = sum(0..n, |j| dot(x[j]).powi(2) + dot(y[j]).powi(2))
        - sum_pairs(0..n, |j, k| 1 / ((x[j] - x[k]).powi(2) + 2 * (y[j] - y[k]).powi(2) + 1)),
)]
struct Oblique {
    n: usize,
}

/// Bodies on a sphere, by constraints.
#[lagrangian(
    coordinates(x[n], y[n], z[n]),
    lagrangian = sum(0..n, |j| dot(x[j]).powi(2) + dot(y[j]).powi(2) + dot(z[j]).powi(2))
        - sum_pairs(0..n, |j, k| 1 / ((x[j] - x[k]).powi(2) + (y[j] - y[k]).powi(2) + (z[j] - z[k]).powi(2)).sqrt()),
    constraint(i in 0..n) = x[i].powi(2) + y[i].powi(2) + z[i].powi(2) - 1,
)]
struct OnASphere {
    n: usize,
}

fn main() {
    let _ = FastSum::<_, 2>::new(&Few::<3>, 1e-6);
    let _ = FastSum::<_, 2>::new(&Oblique { n: 3 }, 1e-6);
    let _ = FastSum::<_, 3>::new(&OnASphere { n: 3 }, 1e-6);
}
