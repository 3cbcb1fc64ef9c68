//! A chain of rigid molecules by RATTLE, and the same molecules with stiff springs in place of the rods.
//!
//! RATTLE keeps momenta and rods to rounding, and the energy has no trend (Andersen 1983; Leimkuhler & Skeel
//! 1994). Steps with springs must be shorter than 2/ω for the fastest vibration of a molecule, ω² = 3k/m,
//! whatever the chain does; with rods the chain sets the length of the steps.

use super::rk4::Accelerations;
use crate::models::{RigidMolecules, RigidMoleculesState, SpringMolecules};
use crate::vocabulary::*;

const MOLECULES: usize = 8;
const BETA: f64 = 4.0;
const SPEED: f64 = 0.4;
const RIGID: RigidMolecules = RigidMolecules { n: MOLECULES, beta: BETA };
/// The molecules with springs, of a stiffness that is large and of one that is larger.
const SOFT: SpringMolecules = SpringMolecules { n: MOLECULES, beta: BETA, k: 1e4 };
const STIFF: SpringMolecules = SpringMolecules { k: 1e5, ..SOFT };
/// The step with rods, and the one with soft springs.
const H: f64 = 0.05;
const H_SPRINGS: f64 = 0.01;
/// The time at which the order is measured, the steps, and that of the reference.
const ORDER_TIME: f64 = 2.0;
const ORDER_STEPS: [f64; 4] = [0.04, 0.02, 0.01, 0.005];
const FINE: f64 = 0.00125;
/// How long the run is that is reversed.
const REVERSED: u64 = 400;
/// The intervals in which errors are drawn and averaged.
const INTERVALS: usize = 250;
/// What the energy error may be, over the energy, and how many steps are tried between one and twice that
/// one.
const BOUND: f64 = 0.01;
const FINENESS: f64 = 8.0;

/// E/E(0) − 1, the largest deviation of the length of a side, the largest velocity along one, and the changes
/// of the momentum in x, that in y and the angular momentum.
type Kept = Series<6>;

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(5000.0, 100.0);
    let scanned = job.choose(50.0, 10.0);
    job.expect(((end / H).round() + (end / H_SPRINGS).round()) as u64);
    let (start, verlet) = (RIGID.chain(SPEED)?, Variational::trapezoid());
    let rods = kept(job, &RIGID, Rattle::default(), start.clone(), H, end)?;
    let springs = kept(job, &SOFT, verlet, start.clone().into(), H_SPRINGS, end)?;
    let rods = Series::new("rods, RATTLE", Stroke::solid(BLUE), rods);
    let springs = Series::new("springs, trapezoid", Stroke::solid(GREEN), springs);
    let scans = [
        Scan::new(job, &RIGID, &Rattle::default(), &start, [0.01, 0.16], scanned)?,
        Scan::new(job, &SOFT, &verlet, &start.clone().into(), [0.005, 0.04], scanned)?,
        Scan::new(job, &STIFF, &verlet, &start.clone().into(), [0.0025, 0.02], scanned)?,
    ];
    let figure = figure([&springs, &rods], &scans, end)?;
    let over_time =
        [(&rods, f64::INFINITY, H), (&springs, SOFT.k, H_SPRINGS)].into_iter().flat_map(|(of, k, h)| {
            let [energy, length] = [0, 1].map(|i: usize| of.kept[i].envelope.magnitude());
            let rows = energy
                .into_iter()
                .zip(length)
                .map(move |([t, energy], [_, length])| [k, h, t, energy, length]);
            rows.map(|row| (["over time"], row.map(Some)))
        });
    let over_step = scans.iter().zip([f64::INFINITY, SOFT.k, STIFF.k]).flat_map(|(Scan(errors), k)| {
        errors.iter().map(move |&[h, error]| (["over step"], [Some(k), Some(h), None, Some(error), None]))
    });
    let columns = ["series", "k", "h", "t", "energy", "length"];
    job.publish(figure, Table::of(&columns, over_time.chain(over_step))?)?;
    let undone = there_and_back(&RIGID, Rattle::default(), H, &start, REVERSED)?;
    Ok(vec![
        momenta_and_rods(&rods),
        trend([&rods, &springs]),
        steps(&scans),
        same(&scans),
        order_of_positions()?,
        beyond(format!("{REVERSED} steps of RATTLE are undone by as many steps of length −{H}")).at_most(
            "largest difference of a coordinate or a velocity from the start",
            undone,
            1e-12,
        ),
    ]
    .into())
}

