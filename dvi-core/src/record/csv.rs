//! Records as tables in CSV.

use std::format;
use std::io::{self, Write};
use std::string::ToString;

use super::Record;
use super::column::Values;

impl Record {
    /// Writes a table in CSV: the names, then a line for each row. Its numbers can be read back without a
    /// rounding error; those that are none are `NaN`, `inf` and `-inf`.
    ///
    /// # Errors
    /// Those of `to`.
    pub fn write_csv(&self, to: impl Write) -> io::Result<()> {
        let mut writer = csv::Writer::from_writer(to);
        writer.write_record(self.columns.iter().map(|column| &column.name)).map_err(io::Error::from)?;
        for row in 0..self.rows() {
            let entries = self.columns.iter().map(|column| match &column.values {
                // As many digits as tell it from its neighbours.
                Values::Numbers(numbers) => format!("{:?}", numbers[row]),
                Values::Counts(counts) => counts[row].to_string(),
                Values::Texts(texts) => texts[row].clone(),
            });
            writer.write_record(entries).map_err(io::Error::from)?;
        }
        writer.flush()
    }
}
