//! Kosmas & Vlachos, Fig. 3: energy and position over 10⁵ periods of an orbit with e = 0.95.
//!
//! The paper's method has the frequency (19) left-frozen and steps by (23). As printed, (23) mixes lengths
//! and times, and the orbit is lost; per unit of arc length it locks in to the motion, and the energy error
//! stays what it is. With reversible steps the method, which is neither symplectic nor reversible, drifts.
//! Beside it stand a frequency that is a part of the discrete Lagrangian, with reversible steps, and Verlet.

use super::kepler::{Course, KeplerRun, follow, osculating, per_arc_length, reversible};
use crate::vocabulary::*;

const ORBIT: Orbit = Orbit { e: 0.95 };
/// The parameter of the reversible step control.
const EPSILON: f64 = 0.02;
/// The tolerance of (23) as printed; at 0.03 the orbit soon breaks up.
const TOLERANCE: f64 = 0.01;
/// After so many periods of steps by (23) as printed there is nothing left of the orbit.
const LOST: u64 = 1000;

/// In the order of their curves, with what a period of each costs, as the progress counts it.
const CONTENDERS: [(&str, Colour, u64); 6] = [
    ("Verlet, reversible steps", SLATE, 3),
    ("left-frozen (19), (23) as printed", AMBER, 4),
    ("left-frozen (19), reversible steps", GREEN, 6),
    ("left-frozen (19), (23) per arc, 10⁻⁵", SKY, 31),
    ("left-frozen (19), (23) per arc, 3·10⁻⁶", BLUE, 57),
    ("√(|*q*''|/|*q*|) in *L*_d, reversible steps", VERMILLION, 14),
];

struct Orbits {
    /// The time in periods, |E − E(0)|, and the position error.
    errors: Decades<3>,
    course: Course,
    /// E − E(0), of which the beginning are 100 periods, and 300.
    energy: [Envelope; 2],
    failure: Option<anyhow::Error>,
}

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let periods = job.choose(100_000, 320);
    let many = |contender: usize| if contender == 1 { periods.min(LOST) } else { periods };
    job.expect((0..6).map(|contender| CONTENDERS[contender].2 * many(contender)).sum());
    let frozen = Variational::simpson().phase_fitted(Curvature(Reading::LeftFrozen));
    let lobatto = Variational::new(Quadrature::lobatto(4)?).phase_fitted(Radial(Reading::Variational));
    // Two threads take a half each, in its order. The first begins with this experiment, the second with all
    // others, and so both end at about the same time.
    let [fine, printed, frozen, coarse, lobatto, verlet] = side_by_side([4, 1, 2, 3, 5, 0], |contender| {
        let (periods, cost) = (many(contender), CONTENDERS[contender].2);
        Ok(match contender {
            0 => Orbits::of(job, reversible(Variational::trapezoid(), ORBIT, EPSILON)?, periods, cost),
            1 => Orbits::of(job, osculating(frozen, ORBIT, TOLERANCE)?, periods, cost),
            2 => Orbits::of(job, reversible(frozen, ORBIT, EPSILON)?, periods, cost),
            3 => Orbits::of(job, per_arc_length(frozen, ORBIT, 1e-5)?, periods, cost),
            4 => Orbits::of(job, per_arc_length(frozen, ORBIT, 3e-6)?, periods, cost),
            _ => Orbits::of(job, reversible(lobatto, ORBIT, EPSILON)?, periods, cost),
        })
    })?;
    let all = [verlet, printed, frozen, coarse, fine, lobatto];
    let curves = all.iter().zip(CONTENDERS);
    let curves = curves.map(|(orbits, (name, ..))| ([name], [], orbits.errors.rows.iter().map(|row| row.1)));
    job.publish(figure(&all, periods), curve_table("method,periods,energy_error,position_error", curves))?;
    Ok(Outcome { claims: claims(job, &all), references: references(job, &all), notes: notes(&all) })
}

impl Orbits {
    /// Each period counts as `cost` units of progress.
    fn of(job: &Job<'_>, mut run: impl KeplerRun, periods: u64, cost: u64) -> Self {
        let mut energy = [100.0, 300.0].map(|early| Envelope::new(periods as f64, 1, early));
        let (mut errors, mut position, mut whole) = (Decades::new(40.0), 0.0f64, 1.0);
        let mut phase = Phase::default();
        let ended = follow(job, &mut run, periods, |(t, change, q)| {
            let (time, error) = (t / TAU, ORBIT.error_after(&mut phase, t, &q));
            // The end of the run belongs to the interval before it.
            errors.push(time.max(0.1).min((1.0 - 1e-7) * periods as f64), [time, change.abs(), error]);
            // `follow` itself counts one for each period.
            if time >= whole {
                whole += 1.0;
                job.proceed(cost - 1);
            }
            note(&mut energy, time, [change; 2]);
            position = larger(position, error);
        });
        let (course, failure) = match ended {
            Ok(course) => (course, None),
            Err(failure) => (Course { energy: energy[1].largest, ..Course::default() }, Some(failure)),
        };
        Self { errors, course: Course { position, ..course }, energy, failure }
    }
}

