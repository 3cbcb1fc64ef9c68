//! Particles that bounce.

use crate::assert_said;
use crate::numbers::at_most;
use crate::table::{rows, value};

#[test]
fn bounces_keep_the_energy_that_is_said() {
    let rows = rows();
    let bounces = |quantity: &str| value(&rows, "bounces", quantity);
    let billiard = |quantity: &str| value(&rows, "billiard", quantity);
    let count = bounces("bounces");
    assert_said(&[
        format!(
            "A particle bounces on a curved floor, {:.0} {:03.0} times up to t = 2·10⁵.",
            (count / 1000.0).floor(),
            count % 1000.0
        ),
        format!(
            "with h = 0.02 is at most {}, which is {:.1} times that up to t = 200, and {} with half the step.",
            at_most(bounces("h = 0.02: max|ΔE|")),
            bounces("h = 0.02: max|ΔE| over all / up to t = 200"),
            at_most(bounces("h = 0.01: max|ΔE|"))
        ),
        format!(
            "the root mean square of its change grows with the power {:.2} of the number of bounces, and after 2048 of them is {:.0} \
             times as large.",
            bounces("exponent of the root mean square of ΔE"),
            bounces("root mean square after 2048 bounces, over that where the energy is kept")
        ),
        format!("RK4 with as many forces has lost {:.3} by the end.", bounces("RK4: max|ΔE|")),
        format!(
            "keeps the product of its angular momenta about the foci to {} over 10⁵ impacts,",
            at_most(billiard("the same by long steps").max(billiard("largest change of the product")))
        ),
    ]);
    assert_eq!(billiard("the most impacts in a long step"), 4.0);
}
