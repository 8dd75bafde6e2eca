"""What a campaign has come to, for people and for programs."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Final

from conformance.report.text import quoted_spec
from conformance.soak.pace import counts, duration

if TYPE_CHECKING:
    from collections.abc import Iterator

    from conformance.soak.campaign import Campaign, Plan
    from conformance.soak.kinds import FailureKind
    from conformance.soak.records import Identity
    from conformance.soak.tally import Failing, Tally

_MOST_REASONS: Final = 10
"""Reasons for skipping that are shown; all are in the summary."""


def lines(tally: Tally, campaign: Campaign, plan: Plan, identity: Identity) -> Iterator[str]:
    """Say what a campaign has come to, its commonest failures first."""
    candidate = identity.candidate
    yield f"{tally.queries:,} of {plan.shards * plan.shard_size:,} queries: {counts(tally)}"
    yield (
        f"this run: {duration(campaign.pace.seconds)}, {campaign.pace.rate(tally):.0f} queries a second; "
        f"all runs: {duration(tally.seconds)} of work"
    )
    for reason, count in tally.skipped.most_common(_MOST_REASONS):
        yield f"  skipped: {reason}: {count:,}"
    for complaint, count in tally.complaints.most_common():
        yield f"  {candidate} does not stop properly: {complaint}: {count:,} times"
    for kind, failing in sorted(tally.failing.items(), key=lambda item: -item[1].count):
        yield from _failing(kind, failing, plan, candidate)
    if campaign.kinds_left:
        yield f"only counted, because enough others came before: {campaign.kinds_left}; mend those first"
    yield from campaign.notes
    if not identity.candidate_digest:
        yield "a change of the candidate would not be noticed: --candidate-digest says what it is"


def summary(tally: Tally, identity: Identity, code: int) -> str:
    """Write the same as JSON."""
    record = {
        "exit_code": code,
        "campaign": identity.model_dump(),
        "queries": tally.queries,
        "shards": tally.shards,
        "agreed": tally.agreed,
        "differed": tally.differed,
        "errored": tally.errored,
        "skipped": dict(tally.skipped),
        "families": dict(tally.asked),
        "seconds": round(tally.seconds, 1),
        "complaints": dict(tally.complaints),
        "failures": [
            {
                **kind._asdict(),
                "count": failing.count,
                "shard": failing.first.shard,
                "query": failing.first.query,
                "said": failing.said,
                "case": None if failing.kept is None else failing.kept.file,
            }
            for kind, failing in tally.failing.items()
        ],
    }
    return json.dumps(record, indent=1, ensure_ascii=False) + "\n"


def _failing(kind: FailureKind, failing: Failing, plan: Plan, candidate: str) -> Iterator[str]:
    yield f"{failing.count:,} time{'' if failing.count == 1 else 's'} {kind}"
    yield f"  first in shard {failing.first.shard}, query {failing.first.query}: {failing.said}"
    if failing.kept is None:
        yield "  not kept as a case"
    else:
        path = plan.found / failing.kept.file
        yield f'  rerun: pytest "{path}" --candidate {quoted_spec(candidate)}'
        if not failing.kept.alone:
            yield "  asked by itself, of a candidate that was asked nothing before, it does not fail"
