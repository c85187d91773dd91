"""Importing is light: no OpenGL, no optional package, nothing linked that is not everywhere."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest
from elftools.elf.elffile import ELFFile

import pbfluids as pbf
from pbfluids import _core

# What a wheel may take for granted or brings along: no OpenGL, EGL or X.
ALLOWED = {"libc", "libm", "libstdc++", "libgcc_s", "libgomp", "libdl", "libpthread", "ld-linux"}


def linked(path):
    with path.open("rb") as stream:
        dynamic = ELFFile(stream).get_section_by_name(".dynamic")
        return [tag.needed for tag in dynamic.iter_tags() if tag.entry.d_tag == "DT_NEEDED"]


def test_the_extension_links_no_opengl():
    libraries = linked(Path(_core.__file__))
    assert "libc.so.6" in libraries
    others = [name for name in libraries if name.split(".so")[0].split("-x86")[0] not in ALLOWED]
    assert not others


def modules_after(outside, code):
    done = outside(f"{code}\nimport sys, json; print(json.dumps(sorted(sys.modules)))")
    assert done.returncode == 0, done.stderr
    return set(json.loads(done.stdout))


def test_importing_loads_nothing_that_is_optional_or_slow(outside):
    loaded = modules_after(outside, "import pbfluids")
    assert "pbfluids._core" in loaded
    assert not loaded & {"av", "PIL", "pydantic", "rich", "typer", "OpenGL", "json.tool"}


def test_scenes_need_no_extra(outside):
    loaded = modules_after(outside, "import pbfluids; pbfluids.Scene.builtin('dam_break')")
    assert "pydantic" in loaded
    assert not loaded & {"av", "PIL", "rich", "typer"}


def test_importing_and_simulating_open_no_opengl(outside):
    code = (
        "import pbfluids as pbf\n"
        "sim = pbf.Simulation()\n"
        "sim.add_particles([[0, 0, 0]])\n"
        "sim.step(0.01)\n"
        "maps = open('/proc/self/maps').read()\n"
        "assert 'libgomp' in maps\n"
        "assert not any(name in maps for name in ('libEGL', 'libGL', 'libX11', 'swrast'))\n"
    )
    done = outside(code)
    assert done.returncode == 0, done.stderr


def test_threads_sleep_while_they_wait_unless_the_user_says_otherwise(outside):
    code = "import os, pbfluids; print(os.environ.get('OMP_WAIT_POLICY'))"
    shown = {"OMP_DISPLAY_ENV": "true", "PATH": "/usr/bin:/bin"}
    default, chosen = outside(code, **shown), outside(code, **shown, OMP_WAIT_POLICY="active")
    assert "OMP_WAIT_POLICY = 'PASSIVE'" in default.stderr
    assert default.stdout == "None\n"  # no trace is left for other programs
    assert "OMP_WAIT_POLICY = 'ACTIVE'" in chosen.stderr
    assert chosen.stdout == "active\n"


@pytest.mark.parametrize("name", sorted(pbf.__all__))
def test_every_public_name_is_there_and_documented(name):
    thing = getattr(pbf, name)
    assert name == "__version__" or thing.__doc__
    assert name in dir(pbf)


def test_an_unknown_name_is_an_attribute_error():
    with pytest.raises(AttributeError, match="no attribute 'nonsense'"):
        _ = pbf.nonsense


def test_the_package_is_typed_and_brings_its_scenes():
    package = Path(_core.__file__).parent
    assert len(list((package / "scenes").glob("*.toml"))) == 4
    assert Path(pbf.__file__).with_name("py.typed").exists()


@pytest.mark.parametrize("command", [["-m", "pbfluids", "--version"]])
def test_the_module_is_the_command(command, tmp_path):
    done = subprocess.run(
        [sys.executable, *command], cwd=tmp_path, capture_output=True, text=True, check=True
    )
    assert done.stdout == f"{pbf.__version__}\n"


def test_errors_are_caught_as_ours_and_as_the_builtin():
    errors = pbf.errors
    for ours, builtin in {
        errors.InvalidParameter: ValueError,
        errors.SceneError: ValueError,
        errors.WrongType: TypeError,
        errors.SimulationFailed: ArithmeticError,
        errors.RendererUnavailable: OSError,
        errors.GlError: RuntimeError,
        errors.OutOfMemory: MemoryError,
        errors.MissingExtra: ImportError,
    }.items():
        assert issubclass(ours, builtin)
        assert issubclass(ours, errors.FluidError)
