//! Constraints: what the attribute makes of them.

mod declarations;
mod systems;

use dvi_tests::Outcome;