fn kept<S: Lagrangian>(
    job: &Job<'_>,
    system: &S,
    method: impl Method<S, f64>,
    start: S::State<f64>,
    h: f64,
    end: f64,
) -> Result<[Deviation; 6]> {
    fn momenta<R: Run<Scalar = f64>>(run: &R) -> [f64; 3] {
        std::array::from_fn(|k| run.momentum(k).unwrap_or(f64::NAN))
    }
    let mut run = Integrator::new(system, method, h, start)?;
    let (energy, begin) = (run.energy(), momenta(&run));
    let span = Span { end, early: 0.1 * end, intervals: INTERVALS };
    Ok(job.keep(&mut run, (end / h).round() as u64, span, |run| {
        let state: Vec<f64> = system.values(&run.state()).into_iter().flatten().collect();
        let ([length, along], now) = (sides(&state), momenta(run));
        let [x, y, angular] = [0, 1, 2].map(|k| now[k] - begin[k]);
        [run.energy() / energy - 1.0, length, along, x, y, angular]
    })?)
}

/// The largest error of a side, and the largest velocity along one.
fn sides(state: &[f64]) -> [f64; 2] {
    let (q, v) = state.split_at(state.len() / 2);
    let atoms = 3 * MOLECULES;
    let (mut length, mut along) = (0.0, 0.0);
    for m in 0..MOLECULES {
        for a in 0..3 {
            let (i, j) = (3 * m + a, 3 * m + (a + 1) % 3);
            let [x, y] = [q[j] - q[i], q[atoms + j] - q[atoms + i]];
            let [dot_x, dot_y] = [v[j] - v[i], v[atoms + j] - v[atoms + i]];
            let found = x.hypot(y);
            length = larger(length, (found - 1.0).abs());
            along = larger(along, ((x * dot_x + y * dot_y) / found).abs());
        }
    }
    [length, along]
}

/// Lengths of steps, the shortest first, each with the largest |E − E(0)| over E(0); infinite where the run
/// is lost.
struct Scan(Vec<[f64; 2]>);

impl Scan {
    /// Of runs up to time `end`, with steps between the two.
    fn new<S: Lagrangian, M: Method<S, f64> + Clone>(
        job: &Job<'_>,
        system: &S,
        method: &M,
        start: &S::State<f64>,
        [shortest, longest]: [f64; 2],
        end: f64,
    ) -> Result<Self> {
        let count = (FINENESS * (longest / shortest).log2()).round() as u32;
        let error = |i: u32| {
            let h = shortest * (f64::from(i) / FINENESS).exp2();
            let mut run = Integrator::new(system, method.clone(), h, start.clone())?;
            let (begin, mut largest) = (run.energy(), 0.0);
            let steps = (end / h).ceil() as u64;
            job.expect(steps);
            let kept = job.follow(&mut run, steps, |run| {
                largest = larger(largest, (run.energy() / begin - 1.0).abs());
            });
            Ok([h, if kept.is_err() || !largest.is_finite() { f64::INFINITY } else { largest }])
        };
        Ok(Self((0..=count).map(error).collect::<Result<_>>()?))
    }

    /// The longest step at which, and at all shorter ones that were tried, the error is at most [`BOUND`].
    fn longest(&self) -> f64 {
        let kept = self.0.iter().take_while(|[_, error]| *error <= BOUND);
        kept.last().map_or(f64::NAN, |[h, _]| *h)
    }

