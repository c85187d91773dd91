"""A scene's tables as plain data: taken from Python values, changed, and given back."""

from __future__ import annotations

import copy
from collections.abc import Mapping
from typing import Any

import numpy as np

from pbfluids.errors import SceneError
from pbfluids.scene_model import STRUCTS, TABLES, SceneModel


def plain(value: Any) -> Any:
    """Turn what Python code likes to give, tuples and arrays, into what TOML gives."""
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    return value


def changed(data: Mapping[str, Any], overrides: Mapping[str, Any]) -> dict[str, Any]:
    """Give the data with changes in it, which are named as `Scene.replace` says."""
    result: dict[str, Any] = copy.deepcopy(dict(data))
    for key, value in overrides.items():
        *tables, last = key.split(".")
        if not tables and last not in SceneModel.model_fields:
            owners = [name for name in STRUCTS if last in TABLES[name].model_fields]
            tables = owners if len(owners) == 1 else []
        target = result
        for table in tables:
            inner = target.setdefault(table, {})
            if not isinstance(inner, dict):
                raise SceneError(f"{key}: {table} is no table")
            target = inner
        if isinstance(value, Mapping) and isinstance(target.get(last), dict):
            target[last] = {**target[last], **value}
        else:
            target[last] = value
    return result


def without_absent(value: Any) -> Any:
    """Leave out None and empty lists: TOML has no word for the one and no need for the other."""
    if isinstance(value, dict):
        items = ((key, without_absent(item)) for key, item in value.items())
        return {key: item for key, item in items if item is not None and item != []}
    return [without_absent(item) for item in value] if isinstance(value, list) else value
