//! Tables in and out.

use dvi_core::ensemble::{Ensemble, Outcome, Table};
use dvi_core::prelude::*;

use crate::ensemble::{Checked, HenonHeiles, Kepler, KeplerState, bytes, left, planets, wells};

fn said<T>(result: Result<T, dvi_core::ensemble::TableError>) -> String {
    result.map_or_else(|error| error.to_string(), |_| "no error".into())
}

#[test]
fn a_table_of_states_and_parameters() -> Checked {
    let text = "mu, dot_y ,y,x,dot_x\n 1.5 ,1,0,2,\"-0.5\"\n0.1,1e-300,-0.0,3,4\n";
    let table = Table::read(text.as_bytes())?;
    let systems: Vec<_> = table.column("mu")?.into_iter().map(|mu| Kepler { mu }).collect();
    let states: Vec<KeplerState> = table.states(&systems[0])?;
    assert_eq!((table.len(), table.is_empty(), systems[1].mu), (2, false, 0.1));
    assert_eq!(states[0], KeplerState { x: 2.0, y: 0.0, dot_x: -0.5, dot_y: 1.0 });
    assert_eq!((states[1].dot_y, states[1].y.is_sign_negative()), (1e-300, true));
    assert!(Table::read("x,y\n".as_bytes())?.is_empty());
    // As some programs write it, with a mark of its encoding and their line ends.
    let marked = Table::read("\u{feff}x,y\r\n1,2\r\n".as_bytes())?;
    assert_eq!([marked.column("x")?, marked.column("y")?], [[1.0], [2.0]]);
    Ok(())
}

#[test]
fn mistakes_have_a_line_and_a_column() {
    for (text, line) in
        [("x\r\n1\r\nbad\r\n", 3), ("x\n1\n\n\nbad\n", 5), ("x\nbad", 2), ("x,r\n1,\"a\nb\"\nbad,c\n", 4)]
    {
        let Ok(table) = Table::read(text.as_bytes()) else { panic!("{text:?} is a table") };
        let said = table.column("x").map_err(|error| error.to_string());
        assert_eq!(said, Err(std::format!("line {line}, column `x`: `bad` is no number")));
    }
    let read = |text: &str| Table::read(text.as_bytes()).and_then(|table| table.states(&Kepler { mu: 1.0 }));
    assert_eq!(said(read("x,y,dot_x,dot_y\n1,2,3,4\n1,2,,4\n")), "line 3, column `dot_x`: `` is no number");
    assert_eq!(said(read("x,y,dot_x,dot_y\n1,l0,3,4\n")), "line 2, column `y`: `l0` is no number");
    assert_eq!(said(read("x,y,dot_x\n1,2,3\n")), "the table has no column `dot_y`, only x, y, dot_x");
    assert_eq!(said(read("x,y,x\n1,2,3\n")), "the columns 1 and 3 of the table both have the name `x`");
    assert!(
        said(read("x,y,dot_x,dot_y\n1,2,3\n")).contains("line: 2"),
        "{}",
        said(read("x,y,dot_x,dot_y\n1,2,3\n"))
    );
    assert!(said(read("")).contains("no column `x`"));
    // A column that nobody asks for may hold anything, and numbers that are none belong to the members.
    assert_eq!(said(read("name,x,y,dot_x,dot_y\nComet,1,NaN,3,inf\n")), "no error");
}

/// What is written can be read: last states are initial states of a run that goes on.
#[test]
fn results_are_a_table_of_states() -> Checked {
    let results = Ensemble::new(&HenonHeiles, Variational::trapezoid(), 0.05, wells(20))
        .until(left)
        .stride(5)
        .take_steps(999)?;
    let [csv, _] = bytes(&results)?;
    let table = Table::read(&csv[..])?;
    let states = table.states(&HenonHeiles)?;
    for (member, state) in results.members().iter().zip(&states) {
        let values: Vec<f64> = HenonHeiles.values(state)?.collect();
        assert!(member.state.iter().zip(&values).all(|(a, b)| a.to_bits() == b.to_bits()));
    }
    let energies = table.column("energy.last")?;
    let bits = |energies: &mut dyn Iterator<Item = f64>| energies.map(f64::to_bits).collect::<Vec<_>>();
    let expected = bits(&mut results.members().iter().map(|member| member.energy.last));
    assert_eq!(bits(&mut energies.into_iter()), expected);
    Ok(())
}

