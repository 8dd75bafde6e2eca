"""The pytest plug-in, run as a user runs it."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from conformance import items, plugin, profiles
from conformance.query import Query, Skipped

if TYPE_CHECKING:
    from collections.abc import Sequence

    from conformance.candidates.base import Candidate

pytest_plugins = ["pytester"]

IMPORTED = profiles
"""A run within this process forgets what it imports; half of hypothesis cannot be imported a second time."""
ROOT = Path(__file__).parents[2]
BUILT_IN = ROOT / "conformance" / "cases"
ORIGIN = BUILT_IN / "contact-plane" / "origin.yaml"
GOOD = """\
id: {id}
title: The identity
why: To be run.
retail: [Frame::cache §4.2]
query: {{op: frame_cache, rotation: [1, 0, 0, 0]}}
expect: {{m: [1, 0, 0, 0, 1, 0, 0, 0, 1]}}
"""
CONFTEST = "from conformance.conftest import pytest_addoption\n"
OFF_BY_A_METRE = """\
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.query import Result


def moved(value):
    if isinstance(value, dict):
        return {key: moved(inner) for key, inner in value.items()}
    if isinstance(value, (list, tuple)):
        return [moved(inner) for inner in value]
    return value + 1.0 if isinstance(value, float) else value


class Engine:
    def __init__(self):
        self._oracle = OracleCandidate()

    def answer(self, query):
        outcome = self._oracle.answer(query)
        return Result(moved(outcome.fields)) if isinstance(outcome, Result) else outcome
"""


@pytest.fixture
def run(pytester: pytest.Pytester, monkeypatch: pytest.MonkeyPatch) -> pytest.Pytester:
    """Return a project of its own that can use the plug-in."""
    monkeypatch.setenv("PYTHONPATH", str(ROOT))
    monkeypatch.setenv("CI", "1")  # pytest does not shorten the summary there
    pytester.makeconftest(CONFTEST)
    return pytester


def case_file(project: pytest.Pytester, name: str, text: str) -> Path:
    """Write a case file into the project."""
    path = project.path / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


def test_cases_of_a_folder(run: pytest.Pytester) -> None:
    """Each case is an item; the counts are told."""
    case_file(run, "mine/a.yaml", GOOD.format(id="one"))
    case_file(run, "mine/b.yml", GOOD.format(id="two"))
    result = run.runpytest_inprocess("--cases", "mine", "--candidate", "oracle", "-v")
    result.assert_outcomes(passed=2)
    result.stdout.fnmatch_lines(
        [
            "mine/a.yaml::one PASSED*",
            "mine/b.yml::two PASSED*",
            "conformance: 2 cases, 2 queries compared, 0 skipped, 0 random queries, candidate oracle",
        ]
    )


class NeverCandidate:
    """Skips whatever it is asked."""

    name = "never"

    def answer(self, query: Query) -> Skipped:
        """Skip."""
        return Skipped(f"no {query.op}")


def test_a_failure_shows_who_wrote_what(run: pytest.Pytester) -> None:
    """Retail's writes and the bug's, the first that differ marked; only of the topics that are asked for."""
    options = ("--cases", str(ORIGIN), "--candidate", "bug:cell-origin", "-k", "origin-step-down-touching")
    plane = "[[]cp-write] ContactPlane: n=(0,0,0) D=0.000 -> n=(0,0,1)"
    call = "    [[]bsp] Call: D -> ADJUSTED caller=outside"
    result = run.runpytest_inprocess(*options)
    result.stdout.fnmatch_lines(
        [
            "  writes (cp-write):",
            "    [[]cp-write] ContactPlaneValid: 0 -> 1 caller=step_sphere_down",
            f"  > retail: {plane} D=-94.000 caller=step_sphere_down",
            f"  > bug:cell-origin: {plane} D=-0.000 caller=step_sphere_down",
            "  scene: *",
        ]
    )
    result.stdout.no_fnmatch_line(call)
    result = run.runpytest_inprocess(*options, "--trace-writes", "bsp,walkable")
    result.stdout.fnmatch_lines(["  writes (bsp, walkable):", call, "    both write the same"])
    result.stdout.fnmatch_lines(["  rerun: * --trace-writes bsp,walkable*"])


def test_an_unknown_topic_is_a_usage_error(run: pytest.Pytester) -> None:
    """Before anything is run."""
    result = run.runpytest_inprocess("--cases", str(ORIGIN), "--trace-writes", "cp-wrte")
    assert result.ret == pytest.ExitCode.USAGE_ERROR
    result.stderr.fnmatch_lines(["*--trace-writes: unknown topic 'cp-wrte'. Did you mean 'cp-write'?*"])


def test_the_bug_that_this_suite_began_with(run: pytest.Pytester) -> None:
    """Red, and one line says that the plane's D is 0 where retail has -94."""
    result = run.runpytest_inprocess("--cases", str(ORIGIN), "--candidate", "bug:cell-origin")
    assert result.ret == pytest.ExitCode.TESTS_FAILED
    reason = "contact_plane.d: retail -94.0 (0xC2BC0000), bug:cell-origin -0.0 (0x80000000), 1.1e9 ULPs"
    result.stdout.fnmatch_lines(
        [
            "*contact_plane.d *-94.0 (0xC2BC0000)*-0.0 (0x80000000)*",
            "*rerun: pytest *origin.yaml::origin-step-down-touching --candidate bug:cell-origin",
            "*retail: *BSPTREE::step_sphere_down SD-1…SD-12*",
            "*| *- id: origin-step-down-touching",
            f"origin-step-down-touching: {reason}",
            f"FAILED *::origin-step-down-touching - {reason}",
        ]
    )


