//! The pendulum in phase-space form, L = p x' − H: what one-step schemes are where α = p dx.
//!
//! There the trapezoidal scheme is leapfrog, kick–drift–kick, and the midpoint scheme is the implicit
//! midpoint rule. Both preserve area.

use super::barnes;
use super::flips::Elliptic;
use crate::vocabulary::*;

const SYSTEM: PhasePendulum = PhasePendulum {};
/// The start of long runs, and their step.
const START: PhasePendulumState = PhasePendulumState { x: 2.0, p: 0.0 };
const H: f64 = 0.2;
/// The corners of a polygon at t = 0, 1, …
type Circles = Vec<Points>;

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(1_000_000, 20_000);
    let (begin, span) = (Problem::new(&SYSTEM, START), Span::of(steps, H, 1000));
    let runs = [
        (("one step, midpoint", solid(BLUE)), begin.any(OneStep::midpoint(), H)?),
        (("one step, trapezoid", solid(GREEN)), begin.any(OneStep::trapezoid(), H)?),
        (("RK4", dashed(VERMILLION)), begin.any(RungeKutta::classical(), H)?),
    ];
    let all = each(runs, |(named, run)| job.energy(named, run, span, 0).whole())?;
    let leapfrog = circles(OneStep::trapezoid(), 100, 8)?;
    let errors = all.iter().flat_map(|Series { name, kept, .. }| {
        kept[0].band().into_iter().map(move |row| ([name.as_str()], row))
    });
    let circles = leapfrog.iter().zip(0..);
    let points = circles.flat_map(|(c, t)| c.iter().map(move |&[x, p]| (["circle"], [f64::from(t), x, p])));
    let table = Table::of("series,t,x or lowest ΔH,p or highest ΔH", errors.chain(points));
    job.publish(figure(&all, &leapfrog, span.end), table)?;
    let text = "the energy error of one-step schemes is no larger in the whole run than in its beginning";
    let growth = |series: &Series<1>| format!("{}: max|ΔH| over all / over 1000 steps", series.name);
    let flat = beyond(text)
        .each(&all[..2], |claim, series| claim.at_most(growth(series), series.kept[0].growth(), 1.001))
        .at_least(growth(&all[2]), all[2].kept[0].growth(), 5.0);
    let references = barnes::areas("trapezoid", &leapfrog).into();
    Ok(Outcome { claims: vec![flat, same_schemes()?, areas()?, periods()?], references, notes: vec![] })
}

/// A regular polygon about (0, 1), carried along with the step of the experiment `barnes`.
fn circles(method: impl Method<PhasePendulum, f64> + Copy, corners: usize, end: u64) -> Result<Circles> {
    barnes::carried(corners, |[x, p]| {
        let mut run = Problem::new(&SYSTEM, PhasePendulumState { x, p }).run(method, 1.0 / 32.0)?;
        Ok(course(&mut run, 32 * end, place)?)
    })
}

fn same_schemes() -> Result<Claim> {
    let (begin, symmetric) = (Problem::new(&SYSTEM, START), SymmetricPendulumState { x: START.x, p: 0.0 });
    let symmetric = Problem::new(&SymmetricPendulum {}, symmetric);
    let trapezoid = course(&mut begin.run(OneStep::trapezoid(), H)?, 500, place)?;
    let midpoint = course(&mut begin.run(OneStep::midpoint(), H)?, 500, place)?;
    let gauss = course(&mut begin.run(Gauss::<1>::new(), H)?, 500, place)?;
    let two_step = course(&mut symmetric.run(Sigma::midpoint(), H)?, 500, place)?;
    let regular = Problem::new(&Pendulum {}, PendulumState { x: START.x, dot_x: 0.0 });
    let verlet =
        course(&mut regular.run(Variational::trapezoid(), H)?, 500, |run| [run.q()[0], run.v()[0]])?;
    let from_verlet = farthest(&trapezoid, &verlet);
    Ok(beyond("with α = p dx the trapezoidal scheme is leapfrog and the midpoint one is implicit midpoint")
        .at_most("500 steps: trapezoid from Störmer–Verlet on L(x, x')", from_verlet, 1e-11)
        .at_most("500 steps: midpoint from Gauss of one stage", farthest(&midpoint, &gauss), 1e-11)
        .at_most("500 steps: midpoint from σ = ½ with ½(p dx − x dp)", farthest(&midpoint, &two_step), 1e-11)
        .at_least("500 steps: trapezoid from midpoint", farthest(&trapezoid, &midpoint), 1e-3))
}

