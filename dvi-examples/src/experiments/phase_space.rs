//! The pendulum in phase-space form, L = p x' − H: what one-step schemes are where α = p dx.
//!
//! There the trapezoidal scheme is leapfrog, kick–drift–kick, and the midpoint scheme is the implicit
//! midpoint rule. Both preserve area.

use super::elliptic::Elliptic;
use crate::models::{
    Pendulum, PendulumState, PhasePendulum, PhasePendulumState, SymmetricPendulum, SymmetricPendulumState,
};
use crate::vocabulary::*;

/// The step of long runs, and their start.
const H: f64 = 0.2;
const START: f64 = 2.0;
/// Steps of the beginning, with which the whole is compared.
const EARLY: u64 = 1000;
/// Steps of the runs that are compared.
const COMPARED: u64 = 500;
/// The step of the circle that is carried along, and until when it is: those of the experiment `barnes`.
const FINE: f64 = 1.0 / 32.0;
const CARRIED: usize = 8;

/// The points of a circle, carried along to t = 0, 1, …
type Circles = Vec<Vec<[f64; 2]>>;

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(1_000_000, 20_000);
    job.expect(3 * steps);
    let all = [
        long_run(job, "one step, midpoint", Stroke::solid(BLUE), OneStep::midpoint(), steps)?,
        long_run(job, "one step, trapezoid", Stroke::solid(GREEN), OneStep::trapezoid(), steps)?,
        long_run(job, "RK4", Stroke::dashed(VERMILLION), RungeKutta::classical(), steps)?,
    ];
    let leapfrog = circles(OneStep::trapezoid(), 100)?;
    let errors = all.iter().flat_map(|series| {
        ranges([&series.name], &series.kept[0].envelope)
            .map(|(name, [t, low, _, high])| (name, [t, low, high]))
    });
    let points = leapfrog.iter().enumerate().flat_map(|(t, circle)| {
        circle.iter().map(move |[x, p]| (["circle".to_owned()], [t as f64, *x, *p]))
    });
    let table = Table::of(&["series", "t", "x or lowest ΔH", "p or highest ΔH"], errors.chain(points))?;
    job.publish(figure(&all, &leapfrog, steps as f64 * H), table)?;
    let text = "the energy error of one-step schemes is no larger in the whole run than in its beginning";
    let growth = |series: &Series<1>| format!("{}: max|ΔH| over all / over {EARLY} steps", series.name);
    let flat = beyond(text)
        .each(&all[..2], |claim, series| claim.at_most(growth(series), series.kept[0].growth(), 1.001))
        .at_least(growth(&all[2]), all[2].kept[0].growth(), 5.0);
    let references = [(2, 0.784_858_871_043), (4, 0.784_780_953_139)].map(|(t, exact)| {
        let quantity = format!("trapezoid: area of 100 corners at t = {t}");
        Check::new(quantity, area(&leapfrog[t]), Bound::Near(exact, 1e-12))
    });
    let claims = vec![flat, same_schemes()?, areas()?, periods()?];
    Ok(Outcome { claims, references: references.into(), notes: vec![] })
}

fn long_run(
    job: &Job<'_>,
    name: &str,
    stroke: Stroke,
    method: impl Method<PhasePendulum, f64>,
    steps: u64,
) -> Result<Series<1>> {
    let mut run = Integrator::new(&PhasePendulum {}, method, H, PhasePendulumState { x: START, p: 0.0 })?;
    let energy = run.energy();
    let span = Span { end: steps as f64 * H, early: EARLY as f64 * H, intervals: 400 };
    Ok(Series::new(name, stroke, job.keep(&mut run, steps, span, |run| [run.energy() - energy])?))
}

/// A regular polygon about (0, 1) at t = 0, 1, …
fn circles(method: impl Method<PhasePendulum, f64> + Copy, corners: usize) -> Result<Circles> {
    let mut circles = vec![Vec::new(); CARRIED + 1];
    for j in 0..corners {
        let (sin, cos) = (TAU * j as f64 / corners as f64).sin_cos();
        let start = PhasePendulumState { x: 0.5 * cos, p: 1.0 + 0.5 * sin };
        let mut run = Integrator::new(&PhasePendulum {}, method, FINE, start)?;
        for circle in &mut circles {
            circle.push([run.q()[0], run.q()[1]]);
            run.take_steps(32)?;
        }
    }
    Ok(circles)
}

fn same_schemes() -> Result<Claim> {
    let (system, start) = (PhasePendulum {}, PhasePendulumState { x: START, p: 0.0 });
    let trapezoid = course(&mut Integrator::new(&system, OneStep::trapezoid(), H, start)?, COMPARED, place)?;
    let midpoint = course(&mut Integrator::new(&system, OneStep::midpoint(), H, start)?, COMPARED, place)?;
    let gauss = course(&mut Integrator::new(&system, Gauss::<1>::new(), H, start)?, COMPARED, place)?;
    let start = PendulumState { x: START, dot_x: 0.0 };
    let mut run = Integrator::new(&Pendulum {}, Variational::trapezoid(), H, start)?;
    let verlet = course(&mut run, COMPARED, |run| [run.q()[0], run.memory().p()[0]])?;
    let start = SymmetricPendulumState { x: START, p: 0.0 };
    let mut run = Integrator::new(&SymmetricPendulum {}, Sigma::midpoint(), H, start)?;
    let two_step = course(&mut run, COMPARED, place)?;
    Ok(beyond("with α = p dx the trapezoidal scheme is leapfrog and the midpoint one is implicit midpoint")
        .at_most(
            "500 steps: trapezoid from Störmer–Verlet on L(x, x')",
            farthest(&trapezoid, &verlet),
            1e-11,
        )
        .at_most("500 steps: midpoint from Gauss of one stage", farthest(&midpoint, &gauss), 1e-11)
        .at_most("500 steps: midpoint from σ = ½ with ½(p dx − x dp)", farthest(&midpoint, &two_step), 1e-11)
        .at_least("500 steps: trapezoid from midpoint", farthest(&trapezoid, &midpoint), 1e-3))
}

