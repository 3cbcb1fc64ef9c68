//! The page of the gallery: for each experiment its figure, its claims with their verdicts and numbers, and
//! its motion if it has one, in one file that loads nothing.

use std::fs;
use std::path::Path;

use anyhow::{Context as _, Result};
use askama::Template as _;

use crate::claim::VERDICTS;
use crate::experiments::{self, SOURCES};
use crate::gallery::{Experiment, Outcome};
use crate::record::Part;
use crate::summary;

const BEYOND: &str = "beyond the papers";
/// On this page the page of a record shows the motion alone.
const MOTION_ALONE: &str = concat!("<style>", include_str!("../templates/motion.css"), "</style></head>");

#[derive(askama::Template)]
#[template(path = "page.html")]
struct Page<'a> {
    parts: &'a [Part],
    folder: &'a Path,
    tally: String,
}

/// The page of a folder that the runs of these parts have left their figures in.
pub fn html(parts: &[Part], folder: &Path) -> Result<String> {
    Page { parts, folder, tally: summary::tally(parts) }.render().context("the page cannot be written")
}

impl Page<'_> {
    fn sources(&self) -> impl Iterator<Item = &'static str> {
        SOURCES.into_iter().chain([BEYOND])
    }

    fn cards(&self) -> impl Iterator<Item = Card<'_>> {
        let of = |name| self.parts.iter().find(|part| part.experiment == name);
        let card =
            move |experiment| Some(Card { experiment, part: of(experiment.name)?, folder: self.folder });
        experiments::ALL.iter().filter_map(card)
    }
}

struct Card<'a> {
    experiment: &'a Experiment,
    part: &'a Part,
    folder: &'a Path,
}

impl Card<'_> {
    /// That by which the reader finds it.
    fn source(&self) -> &'static str {
        if self.experiment.is_of_a_paper() { self.experiment.source } else { BEYOND }
    }

    fn file(&self, extension: &str) -> Option<String> {
        fs::read_to_string(self.folder.join(format!("{}.{extension}", self.experiment.name))).ok()
    }

    /// The figure as an address, in the quotes of an attribute.
    fn figure(&self) -> Option<String> {
        let escaped = [('%', "%25"), ('#', "%23"), ('"', "'"), ('&', "%26"), ('\n', "%0A")];
        Some(escaped.iter().fold(self.file("svg")?, |svg, (letter, code)| svg.replace(*letter, code)))
    }

    fn motion(&self) -> Option<String> {
        Some(self.file("html")?.replacen("</head>", MOTION_ALONE, 1))
    }

    /// The files that there are, by their extension and by what they are.
    fn files(&self) -> impl Iterator<Item = (&str, &str)> {
        let files =
            [("csv", "table"), ("svg", "figure"), ("png", "as PNG"), ("html", "motion, energy and more")];
        let path = |extension| self.folder.join(format!("{}.{extension}", self.experiment.name));
        files.into_iter().filter(move |(extension, _)| path(*extension).exists())
    }
}
