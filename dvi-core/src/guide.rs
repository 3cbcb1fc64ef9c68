//! Pages to read in order: from a Lagrangian on paper to a run that can be trusted.
//! The modules hold no code.

#[doc = include_str!("../docs/first-system.md")]
pub mod first_system {}

#[doc = include_str!("../docs/recipes.md")]
pub mod recipes {}

#[doc = include_str!("../docs/choosing-a-method.md")]
pub mod choosing_a_method {}

#[doc = include_str!("../docs/reading-the-report.md")]
pub mod reading_the_report {}

#[doc = include_str!("../docs/what-can-go-wrong.md")]
pub mod what_can_go_wrong {}
