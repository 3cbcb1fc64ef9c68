//! The gallery as a person starts it: arguments, files, exit codes, Ctrl-C.

#[path = "../../../tests/src/browser.rs"]
mod browser;
mod page;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::{BufRead as _, BufReader};
use std::path::Path;
use std::process::{Command, Output, Stdio};

use tempfile::tempdir;

/// The experiments whose motion is shown.
const MOTIONS: [&str; 6] =
    ["fig3-leapfrogging", "kepler-long", "links", "top", "guiding-centre", "shear-layer"];

fn gallery(arguments: &[&str], out: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_dvi-examples"));
    command.args(arguments).arg("--out").arg(out);
    command
}

/// What a run that ends with this code prints, and its messages.
fn told(command: &mut Command, code: i32) -> [String; 2] {
    let Output { status, stdout, stderr } = command.output().expect("the program starts");
    let told = [stdout, stderr].map(|text| String::from_utf8(text).expect("UTF-8"));
    assert_eq!(status.code(), Some(code), "{told:?}");
    told
}

fn names(folder: &Path) -> BTreeSet<String> {
    let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("readable").file_name());
    entries.map(|name| name.to_string_lossy().into_owned()).collect()
}

/// The experiments with their titles: those of the papers, and those that go beyond.
fn list() -> [Vec<String>; 2] {
    let [list, _] = told(&mut gallery(&["--list"], Path::new(".")), 0);
    let (papers, beyond) = list.split_once("\nWith --all also:\n\n").expect("two lists");
    [papers, beyond].map(|list| list.lines().map(str::to_owned).collect())
}

fn names_in(list: &[String]) -> BTreeSet<&str> {
    list.iter().filter_map(|line| line.split_whitespace().next()).collect()
}

/// What it writes stays in `target/tmp/short-run`.
#[test]
fn a_short_run_writes_complete_files_for_every_experiment_and_a_summary() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("short-run");
    if folder.exists() {
        fs::remove_dir_all(&folder).expect("removed");
    }
    let [printed, messages] = told(&mut gallery(&["--short", "--all"], &folder), 0);
    let place = |name: &str| messages.find(&format!("\n{name} ")).expect("it ended");
    assert!(place("order") < place("kepler-long"), "{messages}");
    let list = list().concat();
    let experiments = names_in(&list);
    assert!(experiments.len() >= 40, "{experiments:?}");
    let files =
        experiments.iter().flat_map(|name| ["svg", "png", "csv"].map(|kind| format!("{name}.{kind}")));
    let motions = MOTIONS.map(|name| format!("{name}.html"));
    let pages = ["index.html", "summary.csv", "summary.md"].map(str::to_owned);
    assert_eq!(names(&folder), files.chain(pages).chain(motions).collect());
    for name in &experiments {
        let read = |extension| fs::read(folder.join(format!("{name}.{extension}"))).expect("readable");
        let svg = String::from_utf8(read("svg")).expect("UTF-8");
        let document = roxmltree::Document::parse(&svg).expect("well-formed");
        assert_eq!(document.root_element().tag_name().name(), "svg", "{name}");
        assert!(!svg.contains("NaN") && svg.len() < 500_000, "{name}: {} bytes", svg.len());
        assert!(read("png").starts_with(b"\x89PNG") && read("png").ends_with(b"IEND\xaeB`\x82"), "{name}");
        assert!(read("csv").iter().filter(|&&byte| byte == b'\n').count() > 3, "{name}");
    }
    let figure = fs::read(folder.join("fig3-leapfrogging.svg")).expect("readable");
    let shown = include_bytes!("../../figures/leapfrogging.svg");
    assert!(figure == shown, "the README shows another figure than this program draws: copy it to figures/");
    let table = fs::read_to_string(folder.join("summary.csv")).expect("readable");
    page::has_all(&folder, &experiments, &verdicts(&table));
    let summary = fs::read_to_string(folder.join("summary.md")).expect("readable");
    assert!(experiments.iter().all(|name| summary.contains(&format!("## {name}:"))), "{summary}");
    assert!(!summary.contains("**fails**") && !summary.contains("**Failed**"), "{summary}");
    assert_eq!(printed, format!("\n{summary}"));
    same_claims(&table);
}

