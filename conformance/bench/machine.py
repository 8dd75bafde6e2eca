"""What a run was made with: the machine, and the versions of everything that counts."""

from __future__ import annotations

import os
import platform
from importlib import metadata
from pathlib import Path
from typing import Any, Final

DISTRIBUTIONS: Final = (
    "retail-conformance",
    "numba",
    "llvmlite",
    "numpy",
    "python-flint",
    "python-fcl",
    "coal",
    "trimesh",
    "matplotlib",
)
_CPU_INFO: Final = Path("/proc/cpuinfo")
"""Where Linux names the processor; elsewhere `platform` does."""


def machine() -> dict[str, Any]:
    """Return the kind of machine."""
    return {
        "processor": processor_name(),
        "architecture": platform.machine(),
        "cores": os.cpu_count() or 1,
        "system": f"{platform.system()} {platform.release()}",
    }


def processor_name() -> str:
    """Return the processor's name, or what the system knows instead."""
    if _CPU_INFO.is_file():
        for line in _CPU_INFO.read_text(encoding="utf-8", errors="replace").splitlines():
            if line.startswith("model name"):
                return line.partition(":")[2].strip()
    return platform.processor() or platform.machine()


def versions() -> dict[str, str]:
    """Return the versions of Python and of every distribution that is installed."""
    found = {"python": platform.python_version()}
    for name in DISTRIBUTIONS:
        try:
            found[name] = metadata.version(name)
        except metadata.PackageNotFoundError:
            continue
    return found