def test_an_engine_that_is_wrong_everywhere_is_told_case_by_case(run: pytest.Pytester) -> None:
    """Whatever a case spells out or leaves out, its failure is told, and the run goes on to the next."""
    run.makepyfile(off_by_a_metre=OFF_BY_A_METRE)
    candidate = "mod:off_by_a_metre:Engine"
    result = run.runpytest_subprocess("--cases", str(BUILT_IN), "--candidate", candidate, "--poses", "0")
    assert result.ret == pytest.ExitCode.TESTS_FAILED
    assert result.parseoutcomes()["failed"] > 1000
    result.stdout.no_fnmatch_line("*INTERNALERROR*")
    result.stdout.fnmatch_lines(["*scene: world_transition; world world with 1 landblock, 1 object;*"])


@pytest.mark.parametrize("asked", [("--cases", str(ORIGIN)), (f"{ORIGIN}::origin-step-down-touching",)])
def test_a_failure_on_a_terminal_of_few_characters(
    run: pytest.Pytester, monkeypatch: pytest.MonkeyPatch, asked: Sequence[str]
) -> None:
    """What it cannot show is a question mark; lines stay lines, also where one case is run again."""
    monkeypatch.setenv("PYTHONIOENCODING", "ascii")
    result = run.runpytest_subprocess(*asked, "--candidate", "bug:cell-origin")
    result.stdout.fnmatch_lines(["  contact_plane.d *-94.0*", "  retail: *SD-1?SD-12*"])


def test_the_same_over_workers(run: pytest.Pytester) -> None:
    """With pytest-xdist the ids, results, reasons and counts are those of one process."""
    pytest.importorskip("xdist")
    args = ["--cases", str(ORIGIN), "--candidate", "bug:cell-origin", "-p", "no:randomly"]
    alone = run.runpytest_subprocess(*args)
    spread = run.runpytest_subprocess(*args, "-n", "2")
    assert alone.ret == spread.ret == pytest.ExitCode.TESTS_FAILED

    def told(result: pytest.RunResult) -> list[str]:
        return [line for line in result.outlines if line.startswith(("conformance:", "origin-", "FAILED"))]

    assert len(told(alone)) >= 3
    assert told(spread) == told(alone)


def test_a_mistyped_folder_is_an_error(run: pytest.Pytester) -> None:
    """Not green, not silent."""
    run.makepyfile("def test_passes(): pass")
    result = run.runpytest_inprocess("--cases", "mistyped")
    assert result.ret == pytest.ExitCode.USAGE_ERROR
    result.stderr.fnmatch_lines(["*--cases mistyped: there is no such folder or file*"])


