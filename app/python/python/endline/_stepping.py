"""A run taken step by step, with a pilot in Python; states stored and restored."""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, fields
from typing import Any, Union

import numpy as np

from . import _endline
from ._labels import Contacts, OutcomeKind, array, contacts
from ._result import Result
from ._units import Quantity, si


@dataclass(frozen=True)
class Controls:
    """Controls of a whale for one step, as a pad or a pilot program gives them. A control beyond its range is set to its limit."""

    #: Swimming speed, 0 (glide) to 1 (cruise).
    speed: float = 0.0
    #: Pitch, -1 (nose down) to 1 (nose up).
    pitch: float = 0.0
    #: Roll, -1 (to port) to 1 (to starboard).
    roll: float = 0.0
    #: Yaw, -1 (to starboard) to 1 (to port).
    yaw: float = 0.0
    #: Burst, 0 or 1: the greatest swimming speed.
    burst: float = 0.0
    #: Mouth, 0 (closed) to 1 (open).
    mouth: float = 0.0
    #: Flippers abducted (1) or adducted (-1).
    flipper_raise: float = 0.0
    #: Flippers pronated (1) or supinated (-1).
    flipper_twist: float = 0.0
    #: Flippers swept forward (1) or aft (-1).
    flipper_sweep: float = 0.0
    #: Id of a requested act of the whale's motion, such as ``"roll-away"``; None for none.
    act: str | None = None


#: Names of the controls.
NAMES = tuple(field.name for field in fields(Controls))


@dataclass(frozen=True)
class Whale:
    """A whale at the start of a step, as a pilot receives it."""

    #: Simulated time [s].
    time_s: float
    #: Place of the origin of the whale's frame [m]: x east, y north, z up from the mean sea surface; shape (3,).
    position_m: np.ndarray
    #: Orientation, whale to world, as (x, y, z, w); shape (4,).
    orientation: np.ndarray
    #: Speed through the water [m/s].
    speed_m_s: float
    #: Sum of the normal contact forces on each part, mean of the last step [N], by the part's name.
    normal_force_N: dict[str, float]

    @property
    def depth_m(self) -> float:
        """Depth of the origin of the whale's frame [m]."""
        return -float(self.position_m[2])

    @property
    def ahead(self) -> np.ndarray:
        """Unit vector from the whale's middle to its snout, shape (3,)."""
        x, y, z, w = self.orientation
        return np.array([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)])

    @property
    def heading_deg(self) -> float:
        """Compass bearing of the snout, 0 to 360 [deg]: 0 is north, 90 is east."""
        ahead = self.ahead
        return math.degrees(math.atan2(ahead[0], ahead[1])) % 360.0


#: A pilot: a function that receives the whale and returns its controls, a mapping of controls by name, or None for the
#: controls of the scenario's pilot program.
Pilot = Callable[[Whale], Union[Controls, Mapping[str, Union[float, str, None]], None]]


