//! A chain of rigid molecules by RATTLE, and the same molecules with stiff springs in place of the rods.
//!
//! RATTLE keeps momenta and rods to rounding, and the energy has no trend (Andersen 1983; Leimkuhler & Skeel
//! 1994). Steps with springs must be shorter than 2/ω for the fastest vibration of a molecule, ω² = 3k/m,
//! whatever the chain does; with rods the chain sets the length of the steps.

use super::longest_steps::Scans;
use crate::vocabulary::*;

const MOLECULES: usize = 8;
const ATOMS: usize = 3 * MOLECULES;
const BETA: f64 = 4.0;
const SPEED: f64 = 0.4;
pub const RIGID: RigidMolecules = RigidMolecules { n: MOLECULES, beta: BETA };
/// The molecules with springs, of a stiffness that is large and of one that is larger.
pub const SOFT: SpringMolecules = SpringMolecules { n: MOLECULES, beta: BETA, k: 1e4 };
pub const STIFF: SpringMolecules = SpringMolecules { k: 1e5, ..SOFT };
const H: f64 = 0.05;
pub const H_SPRINGS: f64 = 0.01;
/// E/E(0) − 1, the largest deviation of the length of a side, the largest velocity along one, and the
/// changes of the momentum in x, that in y and the angular momentum.
type Kept = Series<6>;

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(5000.0, 100.0);
    job.expect(((end / H).round() + (end / H_SPRINGS).round()) as u64);
    let start = RIGID.chain(SPEED)?;
    let (rigid, soft) = (Problem::new(&RIGID, start.clone()), Problem::new(&SOFT, start.clone()));
    let rods = kept(job, ("rods, RATTLE", solid(BLUE)), rigid.run(Rattle::default(), H)?, end)?;
    let verlet = soft.run(Variational::trapezoid(), H_SPRINGS)?;
    let springs = kept(job, ("springs, trapezoid", solid(GREEN)), verlet, end)?;
    let scans = Scans::new(job, &start)?;
    let both = [(&rods, f64::INFINITY, H), (&springs, SOFT.k, H_SPRINGS)];
    let over_time = both.into_iter().flat_map(|(of, k, h)| {
        let rows = of.kept[0].magnitude().into_iter().zip(of.kept[1].magnitude());
        rows.map(move |([t, energy], [_, length])| (["over time"], [k, h, t, energy, length].map(Some)))
    });
    let over_step = scans.rows().map(|[k, h, e]| (["over step"], [Some(k), Some(h), None, Some(e), None]));
    let table = Table::of("series,k,h,t,energy,length", over_time.chain(over_step));
    job.publish(figure([&springs, &rods], &scans, end)?, table)?;
    let [steps, same] = scans.claims();
    let undone = rigid.there_and_back(Rattle::default(), H, 400)?;
    let difference = "largest difference of a coordinate or a velocity from the start";
    let [_, bonds, along, x, y, angular] = rods.kept.each_ref().map(|kept| kept.largest);
    let trend = "mean ΔE in the last tenth of the run less that in the first, over max|ΔE|";
    let no_trend = beyond("the energy has no trend, with rods and with springs");
    claims([
        beyond("8 rigid molecules by RATTLE, h = 0.05: rods and momenta are kept to rounding")
            .at_most("largest deviation of the length of a rod", bonds, 3e-13)
            .at_most("largest velocity along a rod", along, 1e-15)
            .at_most("largest change of the momentum", larger(x, y), 5e-13)
            .at_most("largest change of the angular momentum", angular, 1e-10),
        no_trend.each([&rods, &springs], |claim, Series { name, kept: [energy, ..], .. }| {
            let claim = claim.of(name).at_most(trend, energy.drift().abs() / energy.largest, 0.25);
            claim.at_most("max|ΔE| over all / in the first tenth", energy.growth(), 1.5)
        }),
        steps,
        same,
        order_of_positions()?,
        beyond("400 steps of RATTLE are undone by as many steps of length −0.05")
            .at_most(difference, undone, 1e-12),
    ])
}

