"""A run by Python is the run of the command line, number for number."""

import json
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
from conftest import library_file

import endline


#: Figures that tell real time, and the name of the file, which each names in its own way.
CLOCKS = {"scenario", "wall_s", "times_real_time", "approach", "contact", "cost"}


def test_the_state_is_that_of_the_command_line(hello, hello_json):
    assert hello.state_hash == hello_json["state_hash"]


def test_the_figures_are_those_of_the_command_line(hello, hello_json):
    assert list(hello.figures) == list(hello_json)
    for key in set(hello.figures) - CLOCKS:
        here, there = hello.figures[key], hello_json[key]
        if key == "settled":
            here, there = ({name: value for name, value in figure.items() if name != "wall_s"} for figure in (here, there))
        assert here == there, key


def test_fields_are_set_by_their_paths():
    plain = endline.settle("hello-endline")
    faster = endline.settle("hello-endline", set={"current.speed": "0.5 m/s", "seed": 3, "weak_links": False})
    assert plain != faster
    with pytest.raises(endline.EndlineError, match="sped"):
        endline.settle("hello-endline", set={"current.sped": "0.5 m/s"})


def test_moments_have_the_documented_shapes(hello):
    moments = len(hello.time_s)
    assert moments == 601
    assert np.allclose(np.diff(hello.time_s), 0.1)
    nodes = max(line.nodes.stop for line in hello.lines)
    assert hello.node_position_m.shape == (moments, nodes, 3)
    assert hello.tension_N.shape == hello.segment_length_m.shape
    assert hello.tension_N.shape[0] == moments
    assert hello.whale_position_m.shape == (moments, 3)
    assert np.allclose(np.linalg.norm(hello.whale_orientation, axis=1), 1)
    assert hello.body_position_m.shape == (moments, len(hello.bodies), 3)
    assert not hello.tension_N.flags.writeable


def test_no_moment_exceeds_the_peak_of_all_steps(hello):
    for line in hello.figures["lines"]:
        greatest = hello.line_tension_N(line["id"]).max()
        assert 0.5 * line["peak_tension_N"] < greatest <= line["peak_tension_N"] * (1 + 1e-9)


def test_contacts_lie_on_their_segments(hello):
    contacts = hello.contacts
    assert len(contacts) > 0
    first = hello.figures["whale"]["first_contact_s"]
    assert abs(hello.time_s[contacts.moment[0]] - first) < 0.2
    for line in hello.lines:
        own = contacts.line == hello.lines.index(line)
        segment = contacts.segment[own] - line.segments.start
        a = hello.node_position_m[contacts.moment[own], line.nodes.start + segment]
        b = hello.node_position_m[contacts.moment[own], line.nodes.start + segment + 1]
        reach = np.linalg.norm(contacts.position_m[own] - a, axis=1) + np.linalg.norm(contacts.position_m[own] - b, axis=1)
        assert np.allclose(reach, np.linalg.norm(b - a, axis=1), atol=1e-6)


def test_settle_is_that_of_the_command_line(command):
    there = json.loads(command("settle", library_file("scenarios/hello-endline.toml"), "--json"))
    here = endline.settle("hello-endline")
    assert [line["tension_N"] for line in here["lines"]] == [line["tension_N"] for line in there["lines"]]
    assert here["schema"] == "endline.settle/1"


def test_overrides_reach_the_model(hello):
    other = endline.Scenario("hello-endline", rating_N=1.0, seed=9)
    assert other.model_hash != hello.figures["model_hash"]
    assert endline.Scenario("hello-endline").model_hash == hello.figures["model_hash"]


def test_a_recording_replays_to_the_same_bits_here_and_on_the_command_line(hello, command, tmp_path):
    file = tmp_path / "hello.endline"
    hello.save(file)
    again = endline.replay(file)
    assert again.verified and again.result.state_hash == hello.state_hash
    assert np.array_equal(again.result.node_position_m, hello.node_position_m)
    assert "verified" in command("replay", file, "--verify")


def test_other_threads_run_meanwhile():
    scenario = endline.Scenario("hello-endline")
    ticks, done = [], threading.Event()

    def run():
        scenario.run(frames_hz=0)
        done.set()

    thread = threading.Thread(target=run)
    thread.start()
    while not done.is_set():
        ticks.append(time.monotonic())
        time.sleep(0.01)
    thread.join()
    # A run that held the lock of the interpreter would let none of these through until its end.
    assert len(ticks) > 5


