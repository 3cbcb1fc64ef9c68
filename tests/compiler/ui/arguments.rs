//! The arguments of the attribute.

use dvi_core::prelude::*;

mod no_hamiltonian {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y))]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod no_one_form {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), hamiltonian = x * y)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod no_dynamics {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y))]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod nothing {
    use super::*;
    #[degenerate_lagrangian()]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod lagrangian_and_one_form {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), lagrangian = x * dot(y) - x, one_form = x * d(y))]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod all_three {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), lagrangian = x * dot(y) - x, one_form = x * d(y), hamiltonian = x)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod misspelt_argument {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonain = x * y)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod unknown_argument {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y, damping = x)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod argument_twice {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y, hamiltonian = x)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod coordinates_assigned {
    use super::*;
    #[degenerate_lagrangian(coordinates = (x, y), one_form = x * d(y), hamiltonian = x * y)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod hamiltonian_as_a_list {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian(x * y))]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod hamiltonian_is_empty {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod half_an_expression {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod two_expressions {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x y)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod comma_is_missing {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y) hamiltonian = x)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod comma_after_a_list_is_missing {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y) one_form = x * d(y), hamiltonian = x * y)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod literal_argument {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y, "x")]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod argument_without_value {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y, momenta)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod colon_for_equals {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form: x * d(y), hamiltonian = x)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod crate_is_no_path {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y, crate = 3)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod crate_is_text {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y, crate = "dvi_core")]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod closure_for_a_one_form {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = |x, y| x * d(y), hamiltonian = x)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod bar_before_another_argument {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x | y, momenta(p = x))]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod momentum_in_brackets {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * y, momenta[p = x])]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

fn main() {}
