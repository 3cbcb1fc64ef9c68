//! Rowley & Marsden 2002, Fig. 4: Poincaré sections of a quasi-periodic motion, 0 ≤ t ≤ 10⁵.
//!
//! The exact section is a closed curve. Each run is compared with that curve, computed by Gauss
//! collocation of order six.

use super::crossings::{self, Scheme, *};
use super::sections::{self, CAVEAT};
use crate::vocabulary::*;

const RUNS: [(Scheme, f64); 6] = crossings::runs([0.1, 0.2, 0.5]);

pub fn run(job: &Job<'_>) -> Result<Outcome> {
    let end = job.choose(1e5, 4.5e4);
    let exact = [(Scheme::Gauss6, 0.2)];
    let motion = Motion { job, case: &models::quasi_periodic(), end };
    let all = motion.compare(RUNS)?;
    let [exact] = Motion { end: 1e5, ..motion }.compare(exact)?;
    let curve = Curve::through(&exact.places());
    let exponent = motion.lyapunov_exponent()?;
    job.publish(figure(&all, &curve, end), sections::table(&all))?;
    let [vi_small, vi_middle, vi_large, rk_small, rk_middle, _] = &all;
    let name = |run: &Crossings| format!("largest distance from the exact section, {}", run.name());
    let near = |claim: Claim, run: &Crossings| claim.at_most(name(run), curve.largest_distance(run), 0.01);
    let regular = "the motion is quasi-periodic";
    let claims = vec![
        says("section 5", regular).at_most("largest Lyapunov exponent up to t = 2·10⁴", exponent, 1e-3),
        says("Fig. 4", "both schemes give qualitatively correct results for h = 0.1")
            .each([vi_small, rk_small], near),
        says("Fig. 4", "RK4 gives spurious results for h = 0.2, VI2 does not")
            .at_least(name(rk_middle), curve.largest_distance(rk_middle), 0.5)
            .each([vi_middle, vi_large], near),
        sections::stays_close(&all[..3]).at_least(rk_small.growth_name(), rk_small.error.growth(), 5.0),
    ];
    // Numbers of independent programs.
    let error = |run: &Crossings, target, tolerance| {
        Check::new(format!("max|ΔH|, {}", run.name()), run.error.largest, Bound::Near(target, tolerance))
    };
    let end = job.only_full(rk_small.error.last);
    let left = rk_middle.points.iter().find(|&&[_, r1, p1]| curve.distance([r1, p1]) > 0.1);
    let left = left.map(|point| point[0]);
    let references = vec![
        error(vi_small, 3.847e-5, 5e-8),
        error(vi_middle, 1.546e-4, 1e-7),
        error(vi_large, 1.002e-3, 1e-6),
        Check::new("ΔH at the end, RK4 at h = 0.1", end, Bound::Near(6.518e-4, 1e-6)),
        Check::new("RK4 at h = 0.2 leaves the torus at t", left, Bound::Within(4e4, 4.6e4)),
    ];
    Ok(Outcome { claims, references, notes: sections::notes(&all) })
}

fn figure(all: &[Crossings; 6], curve: &Curve, end: f64) -> Figure {
    let titles = [
        "Quasi-periodic motion of four equal vortices: Poincaré sections of VI2 and RK4",
        "*R*₂ = 0, d*R*₂/d*t* > 0; grey line: the exact section; *d*: the largest distance from it",
    ];
    sections::figure(titles, all, end, |run| panel(run, curve))
        .footer(format!("After Rowley & Marsden 2002, Fig. 4. {CAVEAT}"))
}

/// Close up where the run stays near the exact curve; else all of it, and a frame around the close-up.
fn panel(run: &Crossings, curve: &Curve) -> Panel {
    let [[left, right], [low, high]] = curve.frame();
    let caption = format!("*d* = {}", scientific(curve.largest_distance(run)));
    let exact = closed(&curve.0);
    let inside = |[r1, p1]: [f64; 2]| (left..=right).contains(&r1) && (low..=high).contains(&p1);
    if run.places().into_iter().all(inside) {
        let panel = run.panel([left, right], [low, high], 1.0);
        return panel.below(exact, solid(SLATE).width(5.0).opacity(0.25)).caption(Corner::TopRight, caption);
    }
    // Wide enough for words beside the dots, which stay within 2.4.
    run.panel([-2.6, 2.6], [-2.6, 3.4], 1.0)
        .below(exact, solid(SLATE).width(3.0).opacity(0.35))
        .line(closed(&[[left, low], [right, low], [right, high], [left, high]]), solid(SLATE).width(1.0))
        .caption(Corner::TopLeft, "frame: the close-up above")
        .caption(Corner::TopRight, caption)
}

/// A closed curve around its centre, as a polygon sorted by angle.
struct Curve(Points);

impl Curve {
    fn through(points: &[[f64; 2]]) -> Self {
        let centre = [0, 1].map(|i| mean(points.iter().map(|point| point[i])));
        let angle = |point: &[f64; 2]| (point[1] - centre[1]).atan2(point[0] - centre[0]);
        let mut corners = points.to_vec();
        corners.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
        Self(corners)
    }

    fn frame(&self) -> [[f64; 2]; 2] {
        if self.0.is_empty() {
            return [[-2.6, 2.6]; 2];
        }
        [0, 1].map(|i| {
            let values = || self.0.iter().map(|corner| corner[i]);
            let (low, high) = (least(values()), -least(values().map(|v| -v)));
            let margin = 0.18 * (high - low);
            [low - margin, high + margin]
        })
    }

    fn distance(&self, point: [f64; 2]) -> f64 {
        let to_side = |(&a, &b): (&[f64; 2], &[f64; 2])| {
            let (along, to) = (difference(b, a), difference(point, a));
            let share = (dot(to, along) / dot(along, along).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
            (to[0] - share * along[0]).hypot(to[1] - share * along[1])
        };
        self.0.iter().zip(self.0.iter().cycle().skip(1)).map(to_side).fold(f64::INFINITY, f64::min)
    }

    fn largest_distance(&self, run: &Crossings) -> f64 {
        largest(run.places().into_iter().map(|place| self.distance(place)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distance_from_a_curve_given_in_any_order() {
        let square = Curve::through(&[[1.0, 1.0], [-1.0, -1.0], [1.0, -1.0], [-1.0, 1.0]]);
        assert_eq!(square.distance([0.0, 3.0]), 2.0);
        assert_eq!(square.distance([0.0, 0.5]), 0.5);
        assert_eq!(square.distance([4.0, 5.0]), 5.0);
    }
}
