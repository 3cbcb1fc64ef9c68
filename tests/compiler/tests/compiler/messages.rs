//! What the macro says about mistakes.
//!
//! Each case in `ui/` makes one mistake and then uses the system, to show that one mistake gives one
//! error, on the token at fault, and nothing that follows from it.

#[test]
fn mistakes() {
    trybuild::TestCases::new().compile_fail("ui/*.rs");
}

/// The page of what the language does not say quotes what it says instead.
#[test]
fn what_is_not_said_has_the_messages_of_its_page() -> Result<(), Box<dyn std::error::Error>> {
    let messages = std::fs::read_to_string("ui/unsaid.stderr")?;
    let page = include_str!("../../../../dvi-macros/docs/degenerate_lagrangian.md");
    let (_, section) = page.split_once("# What the language does not say").ok_or("no such section")?;
    let rows = section.lines().filter_map(|line| line.strip_prefix("| ")?.split(" | ").nth(1));
    let quoted: Vec<&str> = rows.filter_map(|cell| cell.strip_prefix('"')?.strip_suffix('"')).collect();
    assert_eq!(quoted.len(), 7);
    for message in quoted {
        assert!(messages.contains(message), "{message}");
    }
    Ok(())
}