fn kept(job: &Job<'_>, named: Named<'_>, mut run: impl Run<Scalar = f64>, end: f64) -> Result<Kept> {
    let (energy, begin): (_, [f64; 3]) = (run.energy(), momenta(&run));
    job.series(named, &mut run, Span { end, early: 0.1 * end, intervals: 250 }, |run, _| {
        let ([length, along], [x, y, angular]) = (sides(run), difference(momenta(run), begin));
        [run.energy() / energy - 1.0, length, along, x, y, angular]
    })
    .whole()
}

/// The largest error of a side, and the largest velocity along one.
fn sides(run: &impl Run<Scalar = f64>) -> [f64; 2] {
    let [r, v] = [run.q(), &run.v()].map(|flat| points(&flat[..ATOMS], &flat[ATOMS..]));
    let sides = (0..ATOMS).map(|i| [i, i / 3 * 3 + (i + 1) % 3]);
    stretched(1.0, sides.map(|[i, j]| [&r, &v].map(|of| difference(of[j], of[i]))))
}

fn order_of_positions() -> Result<Claim> {
    let [fine, double] =
        each([0.00125, 0.0025], |h| Ok(Accelerations::new(&RIGID, h, &RIGID.chain(SPEED)?)?.up_to(2.0)?.r))?;
    let error = |q: &[f64]| farthest(&points(&q[..ATOMS], &q[ATOMS..]), &fine);
    let errors = Problem::new(&RIGID, RIGID.chain(SPEED)?).errors(2.0, &[50, 100, 200, 400], error);
    Ok(beyond("the positions by RATTLE are of second order, against RK4 on the accelerations")
        .at_most("largest distance of the atoms of two references", farthest(&fine, &double), 2e-9)
        .near("order at t = 2", errors.order(Rattle::default())?, [2.0, 0.05]))
}

fn figure(both: [&Kept; 2], scans: &Scans, end: f64) -> Result<Figure> {
    let error = ("largest |*E*/*E*(0) − 1|", [1e-5, 1.0]);
    let named = both.into_iter().zip([H_SPRINGS, H]).map(|(series, h)| {
        (format!("{}, *h* = {h}", series.name), series.stroke, series.kept[0].magnitude())
    });
    let energy = Panel::semilog("Energy", ("time *t*", [0.0, end]), error).lines(named);
    let bonds = over_time(["Sides of the triangles", "largest |length − 1|"], end, [1e-16, 1e-1], both, 1);
    let subtitle = format!(
        "Atoms of mass 1, sides of length 1, and between molecules the potential of Morse with depth 1 and \
         *β* = {BETA}; *h* = {H} with rods, {H_SPRINGS} with springs of *k* = 10⁴."
    );
    let figure = Figure::of(subtitle).row(400.0, vec![chain()?, scans.panel()]);
    Ok(figure.row(310.0, vec![energy, bonds.without_legend()]))
}

/// The chain with rods after some time, about its centre of mass.
fn chain() -> Result<Panel> {
    let mut run = Problem::new(&RIGID, RIGID.chain(SPEED)?).run(Rattle::default(), H)?;
    run.take_steps(1000)?;
    let atoms = run.state().r;
    let centre = [0, 1].map(|i: usize| mean(atoms.iter().map(|atom| atom[i])));
    let atoms: Vec<[f64; 2]> = atoms.into_iter().map(|atom| difference(atom, centre)).collect();
    let pairs = (1..MOLECULES).flat_map(|m| [[3 * m - 2, 3 * m], [3 * m - 1, 3 * m + 1]]);
    Ok(Panel::plane(format!("The chain at *t* = {:.0}, about its centre of mass", run.time()), "*x*", "*y*")
        .each(pairs, |panel, [a, b]| panel.line(vec![atoms[a], atoms[b]], dashed(SLATE).width(1.0)))
        .each(atoms.chunks_exact(3), |panel, triangle| panel.line(closed(triangle), solid(BLUE).width(2.4)))
        .discs(atoms.clone(), BLUE))
}
