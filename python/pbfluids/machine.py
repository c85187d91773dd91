"""What this machine offers."""

from __future__ import annotations

import os
from pathlib import Path

__all__ = ["available_memory"]


def available_memory() -> int:
    """Memory [bytes] that a process may take now, of the machine's or of its container's."""
    available = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    for line in Path("/proc/meminfo").read_text(encoding="ascii").splitlines():
        if line.startswith("MemAvailable:"):
            available = 1024 * int(line.split()[1])
    group = Path("/sys/fs/cgroup")  # version 2; "max" stands for no limit
    try:
        limit = (group / "memory.max").read_text(encoding="ascii").strip()
        used = (group / "memory.current").read_text(encoding="ascii").strip()
    except OSError:
        return available
    return available if limit == "max" else min(available, int(limit) - int(used))
