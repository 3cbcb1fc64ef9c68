//! The frequencies of a clamped beam, by finite elements and by an elastic rod, against those of Euler and
//! Bernoulli.

use super::beam::{ANGLE, ELEMENTS, OF_BEAM, OF_ROD, SEGMENTS, newmark, rod};
use crate::vocabulary::*;

const MODES: [u32; 3] = [0, 1, 2];
const BEAMS: [usize; 4] = [8, 16, 32, 64];
const RODS: [usize; 4] = [12, 25, 50, 100];

/// Relative errors of the frequencies of [`MODES`].
type Errors = [f64; 3];

pub struct Frequencies([Errors; 4], [Errors; 4]);

impl Frequencies {
    pub fn new() -> Result<Self> {
        Ok(Self(each(BEAMS, errors_of_beam)?, each(RODS, errors_of_rod)?))
    }

    pub fn claims(&self) -> Result<[Claim; 2]> {
        let Self(of_beams, of_rods) = self;
        let largest = |errors: Errors| largest(errors.map(f64::abs));
        let error = "elements: largest relative error of a frequency";
        let text = "the frequencies of the first three modes of finite elements are those of Euler and \
                    Bernoulli, with an error of fourth order";
        let elements = orders(beyond(text), "", BEAMS, of_beams, [4.0, 0.05])
            .at_most(format!("16 {error}"), largest(of_beams[1]), 1e-4)
            .at_most(format!("{ELEMENTS} {error}"), largest(errors_of_beam(ELEMENTS)?), 1e-8);
        // The energy of the bent rod less that of the curve.
        let bending = each(RODS, |n| {
            let energy: f64 = rod(n).energy_at(0.0, &rod(n).bent(ANGLE))?;
            Ok(energy - 0.9 * ANGLE * ANGLE)
        })?;
        let quantity = format!("{SEGMENTS} segments: largest relative error of a frequency");
        let text = "the elastic rod has these frequencies at small deflections, and the energy of the \
                    curve, with errors of second order";
        let segments = orders(beyond(text), "rod, ", RODS, of_rods, [2.0, 0.1])
            .at_most(quantity, largest(of_rods[3]), 1.2e-3)
            .near("energy of bending: order in 1/n", order_in_size(RODS, bending), [2.0, 0.05]);
        Ok([elements, segments])
    }

    pub fn panel(&self) -> Panel {
        let points = |sizes: [usize; 4], errors: &[Errors; 4], k: usize| -> Vec<[f64; 2]> {
            sizes.into_iter().zip(errors).map(|(n, errors)| [n as f64, errors[k].abs()]).collect()
        };
        let slope = |n: f64, error: f64, order: i32| vec![[n, error], [2.0 * n, error / 2f64.powi(order)]];
        let n = Axis::logarithmic("elements or segments *n*").within([6.0, 130.0]);
        Panel::new("Frequencies", n, Axis::logarithmic("relative error of the frequency"))
            .each([BLUE, GREEN, PURPLE].into_iter().enumerate(), |panel, (k, colour)| {
                panel.marked([
                    (format!("mode {}, elements", k + 1), solid(colour), points(BEAMS, &self.0, k)),
                    (format!("mode {}, segments", k + 1), dashed(colour), points(RODS, &self.1, k)),
                ])
            })
            .lines([("orders 4 and 2", solid(SLATE).width(1.2), slope(14.0, 1e-8, 4))])
            .line(slope(50.0, 1.5e-2, 2), solid(SLATE).width(1.2))
            .legend_at(Corner::Beside)
    }
}

/// The angular frequency near `guess` of the mode that `start` is near to, without the error of the steps.
///
/// The velocities of a mode obey v₊ + v₋ = 2 cos(ω̃h) v. The cosine that fits best, v·M(v₊ + v₋)/(2 v·Mv),
/// has an error that is of second order in what other modes take part. `method` is Newmark's with β = ¼,
/// which has (2/h) tan(ω̃h/2) = ω.
fn frequency<S>(system: &S, method: Newmark, start: S::State<f64>, guess: f64) -> Result<f64>
where
    S: Separable + RegularLagrangian + System,
{
    // hω = ½, and the mean is taken over 200 steps.
    let h = 0.5 / guess;
    let mut run = Integrator::new(system, method, h, start)?;
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut last = run.memory().p().to_vec();
    run.advance()?;
    let (mut across, mut along) = (0.0, 0.0);
    for _ in 0..200 {
        let (v, p) = (run.v(), run.memory().p().to_vec());
        run.advance()?;
        across += dot(&v, &last) + dot(&v, run.memory().p());
        along += 2.0 * dot(&v, &p);
        last = p;
    }
    // tan²(ω̃h/2) = (1 − cos ω̃h)/(1 + cos ω̃h)
    Ok(2.0 / h * ((along - across) / (along + across)).sqrt())
}

fn errors_of_beam(n: usize) -> Result<Errors> {
    errors(|mode, guess| frequency(&Beam { n }, newmark(OF_BEAM), Beam { n }.struck(mode), guess))
}

/// Of deflections that are so small that the frequency does not depend on them.
fn errors_of_rod(n: usize) -> Result<Errors> {
    errors(|mode, guess| frequency(&rod(n), newmark(OF_ROD), rod(n).struck(mode, 1e-4), guess))
}

fn errors(frequency: impl Fn(Mode, f64) -> Result<f64>) -> Result<Errors> {
    each(MODES.map(Mode::new), |mode| Ok(frequency(mode, mode.frequency())? / mode.frequency() - 1.0))
}

fn order_in_size(sizes: [usize; 4], errors: [f64; 4]) -> Option<f64> {
    order(sizes.into_iter().zip(errors).map(|(n, error)| (1.0 / n as f64, error.abs())))
}

fn orders(claim: Claim, name: &str, sizes: [usize; 4], errors: &[Errors; 4], target: [f64; 2]) -> Claim {
    claim.each(MODES, |claim, k| {
        let quantity = format!("{name}mode {}: order in 1/n, n from {} to {}", k + 1, sizes[0], sizes[3]);
        claim.near(quantity, order_in_size(sizes, errors.map(|errors| errors[k as usize])), target)
    })
}
