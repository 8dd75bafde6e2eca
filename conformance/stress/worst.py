"""The worst query of a severity as a case file that anyone can run."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

import yaml

from conformance.files import write_text
from conformance.found import found_document
from conformance.life.layout import lay_out
from conformance.stress.findings import Worst

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    from conformance.query import Query
    from conformance.stress.sweep import Sweep

WORDS: Final = {
    "contact_metres": "the contact plane's constant is {value:.3g} m off the exact one",
    "position_metres": "the mover ends {value:.3g} m off the exact place",
    "flips": "{value:g} decisions are not those of exact arithmetic",
    "disagreeing": "the decision is not that of exact arithmetic",
}
_WIDTH: Final = 110


def worst_case(sweep: Sweep, severity: float, quantity: str, value: float, query: Query) -> Worst:
    """Return a query as a case; its expected answer is retail's."""
    document = found_document(query, [], candidate="oracle", provenance="conformance stress")
    words = WORDS[quantity].format(value=value)
    document |= {
        "id": _slug(f"stress-{sweep.family}-{sweep.name}-{quantity}"),
        "title": f"Stress, {sweep.family}: {sweep.name} at {severity:g}",
        "why": f"Retail's worst answer in this sweep ({sweep.axis}: {severity:g}): {words}. "
        "A candidate conforms by giving the same answer, not a better one.",
        "tags": ["stress", sweep.family],
    }
    text = yaml.safe_dump(
        document, sort_keys=False, default_flow_style=None, width=_WIDTH, allow_unicode=True
    )
    laid_out = lay_out(text.encode("utf-8"), document["id"])
    return Worst(sweep.family, sweep.name, severity, quantity, value, laid_out)


def write_worst(folder: Path, found: Iterable[Worst]) -> list[Path]:
    """Write cases into a folder, named by family, sweep and quantity; return their paths."""
    paths = []
    for worst in found:
        path = folder / f"{_slug(f'{worst.family}-{worst.sweep}-{worst.quantity}')}.yaml"
        write_text(path, worst.document)
        paths.append(path)
    return paths


def _slug(name: str) -> str:
    """Return a name as a part of a file's name: lower-case words with dashes."""
    return re.sub(r"[^a-z0-9]+", "-", name.lower()).strip("-")