def test_an_empty_folder_is_an_error(run: pytest.Pytester) -> None:
    """A folder without case files is as bad as none."""
    run.mkdir("empty")
    run.makepyfile("def test_passes(): pass")
    result = run.runpytest_inprocess("--cases", "empty")
    assert result.ret == pytest.ExitCode.USAGE_ERROR


def test_a_folder_of_files_without_cases_is_red(run: pytest.Pytester) -> None:
    """An empty file, an empty list of cases: each fails."""
    case_file(run, "mine/a.yaml", "")
    case_file(run, "mine/b.yaml", "cases: []\n")
    result = run.runpytest_inprocess("--cases", "mine")
    result.assert_outcomes(failed=2)


def test_a_suite_without_cases_is_red(run: pytest.Pytester, monkeypatch: pytest.MonkeyPatch) -> None:
    """Even if other tests pass."""
    monkeypatch.setattr(plugin, "BUILT_IN_CASES", run.mkdir("cases"))
    run.makepyfile("def test_passes(): pass")
    result = run.runpytest_inprocess("--candidate", "oracle")
    result.assert_outcomes(passed=1)
    assert result.ret == pytest.ExitCode.NO_TESTS_COLLECTED
    result.stdout.fnmatch_lines(["conformance: no case was found"])


def test_a_run_that_compares_nothing_is_red(run: pytest.Pytester, monkeypatch: pytest.MonkeyPatch) -> None:
    """A candidate that skips every query is not conformant."""
    monkeypatch.setattr("conformance.items.make_candidate", lambda _spec, **_options: NeverCandidate())
    result = run.runpytest_inprocess("--cases", str(ORIGIN))
    result.assert_outcomes(skipped=2)
    assert result.ret == pytest.ExitCode.NO_TESTS_COLLECTED
    result.stdout.fnmatch_lines(["conformance: nothing was compared"])


@pytest.mark.parametrize(
    "part",
    [
        "conformance/cases/contact-plane",
        "conformance/cases/contact-plane/origin.yaml",
        "conformance/cases/contact-plane/origin.yaml::origin-step-down-touching",
        "conformance/test_laws.py",
    ],
)
def test_a_part_that_compares_nothing_is_red(
    run: pytest.Pytester, monkeypatch: pytest.MonkeyPatch, part: str
) -> None:
    """A folder of the suite, a file, a case, or its laws: whatever was asked for, all of it was skipped."""
    monkeypatch.setattr("conformance.items.make_candidate", lambda _spec, **_options: NeverCandidate())
    result = run.runpytest_inprocess(part)
    assert result.parseoutcomes().keys() == {"skipped"}
    assert result.ret == pytest.ExitCode.NO_TESTS_COLLECTED
    result.stdout.fnmatch_lines(["conformance: nothing was compared"])


def test_what_failed_last_is_run_alone(run: pytest.Pytester) -> None:
    """Then no case may be among it; what is mended is green."""
    path = run.makepyfile("def test_fails(): assert False")
    args = "--cases", str(ORIGIN), str(path), "-p", "cacheprovider", "--candidate", "oracle"
    assert run.runpytest_subprocess(*args).ret == pytest.ExitCode.TESTS_FAILED
    path.write_text("def test_fails(): pass", encoding="utf-8")
    result = run.runpytest_subprocess(*args, "--lf")
    result.assert_outcomes(passed=1)
    assert result.ret == pytest.ExitCode.OK


@pytest.mark.parametrize("option", ["--cache-show", "--fixtures", "--collect-only"])
def test_who_only_looks_is_told_nothing(run: pytest.Pytester, option: str) -> None:
    """Nothing was to be compared."""
    result = run.runpytest_subprocess("--cases", str(ORIGIN), option)
    assert result.ret == pytest.ExitCode.OK
    result.stdout.no_fnmatch_line("conformance: no*")


def test_an_unknown_candidate_is_an_error(run: pytest.Pytester) -> None:
    """With the nearest name."""
    result = run.runpytest_inprocess("--candidate", "orakle")
    assert result.ret == pytest.ExitCode.USAGE_ERROR
    result.stderr.fnmatch_lines(["*unknown candidate 'orakle'*Did you mean 'oracle'?*"])


