//! The page of the gallery: for each experiment its figure, its claims with their verdicts and numbers, and
//! its motion if it has one, in one file that loads nothing.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use crate::claim::{Claim, Verdict};
use crate::experiments::{self, SOURCES};
use crate::gallery::Experiment;
use crate::record::{Part, State};
use crate::summary::tally;

const TEMPLATE: &str = include_str!("page/page.html");
/// On this page the page of a record shows the motion alone.
const MOTION_ALONE: &str = concat!("<style>", include_str!("page/motion.css"), "</style></head>");

/// The page of a folder that the runs of these parts have left their figures in.
pub fn html(parts: &[Part], folder: &Path) -> String {
    let mut cards = String::new();
    for experiment in experiments::ALL {
        if let Some(part) = parts.iter().find(|part| part.experiment == experiment.name) {
            card(&mut cards, part, experiment, folder);
        }
    }
    let chips: String =
        SOURCES.into_iter().chain(["beyond the papers"]).map(|name| chip("source", name)).collect();
    let verdicts =
        ["reproduced", "differs", "holds", "undecided", "fails"].map(|name| chip("verdict", name));
    let parts = [
        ("style", include_str!("page/page.css")),
        ("tally", &format!("{}.", text(&tally(parts)))),
        ("chips", &format!("<p>{chips}</p><p>{}</p>", verdicts.concat())),
        ("script", include_str!("page/page.js")),
        ("cards", &cards),
    ];
    parts
        .into_iter()
        .fold(TEMPLATE.to_owned(), |page, (name, part)| page.replacen(&format!("{{{{{name}}}}}"), part, 1))
}

fn chip(kind: &str, name: &str) -> String {
    let name = text(name);
    format!(
        "<button type=\"button\" data-{kind}=\"{name}\" aria-pressed=\"false\">{name} <b></b></button>\n"
    )
}

fn card(page: &mut String, part: &Part, experiment: &Experiment, folder: &Path) {
    let Experiment { name, title, source, .. } = experiment;
    let kind = if experiment.is_of_a_paper() { source } else { "beyond the papers" };
    let source = if source.is_empty() { String::new() } else { format!(" · {}", text(source)) };
    let _ = write!(
        page,
        "<article id=\"{name}\" data-source=\"{}\">\n<h2>{}</h2>\n<p class=\"small\"><code>{name}</code>{source}\
         , the {} form, {}</p>\n<div class=\"sides\">\n<div>",
        text(kind),
        text(title),
        part.length.name(),
        part.when
    );
    if let Ok(svg) = fs::read_to_string(folder.join(format!("{name}.svg"))) {
        let (svg, title) = (in_address(&svg), text(title));
        let _ = write!(
            page,
            "<a href=\"{name}.svg\"><img src=\"data:image/svg+xml,{svg}\" alt=\"{title}\"></a>"
        );
    }
    let files =
        [("csv", "table"), ("svg", "figure"), ("png", "as PNG"), ("html", "motion, energy and more")];
    let is_there = |(extension, _): &(&str, &str)| folder.join(format!("{name}.{extension}")).exists();
    let links = files.iter().filter(|file| is_there(file));
    let links = links.map(|(extension, what)| format!("<a href=\"{name}.{extension}\">{what}</a>"));
    let _ = write!(page, "\n<p class=\"small\">{}</p></div>\n<div>", links.collect::<Vec<_>>().join(" · "));
    match &part.state {
        State::Failed(error) => *page += &format!("<p class=\"fails\">Failed: {}</p>", text(error)),
        State::NotStarted | State::Interrupted => {
            *page += "<p class=\"fails\">Interrupted: no claim was decided.</p>";
        }
        State::Complete => results(page, part),
    }
    *page += "</div>\n</div>\n";
    if let Ok(motion) = fs::read_to_string(folder.join(format!("{name}.html"))) {
        let motion = quoted(&motion.replacen("</head>", MOTION_ALONE, 1));
        let _ = writeln!(page, "<iframe title=\"The motion\" srcdoc=\"{motion}\"></iframe>");
    }
    *page += "</article>\n";
}

fn results(page: &mut String, part: &Part) {
    *page += "<ul>\n";
    for claim in &part.outcome.claims {
        let (verdict, checks) = (verdict(claim), claim.checks().map(|check| text(&check.to_string())));
        let judgement = text(&claim.judgement());
        let _ = write!(
            page,
            "<li data-verdict=\"{verdict}\"><b class=\"{verdict}\">{verdict}</b> {}",
            text(&claim.says)
        );
        let _ = write!(page, " <span class=\"small\">({})</span>", text(&claim.place));
        if let Some((_, instead)) = judgement.split_once("differs: ") {
            let _ = write!(page, "<p>Instead: {instead}.</p>");
        }
        numbers(page, checks.collect());
        *page += "</li>\n";
    }
    *page += "</ul>\n";
    let more = part.outcome.references.iter().map(|check| format!("Regression check: {check}"));
    let more: Vec<String> = more.chain(part.outcome.notes.iter().cloned()).map(|line| text(&line)).collect();
    if !more.is_empty() {
        let _ = write!(
            page,
            "<details class=\"small\"><summary>Notes</summary><p>{}</p></details>",
            more.join("</p><p>")
        );
    }
}

/// The first of the numbers of a claim is seen at once.
fn numbers(page: &mut String, checks: Vec<String>) {
    let Some((first, rest)) = checks.split_first() else { return };
    let more = match rest.len() {
        0 => return *page += &format!("<p class=\"small\">{first}</p>"),
        1 => "one number more".to_owned(),
        count => format!("{count} numbers more"),
    };
    let rest = rest.join("</p><p>");
    let _ = write!(
        page,
        "<details class=\"small\"><summary>{first} <u>{more}</u></summary><p>{rest}</p></details>"
    );
}

/// One word for the verdict of a claim.
fn verdict(claim: &Claim) -> &'static str {
    match claim.verdict() {
        Verdict::Reproduced if claim.is_printed() => "reproduced",
        Verdict::Reproduced => "holds",
        Verdict::Differs(_) => "differs",
        Verdict::NotReproduced => "fails",
        Verdict::Undecided => "undecided",
    }
}

/// A text of the page.
fn text(words: &str) -> String {
    quoted(words).replace('<', "&lt;")
}

/// A text in the quotes of an attribute.
fn quoted(words: &str) -> String {
    words.replace('&', "&amp;").replace('"', "&quot;")
}

/// A document as an address, in the quotes of an attribute.
fn in_address(svg: &str) -> String {
    svg.replace('%', "%25").replace('#', "%23").replace('"', "'").replace('&', "%26").replace('\n', "%0A")
}
