//! Names, functions and their arguments. Each case: one mistake, one error, and a state that exists.

use dvi_core::prelude::*;

mod unknown_name {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = x * d(y),
        hamiltonian = omga * x * x + y * y,
    )]
    pub struct System {
        pub omega: f64,
    }
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System { omega: 1.0 }, Sigma::midpoint(), 0.1, state);
    }
}

mod name_like_nothing {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * charge)]
    pub struct System {
        pub omega: f64,
    }
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System { omega: 1.0 }, Sigma::midpoint(), 0.1, state);
    }
}

mod unknown_field_of_self {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = self.omgea * x)]
    pub struct System {
        pub omega: f64,
    }
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System { omega: 1.0 }, Sigma::midpoint(), 0.1, state);
    }
}

mod unknown_method {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x.sqr() + y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod unknown_function {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = bessel(x) + y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod misspelt_sum {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x[2], y[2]),
        one_form = sum(0..2, |j| x[j] * d(y[j])),
        hamiltonian = sum_pair(0..2, |j, k| x[j] * x[k]),
    )]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: [1.0, 2.0], y: [0.0, 1.0] };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod function_instead_of_method {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = sin(x) + y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod undeclared_path {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = special::gamma(x))]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod too_many_arguments {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x.sin(y))]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod too_few_arguments {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x.atan2() + y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod own_function_with_two_arguments {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = x * d(y),
        hamiltonian = f(x, y),
        functions(f = [sin, cos, minus_sin]),
    )]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod exponent_that_is_no_literal {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x.powi(n) + y)]
    pub struct System {
        pub n: i32,
    }
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System { n: 2 }, Sigma::midpoint(), 0.1, state);
    }
}

mod exponent_beyond_reason {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x.powi(-2147483648) + y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod divided_by_zero {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x / 0.0 + y)]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod value_of_a_let_is_unknown {
    use super::*;
    #[degenerate_lagrangian(
        coordinates(x, y),
        one_form = x * d(y),
        hamiltonian = {
            let r2 = x * x + z * z;
            r2.sqrt() + 1.0 / r2
        },
    )]
    pub struct System;
    pub fn run() {
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, SystemState { x: 1.0, y: 0.0 });
    }
}

mod own_function_as_a_method {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x.f() + y, functions(f = [f, df, d2f]))]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod number_with_a_suffix {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = 2u8 * x + y)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod number_beyond_all {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = 1e999 * x + y)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

mod logarithm_of_zero {
    use super::*;
    #[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = 0.0.ln() * x + y)]
    pub struct System;
    pub fn run() {
        let state = SystemState { x: 1.0, y: 0.0 };
        let _ = Integrator::new(&System, Sigma::midpoint(), 0.1, state);
    }
}

fn main() {}
