//! The compiler at work on systems that are wrong, and itself wrong at work on systems that are right.

mod injected_mistakes;
mod messages;
