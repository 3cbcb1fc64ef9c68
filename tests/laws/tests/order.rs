//! The error after a given time falls like hᵖ, with the order p that a scheme says it has. The motion is
//! that of the equations of motion, which are made from the Lagrangian by hyper-dual
//! numbers.

use dvi_core::prelude::convergence_order;
use dvi_laws::Case;
use dvi_laws::equations::apart;

use super::{Outcome, below, of_every_kind};

/// Errors that are below these have the slope of short steps, and are above rounding.
const SMALL: [f64; 3] = [1e-8, 2e-11, 3e-12];

fn error(case: &Case, steps: u64) -> Outcome<f64> {
    let subject = &case.subject;
    let mut run = case.begin([subject.t, subject.time / steps as f64], &subject.start.concat())?;
    run.take_steps(steps)?;
    Ok(apart(&run.values(), subject.end()))
}

/// From as many steps on as leave errors above rounding, or as the order needs.
pub(super) fn errors_have_the_order(case: &Case) -> Outcome {
    if case.order == 0 || !case.is_plain() {
        return Ok(());
    }
    let mut steps = match case.order {
        1 => 768,
        2 | 3 => 64,
        _ => 4,
    };
    if case.order > 3 {
        let small = SMALL[(case.order / 2 - 2).min(2)];
        while steps < 1000 && error(case, 5 * steps / 2).map_or(true, |error| error > small) {
            steps = steps * 5 / 4 + 1;
        }
    }
    let mut errors = Vec::new();
    for steps in [steps, steps * 5 / 4, steps * 3 / 2, 2 * steps] {
        errors.push((1.0 / steps as f64, error(case, steps)?));
    }
    let found = convergence_order(&errors).ok_or("no slope")?;
    let bound = match case.order {
        ..=2 => 0.07,
        3..=7 => 0.1,
        _ => 0.25,
    };
    below(
        (found - case.order as f64).abs(),
        bound,
        &format!("order {}, not {found}, {errors:?}", case.order),
    )
}

of_every_kind!(errors_have_the_order);
