//! A page that shows a record: one file of HTML with the data, the plotting library and what draws.

use std::io::{self, BufWriter, Write};

use super::Record;
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

pub(super) fn write(record: &Record, to: impl Write) -> io::Result<()> {
    let mut to = BufWriter::new(to);
    let mut rest = TEMPLATE;
    // Names in double braces stand for what is put there.
    while let Some((before, after)) = rest.split_once("{{") {
        to.write_all(before.as_bytes())?;
        let (name, after) = after.split_once("}}").unwrap_or((after, ""));
        match name {
            "title" => escaped(record.title(), &mut to)?,
            "style" => STYLES.iter().try_for_each(|style| to.write_all(style.as_bytes()))?,
            "script" => SCRIPTS.iter().try_for_each(|script| to.write_all(script.as_bytes()))?,
            _ => data(record, &mut to)?,
        }
        rest = after;
    }
    to.write_all(rest.as_bytes())?;
    to.flush()
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

/// The columns of numbers and the bodies, in JSON.
fn data(record: &Record, to: &mut impl Write) -> io::Result<()> {
    to.write_all(b"{\"columns\":[")?;
    let columns = record.columns().iter().filter(|column| !matches!(column.values(), Values::Texts(_)));
    list(columns, to, |column, to| {
        to.write_all(b"\n{\"name\":")?;
        string(column.name(), to)?;
        to.write_all(b",\"unit\":")?;
        string(column.unit(), to)?;
        write!(to, ",\"quantity\":\"{}\",\"values\":[", column.quantity().name())?;
        values(column, to)?;
        to.write_all(b"]}")
    })?;
    to.write_all(b"],\n\"bodies\":[")?;
    list(record.bodies().iter(), to, |body, to| {
        to.write_all(b"{\"name\":")?;
        string(&body.name, to)?;
        write!(to, ",\"is_arm\":{},\"position\":[", body.is_arm)?;
        list(body.position.iter(), to, |name, to| string(name, to))?;
        to.write_all(b"]}")
    })?;
    to.write_all(b"]}")
}

fn values(column: &Column, to: &mut impl Write) -> io::Result<()> {
    match column.values() {
        // There are no other numbers in JSON than finite ones.
        Values::Numbers(numbers) => list(numbers.iter(), to, |number, to| {
            if number.is_finite() { write!(to, "{number:?}") } else { to.write_all(b"null") }
        }),
        Values::Counts(counts) => list(counts.iter(), to, |count, to| write!(to, "{count}")),
        Values::Texts(_) => Ok(()),
    }
}

/// What `item` writes, with commas between.
fn list<T, W: Write>(
    items: impl Iterator<Item = T>,
    to: &mut W,
    mut item: impl FnMut(T, &mut W) -> io::Result<()>,
) -> io::Result<()> {
    for (place, each) in items.enumerate() {
        if place > 0 {
            to.write_all(b",")?;
        }
        item(each, to)?;
    }
    Ok(())
}

/// A text in JSON that does not end the element of HTML that it stands in.
fn string(text: &str, to: &mut impl Write) -> io::Result<()> {
    to.write_all(b"\"")?;
    for letter in text.chars() {
        match letter {
            '"' | '\\' => write!(to, "\\{letter}")?,
            '<' | '\0'..='\x1f' => write!(to, "\\u{:04x}", u32::from(letter))?,
            _ => write!(to, "{letter}")?,
        }
    }
    to.write_all(b"\"")
}