/// A polygon loses area where its sides bend, by n⁻²; a flow that loses area does not get better with n.
fn areas() -> Result<Claim> {
    fn of(method: impl Method<PhasePendulum, f64> + Copy) -> Result<Option<f64>> {
        order_of([100, 200, 400, 800], |corners| {
            let circles = circles(method, corners, 4)?;
            Ok((1.0 / corners as f64, area(&circles[0]) - area(&circles[4])))
        })
    }
    Ok(beyond("the polygon and not the scheme loses area")
        .near("midpoint: order in 1/n of what is lost at t = 4", of(OneStep::midpoint())?, [2.0, 0.01])
        .near("trapezoid: order in 1/n of what is lost at t = 4", of(OneStep::trapezoid())?, [2.0, 0.01]))
}

/// Where a hundred steps lead that are a hundredth of the period each, against the start.
fn periods() -> Result<Claim> {
    let (sin, cos) = (START.x / 2.0).sin_cos();
    let period = 4.0 * Elliptic { modulus: sin, complementary: cos }.quarter();
    let error = |q: &[f64]| distance([q[0], q[1]], [START.x, START.p]);
    let errors = Problem::new(&SYSTEM, START).errors(period, &[100, 150, 200], error);
    let after = "order of the error after a period";
    Ok(beyond("the period comes out as the elliptic integral says, to the order of the scheme")
        .near(format!("midpoint: {after}"), errors.order(OneStep::midpoint())?, [2.0, 0.02])
        .near(format!("trapezoid: {after}"), errors.order(OneStep::trapezoid())?, [2.0, 0.02])
        .near(format!("Gauss of order 4: {after}"), errors.order(OneStepGauss::<2>::new())?, [4.0, 0.05]))
}

fn figure(all: &[Series<1>; 3], leapfrog: &Circles, end: f64) -> Figure {
    let energy = |p: f64, x: f64| p * p / 2.0 - x.cos();
    let contour = |level: f64, sign: f64| -> Points {
        let xs = (-720..=720).map(|k| f64::from(k) / 200.0).filter(|&x| energy(0.0, x) <= level);
        xs.map(|x| [x, sign * (2.0 * (level + x.cos())).sqrt()]).collect()
    };
    let levels = [0.0, 1.0, 2.0].into_iter().flat_map(|level| [(level, 1.0), (level, -1.0)]);
    let grey = solid(SEQUENCE[0]).width(0.6).opacity(0.4);
    let title = "A circle of 100 points, by the trapezoidal scheme";
    let plane = Panel::window(title, ("angle *x*", [-3.6, 3.6]), ("momentum *p*", [-2.8, 4.4]))
        .each(levels, |plane, (level, sign)| plane.line(contour(level, sign), grey))
        .each(leapfrog.iter().enumerate().step_by(2), |plane, (t, circle)| {
            let colour = SEQUENCE[t.min(7)];
            let text = format!("*t* = {t}: area {:.6}", area(circle));
            plane.line(closed(circle), solid(colour)).labelled(text).dots(circle.clone(), 1.3, colour)
        });
    let labels = ["Error of the energy", "largest |*H* − *H*(0)| of each interval"];
    Figure::of(format!("*H* = ½*p*² − cos *x*; left *h* = 1/32, right *h* = {H} from (2, 0)"))
        .row(500.0, vec![plane, over_time(labels, end, [1e-4, 10.0], all, 0).weight(1.2)])
}