#[test]
fn the_columns() -> Checked {
    let (systems, states) = planets(5);
    let ensemble = Ensemble::with_systems(&systems, Variational::trapezoid(), 0.01, states);
    let results = ensemble.exponents().section(Direction::Rising, |_, state| state.y).take_steps(50)?;
    let [csv, _] = bytes(&results)?;
    let text = String::from_utf8(csv)?;
    let mut lines = text.lines();
    let expected = "run.member,run.outcome,run.reason,run.time,run.steps,run.iterations,energy.first,energy.last,\
                    energy.largest_error,momentum.angular.first,momentum.angular.last,run.exponent,run.crossings,\
                    x,y,dot_x,dot_y";
    assert_eq!(lines.next(), Some(expected));
    assert!(lines.next().is_some_and(|line| line.starts_with("0,finished,,0.5,50,0,")));
    let failed = lines.nth(3);
    assert!(
        failed.is_some_and(|line| line.starts_with("4,failed,") && line.ends_with(",,0,0.0,0.0,0.0,0.92")),
        "{failed:?}"
    );
    Ok(())
}

#[test]
fn reasons_are_quoted() -> Checked {
    let reason = "left, \"far\" away\nand for ever";
    let ensemble = Ensemble::new(&HenonHeiles, Variational::trapezoid(), 0.05, wells(2));
    let [csv, _] = bytes(&ensemble.until(|_, _| Some(reason)).take_steps(5)?)?;
    assert!(String::from_utf8_lossy(&csv).contains("\"left, \"\"far\"\" away\nand for ever\""));
    assert_eq!(Table::read(&csv[..])?.column("run.steps")?, [0.0, 0.0]);
    Ok(())
}

/// Every field of the array, found by the offsets of the types in its head.
#[test]
fn the_array_of_numpy() -> Checked {
    let results = Ensemble::new(&HenonHeiles, Variational::trapezoid(), 0.05, wells(20))
        .until(left)
        .stride(5)
        .take_steps(999)?;
    let [csv, npy] = bytes(&results)?;
    assert_eq!(&npy[..8], b"\x93NUMPY\x03\x00");
    let len = u32::from_le_bytes(npy[8..12].try_into()?) as usize;
    let (head, data) = npy[12..].split_at(len);
    assert_eq!((12 + len) % 64, 0);
    let head = std::str::from_utf8(head)?;
    assert!(head.ends_with('\n') && head.contains("'fortran_order': False, 'shape': (20,), }"));
    let fields = head.split_once("[").and_then(|(_, rest)| rest.split_once("]")).ok_or("it has a list")?.0;
    let fields: Vec<(&str, &str)> = fields
        .split("), ")
        .filter_map(|field| field.trim_start_matches('(').split_once(", "))
        .map(|(name, kind)| (name.trim_matches('\''), kind.trim_matches('\'')))
        .collect();
    let size: usize = fields.iter().map(|&(_, kind)| if kind == "|u1" { 1 } else { 8 }).sum();
    assert_eq!(data.len(), 20 * size);
    let table = Table::read(&csv[..])?;
    let mut offset = 0;
    for (name, kind) in fields {
        let values = |read: &dyn Fn([u8; 8]) -> f64| -> Result<Vec<f64>, std::array::TryFromSliceError> {
            data.chunks(size).map(|record| record[offset..][..8].try_into().map(read)).collect()
        };
        match kind {
            "<f8" => {
                let [found, expected] = [values(&f64::from_le_bytes)?, table.column(name)?];
                assert!(found.iter().zip(&expected).all(|(a, b)| a.to_bits() == b.to_bits()), "{name}");
            }
            "<u8" => {
                let counts = values(&|bytes| u64::from_le_bytes(bytes) as f64)?;
                assert_eq!(counts, table.column(name)?, "{name}");
            }
            "|u1" => {
                let codes = data.chunks(size).map(|record| record[offset]);
                let expected = results.members().iter().map(|member| match member.outcome {
                    Outcome::Finished => 0,
                    Outcome::Exited { .. } => 1,
                    Outcome::Failed { .. } => 2,
                });
                assert!(codes.eq(expected));
            }
            other => return Err(format!("{name} has the type {other}").into()),
        }
        offset += if kind == "|u1" { 1 } else { 8 };
    }
    assert_eq!(offset, size);
    Ok(())
}
