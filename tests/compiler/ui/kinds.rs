//! A method, a step or a state that does not fit its system.

use dvi_core::prelude::*;

#[degenerate_lagrangian(coordinates(x, y), one_form = x * d(y), hamiltonian = x * x + y * y)]
pub struct Degenerate;

#[lagrangian(coordinates(x), lagrangian = dot(x) * dot(x) / 2.0 - x * x)]
pub struct Regular;

fn exponent_of_steps_without_a_discrete_lagrangian() {
    let state = DegenerateState { x: 1.0, y: 0.0 };
    let run = Integrator::new(&Degenerate, RungeKutta::classical(), 0.1, state).unwrap();
    let _ = dvi_core::diagnostics::LyapunovExponent::new(&run);
}

#[degenerate_lagrangian(
    coordinates(z[3], w),
    one_form = z[0] * d(z[1]) + z[1] * z[2] * d(w) + w * d(z[2]),
    hamiltonian = z[0] * z[0] + z[1] * w,
)]
pub struct OutOfClass;

fn one_step_scheme_out_of_class() {
    let state = OutOfClassState { z: [1.0; 3], w: 0.0 };
    let _ = Integrator::new(&OutOfClass, OneStep::midpoint(), 0.1, state);
}

fn integer_step() {
    let state = DegenerateState { x: 1.0, y: 0.0 };
    let _ = Integrator::new(&Degenerate, Sigma::midpoint(), 1, state);
}

fn integers_in_a_state() {
    let state = DegenerateState { x: 1, y: 0 };
    let _ = Integrator::new(&Degenerate, Sigma::midpoint(), 0.1, state);
}

fn more_stages_than_there_are() {
    let state = RegularState { x: 1.0, dot_x: 0.0 };
    let mut run = Integrator::new(&Regular, Gauss::<9>::new(), 0.1, state).unwrap();
    run.take_steps(100).unwrap();
    println!("{:?} {}", run.state(), run.energy());
}

fn main() {}
