//! AFFINE, MATCHING and CANONICAL against the entries that Dα is seen to have.

use dvi_core::Space;

use crate::derivatives::oracle::{ByHand, Random, differentiated};

const POINTS: usize = 8;

/// Which entries of Dα and of Ω are ever different from zero, and whether Dα ever changes.
struct Seen {
    n: usize,
    form: Vec<bool>,
    omega: Vec<bool>,
    varies: bool,
}

fn observe<S: ByHand>(system: &S) -> Seen {
    let mut random = Random::new(17);
    let n = system.space().dimension();
    let mut seen = Seen { n, form: vec![false; n * n], omega: vec![false; n * n], varies: false };
    let mut first: Option<Vec<f64>> = None;
    for _ in 0..POINTS {
        let (q, t) = (system.point(&mut random), random.between(-2.0, 2.0));
        let rows = differentiated(&q, t, &|q, t| system.alpha(q, t)).derivatives;
        let matrix: Vec<f64> = rows.iter().flat_map(|row| row[..n].to_vec()).collect();
        for at in 0..n * n {
            let (entry, mirror) = (matrix[at], matrix[n * (at % n) + at / n]);
            seen.form[at] |= entry != 0.0;
            seen.omega[at] |= (mirror - entry).abs() > 1e-13 * (mirror.abs() + entry.abs());
        }
        let first = first.get_or_insert_with(|| matrix.clone());
        seen.varies |= first.iter().zip(&matrix).any(|(a, b)| (a - b).abs() > 1e-13 * (1.0 + a.abs()));
    }
    seen
}

impl Seen {
    /// The only column in which Ω has an entry in row i, if Dα has no other off its diagonal.
    fn conjugate(&self, i: usize) -> Option<usize> {
        let others = || (0..self.n).filter(|j| *j != i);
        let column = others().find(|j| self.omega[self.n * i + j])?;
        let alone = others().filter(|j| *j != column).all(|j| {
            !self.omega[self.n * i + j] && !self.form[self.n * i + j] && !self.form[self.n * j + i]
        });
        alone.then_some(column)
    }
}

/// The compiler may claim only what is seen, and misses nothing on the systems of these tests.
pub(crate) fn agrees<S: ByHand>(system: &S) {
    let (seen, name) = (observe(system), S::REPORT.system);
    let conjugates: Option<Vec<usize>> = (0..seen.n).map(|i| seen.conjugate(i)).collect();
    let diagonal = (0..seen.n).any(|i| seen.form[seen.n * i + i]);
    assert_eq!(S::AFFINE, !seen.varies, "{name}: AFFINE");
    assert_eq!(S::CANONICAL, conjugates.is_some(), "{name}: CANONICAL");
    assert_eq!(S::MATCHING, conjugates.is_some() && !diagonal, "{name}: MATCHING");
    let expected = conjugates.unwrap_or_else(|| (0..seen.n).collect());
    let found: Vec<usize> = (0..seen.n).map(|i| system.conjugate(i)).collect();
    assert_eq!(found, expected, "{name}: conjugates");
}
