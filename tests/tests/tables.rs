//! Tables in text: what is read, and what is said where it cannot be.

use approx::abs_diff_eq;
use dvi_core::ScalarField;
use dvi_core::field::{Axis, Spline, Table, TableError};
use dvi_tests::Outcome;

/// What is said of a table, or of the grid of its columns 1 and 2 with the values of column 3.
fn message(text: &str) -> String {
    let attempt = || Table::read(text)?.grid([1, 2])?.values(3);
    attempt().map_or_else(|error| error.to_string(), |values| format!("{values:?}"))
}

/// What is said of what is refused; nothing of what is not.
fn refusal<T>(result: Result<T, TableError>) -> String {
    result.err().map(|error| error.to_string()).unwrap_or_default()
}

const FULL: &str = "1 10 0\n1 20 1\n2 10 2\n2 20 3\n";

#[test]
fn forms_of_one_table() {
    let values = "[0.0, 1.0, 2.0, 3.0]";
    assert_eq!(message(FULL), values);
    let forms = [
        ("tabs", FULL.replace(' ', "\t")),
        ("commas", FULL.replace(' ', ",")),
        ("commas and blanks", FULL.replace(' ', " ,\t")),
        ("semicolons", FULL.replace(' ', "; ")),
        ("Windows", FULL.replace('\n', "\r\n")),
        ("byte order mark", format!("\u{feff}{FULL}")),
        ("byte order mark and names", format!("\u{feff}r z psi\n{FULL}")),
        ("no end of the last line", FULL.trim_end().to_string()),
        (
            "comments and empty lines",
            format!("# a\n% b\n\n  # c d e f\n{}\n\n#", FULL.replace('\n', "\n\n# x\n")),
        ),
        ("indented", FULL.replace("\n", "  \n   ")),
        ("other order of nesting", "1 10 0\n2 10 2\n1 20 1\n2 20 3".to_string()),
        ("falling", "2 20 3\n2 10 2\n1 20 1\n1 10 0".to_string()),
        ("no order", "2 10 2\n1 20 1\n1 10 0\n2 20 3".to_string()),
        ("exponents", "1e0 1d1 0.0\n1E+00 2D+01 .1D1\n2. 100D-1 +2\n0.2d1 2.0e1 30d-1".to_string()),
        ("both zeros are one place", "0 10 0\n-0.0 20 1\n2 10 2\n2 20 3".to_string()),
        ("numbers that nobody asks for", FULL.replace('\n', " nan inf\n")),
    ];
    for (form, text) in forms {
        assert_eq!(message(&text), values, "{form}");
    }
}

#[test]
fn columns_by_name_and_number() -> Outcome {
    let by_name = |text: &str| Table::read(text)?.grid(["z", "r"])?.values("psi");
    let expected = vec![0.0, 2.0, 1.0, 3.0];
    assert_eq!(by_name(&format!("r z psi\n{FULL}"))?, expected);
    assert_eq!(by_name(&format!("# r z psi\n{FULL}"))?, expected);
    assert_eq!(by_name(&format!("% r, z, psi\n{FULL}"))?, expected);
    assert_eq!(by_name(&format!("\"r\";\"z\" ; psi\n{}", FULL.replace(' ', ";")))?, expected);
    let table = Table::read(&format!("# made for a test\n# on a grid\nr\tz\tpsi\n{FULL}"))?;
    assert_eq!(
        (table.names(), table.columns(), table.rows()),
        (&["r", "z", "psi"].map(String::from)[..], 3, 4)
    );
    assert_eq!(table.column("psi")?, table.column(3)?);
    assert_eq!(table.grid([2, 1])?.points(), &[vec![10.0, 20.0], vec![1.0, 2.0]]);
    // A comment that has another number of words names nothing.
    assert!(Table::read(&format!("# r z\n{FULL}"))?.names().is_empty());
    Ok(())
}