def test_other_yaml_is_left_alone(run: pytest.Pytester) -> None:
    """A user's own files are not ours to read."""
    case_file(run, "compose.yaml", "services: {}\n")
    run.makepyfile("def test_passes(): pass")
    result = run.runpytest_inprocess()
    result.assert_outcomes(passed=1)
    assert not [line for line in result.outlines if line.startswith(("conformance:", "=== conformance"))]


def test_a_file_is_run_by_its_name(run: pytest.Pytester) -> None:
    """Or one case of it; and nothing besides: neither the suite's cases nor found ones, nor neighbours."""
    several = "cases:\n" + "".join(
        "  - " + GOOD.format(id=name).replace("\n", "\n    ").rstrip() + "\n" for name in ("one", "two")
    )
    case_file(run, "mine/a.yaml", several)
    case_file(run, "mine/b.yaml", GOOD.format(id="three"))
    case_file(run, ".conformance/found/found-1.yaml", GOOD.format(id="found"))
    path = str(Path("mine", "a.yaml"))
    whole = run.runpytest_inprocess(path, "--candidate", "oracle", "-v")
    whole.assert_outcomes(passed=2)
    whole.stdout.fnmatch_lines(["conformance: 2 cases, 2 queries compared*"])
    one = run.runpytest_inprocess(f"{run.path / path}::two", "--candidate", "oracle", "-v")
    one.assert_outcomes(passed=1)
    one.stdout.fnmatch_lines(["mine/a.yaml::two PASSED*"])


def test_a_file_is_run_besides_what_else_is_asked_for(run: pytest.Pytester) -> None:
    """Tests, other files, and a folder of cases, in which it may be, too."""
    run.makepyfile("def test_passes(): pass")
    for name, folder in (("one", "mine"), ("two", "mine"), ("three", "other")):
        case_file(run, f"{folder}/{name}.yaml", GOOD.format(id=name))
    options = "--cases", "mine", "--candidate", "oracle"
    run.runpytest_inprocess("other/three.yaml", *options).assert_outcomes(passed=3)
    run.runpytest_inprocess("mine/one.yaml", *options).assert_outcomes(passed=2)
    run.runpytest_inprocess(".", "other/three.yaml", *options[2:]).assert_outcomes(passed=2)


def test_the_suite_is_run_where_it_is_not(run: pytest.Pytester) -> None:
    """As documents and messages name it; a folder of that name would come first."""
    origin = "conformance/cases/contact-plane/origin.yaml"
    result = run.runpytest_inprocess(f"{origin}::origin-step-down-touching", "--candidate", "oracle")
    result.assert_outcomes(passed=1)
    run.runpytest_inprocess("--cases", origin, "--candidate", "oracle", "--co").stdout.fnmatch_lines(
        ["*origin-step-down-touching*"]
    )
    run.mkdir("conformance")
    result = run.runpytest_inprocess(origin)
    assert result.ret == pytest.ExitCode.USAGE_ERROR


def test_what_is_wrong_with_a_named_file_is_told(run: pytest.Pytester) -> None:
    """It is one of cases if it has a single key of a case; a file that can't be parsed is, too."""
    case_file(run, "typo.yaml", GOOD.format(id="one").replace("query:", "querry:"))
    case_file(run, "colon.yaml", "\ufeffid: one\ntitle: a: b\n")
    result = run.runpytest_inprocess("typo.yaml", "colon.yaml", "--candidate", "oracle")
    result.assert_outcomes(failed=2)
    result.stdout.fnmatch_lines(["*typo.yaml:*: querry", "*did you mean 'query'*", "*colon.yaml:2:*"])


def test_a_named_file_of_another_kind_is_left_alone(run: pytest.Pytester) -> None:
    """Another plug-in may know it; pytest says if none does."""
    case_file(run, "compose.yaml", "services: {}\n")
    result = run.runpytest_inprocess("compose.yaml")
    assert result.ret == pytest.ExitCode.USAGE_ERROR
    result.stderr.fnmatch_lines(["ERROR: *compose.yaml*"])


