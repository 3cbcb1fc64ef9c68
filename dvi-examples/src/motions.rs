//! The motions that the page of the gallery shows: short runs beside those of the experiments, as records.

use dvi_core::record::{Column, Record, Recorder};

use crate::vocabulary::*;

/// That of an experiment; `None` if it has none.
pub fn of(experiment: &str) -> Result<Option<Record>> {
    Ok(Some(match experiment {
        "fig3-leapfrogging" => leapfrogging()?,
        "kepler-long" => kepler()?,
        "links" => links()?,
        "top" => top()?,
        "guiding-centre" => guiding_centre()?,
        "shear-layer" => shear_layer()?,
        _ => return Ok(None),
    }))
}

fn leapfrogging() -> Result<Record> {
    let Case { vortices, start } = models::leapfrogging();
    let record = Integrator::new(vortices, Gauss::<3>::new(), 0.25, start)?.record(1, 800)?;
    Ok(record.with_title("Two pairs of vortices that overtake each other"))
}

fn kepler() -> Result<Record> {
    const STEPS: u64 = 4000;
    let orbit = Orbit { e: 0.95 };
    let mut run = Integrator::new(Kepler {}, Gauss::<3>::new(), TAU / STEPS as f64, orbit.pericentre())?;
    let origin = |_: &Kepler, _: &_, _: f64| 0.0;
    let recorder =
        Recorder::new(run.system()).with_function("sun_x", origin)?.with_function("sun_y", origin)?;
    let record = recorder.record(&mut run, STEPS / 400, 1200)?;
    Ok(record
        .with_body("planet", &["x", "y"])?
        .with_body("sun", &["sun_x", "sun_y"])?
        .with_title("An orbit with e = 0.95"))
}

fn links() -> Result<Record> {
    let pendulum = Links { n: 50 };
    let start = pendulum.bent(0.5);
    let record = Integrator::new(pendulum, Rattle::default(), 0.01, start)?.record(4, 500)?;
    thinned(&record, "Every other mass of a pendulum of 50 links", |k| k % 2 == 1)
}

fn top() -> Result<Record> {
    let top = Top { across: 1.0, along: 0.5, weight: 1.0 };
    let start = Top::leaning(0.6, [0.0, -0.4, 5.0]);
    let record = Integrator::new(top, Geodesic::trapezoid(), 0.02, start)?.record(2, 750)?;
    Ok(record.with_title("The axes of a heavy top"))
}

fn guiding_centre() -> Result<Record> {
    let of = |u: f64| {
        let system = TokamakInClass { q: 2.0, mu: 6e-5 };
        let start = TokamakInClassState { r: 0.2, theta: 0.0, phi: 0.0, u };
        let mut run = Integrator::new(system.clone(), OneStep::midpoint(), 40.0, start)?;
        let recorder = Recorder::new(&system)
            .with_function("R", |_, state: &TokamakInClassState, _| 1.0 + state.r * state.theta.cos())?
            .with_function("Z", |_, state, _| state.r * state.theta.sin())?;
        Ok(recorder.record(&mut run, 1, 1200)?)
    };
    let [banana, passing] = each([4e-3, 1.2e-2], of)?;
    let [across, up] = each(["R", "Z"], |name| Ok(passing.numbers(name)?.to_vec()))?;
    let record =
        banana.with_column(Column::new("passing R", across))?.with_column(Column::new("passing Z", up))?;
    let record =
        record.with_body("banana", &["R", "Z"])?.with_body("passing", &["passing R", "passing Z"])?;
    Ok(record.with_title("Two guiding centres in the section of a tokamak"))
}

fn shear_layer() -> Result<Record> {
    let layer = ShearLayer { rows: 5, amplitude: 0.01 };
    let system = layer.system();
    let fast = FastSum::<_, 2>::new(&system, 1e-6)?;
    // The stages converge no further than the sum is accurate.
    let stopping = Stopping { tolerance: 1e-7, ..Stopping::default() };
    let method = Gauss { stopping, ..Gauss::<3>::new() };
    let record = Integrator::new(&fast, method, 0.1, layer.state())?.record(1, 100)?;
    thinned(&record, "One in seven of the 1560 blobs of a shear layer", |k| k % 7 == 0)
}

/// 3 of `x[3]` and of `r[3].x`.
fn index(name: &str) -> Option<usize> {
    let (name, index) = name.split_once('[')?;
    if name.starts_with("dot_") { None } else { index.split_once(']')?.0.parse().ok() }
}

/// The time and the coordinates of some of many bodies, in thousandths: a page is as long as its digits.
fn thinned(record: &Record, title: &str, wanted: impl Fn(usize) -> bool) -> Result<Record> {
    let mut thin = Record::new(title);
    for column in record.columns() {
        if column.name == "time" || index(&column.name).is_some_and(&wanted) {
            let values = record.numbers(&column.name)?.iter().map(|x| (x * 1e3).round() / 1e3);
            let column =
                Column::new(&column.name, values.collect::<Vec<_>>()).with_quantity(column.quantity);
            thin = thin.with_column(column)?;
        }
    }
    Ok(thin)
}
