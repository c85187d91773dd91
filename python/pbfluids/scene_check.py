"""Find every fault of a scene at once, each with its path inside the scene."""

from __future__ import annotations

import difflib
import json
import os
from collections.abc import Iterator, Mapping
from typing import Any

from pydantic import ValidationError

from pbfluids.errors import InvalidParameter, WrongType
from pbfluids.scene_data import Path, files_of
from pbfluids.scene_geometry import geometry_faults
from pbfluids.scene_model import (
    STRUCTS,
    TABLES,
    Ball,
    Block,
    Domain,
    SceneModel,
    SceneTables,
    for_struct,
)

# pydantic's names of faults, and the rule that was broken.
_RULES = {
    "bool_type": "must be true or false",
    "dict_type": "must be a table",
    "finite_number": "must be finite",
    "float_type": "must be a number",
    "greater_than": "must be > {gt:g}",
    "greater_than_equal": "must be >= {ge:g}",
    "int_from_float": "must be a whole number",
    "int_type": "must be a whole number",
    "less_than_equal": "must be <= {le:g}",
    "list_type": "must be a list",
    "literal_error": "must be {expected}",
    "model_type": "must be a table",
    "string_pattern_mismatch": "must be letters, digits, _ and - only",
    "string_type": "must be a string",
    "too_long": "must have {max_length} values",
    "too_short": "must have {min_length} values",
}


def check(data: Mapping[str, Any]) -> tuple[SceneTables | None, list[str]]:
    """Check a scene as it stands in a file.

    Parameters
    ----------
    data
        What TOML or JSON gives.

    Returns
    -------
    model
        The scene; None if its shape is wrong.
    faults
        A line for each fault.
    """
    model, wrong, faults = None, set[Path](), []
    try:
        model = SceneModel.model_validate(data)
    except ValidationError as error:
        for fault in error.errors(include_url=False):
            wrong.add(fault["loc"])
            faults.append(_describe(fault["loc"], fault))
    structs = {}
    for section in STRUCTS:
        structs[section], found = _build(section, data, wrong)
        faults += found
    items = list(_sound_items(data, wrong))
    if not items and not any(path[0] in ("blocks", "balls") for path in wrong):
        faults.append("blocks: missing, there is no fluid without [[blocks]] or [[balls]]")
    faults += geometry_faults(items, _sound_domain(data, wrong), structs["fluid"])
    faults += _file_faults(data)
    return model, faults


def path_text(path: Path) -> str:
    """Path as one writes it: ``("blocks", 0, "upper")`` is ``blocks[0].upper``."""
    text = "".join(f"[{key}]" if isinstance(key, int) else f".{key}" for key in path)
    return text.removeprefix(".")


def _describe(path: Path, fault: Any) -> str:
    kind, where = fault["type"], path_text(path)
    if kind == "extra_forbidden":
        return f"{where}: unknown, {_suggestion(path)}"
    if kind == "missing":
        return f"{where}: missing"
    rule = _RULES.get(kind, fault["msg"]).format(**fault.get("ctx", {}))
    return f"{where} = {json.dumps(fault['input'], default=str)}: {rule}"


def _suggestion(path: Path) -> str:
    """Say what an unknown key was meant to be: the name most like it, here or in a section."""
    key, parents = str(path[-1]), [part for part in path[:-1] if isinstance(part, str)]
    known = _keys_of(parents)
    owners = {name: section for section in STRUCTS for name in _keys_of([section])}
    if not (close := difflib.get_close_matches(key, [*known, *owners], n=1)):
        return "known here are " + ", ".join(known)
    where = "" if close[0] in known else f" in [{owners[close[0]]}]"
    return f'did you mean "{close[0]}"{where}?'


def _keys_of(parents: list[str]) -> list[str]:
    """Names that a table of the file may hold."""
    table = TABLES[parents[-1]] if parents else SceneModel
    return [field.alias or name for name, field in table.model_fields.items()]


def _build(section: str, data: Mapping[str, Any], wrong: set[Path]) -> tuple[Any, list[str]]:
    """Let the struct check those of its values that have the right type."""
    given = data.get(section, {})
    if not isinstance(given, Mapping):
        return None, []
    sound = {key: given[key] for key in given if not _is_wrong((section, key), wrong)}
    table = TABLES[section].model_validate(sound)
    values = for_struct(section, table.model_dump(exclude_unset=True))
    try:
        return STRUCTS[section](**values), []
    except (InvalidParameter, WrongType) as error:  # a whole number may be too large for an int
        owner = STRUCTS[section].__name__
        faults = str(error).splitlines()
        return None, [line.replace(f"{owner}.", f"{section}.", 1) for line in faults]


def _is_wrong(path: Path, wrong: set[Path]) -> bool:
    """Whether the value at a path, or one inside it, has a fault."""
    return any(bad[: len(path)] == path for bad in wrong)


def _sound_items(data: Mapping[str, Any], wrong: set[Path]) -> Iterator[tuple[str, Block | Ball]]:
    kinds: dict[str, type[Block] | type[Ball]] = {"blocks": Block, "balls": Ball}
    for kind, model in kinds.items():
        if (kind,) not in wrong:
            for k, item in enumerate(data.get(kind, [])):
                if not _is_wrong((kind, k), wrong):
                    yield f"{kind}[{k}]", model.model_validate(item)


def _file_faults(data: Mapping[str, Any]) -> Iterator[str]:
    """Look whether the files are there that the scene names."""
    for path, file in files_of(data):
        if not os.path.isfile(file):  # noqa: PTH113 - no name, however odd, makes this raise
            yield f"{path_text(path)} = {json.dumps(file)}: there is no such file"


def _sound_domain(data: Mapping[str, Any], wrong: set[Path]) -> Domain | None:
    if data.get("domain") is None or _is_wrong(("domain",), wrong):
        return None
    return Domain.model_validate(data["domain"])
