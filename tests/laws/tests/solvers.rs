//! However its equations are solved and its sums are taken, a step is the same: asked where no equations in
//! the table say so.

use dvi_laws::all;
use dvi_laws::equations::{Equations, apart};

use super::{ask, below};

#[test]
fn every_way_takes_the_same_steps() {
    let (cases, mut plain, mut ways) = (all(), None, Vec::new());
    for case in &cases {
        if case.is_plain() {
            plain = Some(case);
        } else if let (Equations::Elsewhere, Some(plain)) = (&case.equations, plain) {
            ways.push([plain, case]);
        }
    }
    ask(&ways, |[plain, other]| {
        let (mut plain, mut other) = (plain.run()?, other.run()?);
        for _ in 0..8 {
            plain.take_steps(5)?;
            other.take_steps(5)?;
            below(apart(&other.values(), &plain.values()), 1e-12, "another step")?;
        }
        Ok(())
    });
}