def test_a_folder_of_cases_names_the_option(run: pytest.Pytester) -> None:
    """Where nothing is run; a run of the project's own tests says nothing of it."""
    case_file(run, "mine/a.yaml", GOOD.format(id="one"))
    case_file(run, "theirs/compose.yaml", "services: {}\n")
    result = run.runpytest_inprocess("mine", "theirs")
    assert result.ret == pytest.ExitCode.NO_TESTS_COLLECTED
    result.stdout.fnmatch_lines(["conformance: mine holds cases; to run them: --cases mine"])
    result.stdout.no_fnmatch_line("*theirs holds cases*")
    result = run.runpytest_inprocess()
    assert result.ret == pytest.ExitCode.NO_TESTS_COLLECTED
    result.stdout.no_fnmatch_line("*holds cases*")


def test_a_broken_case_fails_and_the_others_run(run: pytest.Pytester) -> None:
    """It fails with every mistake, located; its neighbours are run."""
    text = "cases:\n" + "".join(
        "  - " + GOOD.format(id=name).replace("\n", "\n    ").rstrip() + "\n" for name in ("one", "two")
    )
    text = text.replace("title: The identity\n    why: To be run.", "titel: x\n    why: ''", 1)
    case_file(run, "mine/a.yaml", text)
    result = run.runpytest_inprocess("--cases", "mine", "--candidate", "oracle", "-v")
    result.assert_outcomes(passed=1, failed=1)
    result.stdout.fnmatch_lines(
        [
            "mine/a.yaml::one FAILED*",
            "mine/a.yaml::two PASSED*",
            "*mine*a.yaml:3:5: cases[[]0[]].titel",
            "*the unknown key 'titel'",
            "*did you mean 'title'[?]",
            "*mine*a.yaml:4:10: cases[[]0[]].why",
            "FAILED mine/a.yaml::one - *no 'title'*(and 2 more)",
        ]
    )
    again = run.runpytest_inprocess("mine/a.yaml::one", "--candidate", "oracle")
    again.assert_outcomes(failed=1)
    again.stdout.fnmatch_lines(["*the unknown key 'titel'"])


@pytest.mark.skipif(sys.platform == "win32", reason="Windows asks for a right to make links")
def test_a_link_is_a_file_of_its_folder(run: pytest.Pytester) -> None:
    """Wherever it leads to."""
    case_file(run, "elsewhere/a.yaml", GOOD.format(id="one"))
    run.mkdir("mine")
    (run.path / "mine" / "linked.yaml").symlink_to(run.path / "elsewhere" / "a.yaml")
    run.runpytest_inprocess("--cases", "mine", "--candidate", "oracle").assert_outcomes(passed=1)


def test_the_same_id_in_two_files_is_red(run: pytest.Pytester) -> None:
    """The first stays, the second fails and names both places."""
    case_file(run, "mine/a.yaml", GOOD.format(id="one"))
    case_file(run, "mine/b.yaml", GOOD.format(id="one"))
    result = run.runpytest_inprocess("--cases", "mine", "--candidate", "oracle")
    result.assert_outcomes(passed=1, failed=1)
    result.stdout.fnmatch_lines(["FAILED *b.yaml:1:1: id: found the id 'one' again (first at *a.yaml:1:1)*"])


class Half:
    """A candidate that skips everything."""

    name = "half"

    def answer(self, query: Query) -> Skipped:
        """Skip."""
        return Skipped(f"needs {query.op}")