#[test]
fn the_readme_shows_each_experiment() {
    let readme = include_str!("../../README.md");
    for line in list().concat() {
        let (name, title) = line.split_once(' ').expect("a name and a sentence");
        let cell = format!("![](figures/{name}.webp)<br>`{name}`: {}.", title.trim_start());
        assert!(readme.contains(&cell), "dvi-examples/README.md should say:\n{cell}");
        let picture = format!("{}/figures/{name}.webp", env!("CARGO_MANIFEST_DIR"));
        assert!(Path::new(&picture).exists(), "{picture}");
    }
}

/// The verdicts of a summary: "undecided" or how a claim was decided.
fn verdicts(table: &str) -> BTreeMap<[String; 3], String> {
    let mut reader = csv::Reader::from_reader(table.as_bytes());
    let rows = reader.records().map(|row| row.expect("a row"));
    let claims = rows.filter(|row| &row[3] == "claim");
    claims.map(|row| ([0, 4, 5].map(|i| row[i].to_owned()), row[10].to_owned())).collect()
}

/// The table of the full run that the README quotes has the claims of this program, and the same verdicts
/// wherever the short form decides.
fn same_claims(short: &str) {
    let (short, full) = (verdicts(short), verdicts(include_str!("../../full-run.csv")));
    assert!(short.keys().eq(full.keys()), "full-run.csv is out of date: see tests/readme");
    for (claim, verdict) in short.iter().filter(|(_, verdict)| !verdict.starts_with("undecided")) {
        assert_eq!(verdict, &full[claim], "{claim:?}: full-run.csv is out of date, see tests/readme");
    }
}

#[test]
fn results_are_the_same_for_every_number_of_threads() {
    let [one, two] = ["1", "2"].map(|threads| {
        let folder = tempdir().expect("a folder");
        let experiments =
            ["--short", "--threads", threads, "--only", "fig2-energy", "stability", "kepler-work"];
        told(gallery(&experiments, folder.path()).env("SOURCE_DATE_EPOCH", "0"), 0);
        let read = |name: String| fs::read(folder.path().join(name)).expect("readable");
        names(folder.path()).into_iter().map(read).collect::<Vec<_>>()
    });
    assert_eq!(one.len(), 12);
    assert!(one == two);
}

#[test]
fn a_run_without_a_terminal_leaves_what_was_asked_for_and_plain_lines() {
    let folder = tempdir().expect("a folder");
    let mut command = Command::new(env!("CARGO_BIN_EXE_dvi-examples"));
    let command = command.args(["--short", "--only", "momenta", "barnes"]).current_dir(folder.path());
    let [_, lines] = told(command, 0);
    let of = |name: &str| ["csv", "png", "svg"].map(|kind| format!("{name}.{kind}"));
    let files =
        [of("barnes"), of("momenta"), ["index.html", "summary.csv", "summary.md"].map(str::to_owned)];
    assert_eq!(names(&folder.path().join("results-short")), files.into_iter().flatten().collect());
    assert!(!lines.contains(['\u{1b}', '\r']) && lines.contains("(2 of 2)"), "{lines}");
}

#[test]
fn the_main_job_is_that_of_the_papers() {
    let claims = verdicts(include_str!("../../full-run.csv")).into_keys();
    let of_papers = claims.filter(|[_, place, _]| place != "beyond the paper").collect::<Vec<_>>();
    assert!(of_papers.len() >= 30, "{of_papers:?}");
    let [papers, beyond] = list();
    let with_claims: BTreeSet<_> = of_papers.iter().map(|[experiment, ..]| experiment.as_str()).collect();
    assert!(with_claims.is_subset(&names_in(&papers)) && beyond.len() >= 20, "{papers:?}");
    // What is stopped at once has said what it was to do.
    let folder = tempdir().expect("a folder");
    let mut command = gallery(&["--short"], folder.path());
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("starts");
    let mut messages = BufReader::new(child.stderr.take().expect("piped")).lines();
    let first = messages.next().expect("a line").expect("readable");
    child.kill().and_then(|()| child.wait()).expect("ends");
    assert!(first.starts_with(&format!("experiments: {}; ", papers.len())), "{first}");
}

