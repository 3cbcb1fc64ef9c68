//! Friction, and steps that keep the discrete energy.

use crate::assert_said;
use crate::numbers::{about, at_most, power};
use crate::table::{rows, value};

#[test]
fn friction_takes_from_the_energy_what_is_said() {
    let rows = rows();
    let friction = |quantity: &str| value(&rows, "friction", quantity);
    let rate =
        |name: &str| friction(&format!("{name}: rate of decay of E less that of the motion, in units of γ"));
    let at_most_hundredths = |name: &str| (100.0 * rate(name).abs()).ceil() / 100.0;
    let ratio = |h: &str| friction(&format!("h = {h}: largest deviation of E, RK4 / midpoint"));
    for name in ["Heun", "explicit midpoint"] {
        assert!(friction(&format!("{name}: time at which E is twice E(0)")) <= 5.0, "{name}");
    }
    assert_said(&[
        format!(
            "is wrong by at most {:.2} γ with the variational midpoint rule, {:.2} γ with the trapezoid and {:.2} γ with \
             Newmark's method; RK4 adds {:.2} γ of its own.",
            at_most_hundredths("variational midpoint"),
            at_most_hundredths("variational trapezoid"),
            at_most_hundredths("Newmark, β = ¼"),
            rate("RK4")
        ),
        format!(
            "at h = 0.1 the energy of RK4 deviates {:.1} times as far as that of the midpoint rule, at h = 0.025 only \
             {:.2} times as far.",
            ratio("0.1"),
            ratio("0.025")
        ),
        format!(
            "decays as e^{{−γt}} up to {} of itself in all of that time.",
            at_most(friction("trapezoid: largest |l/(l(0) exp(−γt)) − 1|"))
        ),
    ]);
}

#[test]
fn steps_that_keep_the_discrete_energy_do_what_is_said() {
    let rows = rows();
    let measured = |quantity: &str| value(&rows, "energy-momentum", quantity);
    let both = |quantity: &str| ["spring", "Kepler"].map(|name| measured(&format!("{name}{quantity}")));
    let kept = both(": largest |E_d − e| of all runs").map(at_most);
    let varies = both(", steps of one length: largest difference of two E_d").map(about);
    let energy = both(": largest difference of two E / that with steps of one length");
    let longest = both(": largest length / that of the first step");
    let distance = both(": largest distance / that with as many steps of one length");
    let work = both(": evaluations of derivatives in a step / in one of steps of one length");
    let farther = both(": largest distance / that with the same work");
    let least =
        (measured("smallest E_d − e of lengths up to 4 times the last, by hand") * 1e4).floor() / 10.0;
    let steps = measured("steps that it takes");
    assert_said(&[
        format!("E_d changes by at most {} on the spring and {} on the orbit;", kept[0], kept[1]),
        format!("with as many steps of one length it varies by {} and {}.", varies[0], varies[1]),
        format!(
            "{:.2} times as much as with steps of one length on the spring, and {:.2} times as much on the orbit.",
            energy[0], energy[1]
        ),
        format!(
            "the longest step is {:.2} times the first on the spring and {:.2} times on the orbit.",
            longest[0], longest[1]
        ),
        format!(
            "the distance from the motion is {:.2} times that of as many steps of one length on the spring and {:.2} times \
             on the orbit.",
            distance[0], distance[1]
        ),
        format!(
            "a step takes {:.1} and {:.1} times as many evaluations of derivatives: for no more evaluations steps of one \
             length come {:.0} and {:.0} times closer.",
            work[0], work[1], farther[0], farther[1]
        ),
        format!(
            "the scheme ends on the spring after {steps} steps: there E_d − e is at least {}",
            power(least, -3)
        ),
    ]);
}
