//! What is on the page of the gallery.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use crate::MOTIONS;
use crate::browser::told;

/// The page has each experiment and each claim with its verdict; in a browser, the checks of `check.js`.
pub(crate) fn has_all(
    folder: &Path,
    experiments: &BTreeSet<&str>,
    verdicts: &BTreeMap<[String; 3], String>,
) {
    let page = fs::read_to_string(folder.join("index.html")).expect("readable");
    assert!(page.len() < 8_000_000, "{} bytes", page.len());
    for loaded in ["src=\"http", "href=\"http", "src='http", "url(http", "@import", "{{"] {
        assert!(!page.contains(loaded), "{loaded}");
    }
    for &name in experiments {
        let card = page.split("<article ").find(|card| card.starts_with(&format!("id=\"{name}\"")));
        let card = card.and_then(|card| card.split("</article>").next()).unwrap_or_default();
        let expected = verdicts.iter().filter(|(claim, _)| claim[0] == name);
        let expected = expected.filter_map(|(_, verdict)| verdict.split(':').next());
        let found = card.split("<li data-verdict=\"").skip(1).filter_map(|claim| claim.split('"').next());
        assert_eq!(sorted(found), sorted(expected), "{name}");
        let has = |extension| card.contains(&format!("href=\"{name}.{extension}\""));
        assert!(has("csv") && has("svg") && has("html") == MOTIONS.contains(&name), "{name}");
    }
    for (width, theme) in [(1200, 0), (400, 1)] {
        let file = folder.with_file_name(format!("index-{width}.html"));
        let Some(found) = told(&page, include_str!("check.js"), &file, width, theme).expect("it is shown")
        else {
            return;
        };
        assert!(found.contains("ok 6 motions"), "{found}");
    }
}

fn sorted<'a>(words: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let mut words: Vec<&str> = words.collect();
    words.sort_unstable();
    words
}