@pytest.mark.parametrize("work", ["s.run()", "endline.replay('twice.endline')"])
def test_ctrl_c_stops_a_run_and_a_replay(work, hello, tmp_path):
    hello.save(tmp_path / "twice.endline")
    script = f"import signal, endline; signal.signal(signal.SIGINT, signal.default_int_handler); s = endline.Scenario('hello-endline'); print('running', flush=True); {work}; print('ended')"
    process = subprocess.Popen(
        [sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, cwd=tmp_path
    )
    assert process.stdout.readline() == "running\n"
    time.sleep(1)
    process.send_signal(signal.SIGINT)
    out, error = process.communicate(timeout=120)
    assert "KeyboardInterrupt" in error and "ended" not in out


@pytest.mark.parametrize("wrong", ["hello-endlin", "no/such/file.toml"])
def test_a_name_that_is_not_there_is_told(wrong):
    with pytest.raises(endline.EndlineError) as raised:
        endline.run(wrong)
    assert wrong in str(raised.value)


def test_errors_have_file_line_and_field(tmp_path):
    text = library_file("scenarios/hello-endline.toml").read_text()
    file = tmp_path / "wrong.toml"
    file.write_text(text.replace('length = "13.7 m"', 'length = "13.7 kg"'))
    with pytest.raises(endline.EndlineError) as raised:
        endline.Scenario(file)
    error = raised.value
    assert error.file == str(file) and error.field == "whale.length"
    assert error.line == 1 + text.splitlines().index('length = "13.7 m"')
    assert error.problems[0]["message"] in str(error)


def test_exported_tables_are_read_by_other_libraries(hello, command, tmp_path):
    """Parquet by pyarrow, polars and duckdb: types, units, counts, and the numbers of the arrays."""
    import duckdb
    import polars
    import pyarrow as arrow
    import pyarrow.parquet

    scenario = library_file("scenarios/hello-endline.toml")
    command("export", scenario, "--out", tmp_path, "--rate", 10)
    moments, nodes = hello.node_position_m.shape[:2]

    file = arrow.parquet.ParquetFile(tmp_path / "nodes.parquet")
    assert file.metadata.num_rows == moments * nodes
    types = {field.name: field.type for field in file.schema_arrow}
    assert types == {
        "time_s": arrow.float64(),
        "line": arrow.string(),
        "node": arrow.int64(),
        "x_m": arrow.float64(),
        "y_m": arrow.float64(),
        "z_m": arrow.float64(),
    }
    about = file.schema_arrow.metadata
    assert about[b"x_m.unit"] == b"m" and about[b"x_m.meaning"] == b"east"
    group = file.metadata.row_group(0)
    lines = group.column([group.column(i).path_in_schema for i in range(6)].index("line"))
    assert any("DICTIONARY" in encoding for encoding in lines.encodings)

    table = polars.read_parquet(tmp_path / "nodes.parquet")
    places = table.select("x_m", "y_m", "z_m").to_numpy().reshape(moments, nodes, 3)
    assert np.array_equal(places, hello.node_position_m)
    tension = polars.read_parquet(tmp_path / "segments.parquet")["tension_N"].to_numpy()
    assert np.array_equal(tension.reshape(hello.tension_N.shape), hello.tension_N)

    contacts = str(tmp_path / "contacts.parquet")
    [(count, most)] = duckdb.sql(f"select count(*), max(normal_force_N) from '{contacts}'").fetchall()
    assert count == len(hello.contacts) and most == hello.contacts.normal_force_N.max()
    reported = duckdb.sql(f"select unit from '{tmp_path / 'columns.parquet'}' where \"column\" = 'tension_N'").fetchall()
    assert reported == [("N",)]


def test_arrow_tables_are_mapped_into_memory_by_other_libraries(hello, command, tmp_path):
    """Arrow by pyarrow, polars and duckdb: types, units, counts, and the numbers of the arrays."""
    import duckdb
    import polars
    import pyarrow as arrow

    scenario = library_file("scenarios/hello-endline.toml")
    command("export", scenario, "--out", tmp_path, "--format", "arrow", "--rate", 10)
    moments, nodes = hello.node_position_m.shape[:2]

    segments = arrow.ipc.open_file(arrow.memory_map(str(tmp_path / "segments.arrow")))
    text = arrow.dictionary(arrow.int32(), arrow.string())
    assert {field.name: field.type for field in segments.schema} == {
        "time_s": arrow.float64(),
        "line": text,
        "segment": arrow.int64(),
        "tension_N": arrow.float64(),
        "length_m": arrow.float64(),
        "is_cut": arrow.bool_(),
    }
    assert segments.schema.field("tension_N").metadata == {
        b"unit": b"N",
        b"meaning": b"tension; none in slack rope",
    }
    assert segments.schema.metadata[b"program"].startswith(b"endline ")
    before = arrow.total_allocated_bytes()
    table = segments.read_all()
    assert arrow.total_allocated_bytes() - before < table.nbytes / 100, "the file is mapped, not copied"
    tension = table["tension_N"].to_numpy()
    assert np.array_equal(tension.reshape(hello.tension_N.shape), hello.tension_N)

    places = polars.read_ipc(tmp_path / "nodes.arrow")
    assert places.schema["line"] == polars.Categorical
    places = places.select("x_m", "y_m", "z_m").to_numpy().reshape(moments, nodes, 3)
    assert np.array_equal(places, hello.node_position_m)

    contacts = arrow.ipc.open_file(tmp_path / "contacts.arrow").read_all()
    [(count, most)] = duckdb.sql("select count(*), max(normal_force_N) from contacts").fetchall()
    assert count == len(hello.contacts) and most == hello.contacts.normal_force_N.max()
