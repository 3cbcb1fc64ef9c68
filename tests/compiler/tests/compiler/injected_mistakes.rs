//! The self-check of the macro against mistakes in the macro.
//!
//! A copy of the compiler, built once as a program, has all of these mistakes in it, each behind a switch.
//! A run of the program makes one of them, or none, and expands a few systems. The formulas of the systems
//! are right, so the compiler has to find the mistake itself: an expansion that passes unchanged is none
//! that a user is protected from.

use std::cmp::Reverse;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

mod mistakes;
mod systems;

use mistakes::{MISTAKES, Mistake};
use systems::SYSTEMS;

/// The compiler as a program: it makes the mistake of a number, expands each system of a file and says what
/// became of it. Without arguments it says where it stands.
const PROGRAM: &str = r#"
/// The number of the mistake that is made, from 1 on.
static MISTAKE: std::sync::atomic::AtomicUsize = std::sync::atomic::AtomicUsize::new(0);

fn is_wrong(number: usize) -> bool {
    MISTAKE.load(std::sync::atomic::Ordering::Relaxed) == number
}

fn main() {
    let mut arguments = std::env::args().skip(1);
    let Some(number) = arguments.next() else {
        println!("{}", std::env::current_exe().expect("a program").display());
        return;
    };
    MISTAKE.store(number.parse().expect("a number"), std::sync::atomic::Ordering::Relaxed);
    let path = arguments.next().expect("a file of systems");
    let text = std::fs::read_to_string(path).expect("a file of systems");
    for line in text.lines() {
        let parts: Vec<&str> = line.split('\t').collect();
        let [kind, attribute, item] = parts.as_slice() else { panic!("kind, attribute, item") };
        let (attribute, item) = (attribute.parse().expect("tokens"), item.parse().expect("tokens"));
        let expand = if *kind == "regular" { expand::lagrangian } else { expand::degenerate_lagrangian };
        let output = expand(attribute, item).to_string();
        let verdict = match (output.contains("mistake in dvi-macros"), output.contains("compile_error")) {
            (true, _) => "caught",
            (false, true) => "refused",
            (false, false) if output.contains("Checked when compiled") => "passed",
            (false, false) => "unchecked",
        };
        println!("{verdict}");
    }
}
"#;

/// The compiler as a program, with switches for its mistakes, and the systems that it expands.
struct Program {
    executable: PathBuf,
    systems: PathBuf,
}

/// Writes a file; one that stays the same is not compiled again.
fn write(path: &Path, text: &str) {
    if fs::read(path).ok().as_deref() != Some(text.as_bytes()) {
        fs::write(path, text).expect("a file");
    }
}

/// Copies the modules of the compiler, with all mistakes in them; `inside` is the folder, as mistakes name it.
fn copy_modules(from: &Path, to: &Path, inside: &str) {
    fs::create_dir_all(to).expect("a folder");
    for entry in fs::read_dir(from).expect("a folder of sources") {
        let entry = entry.expect("an entry");
        let name = entry.file_name().into_string().expect("a name");
        let (path, file) = (to.join(&name), format!("{inside}{name}"));
        if entry.file_type().expect("a type").is_dir() {
            copy_modules(&entry.path(), &path, &format!("{file}/"));
        } else if file != "lib.rs" {
            write(&path, &with_mistakes(&file, &fs::read_to_string(entry.path()).expect("a source")));
        }
    }
}

/// The text of a file in which each mistake stands beside what is right.
fn with_mistakes(file: &str, text: &str) -> String {
    // What is inserted where. What ends at a place comes before what begins there, and of what begins there
    // the longest comes first: one expression may be a part of another.
    let mut insertions = Vec::new();
    for (mistake, number) in MISTAKES.iter().zip(1..) {
        if mistake.file == file {
            let (start, end) = place(mistake, text);
            let switch = format!("(if crate::is_wrong({number}) {{ {} }} else {{ ", mistake.wrong);
            insertions.push(((start, true, Reverse(end)), switch));
            insertions.push(((end, false, Reverse(end)), " })".to_string()));
        }
    }
    insertions.sort();
    let mut switched = String::new();
    let mut copied = 0;
    for ((place, ..), inserted) in insertions {
        switched += &text[copied..place];
        switched += &inserted;
        copied = place;
    }
    switched + &text[copied..]
}

