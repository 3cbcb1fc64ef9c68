//! Instructions per step of the same kernels, counted under valgrind: these do not wobble.
//!
//! `cargo bench -p dvi-kernels --bench instructions`. The program runs itself under
//! `valgrind --tool=callgrind` with two numbers of steps; the difference is free of all set-up. It fails if a generated
//! step takes more instructions than `instructions.csv` allows.

#![allow(clippy::print_stdout)]

mod pinned;

use dvi_kernels as kernels;
use std::process::{Command, ExitCode};

const STEPS: [u64; 2] = [1000, 2000];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().collect();
    if let [_, kernel, steps] = arguments.as_slice()
        && let Ok(steps) = steps.parse()
    {
        std::hint::black_box(kernels::run(kernel, steps));
        return ExitCode::SUCCESS;
    }
    let pinned = pinned::rows();
    let mut exceeded = Vec::new();
    println!("{:<36} {:>10} {:>10} {:>7} {:>10}", "step", "generated", "by hand", "ratio", "pinned");
    for [generated, by_hand] in kernels::KERNELS {
        let (Some(ours), Some(theirs)) = (count(generated), count(by_hand)) else {
            println!("valgrind is needed to count instructions");
            return ExitCode::SUCCESS;
        };
        let name = generated.split('/').next().unwrap_or_default();
        let Some(pinned) = pinned.iter().find(|row| row.name == name) else {
            println!("{name} is not in instructions.csv");
            return ExitCode::FAILURE;
        };
        println!("{name:<36} {ours:>10.1} {theirs:>10.1} {:>7.3} {:>10.1}", ours / theirs, pinned.generated);
        if ours > pinned::MARGIN * pinned.generated {
            exceeded.push(name);
        }
    }
    if exceeded.is_empty() {
        return ExitCode::SUCCESS;
    }
    println!("more instructions than are pinned, by over 3 %: {}", exceeded.join("; "));
    ExitCode::FAILURE
}

/// Instructions per step.
fn count(kernel: &str) -> Option<f64> {
    let [few, many] = STEPS.map(|steps| total(kernel, steps));
    Some((many? - few?) / (STEPS[1] - STEPS[0]) as f64)
}

fn total(kernel: &str, steps: u64) -> Option<f64> {
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(std::env::current_exe().ok()?)
        .args([kernel, &steps.to_string()])
        .output()
        .ok()?;
    let text = String::from_utf8(output.stderr).ok()?;
    text.split("Collected :").nth(1)?.split_whitespace().next()?.parse().ok()
}
