"""Commands called from Python give the JSON, the pages and the files of the command line."""

import dataclasses
import datetime
import importlib.util
import json
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import polars
import pytest
from conftest import ENDLINE, STUDY, library_file

import endline
from endline._records import Record

FISHED = {"area": "lma-1", "on": "2026-06-01"}


def test_the_dataclasses_are_those_of_the_schemas():
    source = Path(__file__).parents[1] / "forms.py"
    spec = importlib.util.spec_from_file_location("forms", source)
    forms = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(forms)
    for file in forms.FILES:
        written = Path(endline.__file__).with_name(file).read_text()
        assert written == forms.text(ENDLINE, file), f"run `python app/python/forms.py` with the built command: {file}"


def types_hold(record):
    """Whether every number and list of a record has the type that its annotation names."""
    for field in dataclasses.fields(record):
        value = getattr(record, field.name)
        if value is None:
            assert "None" in field.type, field.name
        elif isinstance(value, Record):
            assert type(value).__name__ in field.type
            types_hold(value)
        elif isinstance(value, list):
            assert field.type.startswith("list["), field.name
            for one in value:
                if isinstance(one, Record):
                    types_hold(one)
        else:
            assert type(value).__name__ in field.type, f"{field.name}: {value!r} is no {field.type}"


def test_rules_are_checked_as_by_the_command_line(command):
    there = command("rules", "check", "single", "--area", "lma-1", "--on", "2026-06-01", "--depth", "20 fathom", "--json", code=None)
    here = endline.check_rules("single", **FISHED, depth_m=36.576)
    assert here.to_dict() == json.loads(there)
    assert here == endline.check_rules("single", "lma-1", datetime.date(2026, 6, 1), depth_m="20 fathom")
    types_hold(here)
    verdicts = [rule.verdict for rule in here.rules]
    counts = here.counts
    assert (counts.pass_, counts.fail) == (verdicts.count("pass"), verdicts.count("fail"))
    assert counts.pass_ + counts.fail > 0


def test_gear_that_fails_a_rule_is_a_result_and_a_wrong_area_an_error():
    strong = endline.check_rules("trawl-45", **FISHED, depth_m="20 fathom")
    assert any(rule.verdict == "fail" and rule.binding for rule in strong.rules)
    with pytest.raises(endline.EndlineError, match="there is no area `lma-99`; did you mean `lma-1`"):
        endline.check_rules("single", "lma-99", "2026-06-01")
    with pytest.raises(ValueError, match="depth_m: .*no unit"):
        endline.check_rules("single", **FISHED, depth_m="20")


def test_rules_are_listed():
    packs = endline.list_rules().packs
    areas = {area.area for pack in packs for area in pack.areas}
    assert FISHED["area"] in areas and {"canada", "us-maine"} <= {pack.id for pack in packs}


def test_a_haul_has_the_loads_of_the_command_lines(command):
    there = json.loads(command("haul", "single", "--depth", "20 m", "--sea", "1.5 m", "--lead", "20 deg", "--json"))
    here = endline.haul("single", depth_m=20, sea_m="1.5 m", lead_rad="20 deg")
    assert here.to_dict() == there
    types_hold(here)
    assert here.peak_N == max(stage.peak_N for stage in here.stages)
    still = endline.haul("single", depth_m=20, sea_m=0, lead_rad=None, drift_m_s=-0.2)
    assert still.to_dict() == json.loads(
        command("haul", "single", "--depth", "20 m", "--sea", "0 m", "--stay", "--drift=-0.2 m/s", "--json")
    )


def test_a_sweep_has_a_haul_for_each_depth():
    rows = endline.haul_sweep("single", depths_m=[15, "20 m"], sea_m=0)
    assert [row.depth_m for row in rows] == [15, 20]
    assert rows[1].peak_N == endline.haul("single", depth_m=20, sea_m=0).peak_N


