//! What the macro says about mistakes.
//!
//! Each case in `ui/` makes one mistake and then uses the system, to show that one mistake gives one
//! error, on the token at fault, and nothing that follows from it.

#[test]
fn mistakes() {
    trybuild::TestCases::new().compile_fail("ui/*.rs");
}
