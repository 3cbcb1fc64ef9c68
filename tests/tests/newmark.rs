//! What is refused by Newmark's method.

use dvi_core::prelude::*;
use dvi_tests::zoo::regular::*;

#[test]
fn a_beta_out_of_range_is_refused() {
    for beta in [-0.1, 0.6, f64::NAN] {
        let failure = Integrator::new(&KEPLER, Newmark::new(beta), 0.1, pericentre(0.3)).err();
        assert!(matches!(failure, Some(StartError::Parameter { name: "beta", .. })), "{failure:?}");
    }
}