/// Each kind of mistake, and what is said of it.
#[test]
fn messages() {
    #[rustfmt::skip]
    let cases = [
        ("", "the table has no row of numbers"),
        ("# r z psi\n\n", "the table has no row of numbers"),
        ("r z psi\n", "the table has no row of numbers"),
        ("1 10 0\n1 x20 1", "line 2, column 2: `x20` is found, and a number is expected"),
        ("1 10 0\n1 2_0 1", "line 2, column 2: `2_0` is found, and a number is expected"),
        ("1 10 −1", "line 1, column 3: `−1` is found, and a number is expected"),
        ("1 10 1.0-100", "line 1, column 3: `1.0-100` is found, and a number is expected"),
        ("r z psi\nm m Wb\n1 10 0", "line 2, column 1: `m` is found, and a number is expected"),
        ("1 10 0 # here", "line 1, column 4: `#` is found, and a number is expected"),
        ("# c\n\n1 10 0\n1 20", "line 4, column 3: 2 columns are found, and 3 are expected, as in line 3"),
        ("r z psi\n1 10 0 7", "line 2, column 4: 4 columns are found, and 3 are expected, as in line 1"),
        ("1,10,0\n1,,1", "line 2, column 2: an empty column is found, and a number is expected"),
        ("1;10;0;\n", "line 1, column 4: an empty column is found, and a number is expected"),
        ("1,5;10;0", "line 1, column 1: `1,5` is found, and a number with a decimal point is expected, or commas between all columns"),
        ("r;z;psi\n1,5;10;0", "line 2, column 1: `1,5` is found, and a number with a decimal point is expected, or commas between all columns"),
        ("1,5 10 0", "line 1, column 2: `1,5 10 0` is found, and a number with a decimal point is expected, or commas between all columns"),
        ("r z psi\n1 10 0,5", "line 2, column 1: `1 10 0,5` is found, and a number with a decimal point is expected, or commas between all columns"),
        ("1 10 0\n1,20,1", "line 2, column 1: columns separated by commas are found, and by blanks are expected, as in line 1"),
        ("r,z,psi\n1;10;0", "line 2, column 1: columns separated by semicolons are found, and by commas are expected, as in line 1"),
        ("1 10 0\n1 NaN 1", "line 2, column 2: NaN is found, and a finite number is expected"),
        ("1 10 0\n1 20 -inf\n2 10 2\n2 20 3", "line 2, column 3: -inf is found, and a finite number is expected"),
        ("1e999 10 0", "line 1, column 1: inf is found, and a finite number is expected"),
        ("1 10\n1 20", "line 1: column 3 is expected, and found are columns 1 to 2"),
        ("1 10 0\n1 20 1\n2 10 2\n2 20 3\n\n1 20 5", "line 6, column 1: the point column 1 = 1, column 2 = 20 is found again, and is expected once; it is in line 2 too"),
        ("r z psi\n1 10 0\n1 20 1\n2 10 2", "line 4, column 1: r = 2 is found in 1 of 2 rows that are expected; the point r = 2, z = 20 is missing"),
        // A coordinate with a slip of the pen: it is pointed at.
        ("1 10 0\n1 20 1\n1 30 1\n2 10 2\n2 20.1 3\n2 30 1\n3 10 2\n3 20 3\n3 30 1", "line 5, column 2: column 2 = 20.1 is out of order, and numbers that increase, or decrease, from each new one to the next are expected"),
        ("1 10 0\n1 20 1\n1 30 1\n2 10 2\n2 200 3\n2 30 1\n3 10 2\n3 20 3\n3 30 1", "line 5, column 2: column 2 = 200 is found in 1 of 3 rows that are expected; the point column 1 = 1, column 2 = 200 is missing"),
        ("r z psi\n3 10 0\n2 10 1\n2.5 10 2", "line 4, column 1: r = 2.5 is out of order, and numbers that increase, or decrease, from each new one to the next are expected"),
        ("r z psi\n3 10 0\n2 10 1\n4 10 2", "line 4, column 1: r = 4 is out of order, and numbers that increase, or decrease, from each new one to the next are expected"),
    ];
    for (text, expected) in cases {
        assert_eq!(message(text), expected, "{text:?}");
    }
}

/// A first row of which nothing can be read is no row of names.
#[test]
fn unreadable_first_rows() -> Outcome {
    #[rustfmt::skip]
    let words = [
        "0.141-270", "********", "1.#QNAN", "-1.#IND", "1.#INF", "-nan(ind)", "nan(0x8)", "NaN(snan)",
        "inf()", "NA", "N/A", "null", "None", "#N/A", "#DIV/0!", "#NUM!", "0x1F", "1.5E", "1e5x", "0.5f",
        "1'000", "2_000", "1\u{2009}234", "1\u{a0}234.5", "\"0.5\"", "(0.5", "$0.5", "+x", "½", "∞", "?",
        "−1", "-----", "...", "--",
    ];
    for word in words {
        let texts = [
            (1, format!("{word}\n0.5\n0.25\n")),
            (2, format!("0.5\n{word}\n0.25\n")),
            (1, format!("{word};1\n1;2\n")),
        ];
        for (line, text) in texts {
            let said = refusal(Table::read(&text));
            assert_eq!(said, format!("line {line}, column 1: `{word}` is found, and a number is expected"));
        }
    }
    // What is a number for Rust is one, and nobody is told before it is asked for.
    for word in ["NaN", "-nan", "inf", "-Infinity", "1d400"] {
        let table = Table::read(&format!("{word}\n0.5\n0.25\n"))?;
        assert_eq!((table.rows(), table.names().len()), (3, 0), "{word}");
        assert!(matches!(table.column(1), Err(TableError::NotFinite { line: 1, .. })), "{word}");
    }
    for names in [
        ["r", "z"],
        ["|B|", "<x>"],
        ["B_r", "e5"],
        ["ψ", "∂ψ/∂r"],
        ["NA", "x"],
        ["nano", "info"],
        ["[m]", "_x"],
    ] {
        let table = Table::read(&format!("{}\n1 2\n", names.join(" ")))?;
        assert_eq!((table.names(), table.rows()), (&names.map(String::from)[..], 1));
    }
    Ok(())
}