class Moment:
    """A moment of a run in progress, as read-only numpy arrays; names are those of ``Result``, without the axis of moments."""

    def __init__(self, inner: _endline.Moment, run: Run) -> None:
        self._inner = inner
        #: The run.
        self.run = run

    @property
    def time_s(self) -> float:
        """Simulated time [s]."""
        return float(self._one("time_s"))

    @property
    def step(self) -> int:
        """Steps taken."""
        return int(self._one("step"))

    @functools.cached_property
    def node_position_m(self) -> np.ndarray:
        """Places of the rope's nodes [m], shape (nodes, 3); the indices of a line are those of ``Result.lines``."""
        return self._one("node_position_m")

    @functools.cached_property
    def tension_N(self) -> np.ndarray:
        """Tension of each segment, not negative [N], shape (segments,)."""
        return self._one("tension_N")

    @functools.cached_property
    def segment_length_m(self) -> np.ndarray:
        """Unstretched length of each segment [m], shape (segments,)."""
        return self._one("segment_length_m")

    @functools.cached_property
    def is_cut(self) -> np.ndarray:
        """Whether each segment has parted, shape (segments,), bool."""
        return self._one("is_cut")

    @functools.cached_property
    def body_position_m(self) -> np.ndarray:
        """Places of the bodies [m], shape (bodies, 3)."""
        return self._one("body_position_m")

    @functools.cached_property
    def body_orientation(self) -> np.ndarray:
        """Orientation of the bodies, body to world, as (x, y, z, w), shape (bodies, 4)."""
        return self._one("body_orientation")

    @functools.cached_property
    def whale_position_m(self) -> np.ndarray | None:
        """Place of the origin of the whale's frame [m], shape (3,); None without a whale."""
        return self._one("whale_position_m")

    @functools.cached_property
    def whale_orientation(self) -> np.ndarray | None:
        """Orientation of the whale, whale to world, as (x, y, z, w), shape (4,); None without a whale."""
        return self._one("whale_orientation")

    @property
    def whale_speed_m_s(self) -> float | None:
        """Speed of the whale through the water [m/s]; None without a whale."""
        speed = self._one("whale_speed_m_s")
        return None if speed is None else float(speed)

    @functools.cached_property
    def wraps_turns(self) -> np.ndarray | None:
        """Turns of rope about each part of the whale, shape (parts,); None without a whale."""
        return self._one("wraps_turns")

    @functools.cached_property
    def part_normal_force_N(self) -> np.ndarray | None:
        """Sum of the normal forces on each part of the whale, mean of the last step [N], shape (parts,); None without a whale."""
        return self._one("part_normal_force_N")

    @property
    def outcome_kind(self) -> OutcomeKind | None:
        """The outcome so far; None without a whale."""
        kind = self._inner.outcome()
        return None if kind is None else OutcomeKind(kind)

    @functools.cached_property
    def contacts(self) -> Contacts:
        """Contacts of rope and skin."""
        return contacts(self._inner)

    def __repr__(self) -> str:
        return f"Moment({self.time_s:g} s)"

    def _one(self, name: str) -> Any:
        """The values of the one moment; None without a whale."""
        values = array(self._inner, name)
        return values[0] if len(values) > 0 else None


class RunState:
    """A stored state of a run, from which runs of the same scenario continue with the same bits.

    It stays in the memory of this process. To store a run in a file, save its recording: ``run.result().save(file)``.
    """

    def __init__(self, inner: _endline.RunState, time_s: float, state_hash: str) -> None:
        self._inner = inner
        #: Its simulated time [s].
        self.time_s = time_s
        #: Hash of the state; equal bits give equal hashes.
        self.state_hash = state_hash

    def __repr__(self) -> str:
        return f"RunState({self.time_s:g} s, state {self.state_hash})"


