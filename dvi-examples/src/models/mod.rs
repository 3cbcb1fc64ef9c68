//! The systems of the gallery and the initial data of the papers.

mod beam;
mod chains;
mod disc;
mod field_lines;
mod heights;
mod impacts;
mod kepler;
mod oscillators;
mod predators;
mod rigid;
mod tokamak;
mod vortices;

pub use self::{
    beam::*, chains::*, disc::*, field_lines::*, heights::*, impacts::*, kepler::*, oscillators::*,
    predators::*, rigid::*, tokamak::*, vortices::*,
};

/// The last number of an interval, to rounding, up to which something is so.
pub fn bisected([mut low, mut high]: [f64; 2], is_so: impl Fn(f64) -> bool) -> f64 {
    loop {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            return low;
        }
        if is_so(middle) { low = middle } else { high = middle }
    }
}

/// The ends of n segments of length 1/n, one after the other, by their directions in their middles, which
/// are counted as ½, 3/2, ….
fn joined(n: usize, direction: impl Fn(f64) -> [f64; 2]) -> Vec<[f64; 2]> {
    let (mut end, length) = ([0.0; 2], 1.0 / n as f64);
    let segment = |i| {
        let [x, y] = direction(i as f64 + 0.5);
        end = [end[0] + length * x, end[1] + length * y];
        end
    };
    (0..n).map(segment).collect()
}
