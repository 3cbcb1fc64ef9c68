//! A hash by which what has been written is known again.

use core::fmt::{self, Write};

use crate::Real;
use crate::scalar::carries_derivatives;
use crate::scalar::norm::reported;

/// A hash of 64 bits, FNV-1a of texts: it tells mistakes apart, not attacks. Words are taken as a whole and
/// not byte by byte, because no other thread of an ensemble is at work while all initial states are read.
pub(crate) struct Fingerprint(u64);

impl Fingerprint {
    pub(crate) const fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    pub(crate) fn bytes(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    pub(crate) fn word(&mut self, word: u64) {
        let product = (self.0 ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        // A product carries to higher digits only.
        self.0 = product ^ (product >> 32);
    }

    /// A number with all that it carries.
    pub(crate) fn real<T: Real>(&mut self, x: T) {
        self.word(reported(x).to_bits());
        if carries_derivatives::<T>() {
            // Nothing here can fail, and there is no other way to them.
            let _ = write!(self, "{x:?}");
        }
    }

    pub(crate) fn value(&self) -> u64 {
        self.0
    }
}

#[cfg(feature = "ensembles")]
impl Fingerprint {
    pub(crate) fn text(&mut self, text: &str) {
        self.bytes(text.as_bytes());
        // No text has this byte, so that two of them are told from one.
        self.bytes(&[0xff]);
    }

    /// A number; which of those that are none an operation yields differs from instruction to instruction.
    pub(crate) fn number(&mut self, x: f64) {
        self.word(if x.is_nan() { f64::NAN } else { x }.to_bits());
    }
}

#[cfg(feature = "ensembles")]
impl fmt::Display for Fingerprint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}

impl Write for Fingerprint {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.bytes(text.as_bytes());
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use num_dual::Dual64;

    use super::Fingerprint;
    use crate::Real;

    fn of<T: Real>(numbers: &[T]) -> u64 {
        let mut fingerprint = Fingerprint::new();
        numbers.iter().for_each(|&number| fingerprint.real(number));
        fingerprint.value()
    }

    #[test]
    fn every_bit_counts() {
        for bit in 0..64 {
            let other = f64::from_bits(1.0_f64.to_bits() ^ 1 << bit);
            assert_ne!(of(&[1.0, other]), of(&[1.0, 1.0]), "{other:e}");
            assert_ne!(of(&[other, 1.0]), of(&[1.0, 1.0]), "{other:e}");
        }
        assert_ne!(of(&[0.0]), of(&[-0.0]));
        assert_ne!(of(&[1.0, 2.0]), of(&[2.0, 1.0]));
    }

    #[test]
    fn derivatives_count() {
        let dual = |derivative: f64| Dual64::new(1.0, derivative);
        assert_ne!(of(&[dual(0.1)]), of(&[dual(0.1_f64.next_up())]));
        assert_eq!(of(&[dual(0.1)]), of(&[dual(0.1)]));
    }
}
