//! A layer of vortex blobs between two flows, which rolls up: 10⁵ bodies that all act on each other, by a
//! fast sum.
//!
//! Waves on a layer of thickness d between flows whose velocities differ by 1 grow and roll up (Rayleigh
//! 1880; with blobs, Krasny 1986). The potential of a blob of radius δ is that of a vortex a distance δ off
//! the plane. So the rate of growth is Rayleigh's, with s = √(d² + δ²) as the distance of the edges of the
//! layer: √(e^{−2ks} − (e^{−kδ} − k(s − δ))²)/2d. Vortex blobs have an energy and a two-form, impulses and
//! an angular impulse. Gauss collocation preserves the two-form, and the impulses with it: they are
//! quadratic. The fast sum is the energy of a system close by, and jumps by some part of its tolerance where
//! a body goes from one cube to the next. To iterate the stages of a step further than that makes no sense,
//! and does not end.

mod claims;
mod picture;

use std::f64::consts::TAU;

use anyhow::Result;
use dvi_core::fast_sum::FastSum;
use dvi_core::prelude::*;

use crate::claim::larger;
use crate::deviation::Deviation;
use crate::gallery::{Experiment, Outcome};
use crate::job::Job;
use crate::models::{ShearLayer, VortexBlobsState};

pub const EXPERIMENT: Experiment = Experiment {
    name: "shear-layer",
    title: "A shear layer of vortex blobs that rolls up",
    share: 150.0,
    run,
};

/// Of the forces, and of the stages of a step.
const TOLERANCE: f64 = 1e-6;
const H: f64 = 0.2;
/// Steps up to the times that the figure shows.
const SHOWN: [u64; 3] = [10, 20, 40];
const AMPLITUDE: f64 = 0.01;
/// Bodies whose forces are compared with sums over all others.
const COMPARED: usize = 200;

/// What was measured.
struct Measured {
    layer: ShearLayer,
    /// Places of the blobs at the times that the figure shows.
    snapshots: Vec<VortexBlobsState>,
    /// Relative changes of H, ΣΓx and ΣΓy over the sum of |Γ| times the length, and the relative change of
    /// ΣΓ|z|².
    energy: Deviation,
    impulse: Deviation,
    angular: Deviation,
    /// Evaluations of the gradient in a step.
    evaluations: f64,
    /// The error of the forces at the start and at the end.
    errors: [f64; 2],
    /// For each number of blobs: what an evaluation takes, in pairs of bodies and in products between
    /// groups.
    operations: Vec<(u64, u64, u64)>,
    /// The rate at which small waves grow.
    rate: f64,
}

fn run(job: &Job<'_>) -> Result<Outcome> {
    let rows = job.choose(40, 5);
    job.expect(SHOWN[2]);
    let measured = Measured {
        operations: operations(job.choose(&[10, 20, 40, 80], &[5, 10]))?,
        rate: rate(job.choose(10, 6))?,
        ..roll_up(job, rows)?
    };
    job.publish(EXPERIMENT.name, picture::figure(&measured), picture::table(&measured)?)?;
    Ok(Outcome { claims: claims::claims(job, &measured), references: vec![], notes: vec![] })
}

fn method() -> Gauss<3> {
    Gauss { stopping: Stopping { tolerance: TOLERANCE / 10.0, ..Stopping::default() }, ..Gauss::new() }
}

fn roll_up(job: &Job<'_>, rows: usize) -> Result<Measured> {
    let layer = ShearLayer { rows, amplitude: AMPLITUDE };
    let (system, start) = (layer.system(), layer.state());
    let fast = FastSum::new(&system, TOLERANCE)?;
    let first_error = fast.measured_error(&start, COMPARED)?;
    let mut run = Integrator::new(&fast, method(), H, start)?;
    let energy = run.energy();
    let momenta = impulses(&run);
    let end = SHOWN[2] as f64 * H;
    let empty = || Deviation::new(end, SHOWN[2] as usize, end);
    let mut measured = Measured {
        layer,
        snapshots: vec![],
        energy: empty(),
        impulse: empty(),
        angular: empty(),
        evaluations: 0.0,
        errors: [first_error, f64::NAN],
        operations: vec![],
        rate: f64::NAN,
    };
    for step in 1..=SHOWN[2] {
        if job.is_stopping() {
            job.cut_short();
            break;
        }
        run.advance()?;
        job.proceed(1);
        let now = impulses(&run);
        let [x, y, angular]: [f64; 3] = std::array::from_fn(|i| (now[i] - momenta[i]).abs());
        measured.energy.push(run.time(), run.energy() / energy - 1.0);
        measured.impulse.push(run.time(), larger(x, y) / ShearLayer::LENGTH.powi(2));
        measured.angular.push(run.time(), angular / momenta[2]);
        if SHOWN.contains(&step) {
            measured.snapshots.push(run.state());
        }
    }
    measured.evaluations = run.statistics().gradients as f64 / run.steps() as f64;
    measured.errors[1] = fast.measured_error(&run.state(), COMPARED)?;
    Ok(measured)
}

/// ΣΓx, ΣΓy and ΣΓ|z|².
fn impulses(run: &impl Run<Scalar = f64>) -> [f64; 3] {
    let mut values = run.momenta().map(|(_, value)| value);
    std::array::from_fn(|_| values.next().unwrap_or(f64::NAN))
}

/// What an evaluation takes at the start, for layers of so many rows.
fn operations(rows: &[usize]) -> Result<Vec<(u64, u64, u64)>> {
    let count = |&rows: &usize| {
        let layer = ShearLayer { rows, amplitude: AMPLITUDE };
        let system = layer.system();
        let operations = FastSum::<_, 2>::new(&system, TOLERANCE)?.operations(&layer.state())?;
        Ok((layer.blobs() as u64, operations.pairs, operations.products))
    };
    rows.iter().map(count).collect()
}

/// ln(a(2)/a(1)), where a is the amplitude of small waves on the edges of the layer, in its middle.
fn rate(rows: usize) -> Result<f64> {
    const SMALL: f64 = 1e-4;
    let states = |amplitude: f64| -> Result<[VortexBlobsState; 2]> {
        let layer = ShearLayer { rows, amplitude };
        let (system, start) = (layer.system(), layer.state());
        let fast = FastSum::<_, 2>::new(&system, TOLERANCE)?;
        let mut run = Integrator::new(&fast, method(), H, start)?;
        let mut after = |steps| -> Result<VortexBlobsState> {
            run.take_steps(steps)?;
            Ok(run.state())
        };
        Ok([after(5)?, after(5)?])
    };
    // Two runs that begin with opposite waves have everything else in common.
    let [up, down] = [states(SMALL)?, states(-SMALL)?];
    let amplitude = |time: usize| {
        let (up, down) = (&up[time], &down[time]);
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
    Ok((amplitude(1) / amplitude(0)).ln())
}
