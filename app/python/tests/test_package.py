"""The package: library, assemblies, pictures, the command, the cost of the import."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import endline
from endline._result import _png


def test_the_package_brings_library_and_plugins():
    library = endline.Library()
    assert library.path.is_relative_to(Path(endline.__file__).parent)
    assert "hello-endline" in library.scenarios and "single" in library.assemblies
    assert library.studies and "right-whale" in library.ids("whales")
    assert endline.plugin_problems() == []
    with pytest.raises(endline.EndlineError, match="ropes"):
        library.ids("rope")


def test_the_command_is_of_the_same_program(command, hello_json):
    assert hello_json["version"] == endline.__version__
    assert command("--version") == f"endline {endline.__version__.split('+')[0]}\n"


def test_a_changed_library_is_checked(tmp_path):
    import shutil

    folder = tmp_path / "library"
    shutil.copytree(endline.Library().path, folder)
    rope = next(folder.glob("ropes/*.toml"))
    rope.write_text(rope.read_text() + "\nmistake = 1\n")
    problems = endline.Library(folder).check()
    assert any(problem["file"].endswith(rope.name) and "mistake" in problem["field"] for problem in problems)


def test_an_assembly_settles_in_the_sea_of_a_scenario():
    single = endline.Assembly("single")
    calm = single.settle("hello-endline", current_m_s=0.0)
    running = single.settle("hello-endline", current_m_s=0.5)
    assert calm["converged"] and running["converged"]

    def drift(shape):
        return max(abs(place[0]) for line in shape["lines"] for place in line["position_m"])

    assert drift(running) > drift(calm)


def test_a_picture_is_rgba_and_jupyter_shows_it(hello):
    try:
        pixels = hello.render(30.0, size=(320, 200))
    except endline.EndlineError as error:
        if "EGL" in str(error):
            pytest.skip(str(error))
        raise
    assert pixels.shape == (200, 320, 4) and pixels.dtype == np.uint8
    assert len(np.unique(pixels.reshape(-1, 4), axis=0)) > 50
    assert hello._repr_png_().startswith(b"\x89PNG")
    with pytest.raises(endline.EndlineError, match="there is no view"):
        hello.render(view="nowhere")


def test_png_bytes_are_read_back_by_matplotlib(tmp_path):
    from matplotlib import image

    pixels = np.random.default_rng(1).integers(0, 256, (7, 11, 4), dtype=np.uint8)
    (tmp_path / "p.png").write_bytes(_png(pixels))
    assert np.array_equal((image.imread(tmp_path / "p.png") * 255).round().astype(np.uint8), pixels)


def test_importing_brings_no_other_package_than_numpy():
    script = "import sys, endline; print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout.split()
    assert not {"pyarrow", "pandas", "polars", "distributed", "matplotlib"} & set(loaded)


def test_the_stubs_name_what_the_module_has():
    from endline import _endline

    stubs = Path(endline.__file__).with_name("_endline.pyi").read_text()
    named = set(re.findall(r"^(?:class|def) (\w+)", stubs, re.M))
    assert named == {name for name in dir(_endline) if not name.startswith("_")}


def test_everything_public_is_documented():
    for name in endline.__all__:
        item = getattr(endline, name)
        assert item.__doc__, name
        if isinstance(item, type) and item.__module__.startswith("endline"):
            for key, member in vars(item).items():
                if not key.startswith("_") and (callable(member) or isinstance(member, property)):
                    assert member.__doc__, f"{name}.{key}"
