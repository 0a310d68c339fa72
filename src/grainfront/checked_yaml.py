"""YAML files read and checked against a JSON Schema; faults are told in one sentence."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import yaml

from grainfront.errors import InputError

# Numbers but 0 lie between these, either sign: the geometry takes fourth powers of lengths and the
# laws inverse squares, which neither overflow (beyond 1e308) nor vanish (below 1e-308) then.
SMALLEST_NUMBER, LARGEST_NUMBER = 1e-50, 1e50

# What the rules and types of JSON Schema allow, in words.
LIMITS = {
    "minimum": "at least",
    "exclusiveMinimum": "greater than",
    "maximum": "at most",
    "exclusiveMaximum": "less than",
    "enum": "one of",
}
TYPES = {
    "object": "a mapping of keys to values",
    "array": "a list",
    "string": "text",
    "number": "a number",
    "integer": "a whole number",
    "boolean": "true or false",
}


class _Loader(yaml.SafeLoader):
    """Safe loader that refuses repeated keys and aliases, and reads 1e3 as a number (YAML 1.2)."""

    def compose_node(self, parent: yaml.Node | None, index: Any) -> yaml.Node | None:
        # an alias may name its own parent, or multiply a short file to gigabytes
        if self.check_event(yaml.AliasEvent):
            alias = self.peek_event()
            raise yaml.composer.ComposerError(
                None, None, f"aliases such as *{alias.anchor} are not allowed", alias.start_mark
            )
        return super().compose_node(parent, index)

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict:
        seen: set[str] = set()
        for key_node, _ in node.value:
            key = key_node.value if isinstance(key_node, yaml.ScalarNode) else None
            if key is not None and key in seen:
                raise yaml.constructor.ConstructorError(
                    None, None, f"the key '{key}' is given twice", key_node.start_mark
                )
            if key is not None:
                seen.add(key)
        return super().construct_mapping(node, deep)


_Loader.add_implicit_resolver(
    "tag:yaml.org,2002:float",
    re.compile(r"^[-+]?(\d+\.?\d*|\.\d+)[eE][-+]?\d+$"),
    list("-+.0123456789"),
)


def read_text(path: Path) -> str:
    """Text of a UTF-8 file; raises InputError where it cannot be read."""
    try:
        return path.read_text(encoding="utf-8")
    except FileNotFoundError:
        raise InputError(f"{path}: there is no such file.") from None
    except OSError as error:
        raise InputError(f"{path}: cannot be read ({error.strerror}).") from None
    except UnicodeDecodeError:
        raise InputError(f"{path}: is not a text file in UTF-8.") from None


def parse_checked(text: str, schema: dict[str, Any], where: str) -> dict[str, Any]:
    """Parse YAML and check it against `schema`, adding the schema's defaults.

    `where` names the file in errors. Raises InputError, one sentence, where the text is no YAML, is
    empty, repeats a key, holds a number that is not finite or of an absurd magnitude, or breaks the
    schema.
    """
    try:
        data = yaml.load(text, Loader=_Loader)
    except yaml.MarkedYAMLError as error:
        line = f", line {error.problem_mark.line + 1}" if error.problem_mark else ""
        raise InputError(f"{where}{line}: is not valid YAML: {error.problem}.") from None
    except (yaml.YAMLError, ValueError, RecursionError) as error:
        reason = " ".join(str(error).split())
        raise InputError(f"{where}: is not valid YAML: {reason}.") from None
    if data is None:
        raise InputError(f"{where}: is empty, but must give the keys {_keys(schema['required'])}.")
    for keys, number in _numbers(data):
        if number and not SMALLEST_NUMBER <= abs(number) <= LARGEST_NUMBER:
            raise InputError(
                f"{where}: {_dotted(keys)} is {_shown(number)}, but must be a finite number, "
                f"0 or of a magnitude between {SMALLEST_NUMBER:g} and {LARGEST_NUMBER:g}."
            )
    _check(data, schema, where)
    _complete(data, schema, schema)
    return data


def _numbers(data: Any, keys: tuple = ()) -> Iterator[tuple[tuple, float]]:
    """Every number in nested mappings and lists, with the keys that lead to it."""
    if isinstance(data, dict):
        for key, value in data.items():
            yield from _numbers(value, (*keys, key))
    elif isinstance(data, list):
        for i, value in enumerate(data):
            yield from _numbers(value, (*keys, i))
    elif isinstance(data, (int, float)):
        yield keys, data


def _check(data: Any, schema: dict[str, Any], where: str) -> None:
    """Raise InputError for the first fault; unknown keys first, as they cause other faults."""
    from jsonschema import Draft202012Validator

    errors = list(Draft202012Validator(schema).iter_errors(data))
    if errors:
        errors.sort(key=lambda e: (e.validator != "additionalProperties", len(e.absolute_path)))
        raise InputError(f"{where}: {_sentence(errors[0])}.")


def _sentence(error: Any) -> str:
    """What a schema error says to someone who knows YAML and not JSON Schema."""
    keys, found, rule = tuple(error.absolute_path), error.instance, error.validator
    if rule == "additionalProperties":
        return _unknown_key(keys, found, list(error.schema["properties"]))
    if rule == "required":
        missing = [key for key in error.validator_value if key not in found]
        meaning = error.schema["properties"][missing[0]].get("description", "")
        return f"{_dotted((*keys, missing[0]))} is missing, but must be given: {meaning}".rstrip(
            ".: "
        )
    if rule in ("minProperties", "maxProperties"):
        given = f"the keys {_keys(found)}" if found else "no key"
        allowed = _keys(error.schema["properties"])
        return f"{_dotted(keys)} has {given}, but must have exactly one of {allowed}"
    value = error.validator_value
    if rule == "dependentRequired":
        key = next(key for key in value if key in found and set(value[key]) - set(found))
        return f"{_dotted((*keys, key))} is given, but must come with {_keys(value[key])}"
    if rule in LIMITS:
        allowed = f"{LIMITS[rule]} {_keys(value) if rule == 'enum' else value}"
    elif rule == "type" or (rule == "pattern" and _only_word(error.schema)):
        allowed = _allowed_types(error.schema)
    elif rule == "minItems":
        allowed = f"a list at least {value} long"
    elif rule == "maxItems":
        allowed = f"a list at most {value} long"
    elif rule == "uniqueItems":
        allowed = "a list without repetitions"
    elif rule == "minLength":
        allowed = "text that is not empty"
    else:
        allowed = f"text of the pattern {value}" if rule == "pattern" else error.message
    return f"{_dotted(keys)} is {_shown(found)}, but must be {allowed}"


def _only_word(schema: dict[str, Any]) -> str | None:
    """The one word that a schema allows as text, if it is so."""
    found = re.fullmatch(r"\^(\w+)\$", schema.get("pattern", ""))
    return found[1] if found else None


def _allowed_types(schema: dict[str, Any]) -> str:
    """The kinds of values that a schema allows, such as: a number or auto."""
    types = [schema["type"]] if isinstance(schema["type"], str) else schema["type"]
    word = _only_word(schema)
    return " or ".join(word if word and t == "string" else TYPES[t] for t in types)


def _unknown_key(keys: tuple, found: dict, allowed: list[str]) -> str:
    unknown = next(key for key in found if key not in allowed)
    close = difflib.get_close_matches(str(unknown), allowed, n=1, cutoff=0.7)
    hint = f" (did you mean {close[0]}?)" if close else ""
    return f"{_dotted((*keys, unknown))} is an unknown key{hint}; allowed are {_keys(allowed)}"


def _complete(data: Any, schema: dict[str, Any], root: dict[str, Any]) -> None:
    """Add defaults for keys not given and turn 24.0 into 24 where a whole number is asked for.

    In place and at every depth; `data` is known to satisfy the schema.
    """
    for key, described in schema.get("properties", {}).items():
        if "$ref" in described:
            described = root["$defs"][described["$ref"].rsplit("/", 1)[-1]]
        if "default" in described and key not in data:
            default = described["default"]
            data[key] = dict(default) if isinstance(default, dict) else default
        if described.get("type") == "integer" and key in data:
            data[key] = int(data[key])
        if isinstance(data.get(key), dict):
            _complete(data[key], described, root)


def _dotted(keys: tuple) -> str:
    """Keys as a path, such as packing.n_angle or seeds[0]; the file itself where there are none."""
    path = ""
    for key in keys:
        path += f"[{key}]" if isinstance(key, int) else f".{key}"
    return path.lstrip(".") or "the file"


def _keys(keys: Any) -> str:
    return ", ".join(map(str, keys))


def _shown(value: Any) -> str:
    """A value as found, shortened."""
    text = "empty" if value is None else repr(value)
    return text if len(text) <= 60 else text[:57] + "..."
