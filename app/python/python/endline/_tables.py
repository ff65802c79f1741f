"""A result as labelled tables: an xarray Dataset, pandas DataFrames, HTML."""

from __future__ import annotations

import html
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from ._result import Result

#: Axes, unit and meaning of the arrays of a result.
ARRAYS: dict[str, tuple[tuple[str, ...], str, str]] = {
    "step": (("time",), "1", "steps taken"),
    "node_position_m": (("time", "node", "axis"), "m", "places of the rope's nodes"),
    "tension_N": (("time", "segment"), "N", "tension of each segment; 0 in slack rope"),
    "segment_length_m": (("time", "segment"), "m", "unstretched length of each segment"),
    "is_cut": (("time", "segment"), "1", "whether each segment has parted"),
    "body_position_m": (("time", "body", "axis"), "m", "places of the bodies"),
    "body_orientation": (("time", "body", "quaternion"), "1", "orientation of the bodies, body to world"),
}

#: Arrays of a result with a whale.
WHALE_ARRAYS: dict[str, tuple[tuple[str, ...], str, str]] = {
    "whale_position_m": (("time", "axis"), "m", "place of the origin of the whale's frame"),
    "whale_orientation": (("time", "quaternion"), "1", "orientation of the whale, whale to world"),
    "whale_speed_m_s": (("time",), "m/s", "speed of the whale through the water"),
    "wraps_turns": (("time", "part"), "turns", "turns of rope about each part of the whale"),
    "part_normal_force_N": (("time", "part"), "N", "sum of the normal forces on each part of the whale, mean of the step before the moment"),
    "outcome_kind": (("time",), "1", "outcome of the encounter so far"),
    "outcome_decided": (("time",), "1", "whether the run was then long enough for the outcome to be final"),
}

#: Series of the contacts.
CONTACT_ARRAYS: dict[str, tuple[tuple[str, ...], str, str]] = {
    "moment": (("contact",), "1", "index of the moment on the axis of time"),
    "line": (("contact",), "1", "index of the line"),
    "segment": (("contact",), "1", "index on the axis of segments"),
    "region": (("contact",), "1", "region of the skin"),
    "position_m": (("contact", "axis"), "m", "place on the rope's centre line"),
    "normal": (("contact", "axis"), "1", "unit normal from skin to rope"),
    "normal_force_N": (("contact",), "N", "normal force of skin on rope"),
    "friction_N": (("contact", "axis"), "N", "friction force of skin on rope"),
    "length_m": (("contact",), "m", "length of rope of the contact"),
}


def to_xarray(result: Result) -> Any:
    """The arrays of a result as a Dataset; its attributes name the run."""
    try:
        import xarray
    except ImportError as error:
        raise ImportError("to_xarray() needs the package xarray: pip install xarray") from error

    def variable(values: np.ndarray, about: tuple[tuple[str, ...], str, str]) -> tuple[Any, ...]:
        axes, unit, meaning = about
        return axes, values, {"units": unit, "long_name": meaning}

    variables = {name: variable(getattr(result, name), about) for name, about in ARRAYS.items()}
    if len(result.whale_speed_m_s) > 0:
        variables |= {name: variable(getattr(result, name), about) for name, about in WHALE_ARRAYS.items()}
    contacts = result.contacts
    variables |= {
        f"contact_{name}": variable(getattr(contacts, name), about) for name, about in CONTACT_ARRAYS.items()
    }
    events = result.events
    variables |= {
        "event_time_s": variable(np.array([event.time_s for event in events]), (("event",), "s", "time of the event")),
        "event_kind": variable(_texts(event.kind for event in events), (("event",), "1", "kind of the event")),
        "event_subject": variable(
            _texts(event.subject for event in events), (("event",), "1", "part, line, link or body of the event")
        ),
        "event_value": variable(
            np.array([event.value for event in events], dtype=float), (("event",), "1", "value, with the unit event_unit")
        ),
        "event_unit": variable(_texts(event.unit for event in events), (("event",), "1", "unit of the value")),
    }
    lines = result.lines
    coordinates = {
        "time": variable(result.time_s, (("time",), "s", "simulated time")),
        "node_line": variable(
            _of_lines(result, lambda line: line.nodes), (("node",), "1", "id of the line of each node")
        ),
        "segment_line": variable(
            _of_lines(result, lambda line: line.segments), (("segment",), "1", "id of the line of each segment")
        ),
        "line_id": variable(_texts(lines.keys()), (("line",), "1", "id of each line, by the index in contact_line")),
        "body": variable(_texts(result.bodies), (("body",), "1", "id of the body")),
        "part": variable(_texts(result.parts), (("part",), "1", "part of the whale")),
        "axis": variable(_texts("xyz"), (("axis",), "1", "x east, y north, z up from the mean sea surface")),
        "quaternion": variable(_texts("xyzw"), (("quaternion",), "1", "parts of a quaternion")),
    }
    figures = result.figures
    about = {key: figures[key] for key in ("scenario", "seed", "state_hash", "model_hash", "version")}
    about["headline"] = " ".join(result.outcome.headline)
    return xarray.Dataset(variables, coordinates, about)


def to_pandas(result: Result, table: str) -> Any:
    """A table of a result by its name."""
    try:
        import pandas
    except ImportError as error:
        raise ImportError("to_pandas() needs the package pandas: pip install pandas") from error

    if table not in TABLES:
        raise ValueError(f"table={table!r}: expected one of {', '.join(map(repr, TABLES))}")
    frame = pandas.DataFrame(TABLES[table](result))
    return frame.set_index("time_s") if table == "moments" else frame