/// A polygon loses area where its sides bend, by n⁻²; a flow that loses area does not get better with n.
fn areas() -> Result<Claim> {
    fn of(method: impl Method<PhasePendulum, f64> + Copy) -> Result<Option<f64>> {
        order_of([100, 200, 400, 800], |corners| {
            let circles = circles(method, corners)?;
            Ok((1.0 / corners as f64, area(&circles[0]) - area(&circles[4])))
        })
    }
    let (midpoint, trapezoid) = (of(OneStep::midpoint())?, of(OneStep::trapezoid())?);
    Ok(beyond("the polygon and not the scheme loses area")
        .near("midpoint: order in 1/n of what is lost at t = 4", midpoint, [2.0, 0.01])
        .near("trapezoid: order in 1/n of what is lost at t = 4", trapezoid, [2.0, 0.01]))
}

/// Where a hundred steps lead that are a hundredth of the period each, against the start.
fn periods() -> Result<Claim> {
    fn of(method: impl Method<PhasePendulum, f64> + Copy) -> Result<Option<f64>> {
        let (sin, cos) = (START / 2.0).sin_cos();
        let period = 4.0 * Elliptic { modulus: sin, complementary: cos }.quarter();
        order_of([100, 150, 200], |steps| {
            let h = period / steps as f64;
            let start = PhasePendulumState { x: START, p: 0.0 };
            let mut run = Integrator::new(&PhasePendulum {}, method, h, start)?;
            run.take_steps(steps)?;
            Ok((h, (run.q()[0] - START).hypot(run.q()[1])))
        })
    }
    let (midpoint, trapezoid) = (of(OneStep::midpoint())?, of(OneStep::trapezoid())?);
    let gauss = of(OneStepGauss::<2>::new())?;
    Ok(beyond("the period comes out as the elliptic integral says, to the order of the scheme")
        .near("midpoint: order of the error after a period", midpoint, [2.0, 0.02])
        .near("trapezoid: order of the error after a period", trapezoid, [2.0, 0.02])
        .near("Gauss of order 4: order of the error after a period", gauss, [4.0, 0.05]))
}

fn figure(all: &[Series<1>; 3], leapfrog: &Circles, end: f64) -> Figure {
    let energy = |p: f64, x: f64| p * p / 2.0 - x.cos();
    let contour = |level: f64, sign: f64| -> Vec<[f64; 2]> {
        let xs = (-720..=720).map(|k| f64::from(k) / 200.0).filter(|&x| energy(0.0, x) <= level);
        xs.map(|x| [x, sign * (2.0 * (level + x.cos())).sqrt()]).collect()
    };
    let levels = [0.0, 1.0, 2.0].into_iter().flat_map(|level| [(level, 1.0), (level, -1.0)]);
    let grey = Stroke::solid(SEQUENCE[0]).width(0.6).opacity(0.4);
    let (x, p) =
        (Axis::linear("angle *x*").within(-3.6, 3.6), Axis::linear("momentum *p*").within(-2.8, 4.4));
    let plane = Panel::new("A circle of 100 points, by the trapezoidal scheme", x, p)
        .equal()
        .each(levels, |plane, (level, sign)| plane.line(contour(level, sign), grey))
        .each(leapfrog.iter().enumerate().step_by(2), |plane, (t, circle)| {
            let colour = SEQUENCE[t.min(7)];
            let text = format!("*t* = {t}: area {:.6}", area(circle));
            plane.line(closed(circle), Stroke::solid(colour)).labelled(text).dots(
                circle.clone(),
                1.3,
                colour,
            )
        });
    let time = Axis::linear("time *t*   [1/*ω*₀]").within(0.0, end);
    let axis = Axis::logarithmic("largest |*H* − *H*(0)| of each interval").within(1e-4, 10.0);
    let energy = Panel::new("Error of the energy", time, axis).lines(magnitudes(all, 0)).weight(1.2);
    let [midpoint, trapezoid, rk4] = all.each_ref().map(|series| series.kept[0].largest);
    Figure::new(
        "The pendulum in phase-space form: an area carried along, and the energy errors of three methods",
        format!("*H* = ½*p*² − cos *x*; left *h* = 1/32, right *h* = {H} from ({START}, 0)"),
    )
    .row(500.0, vec![plane, energy])
    .footer(format!(
        "Largest |Δ*H*| of one step: midpoint {}, trapezoid {}. RK4 at the end: {}.",
        at_most(midpoint),
        at_most(trapezoid),
        scientific(rk4)
    ))
}
