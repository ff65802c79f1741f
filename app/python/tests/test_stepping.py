"""Runs taken step by step: pilots in Python, states stored and restored."""

import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from conftest import library_file

import endline

#: A short run whose whale meets the endline after 2 s.
NEAR = {"duration": "8 s", "whale.position": ["11.4 m", "-10 m"]}

#: A pilot program as text, and `steers` below as Python.
PROGRAM = """
[[whale.pilot]]
at = "0 s"
speed = 1.0

[[whale.pilot]]
at = "2 s"
yaw = 0.5
pitch = -0.25

[[whale.pilot]]
at = "4 s"
yaw = 0
roll = 1.0
mouth = 0.75
"""


def steers(whale):
    """The controls of PROGRAM; a program meets times to a tenth of a microsecond."""
    time_s = whale.time_s + 1e-7
    controls = {"speed": 1.0}
    if time_s >= 2:
        controls |= {"yaw": 0.5, "pitch": -0.25}
    if time_s >= 4:
        controls |= {"yaw": 0.0, "roll": 1.0, "mouth": 0.75}
    return endline.Controls(**controls)


def near(**over):
    return endline.Scenario("hello-endline", set=NEAR, **over)


def numbers(result):
    """Figures without real times."""
    clocks = {"wall_s", "times_real_time", "approach", "contact", "cost", "settled"}
    return {key: figure for key, figure in result.figures.items() if key not in clocks}


@pytest.fixture(scope="module")
def plain():
    """The short run, taken at once."""
    return near().run()


def test_the_loop_gives_the_run_taken_at_once(plain):
    moments = list(near().steps(0.1))
    assert len(moments) == 80 and np.allclose([moment.time_s for moment in moments], np.arange(1, 81) * 0.1)
    run = moments[-1].run
    assert run.finished and run.state_hash == plain.state_hash
    assert numbers(run.result()) == numbers(plain)
    for moment, index in zip(moments, range(1, 81)):
        assert np.array_equal(moment.node_position_m, plain.node_position_m[index])
        assert np.array_equal(moment.tension_N, plain.tension_N[index])
        assert np.array_equal(moment.wraps_turns, plain.wraps_turns[index])
        assert np.array_equal(moment.body_position_m, plain.body_position_m[index])
        assert moment.outcome_kind == plain.outcome_kind[index]
        assert len(moment.contacts) == (plain.contacts.moment == index).sum()
    assert np.array_equal(moments[-1].whale_position_m, plain.whale_position_m[-1])
    assert len(moments[-1].contacts) > 0, "the whale touches the endline"


def test_the_simulation_advances_when_the_loop_asks():
    moments = near().steps("500 ms")
    first = next(moments)
    assert first.time_s == pytest.approx(0.5) and first.run.time_s == first.time_s and first.step == 50
    next(moments)
    assert first.run.time_s == pytest.approx(1.0)
    assert first.time_s == pytest.approx(0.5), "a moment does not change"


def test_the_last_moment_is_that_of_the_end():
    scenario = endline.Scenario("hello-endline", set={"duration": "1 s"})
    assert [round(moment.time_s, 9) for moment in scenario.steps(0.3)] == [0.3, 0.6, 0.9, 1.0]


def test_a_pilot_in_python_gives_the_bits_of_the_same_pilot_program(plain, tmp_path):
    text = library_file("scenarios/hello-endline.toml").read_text()
    before, rest = text.split("[[whale.pilot]]")
    after = rest[rest.index("[friction]") :]
    (tmp_path / "program.toml").write_text(before + PROGRAM + "\n" + after)
    program = endline.run(tmp_path / "program.toml", set=NEAR)
    assert program.state_hash != plain.state_hash, "the program steers"

    run = near().start()
    for _ in run.steps(0.25, pilot=steers):
        pass
    assert run.state_hash == program.state_hash
    result = run.result()
    assert np.array_equal(result.node_position_m, program.node_position_m)

    result.save(tmp_path / "flown.endline")
    again = endline.replay(tmp_path / "flown.endline")
    assert again.verified and again.result.state_hash == program.state_hash
    (tmp_path / "flown.toml").write_text(result.pilot_program())
    assert endline.run(tmp_path / "flown.toml").state_hash == run.state_hash


def test_a_pilot_may_leave_the_controls_to_the_program(plain):
    run = near().start()
    run.advance(3.0, pilot=lambda whale: None)
    run.advance("60 s", pilot=lambda whale: run.program)
    assert run.finished and run.state_hash == plain.state_hash


def test_the_pilot_receives_the_whale(plain):
    seen = []

    def watch(whale):
        seen.append(whale)
        return None

    run = near().start()
    run.advance(8, pilot=watch)
    assert len(seen) == 800 and np.allclose([whale.time_s for whale in seen], np.arange(800) * 0.01)
    for index in [0, 10, 79]:
        assert np.array_equal(seen[10 * index].position_m, plain.whale_position_m[index])
        assert np.array_equal(seen[10 * index].orientation, plain.whale_orientation[index])
        assert seen[10 * index].speed_m_s == plain.whale_speed_m_s[index]
        assert list(seen[10 * index].normal_force_N) == plain.parts
        assert list(seen[10 * index].normal_force_N.values()) == list(plain.part_normal_force_N[index])
    # The scenario: 12 m deep, swimming north.
    assert seen[0].depth_m == pytest.approx(12) and seen[0].heading_deg % 360 == pytest.approx(0, abs=1e-6)
    assert seen[0].ahead == pytest.approx([0, 1, 0], abs=1e-9)


