//! A disc that rolls upright on a plane, beside a sleigh on a blade: constraints of velocities.
//!
//! A step solves the discrete equations of Lagrange and d'Alembert (Cortés & Martínez 2001). It is
//! reversible, as the motion is, but neither is symplectic. So the energy of a step need not stay near that
//! of the beginning: it does in regular motions, which the reversal takes into themselves, and wanders in
//! others (Modin & Verdier 2020).

use super::disc_energy::{Errors, STARTS};
use super::rk4::rk4_up_to;
use super::sleigh::{H, STEPS, Sleigh, midpoint};
use crate::vocabulary::*;

const FREE: RollingDisc = RollingDisc { radius: 1.0, stiffness: [0.0; 2], field: [0.0; 2], gradient: 0.0 };
/// On springs that are the same in all directions, and on springs that are not, with a magnet.
pub const SPRINGS: RollingDisc = RollingDisc { stiffness: [1.0; 2], ..FREE };
pub const MAGNET: RollingDisc =
    RollingDisc { radius: 1.0, stiffness: [1.0, 1.7], field: [0.3, 0.1], gradient: 0.3 };
/// Where all discs begin, and the rates of θ and φ.
pub const PLACE: [f64; 2] = [0.5, 0.2];
pub const RATES: [f64; 2] = [1.2, 0.4];

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let (errors, sleigh) = (Errors::new(job)?, Sleigh::new()?);
    job.publish(figure(&errors, &sleigh)?, errors.table()?)?;
    let [springs, magnet] = errors.claims(job);
    let undone = there_and_back(&MAGNET, midpoint(), H, &begin(&MAGNET), 200)?;
    let of_disc = "disc with a magnet, 200 steps: largest difference from the start";
    Ok(vec![
        free(job)?,
        order_of_places(&sleigh)?,
        beyond(format!("steps are undone by as many steps of length −{H}"))
            .at_most(of_disc, undone, 1e-12)
            .at_most("sleigh: largest difference from the start", Sleigh::undone()?, 1e-12),
        springs,
        magnet,
        sleigh.claim(),
    ]
    .into())
}

fn begin(disc: &RollingDisc) -> RollingDiscState {
    disc.rolling(PLACE, 0.3, RATES)
}

/// Where a free disc is: on a circle of radius Rθ̇/φ̇.
fn on_circle(t: f64) -> [f64; 2] {
    let RollingDiscState { x, y, phi, dot_theta, dot_phi, .. } = begin(&FREE);
    let (radius, after) = (FREE.radius * dot_theta / dot_phi, phi + dot_phi * t);
    [x + radius * (after.sin() - phi.sin()), y - radius * (after.cos() - phi.cos())]
}

/// A run without a potential.
fn free(job: &Job<'_>) -> Result<Claim> {
    let steps: u64 = job.choose(100_000, 2_000);
    let mut run = Integrator::new(&FREE, midpoint(), H, begin(&FREE))?;
    let (energy, [rolling, turning], mut across) = (run.energy(), momenta(&run), 0.0);
    job.expect(steps);
    let [energy, rolling, turning] = job.keep(&mut run, steps, Span::of(steps, H, 0), |run| {
        let RollingDiscState { phi, dot_x, dot_y, dot_theta, .. } = run.state();
        let speed = FREE.radius * dot_theta;
        // |ẋ − Rθ̇ cos φ| and |ẏ − Rθ̇ sin φ|
        across = largest([across, (dot_x - speed * phi.cos()).abs(), (dot_y - speed * phi.sin()).abs()]);
        let now: [f64; 2] = momenta(run);
        [run.energy() / energy, now[0] / rolling, now[1] / turning].map(|ratio| ratio - 1.0)
    })?;
    let text = format!(
        "without a potential, h = {H}: energy and momenta are kept to rounding, which grows with the angle θ"
    );
    Ok(beyond(text)
        .at_least("θ at the end", job.only_full(run.state().theta), 1e4)
        .at_most("largest |E/E(0) − 1|", energy.largest, 5e-11)
        .at_most("largest relative change of the momentum of rolling", rolling.largest, 3e-11)
        .at_most("largest relative change of the momentum of turning", turning.largest, 1e-13)
        .at_most("largest velocity against the constraints", across, 1e-15))
}

fn order_of_places(sleigh: &Sleigh) -> Result<Claim> {
    // With a magnet, by RK4.
    let [fine, double] = [0.00125, 0.0025].map(|h| {
        let [x, y, ..] = rk4_up_to(begin(&MAGNET).reduced(), 8.0, h, |y| MAGNET.reduced(y));
        [x, y]
    });
    // The same steps as those of the sleigh.
    let counts = STEPS.map(|h| (8.0 / h).round() as u64);
    let order = |disc: &RollingDisc, [x, y]: [f64; 2]| {
        order_at(disc, midpoint(), &begin(disc), 8.0, counts, |q| distance([q[0], q[1]], [x, y]))
    };
    let composed = order_at(&MAGNET, Composition::suzuki(midpoint()), &begin(&MAGNET), 8.0, counts, |q| {
        distance([q[0], q[1]], fine)
    })?;
    let text = "places are of second order: against the circle of a free disc, and against RK4 on equations \
                without constraints";
    Ok(beyond(text)
        .at_most("distance of two references with a magnet", distance(fine, double), 1e-9)
        .near("free disc: order at t = 8", order(&FREE, on_circle(8.0))?, [2.0, 0.01])
        .near("disc with a magnet: order at t = 8", order(&MAGNET, fine)?, [2.0, 0.05])
        .near("the same by Suzuki's composition: order", composed, [4.0, 0.1])
        .near("sleigh: order when it has turned", sleigh.order(), [2.0, 0.05]))
}

/// The places of a disc, in the plane.
fn path(title: &str, disc: &RollingDisc, colour: Colour) -> Result<Panel> {
    let mut run = Integrator::new(disc, midpoint(), H, begin(disc))?;
    let path = course(&mut run, (60.0 / H).round() as u64, place)?;
    Ok(Panel::plane(title, "*x*", "*y*").line(path, Stroke::solid(colour).width(1.2)))
}

fn figure(errors: &Errors, sleigh: &Sleigh) -> Result<Figure> {
    let exact = (0..=400).map(|i| on_circle(f64::from(i) * 0.04)).collect();
    let mut run = Integrator::new(&FREE, midpoint(), H, begin(&FREE))?;
    let places = course(&mut run, (16.0 / H).round() as u64, place)?;
    let free = Panel::new("Free", Axis::linear("*x*"), Axis::linear("*y*").within(-1.0, 9.0))
        .equal()
        .line(exact, Stroke::solid(SLATE).width(1.2))
        .labelled("circle")
        .dots(places.into_iter().step_by(4).collect(), 2.2, GREEN)
        .labelled("every 4th step");
    let [slid, turning] = sleigh.panels();
    let (springs, magnet) =
        (path("On equal springs", &SPRINGS, BLUE)?, path("With a magnet", &MAGNET, VERMILLION)?);
    let subtitle = format!(
        "Midpoint rule, *h* = {H}. Above: the points of contact. Energy: the mean over {STARTS} starts of \
         the largest |*E* − *E*(0)| up to time *t*."
    );
    let figure = Figure::of(subtitle).row(320.0, vec![free, springs, magnet, slid]);
    Ok(figure.row(330.0, vec![errors.panel(), turning]))
}
