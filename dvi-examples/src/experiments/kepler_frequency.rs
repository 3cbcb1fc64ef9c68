//! Kosmas & Vlachos, Fig. 4: the frequency of a Kepler orbit with e = 0.95 over ten periods.
//!
//! ω = |q' × q''|/|q'|² (eq. 19), the angular velocity of the osculating circle, beside √(|q''|/|q|), the
//! frequency of the oscillator with the same acceleration at the same place. On an orbit of semi-major axis
//! 1 they are √(1 − e²)/(2r² − r³) and r^(−3/2).

use crate::vocabulary::*;

const ORBIT: Orbit = Orbit { e: 0.95 };
const PERIODS: u64 = 10;
const STEPS: u64 = 20_000;

/// t, r, (19), and √(|q''|/|q|).
type Readings = [f64; 4];

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    // Both frequencies along a phase-fitted run.
    let method = Variational::simpson().phase_fitted(Radial(Reading::Averaged));
    let mut run = Integrator::new(&Kepler {}, method, TAU / STEPS as f64, ORBIT.pericentre())?;
    let readings = course(&mut run, PERIODS * STEPS, |run| {
        let (q, v) = (run.q(), run.memory().p());
        let r = q[0].hypot(q[1]);
        let a = [-q[0] / r.powi(3), -q[1] / r.powi(3)];
        let (curvature, radial) = (Curvature(Reading::Averaged), Radial(Reading::Averaged));
        [run.time(), r, curvature.at(q, v, &a), radial.at(q, v, &a)]
    })?;
    let readings = &readings[1..];
    let rows = readings.iter().step_by(20).map(|row| ([""; 0], *row));
    job.publish(figure(readings), Table::of("t,r,omega_curvature,omega_radial", rows))?;
    let curvatures = || readings.iter().map(|reading| reading[2]);
    let (highest, lowest) = (largest(curvatures()), least(curvatures()));
    let share = |is_so: &dyn Fn(f64) -> bool| {
        curvatures().filter(|&curvature| is_so(curvature)).count() as f64 / readings.len() as f64
    };
    let curvature = largest(readings.iter().map(|[_, r, omega, _]| (omega / formula(*r) - 1.0).abs()));
    let radial = largest(readings.iter().map(|[_, r, _, radial]| (radial / r.powf(-1.5) - 1.0).abs()));
    let [near, far] = [1.0 - ORBIT.e, 1.0 + ORBIT.e].map(formula);
    // 2r² − r³ is largest at r = 4/3, where it is 32/27.
    let rises = [far / formula(4.0 / 3.0), 1e-3];
    let again = "(19) rises again at the apocentre, where the motion is slowest";
    claims([
        says("Fig. 4", "the frequency is smooth almost everywhere except at the perihelion")
            .at_most("share of time with ω above half its peak", share(&|x| x > 0.5 * highest), 0.01)
            .at_least("share of time with ω below 2", share(&|x| x < 2.0), 0.9)
            .near("peak of ω / √(1 − e²)/(2r² − r³) at the pericentre", highest / near, [1.0, 1e-3]),
        beyond("(19) is √(1 − e²)/(2r² − r³) in closed form, and √(|q''|/|q|) is r^(−3/2)")
            .at_most("(19): largest relative deviation", curvature, 2e-3)
            .at_most("√(|q''|/|q|): largest relative deviation", radial, 1e-12),
        beyond(again).near("ω at the apocentre / lowest ω", far / lowest, rises),
    ])
}

fn formula(r: f64) -> f64 {
    (1.0 - ORBIT.e * ORBIT.e).sqrt() / (r * r * (2.0 - r))
}

fn figure(readings: &[Readings]) -> Figure {
    let panel = |title: &str, from: f64, to: f64| {
        let inside = || readings.iter().filter(|[t, ..]| (from..=to).contains(&(t / TAU)));
        let points = |of: usize| inside().map(|reading| [reading[0] / TAU, reading[of]]).collect();
        let frequency = ("frequency ω   [√(μ/*a*³)]", [0.1, 200.0]);
        Panel::semilog(title, ("time *t*   [periods]", [from, to]), frequency).lines([
            ("|*q*' × *q*''|/|*q*'|²  (19)", solid(BLUE), points(2)),
            ("√(|*q*''|/|*q*|) = *r*^(−3/2)", solid(VERMILLION), points(3)),
        ])
    };
    let all = panel("Ten periods", 0.0, PERIODS as f64).without_legend().weight(1.3);
    Figure::of(format!(
        "Read along a phase-fitted run of {STEPS} steps per period; *a*: the semi-major axis"
    ))
    .row(430.0, vec![all, panel("One period", 0.5, 1.5)])
    .footer("After Kosmas & Vlachos, Fig. 4.")
}