def test_breaks_give_the_mean_and_deviation(tmp_path):
    breaks = [1650.0, 1700.0, 1580.0]
    law = endline.mill([f"{one} lbf" for one in breaks])
    newtons = [one * 4.4482216152605 for one in breaks]
    mean = sum(newtons) / 3
    assert law.breaks == 3 and law.mean_N == pytest.approx(mean)
    assert law.deviation_N == pytest.approx((sum((one - mean) ** 2 for one in newtons) / 2) ** 0.5)
    assert law == endline.mill(newtons)
    types_hold(law)
    file = tmp_path / "breaks.csv"
    file.write_text("break\n" + "".join(f"{one} lbf\n" for one in breaks))
    assert endline.mill(file, out=tmp_path / "link.toml", name="A link").mean_N == law.mean_N
    assert "A link" in (tmp_path / "link.toml").read_text()
    of_mean = endline.mill(mean_N=mean, count=10, limits_N=["2000 lbf"])
    assert isinstance(of_mean, endline.StrengthLaw) and of_mean.deviation_N is None
    assert of_mean.approvals[0].most_N == pytest.approx(2000 * 4.4482216152605)
    (tmp_path / "means.csv").write_text("mean,count,sample\n1650 lbf,10,one\n1580 lbf,10,two\n")
    means = endline.mill(tmp_path / "means.csv")
    assert isinstance(means, endline.MeansLaws) and [one.sample for one in means.samples] == ["one", "two"]
    with pytest.raises(endline.EndlineError, match="no unit"):
        (tmp_path / "wrong.csv").write_text("break\n1650\n")
        endline.mill(tmp_path / "wrong.csv")


def test_a_sheet_is_written(command, tmp_path):
    page = endline.sheet("single", **FISHED, to=tmp_path / "here.html", depth_m="20 fathom", tide_m_s="0.5 kn")
    options = ["--area", "lma-1", "--on", "2026-06-01", "--depth", "20 fathom", "--tide", "0.5 kn"]
    command("sheet", "single", *options, "--to", tmp_path / "there.html")
    assert page == tmp_path / "here.html" and page.read_text() == (tmp_path / "there.html").read_text()


@pytest.fixture
def own_library(tmp_path):
    """A copy of the library, for studies of a test."""
    folder = tmp_path / "gear-library"
    shutil.copytree(endline.Library().path, folder)
    return folder


#: An observation that no run of a small rig without a whale ends like.
OBSERVATION = """format = 1
kind = "observation"
name = "Seen"
source = "a test"
confidence = "estimate"
encounters = "small"
[[site]]
part = "body"
wraps = [1, 2]
"""


def test_a_search_gives_the_stories_of_its_folder(own_library, small, tmp_path):
    small(seconds=0.2)
    text = STUDY.format(encounters=10).split("[[option]]")
    study = text[0].replace('"small.toml"', '"small-rig"').replace('"none"', '"one"')
    study += '[[option]]\nid = "one"\n' + text[2][text[2].index('[encounter."body') :].split("[encounter.tide]")[0]
    (own_library / "studies/small.toml").write_text(study)
    shutil.copy(tmp_path / "small.toml", own_library / "scenarios/small-rig.toml")
    (tmp_path / "seen.toml").write_text(OBSERVATION)
    stories = endline.search(tmp_path / "seen.toml", own_library, out=tmp_path / "out", trials=32, threads=1)
    assert stories.to_dict() == json.loads((tmp_path / "out/stories.json").read_text())
    assert stories.trials >= 32 and stories.observation == "seen"
    types_hold(stories)
    with pytest.raises(endline.EndlineError, match="no `no-such.toml`"):
        endline.search("no-such", own_library)


#: Two strengths of a link that is pulled and that no whale meets.
STRENGTHS = """format = 1
kind = "study"
name = "Threat by strength"
scenario = "weak-link-pull"
encounters = 4
baseline = "rope-1000"
event = "parted"

[[option]]
id = "rope-1000"
strength = "1000 lbf"
curve = "rope"
set = { "link.0.rating" = "1000 lbf" }

[[option]]
id = "rope-1250"
strength = "1250 lbf"
curve = "rope"
set = { "link.0.rating" = "1250 lbf" }

[encounter]
aim = ["warp"]

[encounter.tide]
choice = ["0 m/s", "0.1 m/s"]
source = "assumed"

[[observation]]
id = "B1"
says = "no rope without a whale"
source = "this test"
of = "contact"
observed = [0.0, 0.1]
"""


