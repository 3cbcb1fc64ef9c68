//! A free body that turns about its middle axis and flips, by rotation matrices: against elliptic functions,
//! and its angular momentum.
//!
//! Steps along geodesics keep the angular momentum in space, as the motion does.

use super::flips::{BODY, Flips, OMEGA, Wave, begin};
use super::geodesics::*;
use crate::vocabulary::*;

/// The step of the long runs, and of what is drawn.
const H: f64 = 0.05;
/// The steps with which flips are timed and the order is measured, the longest first.
const STEPS: [f64; 3] = [0.1, 0.05, 0.025];
const DRAWN: f64 = 80.0;
/// Angular velocities of the curves that are drawn, around the first axis and around the third.
#[rustfmt::skip]
const AROUND: [[f64; 3]; 6] = [
    [2.0, 0.4, 0.0], [1.8, 0.65, 0.0], [1.3, 0.85, 0.0],
    [0.0, 0.4, 0.6], [0.0, 0.65, 0.5], [0.0, 0.85, 0.3],
];
/// From where the sphere is seen: the angle about the third axis, and that above the plane of the others.
const VIEW: [f64; 2] = [1.05, 0.42];

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let long = Long { job, steps: job.choose(1_000_000, 5_000), every: 4, h: H };
    job.expect(2 * long.steps / long.every);
    let (wave, start) = (Wave::new(&BODY, OMEGA), begin());
    let before = BODY.momentum_at(&start);
    let first = rotations::apply(&start.R, before);
    let energy = |state: &RigidBodyState| BODY.energy(&state.R, &velocities(state.omega_R), 0.0);
    // E − E(0), |M − M(0)|/|M| in space, max |RᵀR − 1|, and the relative change of |M| in the body.
    let kept = |state: &RigidBodyState| {
        let now = BODY.momentum_at(state);
        let away = length(difference(rotations::apply(&state.R, now), first)) / length(first);
        let change = energy(state) - energy(&start);
        [change, away, rotations::defect(&state.R), length(now) / length(before) - 1.0]
    };
    let all = long.both("geodesics", BODY, &start, kept)?;
    let flips = each(STEPS, |h| Flips::new(&wave, h, job.choose(20.0, 1.5)))?;
    let columns = "method,t,largest_energy_error,largest_change_of_momentum,largest_defect";
    job.publish(figure(&all, &wave, long)?, magnitude_table(columns, &all))?;
    let [rk4, geodesics] = all.each_ref().map(|series| &series.kept);
    let ([_, space, defect, body], walk) = (geodesics, long.random_walk());
    let keeps = "a free body keeps its angular momentum in space, in length and in direction, up to errors \
                 no larger than a unit of rounding times the square root of the number of steps; the one in \
                 the body keeps its length, and matrices are orthogonal to a few units of rounding";
    let in_time = "a free body that turns about its middle axis flips with the period of the elliptic \
                   functions, up to an error of the order h² that is less than h² of it";
    let away = |flips: &Flips| flips.period / wave.period() - 1.0;
    let [long_step, step, fine] = &flips;
    let over_square = away(fine).abs() / (fine.h * fine.h);
    let second = order(flips.iter().map(|flips| (flips.h, flips.error)));
    let flat = "the energy error of a free body has no trend, and is that of the closed form all the time";
    let loses = "RK4 on the entries of the matrix loses the angular momentum, the rotation and the energy \
                in proportion to the time, but the energy by so little that its error is the smaller one \
                all that time";
    let [of_energy, of_space, of_defect, of_body] = rk4.each_ref().map(|kept| job.only_full(kept.largest));
    let [trend, of_energy_trend] = [&rk4[2], &rk4[0]].map(|kept| job.only_full(kept.trend()));
    let far = |kept: usize| 1e6 * geodesics[kept].largest;
    claims([
        beyond(keeps)
            .at_least("steps", job.only_full(long.steps as f64), 1e6)
            .at_most("geodesics: largest |M − M(0)|/|M| in space", space.largest, walk)
            .at_most("geodesics: largest relative change of |M| in the body", body.largest, walk)
            .at_most("geodesics: max|RᵀR − 1|", defect.largest, FEW_UNITS),
        beyond(in_time)
            .at_least("flips", job.only_full(f64::from(fine.count)), 38.0)
            .at_most("h = 0.025: relative error of the period / h²", over_square, 1.0)
            .near("error of the period, h = 0.1 over h = 0.05", away(long_step) / away(step), [4.0, 0.1])
            .near("error of the period, h = 0.05 over h = 0.025", away(step) / away(fine), [4.0, 0.1])
            .near("ω₂ against sn over a period: order", second, [2.0, 0.05]),
        // The largest that h²g makes of it, by the run with the same step.
        long.flat_energy(beyond(flat), "geodesics", &geodesics[0], flips[1].energy.predicted),
        shadow_claim("free body", &flips.map(|flips| flips.energy)),
        beyond(loses)
            .at_least("RK4: largest |M − M(0)|/|M| in space", of_space, far(1))
            .at_least("RK4: largest relative change of |M| in the body", of_body, far(3))
            .at_least("RK4: max|RᵀR − 1|", of_defect, far(2))
            .near("RK4: max|RᵀR − 1|, last tenth of the time over the first", trend, [10.0, 1.0])
            .at_most("RK4: max|ΔE|", of_energy, geodesics[0].largest)
            .near("RK4: max|ΔE|, last tenth of the time over the first", of_energy_trend, [10.0, 1.0]),
        order_claim("a free body", (BODY, start), STEPS, [4.0, 2e-3])?,
    ])
}

