//! Files of records, read again by other means than they are written by.

use std::process::{Command, Stdio};
use std::{fs, io::Write as _};

use dvi_core::prelude::*;
use dvi_core::record::{Column, Record, RecordError, Values};

use crate::records::{Checked, KEPLER, START, bits};

/// Numbers that are hard to write.
const NUMBERS: [f64; 8] =
    [0.1, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 5e-324, f64::MAX, 0.1 + 0.2];

/// Columns of all kinds, with names that are hard to write too.
fn mixed() -> Result<Record, RecordError> {
    let texts = ["", "a", "two words", "α, \"β\"\n", "'", "\\", "𝛾𝛾𝛾𝛾𝛾𝛾𝛾𝛾𝛾𝛾", "end"].map(str::to_owned);
    Record::new("Mixed")
        .with_column(Column::new("a, \"b\"", NUMBERS.to_vec()))?
        .with_column(Column::new("it's \\ φ\n", texts.to_vec()))?
        .with_column(Column::new("count", vec![0, 1, 2, 3, 4, 5, 6, u64::MAX]))
}

/// A reader of CSV by the rules of RFC 4180, letter by letter.
fn cells(text: &str) -> Vec<Vec<String>> {
    let (mut rows, mut row, mut cell, mut is_quoted) = (Vec::new(), Vec::new(), String::new(), false);
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '"' if is_quoted && letters.next_if_eq(&'"').is_some() => cell.push('"'),
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => row.push(std::mem::take(&mut cell)),
            '\n' if !is_quoted => {
                row.push(std::mem::take(&mut cell));
                rows.push(std::mem::take(&mut row));
            }
            _ => cell.push(letter),
        }
    }
    rows
}

#[test]
fn the_csv_reads_back_to_the_bit() -> Checked {
    let mut run = Integrator::new(&KEPLER, Variational::trapezoid(), 0.02, START)?;
    for record in [run.record(5, 100)?, mixed()?] {
        let mut file = Vec::new();
        record.write_csv(&mut file)?;
        let rows = cells(std::str::from_utf8(&file)?);
        assert_eq!(rows.len(), record.rows() + 1);
        for (place, column) in record.columns().iter().enumerate() {
            assert_eq!(rows[0][place], column.name);
            for (row, cells) in rows[1..].iter().enumerate() {
                match &column.values {
                    Values::Numbers(numbers) => {
                        let found: f64 = cells[place].parse()?;
                        let is_same = found.to_bits() == numbers[row].to_bits();
                        assert!(is_same || found.is_nan() && numbers[row].is_nan(), "{}", cells[place]);
                    }
                    Values::Counts(counts) => assert_eq!(cells[place].parse(), Ok(counts[row])),
                    Values::Texts(texts) => assert_eq!(cells[place], texts[row]),
                    other => return Err(format!("{other:?}").into()),
                }
            }
        }
    }
    Ok(())
}

/// By the description of the format: the mark, the version, the length of the head, the head, the data.
#[test]
fn the_array_has_the_format_of_numpy() -> Checked {
    let mut file = Vec::new();
    mixed()?.write_npy(&mut file)?;
    assert_eq!(&file[..8], b"\x93NUMPY\x03\x00");
    let len = u32::from_le_bytes(file[8..12].try_into()?) as usize;
    let (head, data) = file[12..].split_at(len);
    assert_eq!((12 + len) % 64, 0);
    let expected = "{'descr': [('a, \"b\"', '<f8'), ('it\\'s \\\\ φ\\u000a', '<U10'), ('count', '<u8'), ], \
                    'fortran_order': False, 'shape': (8,), }";
    let head = std::str::from_utf8(head)?;
    assert_eq!((head.trim_end(), head.chars().last()), (expected, Some('\n')));
    let size = 8 + 4 * 10 + 8;
    assert_eq!(data.len(), 8 * size);
    let number = |record: &[u8]| record[..8].try_into().map(f64::from_le_bytes);
    let numbers: Vec<f64> = data.chunks(size).map(number).collect::<Result<_, _>>()?;
    assert_eq!(bits(&numbers), bits(&NUMBERS));
    assert_eq!(data[6 * size + 8..][..4], u32::from('𝛾').to_le_bytes());
    assert_eq!(data[size + 8..][..12], [b'a', 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]);
    assert_eq!(data[8 * size - 8..], [255; 8]);
    Ok(())
}

const PROGRAM: &str = "
import sys, numpy
array = numpy.load(sys.argv[1])
for name in array.dtype.names:
    for x in array[name]:
        print(repr(name), float(x).hex() if array.dtype[name].kind == 'f' else repr(x.item()))
";

/// NumPy itself, where it is: it writes down what it has read in hexadecimal.
#[test]
fn numpy_reads_the_array() -> Checked {
    let has_numpy = |python: &&str| {
        let imported = Command::new(python).args(["-c", "import numpy"]).stderr(Stdio::null()).status();
        imported.is_ok_and(|status| status.success())
    };
    let Some(python) = ["python3", "/usr/bin/python3"].into_iter().find(has_numpy) else {
        writeln!(std::io::stderr(), "NOT CHECKED: Python has no numpy")?;
        return Ok(());
    };
    let record = mixed()?;
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("mixed.npy");
    record.write_npy(fs::File::create(&path)?)?;
    let output = Command::new(python).args(["-c", PROGRAM]).arg(&path).output()?;
    let said = String::from_utf8(output.stdout)?;
    let lines: Vec<&str> = said.lines().collect();
    assert_eq!(lines.len(), 24, "{said}{}", String::from_utf8_lossy(&output.stderr));
    assert_eq!(lines[1], "'a, \"b\"' -0x0.0p+0");
    assert_eq!(lines[2], "'a, \"b\"' nan");
    assert_eq!(lines[5], "'a, \"b\"' 0x0.0000000000001p-1022");
    assert_eq!(lines[7], "'a, \"b\"' 0x1.3333333333334p-2");
    assert_eq!(lines[11], r#""it's \\ φ\n" 'α, "β"\n'"#);
    assert_eq!(lines[14], r#""it's \\ φ\n" '𝛾𝛾𝛾𝛾𝛾𝛾𝛾𝛾𝛾𝛾'"#);
    assert_eq!(lines[23], "'count' 18446744073709551615");
    Ok(())
}
