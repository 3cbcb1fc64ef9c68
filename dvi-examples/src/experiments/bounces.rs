//! A particle that bounces on a curved floor: what its energy does over 10⁵ bounces.
//!
//! A step in which the particle reaches the floor is divided there. At the impact either the discrete energy
//! is kept, which makes the steps symplectic (Fetecau, Marsden, Ortiz & West 2003), or the energy at the
//! point of impact. The discrete energies of two flights of different lengths differ by terms of the order
//! h² from the same energy, so the first changes it at each bounce, by amounts that add up as in a random
//! walk.

use super::random_walk::Walks;
use crate::vocabulary::*;

pub const FLOOR: Bouncer = Bouncer { a: 0.8 };
pub const START: BouncerState = BouncerState { x: 0.3, y: 1.8, dot_x: 0.4, dot_y: 0.0 };
/// The lengths of the steps of long runs; RK4 takes four forces a step.
pub const STEPS: [f64; 2] = [0.02, 0.01];
const RK4_STEP: f64 = 4.0 * STEPS[0];
/// Up to here the particle comes down some hundred times.
const EARLY: f64 = 200.0;
pub const LAWS: [Collision; 2] = [Collision::Variational, Collision::Reflection];

/// E − E(0) of a long run, and its bounces, with those at which no impulse keeps the discrete energy.
type Bounces = (Series<1>, [u64; 2]);

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(200_000.0, 1000.0);
    job.expect(STEPS.iter().map(|h| 2 * (end / h) as u64).sum::<u64>() + (end / RK4_STEP) as u64);
    let ([coarse, fine], [discrete, at_impact]) = (STEPS, LAWS);
    let all = [
        (by_rk4(job, end)?, [0; 2]),
        bounces(job, discrete, coarse, solid(BLUE), end)?,
        bounces(job, discrete, fine, dashed(SKY), end)?,
        bounces(job, at_impact, coarse, solid(GREEN), end)?,
        bounces(job, at_impact, fine, dashed(GREEN), end)?,
    ];
    let walks = Walks::new(job)?;
    let curves = all.iter().map(|(run, _)| ([&run.name], [run.h], run.kept[0].magnitude()));
    job.publish(figure(&all, &walks, end)?, curve_table("kept,h,t,largest_energy_error", curves))?;
    let full = |value: f64| job.only_full(value);
    let kept = all.each_ref().map(|(run, _)| &run.kept[0]);
    let [of_rk4, of_coarse, of_fine, coarse, fine] = kept.map(|kept| full(kept.largest));
    let [rk4_growth, .., coarse_growth, fine_growth] = kept.map(|kept| full(kept.growth()));
    let [_, (_, [_, graze]), (_, [_, graze_too]), (_, [bounces, _]), _] = all;
    let over_all = format!("max|ΔE| over all / up to t = {EARLY}");
    let flat = format!(
        "with the energy kept at each impact, the energy error of a particle on a curved floor is less \
         than three times as large over 10⁵ bounces as up to t = {EARLY}, and less than a third with half \
         the step"
    );
    let loses = "RK4 with impacts that keep the energy, and as many forces as with h = 0.02, loses energy \
                 all the time";
    let random = "with the discrete energy kept at each impact the energy walks at random: its change grows \
                  with the square root of the number of bounces, and has a quarter of the size with half \
                  the step";
    let of_both = "bounces that graze so that no impulse keeps the discrete energy, of both runs";
    claims([
        beyond(flat)
            .at_least("bounces", full(bounces as f64), 1e5)
            .at_most("h = 0.02: max|ΔE|", coarse, 1.2e-3)
            .at_most("h = 0.01: max|ΔE|", fine, 2e-4)
            .at_most(format!("h = 0.02: {over_all}"), coarse_growth, 3.0)
            .at_most(format!("h = 0.01: {over_all}"), fine_growth, 3.0)
            .at_least("max|ΔE|, h = 0.02 over h = 0.01", kept[3].largest / kept[4].largest, 3.0),
        walks
            .check(job, beyond(random))
            .at_most("discrete energy, h = 0.02: max|ΔE|", of_coarse, 0.05)
            .at_most("discrete energy, h = 0.01: max|ΔE|", of_fine, 0.0125)
            .at_most(of_both, full((graze + graze_too) as f64), 20.0),
        beyond(loses).of("RK4").at_least("max|ΔE|", of_rk4, 0.01).at_least(&over_all, rk4_growth, 100.0),
        order_of_states()?,
        back_again()?,
    ])
}

fn bounces(job: &Job<'_>, collision: Collision, h: f64, stroke: Stroke, end: f64) -> Result<Bounces> {
    let name = if collision == Collision::Variational { "discrete energy" } else { "energy at the impact" };
    let mut run = Integrator::new(&FLOOR, trapezoid(collision), h, START)?;
    let (begin, span) = (run.energy(), Span { end, early: EARLY, intervals: 300 });
    let named = (name, stroke.width(1.2));
    let series = job.series(named, &mut run, span, |run, _| [run.energy() - begin]).whole()?;
    Ok((series, [run.memory().total(), run.memory().grazing()]))
}

