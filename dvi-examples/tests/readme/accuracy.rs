//! Accuracy against the number of evaluations.

use crate::assert_said;
use crate::numbers::at_most;
use crate::table::{rows, value};

#[test]
fn order_16_pays_where_the_last_digits_are_asked_for() {
    let rows = rows();
    let of = |quantity: &str| value(&rows, "accuracy-cost", quantity);
    let problems = ["vortices", "Kepler", "outer solar system"];
    let [vortices, kepler, planets] =
        problems.map(|name| at_most(of(&format!("{name}: smallest max|ΔH|/|H|"))));
    let fewer = problems.map(|name| of(&format!("{name}: Kahan–Li 8 / Gauss 16")));
    let at_once = problems.map(|name| of(&format!("{name}, stages at once")));
    assert_said(&[
        format!(
            "Gauss collocation of order 16 keeps the energy to {vortices}, {kepler} and {planets} of itself."
        ),
        format!(
            "To keep it to 10⁻¹³, the composition of Kahan & Li of order 8 takes {:.1}, {:.1} and {:.1} times as many \
             evaluations of the gradient, and {:.0}, {:.0} and {:.0} times as many where the stages of a step are \
             evaluated at once and count once.",
            fewer[0], fewer[1], fewer[2], at_once[0], at_once[1], at_once[2]
        ),
        format!(
            "To keep it to 10⁻⁶, other methods take fewer evaluations than Gauss collocation of order 16: RK4 {:.2} times \
             as many on the vortices, and Kahan–Li 8 {:.2} times as many in the solar system.",
            of("vortices, 1e-6: RK4 / Gauss 16"),
            of("outer solar system, 1e-6: Kahan–Li 8 / Gauss 16")
        ),
    ]);
}