def _moments(result: Result) -> dict[str, Any]:
    columns: dict[str, Any] = {"time_s": result.time_s}
    if len(result.whale_speed_m_s) > 0:
        columns |= {
            "outcome_kind": result.outcome_kind,
            "outcome_decided": result.outcome_decided,
            "whale_speed_m_s": result.whale_speed_m_s,
            **_axes("whale_{}_m", result.whale_position_m),
        }
    if len(result.time_s) > 0:
        columns |= {f"{line.id} tension_N": result.line_tension_N(line.id) for line in result.lines}
    if len(result.whale_speed_m_s) > 0:
        columns |= {f"{part} wraps_turns": result.wraps_turns[:, at] for at, part in enumerate(result.parts)}
    return columns


def _nodes(result: Result) -> dict[str, Any]:
    line, place = _of_lines(result, lambda line: line.nodes), _places(result, lambda line: line.nodes)
    return {
        "time_s": np.repeat(result.time_s, len(line)),
        "line": np.tile(line, len(result.time_s)),
        "node": np.tile(place, len(result.time_s)),
        **_axes("{}_m", result.node_position_m.reshape(-1, 3)),
    }


def _segments(result: Result) -> dict[str, Any]:
    line, place = _of_lines(result, lambda line: line.segments), _places(result, lambda line: line.segments)
    return {
        "time_s": np.repeat(result.time_s, len(line)),
        "line": np.tile(line, len(result.time_s)),
        "segment": np.tile(place, len(result.time_s)),
        "tension_N": result.tension_N.ravel(),
        "length_m": result.segment_length_m.ravel(),
        "is_cut": result.is_cut.ravel(),
    }


def _bodies(result: Result) -> dict[str, Any]:
    count = len(result.bodies)
    return {
        "time_s": np.repeat(result.time_s, count),
        "body": np.tile(_texts(result.bodies), len(result.time_s)),
        **_axes("{}_m", result.body_position_m.reshape(-1, 3)),
        **_axes("q{}", result.body_orientation.reshape(-1, 4)),
    }


def _whale(result: Result) -> dict[str, Any]:
    return {
        "time_s": result.time_s[: len(result.whale_speed_m_s)],
        **_axes("{}_m", result.whale_position_m),
        "speed_m_s": result.whale_speed_m_s,
        **_axes("q{}", result.whale_orientation.reshape(-1, 4)),
    }


def _contacts(result: Result) -> dict[str, Any]:
    contacts = result.contacts
    starts = np.array([line.segments.start for line in result.lines], dtype=int)
    return {
        "time_s": result.time_s[contacts.moment],
        "line": _texts(result.lines.keys())[contacts.line],
        "segment": contacts.segment - starts[contacts.line],
        "region": contacts.region,
        **_axes("{}_m", contacts.position_m),
        **_axes("normal_{}", contacts.normal),
        "normal_force_N": contacts.normal_force_N,
        **_axes("friction_{}_N", contacts.friction_N),
        "length_m": contacts.length_m,
    }


def _events(result: Result) -> dict[str, Any]:
    keys = ("time_s", "kind", "subject", "value", "unit")
    return {key: [getattr(event, key) for event in result.events] for key in keys}


#: The tables of ``to_pandas``, and the functions that make their columns.
TABLES: dict[str, Callable[[Result], dict[str, Any]]] = {
    "moments": _moments,
    "nodes": _nodes,
    "segments": _segments,
    "bodies": _bodies,
    "whale": _whale,
    "contacts": _contacts,
    "events": _events,
}


def to_html(result: Result) -> str:
    """The headline of a result, and a table of its lines and weak links."""
    figures = result.figures
    head = "".join(f"<p>{html.escape(sentence)}</p>" for sentence in result.outcome.headline)
    rows = "".join(
        _row(one, kind) for kind, all in (("line", figures["lines"]), ("weak link", figures["links"])) for one in all
    )
    names = ("", "", "greatest tension [N]", "parted at [s]")
    heads = "".join(f"<th>{name}</th>" for name in names)
    foot = f"{figures['simulated_s']:g} s simulated, state {html.escape(figures['state_hash'])}"
    return f"<div>{head}<table><thead><tr>{heads}</tr></thead><tbody>{rows}</tbody></table><p>{foot}</p></div>"


def _row(one: dict[str, Any], kind: str) -> str:
    parted = "" if one["parted_at_s"] is None else f"{one['parted_at_s']:.2f}"
    cells = (kind, html.escape(one["id"]), f"{one['peak_tension_N']:.1f}", parted)
    return "<tr>" + "".join(f"<td>{cell}</td>" for cell in cells) + "</tr>"


def _axes(name: str, values: np.ndarray) -> dict[str, np.ndarray]:
    """Columns of vectors or quaternions; ``{}`` in the name is the axis."""
    return {name.format(axis): values[:, at] for at, axis in enumerate("xyzw"[: values.shape[1]])}


def _texts(texts: Any) -> np.ndarray:
    return np.array(list(texts), dtype=str)


def _of_lines(result: Result, indices: Callable[[Any], slice]) -> np.ndarray:
    """Id of the line of each node or segment."""
    return _texts(line.id for line in result.lines for _ in range(*_bounds(indices(line))))


def _places(result: Result, indices: Callable[[Any], slice]) -> np.ndarray:
    """Place of each node or segment along its line, from 0."""
    places = [np.arange(indices(line).stop - indices(line).start) for line in result.lines]
    return np.concatenate(places) if places else np.zeros(0, int)


def _bounds(indices: slice) -> tuple[int, int]:
    return indices.start, indices.stop
