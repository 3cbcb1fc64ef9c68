//! How long steps may be with rods, and with springs in place of them.

use super::molecules::{H_SPRINGS, RIGID, SOFT, STIFF};
use crate::vocabulary::*;

/// What the energy error may be, over the energy.
const BOUND: f64 = 0.01;

/// Lengths of steps, each with the largest |E/E(0) − 1|, which is infinite where the run is lost.
type Scan = Vec<[f64; 2]>;

/// Those of the rods, and of the soft and the stiff springs.
pub struct Scans([Scan; 3]);

impl Scans {
    pub fn new(job: &Job<'_>, start: &RigidMoleculesState) -> Result<Self> {
        let (rattle, verlet) = (Rattle::default(), Variational::trapezoid());
        let [soft, stiff] = [&SOFT, &STIFF].map(|system| Problem::new(system, start.clone()));
        let rigid = Problem::new(&RIGID, start.clone());
        Ok(Self([
            scan(job, [0.01, 0.16], |h| rigid.run(rattle, h))?,
            scan(job, [0.005, 0.04], |h| soft.run(verlet, h))?,
            scan(job, [0.0025, 0.02], |h| stiff.run(verlet, h))?,
        ]))
    }

    /// The stiffness, the length of the steps, and the error.
    pub fn rows(&self) -> impl Iterator<Item = [f64; 3]> {
        let stiffness = [f64::INFINITY, SOFT.k, STIFF.k];
        self.0.iter().zip(stiffness).flat_map(|(scan, k)| scan.iter().map(move |&[h, error]| [k, h, error]))
    }

    /// The longest steps at which, and at all shorter ones that were tried, the error is at most [`BOUND`].
    pub fn longest(&self) -> [f64; 3] {
        self.0.each_ref().map(|scan| {
            scan.iter().take_while(|[_, error]| *error <= BOUND).last().map_or(f64::NAN, |[h, _]| *h)
        })
    }

    pub fn claims(&self) -> [Claim; 2] {
        let [rods, soft, stiff] = self.longest();
        let springs = [(soft, SOFT.k, 3.0), (stiff, STIFF.k, 9.0)];
        let text = "with rods the longest step that keeps the energy to one hundredth is several times as \
                    long as with springs";
        let longer = beyond(text)
            .within("rods: longest step", rods, [0.035, 0.07])
            .each(springs, |claim, (step, k, low)| {
                claim.at_least(format!("k = {k}: longest step with rods / with springs"), rods / step, low)
            })
            .each(springs, |claim, (step, k, _)| {
                let over_limit = step * (3.0 * k).sqrt() / 2.0;
                claim.within(format!("k = {k}: longest step with springs / (2/ω)"), over_limit, [0.88, 1.01])
            });
        // Of the step that is the nearest.
        let off = |tried: f64| (tried / H_SPRINGS).ln().abs();
        let [rods, soft, _] = self.0.each_ref().map(|scan| {
            scan.iter().min_by(|a, b| off(a[0]).total_cmp(&off(b[0]))).map_or(f64::NAN, |[_, error]| *error)
        });
        let quantity = format!("h = {H_SPRINGS}: max|ΔE| with springs, k = {}, over that with rods", SOFT.k);
        let text = "below that limit rods and springs have the same energy error: only stability shortens \
                    the steps";
        [longer, beyond(text).near(quantity, soft / rods, [1.0, 0.02])]
    }

    pub fn panel(&self) -> Panel {
        let shown = [
            ("rods", solid(BLUE).width(1.4)),
            ("springs, *k* = 10⁴", solid(GREEN).width(2.6)),
            ("springs, *k* = 10⁵", solid(VERMILLION).width(4.0)),
        ];
        let lines = shown.into_iter().zip(&self.0).rev().map(|((name, stroke), scan)| {
            (name, stroke, scan.iter().map(|&[h, error]| [h, error.min(1e6)]).collect())
        });
        let (title, h) = ("Energy error over the length of the steps", [0.0022, 0.2]);
        Panel::loglog(title, ("step *h*", h), ("largest |*E*/*E*(0) − 1|", [1e-5, 1.0]))
            .lines(lines)
            .guide(h.map(|h| [h, BOUND]), "one hundredth")
            .legend_at(Corner::BottomRight)
    }
}

/// Of runs with steps between the two, eight between one and twice that one.
fn scan<R: Run<Scalar = f64>>(
    job: &Job<'_>,
    [shortest, longest]: [f64; 2],
    begun: impl Fn(f64) -> Result<R>,
) -> Result<Scan> {
    let count = (8.0 * (longest / shortest).log2()).round() as u32;
    let error = |i: u32| {
        let h = shortest * (f64::from(i) / 8.0).exp2();
        let mut run = begun(h)?;
        let (begin, mut largest) = (run.energy(), 0.0);
        let steps = (job.choose(50.0, 10.0) / h).ceil() as u64;
        job.expect(steps);
        let kept = job.follow(&mut run, steps, |run| {
            largest = larger(largest, (run.energy() / begin - 1.0).abs());
        });
        Ok([h, if kept.is_err() || !largest.is_finite() { f64::INFINITY } else { largest }])
    };
    (0..=count).map(error).collect()
}
