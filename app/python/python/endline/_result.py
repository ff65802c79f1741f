"""The results of a run: figures, arrays, a recording, pictures."""

from __future__ import annotations

import functools
import json
import os
import struct
import zlib
from dataclasses import dataclass
from pathlib import PurePath
from typing import Any

import numpy as np

from . import _endline


@dataclass(frozen=True)
class Line:
    """The indices of a line in the arrays of a run."""

    #: Its id.
    id: str
    #: Its nodes on axis 1 of ``Result.node_position_m``, from end A to end B.
    nodes: slice
    #: Its segments on axis 1 of ``Result.tension_N``, from end A to end B.
    segments: slice


@dataclass(frozen=True)
class Contacts:
    """Contacts of rope and skin at all moments: arrays of equal length along axis 0."""

    #: Index of the moment, on axis 0 of ``Result.time_s``.
    moment: np.ndarray
    #: Index of the line in ``Result.lines``.
    line: np.ndarray
    #: Index of the segment on axis 1 of ``Result.tension_N``.
    segment: np.ndarray
    #: Region of the skin, as text.
    region: np.ndarray
    #: Place on the rope's centre line [m], shape (n, 3).
    position_m: np.ndarray
    #: Unit normal from skin to rope, shape (n, 3).
    normal: np.ndarray
    #: Normal force [N].
    normal_force_N: np.ndarray
    #: Friction force of skin on rope [N], shape (n, 3).
    friction_N: np.ndarray
    #: Length of rope of a contact [m].
    length_m: np.ndarray

    def __len__(self) -> int:
        return len(self.moment)


class Result:
    """A run that has ended: its figures, and its moments as read-only numpy arrays, one moment for each entry of axis 0."""

    def __init__(self, inner: _endline.Result) -> None:
        self._inner = inner

    @functools.cached_property
    def figures(self) -> dict[str, Any]:
        """Every figure under the keys of ``endline run --json`` (schema ``endline.run/1``)."""
        return json.loads(self._inner.json())

    @property
    def state_hash(self) -> str:
        """Hash of the last state; equal bits give equal hashes."""
        return self.figures["state_hash"]

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
    def contacts(self) -> Contacts:
        """Contacts of rope and skin at each moment."""
        names = ("moment", "line", "segment", "position_m", "normal", "normal_force_N", "friction_N", "length_m")
        region = np.array(self._inner.contact_regions(), dtype=str)
        return Contacts(region=region, **{name: self._array(f"contact_{name}") for name in names})

    @functools.cached_property
    def lines(self) -> list[Line]:
        """The lines, in the order of the figures."""
        return [Line(id, slice(a, b), slice(c, d)) for id, (a, b, c, d) in self._inner.lines()]

    @functools.cached_property
    def bodies(self) -> list[str]:
        """Ids of the bodies, in the order of axis 1 of ``body_position_m``."""
        return self._inner.bodies()

    def line_tension_N(self, line: str) -> np.ndarray:
        """Greatest tension along a line at each moment [N], shape (moments,)."""
        return self.tension_N[:, self._line(line).segments].max(axis=1)

    def line_position_m(self, line: str) -> np.ndarray:
        """Places of a line's nodes from end A to end B [m], shape (moments, nodes, 3)."""
        return self.node_position_m[:, self._line(line).nodes]

    def save(self, path: str | os.PathLike[str]) -> None:
        """Saves the recording, which ``endline replay`` and the workbench open."""
        self._inner.save(path)

    def render(
        self, at_s: float | None = None, *, view: str = "orbit", size: tuple[int, int] = (1280, 800)
    ) -> np.ndarray:
        """A picture of the moment nearest to a time [s], as ``endline render`` draws it: RGBA, shape (height, width, 4), uint8.

        Without ``at_s``, the moment of the greatest tension. ``view`` is one of the views of ``endline render``. Needs EGL.
        """
        if len(self.time_s) == 0:
            raise ValueError("no moments are stored; run with frames_hz above 0")
        if at_s is None:
            lines = self.figures["lines"]
            at_s = max(lines, key=lambda line: line["peak_tension_N"])["peak_at_s"] if lines else 0.0
        moment = int(np.abs(self.time_s - at_s).argmin())
        width, height = size
        caption = PurePath(self.figures["scenario"]).stem
        pixels = self._inner.render(moment, view, (width, height), caption)
        return np.frombuffer(pixels, np.uint8).reshape(height, width, 4)

    def _repr_png_(self) -> bytes | None:
        """The picture for Jupyter; None without moments."""
        try:
            return _png(self.render(size=(960, 600)))
        except (ValueError, _endline.EndlineError):
            return None

    def __repr__(self) -> str:
        figures = self.figures
        return f"Result({figures['scenario']!r}, {figures['simulated_s']:g} s, state {figures['state_hash']})"

    def _line(self, id: str) -> Line:
        for line in self.lines:
            if line.id == id:
                return line
        known = ", ".join(line.id for line in self.lines)
        raise KeyError(f"there is no line {id!r}; there are {known}")

    def _array(self, name: str) -> np.ndarray:
        found = self._inner.series(name)
        if found is None:
            raise AttributeError(f"there is no series {name!r}")
        numbers, shape, kind = found
        return np.frombuffer(numbers, kind).reshape(shape)


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


def _png(pixels: np.ndarray) -> bytes:
    """RGBA pixels as a PNG file."""
    height, width, _ = pixels.shape

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    rows = np.concatenate([np.zeros((height, 1), np.uint8), pixels.reshape(height, width * 4)], axis=1)
    head = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    body = zlib.compress(rows.tobytes(), 6)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", body) + chunk(b"IEND", b"")
