//! Stiff springs and beams.

use crate::assert_said;
use crate::numbers::at_most;
use crate::table::{rows, value};

#[test]
fn stiff_springs_do_what_is_said() {
    let rows = rows();
    let chain = |quantity: &str| value(&rows, "spring-chain", quantity);
    let names = ["β = 0", "β = 1/12", "β = 1/6", "β = 1/4"];
    let [verlet, twelfth, sixth, quarter] = names.map(|name| chain(&format!("{name}: largest |ΔE|")));
    let above = |bound: f64| (1000.0 * bound).ceil() / 1000.0;
    let [verlet, twelfth, sixth, long] =
        [verlet, twelfth, sixth, chain("long step: largest |ΔE|")].map(above);
    let [a, b, c, d] =
        names.map(|name| chain(&format!("{name}: speed of the exchange / that of the motion")));
    let first = |of: &str| 100.0 * chain(&format!("{of}: energy of the first stiff spring at t = 150"));
    // The bounds of these speeds are around the formula, with hω = 1.
    let [p, q, r, s] =
        [0.0_f64, 1.0 / 12.0, 1.0 / 6.0, 0.25].map(|beta| 1.0 / ((1.0 + beta) * (0.75 + beta).sqrt()));
    assert_said(&[
        format!(
            "of E = 2 its error is at most {verlet:.3} with β = 0, {twelfth:.3} with β = 1/12, {sixth:.3} with β = 1/6 and {} with \
             β = 1/4.",
            at_most(quarter)
        ),
        format!(
            "RK4 with the same step has taken all but {} of the energy of the stiff springs by t = 20.",
            at_most(chain("RK4: I/I(0) at t = 20"))
        ),
        format!("It gives {p:.3}, {q:.3}, {r:.3} and {s:.3} for these β,"),
        format!("the runs have {a:.3}, {b:.3}, {c:.3} and {d:.3}."),
        format!(
            "the energy error is still at most {long:.3}, but at t = 150 the first spring has {:.0} % of its energy, where in the \
             motion it has {:.1} %.",
            first("long step"),
            first("motion")
        ),
    ]);
}

#[test]
fn beams_vibrate_as_it_is_said() {
    let rows = rows();
    let beam = |quantity: &str| value(&rows, "beam", quantity);
    let iterations =
        |name: &str| [25, 50, 100, 200].map(|n| beam(&format!("{name}, {n} nodes: iterations of a step")));
    let (of_beam, of_rod) = (iterations("beam"), iterations("rod"));
    let least = |all: [f64; 4]| all.into_iter().fold(f64::INFINITY, f64::min);
    let most = |all: [f64; 4]| all.into_iter().fold(0.0, f64::max);
    assert!(most(of_beam) - least(of_beam) < 0.05, "{of_beam:?}");
    assert_eq!(beam("runs lost of one by Störmer–Verlet with a step that is 1000 times shorter"), 1.0);
    assert_eq!(beam("rod: time until the run is lost, in periods of the first mode"), 50.0);
    assert_eq!(beam("200 segments, h = 0.001: periods until the run is lost, or its end"), 15.0);
    assert_said(&[
        format!(
            "are those of Euler and Bernoulli up to {} of themselves,",
            at_most(beam("200 elements: largest relative error of a frequency"))
        ),
        format!(
            "the energy changes by at most {} of itself in 400 periods;",
            at_most(beam("beam: largest |E/E(0) − 1|"))
        ),
        format!(
            "the error of its energy is at most {} in 50 periods, and {:.2} times that of the first two.",
            at_most(beam("rod: largest |E/E(0) − 1|")),
            (100.0 * beam("rod: largest |E/E(0) − 1| over all / in two periods")).ceil() / 100.0
        ),
        format!(
            "With 200 segments the same step is lost after {:.1} periods:",
            beam("200 segments, h = 0.0025: periods until the run is lost")
        ),
        format!(
            "which is at 15 periods, with an error of at most {}.",
            at_most(beam("200 segments, h = 0.001: largest |E/E(0) − 1|"))
        ),
        format!(
            "A step takes {:.1} iterations of Newton's method on the beam and {:.1} to {:.1} on the rod, with 25, 50, 100 and 200 \
             nodes.",
            most(of_beam),
            least(of_rod),
            most(of_rod)
        ),
    ]);
}
