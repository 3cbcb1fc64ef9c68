//! The table of the full run.

/// One row of the table.
pub(crate) struct Row {
    pub(crate) experiment: String,
    pub(crate) kind: String,
    pub(crate) place: String,
    pub(crate) text: String,
    pub(crate) value: String,
    pub(crate) verdict: String,
}

pub(crate) fn rows() -> Vec<Row> {
    let mut reader = csv::Reader::from_reader(include_str!("../../full-run.csv").as_bytes());
    let rows = reader.records().map(|row| row.expect("a row"));
    let row = |row: csv::StringRecord| {
        assert_eq!(&row[1], "full", "a part of another form: {row:?}");
        let cell = |i: usize| row[i].to_owned();
        Row {
            experiment: cell(0),
            kind: cell(3),
            place: cell(4),
            text: cell(5),
            value: cell(6),
            verdict: cell(10),
        }
    };
    rows.map(row).collect()
}

/// The number that the experiment has measured for the quantity.
pub(crate) fn value(rows: &[Row], experiment: &str, quantity: &str) -> f64 {
    let row = rows.iter().find(|row| row.experiment == experiment && row.text == quantity);
    let row = row.unwrap_or_else(|| panic!("{experiment} does not measure `{quantity}`"));
    row.value.parse().unwrap_or_else(|_| panic!("{experiment} has not measured `{quantity}`"))
}
