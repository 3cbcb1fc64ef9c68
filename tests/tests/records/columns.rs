//! The columns: those of a run, of points, and of the user's.

use dvi_core::prelude::*;
use dvi_core::record::{Column, Quantity, Record, RecordError, Recorder, Values};

use crate::records::{Checked, KEPLER, KeplerState, START, bits, said};

/// Row by row against a second run that is asked.
#[test]
fn a_record_has_what_the_run_says() -> Checked {
    let mut run = Integrator::new(&KEPLER, Variational::trapezoid(), 0.02, START)?;
    let record = run.record(7, 40)?;
    assert_eq!((record.title(), record.rows(), run.steps()), ("Kepler", 41, 280));
    let mut other = Integrator::new(&KEPLER, Variational::trapezoid(), 0.02, START)?;
    for row in 0..41 {
        let KeplerState { x, y, dot_x, dot_y } = other.state();
        let angular = other.momentum(0).ok_or("it is declared")?;
        let expected = [other.time(), x, y, dot_x, dot_y, other.energy(), angular];
        let found: Vec<f64> = ["time", "x", "y", "dot_x", "dot_y", "energy", "angular"]
            .into_iter()
            .map(|name| record.numbers(name).map(|numbers| numbers[row]))
            .collect::<Result<_, _>>()?;
        assert_eq!(bits(&found), bits(&expected), "row {row}");
        other.take_steps(7)?;
    }
    let quantities: Vec<Quantity> = record.columns().iter().map(|column| column.quantity).collect();
    use Quantity::{Coordinate, Energy, Momentum, Time, Velocity};
    assert_eq!(quantities, [Time, Coordinate, Coordinate, Velocity, Velocity, Energy, Momentum]);
    Ok(())
}

/// Steps of variable length, and a second record that begins where the first has ended.
#[test]
fn controlled_runs_are_recorded_too() -> Checked {
    let control = Reversible::power(0.02, 1.5);
    let mut run = Integrator::controlled(&KEPLER, Variational::trapezoid(), control, START)?;
    let [first, second] = [run.record(3, 10)?, run.record(3, 10)?];
    let [first, second] = [first.numbers("time")?, second.numbers("time")?];
    assert_eq!(first[10].to_bits(), second[0].to_bits());
    assert_ne!(first[1] - first[0], first[10] - first[9]);
    Ok(())
}

#[test]
fn functions_of_the_user_are_columns() -> Checked {
    let mut run = Integrator::new_at(&KEPLER, Variational::trapezoid(), 3.0, 0.02, START)?;
    let mut calls = 0;
    let record = Recorder::new(&KEPLER)
        .with_function("radius", |_, state, _| state.x.hypot(state.y))?
        .with_function("x at time", |_, state, time| state.x * time)?
        .with_function("calls", |_, _, _| {
            calls += 1;
            f64::from(calls)
        })?
        .record(&mut run, 5, 20)?;
    let [t, x, y] = [record.numbers("time")?, record.numbers("x")?, record.numbers("y")?];
    for row in 0..21 {
        assert_eq!(record.numbers("radius")?[row], x[row].hypot(y[row]));
        assert_eq!(record.numbers("x at time")?[row], x[row] * t[row]);
        assert_eq!(record.numbers("calls")?[row], row as f64 + 1.0);
    }
    let twice = Recorder::new(&KEPLER).with_function("energy", |_, _, _| 0.0);
    assert_eq!(said(twice), "the record already has a column `energy`");
    Ok(())
}

/// States that come one by one have the energy and momenta of the run that they are from.
#[test]
fn states_come_one_by_one() -> Checked {
    let mut run = Integrator::new(&KEPLER, Variational::midpoint(), 0.02, START)?;
    let mut recorder = Recorder::new(&KEPLER);
    for _ in 0..10 {
        recorder.push(&KEPLER, run.time(), &run.state())?;
        run.advance()?;
    }
    let mut again = Integrator::new(&KEPLER, Variational::midpoint(), 0.02, START)?;
    let whole = again.record(1, 9)?;
    assert_eq!(recorder.finish(), whole);
    Ok(())
}

/// A planet that falls into the sun: what was recorded before is in the error, and the run is where it was.
#[test]
fn a_run_that_fails_keeps_its_record() -> Checked {
    let method = EnergyLimit { method: Variational::trapezoid(), limit: 0.1 };
    let fall = KeplerState { dot_y: 0.0, ..START };
    let mut run = Integrator::new(&KEPLER, method, 0.01, fall)?;
    let Err(RecordError::Step { record, error }) = run.record(10, 100) else { panic!("it falls") };
    assert!(matches!(error.failure, StepFailure::Energy { .. }));
    assert_eq!(record.rows() as u64, error.step / 10 + 1);
    let mut other = Integrator::new(&KEPLER, method, 0.01, fall)?;
    assert_eq!(*record, other.record(10, error.step / 10)?);
    assert_eq!(run.steps(), error.step);
    let text = RecordError::Step { record, error }.to_string();
    assert_eq!(text, format!("{error}; {} rows were recorded before", error.step / 10 + 1));
    assert_eq!(said(run.record(0, 5)), "there must be at least one step between two rows");
    Ok(())
}

/// Predators and prey in a time that is transformed: its coordinates are `x`, `y`, `t` and `energy`.
#[degenerate_lagrangian(
    coordinates(x, y),
    one_form = y.ln() / x * d(x),
    hamiltonian = x + y - x.ln() - 2.0 * y.ln(),
    momenta(time = x, run = y, energy = x * y),
    time_transform = 1.0 / (x + y),
)]
struct Predators;

#[test]
fn names_that_are_taken_are_told_apart() -> Checked {
    let start = Predators.with_energy(PredatorsState { x: 0.2, y: 0.1, t: 0.0, energy: 0.0 })?;
    let mut run = Integrator::new(&Predators, OneStep::midpoint(), 0.02, start)?;
    let record = run.record(1, 3)?;
    let names: Vec<&str> = record.columns().iter().map(|column| &column.name[..]).collect();
    let expected = ["time", "x", "y", "t", "energy", "run.energy", "run.time", "run", "run.run.energy"];
    assert_eq!(names, expected);
    assert_eq!(record.numbers("run.energy")?[3], run.energy());
    assert_eq!(record.numbers("energy")?[3], run.state().energy);
    assert_eq!(record.numbers("run.run.energy")?[3], run.state().x * run.state().y);
    Ok(())
}

#[test]
fn columns_of_ones_own() -> Checked {
    let record = Record::new("Counts")
        .with_column(Column::new("n", vec![1_u64, 2]))?
        .with_column(Column::new("error", vec![0.5, 0.25]).with_quantity(Quantity::Energy))?
        .with_column(Column::new("remark", vec!["a".to_owned(), "b".to_owned()]))?
        .with_unit("error", "J")?;
    assert_eq!((&record.column("error")?.unit[..], &record.column("n")?.unit[..]), ("J", ""));
    assert_eq!(record.column("n")?.values, Values::Counts(vec![1, 2]));
    let with = |column| said(record.clone().with_column(column));
    assert_eq!(with(Column::new("n", vec![0.0; 2])), "the record already has a column `n`");
    assert_eq!(with(Column::new("x", vec![0.0; 3])), "the column `x` has 3 rows, and the record has 2");
    let only = "the record has no column `x`, only n, error, remark";
    assert_eq!(said(record.numbers("x")), only);
    assert_eq!(said(record.clone().with_unit("x", "m")), only);
    assert_eq!(said(record.numbers("n")), "the column `n` does not hold numbers, but counts or texts");
    Ok(())
}
