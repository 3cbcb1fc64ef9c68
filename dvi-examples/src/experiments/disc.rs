//! A disc that rolls upright on a plane, beside a sleigh on a blade: constraints of velocities.
//!
//! A step solves the discrete equations of Lagrange and d'Alembert (Cortés & Martínez 2001). It is
//! reversible, as the motion is, but neither is symplectic. So the energy of a step need not stay near that
//! of the beginning: it does in regular motions, which the reversal takes into themselves, and wanders in
//! others (Modin & Verdier 2020).

use super::disc_energy::{Errors, STARTS};
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
    job.publish(figure(&errors, &sleigh)?, errors.table())?;
    let [springs, magnet] = errors.claims(job);
    let undone = Problem::new(&MAGNET, begin(&MAGNET)).there_and_back(midpoint(), H, 200)?;
    claims([
        free(job)?,
        order_of_places(&sleigh)?,
        beyond(format!("steps are undone by as many steps of length −{H}"))
            .at_most("disc with a magnet, 200 steps: largest difference from the start", undone, 1e-12)
            .at_most("sleigh: largest difference from the start", Sleigh::undone()?, 1e-12),
        springs,
        magnet,
        sleigh.claim(),
    ])
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

fn free(job: &Job<'_>) -> Result<Claim> {
    let steps: u64 = job.choose(100_000, 2_000);
    let mut run = Problem::new(&FREE, begin(&FREE)).run(midpoint(), H)?;
    let (energy, [rolling, turning], mut across) = (run.energy(), momenta(&run), 0.0);
    job.expect(steps);
    let series = job.series(("free disc", solid(GREEN)), &mut run, Span::of(steps, H, 0), |run, _| {
        let RollingDiscState { phi, dot_x, dot_y, dot_theta, .. } = run.state();
        let speed = FREE.radius * dot_theta;
        // |ẋ − Rθ̇ cos φ| and |ẏ − Rθ̇ sin φ|
        across = largest([across, (dot_x - speed * phi.cos()).abs(), (dot_y - speed * phi.sin()).abs()]);
        let now: [f64; 2] = momenta(run);
        [run.energy() / energy, now[0] / rolling, now[1] / turning].map(|ratio| ratio - 1.0)
    });
    let [energy, rolling, turning] = series.whole()?.kept;
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
    let [fine, double] = each([0.00125, 0.0025], |h| {
        let end = Accelerations::new(&MAGNET, h, &begin(&MAGNET))?.up_to(8.0)?;
        Ok([end.x, end.y])
    })?;
    // The same steps as those of the sleigh.
    let counts = STEPS.map(|h| (8.0 / h).round() as u64);
    let [free, magnet] = [(&FREE, on_circle(8.0)), (&MAGNET, fine)].map(|(disc, place)| {
        Problem::new(disc, begin(disc)).errors(8.0, &counts, move |q| distance([q[0], q[1]], place))
    });
    let composed = magnet.order(Composition::suzuki(midpoint()))?;
    let text = "places are of second order: against the circle of a free disc, and against RK4 on equations \
                without constraints";
    Ok(beyond(text)
        .at_most("distance of two references with a magnet", distance(fine, double), 1e-9)
        .near("free disc: order at t = 8", free.order(midpoint())?, [2.0, 0.01])
        .near("disc with a magnet: order at t = 8", magnet.order(midpoint())?, [2.0, 0.05])
        .near("the same by Suzuki's composition: order", composed, [4.0, 0.1])
        .near("sleigh: order when it has turned", sleigh.order(), [2.0, 0.05]))
}

fn places(disc: &RollingDisc, end: f64) -> Result<Points> {
    let mut run = Problem::new(disc, begin(disc)).run(midpoint(), H)?;
    Ok(course(&mut run, (end / H).round() as u64, place)?)
}

fn figure(errors: &Errors, sleigh: &Sleigh) -> Result<Figure> {
    let exact = (0..=400).map(|i| on_circle(f64::from(i) * 0.04)).collect();
    let free = Panel::new("Free", Axis::linear("*x*"), Axis::linear("*y*").within([-1.0, 9.0]))
        .equal()
        .lines([("circle", solid(SLATE).width(1.2), exact)])
        .dots(places(&FREE, 16.0)?.into_iter().step_by(4).collect(), 2.2, GREEN)
        .labelled("every 4th step");
    let [slid, turning] = sleigh.panels();
    let path = |title, disc, colour| -> Result<Panel> {
        Ok(Panel::plane(title, "*x*", "*y*").line(places(disc, 60.0)?, solid(colour).width(1.2)))
    };
    let springs = path("On equal springs", &SPRINGS, BLUE)?;
    let magnet = path("With a magnet", &MAGNET, VERMILLION)?;
    let subtitle = format!(
        "Midpoint rule, *h* = {H}. Above: the points of contact. Energy: the mean over {STARTS} starts of \
         the largest |*E* − *E*(0)| up to time *t*."
    );
    let figure = Figure::of(subtitle).row(320.0, vec![free, springs, magnet, slid]);
    Ok(figure.row(330.0, vec![errors.panel(), turning]))
}