/// Where the right expression starts and ends.
fn place(mistake: &Mistake, text: &str) -> (usize, usize) {
    let [before, right, after] = mistake.parts();
    let found: Vec<usize> =
        text.match_indices(&[before, right, after].concat()).map(|(start, _)| start).collect();
    let [start] = found[..] else {
        panic!("`{}` stands {} times in {}", mistake.place, found.len(), mistake.file)
    };
    let start = start + before.len();
    (start, start + right.len())
}

impl Program {
    fn build() -> Self {
        let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join("injected-mistakes");
        write_package(&root);
        let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("injected-mistakes-target");
        let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".into());
        let output = Command::new(cargo)
            .args(["run", "--quiet", "--offline", "--manifest-path"])
            .arg(root.join("Cargo.toml"))
            .env("CARGO_TARGET_DIR", target)
            .env_remove("RUSTFLAGS")
            .output()
            .expect("cargo runs");
        let executable = succeeded(&output).unwrap_or_else(|errors| panic!("no program: {errors}"));
        let systems = root.join("systems.txt");
        let lines = SYSTEMS.iter().map(|(kind, attribute, item)| {
            let [attribute, item] =
                [attribute, item].map(|text| text.split_whitespace().collect::<Vec<_>>().join(" "));
            format!("{kind}\t{attribute}\t{item}\n")
        });
        write(&systems, &lines.collect::<String>());
        Self { executable: executable.trim_end().into(), systems }
    }

    /// What became of each system with the mistake of this number, with none if it is 0; or what the program
    /// says when it fails.
    fn verdicts(&self, mistake: usize) -> Result<Vec<String>, String> {
        let output = Command::new(&self.executable)
            .arg(mistake.to_string())
            .arg(&self.systems)
            .output()
            .expect("it runs");
        succeeded(&output).map(|verdicts| verdicts.lines().map(ToString::to_string).collect())
    }
}

/// What a program has printed, or its errors if it failed.
fn succeeded(output: &Output) -> Result<String, String> {
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    if output.status.success() {
        Ok(text(&output.stdout))
    } else {
        Err(format!("{}: {}", output.status, text(&output.stderr)))
    }
}

/// The compiler with its mistakes, and with a `main` in place of the attributes.
fn write_package(root: &Path) {
    let compiler = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../dvi-macros");
    let source = root.join("src");
    copy_modules(&compiler.join("src"), &source, "");
    let library = fs::read_to_string(compiler.join("src/lib.rs")).expect("lib.rs");
    let mut modules = String::from("#![allow(dead_code, unreachable_pub, unused_parens)]\n");
    let mut is_test = false;
    for line in library.lines() {
        if line.starts_with("mod ") && !is_test {
            modules += line;
            modules.push('\n');
        }
        is_test = line == "#[cfg(test)]";
    }
    write(&source.join("main.rs"), &(modules + PROGRAM));
    let manifest = fs::read_to_string(compiler.join("Cargo.toml")).expect("a manifest");
    let (_, dependencies) = manifest.split_once("[dependencies]").expect("dependencies");
    let (dependencies, _) = dependencies.split_once("[dev-dependencies]").expect("dev-dependencies");
    let package = "[package]\nname = \"injected\"\nversion = \"0.0.0\"\nedition = \"2024\"\n";
    let profile = "[profile.dev]\ndebug = false\nincremental = false\n";
    let manifest = format!("{package}\n[dependencies]{dependencies}\n{profile}\n[workspace]\n");
    write(&root.join("Cargo.toml"), &manifest);
    fs::copy(compiler.join("../Cargo.lock"), root.join("Cargo.lock")).expect("the lock file");
}

#[test]
fn every_injected_mistake_is_caught() {
    for mistake in MISTAKES {
        // The place of a mistake in a file that does not exist would not be looked for.
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../dvi-macros/src").join(mistake.file);
        assert!(path.is_file(), "{} is no file of the compiler", mistake.file);
    }
    let program = Program::build();
    let passed = vec!["passed".to_string(); SYSTEMS.len()];
    assert_eq!(program.verdicts(0), Ok(passed), "the compiler as it is");
    let mut survivors = Vec::new();
    let mut failures = Vec::new();
    for (mistake, number) in MISTAKES.iter().zip(1..) {
        match program.verdicts(number) {
            Ok(verdicts) if verdicts.iter().any(|verdict| verdict == "caught") => {}
            Ok(_) => survivors.push((mistake.file, mistake.place, mistake.wrong)),
            Err(errors) => failures.push((mistake.file, mistake.place, errors)),
        }
    }
    assert!(
        survivors.is_empty() && failures.is_empty(),
        "not caught: {survivors:#?}, failed: {failures:#?}"
    );
    assert!(MISTAKES.len() >= 20);
}
