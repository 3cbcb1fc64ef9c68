//! Which columns are positions of bodies.

use dvi_core::prelude::*;
use dvi_core::record::{Column, Quantity, Record, Recorder};

use crate::records::page::{data, page};
use crate::records::{Checked, KEPLER};

/// The name of a body, and the columns of its position.
pub(crate) type Told = (String, Vec<String>);

/// The bodies that the page of a record shows.
pub(crate) fn bodies(record: &Record) -> Result<Vec<Told>, Box<dyn std::error::Error>> {
    let data = data(&page(record)?)?;
    let body = |body: &serde_json::Value| -> Result<Told, Box<dyn std::error::Error>> {
        Ok((
            body["name"].as_str().ok_or("a name")?.into(),
            serde_json::from_value(body["position"].clone())?,
        ))
    };
    data["bodies"].as_array().ok_or("bodies")?.iter().map(body).collect()
}

/// The bodies of a record with the time and columns of these names.
fn told(names: &[&str]) -> Result<Vec<Told>, Box<dyn std::error::Error>> {
    let time = Column::new("time", vec![0.0]).with_quantity(Quantity::Time);
    let mut record = Record::new("").with_column(time)?;
    for &name in names {
        record = record.with_column(Column::new(name, vec![0.0]))?;
    }
    bodies(&record)
}

fn body(name: &str, position: &[&str]) -> Told {
    (name.into(), position.iter().map(|&column| column.into()).collect())
}

#[test]
fn names_tell_bodies() -> Checked {
    assert_eq!(told(&["x", "y"])?, [body("", &["x", "y"])]);
    assert_eq!(told(&["z", "y", "x"])?, [body("", &["x", "y", "z"])]);
    assert_eq!(
        told(&["x[0]", "x[1]", "x[10]", "y[0]", "y[1]", "y[10]"])?,
        [body("[0]", &["x[0]", "y[0]"]), body("[1]", &["x[1]", "y[1]"]), body("[10]", &["x[10]", "y[10]"])]
    );
    let pairs = ["x2", "y2", "x1", "y1", "sun_x", "sun_y", "x_moon", "y_moon", "z_moon", "X", "Y"];
    assert_eq!(
        told(&pairs)?,
        [
            body("2", &["x2", "y2"]),
            body("1", &["x1", "y1"]),
            body("sun", &["sun_x", "sun_y"]),
            body("moon", &["x_moon", "y_moon", "z_moon"]),
            body("", &["X", "Y"]),
        ]
    );
    assert_eq!(told(&["angle", "p", "x", "z", "xi", "y[0]", "", "ŷ", "ex"])?, []);
    Ok(())
}

/// Velocities and momenta are no positions, and members of an ensemble no motion.
#[test]
fn positions_are_coordinates_of_a_motion() -> Checked {
    let column = |name: &str| Column::new(name, vec![0.0]);
    let time = column("time").with_quantity(Quantity::Time);
    let still = Record::new("").with_column(column("x"))?.with_column(column("y"))?;
    assert_eq!(bodies(&still)?, []);
    let velocities = |name: &str| column(name).with_quantity(Quantity::Velocity);
    let moving = Record::new("").with_column(time)?;
    let moving = moving.with_column(velocities("x"))?.with_column(velocities("y"))?;
    assert_eq!(bodies(&moving)?, []);
    Ok(())
}

#[test]
fn bodies_that_are_named_take_their_place() -> Checked {
    let record = Recorder::new(&KEPLER).finish();
    assert_eq!(bodies(&record)?, [body("", &["x", "y"])]);
    let record = record.with_body("in phase", &["x", "dot_x"])?.with_body("space", &["x", "y", "energy"])?;
    assert_eq!(bodies(&record)?, [body("in phase", &["x", "dot_x"]), body("space", &["x", "y", "energy"])]);
    let said = |position: &[&str]| {
        record
            .clone()
            .with_body("it", position)
            .map_or_else(|error| error.to_string(), |_| "no error".into())
    };
    assert_eq!(said(&["x"]), "the position of the body `it` has 1 columns: two in a plane, three in space");
    assert!(said(&["x", "w"]).starts_with("the record has no column `w`"));
    Ok(())
}

/// A top and a pendulum on a sphere; the names of the coordinates of the top are like those of a body.
#[lagrangian(
    coordinates(x: SO3, s: S2),
    lagrangian = (omega(x)[0].powi(2) + omega(x)[1].powi(2) + omega(x)[2].powi(2)) / 2.0
        + sum(0..3, |k| dot(s[k]).powi(2)) / 2.0 - s[2] - x[2][2],
)]
struct Turning;

#[test]
fn unit_vectors_and_rotations_are_bodies_in_space() -> Checked {
    let found = bodies(&Recorder::new(&Turning).finish())?;
    let expected = [
        body("x, axis 1", &["x[0]", "x[3]", "x[6]"]),
        body("x, axis 2", &["x[1]", "x[4]", "x[7]"]),
        body("x, axis 3", &["x[2]", "x[5]", "x[8]"]),
        body("s", &["s[0]", "s[1]", "s[2]"]),
    ];
    assert_eq!(found, expected);
    Ok(())
}

/// A particle in space, and two angles: nothing but the user says which of the arrays is a position.
#[lagrangian(
    coordinates(r[3], angle[2]),
    lagrangian = (dot(r).norm_squared() + dot(angle[0]).powi(2) + dot(angle[1]).powi(2)) / 2.0,
)]
struct Arrays;

#[test]
fn arrays_of_numbers_are_bodies_if_they_are_named() -> Checked {
    let record = Recorder::new(&Arrays).finish();
    assert_eq!(bodies(&record)?, []);
    let position = ["r[0]", "r[1]", "r[2]"];
    assert_eq!(bodies(&record.with_body("r", &position)?)?, [body("r", &position)]);
    Ok(())
}
