//! The line of the benchmark that a test reads.

/// What stands before the bits of the [wide](dvi_kernels::wide) gradients.
pub(crate) const WIDE: &str = "bits of gradients with the widest instructions: ";

/// The bits of numbers, as they are printed.
pub(crate) fn text_of(bits: &[u64]) -> String {
    bits.iter().map(|bits| format!("{bits:016x}")).collect()
}
