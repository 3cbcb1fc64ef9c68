//! Two billiards: the section of an integrable one and of a chaotic one.
//!
//! Between impacts a particle is free, and steps of any length follow its straight path. What is computed is
//! where and when the path meets the curve, within each step. In an ellipse the product of the angular
//! momenta about the foci is a constant of the motion, so that each orbit has a curve in the section
//! (Birkhoff 1927). In the curve x⁴ + y⁴ = 1 some orbits fill regions of it.

use crate::vocabulary::*;

const ELLIPSE: EllipseBilliard = EllipseBilliard { a: 1.25, b: 0.8 };
/// The length of the steps; the particle has speed 1, and crosses the curves in about twenty.
const H: f64 = 0.1;
/// Steps in which there are several impacts.
const LONG: f64 = 5.0;
/// The number of orbits, from points on the x axis upwards to the right.
const ORBITS: u32 = 14;
/// More points than these make figures larger, and no clearer.
const SHOWN: usize = 3000;

#[derive(Default)]
struct Orbit {
    /// The polar angle of the first impacts, over π, and the velocity along the curve after them.
    section: Vec<[f64; 2]>,
    /// The largest |gap| at an impact.
    gap: f64,
    /// The largest |E − E(0)|, and the same of the product of the angular momenta about the foci.
    energy: f64,
    product: f64,
    in_a_step: usize,
}

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let impacts = job.choose(100_000, 500);
    job.expect(3 * u64::from(ORBITS) * impacts);
    let [ellipse, long] = each([H, LONG], |h| {
        orbits(|start| {
            let run = Integrator::new(&ELLIPSE, trapezoid(Collision::Reflection), h, start)?;
            let [a2, b2] = [ELLIPSE.a, ELLIPSE.b].map(|half| half * half);
            let curve = |x, y| (1.0 - x * x / a2 - y * y / b2, [-2.0 * x / a2, -2.0 * y / b2]);
            Orbit::of(job, run, impacts, curve)
        })
    })?;
    let square = orbits(|EllipseBilliardState { x, y, dot_x, dot_y }| {
        let start = RoundedSquareBilliardState { x: x / ELLIPSE.a, y, dot_x, dot_y };
        let run = Integrator::new(&RoundedSquareBilliard, trapezoid(Collision::Reflection), H, start)?;
        let curve = |x: f64, y: f64| (1.0 - x.powi(4) - y.powi(4), [-4.0 * x.powi(3), -4.0 * y.powi(3)]);
        Orbit::of(job, run, impacts, curve)
    })?;
    let sections = [("ellipse", &ellipse), ("rounded square", &square)].into_iter();
    let sections = sections.flat_map(|(curve, orbits)| {
        let orbits = orbits.iter().enumerate();
        orbits.map(move |(k, orbit)| ([curve], [k as f64], orbit.section.iter().copied().take(300)))
    });
    job.publish(figure(&ellipse, &square), curve_table("curve,orbit,angle,velocity_along", sections))?;
    let text = format!(
        "{ORBITS} orbits in an ellipse keep the product of the angular momenta about its foci over 10⁵ \
         impacts, with steps of length {H} and with steps of length {LONG}, in which there are several"
    );
    let in_ellipse = beyond(text)
        .at_least("impacts of each orbit", job.only_full(impacts as f64), 1e5)
        .at_most("largest change of the product", most(&ellipse, |orbit| orbit.product), 1e-11)
        .at_most("the same by long steps", most(&long, |orbit| orbit.product), 1e-11)
        .at_least("the most impacts in a long step", most(&long, |orbit| orbit.in_a_step as f64), 3.0)
        .at_most("largest change of the energy", most(&ellipse, |orbit| orbit.energy), 1e-12)
        .at_most("largest |g| at an impact", most(&ellipse, |orbit| orbit.gap), 1e-14);
    let filled = job.only_full(most(&square, Orbit::filled));
    let text = "in x⁴ + y⁴ = 1 the energy is kept too, orbits of one energy fill a region of the section, \
                and the way back is the way there";
    let in_square = beyond(text)
        .at_most("largest change of the energy", most(&square, |orbit| orbit.energy), 1e-12)
        .at_most("largest |g| at an impact", most(&square, |orbit| orbit.gap), 1e-14)
        .at_least("squares of the section that one orbit visits", filled, 0.5)
        .at_most("the same in the ellipse", most(&ellipse, Orbit::filled), 0.3)
        .at_most("distance from the start after 12 impacts there and back", there_and_back()?, 1e-10);
    let text = "between impacts the discrete energy of a free particle is its energy, so that both laws of \
                impact give one orbit, over 1000 impacts in the ellipse";
    claims([in_ellipse, in_square, beyond(text).at_most("largest distance", laws()?, 1e-8)])
}