/// RK4 between impacts, which are found by bisection and keep the energy.
fn by_rk4(job: &Job<'_>, end: f64) -> Result<Series<1>> {
    let span = Span { end, early: EARLY, intervals: 300 };
    let mut y = [START.x, START.y, START.dot_x, START.dot_y];
    let energy = |y: [f64; 4]| FLOOR.energy_at(0.0, &FLOOR.state_of(y));
    let begin: f64 = energy(y)?;
    let after = |y: &[f64; 4], h: f64| {
        rk4(y, h, |&[x, y, u, w]| {
            [u, w, -0.3 * x - 0.4 * x.powi(3) - 0.3 * x * y * y, -1.0 - 0.3 * x * x * y]
        })
    };
    let gap = |[x, y, ..]: [f64; 4]| y - FLOOR.a * x.cos();
    job.watch(("RK4", solid(VERMILLION).width(1.2)), span, (RK4_STEP, 1), || {
        let mut left = RK4_STEP;
        while gap(after(&y, left)) < 0.0 {
            let open = bisected([0.0, left], |h| gap(after(&y, h)) >= 0.0);
            left -= open;
            let [x, height, u, w] = after(&y, open);
            let normal = [FLOOR.a * x.sin(), 1.0];
            let change = 2.0 * dot([u, w], normal) / dot(normal, normal);
            y = [x, height, u - change * normal[0], w - change * normal[1]];
        }
        y = after(&y, left);
        Ok([energy(y)? - begin])
    })
}

fn order_of_states() -> Result<Claim> {
    let motion = Problem::new(&FLOOR, START);
    let expected = motion.up_to(Impacts::reflecting(Galerkin::<5>::new()), 6.0 / 4000.0, 6.0)?;
    // Six lengths near each of four: where in a step the impacts are changes the error.
    let counts = [150, 300, 600, 1200].map(|few| [0, 1, 2, 3, 4, 5].map(|n| few + few * n / 12)).concat();
    let order = |after: &dyn Fn(f64) -> Result<BouncerState>| {
        let error = |h| Ok((h, motion.apart(&after(h)?, &expected)?));
        order_of(counts.iter().map(|steps: &u64| 6.0 / *steps as f64), error)
    };
    let [discrete, at_impact] = each(LAWS, |law| order(&|h| motion.up_to(trapezoid(law), h, 6.0)))?;
    let galerkin = order(&|h| motion.up_to(Impacts::reflecting(Galerkin::<3>::new()), h, 6.0))?;
    Ok(beyond("the state at t = 6, after several bounces, is of the order of the method between impacts")
        .near("discrete energy, trapezoid", discrete, [2.0, 0.25])
        .near("energy at the impact, trapezoid", at_impact, [2.0, 0.15])
        .near("energy at the impact, Galerkin with 3 nodes", galerkin, [4.0, 0.25]))
}

fn back_again() -> Result<Claim> {
    let [discrete, at_impact] = each(LAWS, |collision| {
        let mut run = Integrator::new(&FLOOR, trapezoid(collision), STEPS[0], START)?;
        run.take_steps(300)?;
        Problem::new(&FLOOR, START).apart(&back(trapezoid(collision), &run)?, &START)
    })?;
    Ok(beyond("the way back is the way there, bounces among it")
        .at_most("discrete energy: largest difference from the start", discrete, 1e-11)
        .at_most("energy at the impact: the same", at_impact, 1e-11))
}

fn figure(all: &[Bounces; 5], walks: &Walks, end: f64) -> Result<Figure> {
    let lines = all.iter().map(|(series, _)| {
        (format!("{}, *h* = {}", series.name, series.h), series.stroke, series.kept[0].magnitude())
    });
    let error = ("largest |*E* − *E*(0)|", [1e-5, 1e4]);
    let energy = Panel::semilog("Energy", ("time *t*", [0.0, end]), error).lines(lines);
    let subtitle = "Floor *y* = 0.8 cos *x*. The discrete energy is that of both flights of an impact; the \
                    energy at the impact is kept by RK4, too.";
    let above = vec![path()?, energy.legend_at(Corner::TopLeft).weight(1.6)];
    Ok(Figure::of(subtitle).row(380.0, above).row(300.0, vec![walks.panel()]))
}

/// The path up to t = 20, and the points of impact.
fn path() -> Result<Panel> {
    let mut run = Integrator::new(&FLOOR, trapezoid(Collision::Reflection), STEPS[1], START)?;
    let (mut path, mut impacts) = (vec![[START.x, START.y]], Vec::new());
    while run.time() < 20.0 {
        run.advance()?;
        let here: Vec<_> = run.memory().impacts().iter().map(|at| [at.q[0], at.q[1]]).collect();
        impacts.extend(&here);
        path.extend(here.into_iter().chain([place(&run)]));
    }
    let floor = (-60..=60).map(|i| f64::from(i) * 0.025).map(|x| [x, FLOOR.a * x.cos()]).collect();
    Ok(Panel::plane("The path up to *t* = 20", "*x*", "*y*")
        .line(floor, solid(SLATE).width(2.0))
        .line(path, solid(BLUE).width(0.9))
        .dots(impacts, 2.6, VERMILLION))
}
