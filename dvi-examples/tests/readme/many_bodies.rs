//! Many bodies.

use crate::assert_said;
use crate::numbers::at_most;
use crate::table::{rows, value};

#[test]
fn a_layer_of_many_blobs_does_what_is_said() {
    let rows = rows();
    let layer = |quantity: &str| value(&rows, "shear-layer", quantity);
    assert_said(&[
        format!(
            "Small waves on it grow at {:.2} times the rate of linear theory, from t = 1 to 2.",
            layer("rate from t = 1 to 2 / that of linear theory")
        ),
        format!(
            "The energy changes by at most {} of itself, the impulse by {} of the circulation times the length, and the angular impulse by \
             {} of itself.",
            at_most(layer("largest |ΔH|/H")),
            at_most(layer("largest change of ΣΓz / ΣΓ times the length")),
            at_most(layer("largest relative change of ΣΓ|z|²"))
        ),
        format!(
            "At the end the forces are those of the sum over all pairs up to {} of themselves.",
            at_most(layer("relative error at the end"))
        ),
        format!(
            "An evaluation takes {:.0} times fewer pairs and products than there are ordered pairs, and from 25 000 to 400 000 blobs \
             their number grows with the power {:.2} of that of the blobs. A step takes {:.1} evaluations.",
            layer("100 000 blobs: ordered pairs of all / pairs and products of an evaluation"),
            layer("power of the number of blobs"),
            layer("evaluations in a step")
        ),
    ]);
}
