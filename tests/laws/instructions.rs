//! Instructions of a step of each case in the table of schemes, counted under valgrind.
//!
//! `cargo bench -p dvi-laws --bench instructions > before` prints a line for each case: instructions a step,
//! and how many steps have been counted, as some cases end before. With `-- $PWD/before` it says what has
//! changed since.

#![allow(clippy::print_stdout)]

use dvi_tests::Outcome;
use std::fs;
use std::path::Path;
use std::process::Command;

/// Steps before those that are counted, with which a run gets going, and those.
const STEPS: [u64; 2] = [12, 48];

/// What changed by more than this is named.
const NOTED: f64 = 0.01;

fn main() -> Outcome {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|argument| argument != "--bench").collect();
    if arguments == ["steps"] {
        take_steps();
        return Ok(());
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("instructions");
    let counted = count(&folder)?;
    fs::remove_dir_all(&folder)?;
    match arguments.as_slice() {
        [] => counted.iter().for_each(|(case, per_step)| println!("{per_step:.1}\t{case}")),
        [before, ..] => compare(&fs::read_to_string(before)?, &counted)?,
    }
    Ok(())
}

/// Stands before and after the steps of a case.
#[inline(never)]
fn mark_of_cases() {
    std::hint::black_box(());
}

/// Takes the steps of all cases, each between two marks, and prints what they are.
fn take_steps() {
    for case in dvi_laws::all() {
        let mut run = case.run().expect("starts");
        let started = run.take_steps(STEPS[0]).is_ok();
        let before = run.asked().1;
        mark_of_cases();
        // A case may end before.
        let _ = started && run.take_steps(STEPS[1]).is_ok();
        mark_of_cases();
        println!("{}\t{case:?}\t{:?}", run.asked().1 - before, case.options);
    }
}

/// The cases, with instructions a step.
fn count(folder: &Path) -> Outcome<Vec<(String, f64)>> {
    fs::create_dir_all(folder)?;
    let mut valgrind = Command::new("valgrind");
    valgrind.args(["--tool=callgrind", "--dump-before=*mark_of_cases*"]);
    valgrind.arg(format!("--callgrind-out-file={}", folder.join("counts").display()));
    valgrind.arg(std::env::current_exe()?).arg("steps");
    let output = valgrind.output().map_err(|_| "valgrind is needed to count instructions")?;
    let cases = String::from_utf8(output.stdout)?;
    let counted = cases.lines().enumerate().map(|(number, case)| {
        // The files are numbered from 1 on, and every other one ends with the steps of a case.
        let total = total(&folder.join(format!("counts.{}", 2 * number + 2)))?;
        let (steps, _) = case.split_once('\t').ok_or("no case")?;
        Ok((case.to_owned(), total / f64::max(steps.parse()?, 1.0)))
    });
    counted.collect()
}

fn total(file: &Path) -> Outcome<f64> {
    let text = fs::read_to_string(file)?;
    let total = text.lines().find_map(|line| line.strip_prefix("totals:")).ok_or("no total")?;
    Ok(total.trim().parse()?)
}

/// Prints the mean ratio, and the cases in which it is another than one. Both tables have the same rows.
fn compare(before: &str, now: &[(String, f64)]) -> Outcome {
    let mut ratios = Vec::new();
    let mut rows = before.lines().filter_map(|line| line.split_once('\t'));
    for (case, count) in now {
        let (before, _) = rows.next().filter(|row| row.1 == case).ok_or("another table of schemes")?;
        ratios.push((count / before.parse::<f64>()?, case));
    }
    ratios.sort_by(|one, other| one.0.total_cmp(&other.0));
    for (ratio, case) in ratios.iter().filter(|(ratio, _)| (ratio - 1.0).abs() > NOTED) {
        println!("{ratio:.3}\t{case}");
    }
    let mean = ratios.iter().map(|(ratio, _)| ratio.ln()).sum::<f64>() / ratios.len() as f64;
    println!("{} cases, in the mean {:.4}", ratios.len(), mean.exp());
    Ok(())
}
