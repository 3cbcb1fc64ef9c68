//! What is said of the experiments, in the order of their README.

use dvi_examples::figure::{at_most, scientific as about};

use crate::of;

#[test]
fn one_third_of_the_steps_is_said_of_each_reading() {
    let ratio = of("kepler-steps");
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
    said!(
        "With steps by (23) as printed, at e = 0.95 and against midpoint and trapezoid, phase fitting \
         takes {low:.2} to {high:.2} of the steps, and in {:.0} % of the comparisons more than a third; at \
         e = 0.8 it takes up to {at_lower:.2}.",
        100.0 * share
    );
    said!("With fixed steps it takes {fixed_low:.2} to {fixed_high:.2} at e = 0.95.");
    said!(
        "Against linear Simpson, with fixed steps, it takes at least {simpson:.2} at e = 0.95, and at most \
         {round:.2} at e = 0.2."
    );
}

#[test]
fn long_runs_last_as_long_as_it_is_said() {
    let long = of("kepler-long");
    let symmetry = of("fig2-symmetry");
    let growth = long("(23) per arc length, 3e-6: max|ΔE| over all / over 300 periods");
    assert!(growth <= 1.001, "{growth}");
    said!(
        "read per unit of arc length, (23) locks in to the motion: with a tolerance of 3·10⁻⁶ the energy \
         error is at most {} in the first 300 periods and in all of 10⁵, at {:.0} steps a period.",
        at_most(long("(23) per arc length, 3e-6: max|ΔE|")),
        long("(23) per arc length, 3e-6: steps per period")
    );
    said!(
        "keeps an orbit of eccentricity 0.95 within {} of its energy for 10⁵ periods at {:.0} steps a \
         period.",
        at_most(long("Lobatto-4: max|ΔE| over all")),
        long("Lobatto-4: steps per period")
    );
    said!(
        "breaks up at t = {}, when rounding has broken the mirror symmetry that carries it; with one vortex \
         displaced it breaks up at t = {}.",
        about(symmetry("time at which |ΔH| exceeds 0.05")),
        about(symmetry("displaced: time at which |ΔH| exceeds 0.05"))
    );
}

#[test]
fn compensated_sums_round_as_little_as_it_is_said() {
    let percent = |name: &str| {
        let ratio = of("round-off")(&format!("{name}: compensated/plain, at the end"));
        (1000.0 * ratio).ceil() / 10.0
    };
    said!(
        "After 10⁸ steps on an oscillator the rounding error of the conserved energy is then at most {:.1} \
         % of that with plain sums for σ = ½, and {:.1} % for Verlet's method.",
        percent("oscillator, σ = ½"),
        percent("oscillator, Verlet")
    );
}

#[test]
fn order_16_pays_where_the_last_digits_are_asked_for() {
    let of = of("accuracy-cost");
    let problems = ["vortices", "Kepler", "outer solar system"];
    let [vortices, kepler, planets] =
        problems.map(|name| at_most(of(&format!("{name}: smallest max|ΔH|/|H|"))));
    let fewer = problems.map(|name| of(&format!("{name}: Kahan–Li 8 / Gauss 16")));
    let at_once = problems.map(|name| of(&format!("{name}, stages at once")));
    said!("Gauss collocation of order 16 keeps the energy to {vortices}, {kepler} and {planets} of itself.");
    said!(
        "To keep it to 10⁻¹³, the composition of Kahan & Li of order 8 takes {:.1}, {:.1} and {:.1} times \
         as many evaluations of the gradient, and {:.0}, {:.0} and {:.0} times as many where the stages of \
         a step are evaluated at once and count once.",
        fewer[0],
        fewer[1],
        fewer[2],
        at_once[0],
        at_once[1],
        at_once[2]
    );
    said!(
        "To keep it to 10⁻⁶, other methods take fewer evaluations than Gauss collocation of order 16: RK4 \
         {:.2} times as many on the vortices, and Kahan–Li 8 {:.2} times as many in the solar system.",
        of("vortices, 1e-6: RK4 / Gauss 16"),
        of("outer solar system, 1e-6: Kahan–Li 8 / Gauss 16")
    );
}

