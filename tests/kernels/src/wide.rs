//! What release builds compute by the widest instructions of the processor, and others by those of every
//! processor.

mod gradients;
mod steps;

/// The bits of gradients, forces and states.
///
/// # Panics
/// If something is not computed in the way that is meant, or not at all.
pub fn bits() -> Vec<u64> {
    let mut numbers = Vec::new();
    gradients::add_to(&mut numbers);
    steps::add_to(&mut numbers);
    numbers.into_iter().map(f64::to_bits).collect()
}
