"""`conformance soak`: millions of random queries, in shards, for hours, and what they have found."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

from conformance import exit_codes
from conformance.commands.options import UsageError, add_candidate_option, check_candidate, check_jobs
from conformance.option_types import positive, whole_from

if TYPE_CHECKING:
    import argparse

    from conformance.soak.campaign import Campaign, Plan
    from conformance.soak.crews import Crew
    from conformance.soak.journal import SoakJournal
    from conformance.soak.records import Identity
    from conformance.soak.tally import Tally

HELP: Final = "ask a candidate random queries by the million, for hours, and shrink what fails to cases"
EXAMPLES: Final = (
    "conformance soak --queries 1e5 --jobs 2",
    'conformance soak --queries 1e7 --jobs 8 --candidate "cmd:./my-engine" -o soak-1',
    'conformance soak --queries 1e7 --jobs 8 --candidate "cmd:./my-engine" -o soak-1 --resume',
    "conformance soak --queries 1e7 --scheduler tcp://10.0.0.1:8786",
    "conformance soak --queries 1e9 --minutes 30 --seed 7 --family worlds -o nightly",
)
_METHOD: Final = """\
A query is drawn from the campaign's seed, the number of its shard and its number there: it is the same
whoever asks it, in whatever order. Shards that were asked are in the journal; --resume goes on with the
others, with more queries too. A journal of another seed, suite or candidate is refused.

A failure of a new kind (operation, first output that differs, in what way) is shrunk and written to
FOLDER/found as a case; others of its kind are counted. Ctrl-C keeps what there is.

Exit codes: 0 all that was compared agrees, 1 something differs, 2 usage, 3 the candidate is broken, 4 nothing
was compared, 5 a result could not be written, 130 Ctrl-C, or the scheduler is gone.
"""
_SHARD_SIZE: Final = 1000
"""Queries: some seconds of work, which is what Ctrl-C loses."""
_JOURNAL: Final = "journal.jsonl"
_FOUND: Final = "found"
_SUMMARY: Final = "summary.json"
_MINUTE: Final = 60.0
_PLAIN_SECONDS: Final = 60.0
"""Between two lines of progress where there is no terminal to show it on."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    options = parser.add_argument_group("what is asked", _METHOD)
    options.add_argument(
        "--queries",
        type=whole_from(1),
        required=True,
        metavar="N",
        help="how many, such as 1e7; rounded up to whole shards",
    )
    options.add_argument("--seed", type=int, default=0, metavar="S", help="of the draws (default: 0)")
    options.add_argument(
        "--family", action="append", default=[], metavar="NAME", help="only these queries (repeatable)"
    )
    options.add_argument(
        "--shard-size",
        type=whole_from(1),
        default=_SHARD_SIZE,
        metavar="N",
        help="queries (default: %(default)s)",
    )
    add_candidate_option(parser, default="engine")
    options.add_argument(
        "--candidate-digest",
        metavar="TEXT",
        help="what changes whenever the candidate does, such as the id of its build (default: a digest "
        "of the files that --candidate names)",
    )
    options.add_argument(
        "-o",
        "--output",
        type=Path,
        default=Path("soak"),
        metavar="FOLDER",
        help="for the journal and what was found (default: %(default)s)",
    )
    options.add_argument(
        "--journal", type=Path, metavar="FILE", help=f"another journal than FOLDER/{_JOURNAL}"
    )
    options.add_argument("--resume", action="store_true", help="go on with what the journal holds")
    workers = parser.add_argument_group("who asks")
    workers.add_argument("--jobs", type=whole_from(1), metavar="N", help="processes (default: 1)")
    workers.add_argument(
        "--scheduler",
        metavar="tcp://HOST:PORT",
        help="of a Dask cluster, whose workers ask instead (extra `cluster`)",
    )
    workers.add_argument(
        "--minutes", type=positive("minutes"), metavar="M", help="begin no further shard after this time"
    )