#[test]
fn friction_takes_from_the_energy_what_is_said() {
    let friction = of("friction");
    let rate =
        |name: &str| friction(&format!("{name}: rate of decay of E less that of the motion, in units of γ"));
    let at_most_hundredths = |name: &str| (100.0 * rate(name).abs()).ceil() / 100.0;
    let ratio = |h: &str| friction(&format!("h = {h}: largest deviation of E, RK4 / midpoint"));
    for name in ["Heun", "explicit midpoint"] {
        assert!(friction(&format!("{name}: time at which E is twice E(0)")) <= 5.0, "{name}");
    }
    said!(
        "is wrong by at most {:.2} γ with the variational midpoint rule, {:.2} γ with the trapezoid and \
         {:.2} γ with Newmark's method; RK4 adds {:.2} γ of its own.",
        at_most_hundredths("variational midpoint"),
        at_most_hundredths("variational trapezoid"),
        at_most_hundredths("Newmark, β = ¼"),
        rate("RK4")
    );
    said!(
        "at h = 0.1 the energy of RK4 deviates {:.1} times as far as that of the midpoint rule, at h = \
         0.025 only {:.2} times as far.",
        ratio("0.1"),
        ratio("0.025")
    );
    said!(
        "decays as e^{{−γt}} up to {} of itself in all of that time.",
        at_most(friction("trapezoid: largest |l/(l(0) exp(−γt)) − 1|"))
    );
}

#[test]
fn steps_that_keep_the_discrete_energy_do_what_is_said() {
    let measured = of("energy-momentum");
    let both = |quantity: &str| ["spring", "Kepler"].map(|name| measured(&format!("{name}{quantity}")));
    let kept = both(": largest |E_d − e| of all runs").map(at_most);
    let varies = both(", steps of one length: largest difference of two E_d").map(about);
    let energy = both(": largest difference of two E / that with steps of one length");
    let longest = both(": largest length / that of the first step");
    let distance = both(": largest distance / that with as many steps of one length");
    let work = both(": evaluations of derivatives in a step / in one of steps of one length");
    let farther = both(": largest distance / that with the same work");
    let least =
        (measured("smallest E_d − e of lengths up to 4 times the last, by hand") * 1e4).floor() / 1e4;
    let steps = measured("steps that it takes");
    said!("E_d changes by at most {} on the spring and {} on the orbit;", kept[0], kept[1]);
    said!("with as many steps of one length it varies by {} and {}.", varies[0], varies[1]);
    said!(
        "{:.2} times as much as with steps of one length on the spring, and {:.2} times as much on the \
         orbit.",
        energy[0],
        energy[1]
    );
    said!(
        "the longest step is {:.2} times the first on the spring and {:.2} times on the orbit.",
        longest[0],
        longest[1]
    );
    said!(
        "the distance from the motion is {:.2} times that of as many steps of one length on the spring and \
         {:.2} times on the orbit.",
        distance[0],
        distance[1]
    );
    said!(
        "a step takes {:.1} and {:.1} times as many evaluations of derivatives: for no more evaluations \
         steps of one length come {:.0} and {:.0} times closer.",
        work[0],
        work[1],
        farther[0],
        farther[1]
    );
    said!("the scheme ends on the spring after {steps} steps: there E_d − e is at least {}", about(least));
}

#[test]
fn constrained_steps_of_many_links_do_what_is_said() {
    let links = of("links");
    let apart = |other: &str| links(&format!("trapezoid and {other}: largest distance of the free ends"));
    let iterations = |method: &str, n: u32| links(&format!("{method}: iterations of a step with {n} links"));
    let all = ["trapezoid", "midpoint"].map(|method| [25, 50, 100].map(|n| iterations(method, n)));
    let (fewest, most) =
        all.iter().flatten().fold((f64::INFINITY, 0.0_f64), |(low, high), &x| (low.min(x), high.max(x)));
    let many = iterations("RATTLE", 100);
    said!(
        "the length of a rod is wrong by at most {} of itself, and the velocity along a rod is at most {}.",
        at_most(links("constrained: largest relative deviation of the length of a rod")),
        at_most(links("constrained: largest velocity along a rod"))
    );
    said!(
        "a rod is wrong by {:.0} % at the end.",
        100.0 * links("RK4: largest relative deviation of the length of a rod")
    );
    said!(
        "The energy error of constrained steps is at most {}, and reaches that before t = 5; the one of \
         RK4 grows to {}.",
        at_most(links("constrained: max|ΔE|")),
        about(links("RK4: max|ΔE|"))
    );
    said!("their free ends stay together within {}.", at_most(apart("midpoint").max(apart("RATTLE"))));
    said!(
        "Newton's method takes {fewest:.1} to {most:.1} iterations in a step with 25, 50 and 100 links; \
         RATTLE takes {:.1} with 25 and {many:.1} with 100.",
        many - links("RATTLE: the same less those with 25")
    );
}

#[test]
fn rods_allow_the_steps_that_are_said() {
    let molecules = of("molecules");
    let ratio = |k: &str| molecules(&format!("k = {k}: longest step with rods / with springs"));
    said!("in 50 units of time the longest step is {:.3}.", molecules("rods: longest step"));
    said!(
        "it must be {:.1} times shorter for springs of stiffness 10⁴, and {:.1} times for 10⁵:",
        ratio("10000"),
        ratio("100000")
    );
}

