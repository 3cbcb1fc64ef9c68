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

use dvi_core::fast_sum::FastSum;

use crate::models::{ShearLayer, VortexBlobsState};
use crate::vocabulary::*;

/// Of the forces, and of the stages of a step.
const TOLERANCE: f64 = 1e-6;
const H: f64 = 0.2;
/// Steps up to the times that the figure shows.
const SHOWN: [u64; 3] = [10, 20, 40];
const AMPLITUDE: f64 = 0.01;
/// Bodies whose forces are compared with sums over all others.
const COMPARED: usize = 200;

/// What was measured while the layer rolls up.
struct RollUp {
    layer: ShearLayer,
    /// Places of the blobs at the times that the figure shows.
    snapshots: Vec<VortexBlobsState>,
    /// Relative changes of H, ΣΓx and ΣΓy over the sum of |Γ| times the length, and the relative change of
    /// ΣΓ|z|².
    kept: [Deviation; 3],
    /// Evaluations of the gradient in a step.
    evaluations: f64,
    /// The error of the forces at the start and at the end.
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
    let kept =
        kept.flat_map(|(name, kept)| kept.envelope.magnitude().into_iter().map(move |row| ([name], row)));
    let counts = operations.iter().flat_map(|&(blobs, pairs, products)| {
        [("pairs", pairs), ("products", products)]
            .map(|(name, value)| ([name], [blobs as f64, value as f64]))
    });
    let table = Table::of(&["quantity", "t_or_blobs", "value"], kept.chain(counts))?;
    job.publish(figure(&rolled, &operations), table)?;
    let [energy, impulse, angular] = rolled.kept.each_ref().map(|kept| kept.largest);
    let [at_start, at_end] = rolled.errors;
    Ok(vec![
        waves(job.choose(10, 6))?,
        beyond("while the layer rolls up, energy and impulses are kept to the tolerance of the sum")
            .at_most("largest |ΔH|/H", energy, TOLERANCE)
            .at_most("largest change of ΣΓz / ΣΓ times the length", impulse, TOLERANCE)
            .at_most("largest relative change of ΣΓ|z|²", angular, TOLERANCE),
        beyond("the forces on all blobs are those of the sum over all pairs, to the tolerance")
            .at_most("relative error at the start", at_start, TOLERANCE)
            .at_most("relative error at the end", at_end, TOLERANCE),
        cost(job, &operations, rolled.evaluations),
    ]
    .into())
}

fn method() -> Gauss<3> {
    Gauss { stopping: Stopping { tolerance: TOLERANCE / 10.0, ..Stopping::default() }, ..Gauss::new() }
}

/// ΣΓx, ΣΓy and ΣΓ|z|².
fn impulses(run: &impl Run<Scalar = f64>) -> [f64; 3] {
    let mut values = run.momenta().map(|(_, value)| value);
    std::array::from_fn(|_| values.next().unwrap_or(f64::NAN))
}

