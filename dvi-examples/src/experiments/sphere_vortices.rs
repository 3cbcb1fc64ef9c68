//! Point vortices on a sphere: a one-form along the longitudes only, which is in the class of one-step
//! schemes and not affine.
//!
//! A pair turns around its moment M = ΣΓr with the rate |M|/2πl², where l is its distance, and a ring of n
//! equal vortices at height z around the axis with the rate Γ(n − 1)z/4π(1 − z²) (Polvani & Dritschel 1993).
//! M is conserved. In coordinates along an axis a scheme is symmetric about that axis only: the component
//! along it is kept, and M turns slowly around it. In unit vectors no axis is better than another.

use crate::vocabulary::*;

/// Three vortices whose moment is not along the axis of the coordinates.
const THREE: SphereVortices<3> = SphereVortices { gamma: [1.0, 1.5, 2.0] };
const PLACES: [[f64; 3]; 3] = [[0.9, 0.2, 0.5], [-0.4, 0.8, 0.3], [-0.5, -0.7, 0.7]];
const H: f64 = 0.5;
const EARLY: u64 = 4000;

/// E − E(0), |M| over its value at the start less 1, by what angle M has turned around the axis of the
/// coordinates, and (M_z − M_z(0))/|M|; its path has the places of the three one after the other.
type Kept = Series<4>;

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let steps = job.choose(400_000, 20_000);
    job.expect(3 * steps);
    let (three, span) = (three(), Span { intervals: 100, ..Span::of(steps, H, EARLY) });
    let runs = [
        (("one step, midpoint", solid(BLUE)), three.any(OneStep::midpoint(), H)?),
        (("one step, Gauss of order 4", solid(SKY)), three.any(OneStepGauss::<2>::new(), H)?),
        (("RK4", dashed(VERMILLION)), three.any(RungeKutta::classical(), H)?),
    ];
    let all = each(runs, |(named, mut run)| {
        let of_three = |run: &AnyRun<'_, _>| moment(THREE.gamma, THREE.places(run.q()));
        let (energy, start) = (run.energy(), of_three(&run));
        let (mut before, mut turned) = (start, 0.0);
        job.series(named, &mut run, span, |run, path| {
            let moment = of_three(run);
            if run.steps() <= 400 {
                path.extend(THREE.places(run.q()).map(|[x, y, _]| [x, y]));
            }
            turned += angle(before, moment);
            before = moment;
            let axial = (moment[2] - start[2]) / length(start);
            [run.energy() - energy, length(moment) / length(start) - 1.0, turned, axial]
        })
        .whole()
    })?;
    let table = range_table("method,quantity,t", &["ΔH", "Δ|M|/|M|", "angle of M"], &all);
    job.publish(figure(&all, span.end), table)?;
    claims([keep(&all), precession()?, pair()?, ring()?, vectors()?])
}

fn three() -> Problem<'static, SphereVortices<3>> {
    Problem::new(&THREE, SphereVortices::state(PLACES))
}

fn moment<const N: usize>(gamma: [f64; N], places: [[f64; 3]; N]) -> [f64; 3] {
    std::array::from_fn(|i| gamma.iter().zip(places).map(|(gamma, place)| gamma * place[i]).sum())
}

/// The moment of a pair, and the rate at which the pair turns around it.
fn turning(gamma: [f64; 2], places: [[f64; 3]; 2]) -> ([f64; 3], f64) {
    let moment = moment(gamma, places);
    (moment, length(moment) / (TAU * length(difference(places[0], places[1])).powi(2)))
}

/// By what angle a vector has turned around the z axis, less than half a turn.
fn angle(before: [f64; 3], [x, y, _]: [f64; 3]) -> f64 {
    (y.atan2(x) - before[1].atan2(before[0]) + PI).rem_euclid(TAU) - PI
}

fn keep(all: &[Kept; 3]) -> Claim {
    let text = "energy and length of the moment are no further off in the whole run than in its beginning, \
                and the moment along the axis is kept to rounding errors";
    beyond(text)
        .each(&all[..2], |claim, Series { name, kept: [energy, moment, _, axial], .. }| {
            let of = |quantity: &str| format!("max|Δ{quantity}| over all / over {EARLY} steps");
            let claim = claim.of(name).at_most(of("H"), energy.growth(), 1.05);
            claim.at_most(of("|M|"), moment.growth(), 1.05).at_most("max|ΔM_z|/|M|", axial.largest, 1e-10)
        })
        .at_least(format!("RK4: max|ΔH| over all / over {EARLY} steps"), all[2].kept[0].growth(), 4.0)
}

/// The angle by which M has turned at t = 400, over the step.
fn precession() -> Result<Claim> {
    let begin = three().run(OneStep::midpoint(), H)?;
    let of_three = |q: &[f64]| moment(THREE.gamma, THREE.places(q));
    let angle = |q: &[f64]| angle(of_three(begin.q()), of_three(q)).abs();
    let angles = three().errors(400.0, &[400, 600, 800], angle);
    let (midpoint, gauss) = (OneStep::midpoint(), OneStepGauss::<2>::new());
    let text = "the moment turns slowly around the axis of the coordinates, at a rate that falls with the \
                order of the scheme";
    Ok(beyond(text)
        .near("midpoint: order of the angle at t = 400", angles.order(midpoint)?, [2.0, 0.1])
        .near("Gauss of order 4: order of the angle at t = 400", angles.order(gauss)?, [4.0, 0.2]))
}

