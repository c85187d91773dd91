"""A scene's tables as plain data: taken from Python values, changed, and given back."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path as FilePath
from typing import Any

import numpy as np

from pbfluids.errors import SceneError
from pbfluids.scene_model import STRUCTS, TABLES, SceneModel

# Where a value is inside a scene.
Path = tuple[str | int, ...]

# Tables and lists inside one another: a scene has four.
_DEEPEST = 32


def plain(value: Any, depth: int = 0) -> Any:
    """Turn what Python code likes to give, tuples and arrays, into what TOML gives, all copied.

    Raises
    ------
    SceneError
        If tables and lists are nested deeper than makes sense, or without an end.
    """
    if depth > _DEEPEST:
        raise SceneError(
            f"tables or lists are nested more than {_DEEPEST} deep; a scene needs no more than 4"
        )
    if isinstance(value, Mapping):
        return {str(key): plain(item, depth + 1) for key, item in value.items()}
    if isinstance(value, FilePath):
        return str(value)
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    if isinstance(value, list | tuple):
        return [plain(item, depth + 1) for item in value]
    return value


def changed(data: Mapping[str, Any], overrides: Mapping[str, Any]) -> dict[str, Any]:
    """Give the data with changes in it, which are named as `Scene.replace` says."""
    result: dict[str, Any] = plain(data)
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


def files_of(data: Mapping[str, Any]) -> Iterator[tuple[Path, str]]:
    """Give the names of files in a scene, sound or not, with their paths inside the scene."""
    meshes, render = data.get("meshes"), data.get("render")
    for k, mesh in enumerate(meshes if isinstance(meshes, list) else []):
        if isinstance(mesh, Mapping) and isinstance(mesh.get("file"), str):
            yield ("meshes", k, "file"), mesh["file"]
    if isinstance(render, Mapping) and isinstance(render.get("environment_map"), str):
        yield ("render", "environment_map"), render["environment_map"]


def located(data: Mapping[str, Any], folder: str | FilePath) -> dict[str, Any]:
    """Give the data with absolute names of files; those that are not are relative to a folder."""
    result: dict[str, Any] = plain(data)
    for (*tables, last), file in files_of(data):
        target: Any = result
        for table in tables:
            target = target[table]
        target[last] = os.path.abspath(os.path.join(folder, file))  # noqa: PTH100, PTH118
    return result


def without_absent(value: Any) -> Any:
    """Leave out None and empty lists: TOML has no word for the one and no need for the other."""
    if isinstance(value, dict):
        items = ((key, without_absent(item)) for key, item in value.items())
        return {key: item for key, item in items if item is not None and item != []}
    return [without_absent(item) for item in value] if isinstance(value, list) else value