#[test]
fn constraints_of_velocities_keep_the_energy_where_it_is_said() {
    let disc = of("disc");
    let [springs, magnet, rk4] =
        ["constrained", "magnet", "RK4"].map(|name| disc(&format!("{name}: largest |ΔE|")));
    let early = magnet / disc("magnet: largest |ΔE| over all / up to t = 100");
    assert!(disc("constrained: largest |ΔE| over all / up to t = 100") < 1.0001);
    said!("the energy changes by at most {} of itself.", at_most(disc("largest |E/E(0) − 1|")));
    said!("the energy error is at most {}, on average over eight starts,", at_most(springs));
    said!(
        "its error is {early:.3} up to t = 100 and {magnet:.2} up to t = 5·10⁴, and half the step has \
         {:.2} times as much up to t = 10⁴.",
        disc("magnet: largest |ΔE| up to t = 10000 with half the step / with the whole")
    );
    said!(
        "its error is {:.1} times smaller up to t = 5·10⁴. On the equal springs it is {:.1} times larger \
         than that of constrained steps",
        disc("magnet: largest |ΔE| / that of RK4"),
        rk4 / springs
    );
    said!(
        "its energy changes by {:.2} % while it turns, and then by no more than {} of itself.",
        100.0 * disc("|E/E(0) − 1| at t = 24"),
        at_most(disc("largest relative change of E when it has turned"))
    );
}

#[test]
fn stiff_springs_do_what_is_said() {
    let chain = of("spring-chain");
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
    said!(
        "of E = 2 its error is at most {verlet:.3} with β = 0, {twelfth:.3} with β = 1/12, {sixth:.3} with \
         β = 1/6 and {} with β = 1/4.",
        at_most(quarter)
    );
    said!(
        "RK4 with the same step has taken all but {} of the energy of the stiff springs by t = 20.",
        at_most(chain("RK4: I/I(0) at t = 20"))
    );
    said!("It gives {p:.3}, {q:.3}, {r:.3} and {s:.3} for these β,");
    said!("the runs have {a:.3}, {b:.3}, {c:.3} and {d:.3}.");
    said!(
        "the energy error is still at most {long:.3}, but at t = 150 the first spring has {:.0} % of its \
         energy, where in the motion it has {:.1} %.",
        first("long step"),
        first("motion")
    );
}

#[test]
fn beams_vibrate_as_it_is_said() {
    let beam = of("beam");
    let iterations =
        |name: &str| [25, 50, 100, 200].map(|n| beam(&format!("{name}, {n} nodes: iterations of a step")));
    let (of_beam, of_rod) = (iterations("beam"), iterations("rod"));
    let least = |all: [f64; 4]| all.into_iter().fold(f64::INFINITY, f64::min);
    let most = |all: [f64; 4]| all.into_iter().fold(0.0, f64::max);
    assert!(most(of_beam) - least(of_beam) < 0.05, "{of_beam:?}");
    assert_eq!(beam("runs lost of one by Störmer–Verlet with a step that is 1000 times shorter"), 1.0);
    assert_eq!(beam("rod: time until the run is lost, in periods of the first mode"), 50.0);
    assert_eq!(beam("200 segments, h = 0.001: periods until the run is lost, or its end"), 15.0);
    said!(
        "are those of Euler and Bernoulli up to {} of themselves,",
        at_most(beam("200 elements: largest relative error of a frequency"))
    );
    said!(
        "the energy changes by at most {} of itself in 400 periods;",
        at_most(beam("beam: largest |E/E(0) − 1|"))
    );
    said!(
        "the error of its energy is at most {} in 50 periods, and {:.2} times that of the first two.",
        at_most(beam("rod: largest |E/E(0) − 1|")),
        (100.0 * beam("rod: largest |E/E(0) − 1| over all / in two periods")).ceil() / 100.0
    );
    said!(
        "With 200 segments the same step is lost after {:.1} periods:",
        beam("200 segments, h = 0.0025: periods until the run is lost")
    );
    said!(
        "which is at 15 periods, with an error of at most {}.",
        at_most(beam("200 segments, h = 0.001: largest |E/E(0) − 1|"))
    );
    said!(
        "A step takes {:.1} iterations of Newton's method on the beam and {:.1} to {:.1} on the rod, with \
         25, 50, 100 and 200 nodes.",
        most(of_beam),
        least(of_rod),
        most(of_rod)
    );
}

