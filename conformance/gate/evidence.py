"""The evidence of a gate: one folder that says what was asked, of whom, on what, and what came of it."""

from __future__ import annotations

import datetime as dt
import hashlib
from typing import TYPE_CHECKING, Any, Final

from conformance import exit_codes
from conformance.bench.machine import machine, versions
from conformance.files import write_text
from conformance.gate.junit import junit_xml
from conformance.gate.outcome import VERDICTS, Stage, Status
from conformance.json_reading import read_json
from conformance.json_writing import json_text

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from conformance.gate.outcome import GateRun
    from conformance.gate.parties import Parties

SUMMARY: Final = "summary.json"
REPORT: Final = "report.html"
SUMS: Final = "SHA256SUMS"
_COLOURS: Final = {
    exit_codes.OK: "brightgreen",
    exit_codes.FAILURES: "red",
    exit_codes.BROKEN: "orange",
}
"""Of the badge; grey where nothing was shown."""
_KEPT: Final = frozenset({Status.PASSED.value, Status.UNCHANGED.value})


class EvidenceError(Exception):
    """A folder that is no evidence of an earlier gate."""


def write_evidence(run: GateRun, parties: Parties) -> None:
    """Write the folder; `SUMS`, the last, is over all of the others and over kept queries.

    Raises
    ------
    OSError
        It cannot be written.
    """
    folder = parties.evidence
    texts = {
        SUMMARY: _json(summary_record(run, parties)),
        "junit.xml": junit_xml(run),
        "environment.json": _json(_environment(parties)),
        "seeds.json": _json(_seeds(parties)),
        "badge.json": _json(badge_record(run)),
        **({REPORT: run.report} if run.report else {}),
    }
    if not run.report:
        (folder / REPORT).unlink(missing_ok=True)  # of an earlier run in the same folder
    for name, text in texts.items():
        write_text(folder / name, text)
    written = [folder / name for name in texts]
    written += _kept_queries(folder, run)
    sums = [f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {_name(path, folder)}" for path in written]
    write_text(folder / SUMS, "\n".join(sums) + "\n")


def summary_record(run: GateRun, parties: Parties) -> dict[str, Any]:
    """Return what a gate came to, for JSON."""
    return {
        "verdict": VERDICTS[run.exit_code],
        "exit_code": run.exit_code,
        "candidate": parties.spec,
        "whole": run.whole,
        "stages": {stage.value: run.counts(stage) for stage in run.asked},
        "empty_stages": [stage.value for stage in run.empty_stages],
        "deviations": len(parties.deviations.entries),
        "notes": run.notes,
        "checks": [check.to_record() for check in run.checks],
    }


def badge_record(run: GateRun) -> dict[str, Any]:
    """Return a badge as shields.io reads it from an address."""
    counts = run.counts(Stage.CASES)
    right = counts[Status.PASSED] + counts[Status.UNCHANGED]
    said = f"{right} cases" if run.exit_code == exit_codes.OK else VERDICTS[run.exit_code]
    recorded = f", {counts[Status.RECORDED]} deviations" if counts[Status.RECORDED] else ""
    return {
        "schemaVersion": 1,
        "label": "retail conformance",
        "message": said + recorded,
        "color": _COLOURS.get(run.exit_code, "lightgrey"),
    }


def passed_before(folder: Path) -> frozenset[str]:
    """Return the digests of what has passed in an earlier gate.

    Raises
    ------
    EvidenceError
        The folder is not one that `write_evidence` has written.
    """
    path = folder / SUMMARY
    try:
        checks = read_json(path.read_text(encoding="utf-8"))["checks"]
        return frozenset(
            check["digest"] for check in checks if check["status"] in _KEPT and check.get("digest")
        )
    except OSError as error:
        raise EvidenceError(f"cannot read {path}: {error.strerror}") from error
    except (ValueError, KeyError, TypeError) as error:
        raise EvidenceError(f"{path}: found no summary of a gate ({error})") from error


def _environment(parties: Parties) -> Mapping[str, Any]:
    return {
        "finished": dt.datetime.now(dt.UTC).isoformat(timespec="seconds"),
        "machine": machine(),
        "versions": versions(),
        "digests": {"suite": parties.suite_digest, "candidate": parties.candidate_digest},
    }


def _seeds(parties: Parties) -> Mapping[str, Any]:
    gate = parties.gate
    draws = {"case_poses": gate.case_poses, "poses": gate.poses, "walks": gate.walks}
    return {
        name: None if draw is None else {"count": draw.count, "seed": draw.seed}
        for name, draw in draws.items()
    }


def _kept_queries(folder: Path, run: GateRun) -> list[Path]:
    """List the cases that this run has kept, not those of an earlier one in the same folder."""
    names = {check.message.rpartition("kept: ")[2] for check in run.checks if "kept: " in check.message}
    return sorted(path for name in names if (path := folder / "found" / name).is_file())


def _name(path: Path, folder: Path) -> str:
    return path.relative_to(folder).as_posix()


def _json(record: Mapping[str, Any]) -> str:
    return json_text(record, indent=1)
