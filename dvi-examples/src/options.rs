//! The command line.

use std::path::PathBuf;

use clap::Parser;
use clap::builder::PossibleValuesParser;

use crate::experiments;

/// Reproduces the published experiments on variational integrators.
///
/// Without options the experiments of the papers run at full length, in some minutes. Each writes a figure
/// (SVG and PNG of the same picture) and its data (CSV); at the end `summary.md` says, claim by claim, what
/// the paper says, what was measured, and whether it was reproduced, and `summary.csv` says the same to
/// programs. A run replaces the parts of its own experiments in the summary of its folder and keeps the
/// others.
#[derive(Debug, Parser)]
#[command(name = "dvi-examples", version, after_help = AFTER_HELP)]
pub struct Options {
    /// The folder for figures, tables and the summary; it is created if it does not exist
    /// [default: results, with --short results-short]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,

    /// Run those too that go beyond the papers, which takes several times as long
    #[arg(long, conflicts_with = "only")]
    pub all: bool,

    /// Run the same experiments for shorter times; claims that need longer ones stay undecided
    #[arg(long)]
    pub short: bool,

    /// Run only these experiments (see --list)
    #[arg(long, value_name = "NAME", num_args = 1.., value_parser = PossibleValuesParser::new(experiments::names()),
          hide_possible_values = true)]
    pub only: Vec<String>,

    /// List the experiments and exit
    #[arg(long)]
    pub list: bool,

    /// Threads to use; the results are the same for every number [default: all processors]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
}

impl Options {
    pub fn folder(&self) -> PathBuf {
        let default = if self.short { "results-short" } else { "results" };
        self.out.clone().unwrap_or_else(|| default.into())
    }
}

const AFTER_HELP: &str = "\
Experiments that have ended are in the summary and on the page at once, also if Ctrl-C stops the others.

Exit status: 0 all experiments ran, 1 an error, 2 a bad argument.";
