"""Labels of a result: outcome, events, lines, xarray, pandas, recordings."""

import csv
import json

import blake3
import numpy as np
import pytest

import endline


def test_the_outcome_has_the_values_of_the_figures(hello):
    whale, outcome = hello.figures["whale"], hello.outcome
    assert outcome.kind == whale["outcome"] and isinstance(outcome.kind, endline.OutcomeKind)
    assert f"{outcome.kind}" == whale["outcome"]
    assert (outcome.decided, outcome.first_contact_s) == (whale["decided"], whale["first_contact_s"])
    assert outcome.valid and outcome.stopped is None and outcome.partings == ()
    assert list(outcome.headline) == hello.figures["headline"]


def test_the_kinds_of_outcome_are_those_of_the_schema(command):
    schema = json.dumps(json.loads(command("schema", "endline.run/1"))["properties"]["whale"])
    for kind in endline.OutcomeKind:
        assert f"`{kind}`" in schema
    assert schema.count("`no_contact`") == 1


def test_partings_are_in_the_order_of_time():
    weak = endline.run("hello-endline", rating_N="20 N", set={"duration": "20 s"})
    assert weak.outcome.partings, "a link of 20 N parts"
    assert [one.at_s for one in weak.outcome.partings] == sorted(one.at_s for one in weak.outcome.partings)
    first = weak.outcome.partings[0]
    assert first.of == "link" and first.peak_tension_N > 20
    parted = [event for event in weak.events if event.kind == "link_parted"]
    assert (parted[0].time_s, parted[0].subject, parted[0].unit) == (pytest.approx(first.at_s, abs=0.02), first.id, "N")


def test_events_are_those_of_the_figures(hello):
    events = hello.events
    assert len(events) == len(hello.figures["events"]) > 0
    assert [event.time_s for event in events] == sorted(event.time_s for event in events)
    contact = next(event for event in events if event.kind == "contact")
    assert contact.time_s == hello.outcome.first_contact_s and contact.unit == "N"


def test_the_outcome_changes_at_the_first_contact(hello):
    touched = hello.time_s >= hello.outcome.first_contact_s
    assert set(hello.outcome_kind[~touched]) == {"no_contact"}
    assert "no_contact" not in hello.outcome_kind[touched]
    assert hello.outcome_kind[-1] == hello.outcome.kind and hello.outcome_decided[-1] == hello.outcome.decided


def test_wraps_and_forces_of_the_parts_agree_with_figures_and_contacts(hello):
    regions = hello.figures["whale"]["regions"]
    assert [region["region"] for region in regions] == hello.parts
    assert hello.wraps_turns.shape == (len(hello.time_s), len(hello.parts))
    assert list(hello.wraps_turns[-1]) == [region["wraps"] for region in regions]
    for at, region in enumerate(regions):
        assert hello.wraps_turns[:, at].max() <= region["peak_wraps"] + 1e-9
        assert hello.part_normal_force_N[:, at].max() <= region["peak_normal_N"] * (1 + 1e-9)
    # Contacts are those at the end of a step; the forces are means of the step.
    at_end = np.bincount(hello.contacts.moment, hello.contacts.normal_force_N, len(hello.time_s))
    of_step = hello.part_normal_force_N.sum(axis=1)
    assert at_end.max() > 50
    assert np.abs(of_step - at_end).max() < 0.1 * at_end.max()
    assert ((of_step > 0) == (at_end > 0)).mean() > 0.98


def test_lines_are_found_by_id_and_index_and_iterated_as_lines(hello):
    lines = hello.lines
    assert [line.id for line in lines] == [line["id"] for line in hello.figures["lines"]] == list(lines.keys())
    for index, line in enumerate(lines):
        assert lines[line.id] is lines[index] is lines[index - len(lines)] is line
        assert line.id in lines and line in lines and lines.index(line) == lines.index(line.id) == index
    assert dict(lines) == dict(lines.items()) == {line.id: line for line in lines}
    assert lines.get("nowhere") is None and "nowhere" not in lines
    with pytest.raises(KeyError, match=f"expected one of {lines[0].id}"):
        lines["nowhere"]
    with pytest.raises(IndexError, match="expected an index from 0"):
        lines[len(lines)]
    with pytest.raises(KeyError, match="expected one of"):
        hello.line_tension_N("nowhere")


ARRAYS = "node_position_m tension_N segment_length_m is_cut body_position_m body_orientation whale_position_m whale_speed_m_s"


def test_a_dataset_has_the_arrays_with_axes_and_units(hello, tmp_path):
    xarray = pytest.importorskip("xarray")
    data = hello.to_xarray()
    for name in [*ARRAYS.split(), "whale_orientation", "wraps_turns", "part_normal_force_N", "outcome_kind", "step"]:
        assert np.array_equal(data[name], getattr(hello, name)), name
    assert np.array_equal(data["time"], hello.time_s)
    for name in data.variables:
        assert {"units", "long_name"} <= set(data[name].attrs), name
    units = {"m": "_m", "N": "_N", "m/s": "_m_s", "turns": "_turns"}
    for name in data.data_vars:
        unit = data[name].attrs["units"]
        assert unit not in units or name.endswith(units[unit]), name
    line = hello.lines[-1]
    own = data["tension_N"].isel(segment=(data["segment_line"] == line.id).values).max("segment")
    assert np.array_equal(own, hello.line_tension_N(line.id))
    assert np.array_equal(data["wraps_turns"].sel(part="head"), hello.wraps_turns[:, hello.parts.index("head")])
    assert data["contact_normal_force_N"].size == len(hello.contacts)
    assert data.attrs["state_hash"] == hello.state_hash

    data.to_netcdf(tmp_path / "run.nc")
    with xarray.open_dataset(tmp_path / "run.nc") as again:
        assert np.array_equal(again["tension_N"], hello.tension_N)
        assert list(again["event_kind"].values) == [event.kind for event in hello.events]