#[test]
fn messages_of_names() -> Outcome {
    let said = |text: &str, name: &str| refusal(Table::read(text).and_then(|table| table.column(name)));
    let named = format!("\nr z r\n{FULL}");
    assert_eq!(said(&named, "psi"), "line 2: a column `psi` is expected, and found are `r`, `z`, `r`");
    assert_eq!(said(&named, "r"), "line 2, column 3: `r` is found again, and is the name of column 1 too");
    assert_eq!(said(FULL, "psi"), "line 1: a column `psi` is expected, and found are no names but numbers");
    let zero = refusal(Table::read(FULL)?.column(0));
    assert_eq!(zero, "line 1: column 0 is expected, and found are columns 1 to 3");
    let long = "x".repeat(1000);
    let shown = refusal(Table::read(&format!("1 {long}")));
    assert_eq!(shown, format!("line 1, column 2: `{}…` is found, and a number is expected", "x".repeat(40)));
    Ok(())
}

/// Rows in three orders give one spline, also where the end of the period is among the rows.
#[test]
fn from_text_to_a_spline() -> Outcome {
    let f = |r: f64, z: f64| r * r * (z * std::f64::consts::FRAC_PI_3).sin();
    let row = |i: usize, j: usize| {
        let (r, z) = (1.0 + 0.25 * i as f64, 0.5 * j as f64);
        format!("{r} {z} {}", f(r, z))
    };
    let rows = |order: &dyn Fn(usize) -> (usize, usize), count: usize| {
        let rows: Vec<String> = (0..count).map(order).map(|(i, j)| row(i, j)).collect();
        format!("# r z psi\n{}", rows.join("\n"))
    };
    // 5 × 12 points, or 13 with the end of the period of 6.
    let texts = [
        rows(&|k| (k / 12, k % 12), 60),
        rows(&|k| (k % 5, k / 5), 60),
        rows(&|k| (4 - k % 5, 11 - k / 5), 60),
        rows(&|k| (k / 13, k % 13), 65),
    ];
    for text in texts {
        let table = Table::read(&text)?;
        let grid = table.grid(["r", "z"])?;
        let [r, z] = grid.points();
        let psi = Spline::new([Axis::new(r)?, Axis::periodic(z, 6.0)?], &grid.values("psi")?)?;
        for (r, z) in [(1.0, 0.5), (1.25, 5.5), (2.0, -60.5), (1.75, 7.5)] {
            let value = psi.expansion([r, z]).value;
            assert!(abs_diff_eq!(value, f(r, z), epsilon = 1e-13), "({r}, {z}): {value} {}", f(r, z));
        }
    }
    Ok(())
}

/// What is in a file is no reason to fail: any text is read or refused.
#[test]
fn any_text() {
    let words = [
        "1", "2.5", "-3", "nan", "x", ",", ";", " ", "\n", "\n", "\r\n", "#", "1e5", "1d", "é", "\u{feff}",
        "0", "\t",
    ];
    let mut state = 1_u64;
    let mut next = |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    let (mut read, mut refused) = (0, 0);
    for _ in 0..20_000 {
        let length = next(25);
        let text: String = (0..length).map(|_| words[next(words.len())]).collect();
        match Table::read(&text) {
            Ok(table) => {
                read += 1;
                let _ = table.grid([1]).and_then(|grid| grid.values(2));
                let _ = table.grid([1, 2]).and_then(|grid| grid.values("x"));
                let _ = table.grid([2, 1, 2]);
            }
            Err(error) => {
                refused += 1;
                assert!(!error.to_string().is_empty());
            }
        }
    }
    assert!(read > 1000 && refused > 1000, "{read} {refused}");
}

/// A table of a million numbers is read in a time that is in proportion to it, or this test does not end.
#[test]
fn a_large_table() -> Outcome {
    use std::fmt::Write;
    let (mut text, size) = (String::from("r,z,psi\n"), 300_usize);
    for k in 0..size * size {
        // Backwards, and in columns.
        writeln!(text, "{},{},{k}", size - 1 - k % size, size - 1 - k / size)?;
    }
    let table = Table::read(&text)?;
    let grid = table.grid(["r", "z"])?;
    assert_eq!(grid.values("r")?[size], 1.0);
    assert_eq!(grid.points().each_ref().map(Vec::len), [size, size]);
    Ok(())
}