fn claims(job: &Job<'_>, [verlet, printed, frozen, coarse, fine, lobatto]: &[Orbits; 6]) -> Vec<Claim> {
    let growth = "max|ΔE| over all / over 300 periods";
    let lasting = |orbits: &Orbits| job.only_full(orbits.energy[1].growth());
    let saturates = |orbits: &Orbits| job.only_full(orbits.course.position);
    let position = "(23) per arc length, 3e-6: largest position error, in a";
    let lost = job.only_full(printed.course.energy);
    let smaller = lobatto.course.energy / fine.course.energy;
    let limits = "over many periods the energy error keeps in stable limits, left-frozen with steps by (23)";
    let drifts =
        "with (23) as printed the orbit is lost, and with reversible steps the left-frozen method drifts";
    vec![
        says("Fig. 3", limits).of("(23) per arc length, 3e-6").at_most(growth, lasting(fine), 1.001),
        says("Fig. 3", "the position error keeps in stable limits")
            .at_most(position, saturates(fine), 0.1)
            .instead("it grows until it is the size of the orbit")
            .within(position, saturates(fine), [1.0, 2.1])
            // Its orbit turns: two points of two such orbits are up to twice the aphelion distance apart.
            .within("(23) per arc length, 1e-5: the same", saturates(coarse), [1.0, 3.9]),
        beyond(drifts)
            .at_least("(23) as printed: max|ΔE| within 1000 periods, in μ/a", lost, 0.5)
            .of("reversible steps")
            .at_least(growth, lasting(frozen), 10.0),
        beyond("variational and reversible, phase fitting keeps the energy without drift, at fewer steps")
            .at_most(format!("Lobatto-4: {growth}"), lobatto.energy[1].growth(), 1.001)
            .at_most("max|ΔE|, Lobatto-4 / left-frozen with (23) per arc length, 3e-6", smaller, 1e-3)
            .at_most("steps per period, Lobatto-4 / the same", lobatto.course.steps / fine.course.steps, 0.1)
            .at_most(format!("Verlet: {growth}"), verlet.energy[1].growth(), 1.001),
    ]
}

/// Numbers of independent programs; with steps by (23) of this program: rounding decides where they lock in,
/// and other orders of sums have given 2.5619e-4 and 3.7736e-4 at 3e-6, and 8.428e-3 at 1e-5.
fn references(job: &Job<'_>, [verlet, _, _, coarse, fine, lobatto]: &[Orbits; 6]) -> Vec<Check> {
    let [largest, steps] = [job.only_full(coarse.course.energy), Some(fine.course.steps)];
    let [early, of_verlet] = [lobatto, verlet].map(|orbits| orbits.energy[0].largest_early);
    let of_coarse = "(23) per arc length, 1e-5: max|ΔE| over 10⁵ periods";
    vec![
        Check::new("Lobatto-4: max|ΔE| over 100 periods", early, Bound::Within(9.4e-8, 9.6e-8)),
        Check::new("Lobatto-4: max|ΔE| over all", lobatto.course.energy, Bound::AtMost(1e-7)),
        Check::new("Lobatto-4: steps per period", lobatto.course.steps, Bound::Within(460.0, 468.0)),
        Check::new("Verlet: max|ΔE| over 100 periods", of_verlet, Bound::Near(1.542e-3, 1e-6)),
        Check::new("(23) per arc length, 3e-6: max|ΔE|", fine.course.energy, Bound::Near(1.8193e-4, 2e-8)),
        Check::new("(23) per arc length, 3e-6: steps per period", steps, Bound::Near(5708.0, 3.0)),
        Check::new(of_coarse, largest, Bound::Near(8.4354e-3, 1e-6)),
    ]
}

fn notes(all: &[Orbits; 6]) -> Vec<String> {
    let line = |(orbits, (name, ..)): (&Orbits, (&str, Colour, u64))| {
        let (name, course) = (name.replace('*', ""), &orbits.course);
        // The time of the last step.
        let last = orbits.errors.rows.last().map_or(0.0, |(_, row)| row[0]);
        match &orbits.failure {
            Some(error) => format!("{name}: ended after {last:.0} periods, {error}."),
            None => format!(
                "{name}: {:.0} steps and {:.0} evaluations per period; max|ΔE| {:.3e} over the first \
                 300 periods, {:.3e} over {last:.0}; position error up to {:.3}.",
                course.steps,
                course.evaluations,
                orbits.energy[1].largest_early,
                course.energy,
                course.position
            ),
        }
    };
    all.iter().zip(CONTENDERS).map(line).collect()
}

fn figure(all: &[Orbits; 6], periods: u64) -> Figure {
    let end = periods as f64;
    let panel = |title: &str, label: &str, column: usize| {
        let lines = all.iter().zip(CONTENDERS).map(|(orbits, (name, colour, _))| {
            let points = orbits.errors.rows.iter().map(|(_, row)| [row[0], row[column]]).collect();
            (name, solid(colour).width(1.6), points)
        });
        Panel::loglog(title, ("time *t*   [periods]", [0.1, end]), (label, [1e-8, 10.0])).lines(lines)
    };
    let position = panel("Position", "largest distance from the exact position   [*a*]", 2)
        .guide([[0.1, 2.0], [end, 2.0]], "the diameter of the orbit");
    Figure::of("Left-frozen: Simpson's rule; in *L*_d: Lobatto's with four nodes. (23) with its tolerance")
        .row_with_legend(470.0, vec![panel("Energy", "largest |*E* − *E*(0)|   [μ/*a*]", 1), position], 1.45)
        .footer("After Kosmas & Vlachos, Fig. 3.")
}
