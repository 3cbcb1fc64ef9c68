//! A hash by which files and facts are known again.

use std::fmt;

use super::member::plain;

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

    pub(crate) fn text(&mut self, text: &str) {
        self.bytes(text.as_bytes());
        // No text has this byte, so that two of them are told from one.
        self.bytes(&[0xff]);
    }

    pub(crate) fn number(&mut self, x: f64) {
        let product = (self.0 ^ plain(x).to_bits()).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        // A product carries to higher digits only.
        self.0 = product ^ (product >> 32);
    }

    pub(crate) fn value(&self) -> u64 {
        self.0
    }
}

impl fmt::Display for Fingerprint {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:016x}", self.0)
    }
}
