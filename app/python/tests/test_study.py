"""A study by Python leaves the bytes of the command line's."""

import json
import signal
import subprocess
import sys
import time

import polars
import pytest

import endline


@pytest.fixture
def by_command(command, tmp_path):
    """Runs a study by the command line; answers its folder."""

    def run(file):
        out = tmp_path / "by-command"
        command("study", "run", file, "--out", out, "--eager")
        command("study", "merge", file, "--out", out)
        return out

    return run


def test_the_table_has_the_bytes_of_the_command_lines(small, by_command, tmp_path, command):
    file = small()
    there = by_command(file)
    study = endline.Study(file)
    assert study.plan() == json.loads(command("study", "plan", file, "--json"))
    assert study.run(tmp_path / "here", threads=2) == (10, 10)
    table = study.merge(tmp_path / "here")
    for name in ["table.parquet", "table.csv"]:
        assert table.with_name(name).read_bytes() == (there / name).read_bytes()


def test_parts_make_the_whole(small, by_command, tmp_path):
    file = small()
    study, out = endline.Study(file), tmp_path / "parts"
    for part in [3, 1, 2]:
        study.run(out, part=part, of=3, threads=1)
    assert study.merge(out).read_bytes() == (by_command(file) / "table.parquet").read_bytes()
    for part in [0, 4]:
        with pytest.raises(ValueError, match=f"part={part}, of=3: expected a part from 1"):
            study.run(out, part=part, of=3)


def test_a_part_has_the_blocks_of_the_command_lines_shard(small, command, tmp_path):
    file = small()
    endline.Study(file).run(tmp_path / "here", part=2, of=3, threads=1)
    command("study", "run", file, "--out", tmp_path / "there", "--shard", "2/3", "--eager")
    here, there = (sorted(block.name for block in (tmp_path / side).glob("block-*.parquet")) for side in ["here", "there"])
    assert here == there and 0 < len(here) < 10


def test_progress_counts_up_to_all_encounters(small, tmp_path):
    study, reported = endline.Study(small()), []
    study.run(tmp_path / "out", threads=1, progress=lambda done, total: reported.append((done, total)))
    assert reported == sorted(set(reported)) and reported[-1] == (10, 10)
    assert len(reported) > 2


def test_an_exception_of_progress_ends_the_study_and_the_next_call_continues(small, tmp_path):
    study, out = endline.Study(small(24, seconds=2)), tmp_path / "out"

    def stop(done, total):
        if done > 0:
            raise RuntimeError(f"stopped at {done}")

    with pytest.raises(RuntimeError, match="stopped at"):
        study.run(out, threads=1, progress=stop)
    assert len(list(out.glob("block-*.parquet"))) < 24
    assert study.run(out) == (24, 24)


def test_a_table_is_read_by_pyarrow_polars_and_pandas(small, tmp_path):
    study, out = endline.Study(small(4)), tmp_path / "out"
    with pytest.raises(FileNotFoundError, match="merge"):
        study.read(out)
    study.run(out)
    study.merge(out)
    arrow, frame, pandas = (study.read(out, to=to) for to in ["pyarrow", "polars", "pandas"])
    assert arrow.num_rows == len(frame) == len(pandas) == 4 * 2
    assert arrow.column_names == frame.columns == list(pandas.columns)
    text = polars.read_csv(out / "table.csv", infer_schema_length=None)
    assert frame["state_hash"].to_list() == text["state_hash"].to_list() == list(pandas["state_hash"])
    assert frame["simulated_s"].to_list() == text["simulated_s"].to_list()
    with pytest.raises(ValueError, match="polars"):
        study.read(out, to="excel")


def test_a_report_is_written(small, tmp_path):
    study, out = endline.Study(small(4)), tmp_path / "out"
    study.run(out)
    with pytest.raises(endline.EndlineError, match="merge"):
        study.report(out)
    study.merge(out)
    page, findings = study.report(out)
    assert "Small" in page.read_text()
    assert json.loads((out / "findings.json").read_text()) == findings


def test_blocks_missing_are_told(small, tmp_path):
    study, out = endline.Study(small()), tmp_path / "out"
    study.run(out, part=1, of=2)
    with pytest.raises(endline.EndlineError, match="lacks 5 of 10 blocks"):
        study.merge(out)


def test_ctrl_c_ends_a_study_and_the_next_call_goes_on(small, by_command, tmp_path):
    file, out = small(24, seconds=2), tmp_path / "out"
    script = f"import signal, endline; signal.signal(signal.SIGINT, signal.default_int_handler); s = endline.Study({str(file)!r}); print('running', flush=True); s.run({str(out)!r}, threads=1)"
    process = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "running\n"
    while len(list(out.glob("block-*"))) < 2 and process.poll() is None:
        time.sleep(0.02)
    process.send_signal(signal.SIGINT)
    _, error = process.communicate(timeout=60)
    assert "KeyboardInterrupt" in error
    assert 2 <= len(list(out.glob("block-*.parquet"))) < 24
    study = endline.Study(file)
    assert study.run(out) == (24, 24)
    assert study.merge(out).read_bytes() == (by_command(file) / "table.parquet").read_bytes()
