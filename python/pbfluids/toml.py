"""TOML in and out, for scenes: the standard library reads it but does not write it."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping
from typing import Any

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

__all__ = ["TOMLDecodeError", "dumps", "loads"]

TOMLDecodeError = tomllib.TOMLDecodeError


def loads(text: str) -> dict[str, Any]:
    """Read TOML.

    Raises
    ------
    TOMLDecodeError
        If it is none, or more than the parser takes: numbers of thousands of digits, deep nesting.
    """
    try:
        return tomllib.loads(text)
    except RecursionError as error:
        raise TOMLDecodeError("nested too deeply") from error
    except TOMLDecodeError:
        raise
    except ValueError as error:
        raise TOMLDecodeError(str(error)) from error


def dumps(data: Mapping[str, Any]) -> str:
    """Write values, then tables, then arrays of tables. None is left out: TOML has no word for it.

    Parameters
    ----------
    data
        Strings, numbers, booleans, lists of them, mappings of them and lists of mappings.
    """
    lines = list(_values(data))
    for key, value in data.items():
        if isinstance(value, Mapping):
            lines += ["", f"[{key}]", *_values(value)]
        elif _is_table_array(value):
            for table in value:
                lines += ["", f"[[{key}]]", *_values(table)]
    return "\n".join(lines) + "\n"


def _is_table_array(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and isinstance(value[0], Mapping)


def _values(table: Mapping[str, Any]) -> list[str]:
    plain = {
        key: value
        for key, value in table.items()
        if value is not None and not isinstance(value, Mapping) and not _is_table_array(value)
    }
    return [f"{key} = {_text(value)}" for key, value in plain.items()]


def _text(value: Any) -> str:
    if isinstance(value, list):
        return "[" + ", ".join(_text(item) for item in value) + "]"
    if isinstance(value, str):  # JSON's escapes are TOML's, but for DEL
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, bool):
        return "true" if value else "false"
    return repr(value)
