//! What is said of rotations and unit vectors.

use crate::assert_said;
use crate::numbers::{about, at_most};
use crate::table::{rows, value};

#[test]
fn rotations_and_unit_vectors_stay_what_they_are_as_it_is_said() {
    let rows = rows();
    let top = |quantity: &str| value(&rows, "top", quantity);
    let body = |quantity: &str| value(&rows, "rigid-body", quantity);
    let pendulum = |quantity: &str| value(&rows, "spherical-pendulum", quantity);
    let momentum = "largest relative change of the momentum about the vertical";
    let above = |bound: f64, decimals: usize| {
        let scale = 10f64.powi(decimals as i32);
        format!("{:.decimals$}", (scale * bound).ceil() / scale)
    };
    assert_eq!(top("largest relative change of the spin"), 0.0, "the README says that it does not change");
    assert_said(&[
        format!("RᵀR differs from 1 by at most {}.", at_most(top("geodesics: max|RᵀR − 1|"))),
        format!("the one about the vertical changes by at most {} of itself", at_most(top(momentum))),
        format!("The energy error is at most {} and has no trend.", at_most(top("geodesics: max|ΔE|"))),
        format!(
            "with h = 0.04 they miss the roots of the cubic by at most {} h².",
            above(top("h = 0.04: largest distance of a turning from its root / h²"), 3)
        ),
        format!(
            "RᵀR differs from 1 by {:.2} at the end, and the energy from its start by {}.",
            top("RK4: max|RᵀR − 1|"),
            about(top("RK4: max|ΔE|"))
        ),
        format!(
            "the period is that of the elliptic functions up to {} h² of itself.",
            above(body("h = 0.025: relative error of the period / h²"), 4)
        ),
        format!(
            "changes by at most {} of itself, in length and direction, and by {} with RK4.",
            at_most(body("geodesics: largest |M − M(0)|/|M| in space")),
            about(body("RK4: largest |M − M(0)|/|M| in space"))
        ),
        format!(
            "The energy error of RK4 is the smaller one for all of that time, {} against {}, but it grows.",
            about(body("RK4: max|ΔE|")),
            about(body("geodesics: max|ΔE|"))
        ),
        format!(
            "|s|² differs from 1 by at most {}.",
            at_most(pendulum("great circles: largest ||s|² − 1|"))
        ),
        format!(
            "The momentum about the vertical changes by at most {} of itself, and by at most {} with RATTLE.",
            at_most(pendulum(&format!("great circles: {momentum}"))),
            at_most(pendulum(&format!("RATTLE: {momentum}")))
        ),
        format!(
            "The energy error is at most {} along great circles and {} by RATTLE, and both have no trend.",
            at_most(pendulum("great circles: max|ΔE|")),
            at_most(pendulum("RATTLE: max|ΔE|"))
        ),
    ]);
}
