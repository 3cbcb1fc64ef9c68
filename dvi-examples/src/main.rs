//! The gallery: published experiments on variational integrators, reproduced with figures, tables and
//! a summary that compares claim by claim.
//!
//! `cargo run --release -p dvi-examples` runs those of the papers; `--help` says what else there is.

#![allow(unreachable_pub, reason = "in a binary `pub` means: for the other modules")]

mod alternating;
mod claim;
mod envelope;
mod experiments;
mod gallery;
mod job;
mod motions;
mod numbers;
mod options;
mod page;
mod progress;
mod record;
mod rk4;
mod runs;
mod series;
mod summary;
mod vocabulary;

use std::io::Write as _;
use std::path::Path;
use std::process::ExitCode;
use std::sync::{Mutex, PoisonError};

use anyhow::{Context as _, Result};
use clap::Parser as _;
use console::Term;

use dvi_examples::{figure, output};

use crate::gallery::Experiment;
use crate::job::Length;
use crate::options::Options;
use crate::record::Part;

fn main() -> ExitCode {
    let options = Options::parse();
    let done = if options.list { list() } else { run(&options) };
    done.unwrap_or_else(|error| {
        eprintln!("error: {error:#}");
        ExitCode::FAILURE
    })
}

/// Those of the papers, which run if nothing else is said, and below them those that go beyond.
fn list() -> Result<ExitCode> {
    let lines = |of_papers: bool| {
        let listed = experiments::ALL.iter().filter(|experiment| experiment.is_of_a_paper() == of_papers);
        listed
            .map(|experiment: &Experiment| format!("{:<20} {}\n", experiment.name, experiment.title))
            .collect::<String>()
    };
    say(&format!("{}\nWith --all also:\n\n{}", lines(true), lines(false))).map(|()| ExitCode::SUCCESS)
}

fn run(options: &Options) -> Result<ExitCode> {
    let folder = options.folder();
    output::prepare_folder(&folder)?;
    // A summary that cannot be completed is an error before the first number is computed.
    let parts = Mutex::new(record::load(&folder)?);
    let wanted = |experiment: &Experiment| {
        let is_named = options.only.iter().any(|name| name == experiment.name);
        is_named || options.only.is_empty() && (options.all || experiment.is_of_a_paper())
    };
    let chosen: Vec<Experiment> = experiments::ALL.iter().copied().filter(wanted).collect();
    let length = if options.short { Length::Short } else { Length::Full };
    eprintln!("experiments: {}; results go to {}", chosen.len(), folder.display());

    gallery::run(&chosen, &folder, length, options.threads, |part| {
        let mut parts = parts.lock().unwrap_or_else(PoisonError::into_inner);
        record::put(&mut parts, part, &experiments::names());
        write(&folder, &parts)
    })?;
    let mut parts = parts.into_inner().unwrap_or_else(PoisonError::into_inner);
    parts.retain(|part| chosen.iter().any(|experiment| experiment.name == part.experiment));
    say(&format!("\n{}", summary::markdown(&parts, experiments::ALL)?))?;
    eprintln!("look at {}", folder.join("index.html").display());
    let has_failed = parts.iter().any(|part| part.outcome.is_err());
    Ok(if has_failed { ExitCode::FAILURE } else { ExitCode::SUCCESS })
}

/// Writes what the parts of a folder say together, so that a run can be looked at, or stopped, at any time.
fn write(folder: &Path, parts: &[Part]) -> Result<()> {
    record::save(folder, parts)?;
    output::write_whole(&folder.join("summary.md"), summary::markdown(parts, experiments::ALL)?.as_bytes())?;
    output::write_whole(&folder.join("index.html"), page::html(parts, folder)?.as_bytes())
}

/// Prints, on a terminal in lines that break between words, and does not mind a reader who has seen enough.
fn say(text: &str) -> Result<()> {
    let text = match Term::stdout().size_checked() {
        None => text.to_owned(),
        Some((_, width)) => {
            let options = textwrap::Options::new(width.into()).subsequent_indent("    ");
            text.lines().map(|line| textwrap::fill(line, &options) + "\n").collect()
        }
    };
    match std::io::stdout().lock().write_all(text.as_bytes()) {
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        other => other.context("cannot print"),
    }
}