def rows(file):
    with open(file, newline="") as text:
        return list(csv.DictReader(text))


def test_tables_are_those_of_the_exported_files(hello, command, tmp_path):
    """The command line writes the same run by its own code: same columns, and equal numbers."""
    from conftest import library_file

    out = tmp_path / "tables"
    command("export", library_file("scenarios/hello-endline.toml"), "--out", out, "--format", "csv", "--rate", 10)
    for name in ["nodes", "segments", "bodies", "whale", "contacts"]:
        table, exported = hello.to_pandas(name), rows(out / f"{name}.csv")
        assert list(table.columns) == list(exported[0]) and len(table) == len(exported) > 0, name
        for column in table.columns:
            texts = [row[column] for row in exported]
            own = table[column]
            if own.dtype == bool:
                assert [text == "true" for text in texts] == list(own), f"{name}.{column}"
            elif own.dtype.kind in "if":
                assert np.array_equal(np.array(texts, dtype=own.dtype), own), f"{name}.{column}"
            else:
                assert texts == list(own), f"{name}.{column}"


def test_the_table_of_moments_has_a_row_for_each_moment(hello):
    table = hello.to_pandas()
    assert table.index.name == "time_s" and np.array_equal(table.index, hello.time_s)
    for line in hello.lines:
        assert np.array_equal(table[f"{line.id} tension_N"], hello.line_tension_N(line.id))
    assert np.array_equal(table["head wraps_turns"], hello.wraps_turns[:, hello.parts.index("head")])
    assert list(hello.to_pandas("events")["subject"]) == [event.subject for event in hello.events]
    with pytest.raises(ValueError, match="expected one of 'moments'"):
        hello.to_pandas("knots")


def test_a_run_without_a_whale_or_moments_has_tables_too():
    still = endline.run("tide-turns", frames_hz=0, set={"duration": "0.2 s"})
    assert still.outcome.kind is None and still.outcome.decided is None and still.events == ()
    assert len(still.to_pandas()) == 0 and len(still.to_pandas("contacts")) == 0
    assert "outcome_kind" not in still.to_xarray()
    moving = endline.run("tide-turns", set={"duration": "0.2 s"})
    assert "whale_speed_m_s" not in moving.to_pandas() and len(moving.to_pandas()) == 3


def test_a_recording_is_loaded_by_running_it_again(tmp_path):
    short = endline.run("hello-endline", set={"duration": "1 s"})
    short.save(tmp_path / "short.endline")
    again = endline.Result.load(tmp_path / "short.endline", frames_hz="20 Hz")
    assert again.state_hash == short.state_hash and again.outcome == short.outcome
    assert np.array_equal(again.node_position_m[::2], short.node_position_m)
    assert np.array_equal(again.wraps_turns[::2], short.wraps_turns)


def test_a_changed_recording_is_not_loaded(tmp_path):
    short = endline.run("hello-endline", set={"duration": "1 s"})
    file = tmp_path / "short.endline"
    short.save(file)
    data = bytearray(file.read_bytes())
    inputs = data.index(b"INPT") + 4 + 8 + 32
    # A swimming speed of 1.0 in step 50 becomes 0.5.
    at = inputs + 49 * 80
    assert data[at : at + 8] == np.float64(1.0).tobytes()
    data[at : at + 8] = np.float64(0.5).tobytes()
    file.write_bytes(data)
    with pytest.raises(endline.EndlineError, match=r"step 50 .*input differs.*expected the version"):
        endline.Result.load(file)


def test_a_replay_that_differs_in_a_stored_moment_has_labels_for_each(tmp_path):
    """The word of the whale in the recorded hash of step 50 is changed, and the hash of the section with it."""
    short = endline.run("hello-endline", set={"duration": "1 s"})
    file = tmp_path / "short.endline"
    short.save(file)
    data = bytearray(file.read_bytes())
    section = data.index(b"HASH")
    length = int.from_bytes(data[section + 4 : section + 12], "little")
    start = section + 44
    assert length == 101 * 56, "the settled state and 100 steps"
    data[start + 50 * 56 + 4 * 8] ^= 1
    data[section + 12 : start] = blake3.blake3(data[start : start + length]).digest()
    file.write_bytes(data)
    again = endline.replay(file)
    assert again.differs == (50, pytest.approx(0.5), "whale")
    result = again.result
    assert len(result.time_s) == len(result.outcome_kind) == len(result.wraps_turns) == 6
    assert result.to_xarray().sizes["time"] == 6