def test_a_case_of_which_all_was_skipped_is_skipped(
    run: pytest.Pytester, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The reason and the line of the case are told, and counted."""
    make = items.make_candidate

    def half(spec: str, **_options: object) -> Candidate:
        return Half() if spec == "engine" else make(spec)

    monkeypatch.setattr(items, "make_candidate", half)
    case_file(run, "mine/a.yaml", "# first line\n" + GOOD.format(id="one"))
    result = run.runpytest_inprocess("--cases", "mine", "-rs")
    result.assert_outcomes(skipped=1)
    result.stdout.fnmatch_lines(
        [
            "conformance: 1 cases, 0 queries compared, 1 skipped (half: needs frame_cache: 1)*",
            "SKIPPED [[]1[]] mine?a.yaml:2: half: needs frame_cache",
        ]
    )


def test_found_cases_are_replayed_first(run: pytest.Pytester) -> None:
    """What a random run has found comes before the cases that are asked for, and can be rerun alone."""
    case_file(run, ".conformance/found/found-1.yaml", GOOD.format(id="found-1"))
    case_file(run, "mine/a.yaml", GOOD.format(id="one"))
    result = run.runpytest_inprocess("--cases", "mine", "--candidate", "oracle", "-v")
    result.assert_outcomes(passed=2)
    result.stdout.fnmatch_lines([".conformance/found/found-1.yaml::found-1 PASSED*", "*::one PASSED*"])
    node = ".conformance/found/found-1.yaml::found-1"
    run.runpytest_inprocess(node, "--candidate", "oracle").assert_outcomes(passed=1)


def test_options_change_the_poses(run: pytest.Pytester) -> None:
    """`--poses` sets how often a scene case is run, and is part of the rerun command."""
    args = ["--cases", str(ORIGIN), "--poses", "3", "--pose-seed", "7"]
    result = run.runpytest_inprocess(*args, "--candidate", "oracle")
    result.stdout.fnmatch_lines(["conformance: 2 cases, 8 queries compared*"])
    result = run.runpytest_inprocess(*args, "--candidate", "bug:cell-origin")
    result.stdout.fnmatch_lines(["*--candidate bug:cell-origin --poses 3 --pose-seed 7"])


def test_a_file_that_no_name_tells_to_be_one_of_cases_is_run_again(run: pytest.Pytester) -> None:
    """All in braces, it is known by `--cases` alone, which the command says."""
    case = "{id: one, title: x, why: x, retail: [Frame::cache §4.2], "
    case += "query: {op: frame_cache, rotation: [1, 0, 0, 0]}, expect: {m: [2, 0, 0, 0, 1, 0, 0, 0, 1]}}\n"
    case_file(run, "mine/a.yaml", case)
    result = run.runpytest_inprocess("--cases", "mine", "--candidate", "oracle")
    (line,) = [line for line in result.outlines if "rerun: pytest " in line]
    again = run.runpytest_inprocess(*line.partition("rerun: pytest ")[2].split())
    assert again.parseoutcomes()["failed"] == 1


def test_a_case_can_be_selected(run: pytest.Pytester) -> None:
    """By id, by tag, by op, by marker."""
    for selection in (["-k", "origin-step-down-short"], ["-k", "cell-pose"], ["-m", "conformance"]):
        result = run.runpytest_inprocess("--cases", str(ORIGIN), "--candidate", "oracle", *selection)
        assert result.ret == pytest.ExitCode.OK
        assert result.parseoutcomes()["passed"] >= 1


def test_the_fixtures_of_the_plug_in(run: pytest.Pytester, monkeypatch: pytest.MonkeyPatch) -> None:
    """Random tests get the candidate, the oracle and the folder of real cells."""
    monkeypatch.delenv(plugin.FIXTURES_VARIABLE, raising=False)
    run.makepyfile(
        """
        def test_names(candidate, oracle):
            assert (candidate.name, oracle.name) == ("bug:cell-origin", "oracle")

        def test_cells(fixtures_dir):
            assert fixtures_dir.is_dir()
        """
    )
    result = run.runpytest_inprocess("--candidate", "bug:cell-origin", "-rs")
    result.assert_outcomes(passed=1, skipped=1)
    result.stdout.fnmatch_lines(["SKIPPED*fixtures absent"])
    result = run.runpytest_inprocess("--candidate", "bug:cell-origin", "--retail-fixtures", ".")
    result.assert_outcomes(passed=2)


def test_the_plug_in_loads_nothing_heavy(run: pytest.Pytester) -> None:
    """It is imported in every pytest run of the environment."""
    heavy = ["numpy", "numba", "pydantic", "hypothesis", "yaml", "engine", "oracle"]
    done = run.runpython_c(f"import sys, conformance.plugin; print([m for m in {heavy} if m in sys.modules])")
    assert done.outlines == ["[]"]
