//! A layer of vortex blobs between two flows, which rolls up: 10⁵ bodies that all act on each other, by a
//! fast sum.
//!
//! Waves on a layer of thickness d between flows whose velocities differ by 1 grow and roll up (Rayleigh
//! 1880; with blobs, Krasny 1986). The potential of a blob of radius δ is that of a vortex a distance δ off
//! the plane. Vortex blobs have an energy and a two-form, impulses and an angular impulse. Gauss collocation
//! preserves the two-form, and the impulses with it: they are quadratic. The fast sum is the energy of a
//! system close by, and jumps by some part of its tolerance where a body goes from one cube to the next. To
//! iterate the stages of a step further than that makes no sense, and does not end.

use crate::vocabulary::*;

/// Of the forces, and of the stages of a step.
const TOLERANCE: f64 = 1e-6;
const H: f64 = 0.2;
/// Steps up to the times that the figure shows.
const SHOWN: [u64; 3] = [10, 20, 40];
const AMPLITUDE: f64 = 0.01;
/// Bodies whose forces are compared with sums over all others.
const COMPARED: usize = 200;

struct RollUp {
    layer: ShearLayer,
    snapshots: Vec<VortexBlobsState>,
    /// Relative changes of H, ΣΓx and ΣΓy over the sum of |Γ| times the length, and of ΣΓ|z|².
    kept: [Envelope; 3],
    /// Evaluations of the gradient in a step, and the error of the forces at the start and at the end.
    evaluations: f64,
    errors: [f64; 2],
}

/// A number of blobs, and what an evaluation takes, in pairs of bodies and in products between groups.
type Operations = (u64, u64, u64);

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    job.expect(SHOWN[2]);
    let rolled = RollUp::new(job, job.choose(40, 5))?;
    let rows: &[usize] = job.choose(&[10, 20, 40, 80], &[5, 10]);
    let operations = rows.iter().map(|&rows| operations(rows)).collect::<Result<Vec<_>>>()?;
    let kept = ["ΔH/H", "ΔΣΓz", "ΔΣΓ|z|²"].into_iter().zip(&rolled.kept);
    let kept = kept.flat_map(|(name, kept)| kept.magnitude().into_iter().map(move |row| ([name], row)));
    let counts = operations.iter().flat_map(|&(blobs, pairs, products)| {
        [("pairs", pairs), ("products", products)].map(|(name, n)| ([name], [blobs as f64, n as f64]))
    });
    job.publish(figure(&rolled, &operations), Table::of("quantity,t_or_blobs,value", kept.chain(counts)))?;
    let [energy, impulse, angular] = rolled.kept.each_ref().map(|kept| kept.largest);
    let [at_start, at_end] = rolled.errors;
    let total = |&(blobs, pairs, products): &Operations| (blobs as f64, (pairs + products) as f64);
    let totals: Vec<_> = operations.iter().map(total).collect();
    let saving = totals.get(2).map(|(blobs, total)| blobs * (blobs - 1.0) / total);
    let saved = "100 000 blobs: ordered pairs of all / pairs and products of an evaluation";
    let power = job.only_full(order(totals.into_iter().skip(1)));
    claims([
        waves(job.choose(10, 6))?,
        beyond("while the layer rolls up, energy and impulses are kept to the tolerance of the sum")
            .at_most("largest |ΔH|/H", energy, TOLERANCE)
            .at_most("largest change of ΣΓz / ΣΓ times the length", impulse, TOLERANCE)
            .at_most("largest relative change of ΣΓ|z|²", angular, TOLERANCE),
        beyond("the forces on all blobs are those of the sum over all pairs, to the tolerance")
            .at_most("relative error at the start", at_start, TOLERANCE)
            .at_most("relative error at the end", at_end, TOLERANCE),
        beyond("from 25 000 to 400 000 blobs, what an evaluation takes grows like their number")
            .near("power of the number of blobs", power, [1.0, 0.1])
            .at_least(saved, job.only_full(saving), 30.0)
            .at_most("evaluations in a step", job.only_full(rolled.evaluations), 25.0),
    ])
}

fn method() -> Gauss<3> {
    Gauss { stopping: Stopping { tolerance: TOLERANCE / 10.0, ..Stopping::default() }, ..Gauss::new() }
}

