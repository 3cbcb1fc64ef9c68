//! Small waves on a shear layer of vortex blobs, which grow as Rayleigh (1880) says: with √(d² + δ²) = s as
//! the distance of the edges of the layer, at the rate √(e^{−2ks} − (e^{−kδ} − k(s − δ))²)/2d.

use dvi_core::fast_sum::FastSum;

use super::shear_layer::{H, TOLERANCE, method};
use crate::vocabulary::*;

/// ln(a(2)/a(1)), where a is the amplitude of small waves on the edges of the layer, in its middle, over the
/// rate of linear theory.
pub fn waves(rows: usize) -> Result<Claim> {
    // Two runs that begin with opposite waves have everything else in common.
    let [up, down] = each([1e-4, -1e-4], |amplitude| {
        let layer = ShearLayer { rows, amplitude };
        let (system, start) = (layer.system(), layer.state());
        let fast = FastSum::<_, 2>::new(&system, TOLERANCE)?;
        let mut run = Integrator::new(&fast, method(), H, start)?;
        each([5, 5], |steps| {
            run.take_steps(steps)?;
            Ok(run.state())
        })
    })?;
    let amplitude = |time: usize| {
        let (up, down): (&VortexBlobsState, &VortexBlobsState) = (&up[time], &down[time]);
        let edge = |row: usize| {
            let blobs = (row..up.x.len()).step_by(rows).filter(|&blob| up.x[blob].abs() < 1.0);
            let parts = blobs.fold([0.0; 2], |[sine, cosine], blob| {
                let ((sin, cos), apart) = ((TAU * up.x[blob]).sin_cos(), up.y[blob] - down.y[blob]);
                [sine + sin * apart, cosine + cos * apart]
            });
            parts[0].hypot(parts[1])
        };
        edge(0) + edge(rows - 1)
    };
    let [k, d, core] = [TAU, ShearLayer::THICKNESS, ShearLayer::CORE];
    let s = d.hypot(core);
    let expected = ((-2.0 * k * s).exp() - ((-k * core).exp() - k * (s - core)).powi(2)).sqrt() / (2.0 * d);
    let rate = (amplitude(1) / amplitude(0)).ln() / expected;
    let claim = beyond("small waves on the layer grow as Rayleigh says");
    Ok(claim.near("rate from t = 1 to 2 / that of linear theory", rate, [1.0, 0.05]))
}