fn states(omega: [f64; 3], h: f64, end: f64) -> Result<Vec<RigidBodyState>> {
    let mut run = Problem::new(&BODY, RigidBody::turning(omega)).run(Geodesic::trapezoid(), h)?;
    Ok(course(&mut run, (end / h).round() as u64, |run| run.state())?)
}

/// Right and up in the picture, and towards the eye.
fn seen([x, y, z]: [f64; 3]) -> [f64; 3] {
    let [turn, tilt] = VIEW;
    let (right, ahead) = (y * turn.cos() - x * turn.sin(), x * turn.cos() + y * turn.sin());
    [right, z * tilt.cos() - ahead * tilt.sin(), ahead * tilt.cos() + z * tilt.sin()]
}

/// The directions of the angular momentum in the body, as far as they are in front.
fn front(states: &[RigidBodyState]) -> Vec<[f64; 2]> {
    let visible = |[x, y, towards]: [f64; 3]| if towards > 0.0 { [x, y] } else { [f64::NAN; 2] };
    let direction = |momentum: [f64; 3]| momentum.map(|x| x / length(momentum));
    states.iter().map(|state| visible(seen(direction(BODY.momentum_at(state))))).collect()
}

fn sphere(flipping: &[RigidBodyState]) -> Result<Panel> {
    let axis = ("", [-1.15, 1.15]);
    let mut panel = Panel::window("Angular momentum in the body", axis, axis)
        .line(circle([0.0; 2], 1.0), solid(SLATE).width(1.0));
    for (k, omega) in AROUND.into_iter().enumerate() {
        let colour = if k < AROUND.len() / 2 { BLUE } else { GREEN };
        for start in [omega, omega.map(|x| -x)] {
            // Once around, or a little more.
            let path = states(start, 2.0 * H, 22.0 / length(start))?;
            panel = panel.line(front(&path), solid(colour).width(1.2));
        }
    }
    let axes = [("1", [1.0, 0.0, 0.0]), ("2", [0.0, 1.0, 0.0]), ("3", [0.0, 0.0, 1.0])];
    Ok(panel.line(front(flipping), solid(VERMILLION)).each(axes, |panel, (name, end)| {
        let [x, y, _] = seen(end);
        panel.dots(vec![[x, y]], 3.0, SLATE).note([x + 0.05, y - 0.1], Anchor::Start, SLATE, name)
    }))
}

fn figure(all: &[Series<4>; 2], wave: &Wave, long: Long<'_>) -> Result<Figure> {
    let flipping = states(OMEGA, H, DRAWN)?;
    let exact = (0..=1600).map(|k| DRAWN * f64::from(k) / 1600.0).map(|t| [t, wave.at(t)]).collect();
    let steps = flipping.iter().enumerate().step_by(20).map(|(k, state)| [k as f64 * H, state.omega_R[1]]);
    let title = "The middle component of the angular velocity";
    let middle = Panel::linear(title, ("time *t*", [0.0, DRAWN]), ("*ω*₂", [-1.2, 1.5]))
        .lines([("elliptic function", solid(SLATE).width(1.2), exact)])
        .dots(steps.collect(), 2.4, PURPLE)
        .labelled("every 20th step")
        .weight(1.7);
    let quantities = [
        (0, ["Energy", "largest |*E* − *E*(0)|"], [1e-10, 1e-1]),
        (1, ["Angular momentum in space", "|*M* − *M*(0)| / |*M*|"], [1e-17, 10.0]),
        (2, ["Orthogonality", "max |*R*ᵀ*R* − 1|"], [1e-17, 10.0]),
    ];
    let subtitle = "Moments of inertia 1, 2 and 3; it begins with *ω* = (0, 1, 0.02). The sphere shows \
                    directions of the angular momentum in the body, with the curve that flips in red.";
    let figure = Figure::of(subtitle).row(400.0, vec![sphere(&flipping)?, middle]);
    Ok(figure.row(300.0, long.panels(all, &quantities)))
}
