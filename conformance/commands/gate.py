"""`conformance gate`: everything that a release of an engine is held to, with evidence of it."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Final

from conformance import exit_codes
from conformance.commands.options import UsageError, add_candidate_option, candidate_from

if TYPE_CHECKING:
    import argparse

    from rich.console import Console

    from conformance.case import Case
    from conformance.gate.config import Gate
    from conformance.gate.outcome import GateRun, Stage
    from conformance.gate.parties import Parties
    from conformance.gate.speed import Baseline
    from conformance.stress.budgets import Budget

HELP: Final = "hold a candidate to everything that a release is held to, and write the evidence into a folder"
EXAMPLES: Final = (
    "conformance gate --quick",
    'conformance gate --full --config gate.yaml --candidate "cmd:./my-engine" -o evidence',
    "conformance gate --quick --skip-unchanged evidence --candidate engine",
    "conformance gate --stage cases --case 'step-up-*' --candidate bug:scaled-offset",
    "conformance gate --quick --write-baseline baseline.json",
    "conformance gate --quick --baseline baseline.json",
)
_METHOD: Final = """\
Stages: cases (every pinned case), poses (random calls, scenes and worlds), walks (random walks), stress
(numerical stress, extra `exact`), performance (only with a baseline). Each must show something.

Exit codes: 0 pass, 1 disagreement with retail, a budget, a deviation or the baseline, 2 usage, 3 the
candidate is broken (it gave no answer to something, and is right where it gave one), 4 nothing ran in some
stage, 5 the evidence could not be written, 130 Ctrl-C broke it off.
"""
_MOST_SHOWN: Final = 10
"""Failing checks of a stage, and reasons for skipping, that are printed; all are in the evidence."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    options = parser.add_argument_group("what is asked", _METHOD)
    size = options.add_mutually_exclusive_group()
    size.add_argument("--quick", action="store_true", help="less of it: under a minute and a half")
    size.add_argument("--full", action="store_true", help="more of it, nothing skipped: under five minutes")
    options.add_argument("--config", type=Path, metavar="FILE", help="a gate.yaml that changes what is asked")
    add_candidate_option(parser, default="engine")
    options.add_argument(
        "--stage", action="append", default=[], metavar="NAME", help="only this stage (repeatable)"
    )
    options.add_argument(
        "--case",
        action="append",
        default=[],
        metavar="PATTERN",
        help="only cases whose id matches, in which * is anything (repeatable)",
    )
    options.add_argument("--deviations", metavar="FILE", help="how the candidate is known to differ")
    options.add_argument(
        "-o",
        "--output",
        type=Path,
        default=Path("gate-evidence"),
        metavar="DIR",
        help="folder of the evidence (default: %(default)s)",
    )
    options.add_argument(
        "--skip-unchanged",
        type=Path,
        metavar="DIR",
        help="evidence of an earlier gate: cases that passed there are not asked again if neither they nor "
        "the suite nor the candidate has changed",
    )
    options.add_argument(
        "--candidate-digest",
        metavar="TEXT",
        help="what changes whenever the candidate does, such as the id of its build: without it nothing of a "
        "cmd: or mod: candidate is known to be unchanged",
    )
    options.add_argument(
        "--baseline",
        type=Path,
        metavar="FILE",
        help="hold the candidate's speed against what is stored there",
    )
    options.add_argument(
        "--write-baseline", type=Path, metavar="FILE", help="measure the candidate's speed and store it there"
    )


def run(args: argparse.Namespace) -> int:
    """Run the gate, write the evidence, print, and return the exit code."""
    from conformance.console import make_console
    from conformance.files import write_text
    from conformance.gate.evidence import write_evidence
    from conformance.gate.outcome import Stage
    from conformance.gate.pinned import chosen, unknown_deviations

    gate = _gate(args)
    every = _cases(gate)
    cases = chosen(every, gate.only)
    seen = _asked(gate, args)
    baseline, budget = _baseline(seen, gate, cases, args), _budget(seen, gate, args)
    parties = _parties(gate, args)
    seen.checks += unknown_deviations(parties.deviations, every) if Stage.CASES in seen.asked else []
    measured = _run(seen, parties, cases, baseline, budget)
    console = make_console()
    try:
        write_evidence(seen, parties)
        if measured is not None and args.write_baseline is not None:
            write_text(args.write_baseline, measured.to_json())
    finally:  # what minutes have shown is told, wherever it cannot be written
        _show(console, seen, parties.evidence)
    return seen.exit_code


def _gate(args: argparse.Namespace) -> Gate:
    from conformance.gate.config import FULL, QUICK, STANDARD, GateConfigError, read_config
    from conformance.gate.outcome import Stage
    from conformance.yaml_source import YamlError

    if args.full and args.skip_unchanged is not None:
        raise UsageError("--full never skips: leave out --skip-unchanged")
    gate = QUICK if args.quick else FULL if args.full else STANDARD
    try:
        if args.config is not None:
            gate = read_config(args.config, gate)
    except OSError as error:
        raise UsageError(f"cannot read {args.config}: {error.strerror}") from error
    except (GateConfigError, YamlError) as error:
        raise UsageError(f"not a gate's configuration:\n{error}") from error
    if args.baseline is not None:
        gate = replace(gate, baseline=args.baseline, stages=(*gate.stages, Stage.PERFORMANCE))
    return replace(gate, only=tuple(args.case), deviations=args.deviations or gate.deviations)


def _cases(gate: Gate) -> tuple[Case, ...]:
    from conformance.loader import NoCasesError, Vary, load_paths

    poses = gate.case_poses
    vary = Vary(poses=0) if poses is None else Vary(poses.count, poses.seed)
    try:
        loaded = load_paths(gate.cases, vary)
    except NoCasesError as error:
        raise UsageError(str(error)) from error
    if loaded.problems:
        raise UsageError(f"{len(loaded.problems)} cases are wrong: see `conformance lint`")
    return loaded.cases