def test_threats_and_the_hindcast_of_a_study(tmp_path, command):
    file, out = tmp_path / "study.toml", tmp_path / "out"
    file.write_text(STRENGTHS)
    study = endline.Study(file)
    with pytest.raises(endline.EndlineError, match="merge"):
        study.threat(out)
    study.run(out)
    study.merge(out)
    threats = study.threat(out, cap_N="1100 lbf", to=tmp_path / "threat.csv")
    there = command("study", "threat", file, "--out", out, "--cap", "1100 lbf", "--json")
    assert isinstance(threats, endline.StrengthThreats) and threats.to_dict() == json.loads(there)
    types_hold(threats)
    assert [option.strength_lbf for option in threats.options] == pytest.approx([1000, 1250])
    assert threats.cap_lbf == pytest.approx(1100)
    written = polars.read_csv(tmp_path / "threat.csv")
    assert len(written) == len(threats.strengths) and (tmp_path / "threat-bands.csv").is_file()
    with pytest.raises(endline.EndlineError, match="no such event"):
        study.threat(out, event="partd")

    page = study.hindcast(out)
    assert page == command("study", "hindcast", file, "--out", out)
    assert "| B1 |" in page and "0 of 4 | not settled" in page


def test_exported_tables_are_those_of_the_command_line(command, tmp_path):
    short = endline.run("hello-endline", set={"duration": "1 s"})
    files = short.export(tmp_path / "here", rate_hz=5, from_s="200 ms", to_s=0.8)
    assert {file.name for file in files} >= {"nodes.parquet", "segments.parquet", "columns.parquet"}
    segments = polars.read_parquet(tmp_path / "here/segments.parquet")
    assert segments["time_s"].unique().sort().to_list() == pytest.approx([0.2, 0.4, 0.6, 0.8])
    assert segments["tension_N"].to_list() == short.tension_N[2:9:2].ravel().tolist()
    short.save(tmp_path / "short.endline")
    command("export", tmp_path / "short.endline", "--out", tmp_path / "there", "--rate", 5, "--format", "csv")
    for file in endline.export(tmp_path / "short.endline", tmp_path / "csv", rate_hz=5, format="csv"):
        assert file.read_bytes() == (tmp_path / "there" / file.name).read_bytes()
    with pytest.raises(endline.EndlineError, match="is no stretch of a run"):
        short.export(tmp_path / "beyond", to_s=60)


def test_a_film_is_written(tmp_path):
    short = endline.run("hello-endline", set={"duration": "1 s"})
    model = short.film(tmp_path / "run.glb", fps=5)
    assert model == tmp_path / "run.glb" and model.read_bytes()[:4] == b"glTF"
    with pytest.raises(ValueError, match=r"run.png'.*expected a file that ends with one of .gif"):
        short.film(tmp_path / "run.png")
    try:
        film = short.film(tmp_path / "run.gif", fps=5, from_s="0.2 s", to_s="0.8 s", view="side", size=(64, 48))
    except endline.EndlineError as error:
        if "EGL" in str(error):
            pytest.skip(str(error))
        raise
    content = film.read_bytes()
    assert content[:6] == b"GIF89a" and content[6:10] == bytes([64, 0, 48, 0])
    # One image descriptor follows each graphic control extension: pictures at 0.2, 0.4, 0.6 and 0.8 s.
    assert content.count(b"\x21\xf9\x04") == 4


def test_ctrl_c_interrupts_a_command_once(tmp_path, small):
    study = small(24, seconds=3)
    script = (
        "import signal; from endline._command import call\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler); print('running', flush=True)\n"
        f"try: call(['study', 'run', {str(study)!r}], {{'out': {str(tmp_path / 'out')!r}, 'threads': 1, 'eager': True}})\n"
        "except KeyboardInterrupt: print('interrupted')"
    )
    process = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "running\n"
    while not list((tmp_path / "out").glob("block-*.parquet")) and process.poll() is None:
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    out, error = process.communicate(timeout=60)
    assert out == "interrupted\n", error
    written = len(list((tmp_path / "out").glob("block-*.parquet")))
    time.sleep(1)
    assert written == len(list((tmp_path / "out").glob("block-*.parquet"))) < 24, "the command has ended"


def test_a_missing_file_is_named():
    with pytest.raises(endline.EndlineError, match="no/such.endline"):
        endline.export("no/such.endline", "tables")
    assert library_file("scenarios").is_dir()
