//! What the HTML pages of studies, searches and compliance sheets share: style sheet, tables of cells, pictures as SVG, numbered
//! sources.

pub(crate) mod cell;
pub(crate) mod citations;
pub(crate) mod svg;

/// The style sheet of a page.
pub(crate) const STYLE: &str =
    include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets/report/report.css"));
