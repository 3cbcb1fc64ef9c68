//! The page of a record: that it has the data, loads nothing, and draws in a browser.

use std::path::Path;

use dvi_core::prelude::*;
use dvi_core::record::{Column, Record};

use crate::browser::told;
use crate::records::{Checked, KEPLER, START, bits};

pub(super) fn page(record: &Record) -> Result<String, Box<dyn std::error::Error>> {
    let mut page = Vec::new();
    record.write_page(&mut page)?;
    Ok(String::from_utf8(page)?)
}

/// What stands on a page as data, read by another program.
pub(super) fn data(page: &str) -> Result<serde_json::Value, Box<dyn std::error::Error>> {
    let (_, rest) =
        page.split_once(r#"<script type="application/json" id="record">"#).ok_or("it has data")?;
    let (data, _) = rest.split_once("</script>").ok_or("they end")?;
    Ok(serde_json::from_str(data)?)
}

fn numbers(value: &serde_json::Value) -> Vec<f64> {
    value.as_array().into_iter().flatten().map(|x| x.as_f64().unwrap_or(f64::NAN)).collect()
}

fn orbit() -> Result<Record, Box<dyn std::error::Error>> {
    let mut run = Integrator::new(&KEPLER, Variational::trapezoid(), 0.02, START)?;
    Ok(run.record(5, 200)?.with_unit("time", "d")?)
}

#[test]
fn a_page_has_the_data_and_loads_nothing() -> Checked {
    let record = orbit()?;
    let text = page(&record)?;
    assert!(
        !text.contains("http") && !text.contains("src=") && !text.contains("url("),
        "it loads something"
    );
    assert!(!text.contains("@import") && !text.contains("{{"));
    assert!(text.contains("<title>Kepler</title>") && text.contains("<h1>Kepler</h1>"));
    // The library comes with its licence.
    assert!(text.contains("Permission is hereby granted, free of charge") && text.contains("Leon Sorokin"));
    let data = data(&text)?;
    let columns = data["columns"].as_array().ok_or("columns")?;
    assert_eq!(columns.len(), record.columns().len());
    for (found, column) in columns.iter().zip(record.columns()) {
        assert_eq!(
            (found["name"].as_str(), found["unit"].as_str()),
            (Some(&column.name[..]), Some(&column.unit[..]))
        );
        assert_eq!(bits(&numbers(&found["values"])), bits(record.numbers(&column.name)?));
    }
    assert_eq!(columns[0]["quantity"], "time");
    assert_eq!(data["bodies"][0]["position"], serde_json::json!(["x", "y"]));
    Ok(())
}

#[test]
fn a_page_is_small_beside_its_data() -> Checked {
    let empty = page(&Record::new(""))?.len();
    assert!(empty < 100_000, "{empty} bytes");
    let filled = page(&orbit()?)?.len();
    let count = 201 * 7;
    assert!(filled < empty + 25 * count, "{} bytes for {count} numbers", filled - empty);
    Ok(())
}

/// Names and titles with signs of HTML and JSON in them, numbers that are none, and texts.
fn awkward() -> Result<Record, Box<dyn std::error::Error>> {
    let name = "</script><b>\"x\" & \\ \n\u{1}";
    Ok(Record::new("<i>a & b</i>")
        .with_column(Column::new(name, vec![f64::NAN, 1.5, f64::INFINITY, 2.0, -0.0, 5e-324]))?
        .with_column(Column::new("count", vec![0_u64, 1, 2, 3, 4, 5]))?
        .with_column(Column::new("text", ["a"; 6].map(str::to_owned).to_vec()))?
        .with_unit("count", "<b>")?)
}

#[test]
fn nothing_of_a_record_breaks_its_page() -> Checked {
    let record = awkward()?;
    let text = page(&record)?;
    assert!(text.contains("<title>&lt;i>a &amp; b&lt;/i></title>"));
    let data = data(&text)?;
    let columns = data["columns"].as_array().ok_or("columns")?;
    assert_eq!(columns.len(), 2);
    assert_eq!(columns[0]["name"].as_str(), Some(&record.columns()[0].name[..]));
    assert_eq!(columns[0]["values"].as_array().map(|values| values[0].is_null()), Some(true));
    let expected = [f64::NAN, 1.5, f64::NAN, 2.0, -0.0, 5e-324];
    assert_eq!(bits(&numbers(&columns[0]["values"])), bits(&expected));
    assert_eq!(numbers(&columns[1]["values"]), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
    Ok(())
}

/// A spherical pendulum, and a particle that falls beside it.
#[lagrangian(
    coordinates(s: S2, z),
    lagrangian = sum(0..3, |k| dot(s[k]).powi(2)) / 2.0 - s[2] + dot(z).powi(2) / 2.0 - z,
)]
struct Sphere;

fn sphere() -> Result<Record, Box<dyn std::error::Error>> {
    let start = SphereState { s: [0.6, 0.0, 0.8], z: 1.0, dot_s: [0.0, 0.5, 0.0], dot_z: 0.0 };
    let mut run = Integrator::new(&Sphere, Geodesic::trapezoid(), 0.05, start)?;
    Ok(run.record(1, 300)?)
}

/// Many rows, in a time that goes back.
fn long() -> Result<Record, Box<dyn std::error::Error>> {
    let mut run = Integrator::new(&KEPLER, Variational::trapezoid(), -0.02, START)?;
    Ok(run.record(1, 70_000)?)
}

/// The checks of `check.js`, in both themes and in wide and narrow windows.
#[test]
fn a_browser_draws_the_pages() -> Checked {
    let all = "over-time, motion, plane";
    for (name, record, shown, width, theme) in [
        ("orbit", orbit()?, all, 1200, 1),
        ("sphere", sphere()?, all, 400, 0),
        ("long", long()?, all, 400, 1),
        ("awkward", awkward()?, "plane", 1200, 0),
    ] {
        let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("record-{name}.html"));
        let Some(found) = told(&page(&record)?, include_str!("check.js"), &file, width, theme)? else {
            return Ok(());
        };
        assert!(found.contains(&format!("ok shown are {shown}\n")), "{name}:\n{found}");
    }
    Ok(())
}
