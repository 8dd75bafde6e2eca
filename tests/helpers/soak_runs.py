"""Help for tests of campaigns: small ones, of calls that take no time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from conformance.soak.campaign import Campaign, Plan
from conformance.soak.crews import Alone
from conformance.soak.identity import identity_of
from conformance.soak.journal import SoakJournal
from conformance.soak.kinds import FailureKind
from conformance.soak.records import Failures, ShardResult
from conformance.soak.workshop import Work

if TYPE_CHECKING:
    from pathlib import Path

    from conformance.soak.crews import Crew
    from conformance.soak.records import Identity
    from conformance.soak.tally import Tally

FAMILY = "single calls"
SHARD_SIZE = 20
QUERIES = 60
SEED = 7
KIND = FailureKind("walk", "x", "another value")


def engine(name: str) -> str:
    """Return one of the engines of `soak_engines` as ``--candidate`` takes it."""
    return f"mod:soak_engines:{name}"


def identity(candidate: str) -> Identity:
    """Return the identity of a small campaign."""
    return identity_of(candidate, None, seed=SEED, shard_size=SHARD_SIZE, families=[FAMILY])


def plan(folder: Path, candidate: str, queries: int = QUERIES, *, seconds: float = 1e9) -> Plan:
    """Return the plan of a small campaign."""
    work = Work(identity(candidate).model_dump_json(), None, None)
    return Plan(queries, SHARD_SIZE, work, folder / "found", seconds)


def shard_result(shard: int, **changes: Any) -> ShardResult:
    """Return what may have come of a shard of ten queries, two of which fail."""
    failures = [Failures(**KIND._asdict(), count=2, query=shard + 1, said=f"x in {shard}")]
    known = {
        "shard": shard,
        "agreed": 7,
        "differed": 2,
        "errored": 0,
        "skipped": {"engine: no": 1},
        "asked": {"worlds": 10},
        "failures": failures,
        "complaints": [],
        "answers": "a",
        "seconds": 0.5,
    }
    return ShardResult(**{**known, **changes})


def run(
    folder: Path,
    candidate: str,
    queries: int = QUERIES,
    *,
    crew: Crew | None = None,
    resume: bool = False,
    said: list[str] | None = None,
) -> Tally:
    """Run a small campaign in a folder and return what it has come to."""
    journal = SoakJournal(folder / "journal.jsonl", identity(candidate), resume=resume)
    say = [].append if said is None else said.append
    with journal:
        Campaign(plan(folder, candidate, queries), crew or Alone(), journal, say).run()
    return journal.tally
