//! Mistakes of the compiler itself.
//!
//! After the last stage that reports mistakes of the user, nothing is left to go wrong; where the types
//! cannot say so, [`internal`] ends the expansion, and the user reads a compile error with the request
//! to report it. No stage goes on with a value that it made up.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

/// What was found to be wrong.
struct Mistake(String);

/// Ends the expansion, without a message of its own on the terminal.
pub(crate) fn internal(what: impl Into<String>) -> ! {
    resume_unwind(Box::new(Mistake(what.into())))
}

/// The value of `stages`, or what went wrong inside of them.
pub(crate) fn guarded<T>(stages: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(stages)).map_err(|payload| {
        format!(
            "this is a mistake in dvi-macros, not in your formulas ({}); please report it together with this system",
            said(payload.as_ref())
        )
    })
}

fn said(payload: &(dyn Any + Send)) -> String {
    if let Some(Mistake(what)) = payload.downcast_ref() {
        return what.clone();
    }
    let text = payload.downcast_ref::<&str>().map(ToString::to_string);
    text.or_else(|| payload.downcast_ref::<String>().cloned())
        .unwrap_or_else(|| "a panic without words".into())
}
