//! One-forms as lists of components, and Ω that is singular for certain.

use dvi_core::prelude::*;

mod too_many_components {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = [y, x, 0.0], hamiltonian = x * y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod too_few_components {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = [y], hamiltonian = x * y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod array_without_closure {
    use super::*;
    #[degenerate_lagrangian(coordinates(x[3], y[3]), one_form = [0.0, |j| x[j]], hamiltonian = x[0] * y[0])]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0, 2.0, 3.0], y: [0.0; 3] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod closure_for_a_single_coordinate {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = [|i| y, 0.0], hamiltonian = x * y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod component_with_two_indices {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[3], y[3]),
        one_form = [|i| y[i], |i, j| x[j]],
        hamiltonian = x[0] * y[0],
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0, 2.0, 3.0], y: [0.0; 3] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod odd_dimension {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y, z), one_form = x * d(y) + y * d(z), hamiltonian = x * y)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0, z: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod odd_array {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(z[3]),
        one_form = sum(0..3, |i| z[(i + 1) % 3] * d(z[i])),
        hamiltonian = z[0],
    )]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { z: [1.0; 3] });
    }
}

mod zero_one_form {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = [0.0, 0.0], hamiltonian = x * y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod zero_one_form_as_a_number {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = 0.0, hamiltonian = x * y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod exact_one_form {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y) + y * d(x), hamiltonian = x * y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod no_velocity_in_the_lagrangian {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), lagrangian = x * y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod coordinates_that_nothing_mentions {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y, u, w), one_form = x * d(y), hamiltonian = x * y + u)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0, u: 0.0, w: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod all_that_couples_couples_to_one {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x, y, u, w),
        one_form = x * d(y) + x * x * d(u) + x * d(w),
        hamiltonian = x * y + u * w,
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0, u: 0.0, w: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

fn main() {}