    /// The error of the step that is the nearest to `h`.
    fn error(&self, h: f64) -> f64 {
        let off = |tried: f64| (tried / h).ln().abs();
        let nearest = self.0.iter().min_by(|a, b| off(a[0]).total_cmp(&off(b[0])));
        nearest.map_or(f64::NAN, |[_, error]| *error)
    }
}

fn momenta_and_rods(rods: &Kept) -> Claim {
    let [_, bonds, along, x, y, angular] = rods.kept.each_ref().map(|kept| kept.largest);
    beyond(format!("{MOLECULES} rigid molecules by RATTLE, h = {H}: rods and momenta are kept to rounding"))
        .at_most("largest deviation of the length of a rod", bonds, 3e-13)
        .at_most("largest velocity along a rod", along, 1e-15)
        .at_most("largest change of the momentum", larger(x, y), 5e-13)
        .at_most("largest change of the angular momentum", angular, 1e-10)
}

fn trend(both: [&Kept; 2]) -> Claim {
    let trend = "mean ΔE in the last tenth of the run less that in the first, over max|ΔE|";
    let claim = beyond("the energy has no trend, with rods and with springs");
    claim.each(both, |claim, Series { name, kept: [energy, ..], .. }| {
        let claim = claim.of(name).at_most(trend, energy.drift().abs() / energy.largest, 0.25);
        claim.at_most("max|ΔE| over all / in the first tenth", energy.growth(), 1.5)
    })
}

fn steps([rods, soft, stiff]: &[Scan; 3]) -> Claim {
    let springs = [(soft, SOFT.k, 3.0), (stiff, STIFF.k, 9.0)];
    beyond(
        "with rods the longest step that keeps the energy to one hundredth is several times as long as \
            with springs",
    )
    .within("rods: longest step", rods.longest(), [0.035, 0.07])
    .each(springs, |claim, (scan, k, low)| {
        claim.at_least(
            format!("k = {k}: longest step with rods / with springs"),
            rods.longest() / scan.longest(),
            low,
        )
    })
    .each(springs, |claim, (scan, k, _)| {
        let over_limit = scan.longest() * (3.0 * k).sqrt() / 2.0;
        claim.within(format!("k = {k}: longest step with springs / (2/ω)"), over_limit, [0.88, 1.01])
    })
}

fn same([rods, soft, _]: &[Scan; 3]) -> Claim {
    let quantity = format!("h = {H_SPRINGS}: max|ΔE| with springs, k = {}, over that with rods", SOFT.k);
    beyond("below that limit rods and springs have the same energy error: only stability shortens the steps")
        .near(quantity, soft.error(H_SPRINGS) / rods.error(H_SPRINGS), [1.0, 0.02])
}

/// Where the atoms are.
fn atoms(RigidMoleculesState { x, y, .. }: &RigidMoleculesState) -> Vec<[f64; 2]> {
    x.iter().zip(y).map(|(&x, &y)| [x, y]).collect()
}

fn order_of_positions() -> Result<Claim> {
    let [fine, double] = each([FINE, 2.0 * FINE], |h| {
        Ok(atoms(&Accelerations::new(&RIGID, h, &RIGID.chain(SPEED)?)?.up_to(ORDER_TIME)?))
    })?;
    let order = order_of(ORDER_STEPS, |h| {
        let end = up_to(&RIGID, Rattle::default(), h, RIGID.chain(SPEED)?, ORDER_TIME)?;
        Ok((h, farthest(&atoms(&end), &fine)))
    })?;
    Ok(beyond("the positions by RATTLE are of second order, against RK4 on the accelerations")
        .at_most("largest distance of the atoms of two references", farthest(&fine, &double), 2e-9)
        .near(format!("order at t = {ORDER_TIME}"), order, [2.0, 0.05]))
}