impl RollUp {
    fn new(job: &Job<'_>, rows: usize) -> Result<Self> {
        let layer = ShearLayer { rows, amplitude: AMPLITUDE };
        let system = layer.system();
        let fast = FastSum::new(&system, TOLERANCE)?;
        let at_start = fast.measured_error(&layer.state(), COMPARED)?;
        let mut run = Integrator::new(&fast, method(), H, layer.state())?;
        let (energy, before, mut snapshots) = (run.energy(), momenta(&run), vec![]);
        let end = SHOWN[2] as f64 * H;
        let mut kept = Span { end, early: end, intervals: SHOWN[2] as usize }.envelopes();
        for step in 1..=SHOWN[2] {
            run.advance()?;
            job.proceed(1);
            let [x, y, angular]: [f64; 3] = difference(momenta(&run), before).map(f64::abs);
            let impulse = larger(x, y) / ShearLayer::LENGTH.powi(2);
            note(&mut kept, run.time(), [run.energy() / energy - 1.0, impulse, angular / before[2]]);
            if SHOWN.contains(&step) {
                snapshots.push(run.state());
            }
        }
        let evaluations = run.statistics().gradients as f64 / run.steps() as f64;
        let errors = [at_start, fast.measured_error(&run.state(), COMPARED)?];
        Ok(Self { layer, snapshots, kept, evaluations, errors })
    }
}

/// What an evaluation takes at the start, for a layer of so many rows.
fn operations(rows: usize) -> Result<Operations> {
    let layer = ShearLayer { rows, amplitude: AMPLITUDE };
    let system = layer.system();
    let operations = FastSum::<_, 2>::new(&system, TOLERANCE)?.operations(&layer.state())?;
    Ok((layer.blobs() as u64, operations.pairs, operations.products))
}

/// Small waves grow as Rayleigh (1880) says: with √(d² + δ²) = s as the distance of the edges of the layer,
/// at the rate √(e^{−2ks} − (e^{−kδ} − k(s − δ))²)/2d. Their amplitude is that on the edges, in the middle
/// of the layer.
fn waves(rows: usize) -> Result<Claim> {
    // Two runs that begin with opposite waves have everything else in common.
    let [up, down] = each([1e-4, -1e-4], |amplitude| {
        let layer = ShearLayer { rows, amplitude };
        let system = layer.system();
        let fast = FastSum::<_, 2>::new(&system, TOLERANCE)?;
        let mut run = Integrator::new(&fast, method(), H, layer.state())?;
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

fn figure(rolled: &RollUp, operations: &[Operations]) -> Figure {
    let n = rolled.layer.blobs();
    let shown = rolled.snapshots.iter().zip(SHOWN).zip([1.0, 1.7, 1.0]);
    let mut panels: Vec<Panel> =
        shown.map(|((state, steps), weight)| snapshot(rolled.layer, state, steps).weight(weight)).collect();
    let late = panels.split_off(panels.len().min(1));
    let named = [("*H*", BLUE), ("ΣΓ*z*", GREEN), ("ΣΓ|*z*|²", VERMILLION)].into_iter().zip(&rolled.kept);
    let lines = named.map(|((name, colour), kept)| (name, solid(colour), kept.magnitude()));
    let time = Axis::time(SHOWN[2] as f64 * H);
    let kept = Panel::new("What is kept", time, Axis::logarithmic("relative change")).lines(lines);
    let per_blob = |of: fn(&Operations) -> u64| -> Vec<[f64; 2]> {
        operations.iter().map(|counts| [counts.0 as f64, of(counts) as f64 / counts.0 as f64]).collect()
    };
    let costs = [
        ("all pairs", solid(SLATE), per_blob(|(blobs, ..)| blobs * (blobs - 1))),
        ("pairs nearby", solid(BLUE), per_blob(|(_, pairs, _)| *pairs)),
        ("products of groups", solid(VERMILLION), per_blob(|(.., products)| *products)),
    ];
    let axes = (Axis::logarithmic("number of blobs"), Axis::logarithmic("for each blob"));
    let costs = Panel::new("What an evaluation takes for each blob", axes.0, axes.1).marked(costs);
    let (thousands, rest, tolerance) = (n / 1000, n % 1000, scientific(TOLERANCE));
    Figure::of(format!(
        "{thousands} {rest:03} blobs; Gauss collocation of order 6, *h* = {H}, with a fast sum of tolerance \
         {tolerance}"
    ))
    .row(370.0, panels)
    .row(560.0, late)
    .row(330.0, vec![kept.legend_at(Corner::Beside), costs.legend_at(Corner::Beside)])
    .sequence_key("from below", "from above")
}

fn snapshot(layer: ShearLayer, state: &VortexBlobsState, steps: u64) -> Panel {
    let rows = layer.rows;
    let radius = if rows > 20 { 0.3 } else { 1.0 };
    let plane = Panel::plane(format!("*t* = {}", steps as f64 * H), "*x*", "*y*");
    plane.each(SEQUENCE.into_iter().enumerate(), |plane, (number, colour)| {
        let blobs = points(&state.x, &state.y).into_iter().enumerate();
        let of_colour = blobs.filter(|(blob, _)| blob % rows * SEQUENCE.len() / rows == number);
        plane.dots(of_colour.map(|(_, blob)| blob).collect(), radius, colour)
    })
}
