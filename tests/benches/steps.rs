//! The generated steps beside the same schemes by hand: four vortices, Kepler's problem, predators and prey.
//!
//! `cargo bench -p dvi-benches --bench steps [-- --markdown]`; the times of a pair are to be compared with
//! each other, in one run.

use criterion::Criterion;
use dvi_kernels as kernels;

/// Steps per measured call, so that the call itself does not count.
const STEPS: u64 = 1000;

/// How many steps a kernel by hand takes before it is asked to: to a second point, or to fill what it
/// extrapolates from.
fn steps_ahead(name: &str) -> u64 {
    match name {
        _ if ["Verlet", "RATTLE", "matrix", "top"].iter().any(|scheme| name.contains(scheme)) => 0,
        _ if name.contains("explicit") => 1,
        _ => 7,
    }
}

fn steps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("1000 steps");
    for [ours, theirs] in kernels::KERNELS {
        // Both compute the same; later the explicit scheme tells rounding errors apart.
        let difference = kernels::run(ours, 100) - kernels::run(theirs, 100 - steps_ahead(theirs));
        assert!(difference.abs() < 1e-6, "{ours} and {theirs} differ by {difference:e}");
    }
    for name in kernels::KERNELS.as_flattened() {
        group.bench_function(*name, |bencher| bencher.iter(|| kernels::run(name, STEPS)));
    }
    group.finish();
}

/// The kernels as the README of the project calls them.
const TITLES: [&str; 12] = [
    "σ = 0, explicit",
    "the same, every state read",
    "the same on leapfrogging pairs, with the limit of the parasitic mode",
    "σ = ½, fixed point, tolerance 1e-12",
    "σ = ½, Newton, tolerance 1e-12",
    "residual and matrix of Newton's method",
    "Kepler, Störmer–Verlet",
    "Kepler, Simpson fitted to the mean of √(\\|a\\|/\\|q\\|), tolerance 1e-12",
    "the same with r^(−3/2) as a frequency of one's own",
    "one-step midpoint on predators and prey, tolerance 1e-12",
    "RATTLE with one constraint, a mass on a sphere, tolerance 1e-12",
    "a heavy top along geodesics of SO(3), tolerance 1e-12",
];

/// The table of the README, with the instructions that are pinned.
fn main() {
    let Some(medians) = markdown::measure(&[steps]) else { return };
    let pinned = include_str!("../kernels/instructions.csv").as_bytes();
    let pinned = csv::Reader::from_reader(pinned).into_deserialize::<(String, f64, f64)>();
    println!("| step | by hand | ours | time |\n|---|---|---|---|");
    for ((title, [ours, theirs]), row) in TITLES.iter().zip(kernels::KERNELS).zip(pinned) {
        let (_, generated, by_hand) = row.expect("a name and two numbers");
        let [time, other] = [ours, theirs].map(|name| medians.of("1000 steps", name));
        markdown::print_row(
            [(*title).to_owned(), format!("{by_hand:.0}"), format!("{generated:.0}")]
                .into_iter()
                .chain([format!("{:.2}", time / other)]),
        );
    }
}