#[test]
fn bounces_keep_the_energy_that_is_said() {
    let bounces = of("bounces");
    let billiard = of("billiard");
    let count = bounces("bounces");
    said!(
        "A particle bounces on a curved floor, {:.0} {:03.0} times up to t = 2·10⁵.",
        (count / 1000.0).floor(),
        count % 1000.0
    );
    said!(
        "with h = 0.02 is at most {}, which is {:.1} times that up to t = 200, and {} with half the step.",
        at_most(bounces("h = 0.02: max|ΔE|")),
        bounces("h = 0.02: max|ΔE| over all / up to t = 200"),
        at_most(bounces("h = 0.01: max|ΔE|"))
    );
    said!(
        "the root mean square of its change grows with the power {:.2} of the number of bounces, and after \
         2048 of them is {:.0} times as large.",
        bounces("exponent of the root mean square of ΔE"),
        bounces("root mean square after 2048 bounces, over that where the energy is kept")
    );
    said!("RK4 with as many forces has lost {:.3} by the end.", bounces("RK4: max|ΔE|"));
    said!(
        "keeps the product of its angular momenta about the foci to {} over 10⁵ impacts,",
        at_most(billiard("the same by long steps").max(billiard("largest change of the product")))
    );
    assert_eq!(billiard("the most impacts in a long step"), 4.0);
}

#[test]
fn rotations_and_unit_vectors_stay_what_they_are_as_it_is_said() {
    let top = of("top");
    let body = of("rigid-body");
    let pendulum = of("spherical-pendulum");
    let momentum = "largest relative change of the momentum about the vertical";
    let above = |bound: f64, decimals: usize| {
        let scale = 10f64.powi(decimals as i32);
        format!("{:.decimals$}", (scale * bound).ceil() / scale)
    };
    assert_eq!(top("largest relative change of the spin"), 0.0, "the README says that it does not change");
    said!("RᵀR differs from 1 by at most {}.", at_most(top("geodesics: max|RᵀR − 1|")));
    said!("the one about the vertical changes by at most {} of itself", at_most(top(momentum)));
    said!("The energy error is at most {} and has no trend.", at_most(top("geodesics: max|ΔE|")));
    said!(
        "with h = 0.04 they miss the roots of the cubic by at most {} h².",
        above(top("h = 0.04: largest distance of a turning from its root / h²"), 3)
    );
    said!(
        "RᵀR differs from 1 by {:.2} at the end, and the energy from its start by {}.",
        top("RK4: max|RᵀR − 1|"),
        about(top("RK4: max|ΔE|"))
    );
    said!(
        "the period is that of the elliptic functions up to {} h² of itself.",
        above(body("h = 0.025: relative error of the period / h²"), 4)
    );
    said!(
        "changes by at most {} of itself, in length and direction, and by {} with RK4.",
        at_most(body("geodesics: largest |M − M(0)|/|M| in space")),
        about(body("RK4: largest |M − M(0)|/|M| in space"))
    );
    said!(
        "The energy error of RK4 is the smaller one for all of that time, {} against {}, but it grows.",
        about(body("RK4: max|ΔE|")),
        about(body("geodesics: max|ΔE|"))
    );
    said!("|s|² differs from 1 by at most {}.", at_most(pendulum("great circles: largest ||s|² − 1|")));
    said!(
        "The momentum about the vertical changes by at most {} of itself, and by at most {} with RATTLE.",
        at_most(pendulum(&format!("great circles: {momentum}"))),
        at_most(pendulum(&format!("RATTLE: {momentum}")))
    );
    said!(
        "The energy error is at most {} along great circles and {} by RATTLE, and both have no trend.",
        at_most(pendulum("great circles: max|ΔE|")),
        at_most(pendulum("RATTLE: max|ΔE|"))
    );
}

#[test]
fn a_layer_of_many_blobs_does_what_is_said() {
    let layer = of("shear-layer");
    said!(
        "Small waves on it grow at {:.2} times the rate of linear theory, from t = 1 to 2.",
        layer("rate from t = 1 to 2 / that of linear theory")
    );
    said!(
        "The energy changes by at most {} of itself, the impulse by {} of the circulation times the \
         length, and the angular impulse by {} of itself.",
        at_most(layer("largest |ΔH|/H")),
        at_most(layer("largest change of ΣΓz / ΣΓ times the length")),
        at_most(layer("largest relative change of ΣΓ|z|²"))
    );
    said!(
        "At the end the forces are those of the sum over all pairs up to {} of themselves.",
        at_most(layer("relative error at the end"))
    );
    said!(
        "An evaluation takes {:.0} times fewer pairs and products than there are ordered pairs, and from \
         25 000 to 400 000 blobs their number grows with the power {:.2} of that of the blobs. A step \
         takes {:.1} evaluations.",
        layer("100 000 blobs: ordered pairs of all / pairs and products of an evaluation"),
        layer("power of the number of blobs"),
        layer("evaluations in a step")
    );
}
