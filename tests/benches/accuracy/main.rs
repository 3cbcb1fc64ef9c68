//! Accuracy against cost, in times: methods of this library and other programs on four vortices, on a Kepler
//! orbit and on the outer solar system.
//!
//! `cargo bench -p dvi-benches --bench accuracy [-- --out DIR]`. For each problem and each method a sweep
//! over steps or tolerances gives points of cost and accuracy. The table has the time of the fastest run
//! that holds the energy to a bound. The accuracy is the largest error of the energy over the ends of all
//! steps, of a run that is not timed; the run that is timed looks at no energy. A time is that of the
//! processor, and the median of interleaved runs in one process.
//!
//! If `alternatives.csv`, which `tests/benches/alternatives/run` writes, is in `accuracy` in the target
//! folder, or in DIR, its points are among them.

mod alternatives;
mod fields;
mod measure;
mod ours;
mod problem;
mod problems;
mod report;
mod rivals;

use std::path::PathBuf;

use anyhow::{Context as _, Result, bail};

use alternatives::Alternatives;
use problems::{GAUSS_16, KAHAN_LI, REFERENCE, TO_TOLERANCE};
use report::Measured;

fn main() -> Result<()> {
    let alternatives = Alternatives::read(&folder()?)?;
    let problems = [problems::vortices(), problems::kepler(), problems::planets()];
    let mut all = Vec::new();
    for problem in &problems {
        let mut points = measure::measure(problem);
        points.extend(alternatives.of(problem.name));
        let measured = Measured { problem, points };
        measured.print();
        all.push(measured);
    }
    let [vortices, _, planets] = &all[..] else { bail!("three problems") };
    println!();
    for gauss in [GAUSS_16, TO_TOLERANCE] {
        bar("vortices, |ΔH| ≤ 1e-10", gauss, REFERENCE, vortices.ratio(gauss, REFERENCE, 1e-10), 0.4);
    }
    bar("planets, |ΔH|/|H| ≤ 1e-13", GAUSS_16, KAHAN_LI, planets.ratio(GAUSS_16, KAHAN_LI, 1e-13), 0.7);
    Ok(())
}

/// Prints a ratio beside what it is to be.
fn bar(on: &str, method: &str, other: &str, ratio: Option<f64>, most: f64) {
    let ratio = ratio.map_or("not measured".into(), |ratio| format!("{ratio:.2}"));
    println!("{on}: {method} / {other} = {ratio} (to be at most {most})");
}

/// The folder after `--out`, or `accuracy` in the target folder. What cargo adds is `--bench`; `--markdown`
/// changes nothing here, where all tables are in Markdown.
fn folder() -> Result<PathBuf> {
    let ours = |argument: &String| !["--bench", "--markdown"].contains(&argument.as_str());
    let mut arguments = std::env::args().skip(1).filter(ours);
    match (arguments.next().as_deref(), arguments.next()) {
        (None, _) => {
            let program = std::env::current_exe().context("where is this program?")?;
            let target = program.ancestors().nth(3).context("benchmarks are in the target folder")?;
            Ok(target.join("accuracy"))
        }
        (Some("--out"), Some(folder)) => Ok(folder.into()),
        _ => bail!("arguments: [--out DIR]"),
    }
}
