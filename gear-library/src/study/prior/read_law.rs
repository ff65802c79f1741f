//! Reading a distribution: `uniform`, `normal`, `bins`, `choice` or `value`.

use super::known::Takes;
use super::law::{Law, Level};
use crate::fields::{Fields, Range, read_value};
use crate::tree::{Content, Node};
use crate::units::{self, Quantity};

/// One of `uniform`, `normal` with `between`, `bins` or `choice` with `weights`, or `value`.
pub(super) fn law(fields: &Fields<'_>, known: Option<Takes>) -> Option<Law> {
    let given = ["uniform", "normal", "bins", "choice", "value"].map(|key| fields.get(key));
    let between = fields.get("between");
    let weights = fields.get("weights");
    match given {
        [Some(node), None, None, None, None] => uniform(node, known, fields),
        [None, Some(node), None, None, None] => normal(node, between, known, fields),
        [None, None, Some(node), None, None] => bins(node, weights, known, fields),
        [None, None, None, Some(node), None] => choice(node, weights, known, fields),
        [None, None, None, None, Some(node)] => {
            Some(Law::Choice(vec![(level(node, known, fields)?, 1.0)]))
        }
        _ => {
            fields.missing("uniform", "write one of uniform = [least, greatest], normal = [mean, deviation] with between = [least, greatest], bins = [a, b, c] with weights = [0.3, 0.7], choice = [a, b] or value = a");
            None
        }
    }
}

fn uniform(node: &Node, known: Option<Takes>, fields: &Fields<'_>) -> Option<Law> {
    let (pair, quantity) = numbers(node, known, fields)?;
    let [low, high] = two(&pair, node, fields)?;
    if low >= high {
        fields.problems().push(node.place.error(
            "the first value is not below the second",
            "write the least value first; value = … where it does not vary",
        ));
        return None;
    }
    Some(Law::Uniform { low, high, quantity })
}

fn normal(
    node: &Node,
    between: Option<&Node>,
    known: Option<Takes>,
    fields: &Fields<'_>,
) -> Option<Law> {
    let Some(between) = between else {
        fields.missing("between", "a normal law is cut off: write between = [least, greatest]");
        return None;
    };
    // A deviation need not lie in the quantity's own range.
    let free = known.map(|takes| {
        if let Takes::Number(quantity, _) = takes {
            Takes::Number(quantity, Range::Any)
        } else {
            takes
        }
    });
    let (pair, quantity) = numbers(node, free, fields)?;
    let [mean, deviation] = two(&pair, node, fields)?;
    let (ends, _) = numbers(between, known, fields)?;
    let [low, high] = two(&ends, between, fields)?;
    if deviation <= 0.0 || low >= high {
        fields.problems().push(node.place.error(
            "this normal law has no width",
            "the deviation is above zero, and `between` rises",
        ));
        return None;
    }
    Some(Law::Normal { mean, deviation, low, high, quantity })
}

fn bins(
    node: &Node,
    weights: Option<&Node>,
    known: Option<Takes>,
    fields: &Fields<'_>,
) -> Option<Law> {
    let (edges, quantity) = numbers(node, known, fields)?;
    let weights = weights.map_or_else(|| Some(Vec::new()), |node| shares(node, fields))?;
    let sum: f64 = weights.iter().sum();
    let rises = edges.len() > 1 && edges.windows(2).all(|ends| ends[0] < ends[1]);
    if !rises || weights.len() + 1 != edges.len() || sum <= 0.0 {
        fields.problems().push(node.place.error(
            "`bins` and `weights` do not fit",
            "write the ends of ranges in rising order, and one weight for each range, not all zero",
        ));
        return None;
    }
    let shares = weights.into_iter().map(|weight| weight / sum).collect();
    Some(Law::Bins { edges, shares, quantity })
}

/// Weights as they are written.
fn shares(node: &Node, fields: &Fields<'_>) -> Option<Vec<f64>> {
    let Content::List(items) = &node.content else {
        fields.problems().push(node.place.error(
            format!("`weights` is {}", node.content.noun()),
            "write a list of numbers, such as weights = [0.7, 0.3]",
        ));
        return None;
    };
    let read = items.iter().map(|item| {
        read_value(item, Quantity::Ratio, Range::NotNegative, fields.problems()).map(|at| at.value)
    });
    read.collect()
}

