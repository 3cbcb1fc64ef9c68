//! Indices, ranges and sums.

use dvi_core::prelude::*;

mod literal_index {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = x[0] * x[4] + y[0],
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod negative_index {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = x[-1] + y[0],
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod huge_index {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = x[18446744073709551615] + y[0],
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod neighbour_of_the_last {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = sum(0..4, |j| (x[j + 1] - x[j]).powi(2)),
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod neighbour_of_the_first {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = sum(0..=3, |j| x[j - 1] * x[j]),
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod parameter_array_too_short {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = sum(0..4, |j| a[j] * x[j] * x[j]) + y[0],
    )]
    pub struct System {
        pub a: [f64; 3],
    }
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System { a: [1.0; 3] }, Sigma::midpoint(), 0.1, state);
    }
}

mod matrix_too_narrow {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = a[0][2] * x[0] + y[0],
    )]
    pub struct System {
        pub a: [[f64; 2]; 3],
    }
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System { a: [[1.0; 2]; 3] }, Sigma::midpoint(), 0.1, state);
    }
}

mod one_index_for_a_matrix {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = a[0] * x[0] + y[0],
    )]
    pub struct System {
        pub a: [[f64; 2]; 3],
    }
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System { a: [[1.0; 2]; 3] }, Sigma::midpoint(), 0.1, state);
    }
}

mod two_indices_for_a_list {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = a[0][1] * x[0] + y[0],
    )]
    pub struct System {
        pub a: [f64; 3],
    }
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System { a: [1.0; 3] }, Sigma::midpoint(), 0.1, state);
    }
}

mod index_outside_of_its_sum {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = sum(0..4, |j| x[j] * x[j]) + y[j],
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod index_as_a_number {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = sum(0..4, |j| j * x[j]) + y[0],
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod number_as_an_index {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = x[1.0] + y[a],
    )]
    pub struct System {
        pub a: f64,
    }
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System { a: 1.0 }, Sigma::midpoint(), 0.1, state);
    }
}

mod misspelt_index {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = sum(0..4, |site| x[site] * y[sit]),
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod array_without_index {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = x * x + y[0],
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod parameter_array_without_index {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = a * x + y)]
    pub struct System {
        pub a: Vec<f64>,
    }
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System { a: vec![1.0] }, Sigma::midpoint(), 0.1, state);
    }
}

mod index_on_a_single_coordinate {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x[0] + y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod index_on_a_single_parameter {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = a[0] * x + y)]
    pub struct System {
        pub a: f64,
    }
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System { a: 1.0 }, Sigma::midpoint(), 0.1, state);
    }
}

mod two_indices_for_a_coordinate {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = x[0][1] + y[0],
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod index_of_an_expression {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = (x[0] + y[0])[0],
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod product_of_indices {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = sum_pairs(0..2, |j, k| x[j * k] * y[j]),
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod quotient_of_indices {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = sum(0..4, |j| x[j / 2] * y[j]),
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod remainder_by_zero {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = sum(0..4, |j| x[j % 0] * y[j]),
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod range_without_end {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = sum(0.., |j| x[j] * y[j]),
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod range_that_is_none {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = sum(4, |j| x[j] * y[j]),
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod sum_without_closure {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = sum(0..4, x[0] * y[0]),
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod sum_over_two_indices {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = sum(0..4, |j, k| x[j] * y[k]),
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod pairs_over_one_index {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = sum_pairs(0..4, |j| x[j] * y[j]),
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod index_that_is_a_pattern {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = sum(0..4, |(j, k)| x[j] * y[j]),
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod range_that_is_empty {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = sum(4..0, |j| x[j] * y[j]) + x[0],
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod cast_to_an_integer {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[4], y[4]),
        one_form = sum(0..4, |j| x[j] * d(y[j])),
        hamiltonian = sum(0..4, |j| j as u32 * x[j]) + y[0],
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0; 4], y: [0.0; 4] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod two_indices_with_one_name {
    use super::*;
    #[lagrangian(
        coordinates(q[n][n]),
        lagrangian = sum(0..n, |i| sum(0..n, |j| dot(q[i][j]).powi(2))) / 2.0
            - sum_pairs(0..n, |i, i| q[i][0] * q[0][i]),
        force(q) = |j, j| -q[j][j],
    )]
    pub struct System {
        pub n: usize,
    }
}

fn main() {}