def run(args: argparse.Namespace) -> int:
    """Run the campaign, print what came of it and return the exit code."""
    from conformance.console import Progress, make_console
    from conformance.files import write_text
    from conformance.report.soak import lines, summary
    from conformance.soak.campaign import Campaign

    identity = _identity(args)
    plan, journal = _plan(args, identity), _journal(args, identity)
    crew = _crew(args)
    with journal, Progress(plain_seconds=_PLAIN_SECONDS) as progress:
        campaign = Campaign(plan, crew, journal, progress.say)
        ending = _run(campaign)
    code = _exit_code(journal.tally, ending.code)
    console = make_console()
    for line in lines(journal.tally, campaign, plan, identity):
        console.print(line)
    if ending.said:
        console.print(ending.said, style="red")
    if journal.tally.queries < plan.shards * plan.shard_size:
        console.print(f"journal: {journal.path}; the same command with --resume goes on")
    write_text(args.output / _SUMMARY, summary(journal.tally, identity, code))
    return code


class _Ending(NamedTuple):
    """How a run of a campaign has ended."""

    code: int = exit_codes.OK
    said: str = ""


def _run(campaign: Campaign) -> _Ending:
    """Run a campaign; whatever ends it early, what it has found so far is shown."""
    from conformance.candidates.registry import BadCandidateError
    from conformance.soak.campaign import NoAnswersError, WorkerLostError
    from conformance.soak.cluster import ClusterError
    from conformance.soak.shard import SilentCandidateError
    from conformance.soak.tally import UnlikeShardError
    from conformance.soak.workshop import OtherInstallationError

    try:
        campaign.run()
    except KeyboardInterrupt:
        return _Ending(exit_codes.BROKEN_OFF, "broken off")
    except (NoAnswersError, SilentCandidateError, UnlikeShardError, WorkerLostError) as error:
        return _Ending(exit_codes.BROKEN, f"given up: {error}")
    except (BadCandidateError, OtherInstallationError) as error:
        return _Ending(exit_codes.USAGE, str(error))
    except ClusterError as error:
        return _Ending(exit_codes.BROKEN_OFF, str(error))
    except OSError as error:
        return _Ending(exit_codes.CANNOT_WRITE, f"could not be written: {error}")
    return _Ending()


def _exit_code(tally: Tally, ended: int) -> int:
    """Return how the command ends: what is known of the candidate counts more than what ended the run."""
    known = tally.exit_code
    return known if not ended or known in {exit_codes.FAILURES, exit_codes.BROKEN} else ended


def _identity(args: argparse.Namespace) -> Identity:
    from conformance.soak.families import STRATEGIES, mix_of
    from conformance.soak.identity import identity_of

    check_candidate(args)
    try:
        families = mix_of(args.family).names
    except KeyError as error:
        raise UsageError(f"no family {error}; there are {', '.join(STRATEGIES)}") from error
    return identity_of(
        args.candidate, args.candidate_digest, seed=args.seed, shard_size=args.shard_size, families=families
    )


def _plan(args: argparse.Namespace, identity: Identity) -> Plan:
    from conformance.soak.campaign import Plan
    from conformance.soak.workshop import Work

    return Plan(
        queries=args.queries,
        shard_size=args.shard_size,
        work=Work(identity.model_dump_json(), args.candidate_digest, args.read_timeout),
        found=args.output / _FOUND,
        seconds=math.inf if args.minutes is None else _MINUTE * args.minutes,
    )


def _journal(args: argparse.Namespace, identity: Identity) -> SoakJournal:
    from conformance.journal import JournalError
    from conformance.soak.journal import SoakJournal

    path = args.journal or args.output / _JOURNAL
    try:
        return SoakJournal(path, identity, resume=args.resume)
    except FileExistsError as error:
        raise UsageError(f"{error}: --resume goes on with it, another -o begins another") from error
    except JournalError as error:
        raise UsageError(str(error)) from error
    except OSError as error:
        raise UsageError(f"cannot read {path}: {error.strerror}") from error


def _crew(args: argparse.Namespace) -> Crew:
    from conformance.soak.cluster import Cluster, ClusterError
    from conformance.soak.crews import Alone, Processes

    if args.scheduler is None:
        check_jobs(args.jobs or 1)
        return Alone() if args.jobs in {None, 1} else Processes(args.jobs)
    if args.jobs is not None:
        raise UsageError("--jobs is about processes here: how many a cluster has, its workers say")
    try:
        return Cluster(args.scheduler)
    except ClusterError as error:
        raise UsageError(str(error)) from error
