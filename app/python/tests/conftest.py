"""The command line that the package brings, to compare with."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

ENDLINE = Path(sys.executable).parent / "endline"


@pytest.fixture(scope="session")
def command():
    """Calls the installed command; returns its output. `code` is the expected exit code; None allows any."""

    def call(*arguments, code=0, **options):
        done = subprocess.run([ENDLINE, *map(str, arguments)], capture_output=True, text=True, **options)
        assert code is None or done.returncode == code, done.stderr
        return done.stdout

    return call


@pytest.fixture(scope="session")
def hello():
    """The bundled encounter, run once."""
    import endline

    return endline.run("hello-endline")


@pytest.fixture(scope="session")
def hello_json(command):
    """The same by the command line."""
    return json.loads(command("run", library_file("scenarios/hello-endline.toml"), "--json"))


def library_file(name):
    import endline

    return endline.Library().path / name


#: Short draws of a small rig without a whale: the tests check the run, not the physics.
STUDY = """
format = 1
kind = "study"
name = "Small"
scenario = "small.toml"
encounters = {encounters}
baseline = "none"

[[option]]
id = "none"
set = {{ weak_links = false }}

[[option]]
id = "weak"
strength = "5 N"
set = {{ "link.0.rating" = "5 N" }}

[encounter."body.0.drag_area"]
uniform = ["0.1 m2", "0.3 m2"]
source = "assumed"

[encounter.tide]
choice = ["0.2 m/s", "0.5 m/s"]
source = "assumed"
"""


@pytest.fixture
def small(tmp_path):
    """Writes a small study with a number of encounters and simulated seconds of each; returns its file."""

    def write(encounters=10, seconds=0.5):
        gear = library_file("scenarios/study-endline-held.toml").read_text().split("[whale]")[0]
        head, rest = gear.split("[resolution]")
        gear = f"{head}[site]{rest.split('[site]')[1]}"
        gear = gear.replace('duration = "660 s"', f'duration = "{seconds} s"')
        (tmp_path / "small.toml").write_text(gear.replace("rope_nodes = 500", "rope_nodes = 12"))
        file = tmp_path / "study.toml"
        file.write_text(STUDY.format(encounters=encounters))
        return file

    return write
