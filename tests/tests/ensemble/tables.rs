//! The tables of ensembles.

use dvi_core::ensemble::{Ensemble, Member, Outcome, Results, Shard};
use dvi_core::prelude::*;
use dvi_core::record::{Quantity, RecordError, Values};

use crate::ensemble::{Checked, bytes, file, planets};

#[test]
fn the_columns() -> Checked {
    let (systems, states) = planets(5);
    let results = Ensemble::with_systems(&systems, Variational::trapezoid(), 0.01, states).take_steps(50)?;
    let [csv, _] = bytes(&results)?;
    let text = String::from_utf8(csv)?;
    let mut lines = text.lines();
    let expected = "run.member,run.outcome,run.reason,run.time,run.steps,run.iterations,energy.first,energy.last,\
                    energy.largest_error,momentum.angular.first,momentum.angular.last,x,y,dot_x,dot_y";
    assert_eq!(lines.next(), Some(expected));
    assert!(lines.next().is_some_and(|line| line.starts_with("0,finished,,0.5,50,0,")));
    let failed = lines.nth(3);
    assert!(
        failed.is_some_and(|line| line.starts_with("4,failed,") && line.ends_with(",NaN,0.0,0.0,0.0,0.92")),
        "{failed:?}"
    );
    Ok(())
}

/// Every column against what the members say, and against the systems and states that they have begun from.
#[test]
fn the_record_of_an_ensemble() -> Checked {
    let (systems, states) = planets(7);
    let results = Ensemble::with_systems(&systems, Variational::trapezoid(), 0.01, states.clone())
        .parameter("mu", |_, _| 0.0)
        .parameter("start", |_, state| state.dot_y)
        .parameter("mu", |planet, _| planet.mu)
        .take_steps(50)?;
    let record = results.record()?;
    assert_eq!((record.title(), record.rows()), ("Kepler", 7));
    let numbers = |name: &str| -> Result<Vec<u64>, RecordError> {
        Ok(record.numbers(name)?.iter().map(|number| number.to_bits()).collect())
    };
    let of = |value: &dyn Fn(&Member) -> f64| -> Vec<u64> {
        results.members().iter().map(|member| value(member).to_bits()).collect()
    };
    assert_eq!(numbers("run.time")?, of(&|member| member.time));
    assert_eq!(numbers("energy.largest_error")?, of(&|member| member.energy.largest_error));
    assert_eq!(numbers("momentum.angular.first")?, of(&|member| member.momenta[0][0]));
    assert_eq!(numbers("momentum.angular.last")?, of(&|member| member.momenta[0][1]));
    assert_eq!(numbers("dot_x")?, of(&|member| member.state[2]));
    assert_eq!(numbers("parameter.mu")?, of(&|member| systems[member.number as usize].mu));
    assert_eq!(numbers("parameter.start")?, of(&|member| states[member.number as usize].dot_y));
    let quantity = |name: &str| record.column(name).map(|column| column.quantity);
    assert_eq!([quantity("y")?, quantity("dot_x")?], [Quantity::Coordinate, Quantity::Velocity]);
    assert_eq!(quantity("parameter.mu")?, Quantity::Parameter);
    let Values::Texts(outcomes) = &record.column("run.outcome")?.values else { panic!("they are words") };
    let expected = results.members().iter().map(|member| match member.outcome {
        Outcome::Finished => "finished",
        Outcome::Exited { .. } => "exited",
        Outcome::Failed { .. } => "failed",
    });
    assert!(outcomes.iter().eq(expected) && outcomes[4] == "failed");
    assert_eq!(record.column("run.member")?.values, Values::Counts(vec![0, 1, 2, 3, 4, 5, 6]));
    Ok(())
}

/// Parameters of the table go through checkpoints, and tell ensembles apart.
#[test]
fn parameters_are_in_the_checkpoint() -> Checked {
    let path = file("parameters.ckpt");
    let (systems, states) = planets(5);
    let run = |shard: Shard, factor: f64| {
        Ensemble::with_systems(&systems, Variational::trapezoid(), 0.01, states.clone())
            .parameter("mu", move |planet, _| factor * planet.mu)
            .checkpoints(&path, std::time::Duration::from_secs(60))
            .shard(shard)
            .take_steps(20)
    };
    let [first, second] = [Shard::new(0, 2)?, Shard::new(1, 2)?];
    run(first, 1.0)?;
    run(second, 1.0)?;
    let whole = Results::merge([Results::read(second.path(&path))?, Results::read(first.path(&path))?])?;
    let expected: Vec<f64> = systems.iter().map(|planet| planet.mu).collect();
    assert_eq!(whole.record()?.numbers("parameter.mu")?, expected);
    let said = run(first, 2.0).map_or_else(|error| error.to_string(), |_| "no error".into());
    assert!(said.contains("fingerprint of the parameters in the table"), "{said}");
    Ok(())
}
