"""The results of a run: figures, arrays, a recording, pictures."""

from __future__ import annotations

import functools
import json
import os
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path, PurePath
from typing import Any, TypeVar

import numpy as np

from . import _endline, _tables
from ._commands import export, film
from ._labels import Contacts, Event, Line, Lines, Outcome, array, contacts
from ._units import PathLike, Quantity, si

#: Stored moments per simulated second, as with ``endline run --out`` [Hz].
FRAMES_HZ = 10.0

Made = TypeVar("Made")


class Result:
    """A run that has ended: its figures, and its moments as read-only numpy arrays, one moment for each entry of axis 0."""

    def __init__(self, inner: _endline.Result) -> None:
        self._inner = inner

    @classmethod
    def load(cls, recording: PathLike, *, frames_hz: Quantity = FRAMES_HZ, other_plugins: bool = False) -> Result:
        """The result of a recording, which is computed again from its inputs, and compared in every step.

        A recording contains inputs and hashes of states, but no arrays; ``to_xarray().to_netcdf(file)`` and ``export(folder)``
        store arrays. Raises ``EndlineError`` at a step that differs; ``replay`` returns such a result with the step.
        """
        inner, differs = _endline.replay(recording, si(frames_hz, "frames_hz", "Hz"), other_plugins)
        if differs is not None:
            step, time_s, part = differs
            raise _endline.EndlineError(
                f"{os.fspath(recording)}: step {step} ({time_s:.3f} s): {part} differs from the recording; "
                "expected the version of Endline and the plugins that recorded it; endline.replay returns what differs"
            )
        return cls(inner)

    @functools.cached_property
    def figures(self) -> dict[str, Any]:
        """Every figure under the keys of ``endline run --json`` (schema ``endline.run/1``)."""
        return json.loads(self._inner.json())

    @property
    def state_hash(self) -> str:
        """Hash of the last state; equal bits give equal hashes."""
        return self.figures["state_hash"]

    @functools.cached_property
    def outcome(self) -> Outcome:
        """The outcome of the run: its kind, validity, partings, and the result in sentences."""
        return Outcome.of(self.figures)

    @functools.cached_property
    def events(self) -> tuple[Event, ...]:
        """The events of all steps, by time: contacts, wraps, partings, bodies that are dragged or caught."""
        keys = ("time_s", "kind", "subject", "value", "unit")
        return tuple(Event(*(event[key] for key in keys)) for event in self.figures["events"])

    @functools.cached_property
    def time_s(self) -> np.ndarray:
        """Simulated time of each moment [s], shape (moments,)."""
        return self._array("time_s")

    @functools.cached_property
    def step(self) -> np.ndarray:
        """Steps taken at each moment, shape (moments,)."""
        return self._array("step")

    @functools.cached_property
    def node_position_m(self) -> np.ndarray:
        """Places of the rope's nodes [m], shape (moments, nodes, 3); ``lines`` has the indices of each line."""
        return self._array("node_position_m")

    @functools.cached_property
    def tension_N(self) -> np.ndarray:
        """Tension of each segment, not negative [N], shape (moments, segments)."""
        return self._array("tension_N")

    @functools.cached_property
    def segment_length_m(self) -> np.ndarray:
        """Unstretched length of each segment [m], shape (moments, segments)."""
        return self._array("segment_length_m")

    @functools.cached_property
    def body_position_m(self) -> np.ndarray:
        """Places of the bodies [m], shape (moments, bodies, 3)."""
        return self._array("body_position_m")

    @functools.cached_property
    def body_orientation(self) -> np.ndarray:
        """Orientation of the bodies, body to world, as (x, y, z, w), shape (moments, bodies, 4)."""
        return self._array("body_orientation")

    @functools.cached_property
    def whale_position_m(self) -> np.ndarray:
        """Place of the origin of the whale's frame [m], shape (moments, 3); (0, 3) without a whale."""
        return self._array("whale_position_m")

    @functools.cached_property
    def whale_orientation(self) -> np.ndarray:
        """Orientation of the whale, whale to world, as (x, y, z, w), shape (moments, 4)."""
        return self._array("whale_orientation")

    @functools.cached_property
    def whale_speed_m_s(self) -> np.ndarray:
        """Speed of the whale through the water [m/s], shape (moments,)."""
        return self._array("whale_speed_m_s")

    @functools.cached_property
    def is_cut(self) -> np.ndarray:
        """Whether each segment has parted, shape (moments, segments), bool."""
        return self._array("is_cut")

    @functools.cached_property
    def outcome_kind(self) -> np.ndarray:
        """The outcome so far at each moment, as the texts of ``OutcomeKind``, shape (moments,); (0,) without a whale."""
        return np.array(self._inner.outcomes(), dtype=str)

    @functools.cached_property
    def outcome_decided(self) -> np.ndarray:
        """Whether the run was then long enough for the outcome to be final, shape (moments,), bool."""
        return self._array("decided")

    @functools.cached_property
    def wraps_turns(self) -> np.ndarray:
        """Turns of rope about each part of the whale, shape (moments, parts); ``parts`` has the names."""
        return self._array("wraps_turns")

    @functools.cached_property
    def part_normal_force_N(self) -> np.ndarray:
        """Sum of the normal forces on each part of the whale, mean of the step before the moment [N], shape (moments, parts)."""
        return self._array("part_normal_force_N")

    @functools.cached_property
    def parts(self) -> list[str]:
        """Names of the whale's parts, in the order of axis 1 of ``wraps_turns``."""
        return _endline.parts()

    @functools.cached_property
    def contacts(self) -> Contacts:
        """Contacts of rope and skin at each moment."""
        return contacts(self._inner)

    @functools.cached_property
    def lines(self) -> Lines:
        """The lines, by id or index; iteration yields ``Line`` in the order of the figures."""
        return Lines([Line(id, slice(a, b), slice(c, d)) for id, (a, b, c, d) in self._inner.lines()])

    @functools.cached_property
    def bodies(self) -> list[str]:
        """Ids of the bodies, in the order of axis 1 of ``body_position_m``."""
        return self._inner.bodies()

    def line_tension_N(self, line: str) -> np.ndarray:
        """Greatest tension along a line at each moment [N], shape (moments,)."""
        return self.tension_N[:, self.lines[line].segments].max(axis=1)

    def line_position_m(self, line: str) -> np.ndarray:
        """Places of a line's nodes from end A to end B [m], shape (moments, nodes, 3)."""
        return self.node_position_m[:, self.lines[line].nodes]

    def to_xarray(self) -> Any:
        """The arrays as an ``xarray.Dataset`` with named axes, and with unit and meaning of each array in its ``attrs``.

        Needs xarray: ``pip install xarray``.
        """
        return _tables.to_xarray(self)

    def to_pandas(self, table: str = "moments") -> Any:
        """A table as a ``pandas.DataFrame``. Units are part of the columns' names. Needs pandas: ``pip install pandas``.

        ``"moments"`` has a row for each moment, indexed by ``time_s``: outcome, whale, greatest tension of each line, wraps of
        each part. ``"nodes"``, ``"segments"``, ``"bodies"``, ``"whale"`` and ``"contacts"`` are the tables of ``export``.
        ``"events"`` has a row for each event.
        """
        return _tables.to_pandas(self, table)

    def save(self, path: PathLike) -> None:
        """Saves the recording, which ``Result.load``, ``endline replay`` and the workbench open."""
        self._inner.save(path)

    def pilot_program(self) -> str:
        """The scenario with the inputs of the run as its pilot program: text of a scenario file whose run has the same bits.

        Fields of the scenario that ``set`` changed are in the text. Its first line names the other options of the run, such as
        ``--seed 3``, and changed fields of library files are given again with ``set``. Raises ``EndlineError`` without a whale.
        """
        return self._inner.pilot_program()

    def render(
        self, at_s: Quantity | None = None, *, view: str = "orbit", size: tuple[int, int] = (1280, 800)
    ) -> np.ndarray:
        """A picture of the moment nearest to a time, as ``endline render`` draws it: RGBA, shape (height, width, 4), uint8.

        Without ``at_s``, the moment of the greatest tension. ``view`` is one of the views of ``endline render``. Needs EGL.
        """
        if len(self.time_s) == 0:
            raise ValueError("no moments are stored; expected a run with frames_hz above 0")
        if at_s is None:
            lines = self.figures["lines"]
            at_s = max(lines, key=lambda line: line["peak_tension_N"])["peak_at_s"] if lines else 0.0
        moment = int(np.abs(self.time_s - si(at_s, "at_s", "s")).argmin())
        width, height = size
        caption = PurePath(self.figures["scenario"]).stem
        pixels = self._inner.render(moment, view, (width, height), caption)
        return np.frombuffer(pixels, np.uint8).reshape(height, width, 4)

    def export(
        self,
        folder: PathLike,
        *,
        format: str = "parquet",
        rate_hz: int = 10,
        from_s: Quantity | None = None,
        to_s: Quantity | None = None,
    ) -> list[Path]:
        """Writes moments as tables, as ``endline.export`` describes; returns their files. The run is computed again."""
        return self._recorded(lambda file: export(file, folder, format=format, rate_hz=rate_hz, from_s=from_s, to_s=to_s))

    def film(
        self,
        to: PathLike,
        *,
        from_s: Quantity | None = None,
        to_s: Quantity | None = None,
        fps: int = 20,
        view: str = "orbit",
        look: str = "measured",
        size: tuple[int, int] = (1280, 800),
    ) -> Path:
        """Writes a film or an animated 3-D model, as ``endline.film`` describes; returns its path. The run is computed again."""
        return self._recorded(
            lambda file: film(file, to, from_s=from_s, to_s=to_s, fps=fps, view=view, look=look, size=size)
        )

    def _repr_html_(self) -> str:
        """The headline and the lines for Jupyter, without a picture."""
        return _tables.to_html(self)

    def __repr__(self) -> str:
        figures = self.figures
        return f"Result({figures['scenario']!r}, {figures['simulated_s']:g} s, state {figures['state_hash']})"

    def _recorded(self, work: Callable[[Path], Made]) -> Made:
        """Gives a recording of the run to a command."""
        with tempfile.TemporaryDirectory(prefix="endline-") as folder:
            file = Path(folder, f"{PurePath(self.figures['scenario']).stem}.endline")
            self.save(file)
            return work(file)

    def _array(self, name: str) -> np.ndarray:
        return array(self._inner, name)


@dataclass(frozen=True)
class Replayed:
    """A replayed recording."""

    #: The run, up to the first step that differs.
    result: Result
    #: The first step that differs, its time [s] and the part of the state; None if all steps have the recorded bits.
    differs: tuple[int, float, str] | None

    @property
    def verified(self) -> bool:
        """Whether all steps have the recorded bits."""
        return self.differs is None
