//! The double pendulum: chaos, with a mass matrix that depends on the angles.
//!
//! The variational step is implicit here, p0 = −D₁L_d(q0, q1), and the compiler has differentiated what it
//! needs. Beside it stands the classical Runge–Kutta method on Hamilton's equations.

use crate::vocabulary::*;

const SYSTEM: DoublePendulum = DoublePendulum { length: 1.0, g: 9.81 };
/// Both rods horizontal, at rest.
const START: DoublePendulumState =
    DoublePendulumState { a: FRAC_PI_2, b: FRAC_PI_2, dot_a: 0.0, dot_b: 0.0 };
const H: f64 = 0.01;
const SHOWN: f64 = 12.0;
const EARLY: f64 = 100.0;

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(1e4, 1e3);
    let steps = (end / H).round() as u64;
    job.expect(3 * steps);
    let (span, places) = (Span { early: EARLY, ..Span::of(steps, H, 0) }, (SHOWN / H) as usize);
    let pendulum = Problem::new(&SYSTEM, START);
    let runs = [
        (("variational, midpoint", solid(GREEN)), pendulum.any(Variational::midpoint(), H)?),
        (("variational, Simpson", solid(BLUE)), pendulum.any(Variational::simpson(), H)?),
        (("RK4", dashed(VERMILLION)), pendulum.any(RungeKutta::classical(), H)?),
    ];
    let all = each(runs, |(named, run)| job.energy(named, run, span, places).whole())?;
    job.publish(figure(&all, end), range_table("method,t", &[""], &all))?;
    let [midpoint, simpson, rk4] = all.each_ref().map(|series| &series.kept[0]);
    let growth = rk4.last.abs() / rk4.largest_early;
    let loses = "RK4 loses energy steadily at the same step";
    claims([
        beyond("the variational energy error stays bounded over a long chaotic run")
            .at_most("midpoint: max|ΔE| over all / to t = 100", midpoint.growth(), 3.0)
            .at_most("Simpson: max|ΔE| over all / to t = 100", simpson.growth(), 3.0),
        beyond(loses).at_least("RK4: |ΔE| at the end / max|ΔE| to t = 100", growth, 5.0),
    ])
}

fn figure(all: &[Series<1>; 3], end: f64) -> Figure {
    let [x, y] = ["*x*   [m]", "*y*   [m]"].map(|label| (label, [-2.1, 2.1]));
    let lower = |[a, b]: [f64; 2]| [a.sin() + b.sin(), -a.cos() - b.cos()].map(|x| SYSTEM.length * x);
    let path: Points = all[1].path.iter().copied().map(lower).collect();
    let part = path.len().div_ceil(SEQUENCE.len()).max(1);
    let parts = SEQUENCE.into_iter().enumerate();
    let path = Panel::window("Path of the lower mass", x, y).each(parts, |panel, (i, colour)| {
        // One point more, so that the parts join.
        panel.line(path.iter().skip(i * part).take(part + 1).copied().collect(), solid(colour).width(1.5))
    });
    let labels = ["Error of the energy", "largest |*E* − *E*(0)| of each interval   [J]"];
    let energy = over_time(labels, end, [1e-6, 1.0], all, 0);
    Figure::of(format!("Masses of 1 kg, rods of 1 m, released with both rods horizontal; *h* = {H} s"))
        .row(470.0, vec![path, energy.weight(1.35).legend_at(Corner::BottomRight)])
        .sequence_key("path: 0 s", format!("{SHOWN} s"))
        .footer("The path is that of Simpson's rule.")
}
