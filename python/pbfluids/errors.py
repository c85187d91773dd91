"""What pbfluids raises on purpose: one base, and under it the builtin one would expect.

A message says field, value, rule and remedy. A call that raises has changed nothing.
"""

from __future__ import annotations

__all__ = [
    "FluidError",
    "GlError",
    "InvalidParameter",
    "MissingExtra",
    "OutOfMemory",
    "RendererUnavailable",
    "SceneError",
    "SimulationFailed",
    "SoftwareRendering",
    "UnstableTimeStep",
    "WrongType",
]


class FluidError(Exception):
    """Base of every error that pbfluids raises."""


class InvalidParameter(FluidError, ValueError):
    """A value, a shape or a file's content breaks a rule."""


class SceneError(InvalidParameter):
    """A scene cannot be had: the message lists every fault with its path inside the scene."""


class WrongType(FluidError, TypeError):
    """An argument has a type or a dtype that cannot be used."""


class SimulationFailed(FluidError, ArithmeticError):
    """A step could not be completed; the state is that of the last complete step."""


class UnstableTimeStep(RuntimeWarning):
    """A warning: the time step is too long for the fluid to stay one."""


class RendererUnavailable(FluidError, OSError):
    """No OpenGL context can be had here; the message lists every attempt and the cure."""


class SoftwareRendering(UserWarning):
    """A warning: the processor draws, unasked: beside a GPU, or as there is no OpenGL."""


class GlError(FluidError, RuntimeError):
    """A shader does not compile, or the driver reports an error."""


class OutOfMemory(FluidError, MemoryError):
    """More memory is needed than there is."""


class MissingExtra(FluidError, ImportError):
    """An optional package is not installed; the message names the extra that brings it."""