def test_yaw_to_port_turns_the_bearing_to_the_west():
    run = near().start()
    run.advance(2, pilot=lambda whale: {"speed": 1.0, "yaw": 1.0})
    assert 180 < run.whale.heading_deg < 360


def test_a_restored_state_continues_with_the_same_bits(plain, tmp_path):
    run = near().start()
    there = run.advance("6.5 s")
    assert len(there.contacts) > 0, "rope is on the skin"
    state = run.save_state()
    assert state.time_s == pytest.approx(6.5) and state.state_hash == run.state_hash
    run.advance(60)
    assert run.state_hash == plain.state_hash

    run.restore(state)
    assert run.time_s == pytest.approx(6.5) and run.state_hash == state.state_hash
    here = run.moment()
    assert np.array_equal(here.node_position_m, there.node_position_m)
    assert np.array_equal(here.contacts.normal_force_N, there.contacts.normal_force_N)
    run.advance(1, pilot=lambda whale: {"speed": 0.0, "yaw": -1.0})
    other = run.save_state()
    assert other.state_hash != state.state_hash
    run.advance(60)
    assert run.state_hash != plain.state_hash, "it was steered otherwise"

    for again in [run, near().start()]:
        again.restore(state)
        again.advance(60)
        result = again.result()
        assert again.state_hash == plain.state_hash and numbers(result) == numbers(plain)
        assert np.array_equal(result.node_position_m, plain.node_position_m)
        assert np.array_equal(result.wraps_turns, plain.wraps_turns)
        result.save(tmp_path / "again.endline")
        assert endline.replay(tmp_path / "again.endline").verified

    run.restore(other)
    assert run.state_hash == other.state_hash and run.time_s == pytest.approx(7.5)


def test_a_state_of_another_model_is_rejected():
    state = near().start().save_state()
    with pytest.raises(endline.EndlineError, match="expected a state of a run of the same scenario"):
        near(rating_N="600 lbf").start().restore(state)
    with pytest.raises(TypeError, match="expected a RunState"):
        near().start().restore("12 s")


@pytest.mark.parametrize(
    "controls, error, says",
    [
        ({"speeed": 1.0}, ValueError, "no control 'speeed'; expected some of speed, pitch"),
        ({"speed": float("nan")}, ValueError, "control speed=nan: expected a finite number"),
        ({"speed": "fast"}, ValueError, "control speed='fast': expected a finite number"),
        ({"act": "somersault"}, ValueError, "act='somersault': there is no such act"),
        (1.0, TypeError, "expected endline.Controls"),
    ],
)
def test_wrong_controls_are_named(controls, error, says):
    run = near().start()
    with pytest.raises(error, match=says):
        run.step(controls)
    assert run.time_s == 0 and run.step() and run.time_s == pytest.approx(run.step_s)


def test_controls_beyond_their_range_are_set_to_its_limit():
    runs = [near().start() for _ in range(2)]
    for run, speed in zip(runs, [1.0, 7.0]):
        run.advance(0.5, pilot=lambda whale: {"speed": speed})
    assert runs[0].state_hash == runs[1].state_hash


def test_acts_are_requested_by_id():
    flown = endline.Scenario("fly-endline").start(frames_hz=0)
    assert flown.acts, "its motion has acts"
    plain = endline.Scenario("fly-endline").start(frames_hz=0)
    for run, act in [(flown, flown.acts[0]), (plain, None)]:
        run.advance(1, pilot=lambda whale: endline.Controls(speed=1.0, act=act))
    assert flown.state_hash != plain.state_hash


def test_every_s_must_be_above_zero_and_a_pilot_needs_a_whale():
    for wrong in [0, -1.0, "0 s"]:
        with pytest.raises(ValueError, match="expected a time above 0 s"):
            near().steps(wrong)
    still = endline.Scenario("tide-turns", set={"duration": "0.2 s"})
    with pytest.raises(ValueError, match=r"no whale to steer; expected a scenario with \[whale\]"):
        still.steps(0.1, pilot=lambda whale: None)
    moments = list(still.steps(0.1))
    assert moments and moments[0].whale_position_m is None and moments[0].outcome_kind is None
    assert moments[0].run.whale is None


def test_a_finished_run_takes_no_step():
    run = endline.Scenario("hello-endline", set={"duration": "0.05 s"}).start()
    assert [run.step() for _ in range(7)] == [True] * 5 + [False] * 2
    assert run.finished and list(run.steps(0.1)) == []


def test_an_exception_of_the_pilot_leaves_the_run_at_its_last_step():
    def pilot(whale):
        if whale.time_s > 0.095:
            raise RuntimeError("no more")
        return None

    run = near().start()
    with pytest.raises(RuntimeError, match="no more"):
        run.advance(1, pilot=pilot)
    assert run.time_s == pytest.approx(0.1)


def test_ctrl_c_stops_a_loop_between_two_steps(tmp_path):
    script = (
        "import signal, endline; signal.signal(signal.SIGINT, signal.default_int_handler);"
        "run = endline.Scenario('hello-endline').start(); print('running', flush=True)\n"
        "try: run.advance(60)\n"
        "except KeyboardInterrupt: print('stopped', run.time_s < 60, run.step())"
    )
    process = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "running\n"
    time.sleep(1)
    process.send_signal(signal.SIGINT)
    out, error = process.communicate(timeout=120)
    assert out == "stopped True True\n", error