fn figure(both: [&Kept; 2], scans: &[Scan; 3], end: f64) -> Result<Figure> {
    let [rods, soft, stiff] = scans;
    let all = [
        (stiff, VERMILLION, "springs, *k* = 10⁵", 4.0),
        (soft, GREEN, "springs, *k* = 10⁴", 2.6),
        (rods, BLUE, "rods", 1.4),
    ];
    let lines = all.map(|(Scan(errors), colour, name, width)| {
        let drawn = errors.iter().map(|&[h, error]| [h, error.min(1e6)]).collect();
        (name, Stroke::solid(colour).width(width), drawn)
    });
    let step = Axis::logarithmic("step *h*").within(0.0022, 0.2);
    let error = Axis::logarithmic("largest |*E*/*E*(0) − 1|").within(1e-5, 1.0);
    let lengths = Panel::new("Energy error over the length of the steps", step, error)
        .lines(lines)
        .line(vec![[0.0022, BOUND], [0.2, BOUND]], Stroke::dashed(SLATE).width(1.2))
        .labelled("one hundredth")
        .legend_at(Corner::BottomRight);
    let steps = both
        .into_iter()
        .zip([H_SPRINGS, H])
        .map(|(series, h)| Series { name: format!("{}, *h* = {h}", series.name), ..series.clone() });
    let energy =
        over_time(["Energy", "largest |*E*/*E*(0) − 1|"], end, [1e-5, 1.0], &steps.collect::<Vec<_>>(), 0);
    let bonds = over_time(["Sides of the triangles", "largest |length − 1|"], end, [1e-16, 1e-1], both, 1);
    let most = scientific(both[1].kept[1].largest);
    let bonds = bonds.without_legend().caption(Corner::BottomRight, format!("rods: at most {most}"));
    let [rods, soft, stiff] = scans.each_ref().map(Scan::longest);
    Ok(Figure::new(
        format!("A chain of {MOLECULES} rigid molecules by RATTLE, and with springs in place of the rods"),
        format!(
            "Atoms of mass 1, sides of length 1, and between molecules the potential of Morse with depth 1 \
             and *β* = {BETA}; *h* = {H} with rods, {H_SPRINGS} with springs of *k* = 10⁴."
        ),
    )
    .row(400.0, vec![chain()?, lengths])
    .row(310.0, vec![energy, bonds])
    .footer(format!(
        "The longest step that keeps the energy to 1 % is {rods:.3} with rods, {soft:.4} and {stiff:.4} \
         with springs. The chain moves away from the origin: rounding of coordinates grows with the \
         distance.",
    )))
}

/// The chain with rods after some time, about its centre of mass.
fn chain() -> Result<Panel> {
    let mut run = Integrator::new(&RIGID, Rattle::default(), H, RIGID.chain(SPEED)?)?;
    run.take_steps(1000)?;
    let atoms = atoms(&run.state());
    let centre: [f64; 2] =
        std::array::from_fn(|i| atoms.iter().map(|atom| atom[i]).sum::<f64>() / atoms.len() as f64);
    let atoms: Vec<[f64; 2]> = atoms.into_iter().map(|[x, y]| [x - centre[0], y - centre[1]]).collect();
    let title = format!("The chain at *t* = {:.0}, about its centre of mass", run.time());
    let pairs = (1..MOLECULES).flat_map(|m| [[3 * m - 2, 3 * m], [3 * m - 1, 3 * m + 1]]);
    Ok(Panel::plane(title, "*x*", "*y*")
        .each(pairs, |panel, [a, b]| panel.line(vec![atoms[a], atoms[b]], Stroke::dashed(SLATE).width(1.0)))
        .each(atoms.chunks_exact(3), |panel, triangle| {
            panel.line(closed(triangle), Stroke::solid(BLUE).width(2.4))
        })
        .discs(atoms.clone(), BLUE, Fill::Solid))
}
