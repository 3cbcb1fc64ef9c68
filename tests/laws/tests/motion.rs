//! What the library says of a state: L, E = ∂L/∂v·v − L, and the motion, d/dt ∂L/∂v = ∂L/∂q + F + Gᵀλ, which
//! are made of L by hyper-dual numbers.

use dvi_laws::Case;
use dvi_laws::equations::apart;

use super::{Outcome, below, of_every_kind};

fn states_are_those_of_the_lagrangian(case: &Case) -> Outcome {
    let (subject, start) = (&case.subject, case.subject.start.concat());
    below(
        apart(&subject.said(subject.t, &start)?, &subject.expected(&start, subject.t)),
        1e-13,
        "another motion",
    )
}

of_every_kind!(states_are_those_of_the_lagrangian);
