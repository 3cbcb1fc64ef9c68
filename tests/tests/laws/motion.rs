//! The equations of motion that the library solves are those of the Lagrangian, d/dt ∂L/∂v = ∂L/∂q + F +
//! Gᵀλ, made of it in plain Rust by hyper-dual numbers.

use dvi_tests::schemes::Case;
use dvi_tests::schemes::equations::apart;

use super::{Outcome, below, of_every_kind};

fn rates_are_those_of_the_lagrangian(case: &Case) -> Outcome {
    let (subject, start) = (&case.subject, case.subject.start.concat());
    below(
        apart(&subject.field(subject.t, &start)?, &subject.rates(&start, subject.t)),
        1e-13,
        "another motion",
    )
}

of_every_kind!(rates_are_those_of_the_lagrangian);
