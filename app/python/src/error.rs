//! Errors of the session as exceptions with file, line and field.

use endline_gear::Diagnostic;
use endline_session::Error;
use pyo3::create_exception;
use pyo3::exceptions::PyException;
use pyo3::prelude::*;
use pyo3::types::PyDict;

create_exception!(
    endline,
    EndlineError,
    PyException,
    "An error of Endline. `file` (str), `line` (int, from 1) and `field` (str) are its place, `help` is its correction; each is \
     None where it does not apply. `problems` lists every located problem as a dictionary with these keys, `column` and `message`."
);

/// The exception of an error.
pub fn raised(error: Error) -> PyErr {
    let raised = EndlineError::new_err(error.to_string());
    let added = Python::attach(|python| match &error {
        Error::Diagnostics(problems) => add_details(&raised, python, problems, None),
        Error::File { file, .. } => add_details(&raised, python, &[], Some(file)),
        _ => add_details(&raised, python, &[], None),
    });
    added.err().unwrap_or(raised)
}

/// The exception of a plain message.
pub fn failed(message: String) -> PyErr {
    raised(Error::Message(message))
}

fn add_details(
    raised: &PyErr,
    python: Python<'_>,
    problems: &[Diagnostic],
    file: Option<&String>,
) -> PyResult<()> {
    let value = raised.value(python);
    let first = problems.first();
    value.setattr("file", first.map(|problem| &problem.file).or(file))?;
    value.setattr("line", first.map(|problem| problem.line).filter(|line| *line > 0))?;
    value
        .setattr("field", first.map(|problem| &problem.field).filter(|field| !field.is_empty()))?;
    value.setattr("help", first.map(|problem| &problem.help).filter(|help| !help.is_empty()))?;
    let all: PyResult<Vec<_>> = problems.iter().map(|problem| as_dict(python, problem)).collect();
    value.setattr("problems", all?)
}

/// A located problem as a dictionary.
pub fn as_dict<'py>(python: Python<'py>, problem: &Diagnostic) -> PyResult<Bound<'py, PyDict>> {
    let dict = PyDict::new(python);
    dict.set_item("file", &problem.file)?;
    dict.set_item("line", problem.line)?;
    dict.set_item("column", problem.column)?;
    dict.set_item("field", &problem.field)?;
    dict.set_item("message", &problem.message)?;
    dict.set_item("help", &problem.help)?;
    dict.set_item("is_error", problem.is_error())?;
    Ok(dict)
}