fn choice(
    node: &Node,
    weights: Option<&Node>,
    known: Option<Takes>,
    fields: &Fields<'_>,
) -> Option<Law> {
    let Content::List(items) = &node.content else {
        fields.problems().push(node.place.error(
            "`choice` is no list",
            "write choice = [a, b], and weights = [0.7, 0.3] where they are not alike",
        ));
        return None;
    };
    let levels =
        items.iter().map(|item| level(item, known, fields)).collect::<Option<Vec<Level>>>()?;
    let weights = match weights {
        None => vec![1.0; levels.len()],
        Some(node) => shares(node, fields)?,
    };
    let sum: f64 = weights.iter().sum();
    if weights.len() != levels.len() || levels.is_empty() || sum <= 0.0 {
        fields.problems().push(node.place.error(
            "`choice` and `weights` do not fit",
            "give as many weights as values, not all zero",
        ));
        return None;
    }
    let mut choice: Vec<(Level, f64)> =
        levels.into_iter().zip(weights.into_iter().map(|weight| weight / sum)).collect();
    choice.sort_by(|one, other| one.0.text.cmp(&other.0.text));
    Some(Law::Choice(choice))
}

fn level(node: &Node, known: Option<Takes>, fields: &Fields<'_>) -> Option<Level> {
    if let Some(Takes::Number(quantity, range)) = known {
        let number = read_value(node, quantity, range, fields.problems())?.value;
        let text =
            if let Content::Text(text) = &node.content { text.clone() } else { number.to_string() };
        return Some(Level { text, number: Some(number), plain: quantity == Quantity::Ratio });
    }
    match &node.content {
        Content::Text(text) => Some(Level {
            text: text.clone(),
            number: quantity_of(text).map(|(_, number)| number),
            plain: false,
        }),
        Content::Number(number) => {
            Some(Level { text: number.to_string(), number: Some(*number), plain: true })
        }
        Content::Flag(flag) => Some(Level { text: flag.to_string(), number: None, plain: true }),
        other => {
            fields.problems().push(node.place.error(
                format!("this is {}", other.noun()),
                "write a text, a number, true or false",
            ));
            None
        }
    }
}

/// A list of numbers, all of one quantity.
fn numbers(node: &Node, known: Option<Takes>, fields: &Fields<'_>) -> Option<(Vec<f64>, Quantity)> {
    let Content::List(items) = &node.content else {
        fields.problems().push(node.place.error("this is no list", "write two values in brackets"));
        return None;
    };
    let (quantity, range) = match known {
        Some(Takes::Number(quantity, range)) => (quantity, range),
        Some(Takes::Word) => {
            fields.problems().push(
                node.place.error("this is drawn among words", "write choice = [\"…\", \"…\"]"),
            );
            return None;
        }
        None => {
            let first = items.first().map(|item| &item.content);
            let quantity = if let Some(Content::Text(text)) = first {
                quantity_of(text).map(|(quantity, _)| quantity)
            } else {
                None
            };
            (quantity.unwrap_or(Quantity::Ratio), Range::Any)
        }
    };
    let read: Vec<_> =
        items.iter().map(|item| read_value(item, quantity, range, fields.problems())).collect();
    let values = read
        .into_iter()
        .map(|value| value.map(|value| value.value))
        .collect::<Option<Vec<f64>>>()?;
    Some((values, quantity))
}

fn two(values: &[f64], node: &Node, fields: &Fields<'_>) -> Option<[f64; 2]> {
    if let [first, second] = *values {
        return Some([first, second]);
    }
    fields
        .problems()
        .push(node.place.error(format!("there are {} values", values.len()), "write two"));
    None
}

/// What a text with a unit measures.
fn quantity_of(text: &str) -> Option<(Quantity, f64)> {
    Quantity::ALL
        .into_iter()
        .find_map(|quantity| Some((quantity, units::parse(text, quantity).ok()?)))
}
