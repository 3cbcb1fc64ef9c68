//! Sizes that are known when the program runs: what does not fit the columns is no row.

use dvi_core::prelude::*;
use dvi_core::record::{Record, RecordError, Recorder};

use crate::records::{Checked, said};

/// A chain whose length is known when the program runs.
#[lagrangian(coordinates(x[n]), lagrangian = sum(0..n, |j| dot(x[j]).powi(2) / 2.0 - x[j].powi(4)))]
struct Chain {
    n: usize,
}

#[test]
fn states_of_another_length_are_refused() -> Checked {
    let chain = Chain { n: 3 };
    let mut recorder = Recorder::new(&chain);
    let wrong = ChainState { x: vec![0.0; 2], dot_x: vec![0.0; 3] };
    let error = recorder.push(&chain, 0.0, &wrong).map_err(|error| error.to_string());
    assert_eq!(error, Err("`x` has length 2, but the system declares 3".into()));
    let right = ChainState { x: vec![1.0, 2.0, 3.0], dot_x: vec![4.0, 5.0, 6.0] };
    recorder.push(&chain, 0.5, &right)?;
    let record = recorder.finish();
    assert_eq!((record.rows(), record.numbers("dot_x[1]")?), (1, &[5.0][..]));
    Ok(())
}

/// A recorder for one length takes no rows of a run of another, from wherever they come.
#[test]
fn runs_of_another_length_are_refused() -> Checked {
    for [of, on] in [[3, 4], [4, 3], [0, 1], [1, 0]] {
        let (columns, chain) = (Chain { n: of }, Chain { n: on });
        let expected = format!("`x` has length {on}, but the system declares {of}");
        let start = ChainState { x: vec![0.1; on], dot_x: vec![0.2; on] };
        let mut run = Integrator::new(&chain, Variational::trapezoid(), 0.01, start.clone())?;
        assert_eq!(said(Recorder::new(&columns).record(&mut run, 1, 5)), expected);
        assert_eq!(run.steps(), 0);
        // The rows before it stay, and their files can be written.
        let mut recorder = Recorder::new(&columns).with_function("one", |_, _, _| 1.0)?;
        recorder.push(&columns, 0.0, &columns.state_of([]))?;
        let error = recorder.push(&chain, 1.0, &start);
        assert!(
            matches!(&error, Err(RecordError::State(error)) if error.expected == of && error.found == on)
        );
        assert_eq!(said(error), expected);
        let record = recorder.finish();
        assert_eq!((record.rows(), lines(&record)?), (1, 2));
    }
    Ok(())
}

/// How many there are in the CSV.
fn lines(record: &Record) -> Result<usize, Box<dyn std::error::Error>> {
    let mut files = [Vec::new(), Vec::new(), Vec::new()];
    let [csv, npy, page] = &mut files;
    record.write_csv(&mut *csv)?;
    record.write_npy(npy)?;
    record.write_page(page)?;
    Ok(csv.iter().filter(|&&byte| byte == b'\n').count())
}

/// Oscillators in rows, each row with its strength.
#[lagrangian(
    coordinates(q[n][m]),
    lagrangian = sum(0..n, |i| sum(0..m, |j| dot(q[i][j]).powi(2) / 2.0 - k[i] * q[i][j].powi(4))),
)]
pub(crate) struct Lattice {
    pub(crate) n: usize,
    pub(crate) m: usize,
    pub(crate) k: Vec<f64>,
}

/// As many coordinates, in rows of other lengths.
#[test]
fn runs_with_other_rows_are_refused() -> Checked {
    let [wide, tall] = [[2, 3], [3, 2]].map(|[n, m]| Lattice { n, m, k: vec![1.0; n] });
    for [of, on] in [[&wide, &tall], [&tall, &wide]] {
        let mut run = Integrator::new(on, Variational::trapezoid(), 0.01, on.state_of([]))?;
        let expected = format!("`q` has length {}, but the system declares {}", on.n, of.n);
        assert_eq!(said(Recorder::new(of).record(&mut run, 1, 5)), expected);
    }
    Ok(())
}

/// The energy of such a system would need numbers that there are none of.
#[test]
fn parameters_that_are_too_short_are_refused() {
    let system = Lattice { n: 2, m: 1, k: vec![1.0] };
    let expected = "the formulas use index 1 of `k`, which has length 1";
    let state = || system.state_of([]);
    assert_eq!(said(Recorder::new(&system).push(&system, 0.0, &state())), expected);
}
