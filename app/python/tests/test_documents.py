"""Runs the examples of the documents."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

DOCS = Path(__file__).parents[3] / "docs"


def scripts():
    return re.findall(r"```python\n(.*?)```", (DOCS / "python.md").read_text(), re.S)


def test_the_first_script_plots_tension(tmp_path):
    first = scripts()[0]
    assert len(first.splitlines()) <= 10
    subprocess.run([sys.executable, "-c", first], cwd=tmp_path, env={"MPLBACKEND": "agg", "PATH": ""}, check=True)
    from matplotlib import image

    picture = image.imread(tmp_path / "tension.png")
    assert picture.std() > 0.05, "the picture is empty"


@pytest.mark.parametrize("script", scripts())
def test_every_script_is_python(script):
    compile(script, "docs/python.md", "exec")


#: Scripts that need an hour or a cluster.
LONG = ("weak-links", "dask")


@pytest.mark.parametrize("script", [script for script in scripts()[1:] if not any(word in script for word in LONG)])
def test_short_scripts_run(script, tmp_path):
    subprocess.run([sys.executable, "-c", script], cwd=tmp_path, env={"MPLBACKEND": "agg", "PATH": ""}, check=True)


def test_the_notebook_runs():
    import nbclient
    import nbformat

    notebook = nbformat.read(DOCS / "notebooks/two-links.ipynb", 4)
    nbclient.NotebookClient(notebook, timeout=900, resources={"metadata": {"path": DOCS / "notebooks"}}).execute()
    outputs = [output for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs]
    pictures = [output for output in outputs if "image/png" in output.get("data", {})]
    assert len(pictures) >= 2, "a forest plot and a survival curve"
    assert not [output for output in outputs if output.output_type == "error"]