def _asked(gate: Gate, args: argparse.Namespace) -> GateRun:
    """Return an empty run of the stages that are asked for, with notes on those that cannot be."""
    from conformance.gate.outcome import GateRun, Stage

    run = GateRun(tuple(_stages(gate, args)))
    missing = _missing_extra() if Stage.STRESS in run.asked else ""
    if missing and (Stage.STRESS.value in args.stage or args.config is not None):
        raise UsageError(f"stage stress: {missing}")
    if missing:
        run.leave_out(Stage.STRESS, missing)
    return run


def _missing_extra() -> str:
    """Say what the stage of stress lacks; empty if nothing."""
    from conformance.candidates.registry import MissingExtraError, check_extra

    try:
        check_extra("exact")
    except MissingExtraError as error:
        return str(error)
    return ""


def _stages(gate: Gate, args: argparse.Namespace) -> list[Stage]:
    """Return the stages of the gate, or those of the command line."""
    from conformance.gate.outcome import Stage

    known = [stage.value for stage in Stage]
    for name in args.stage:
        if name not in known:
            raise UsageError(f"no stage {name!r}; there are {', '.join(known)}")
    wanted = {Stage(name) for name in args.stage} or set(gate.stages)
    if args.write_baseline is not None:
        wanted.add(Stage.PERFORMANCE)
    return [stage for stage in Stage if stage in wanted]


def _baseline(run: GateRun, gate: Gate, cases: list[Case], args: argparse.Namespace) -> Baseline | None:
    """Read what the speed is held against, before anything is asked."""
    from conformance.gate.outcome import Stage
    from conformance.gate.speed import BaselineError, queries_digest, read_baseline

    if Stage.PERFORMANCE not in run.asked or args.write_baseline is not None:
        return None
    if gate.baseline is None:
        raise UsageError("stage performance: --baseline is needed; --write-baseline makes one")
    try:
        return read_baseline(gate.baseline, queries_digest(cases))
    except BaselineError as error:
        raise UsageError(str(error)) from error


def _budget(run: GateRun, gate: Gate, args: argparse.Namespace) -> Budget | None:
    """Read what errors under stress are held against, before anything is asked."""
    from conformance.gate.outcome import Stage
    from conformance.yaml_source import YamlError

    if Stage.STRESS not in run.asked:
        return None
    from conformance.stress.budgets import BudgetError, find_budget, read_budget

    try:
        return find_budget(args.candidate) if gate.budget is None else read_budget(gate.budget)
    except OSError as error:
        raise UsageError(f"cannot read {gate.budget}: {error.strerror}") from error
    except (BudgetError, YamlError) as error:
        raise UsageError(f"not a budget:\n{error}") from error


def _parties(gate: Gate, args: argparse.Namespace) -> Parties:
    from conformance.candidates.oracle_candidate import OracleCandidate
    from conformance.deviations.known import BadDeviationsError, load_deviations, today
    from conformance.gate.digests import candidate_digest, suite_digest
    from conformance.gate.evidence import EvidenceError, passed_before
    from conformance.gate.parties import Parties

    try:
        deviations = load_deviations(gate.deviations, args.candidate)
        unchanged = passed_before(args.skip_unchanged) if args.skip_unchanged else frozenset()
    except (BadDeviationsError, EvidenceError) as error:
        raise UsageError(str(error)) from error
    return Parties(
        gate=gate,
        spec=args.candidate,
        read_timeout=args.read_timeout,
        candidate=candidate_from(args),
        oracle=OracleCandidate(),
        deviations=deviations,
        today=today(),
        suite_digest=suite_digest(),
        candidate_digest=candidate_digest(args.candidate, args.candidate_digest),
        unchanged=unchanged,
        evidence=args.output,
    )


def _run(
    run: GateRun,
    parties: Parties,
    cases: list[Case],
    baseline: Baseline | None,
    budget: Budget | None,
) -> Baseline | None:
    from conformance.console import Progress
    from conformance.gate.runner import run_gate

    try:
        with Progress() as progress:
            return run_gate(run, parties, cases, baseline, budget, progress.say)
    except KeyboardInterrupt:
        run.notes.append("the run was broken off: this is what was seen until then")
        return None


def _show(console: Console, run: GateRun, folder: Path) -> None:
    from conformance.gate.outcome import VERDICTS, Stage, Status

    for stage in run.asked:
        counts = run.counts(stage)
        parts = [f"{counts[status]} {status.value}" for status in Status if counts[status]]
        console.print(f"{stage.value}: {', '.join(parts) or 'nothing'}; {counts['compared']} compared")
        why = Counter(check.message for check in run.of(stage) if check.status is Status.SKIPPED)
        for reason, count in why.most_common(_MOST_SHOWN):
            console.print(f"  skipped: {reason}: {count}")
        wrong = [check for check in run.of(stage) if check.status in {Status.FAILED, Status.BROKEN}]
        for check in wrong[:_MOST_SHOWN]:
            console.print(f"  {check.name}: {check.message}", style="red")
        if len(wrong) > _MOST_SHOWN:
            console.print(f"  ... and {len(wrong) - _MOST_SHOWN} more")
        if wrong and stage is Stage.CASES and run.report:
            console.print(f"  every field, the source and the scene: {folder / 'report.html'}")
    for note in run.notes:
        console.print(note, style="yellow")
    for stage in run.empty_stages:
        console.print(f"{stage.value}: nothing was shown", style="yellow")
    code = run.exit_code
    console.print(
        f"gate: {VERDICTS[code]}; evidence: {folder}", style="green" if code == exit_codes.OK else "red"
    )
