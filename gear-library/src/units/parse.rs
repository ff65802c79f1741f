//! Reading a value with its unit.

use super::{Quantity, UnitError, table};
use crate::nearest::nearest;

/// Reads a value such as `3/8 in`, `1,700 lbf` or `0.5 m/s` into SI.
///
/// # Errors
/// Where the number does not read, the unit is missing, unknown, or measures something else.
pub fn parse(text: &str, quantity: Quantity) -> Result<f64, UnitError> {
    let (number, unit) = split(text.trim());
    let value = read_number(number).ok_or_else(|| bad_number(text, number, quantity))?;
    let factor = read_unit(text, unit, quantity)?;
    Ok(value * factor)
}

/// Splits `1 1/2 in` into `1 1/2` and `in`.
fn split(text: &str) -> (&str, &str) {
    let mut end = 0;
    let bytes = text.as_bytes();
    while end < bytes.len() {
        let exponent = matches!(bytes[end], b'e' | b'E') && exponent_follows(bytes, end);
        let sign = matches!(bytes[end], b'+' | b'-')
            && (end == 0 || matches!(bytes[end - 1], b'e' | b'E'));
        let part = bytes[end].is_ascii_digit()
            || matches!(bytes[end], b'.' | b',' | b' ')
            || exponent
            || sign;
        let fraction =
            bytes[end] == b'/' && end > 0 && bytes.get(end + 1).is_some_and(u8::is_ascii_digit);
        if !part && !fraction {
            break;
        }
        end += 1;
    }
    (text[..end].trim(), text[end..].trim())
}

fn exponent_follows(bytes: &[u8], at: usize) -> bool {
    let after = bytes.get(at + 1).copied().unwrap_or(b' ');
    let digits = after.is_ascii_digit()
        || (matches!(after, b'+' | b'-') && bytes.get(at + 2).is_some_and(u8::is_ascii_digit));
    at > 0 && bytes[at - 1].is_ascii_digit() && digits
}

/// A decimal, a fraction, or a whole number with a fraction; thousands may have commas.
fn read_number(text: &str) -> Option<f64> {
    let mut parts = text.split_whitespace();
    let (first, second) = (parts.next()?, parts.next());
    if parts.next().is_some() {
        return None;
    }
    let value = match second {
        None => read_fraction(first).or_else(|| read_decimal(first))?,
        Some(fraction) => {
            let whole = read_decimal(first).filter(|_| !first.contains('.'))?;
            let part = read_fraction(fraction)?;
            if first.starts_with('-') { whole - part } else { whole + part }
        }
    };
    value.is_finite().then_some(value)
}

fn read_fraction(text: &str) -> Option<f64> {
    let (above, below) = text.split_once('/')?;
    let (above, below) = (read_decimal(above)?, read_decimal(below)?);
    (below > 0.0).then(|| above / below)
}

/// The size nearest to a fraction of an inch that no rule has, such as `5/17 in`; `None` for every other text.
pub(crate) fn odd_fraction(text: &str) -> Option<String> {
    let (number, unit) = split(text.trim());
    let unit = table::find(unit, Quantity::Length).filter(|unit| unit.name() == "in")?;
    let (_, below) = number.split_whitespace().last()?.split_once('/')?;
    if ["2", "4", "8", "16", "32", "64"].contains(&below) {
        return None;
    }
    let sixteenths = (read_number(number)? * 16.0).round().max(1.0);
    Some(super::format(sixteenths / 16.0 * unit.factor(), unit))
}

fn read_decimal(text: &str) -> Option<f64> {
    let well_grouped = text.split('.').next().is_some_and(|whole| {
        let mut groups = whole.split(',');
        let first = groups.next().unwrap_or_default();
        !whole.contains(',') || (!first.is_empty() && groups.all(|group| group.len() == 3))
    });
    let fraction_has_comma =
        text.split_once('.').is_some_and(|(_, fraction)| fraction.contains(','));
    if !well_grouped || fraction_has_comma {
        return None;
    }
    text.replace(',', "").parse().ok()
}

fn bad_number(text: &str, number: &str, quantity: Quantity) -> UnitError {
    let message = if number.is_empty() {
        format!("`{text}` has no number")
    } else {
        format!("`{number}` does not read as a number")
    };
    let comma = if number.contains(',') {
        "; write decimals with a point, commas only between thousands"
    } else {
        ""
    };
    UnitError {
        message,
        help: format!("expected {} such as {}{comma}", quantity.noun(), quantity.examples()),
    }
}

/// The factor of a unit, or what is wrong with it.
fn read_unit(text: &str, unit: &str, quantity: Quantity) -> Result<f64, UnitError> {
    let expected = format!("expected {} such as {}", quantity.noun(), quantity.examples());
    if quantity == Quantity::Ratio {
        let message = format!("`{text}` has the unit `{unit}`, but this is a pure number");
        return match unit {
            "" => Ok(1.0),
            "%" => Ok(0.01),
            _ => Err(UnitError { message, help: expected }),
        };
    }
    if unit.is_empty() {
        return Err(UnitError { message: format!("`{text}` has no unit"), help: expected });
    }
    if let Some(found) = table::find(unit, quantity) {
        return Ok(found.factor());
    }
    let other = Quantity::ALL.into_iter().find(|other| table::find(unit, *other).is_some());
    let message = match other {
        Some(other) => {
            format!("`{unit}` is a unit of {}, not of {}", other.noun(), quantity.noun())
        }
        None => format!("unknown unit `{unit}`"),
    };
    let names = quantity.units().iter().flat_map(super::Unit::names).copied();
    let known: Vec<&str> = quantity.units().iter().map(super::Unit::name).collect();
    let meant = match other {
        None => nearest(unit, names),
        // In the trade a pull of so many pounds is mostly written without the `f`.
        Some(Quantity::Mass) if quantity == Quantity::Force && unit.starts_with("lb") => {
            Some("lbf")
        }
        Some(_) => None,
    };
    let number = text.trim().trim_end_matches(unit).trim();
    let hint = meant.map_or_else(
        || format!("; known units are {}", known.join(", ")),
        |name| format!("; did you mean `{number} {name}`?"),
    );
    Err(UnitError { message, help: expected + &hint })
}
