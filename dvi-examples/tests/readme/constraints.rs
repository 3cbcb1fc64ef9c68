//! Constraints of positions and of velocities.

use crate::assert_said;
use crate::numbers::{about, at_most};
use crate::table::{rows, value};

#[test]
fn constrained_steps_of_many_links_do_what_is_said() {
    let rows = rows();
    let links = |quantity: &str| value(&rows, "links", quantity);
    let apart = |other: &str| links(&format!("trapezoid and {other}: largest distance of the free ends"));
    let iterations = |method: &str, n: u32| links(&format!("{method}: iterations of a step with {n} links"));
    let all = ["trapezoid", "midpoint"].map(|method| [25, 50, 100].map(|n| iterations(method, n)));
    let (fewest, most) =
        all.iter().flatten().fold((f64::INFINITY, 0.0_f64), |(low, high), &x| (low.min(x), high.max(x)));
    let many = iterations("RATTLE", 100);
    assert_said(&[
        format!(
            "the length of a rod is wrong by at most {} of itself, and the velocity along a rod is at most {}.",
            at_most(links("constrained: largest relative deviation of the length of a rod")),
            at_most(links("constrained: largest velocity along a rod"))
        ),
        format!(
            "a rod is wrong by {:.0} % at the end.",
            100.0 * links("RK4: largest relative deviation of the length of a rod")
        ),
        format!(
            "The energy error of constrained steps is at most {}, and reaches that before t = 5; the one of RK4 grows to {}.",
            at_most(links("constrained: max|ΔE|")),
            about(links("RK4: max|ΔE|"))
        ),
        format!("their free ends stay together within {}.", at_most(apart("midpoint").max(apart("RATTLE")))),
        format!(
            "Newton's method takes {fewest:.1} to {most:.1} iterations in a step with 25, 50 and 100 links; RATTLE takes {:.1} with \
             25 and {many:.1} with 100.",
            many - links("RATTLE: the same less those with 25")
        ),
    ]);
}

#[test]
fn rods_allow_the_steps_that_are_said() {
    let rows = rows();
    let molecules = |quantity: &str| value(&rows, "molecules", quantity);
    let ratio = |k: &str| molecules(&format!("k = {k}: longest step with rods / with springs"));
    assert_said(&[
        format!("in 50 units of time the longest step is {:.3}.", molecules("rods: longest step")),
        format!(
            "it must be {:.1} times shorter for springs of stiffness 10⁴, and {:.1} times for 10⁵:",
            ratio("10000"),
            ratio("100000")
        ),
    ]);
}

#[test]
fn constraints_of_velocities_keep_the_energy_where_it_is_said() {
    let rows = rows();
    let disc = |quantity: &str| value(&rows, "disc", quantity);
    let [springs, magnet, rk4] =
        ["constrained", "magnet", "RK4"].map(|name| disc(&format!("{name}: largest |ΔE|")));
    let early = magnet / disc("magnet: largest |ΔE| over all / up to t = 100");
    assert!(disc("constrained: largest |ΔE| over all / up to t = 100") < 1.0001);
    assert_said(&[
        format!("the energy changes by at most {} of itself.", at_most(disc("largest |E/E(0) − 1|"))),
        format!("the energy error is at most {}, on average over eight starts,", at_most(springs)),
        format!(
            "its error is {early:.3} up to t = 100 and {magnet:.2} up to t = 5·10⁴, and half the step has {:.2} times as much up \
             to t = 10⁴.",
            disc("magnet: largest |ΔE| up to t = 10000 with half the step / with the whole")
        ),
        format!(
            "its error is {:.1} times smaller up to t = 5·10⁴. On the equal springs it is {:.1} times larger than that of \
             constrained steps",
            disc("magnet: largest |ΔE| / that of RK4"),
            rk4 / springs
        ),
        format!(
            "its energy changes by {:.2} % while it turns, and then by no more than {} of itself.",
            100.0 * disc("|E/E(0) − 1| at t = 24"),
            at_most(disc("largest relative change of E when it has turned"))
        ),
    ]);
}