impl RollUp {
    fn new(job: &Job<'_>, rows: usize) -> Result<Self> {
        let layer = ShearLayer { rows, amplitude: AMPLITUDE };
        let (system, start) = (layer.system(), layer.state());
        let fast = FastSum::new(&system, TOLERANCE)?;
        let at_start = fast.measured_error(&start, COMPARED)?;
        let mut run = Integrator::new(&fast, method(), H, start)?;
        let (energy, momenta, mut snapshots) = (run.energy(), impulses(&run), vec![]);
        let end = SHOWN[2] as f64 * H;
        let mut kept = Span { end, early: end, intervals: SHOWN[2] as usize }.deviations();
        for step in 1..=SHOWN[2] {
            if job.is_stopping() {
                job.cut_short();
                break;
            }
            run.advance()?;
            job.proceed(1);
            let now = impulses(&run);
            let [x, y, angular]: [f64; 3] = std::array::from_fn(|i| (now[i] - momenta[i]).abs());
            let impulse = larger(x, y) / ShearLayer::LENGTH.powi(2);
            note(&mut kept, run.time(), [run.energy() / energy - 1.0, impulse, angular / momenta[2]]);
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

/// ln(a(2)/a(1)), where a is the amplitude of small waves on the edges of the layer, in its middle, over the
/// rate of linear theory.
fn waves(rows: usize) -> Result<Claim> {
    const SMALL: f64 = 1e-4;
    // Two runs that begin with opposite waves have everything else in common.
    let [up, down] = each([SMALL, -SMALL], |amplitude| {
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
    let rate = (amplitude(1) / amplitude(0)).ln();
    Ok(beyond("small waves on the layer grow as Rayleigh says").near(
        "rate from t = 1 to 2 / that of linear theory",
        rate / expected,
        [1.0, 0.05],
    ))
}

fn cost(job: &Job<'_>, operations: &[Operations], evaluations: f64) -> Claim {
    let counts =
        operations.iter().map(|&(blobs, pairs, products)| (blobs as f64, (pairs + products) as f64));
    let saving = operations
        .get(2)
        .map(|&(blobs, pairs, products)| (blobs * (blobs - 1)) as f64 / (pairs + products) as f64);
    let saved = "100 000 blobs: ordered pairs of all / pairs and products of an evaluation";
    beyond("from 25 000 to 400 000 blobs, what an evaluation takes grows like their number")
        .near("power of the number of blobs", job.only_full(order(counts.skip(1))), [1.0, 0.1])
        .at_least(saved, job.only_full(saving), 30.0)
        .at_most("evaluations in a step", job.only_full(evaluations), 25.0)
}

fn figure(rolled: &RollUp, operations: &[Operations]) -> Figure {
    let n = rolled.layer.blobs();
    let mut snapshots = rolled.snapshots.iter().zip(SHOWN).zip([1.0, 1.7, 1.0]);
    let mut next = || {
        snapshots.next().map(|((state, steps), weight)| snapshot(rolled.layer, state, steps).weight(weight))
    };
    let early: Vec<Panel> = next().into_iter().collect();
    let late: Vec<Panel> = [next(), next()].into_iter().flatten().collect();
    let shown = [(370.0, early), (560.0, late)].into_iter().filter(|(_, panels)| !panels.is_empty());
    let figure = Figure::new(
        format!("A shear layer of {} {:03} vortex blobs rolls up", n / 1000, n % 1000),
        format!(
            "Gauss collocation of order 6, *h* = {H}, with a fast sum of tolerance {}",
            scientific(TOLERANCE)
        ),
    )
    .sequence_key("from below", "from above");
    let [energy, impulse, angular] = rolled.kept.each_ref().map(|kept| kept.envelope.magnitude());
    let time = Axis::time(SHOWN[2] as f64 * H);
    let kept = Panel::new("What is kept", time, Axis::logarithmic("relative change")).lines([
        ("*H*", Stroke::solid(BLUE), energy),
        ("ΣΓ*z*", Stroke::solid(GREEN), impulse),
        ("ΣΓ|*z*|²", Stroke::solid(VERMILLION), angular),
    ]);
    let [at_start, at_end] = rolled.errors.map(scientific);
    shown
        .fold(figure, |figure, (height, panels)| figure.row(height, panels))
        .row(330.0, vec![kept.legend_at(Corner::Beside), costs(operations)])
        .footer(format!(
            "Velocities differ by 1 across the layer, the waves on it have the length 1. Relative error of \
             the forces: {at_start} at the start, {at_end} at the end."
        ))
}

/// The blobs, in the colours of their rows.
fn snapshot(layer: ShearLayer, state: &VortexBlobsState, steps: u64) -> Panel {
    let rows = layer.rows;
    let radius = if rows > 20 { 0.3 } else { 1.0 };
    let plane = Panel::plane(format!("*t* = {}", steps as f64 * H), "*x*", "*y*");
    plane.each(SEQUENCE.into_iter().enumerate(), |plane, (number, colour)| {
        let blobs = state.x.iter().zip(&state.y).enumerate();
        let of_colour = blobs.filter(|(blob, _)| blob % rows * SEQUENCE.len() / rows == number);
        plane.dots(of_colour.map(|(_, (x, y))| [*x, *y]).collect(), radius, colour)
    })
}

fn costs(operations: &[Operations]) -> Panel {
    let per_blob = |of: fn(&Operations) -> u64| -> Vec<[f64; 2]> {
        operations.iter().map(|counts| [counts.0 as f64, of(counts) as f64 / counts.0 as f64]).collect()
    };
    let of_groups = [
        ("pairs nearby", per_blob(|(_, pairs, _)| *pairs), BLUE),
        ("products of groups", per_blob(|(.., products)| *products), VERMILLION),
    ];
    let axes = (Axis::logarithmic("number of blobs"), Axis::logarithmic("for each blob"));
    Panel::new("What an evaluation takes for each blob", axes.0, axes.1)
        .line(per_blob(|(blobs, ..)| blobs * (blobs - 1)), Stroke::solid(SLATE))
        .labelled("all pairs")
        .each(of_groups, |panel, (name, points, colour)| {
            let line = panel.line(points.clone(), Stroke::solid(colour)).labelled(name);
            line.discs(points, colour, Fill::Solid)
        })
        .legend_at(Corner::Beside)
}
