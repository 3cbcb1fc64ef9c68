//! Orbits and vortices over long times, and their rounding errors.

use crate::assert_said;
use crate::numbers::{about, at_most};
use crate::table::{rows, value};

#[test]
fn one_third_of_the_steps_is_said_of_each_reading() {
    let rows = rows();
    let ratio = |quantity: &str| value(&rows, "kepler-steps", quantity);
    let third = "against midpoint and trapezoid";
    let range = |how: &str, e: &str| {
        [
            ratio(&format!("{how}, e = {e}, {third}: smallest ratio")),
            ratio(&format!("{how}, e = {e}, {third}: largest ratio")),
        ]
    };
    let [low, high] = range("(23) as printed", "0.95");
    let [_, at_lower] = range("(23) as printed", "0.8");
    let [fixed_low, fixed_high] = range("fixed steps", "0.95");
    let share = ratio("(23) as printed, e = 0.95: share of the ratios above one third");
    let simpson = ratio("fixed steps, e = 0.95, against linear Simpson: smallest ratio");
    let round = ratio("fixed steps, e = 0.2, against linear Simpson: largest ratio");
    // No bound is rounded inwards.
    let (below, above) =
        (|bound: f64| (100.0 * bound).floor() / 100.0, |bound: f64| (100.0 * bound).ceil() / 100.0);
    let [low, fixed_low, simpson] = [low, fixed_low, simpson].map(below);
    let [high, at_lower, fixed_high, round] = [high, at_lower, fixed_high, round].map(above);
    assert_said(&[
        format!(
            "With steps by (23) as printed, at e = 0.95 and against midpoint and trapezoid, phase fitting takes \
             {low:.2} to {high:.2} of the steps, and in {:.0} % of the comparisons more than a third; at e = 0.8 it \
             takes up to {at_lower:.2}.",
            100.0 * share
        ),
        format!("With fixed steps it takes {fixed_low:.2} to {fixed_high:.2} at e = 0.95."),
        format!(
            "Against linear Simpson, with fixed steps, it takes at least {simpson:.2} at e = 0.95, and at most {round:.2} at \
             e = 0.2."
        ),
    ]);
}

#[test]
fn long_runs_last_as_long_as_it_is_said() {
    let rows = rows();
    let long = |quantity: &str| value(&rows, "kepler-long", quantity);
    let symmetry = |quantity: &str| value(&rows, "fig2-symmetry", quantity);
    let growth = long("(23) per arc length, 3e-6: max|ΔE| over all / over 300 periods");
    assert!(growth <= 1.001, "{growth}");
    assert_said(&[
        format!(
            "read per unit of arc length, (23) locks in to the motion: with a tolerance of 3·10⁻⁶ the energy error is \
             at most {} in the first 300 periods and in all of 10⁵, at {:.0} steps a period.",
            at_most(long("(23) per arc length, 3e-6: max|ΔE|")),
            long("(23) per arc length, 3e-6: steps per period")
        ),
        format!(
            "keeps an orbit of eccentricity 0.95 within {} of its energy for 10⁵ periods at {:.0} steps a period.",
            at_most(long("Lobatto-4: max|ΔE| over all")),
            long("Lobatto-4: steps per period")
        ),
        format!(
            "breaks up at t = {}, when rounding has broken the mirror symmetry that carries it; with one vortex \
             displaced it breaks up at t = {}.",
            about(symmetry("time at which |ΔH| exceeds 0.05")),
            about(symmetry("displaced: time at which |ΔH| exceeds 0.05"))
        ),
    ]);
}

#[test]
fn compensated_sums_round_as_little_as_it_is_said() {
    let rows = rows();
    let percent = |name: &str| {
        let ratio = value(&rows, "round-off", &format!("{name}: compensated/plain, at the end"));
        (1000.0 * ratio).ceil() / 10.0
    };
    assert_said(&[format!(
        "After 10⁸ steps on an oscillator the rounding error of the conserved energy is then at most {:.1} % of that with \
         plain sums for σ = ½, and {:.1} % for Verlet's method.",
        percent("oscillator, σ = ½"),
        percent("oscillator, Verlet")
    )]);
}