class Run:
    """A run in progress, from ``Scenario.start()``. Inputs are recorded, so that ``result().save(file)`` replays bit for bit."""

    def __init__(self, inner: _endline.Run) -> None:
        self._inner = inner
        #: Length of a step between inputs [s].
        self.step_s, self._steps = inner.extent()
        self._acts = inner.acts()
        self._parts = _endline.parts()

    @property
    def time_s(self) -> float:
        """Simulated time [s]."""
        return self._inner.now()[0]

    @property
    def finished(self) -> bool:
        """Whether the scenario's time is over or the run has stopped; ``result().outcome.stopped`` says why it stopped."""
        return self._inner.finished()

    @property
    def state_hash(self) -> str:
        """Hash of the state now; equal bits give equal hashes."""
        return self._inner.state_hash()

    @property
    def acts(self) -> list[str]:
        """Ids of the acts of the whale's motion, for ``Controls.act``; empty without a whale."""
        return list(self._acts or [])

    @property
    def program(self) -> Controls:
        """The controls that the scenario's pilot program gives for the next step."""
        numbers: dict[str, Any] = dict(zip(NAMES, self._inner.program()))
        act = int(numbers["act"])
        return Controls(**{**numbers, "act": self.acts[act - 1] if act > 0 else None})

    @property
    def whale(self) -> Whale | None:
        """The whale now, as a pilot receives it; None without a whale."""
        now = self._inner.whale()
        if now is None:
            return None
        position, orientation, speed, forces = now
        return Whale(self.time_s, np.array(position), np.array(orientation), speed, dict(zip(self._parts, forces)))

    def moment(self) -> Moment:
        """The moment now."""
        return Moment(self._inner.moment(), self)

    def step(self, controls: Controls | Mapping[str, float | str | None] | None = None) -> bool:
        """Takes one step under these controls, or under the scenario's pilot program where None; returns whether it was taken.

        No step is taken once the run is finished, and the step at which a run stops does not count as taken.
        """
        return self._inner.step(self._numbers(controls), 1) == 1

    def advance(self, for_s: Quantity, *, pilot: Pilot | None = None) -> Moment:
        """Takes steps for a simulated time, at least one, or to the end of the run; returns the moment reached."""
        self._advance(self._count(for_s, "for_s"), pilot)
        return self.moment()

    def steps(self, every_s: Quantity = 0.1, *, pilot: Pilot | None = None) -> Iterator[Moment]:
        """Yields a moment after each ``every_s`` of simulated time, up to the end of the scenario.

        ``every_s`` is rounded to whole steps, at least one; the last moment is that of the end. The simulation advances when the
        loop asks for the next moment, so that a state may be restored between two. ``pilot`` is called before each step of
        ``step_s``; without one, the scenario's pilot program steers.

        Raises ``ValueError`` for ``every_s`` that is not above 0, and for a pilot in a scenario without a whale.
        """
        count = self._count(every_s, "every_s")
        self._check(pilot)
        return self._moments(count, pilot)

    def save_state(self) -> RunState:
        """The state now, for ``restore``. Raises ``EndlineError`` if the run has stopped, as no run continues from there."""
        return RunState(self._inner.save_state(), self.time_s, self.state_hash)

    def restore(self, state: RunState) -> None:
        """Continues from a state that this run, or another run of the same scenario, has stored.

        The run is then that of the state: its inputs and stored moments too. Raises ``EndlineError`` if the state is of another
        scenario, library or option.
        """
        if not isinstance(state, RunState):
            raise TypeError(f"state={state!r}: expected a RunState from save_state()")
        self._inner.restore(state._inner)

    def result(self) -> Result:
        """The results so far, with the moments that were stored at ``frames_hz``."""
        return Result(self._inner.result())

    def __repr__(self) -> str:
        return f"Run({self.time_s:g} s of {self._steps * self.step_s:g} s)"

    def _moments(self, count: int, pilot: Pilot | None) -> Iterator[Moment]:
        while not self.finished and self._advance(count, pilot) > 0:
            yield self.moment()

    def _advance(self, count: int, pilot: Pilot | None) -> int:
        """Takes steps; returns how many were taken."""
        if pilot is None:
            return self._inner.step(None, count)
        self._check(pilot)
        for taken in range(count):
            whale = self.whale
            if whale is None or self.finished or self._inner.step(self._numbers(pilot(whale)), 1) == 0:
                return taken
        return count

    def _check(self, pilot: Pilot | None) -> None:
        if pilot is not None and self._acts is None:
            raise ValueError("pilot: the scenario has no whale to steer; expected a scenario with [whale], or pilot=None")

    def _count(self, time: Quantity, argument: str) -> int:
        """A time as a number of steps."""
        time_s = si(time, argument, "s")
        if time_s <= 0:
            raise ValueError(f"{argument}={time!r}: expected a time above 0 s")
        return max(1, round(time_s / self.step_s))

    def _numbers(self, controls: Controls | Mapping[str, float | str | None] | None) -> list[float] | None:
        """Controls in the order of the compiled module; None for the pilot program's."""
        if controls is None:
            return None
        if isinstance(controls, Mapping):
            unknown = [name for name in controls if name not in NAMES]
            if unknown:
                raise ValueError(f"there is no control {unknown[0]!r}; expected some of {', '.join(NAMES)}")
            named: dict[str, Any] = dict(controls)
            controls = Controls(**named)
        if not isinstance(controls, Controls):
            raise TypeError(f"{controls!r} is no controls; expected endline.Controls, a mapping of controls by name, or None")
        amounts = []
        for name in NAMES[:-1]:
            value = getattr(controls, name)
            try:
                number = float(value)
            except (TypeError, ValueError):
                number = math.nan
            if not math.isfinite(number):
                raise ValueError(f"control {name}={value!r}: expected a finite number")
            amounts.append(number)
        return [*amounts, self._act(controls.act)]

    def _act(self, act: str | None) -> float:
        if act is None:
            return 0.0
        if act not in self.acts:
            known = f"one of {', '.join(self.acts)}" if self.acts else "None, because the whale's motion has no acts"
            raise ValueError(f"act={act!r}: there is no such act; expected {known}")
        return float(self.acts.index(act) + 1)
