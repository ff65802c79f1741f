"""Results of commands as dataclasses, read from the JSON that a command prints."""

from __future__ import annotations

import dataclasses
import functools
import types
import typing
from typing import Any, TypeVar

Self = TypeVar("Self", bound="Record")


class Record:
    """A result of a command. Its attributes are the keys of the command's JSON; ``to_dict()`` returns that JSON.

    A key that is a word of Python has an underscore after it, such as ``pass_``.
    Numbers are in SI where the name has no other unit. A number that is not finite is None.
    """

    @classmethod
    def of(cls: type[Self], value: dict[str, Any]) -> Self:
        """Reads a JSON object. Keys of a later version are ignored; a missing optional key is None."""
        hints: dict[str, Any] = _hints(cls)  # type: ignore[arg-type]
        return cls(**{name: _read(hint, value.get(_key(name))) for name, hint in hints.items()})

    def to_dict(self) -> dict[str, Any]:
        """The keys and values of the JSON, as dictionaries and lists."""
        return _plain(self)


def _key(attribute: str) -> str:
    """The key of an attribute, which ends with `_` where the key is a word of Python, such as `pass`."""
    return attribute.removesuffix("_")


def _plain(value: Any) -> Any:
    """A record as a dictionary, and the same for all inside it."""
    if isinstance(value, Record):
        return {_key(field.name): _plain(getattr(value, field.name)) for field in dataclasses.fields(value)}  # type: ignore[arg-type]
    if isinstance(value, (list, tuple)):
        return [_plain(one) for one in value]
    if isinstance(value, dict):
        return {key: _plain(one) for key, one in value.items()}
    return value


@functools.cache
def _hints(cls: type) -> dict[str, Any]:
    return typing.get_type_hints(cls)


def _read(hint: Any, value: Any) -> Any:
    """A value of JSON as the type of a field."""
    if value is None:
        return None
    origin = typing.get_origin(hint)
    if origin in (typing.Union, types.UnionType):
        inner = [one for one in typing.get_args(hint) if one is not type(None)]
        return _read(inner[0], value) if len(inner) == 1 else value
    if origin is list:
        [inner] = typing.get_args(hint)
        return [_read(inner, one) for one in value]
    if origin is tuple:
        return tuple(_read(inner, one) for inner, one in zip(typing.get_args(hint), value))
    if origin is dict:
        return {key: _read(typing.get_args(hint)[1], one) for key, one in value.items()}
    if isinstance(hint, type) and issubclass(hint, Record):
        return hint.of(value)
    if hint is float and isinstance(value, int):
        return float(value)
    return value
