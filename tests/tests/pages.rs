//! What the README shows is what the examples are, and what they print; and each example writes its table.

use approx::assert_abs_diff_eq;
use std::fs;
use std::path::Path;
use std::process::Command;

use dvi_core::prelude::*;
use dvi_tests::{larger, oracle};

const README: &str = include_str!("../../README.md");

/// What an example of `dvi-core` prints, started in `folder`. It is built with the features of the
/// workspace, as the tests are, and not again with its own.
fn printed_by(example: &str, folder: &Path) -> String {
    let manifest = concat!(env!("CARGO_MANIFEST_DIR"), "/../Cargo.toml");
    let arguments = ["run", "--quiet", "--locked", "--example", example, "--manifest-path", manifest];
    let output =
        Command::new(env!("CARGO")).args(arguments).current_dir(folder).output().expect("cargo starts");
    assert!(output.status.success(), "{example}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("UTF-8")
}

fn empty_folder(name: &str) -> std::path::PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    if folder.exists() {
        fs::remove_dir_all(&folder).expect("removed");
    }
    fs::create_dir_all(&folder).expect("made");
    folder
}

/// The source of an example from the first line that contains `from` up to the last before `to`.
fn excerpt<'a>(source: &'a str, from: &str, to: &str) -> &'a str {
    let start = source.find(from).expect("it begins");
    let end = source[start..].find(to).map_or(source.len(), |end| start + end);
    source[start..end].trim_end()
}

#[test]
fn the_readme_shows_the_first_example() {
    let first = include_str!("../../dvi-core/examples/first.rs");
    let shown = format!("```rust,no_run\n{}\n```", excerpt(first, "use dvi_core", "no such line"));
    assert!(README.contains(&shown), "the README should show the program `first`:\n{shown}");
}

/// It is for readers in a hurry.
#[test]
fn the_readme_is_short() {
    let words = README.split_whitespace().count();
    assert!(words <= 1200, "the README has {words} words");
}

#[test]
fn the_readme_shows_what_the_first_program_prints() {
    let shown = format!("```text\n{}```", printed_by("first", &empty_folder("first")));
    assert!(README.contains(&shown), "the README should show:\n{shown}");
}

/// The system of the first program.
#[lagrangian(
    coordinates(angle),
    lagrangian = dot(angle).powi(2) / 2.0 + g / length * angle.cos(),
)]
pub(crate) struct Pendulum {
    pub(crate) g: f64,
    pub(crate) length: f64,
}

#[test]
fn the_energy_of_the_first_program_stays_in_its_band() -> Result<(), Box<dyn std::error::Error>> {
    let pendulum = Pendulum { g: 9.81, length: 1.0 };
    let start = PendulumState { angle: 2.0, dot_angle: 0.0 };
    let mut run = Integrator::new(&pendulum, Variational::trapezoid(), 0.01, start)?;
    let energy = run.energy();
    let mut largest = |steps: u64| -> Result<f64, StepError> {
        let mut largest = 0.0;
        for _ in 0..steps {
            run.advance()?;
            largest = larger(largest, (run.energy() - energy).abs());
        }
        Ok(largest)
    };
    // A swing to and fro takes 2.66.
    let (first, all) = (largest(266)?, largest(2_000_000)?);
    assert!(first > 1e-3 && all < 1.01 * first, "{first:e} and {all:e}");
    assert!(README.contains("within two\nmillion steps it does not differ by more"));
    Ok(())
}

/// What the examples are to show, in their own numbers.
#[test]
fn examples_write_their_tables_and_show_what_they_say() {
    let folder = empty_folder("examples");
    for (example, table, rows) in [
        ("pendulum", "pendulum", 1000),
        ("kepler", "kepler", 40_000),
        ("vortices", "vortices", 3000),
        ("lotka_volterra", "lotka-volterra", 2000),
    ] {
        let printed = printed_by(example, &folder);
        let file = format!("results/{table}.csv");
        assert!(printed.contains(&file), "{printed}");
        let page = fs::read_to_string(folder.join(format!("results/{table}.html"))).expect("a page");
        assert!(page.ends_with("</html>\n") && !page.contains("http"), "{example}");
        let written = fs::read_to_string(folder.join(&file)).expect("a table");
        let columns = written.lines().next().expect("a head").split(',').count();
        assert!(written.lines().count() > rows, "{file}");
        for line in written.lines().skip(1) {
            let numbers: Vec<f64> = line.split(',').map(|cell| cell.parse().expect("a number")).collect();
            assert!(numbers.len() == columns && numbers.iter().all(|x| x.is_finite()), "{file}: {line}");
        }
        let source =
            Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../dvi-core/examples/{example}.rs"));
        assert!(fs::read_to_string(source).expect("source").lines().count() < 60, "{example}");
    }
    let table = |name: &str| -> Vec<Vec<f64>> {
        let text = fs::read_to_string(folder.join(format!("results/{name}.csv"))).expect("a table");
        text.lines()
            .skip(1)
            .map(|line| line.split(',').map(|x| x.parse().expect("a number")).collect())
            .collect()
    };
    // The error of the variational integrator is as large in the last tenth of the run as in the first, and
    // that of Runge–Kutta has grown.
    let largest =
        |rows: &[Vec<f64>], column: usize| rows.iter().map(|row| row[column].abs()).fold(0.0, larger);
    let pendulum = table("pendulum");
    let growth = |column: usize| largest(&pendulum[900..], column) / largest(&pendulum[..100], column);
    assert!(growth(1) < 1.1 && growth(2) > 5.0, "{} and {}", growth(1), growth(2));
    // The comet's energy error with steps that follow the motion: the energy is in the sixth column.
    let kepler = table("kepler");
    let error = kepler.iter().map(|row| (row[5] - kepler[0][5]).abs()).fold(0.0, larger);
    assert!(error < 2e-3 && error > 0.0, "{error:e}");
}

/// The period of the cycle, by another integration: the classical Runge–Kutta method, written out, with
/// steps a tenth as long, and the passage through the equilibrium by Newton's method on it.
#[test]
fn the_period_that_an_example_prints_is_right() {
    let printed = printed_by("lotka_volterra", &empty_folder("period"));
    let line = printed.lines().find(|line| line.starts_with("period")).expect("the period");
    let found: f64 = line.rsplit(' ').next().expect("a number").parse().expect("a number");
    let field = |[x, y]: [f64; 2]| [x * (1.0 - y), y * (x - 2.0)];
    let step = |z: [f64; 2], h: f64| {
        let next = oracle::runge_kutta(|z, _| field([z[0], z[1]]).to_vec(), &z, [0.0, h]);
        [next[0], next[1]]
    };
    let (mut z, mut t, h) = ([1.0, 0.5], 0.0, 1e-3);
    let mut times = Vec::new();
    while times.len() < 2 {
        let next = step(z, h);
        if z[0] < 2.0 && next[0] >= 2.0 {
            let mut part = h * (2.0 - z[0]) / (next[0] - z[0]);
            for _ in 0..5 {
                let at = step(z, part);
                part -= (at[0] - 2.0) / field(at)[0];
            }
            times.push(t + part);
        }
        (z, t) = (next, t + h);
    }
    let expected = times[1] - times[0];
    assert_abs_diff_eq!(found, expected, epsilon = 1e-7);
}
