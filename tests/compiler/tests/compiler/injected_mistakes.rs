//! The self-check of the macro against mistakes in the macro.
//!
//! Each of these mistakes is written into a copy of the compiler, which is built as a program and expands
//! a few systems. The formulas of the systems are right, so the compiler has to find the mistake itself:
//! an expansion that passes unchanged is none that a user is protected from.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

mod mistakes;
mod systems;

use mistakes::{MISTAKES, Mistake};
use systems::SYSTEMS;

/// The compiler as a program: it expands each system of a file and says what became of it.
const PROGRAM: &str = r#"
fn main() {
    let path = std::env::args().nth(1).expect("a file of systems");
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

/// A copy of the compiler that is changed, built and run.
struct Copy {
    root: PathBuf,
    sources: PathBuf,
}

fn copy_sources(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a folder");
    for entry in fs::read_dir(from).expect("a folder of sources") {
        let entry = entry.expect("an entry");
        let target = to.join(entry.file_name());
        if entry.file_type().expect("a type").is_dir() {
            copy_sources(&entry.path(), &target);
        } else {
            // A file that stays the same is not compiled again.
            let text = fs::read(entry.path()).expect("a source");
            if fs::read(&target).ok().as_ref() != Some(&text) {
                fs::write(target, text).expect("a copy");
            }
        }
    }
}

impl Copy {
    fn new() -> Self {
        let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../dvi-macros");
        let root = Path::new(env!("CARGO_TARGET_TMPDIR")).join("injected-mistakes");
        let copy = Self { root, sources };
        copy.restore();
        copy
    }

    /// The compiler as it is, with a `main` in place of the two attributes.
    fn restore(&self) {
        let source = self.root.join("src");
        copy_sources(&self.sources.join("src"), &source);
        let library = fs::read_to_string(source.join("lib.rs")).expect("lib.rs");
        let mut modules = String::from("#![allow(dead_code, unreachable_pub)]\n");
        let mut is_test = false;
        for line in library.lines() {
            if line.starts_with("mod ") && !is_test {
                modules += line;
                modules.push('\n');
            }
            is_test = line == "#[cfg(test)]";
        }
        fs::write(source.join("main.rs"), modules + PROGRAM).expect("main.rs");
        fs::remove_file(source.join("lib.rs")).expect("lib.rs is replaced");
        let manifest = fs::read_to_string(self.sources.join("Cargo.toml")).expect("a manifest");
        let (_, dependencies) = manifest.split_once("[dependencies]").expect("dependencies");
        let (dependencies, _) = dependencies.split_once("[dev-dependencies]").expect("dev-dependencies");
        let package = "[package]\nname = \"injected\"\nversion = \"0.0.0\"\nedition = \"2024\"\n";
        let manifest =
            format!("{package}\n[dependencies]{dependencies}\n[profile.dev]\ndebug = false\n\n[workspace]\n");
        fs::write(self.root.join("Cargo.toml"), manifest).expect("a manifest");
        fs::copy(self.sources.join("../Cargo.lock"), self.root.join("Cargo.lock")).expect("the lock file");
    }

    fn inject(&self, mistake: &Mistake) {
        let path = self.root.join("src").join(mistake.file);
        let text = fs::read_to_string(&path).expect("a source");
        let found = text.matches(mistake.right).count();
        assert_eq!(found, 1, "`{}` stands {found} times in {}", mistake.right, mistake.file);
        fs::write(path, text.replace(mistake.right, mistake.wrong)).expect("a mistake");
    }

    /// What became of each system.
    fn verdicts(&self, what: &str) -> Vec<String> {
        let systems = self.root.join("systems.txt");
        let lines = SYSTEMS.iter().map(|(kind, attribute, item)| {
            let [attribute, item] =
                [attribute, item].map(|text| text.split_whitespace().collect::<Vec<_>>().join(" "));
            format!("{kind}\t{attribute}\t{item}\n")
        });
        fs::write(&systems, lines.collect::<String>()).expect("the systems");
        let target = Path::new(env!("CARGO_TARGET_TMPDIR")).join("injected-mistakes-target");
        let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".into());
        let output = Command::new(cargo)
            .args(["run", "--quiet", "--offline", "--manifest-path"])
            .arg(self.root.join("Cargo.toml"))
            .arg("--")
            .arg(&systems)
            .env("CARGO_TARGET_DIR", target)
            .env_remove("RUSTFLAGS")
            // One line differs from build to build.
            .env("CARGO_INCREMENTAL", "1")
            .output()
            .expect("cargo runs");
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{what}: {errors}");
        let verdicts = String::from_utf8(output.stdout).expect("text");
        verdicts.lines().map(ToString::to_string).collect()
    }
}

#[test]
fn every_injected_mistake_is_caught() {
    let copy = Copy::new();
    let without = copy.verdicts("the compiler as it is");
    assert_eq!(without, vec!["passed"; SYSTEMS.len()], "the compiler as it is");
    let mut survivors = Vec::new();
    for mistake in MISTAKES {
        copy.restore();
        copy.inject(mistake);
        let verdicts = copy.verdicts(mistake.right);
        if !verdicts.iter().any(|verdict| verdict == "caught") {
            survivors.push((mistake.file, mistake.right));
        }
    }
    assert!(survivors.is_empty(), "not caught: {survivors:#?}");
    assert!(MISTAKES.len() >= 20);
}
