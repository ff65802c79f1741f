"""The package: library, assemblies, pictures, the command, the cost of the import."""

import inspect
import re
import subprocess
import sys
import xml.etree.ElementTree
from pathlib import Path

import numpy as np
import pytest

import endline


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


def shape_of(settled):
    return [line["position_m"] for line in settled["lines"]]


def test_a_quantity_is_a_number_in_si_or_a_text_with_its_unit():
    single = endline.Assembly("single")
    numbers = single.settle("hello-endline", depth_m=18.288, current_m_s=0.4)
    assert shape_of(numbers) == shape_of(single.settle("hello-endline", depth_m="10 fathom", current_m_s="40 cm/s"))
    assert shape_of(numbers) != shape_of(single.settle("hello-endline", depth_m="20 fathom", current_m_s=0.4))
    rated = [endline.Scenario("hello-endline", rating_N=rating, step_s=step) for rating, step in [(2669.0, 0.01), ("2669 N", "10 ms")]]
    assert rated[0].model_hash == rated[1].model_hash != endline.Scenario("hello-endline").model_hash


@pytest.mark.parametrize(
    "arguments, error, says",
    [
        ({"depth_m": "40"}, ValueError, "depth_m: .*no unit.*a plain number is in m"),
        ({"depth_m": "40 kg"}, ValueError, "depth_m: .*expected a length"),
        ({"current_m_s": "1 m"}, ValueError, "current_m_s: .*expected a speed"),
        ({"current_m_s": float("nan")}, ValueError, "expected a finite number in m/s"),
        ({"depth_m": True}, TypeError, "depth_m=True: expected a finite number in m"),
        ({"depth_m": [40]}, TypeError, "expected a finite number in m"),
    ],
)
def test_a_wrong_quantity_is_named(arguments, error, says):
    with pytest.raises(error, match=says):
        endline.Assembly("single").settle("hello-endline", **arguments)


def test_run_and_settle_name_the_arguments_of_a_scenario():
    own = set(inspect.signature(endline.Scenario).parameters)
    for call, added in [(endline.run, {"frames_hz", "unsettled"}), (endline.settle, set())]:
        assert set(inspect.signature(call).parameters) == own | added


def test_a_picture_is_rgba(hello):
    try:
        pixels = hello.render("30 s", size=(320, 200))
    except endline.EndlineError as error:
        if "EGL" in str(error):
            pytest.skip(str(error))
        raise
    assert pixels.shape == (200, 320, 4) and pixels.dtype == np.uint8
    assert len(np.unique(pixels.reshape(-1, 4), axis=0)) > 50
    assert np.array_equal(pixels, hello.render(30.0, size=(320, 200)))
    with pytest.raises(endline.EndlineError, match="there is no view"):
        hello.render(view="nowhere")


def test_jupyter_shows_the_headline_and_the_lines_without_a_picture(hello):
    shown = hello._repr_html_()
    assert not hasattr(hello, "_repr_png_") and "<img" not in shown and len(shown) < 5000
    page = xml.etree.ElementTree.fromstring(shown)
    assert [text.text for text in page.findall("p")][:-1] == hello.figures["headline"]
    rows = [[cell.text for cell in row] for row in page.iter("tr")][1:]
    expected = [("line", line) for line in hello.figures["lines"]] + [("weak link", link) for link in hello.figures["links"]]
    assert [(row[0], row[1]) for row in rows] == [(kind, one["id"]) for kind, one in expected]
    assert [float(row[2]) for row in rows] == pytest.approx([one["peak_tension_N"] for _, one in expected], abs=0.05)


def test_importing_brings_no_other_package_than_numpy():
    script = "import sys, endline; print(*sys.modules)"
    loaded = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout.split()
    assert not {"pyarrow", "pandas", "polars", "xarray", "distributed", "matplotlib"} & set(loaded)


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
