//! What the checks found, in lines for people.

use super::Tried;

/// A line for each plugin and each check.
pub(super) fn lines(tried: &[Tried]) -> Vec<String> {
    let mut lines = Vec::new();
    for Tried { info, findings } in tried {
        lines.push(format!("{}  {}  {}: {}", info.id, info.version, info.kind, info.name));
        let (attributes, acts) =
            (counted(info.attributes.len(), "attribute"), counted(info.acts.len(), "act"));
        lines.push(format!("  {:<10}  ok     {attributes}, {acts}", "declared"));
        for finding in findings {
            let (word, told) = match &finding.outcome {
                Ok(told) => ("ok", told),
                Err(fault) => ("FAULT", fault),
            };
            lines.push(format!("  {:<10}  {word:<5}  {told}", finding.check).trim_end().to_owned());
        }
    }
    lines
}

fn counted(count: usize, what: &str) -> String {
    if count == 1 { format!("1 {what}") } else { format!("{count} {what}s") }
}
