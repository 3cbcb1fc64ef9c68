//! A page that shows a record: one file of HTML with the data, the plotting library and what draws.

use std::io::{self, BufWriter, Write};
use std::string::String;
use std::vec::Vec;

use serde::Serialize;

use super::Record;
use super::body::Body;
use super::column::{Column, Values};

const TEMPLATE: &str = include_str!("page/page.html");
const STYLES: [&str; 2] = [include_str!("page/uplot.css"), include_str!("page/page.css")];
/// `uplot.js` is the plotting library, as `make-uplot` makes it.
const SCRIPTS: [&str; 6] = [
    include_str!("page/uplot.js"),
    include_str!("page/data.js"),
    include_str!("page/charts.js"),
    include_str!("page/motion.js"),
    include_str!("page/frame.js"),
    include_str!("page/main.js"),
];

impl Record {
    /// Writes a page of HTML that shows the columns over time, any column against any other, and, if there
    /// are [bodies](Self::with_body), how they move. It is one file, which needs no network and no server:
    /// less than 100 kB, and about 20 bytes for each number. Numbers that are none are gaps. Of long columns
    /// at most 4000 points over time are drawn, the extremes among them, and 60,000 against each other; the
    /// page says of how many. Columns of texts are not on it.
    ///
    /// # Errors
    /// Those of `to`.
    pub fn write_page(&self, to: impl Write) -> io::Result<()> {
        let mut to = BufWriter::new(to);
        let mut rest = TEMPLATE;
        // Names in double braces stand for what is put there.
        while let Some((before, after)) = rest.split_once("{{") {
            to.write_all(before.as_bytes())?;
            let (name, after) = after.split_once("}}").unwrap_or((after, ""));
            match name {
                "title" => escaped(self.title(), &mut to)?,
                "style" => STYLES.iter().try_for_each(|style| to.write_all(style.as_bytes()))?,
                "script" => SCRIPTS.iter().try_for_each(|script| to.write_all(script.as_bytes()))?,
                _ => to.write_all(data(self)?.as_bytes())?,
            }
            rest = after;
        }
        to.write_all(rest.as_bytes())?;
        to.flush()
    }
}

/// A text between tags.
fn escaped(text: &str, to: &mut impl Write) -> io::Result<()> {
    for letter in text.chars() {
        match letter {
            '&' => to.write_all(b"&amp;")?,
            '<' => to.write_all(b"&lt;")?,
            _ => write!(to, "{letter}")?,
        }
    }
    Ok(())
}

/// The columns of numbers and the bodies, in JSON that does not end the element of HTML that it stands in.
/// Numbers that are none are `null` there.
fn data(record: &Record) -> io::Result<String> {
    #[derive(Serialize)]
    struct Data<'r> {
        columns: Vec<&'r Column>,
        bodies: Vec<Body>,
    }

    let columns = record.columns().iter().filter(|column| !matches!(column.values, Values::Texts(_)));
    let text = serde_json::to_string(&Data { columns: columns.collect(), bodies: record.bodies() })?;
    Ok(text.replace('<', "\\u003c"))
}
