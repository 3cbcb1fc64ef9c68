//! The page of a record: that it has the data, loads nothing, and draws in a browser.

use std::fs::{self, File};
use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use dvi_core::prelude::*;
use dvi_core::record::{Column, Record};

use crate::records::{Checked, Kepler, START, bits};

fn page(record: &Record) -> Result<String, Box<dyn std::error::Error>> {
    let mut page = Vec::new();
    record.write_page(&mut page)?;
    Ok(String::from_utf8(page)?)
}

/// What stands on a page as data, read by another program.
fn data(page: &str) -> Result<serde_json::Value, Box<dyn std::error::Error>> {
    let (_, rest) =
        page.split_once(r#"<script type="application/json" id="record">"#).ok_or("it has data")?;
    let (data, _) = rest.split_once("</script>").ok_or("they end")?;
    Ok(serde_json::from_str(data)?)
}

fn numbers(value: &serde_json::Value) -> Vec<f64> {
    value.as_array().into_iter().flatten().map(|x| x.as_f64().unwrap_or(f64::NAN)).collect()
}

fn orbit() -> Result<Record, Box<dyn std::error::Error>> {
    let mut run = Integrator::new(&Kepler, Variational::trapezoid(), 0.02, START)?;
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
            (Some(column.name()), Some(column.unit()))
        );
        assert_eq!(bits(&numbers(&found["values"])), bits(record.numbers(column.name())?));
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
    assert_eq!(columns[0]["name"].as_str(), Some(record.columns()[0].name()));
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
    let mut run = Integrator::new(&Kepler, Variational::trapezoid(), -0.02, START)?;
    Ok(run.record(1, 70_000)?)
}

/// A name under which there is a browser to be run without a window.
fn browser() -> Option<&'static str> {
    let starts = |name: &&str| {
        let version =
            Command::new(name).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
        version.is_ok_and(|status| status.success())
    };
    ["chromium", "chromium-browser", "google-chrome"].into_iter().find(starts)
}

/// Shows a page in a frame, which can be narrower than a window, and what the page tells of itself.
const FRAME: &str =
    "<!DOCTYPE html><meta name='color-scheme' content='light dark'><pre id='found'></pre><script>
addEventListener('message', ({ data }) => { document.getElementById('found').textContent = data; });
</script>";

/// What a page becomes in some seconds in a theme.
fn displayed(browser: &str, file: &Path, theme: usize) -> Result<String, Box<dyn std::error::Error>> {
    let profile = file.with_extension("profile");
    let output = file.with_extension("out");
    for _ in 0..3 {
        let mut child = Command::new(browser)
            .args(["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run"])
            .args(["--disable-background-networking", "--disable-component-update", "--disable-sync"])
            .args(["--virtual-time-budget=20000", "--dump-dom"])
            .arg(format!("--user-data-dir={}", profile.display()))
            .arg("--window-size=1300,900")
            .arg(format!("--blink-settings=preferredColorScheme={theme}"))
            .arg(format!("file://{}", file.display()))
            .stdout(File::create(&output)?)
            .stderr(Stdio::null())
            .spawn()?;
        let begun = Instant::now();
        let mut ended = child.try_wait()?;
        while ended.is_none() && begun.elapsed() < Duration::from_secs(100) {
            std::thread::sleep(Duration::from_millis(50));
            ended = child.try_wait()?;
        }
        if ended.is_none() {
            child.kill()?;
            child.wait()?;
        }
        // It need not be there.
        let _ = fs::remove_dir_all(&profile);
        let text = fs::read_to_string(&output)?;
        // A browser without a screen may crash before it has loaded the page.
        if ended.is_some_and(|status| status.success()) && text.contains("</html>") {
            return Ok(text);
        }
    }
    Err(format!("{browser} does not show {}", file.display()).into())
}

/// The checks of `check.js`, in both themes and in wide and narrow windows.
#[test]
fn a_browser_draws_the_pages() -> Checked {
    let Some(browser) = browser() else {
        writeln!(std::io::stderr(), "NOT CHECKED: there is no Chromium to show the pages of records")?;
        return Ok(());
    };
    let all = "over-time, motion, plane";
    for (name, record, shown, width, theme) in [
        ("orbit", orbit()?, all, 1200, 1),
        ("sphere", sphere()?, all, 400, 0),
        ("long", long()?, all, 400, 1),
        ("awkward", awkward()?, "plane", 1200, 0),
    ] {
        let file =
            |suffix: &str| Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("record-{name}{suffix}"));
        let script = concat!("<head><script>", include_str!("check.js"), "</script>");
        fs::write(file(".html"), page(&record)?.replacen("<head>", script, 1))?;
        let frame =
            format!("{FRAME}<iframe src='record-{name}.html' width='{width}' height='900'></iframe>");
        fs::write(file("-frame.html"), frame)?;
        let text = displayed(browser, &file("-frame.html"), theme)?;
        let found = text.split_once("<pre id=\"found\">").and_then(|(_, rest)| rest.split_once("</pre>"));
        let (found, _) = found.ok_or("there is a place for what was found")?;
        assert!(found.lines().all(|line| line.starts_with("ok ")), "{name}:\n{found}");
        assert!(found.contains(&format!("ok shown are {shown}\n")), "{name}:\n{found}");
        let window = format!("ok the window is {width} wide, and {}", ["dark", "light"][theme]);
        assert!(found.ends_with(&window), "{name}:\n{found}");
    }
    Ok(())
}