/// One for each place on the x axis at which it begins, with its velocity there.
fn orbits(of: impl Fn(EllipseBilliardState) -> Result<Orbit> + Sync + Send) -> Result<Vec<Orbit>> {
    (0..ORBITS).into_par_iter().map(|number| of(start(number))).collect()
}

fn start(number: u32) -> EllipseBilliardState {
    let part = (f64::from(number) + 0.5) / f64::from(ORBITS);
    let angle = 0.5 * PI * (1.0 - 0.6 * part);
    EllipseBilliardState { x: 0.95 * part * ELLIPSE.a, y: 0.0, dot_x: angle.cos(), dot_y: angle.sin() }
}

impl Orbit {
    /// In a curve that is where a function is zero, of which `curve` returns the value and the gradient.
    fn of<S: UnilateralLagrangian>(
        job: &Job<'_>,
        mut run: Integrator<&S, Bouncing>,
        impacts: u64,
        curve: impl Fn(f64, f64) -> (f64, [f64; 2]),
    ) -> Result<Self> {
        let (energy, product, mut orbit) = (run.energy(), run.momentum(0), Self::default());
        while run.memory().total() < impacts {
            run.advance()?;
            let of_step = run.memory().impacts();
            for impact in of_step {
                let ([x, y], [u, v]) = ([impact.q[0], impact.q[1]], [impact.v[0], impact.v[1]]);
                let (gap, normal) = curve(x, y);
                orbit.gap = larger(orbit.gap, gap.abs());
                if orbit.section.len() < SHOWN {
                    let along = (u * normal[1] - v * normal[0]) / normal[0].hypot(normal[1]) / u.hypot(v);
                    orbit.section.push([y.atan2(x) / PI, along]);
                }
            }
            orbit.in_a_step = orbit.in_a_step.max(of_step.len());
            orbit.energy = larger(orbit.energy, (run.energy() - energy).abs());
            if let (Some(now), Some(begin)) = (run.momentum(0), product) {
                orbit.product = larger(orbit.product, (now - begin).abs());
            }
            job.proceed(of_step.len() as u64);
        }
        Ok(orbit)
    }

    /// The part of the squares, twenty in each direction, that the points of the section visit.
    fn filled(&self) -> f64 {
        let place = |value: f64| (((value + 1.0) * 10.0) as usize).min(19);
        let mut visited = [false; 400];
        for &[angle, along] in &self.section {
            visited[20 * place(angle) + place(along)] = true;
        }
        visited.iter().filter(|&&is_visited| is_visited).count() as f64 / 400.0
    }
}

/// How far a particle in the square is from its start after twelve impacts and as many back.
fn there_and_back() -> Result<f64> {
    let start = RoundedSquareBilliardState { x: 0.3, y: 0.1, dot_x: 0.8, dot_y: 0.6 };
    let method = trapezoid(Collision::Variational);
    let mut run = Integrator::new(&RoundedSquareBilliard, method, H, start)?;
    while run.memory().total() < 12 {
        run.advance()?;
    }
    let RoundedSquareBilliardState { x, y, .. } = back(method, &run)?;
    Ok(distance([x, y], [start.x, start.y]))
}

/// The largest distance of two runs with the two laws of impact.
fn laws() -> Result<f64> {
    let begun = |collision| Ok(Integrator::new(&ELLIPSE, trapezoid(collision), H, start(3))?);
    let [mut one, mut other] = each([Collision::Variational, Collision::Reflection], begun)?;
    let mut largest = 0.0;
    while one.memory().total() < 1000 {
        one.advance()?;
        other.advance()?;
        largest = larger(largest, distance(place(&one), place(&other)));
    }
    Ok(largest)
}

fn figure(ellipse: &[Orbit], square: &[Orbit]) -> Figure {
    let panel = |title: String, orbits: &[Orbit]| {
        let angle = ("polar angle of the impact / π", [-1.0, 1.0]);
        let plane = Panel::linear(title, angle, ("velocity along the curve", [-1.0, 1.0]));
        plane.each(orbits.iter().enumerate(), |panel, (number, orbit)| {
            let colour = SEQUENCE[number * (SEQUENCE.len() - 1) / (ORBITS as usize - 1)];
            panel.dots(orbit.section.clone(), 0.7, colour)
        })
    };
    let left = panel(format!("Ellipse with half axes {} and {}", ELLIPSE.a, ELLIPSE.b), ellipse);
    let subtitle = "The first 3000 impacts of 14 orbits of speed 1, by where they begin on the *x* axis";
    let figure = Figure::of(subtitle).row(470.0, vec![left, panel("*x*⁴ + *y*⁴ = 1".into(), square)]);
    figure.sequence_key("centre", "edge")
}
