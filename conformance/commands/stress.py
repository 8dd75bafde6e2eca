"""`conformance stress`: where float32 gives way, and whether the candidate gives way as retail does."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from conformance import exit_codes
from conformance.commands.options import UsageError, add_candidate_option, candidate_from, check_jobs
from conformance.workers import one_for_each_core

if TYPE_CHECKING:
    import argparse

    from rich.console import Console

    from conformance.stress.budgets import Budget
    from conformance.stress.findings import Findings
    from conformance.stress.runner import Plan
    from conformance.stress.settings import Settings

HELP: Final = (
    "push questions towards where float32 gives way: far out, nearly degenerate, at thresholds, for long"
)
EXAMPLES: Final = (
    "conformance stress --quick",
    "conformance stress --family translation --family scale --plots plots",
    "conformance stress --json stress.json --worst worst-cases",
    "conformance stress --quick --candidate single",
)
_METHOD: Final = """\
Each family is a set of sweeps. At every severity the oracle (retail), the same with single and with double
precision, and the candidate are asked the same queries and held against exact arithmetic (extra `exact`). The
candidate is also held against retail, bit for bit, and against its error budget. Ctrl-C keeps what there is.

Exit codes: 0 all is within the budget, 1 it is not, 2 usage, 3 the candidate has not answered everything,
but what it did is within the budget, 4 it was asked nothing, or skipped all of it, 5 a file cannot be
written, 130 Ctrl-C.
"""
_PIPED_WIDTH: Final = 200
"""Columns of the tables where no terminal says how wide it is."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the command's arguments."""
    options = parser.add_argument_group("what is asked", _METHOD)
    options.add_argument(
        "--family",
        action="append",
        default=[],
        metavar="NAME",
        help="translation, rotation, thresholds, degenerate, drift or scale alone (repeatable)",
    )
    options.add_argument("--quick", action="store_true", help="less of everything: under a minute")
    options.add_argument("--seed", type=int, metavar="N", help="of the random moves (default: a fixed one)")
    options.add_argument(
        "--jobs",
        type=int,
        default=one_for_each_core(),
        metavar="N",
        help="processes at once (default: one for each core, %(default)s)",
    )
    add_candidate_option(parser, default="engine")
    options.add_argument(
        "--budget",
        type=Path,
        metavar="FILE",
        help="the candidate's error budget (default: the suite's for it; else it must be retail bit for bit)",
    )
    options.add_argument("--json", type=Path, metavar="FILE", help="also write everything as JSON")
    options.add_argument("--plots", type=Path, metavar="DIR", help="also draw it (extra `bench`)")
    options.add_argument(
        "--comparisons",
        type=Path,
        metavar="FILE",
        help="ask nothing; write the list of retail's comparisons with their squares as a Markdown page",
    )
    options.add_argument(
        "--worst", type=Path, metavar="DIR", help="write the worst query of each sweep as a case"
    )


def run(args: argparse.Namespace) -> int:
    """Ask, print, and return the exit code; what cannot be written is an `OSError`."""
    from conformance.console import make_console
    from conformance.stress.findings import Findings

    if args.comparisons is not None:
        return _list_comparisons(args.comparisons)
    plan, budget = _plan(args), _budget(args)
    _check_plots(args)
    console = make_console()
    if not console.is_terminal:
        console.width = _PIPED_WIDTH
    findings = Findings()
    whole = _ask(plan, findings)
    _check_budget(budget, findings, whole=whole and not args.quick)
    _show(console, findings, args)
    _write(args, findings, plan, console)
    if findings.failures:
        return exit_codes.FAILURES
    if not whole:
        return exit_codes.BROKEN_OFF
    if findings.errors:
        return exit_codes.BROKEN
    return exit_codes.OK if findings.has_answered() else exit_codes.NOTHING_RAN


def _list_comparisons(file: Path) -> int:
    from conformance.files import write_text
    from conformance.stress.comparisons.page import page

    write_text(file, page())
    return exit_codes.OK


def _plan(args: argparse.Namespace) -> Plan:
    from conformance.candidates.registry import MissingExtraError, check_extra

    candidate_from(args)
    try:
        check_extra("exact")
    except MissingExtraError as error:
        raise UsageError(str(error)) from error
    from conformance.stress.families import FAMILIES
    from conformance.stress.models import Spec
    from conformance.stress.runner import Plan

    for name in args.family:
        if name not in FAMILIES:
            raise UsageError(f"no family {name!r}; there are {', '.join(FAMILIES)}")
    check_jobs(args.jobs)
    families = tuple(name for name in FAMILIES if not args.family or name in args.family)
    return Plan(_settings(args), families, Spec(args.candidate, args.read_timeout), args.jobs)


def _settings(args: argparse.Namespace) -> Settings:
    from conformance.stress.settings import DEFAULT_SEED, full, quick

    seed = DEFAULT_SEED if args.seed is None else args.seed
    if seed < 0:
        raise UsageError(f"a seed is not negative: {seed}")
    return quick(seed) if args.quick else full(seed)


def _budget(args: argparse.Namespace) -> Budget:
    from conformance.stress.budgets import BudgetError, find_budget, read_budget
    from conformance.yaml_source import YamlError

    try:
        return find_budget(args.candidate) if args.budget is None else read_budget(args.budget)
    except OSError as error:
        raise UsageError(f"cannot read {args.budget}: {error}") from error
    except (BudgetError, YamlError) as error:
        raise UsageError(f"not a budget:\n{error}") from error


def _check_plots(args: argparse.Namespace) -> None:
    """Find out before a long run that nothing can be drawn after it."""
    from conformance.bench.plots import NoPlotsError, import_matplotlib

    if args.plots is None:
        return
    try:
        import_matplotlib()
    except NoPlotsError as error:
        raise UsageError(str(error)) from error


def _ask(plan: Plan, findings: Findings) -> bool:
    """Run everything; tell whether it was not broken off."""
    from conformance.console import Progress
    from conformance.stress.runner import run_plan

    try:
        with Progress() as progress:
            run_plan(plan, findings, progress.say)
    except KeyboardInterrupt:
        findings.notes.append("the run was broken off: what follows is what there was until then")
        return False
    return True


def _check_budget(budget: Budget, findings: Findings, *, whole: bool) -> None:
    from conformance.stress.budgets import broken_bounds

    findings.failures += [f"budget: {text}" for text in broken_bounds(budget, findings, whole=whole)]


def _show(console: Console, findings: Findings, args: argparse.Namespace) -> None:
    from conformance.stress.tables import show

    show(console, findings, args.candidate)


def _write(args: argparse.Namespace, findings: Findings, plan: Plan, console: Console) -> None:
    from conformance.files import write_text
    from conformance.stress.plots import write_plots
    from conformance.stress.worst import write_worst

    if args.json is not None:
        write_text(args.json, findings.to_json(_facts(args, plan)))
    if args.worst is not None:
        for path in write_worst(args.worst, findings.worst_of_sweeps()):
            console.print(f"kept: {path}")
    if args.plots is not None:
        for path in write_plots(findings, plan, args.plots):
            console.print(f"drawn: {path}")


def _facts(args: argparse.Namespace, plan: Plan) -> dict[str, Any]:
    """Return what a run was, for its JSON."""
    return {
        "candidate": plan.candidate.name,
        "seed": plan.settings.seed,
        "quick": bool(args.quick),
        "families": list(plan.families),
    }
