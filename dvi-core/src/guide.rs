//! Pages to read in order: from a Lagrangian on paper to a run that can be trusted.
//!
//! | page | what it answers |
//! |---|---|
//! | [Your first system](first_system) | How do I declare a system, run it, and write a table? |
//! | [Recipes](recipes) | States at given times, events, sections, sweeps, fits, checkpoints: how do I …? |
//! | [Choosing a method](choosing_a_method) | Which method do I begin with, and when do I take another? |
//! | [Reading the report](reading_the_report) | What did the compiler see, and what follows from it? |
//! | [What can go wrong](what_can_go_wrong) | What do the errors mean, and what does no error show? |
//!
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
