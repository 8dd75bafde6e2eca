"""The lines of a campaign's journal: what is asked, what came of each shard, which failures were kept."""

from __future__ import annotations

from typing import Annotated, Final

from pydantic import BaseModel, ConfigDict, Field, Strict

from conformance.soak.kinds import FailureKind

FORMAT: Final = 1
"""The version of the journal; another one cannot be gone on with."""

_Count = Annotated[int, Strict(), Field(ge=0)]


class _Line(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


class Identity(_Line):
    """The first line: what makes a campaign the same campaign.

    Attributes
    ----------
    soak : int
        `FORMAT`.
    suite, candidate_digest : str
        Digests of retail, of what draws and compares, and of the candidate; the last may be empty.
    candidate : str
        As ``--candidate`` takes it.
    seed, shard_size : int
        Of the draws, and queries of a shard.
    families : list of str
        What is drawn from.
    """

    soak: _Count
    suite: str
    candidate: str
    candidate_digest: str
    seed: Annotated[int, Strict()]
    shard_size: Annotated[int, Strict(), Field(ge=1)]
    families: list[str]


class Failures(_Line):
    """The failures of one kind in a shard.

    Attributes
    ----------
    op, field, cause : str
        The kind.
    count : int
        How many there are.
    query : int
        The number of the first.
    said : str
        What is wrong with it.
    """

    op: str
    field: str
    cause: str
    count: _Count
    query: _Count
    said: str

    @property
    def kind(self) -> FailureKind:
        """What they have in common."""
        return FailureKind(self.op, self.field, self.cause)


class ShardResult(_Line):
    """What came of a shard.

    Attributes
    ----------
    shard : int
        Its number, from 0.
    agreed, differed, errored : int
        Queries that ended so.
    skipped : Mapping of str to int
        Queries that somebody does not do, by who and why.
    asked : Mapping of str to int
        Queries by family.
    failures : list of Failures
        In the order in which they came first.
    complaints : list of str
        What was wrong with how the candidate stopped.
    answers : str
        Digest of all of retail's answers: the same shard asked again has the same.
    seconds : float
        How long it took.
    """

    shard: _Count
    agreed: _Count
    differed: _Count
    errored: _Count
    skipped: dict[str, _Count]
    asked: dict[str, _Count]
    failures: list[Failures]
    complaints: list[str]
    answers: str
    seconds: float

    @property
    def queries(self) -> int:
        """How many queries it has asked."""
        return self.agreed + self.differed + self.errored + sum(self.skipped.values())


class Kept(_Line):
    """A failure that was kept as a case.

    Attributes
    ----------
    op, field, cause : str
        Its kind.
    shard, query : int
        Where it was found.
    file : str
        Name of the case's file in the folder of found cases.
    alone : bool
        Whether it shows when the case is asked by itself.
    """

    op: str
    field: str
    cause: str
    shard: _Count
    query: _Count
    file: str
    alone: Annotated[bool, Strict()]

    @property
    def kind(self) -> FailureKind:
        """What it is one of."""
        return FailureKind(self.op, self.field, self.cause)