fn turned(v: [f64; 3], axis: [f64; 3], angle: f64) -> [f64; 3] {
    rotations::apply(&rotations::exp(axis.map(|x| angle * x / length(axis))), v)
}

/// The largest distance of a vortex from its place at the start, turned.
fn away<const N: usize>(ends: [[f64; 3]; N], starts: [[f64; 3]; N], axis: [f64; 3], angle: f64) -> f64 {
    largest(ends.into_iter().zip(starts).map(|(a, b)| length(difference(a, turned(b, axis, angle)))))
}

fn pair() -> Result<Claim> {
    let pair = SphereVortices { gamma: [1.0, 2.0] };
    let motion = Problem::new(&pair, SphereVortices::state([[0.8, 0.3, 0.2], [-0.3, 0.5, 0.6]]));
    let begin = motion.run(OneStep::midpoint(), H)?;
    let places = pair.places(begin.q());
    let (axis, rate) = turning(pair.gamma, places);
    let distance = |q: &[f64]| away(pair.places(q), places, axis, rate * 40.0);
    let errors = motion.errors(40.0, &[100, 150, 200], distance).of(OneStep::midpoint())?;
    Ok(beyond("a pair turns around its moment with the rate |M|/2πl², to the order of the scheme")
        .at_most("distance from that at t = 40, 200 steps", errors[2].1, 0.05)
        .near("order of it", order(errors), [2.0, 0.05]))
}

fn ring() -> Result<Claim> {
    let (z, radius, steps) = (0.7f64, (1.0 - 0.7f64 * 0.7).sqrt(), 100);
    let ring = SphereVortices { gamma: [1.0; 4] };
    let start = [0.0, 1.0, 2.0, 3.0].map(|j: f64| {
        let (sin, cos) = (TAU * j / 4.0).sin_cos();
        [radius * cos, radius * sin, z]
    });
    let rate = 3.0 * z / (4.0 * PI * (1.0 - z * z));
    let mut run = Problem::new(&ring, SphereVortices::state(start)).run(OneStep::midpoint(), H)?;
    run.take_steps(steps)?;
    let error = away(ring.places(run.q()), start, [0.0, 0.0, 1.0], rate * H * steps as f64);
    Ok(beyond("a ring of four vortices around the axis turns as it should, without error of the scheme")
        .at_most("distance from that after 100 steps of h = 0.5", error, 1e-11))
}

/// The three vortices, and a pair of which one begins at the pole.
fn vectors() -> Result<Claim> {
    let three = VortexVectors { gamma: THREE.gamma };
    let begin = PLACES.map(|place| place.map(|x| x / length(place)));
    let mut run = Problem::new(&three, (begin,)).run(Sigma::midpoint(), H)?;
    let of = |q: &[f64]| moment(three.gamma, three.places(q));
    let (start, mut moved, mut off) = (of(run.q()), 0.0_f64, 0.0_f64);
    for _ in 0..100 {
        run.take_steps(200)?;
        moved = moved.max(length(difference(of(run.q()), start)) / length(start));
        off = off.max(largest(three.places(run.q()).map(|r| (length(r) - 1.0).abs())));
    }
    let pair = VortexVectors { gamma: [1.0, 2.0] };
    let places = [[0.6, 0.0, 0.8], [0.0, 0.0, 1.0]];
    let (axis, rate) = turning(pair.gamma, places);
    let distance = |q: &[f64]| away(pair.places(q), places, axis, rate * 40.0);
    let errors = Problem::new(&pair, (places,)).errors(40.0, &[400, 600, 800], distance);
    let errors = errors.of(Sigma::midpoint())?;
    Ok(beyond("as unit vectors vortices keep all of the moment to rounding errors, and pass over the pole")
        .at_most("max|ΔM|/|M| of three in 20,000 steps", moved, 1e-12)
        .at_most("max||r| - 1|", off, 1e-12)
        .near("order of the place of a pair that begins at the pole", order(errors), [2.0, 0.05]))
}

fn figure(all: &[Kept; 3], end: f64) -> Figure {
    let lines = [BLUE, VERMILLION, GREEN].into_iter().zip(THREE.gamma).enumerate();
    let lines = lines.map(|(j, (colour, gamma))| {
        let path = all[0].path.iter().skip(j).step_by(3).copied().collect();
        (format!("Γ = {gamma}"), solid(colour).width(1.1), path)
    });
    let (x, y) = (("*x*", [-1.1, 1.1]), ("*y*", [-1.1, 1.75]));
    let seen = Panel::window("Paths, seen from above the pole", x, y)
        .line(circle([0.0; 2], 1.0), solid(SLATE).width(1.0))
        .lines(lines);
    let over_time = |title: &str, label: &str, quantity: usize| {
        Panel::new(title, Axis::time(end), Axis::logarithmic(label)).lines(magnitudes(all, quantity))
    };
    let energy = over_time("Error of the energy", "largest |Δ*H*| of each interval", 0);
    let moment = over_time("Length of the moment", "largest |Δ|*M*||/|*M*| of each interval", 1);
    let turn = over_time("Direction of the moment", "angle around the axis   [rad]", 2);
    Figure::of(format!("*h* = {H}; on the left the one-step midpoint scheme up to *t* = {}", 400.0 * H))
        .row(430.0, vec![seen, energy.weight(1.4).legend_at(Corner::Beside)])
        .row(300.0, vec![moment.without_legend(), turn.without_legend()])
}
