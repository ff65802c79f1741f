"""Writes the dataclasses of `_gear_forms.py` and `_encounter_forms.py` in `python/endline` from the schemas of the command's JSON.

Run it with the built command after a change of a form: `python app/python/forms.py target/debug/endline`.
`tests/test_commands.py` compares the files with the schemas of the installed command.
"""

from __future__ import annotations

import json
import keyword
import subprocess
import sys
import textwrap
from pathlib import Path
from typing import Any

#: The forms that functions of the package return, with the names of their dataclasses, by file.
FILES = {
    "_gear_forms.py": {
        "endline.rules.check/1": "RuleSheet",
        "endline.rules.list/1": "RuleList",
        "endline.haul/1": "HaulSheet",
        "endline.haul_sweep/1": "HaulSweep",
        "endline.mill/1": "StrengthLaw",
        "endline.mill.means/1": "MeansLaws",
    },
    "_encounter_forms.py": {
        "endline.stories/1": "Stories",
        "endline.threat/1": "Threats",
        "endline.threat_by_strength/1": "StrengthThreats",
    },
}

HEAD = '''"""Results of commands, one dataclass for each object of their JSON. Written by `app/python/forms.py` from `endline schema`."""

from __future__ import annotations

from dataclasses import dataclass

from ._records import Record
'''

WIDTH = 127


def text(command: Path, file: str) -> str:
    """The text of a file, by the schemas that the command prints."""
    classes: dict[str, str] = {}
    for form, name in FILES[file].items():
        schema = json.loads(subprocess.run([command, "schema", form], capture_output=True, text=True, check=True).stdout)
        # A form that is a list has the name of its items.
        items = schema.get("items", {}).get("$ref", "").rsplit("/", 1)[-1]
        for inner, about in sorted(schema.get("$defs", {}).items()):
            if "properties" in about:
                _add(classes, name if inner == items else inner, about, schema, form)
        if "properties" in schema:
            _add(classes, name, schema, schema, form)
    return HEAD + "".join(classes.values())


def _add(classes: dict[str, str], name: str, about: dict[str, Any], schema: dict[str, Any], form: str) -> None:
    text = _class(name, about, schema)
    if classes.setdefault(name, text) != text:
        sys.exit(f"{form}: another form has an object {name} with other keys; give one of them another name in Rust")


def _class(name: str, about: dict[str, Any], schema: dict[str, Any]) -> str:
    lines = ["", "", "@dataclass(frozen=True)", f"class {name}(Record):"]
    description = " ".join(about.get("description", "An object of a command's JSON.").split())
    documentation = textwrap.wrap(f'"""{description}"""', WIDTH - 4)
    lines += [f"    {line}" for line in documentation] + [""]
    for key, property in about["properties"].items():
        if not key.isidentifier():
            sys.exit(f"{name}: the key {key!r} cannot be an attribute of Python")
        meaning = " ".join(_meaning(property).split())
        lines += [f"    #: {line}" for line in textwrap.wrap(meaning, WIDTH - 7)]
        attribute = f"{key}_" if keyword.iskeyword(key) else key
        lines.append(f"    {attribute}: {_type(property, schema)}")
    return "\n".join(lines) + "\n"


def _meaning(property: dict[str, Any]) -> str:
    if "const" in property and "description" in property:
        return f"{property['description'].rstrip('.')}: `{property['const']}`."
    return property.get("description", "")


def _type(about: Any, schema: dict[str, Any]) -> str:
    """The type of a value in Python."""
    if not isinstance(about, dict):
        sys.exit(f"a value without a type in its schema: {about!r}")
    if "$ref" in about:
        name = about["$ref"].rsplit("/", 1)[1]
        inner = schema["$defs"][name]
        return name if "properties" in inner else _type(inner, schema)
    choices = about.get("anyOf") or about.get("oneOf")
    if choices:
        types = list(dict.fromkeys(_type(choice, schema) for choice in choices))
        return " | ".join(sorted(types, key=lambda one: one == "None"))
    if "const" in about or "enum" in about:
        return "str"
    kinds = about.get("type", [])
    kinds = [kinds] if isinstance(kinds, str) else kinds
    types = [_plain(kind, about, schema) for kind in kinds]
    if not types:
        sys.exit(f"a value without a type in its schema: {about!r}")
    return " | ".join(types)


def _plain(kind: str, about: dict[str, Any], schema: dict[str, Any]) -> str:
    if kind == "array":
        if "prefixItems" in about:
            return f"tuple[{', '.join(_type(item, schema) for item in about['prefixItems'])}]"
        return f"list[{_type(about.get('items'), schema)}]"
    if kind == "object":
        return f"dict[str, {_type(about.get('additionalProperties'), schema)}]"
    return {"number": "float", "integer": "int", "string": "str", "boolean": "bool", "null": "None"}[kind]


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit("usage: python app/python/forms.py ENDLINE, the built command")
    for name in FILES:
        Path(__file__).with_name("python").joinpath("endline", name).write_text(text(Path(sys.argv[1]), name))
