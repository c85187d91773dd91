"""A module for each case."""

from __future__ import annotations
