//! Numbers as the READMEs write them.

/// Two digits and a power of ten, rounded up: for bounds.
pub(crate) fn at_most(value: f64) -> String {
    let mut exponent = value.log10().floor() as i32;
    let mut tenths = (value / 10f64.powi(exponent - 1) - 1e-9).ceil();
    if tenths >= 100.0 {
        (tenths, exponent) = (10.0, exponent + 1);
    }
    power(tenths / 10.0, exponent)
}

/// Two digits and a power of ten.
pub(crate) fn about(value: f64) -> String {
    let text = format!("{value:.1e}");
    let (mantissa, exponent) = text.split_once('e').expect("an exponent");
    power(mantissa.parse().expect("a number"), exponent.parse().expect("a number"))
}

pub(crate) fn power(mantissa: f64, exponent: i32) -> String {
    let superscript = |digit: char| match digit {
        '-' => '⁻',
        digit => "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(digit as usize - '0' as usize).expect("a digit"),
    };
    format!("{mantissa:.1}·10{}", exponent.to_string().chars().map(superscript).collect::<String>())
}
