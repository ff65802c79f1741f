"""Quantities as arguments: a number in SI, or a text with its unit."""

from __future__ import annotations

import math
import os
from typing import Union

from . import _endline

#: A file or folder.
PathLike = Union[str, "os.PathLike[str]"]

#: A number in the SI unit that the argument's name ends with, or a text with a unit, such as ``"40 fathom"``.
Quantity = Union[float, str]


def si(value: Quantity, argument: str, unit: str) -> float:
    """A quantity in an SI unit, such as ``m/s``; ``argument`` is its name in messages.

    Raises ``ValueError`` for a text without a unit of this quantity and for a number that is not finite, ``TypeError`` for
    another type.
    """
    if isinstance(value, str):
        return _endline.si(value, unit, argument)
    expected = f"expected a finite number in {unit}, or a text with its unit"
    if isinstance(value, bool):
        raise TypeError(f"{argument}={value!r}: {expected}")
    try:
        number = float(value)
    except TypeError:
        raise TypeError(f"{argument}={value!r}: {expected}") from None
    if not math.isfinite(number):
        raise ValueError(f"{argument}={value!r}: {expected}")
    return number


def si_or_none(value: Quantity | None, argument: str, unit: str) -> float | None:
    """``si`` for an argument that may be omitted."""
    return None if value is None else si(value, argument, unit)


def length_text(value: Quantity | None, argument: str) -> str | None:
    """A length as a text with its unit, as gear files have it."""
    return None if value is None else f"{si(value, argument, 'm')!r} m"