#[test]
fn a_run_completes_the_summary_of_its_folder() {
    let folder = tempdir().expect("a folder");
    let new = folder.path().join("new/folder");
    for (name, seconds) in [("momenta", "0"), ("barnes", "86400"), ("momenta", "0")] {
        told(gallery(&["--short", "--only", name], &new).env("SOURCE_DATE_EPOCH", seconds), 0);
    }
    let summary = fs::read_to_string(new.join("summary.md")).expect("readable");
    let section =
        |name: &str| summary.split("\n## ").find(|part| part.starts_with(name)).unwrap_or_default();
    assert!(section("momenta: ").contains("The short form, 1970-01-01 00:00 UTC."), "{summary}");
    assert!(section("barnes: ").contains("The short form, 1970-01-02 00:00 UTC."), "{summary}");
    assert_eq!(summary.matches("\n## ").count(), 2, "{summary}");
}

#[test]
fn results_that_could_not_be_written_are_refused_before_anything_runs() {
    let folder = tempdir().expect("a folder");
    let table = folder.path().join("summary.csv");
    fs::write(&table, "a,b\n1,2\n").expect("written");
    for (out, words) in [
        (folder.path().to_owned(), "remove it or choose another folder"),
        (table.join("below"), "cannot create the folder"),
    ] {
        let [_, message] = told(&mut gallery(&["--short", "--only", "momenta"], &out), 1);
        assert!(message.starts_with("error: ") && message.contains(words), "{message}");
    }
    assert_eq!(names(folder.path()).into_iter().collect::<Vec<_>>(), ["summary.csv"]);
}

#[test]
fn bad_arguments_are_refused_before_anything_is_written() {
    let folder = tempdir().expect("a folder");
    let refused = |arguments: &[&str], hint: &str| {
        let [_, message] = told(&mut gallery(arguments, &folder.path().join("out")), 2);
        assert!(message.contains(hint), "{message}");
    };
    refused(&["--only", "fig2-energi"], "fig2-energy");
    refused(&["--only", "fig9"], "fig2-energy");
    refused(&["--only"], "--only <NAME>");
    refused(&["--threads", "0"], "1..=1024");
    refused(&["--treads", "2"], "--threads");
    refused(&["results"], "unexpected argument");
    assert!(names(folder.path()).is_empty());
}

#[cfg(unix)]
#[test]
fn what_has_ended_is_there_when_the_rest_is_stopped() {
    let folder = tempdir().expect("a folder");
    let mut command = gallery(&["--only", "fig5-chaotic", "momenta", "--threads", "1"], folder.path());
    let mut child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("starts");
    let messages = BufReader::new(child.stderr.take().expect("piped")).lines();
    let mut messages = messages.map(|line| line.expect("readable"));
    assert!(messages.any(|line| line.starts_with("momenta ") && line.contains(" done, ")));
    // As by Ctrl-C, which a process that a shell has put into the background ignores.
    let kill = Command::new("kill").args(["-TERM", &child.id().to_string()]).status().expect("kill starts");
    assert!(kill.success() && !child.wait().expect("ends").success());
    let files = ["index.html", "momenta.csv", "momenta.png", "momenta.svg", "summary.csv", "summary.md"];
    assert_eq!(names(folder.path()).into_iter().collect::<Vec<_>>(), files);
    for file in ["index.html", "summary.csv", "summary.md"] {
        let page = fs::read_to_string(folder.path().join(file)).expect("readable");
        assert!(page.contains("momenta") && !page.contains("fig5-chaotic"), "{page}");
    }
}
