//! Instructions per step of the same kernels, counted under valgrind: these do not wobble.
//!
//! `cargo bench -p dvi-kernels --bench instructions`. The program runs itself under
//! `valgrind --tool=callgrind` with two numbers of steps; the difference is free of all set-up. It fails if
//! a generated step takes more instructions than `instructions.csv` allows. It also prints a hash of
//! gradients that use the widest instructions of the processor.

#![allow(clippy::print_stdout)]

mod pinned;
mod printed;

use dvi_kernels as kernels;
use printed::{WIDE, hash_of};
use std::process::{Child, Command, ExitCode, Stdio};

const STEPS: [u64; 2] = [1000, 2000];

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().collect();
    if let [_, kernel, steps] = arguments.as_slice()
        && let Ok(steps) = steps.parse()
    {
        std::hint::black_box(kernels::run(kernel, steps));
        return ExitCode::SUCCESS;
    }
    println!("{WIDE}{}", hash_of(&kernels::wide::bits()));
    let pinned = pinned::rows();
    let mut exceeded = Vec::new();
    println!("{:<36} {:>10} {:>10} {:>7} {:>10}", "step", "generated", "by hand", "ratio", "pinned");
    for [generated, by_hand] in kernels::KERNELS {
        let Some([ours, theirs]) = count([generated, by_hand]) else {
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

/// Instructions per step of each kernel, or `None` without valgrind. All runs are started at once.
fn count<const KERNELS: usize>(kernels: [&str; KERNELS]) -> Option<[f64; KERNELS]> {
    let runs = kernels.map(|kernel| STEPS.map(|steps| start(kernel, steps)));
    let mut counts = [0.0; KERNELS];
    for (count, runs) in counts.iter_mut().zip(runs) {
        let [few, many] = runs.map(|run| total(run?));
        *count = (many? - few?) / (STEPS[1] - STEPS[0]) as f64;
    }
    Some(counts)
}

fn start(kernel: &str, steps: u64) -> Option<Child> {
    let mut valgrind = Command::new("valgrind");
    valgrind.args(["--tool=callgrind", "--callgrind-out-file=/dev/null"]);
    valgrind.arg(std::env::current_exe().ok()?).args([kernel, &steps.to_string()]);
    valgrind.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().ok()
}

fn total(run: Child) -> Option<f64> {
    let text = String::from_utf8(run.wait_with_output().ok()?.stderr).ok()?;
    text.split("Collected :").nth(1)?.split_whitespace().next()?.parse().ok()
}
