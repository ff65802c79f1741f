"""Typed labels of a run: outcome, partings, events, lines, contacts."""

from __future__ import annotations

import enum
from collections.abc import ItemsView, Iterator, KeysView, ValuesView
from dataclasses import dataclass
from typing import Any

import numpy as np


class OutcomeKind(str, enum.Enum):
    """Outcome of an encounter; each member equals its text, such as ``"shed"``."""

    #: Rope never touched the whale.
    NO_CONTACT = "no_contact"
    #: Rope touched the whale and came off; nothing parted.
    SHED = "shed"
    #: Rope holds the whale; nothing parted.
    ENTANGLED = "entangled"
    #: A link or line parted, and the whale is free of rope.
    PARTED_FREE = "parted_free"
    #: A link or line parted, and rope still holds the whale.
    PARTED_ENTANGLED = "parted_entangled"

    def __str__(self) -> str:
        return self.value


@dataclass(frozen=True)
class Parting:
    """A weak link or line that parted."""

    #: Its id.
    id: str
    #: ``"link"`` or ``"line"``.
    of: str
    #: Time [s].
    at_s: float
    #: Its greatest tension in the run [N].
    peak_tension_N: float


@dataclass(frozen=True)
class Outcome:
    """The outcome of a run."""

    #: Outcome of the encounter; None without a whale.
    kind: OutcomeKind | None
    #: Whether the run was long enough for ``kind`` to be final; None without a whale.
    decided: bool | None
    #: Whether the numbers are reliable.
    valid: bool
    #: Reasons for an invalid run.
    invalid_because: tuple[str, ...]
    #: Reason for a stop before the end of the run; None if it reached its end.
    stopped: str | None
    #: Time of the first contact of rope and whale [s]; None without contact.
    first_contact_s: float | None
    #: Time of the last contact [s]; None without contact.
    last_contact_s: float | None
    #: Weak links and lines that parted, by time.
    partings: tuple[Parting, ...]
    #: The result in sentences.
    headline: tuple[str, ...]

    def __str__(self) -> str:
        return " ".join(self.headline)

    @classmethod
    def of(cls, figures: dict[str, Any]) -> Outcome:
        """The outcome in the figures of a run."""
        whale = figures["whale"] or {}
        kind = whale.get("outcome")
        parted = [
            Parting(one["id"], of, one["parted_at_s"], one["peak_tension_N"])
            for of, all in (("link", figures["links"]), ("line", figures["lines"]))
            for one in all
            if one["parted_at_s"] is not None
        ]
        return cls(
            kind=None if kind is None else OutcomeKind(kind),
            decided=whale.get("decided"),
            valid=figures["valid"],
            invalid_because=tuple(figures["invalid_because"]),
            stopped=figures["stopped"],
            first_contact_s=whale.get("first_contact_s"),
            last_contact_s=whale.get("last_contact_s"),
            partings=tuple(sorted(parted, key=lambda one: one.at_s)),
            headline=tuple(figures["headline"]),
        )


@dataclass(frozen=True)
class Event:
    """An event of a run."""

    #: Time at which it was detected [s].
    time_s: float
    #: Kind, such as ``"link_parted"``.
    kind: str
    #: Part of the whale, or id of a line, link or body.
    subject: str
    #: Value, whose meaning the kind defines.
    value: float | None
    #: Unit of the value.
    unit: str


@dataclass(frozen=True)
class Line:
    """The indices of a line in the arrays of a run."""

    #: Its id.
    id: str
    #: Its nodes on axis 1 of ``Result.node_position_m``, from end A to end B.
    nodes: slice
    #: Its segments on axis 1 of ``Result.tension_N``, from end A to end B.
    segments: slice

    def __hash__(self) -> int:
        # Slices have a hash from Python 3.12.
        return hash(self.id)


class Lines:
    """The lines of a run, by id or by index.

    ``lines["endline"]`` and ``lines[0]`` are a ``Line``. ``keys()``, ``values()``, ``items()`` and ``in`` are those of a mapping
    by id, and ``dict(lines)`` is that mapping. Iteration yields the lines in the order of the figures, not their ids.
    """

    def __init__(self, lines: list[Line]) -> None:
        self._lines = tuple(lines)
        self._by_id = {line.id: line for line in lines}

    def __getitem__(self, key: str | int) -> Line:
        if isinstance(key, str):
            if key not in self._by_id:
                raise KeyError(f"there is no line {key!r}; expected one of {', '.join(self._by_id)}")
            return self._by_id[key]
        if not -len(self._lines) <= key < len(self._lines):
            raise IndexError(f"there is no line {key}; expected an index from 0 to {len(self._lines) - 1}, or an id")
        return self._lines[key]

    def __iter__(self) -> Iterator[Line]:
        return iter(self._lines)

    def __len__(self) -> int:
        return len(self._lines)

    def __contains__(self, key: object) -> bool:
        return key in self._by_id or key in self._lines

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Lines) and self._lines == other._lines

    def __hash__(self) -> int:
        return hash(self._lines)

    def keys(self) -> KeysView[str]:
        """The ids, in the order of the figures."""
        return self._by_id.keys()

    def values(self) -> ValuesView[Line]:
        """The lines, in the order of the figures."""
        return self._by_id.values()

    def items(self) -> ItemsView[str, Line]:
        """Pairs of id and line."""
        return self._by_id.items()

    def get(self, id: str, default: Any = None) -> Any:
        """The line of an id, or ``default`` if there is none."""
        return self._by_id.get(id, default)

    def index(self, line: Line | str) -> int:
        """The index of a line or of an id, as in ``Contacts.line``. Raises ``ValueError`` if there is none."""
        id = line if isinstance(line, str) else line.id
        for index, own in enumerate(self._lines):
            if own.id == id:
                return index
        raise ValueError(f"there is no line {id!r}; expected one of {', '.join(self._by_id)}")

    def __repr__(self) -> str:
        return f"Lines({list(self._lines)!r})"


@dataclass(frozen=True)
class Contacts:
    """Contacts of rope and skin: arrays of equal length along axis 0."""

    #: Index of the moment, on axis 0 of ``Result.time_s``; 0 in a single moment.
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


#: Names of the series of ``Contacts``, without ``region``.
CONTACT_SERIES = ("moment", "line", "segment", "position_m", "normal", "normal_force_N", "friction_N", "length_m")


def array(inner: Any, name: str) -> np.ndarray:
    """A series of the compiled module as a read-only array."""
    found = inner.series(name)
    if found is None:
        raise AttributeError(f"there is no series {name!r}")
    numbers, shape, kind = found
    return np.frombuffer(numbers, kind).reshape(shape)


def contacts(inner: Any) -> Contacts:
    """The contacts of a result or a moment of the compiled module."""
    region = np.array(inner.contact_regions(), dtype=str)
    return Contacts(region=region, **{name: array(inner, f"contact_{name}") for name in CONTACT_SERIES})
