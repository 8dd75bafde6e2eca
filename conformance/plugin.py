"""The pytest plug-in: YAML cases become tests, compared with retail field by field.

It is loaded in every pytest run of an environment that has the package, so it imports little, collects
only what is meant for it, and adds nothing to a run that has no cases.
"""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import pytest

from conformance.case_folders import CASE_SUFFIXES, yaml_files
from conformance.installed import installed
from conformance.option_types import positive, whole_from
from conformance.summary import Counts

if TYPE_CHECKING:
    from conformance.candidates.base import Candidate

BUILT_IN_CASES: Final = Path(__file__).parent / "cases"
_CASE_KEYS: Final = re.compile(rb"^(?:\xef\xbb\xbf)?(?:cases|id|query|retail)[ \t]*:", re.MULTILINE)
"""What a file of cases has and other YAML hardly: a case's keys, or that of a list of cases."""
FIXTURES_VARIABLE: Final = "RETAIL_FIXTURES"
DEFAULT_CANDIDATE: Final = "engine"

_FOLDERS: Final = pytest.StashKey["tuple[Path, ...]"]()
_GIVEN: Final = pytest.StashKey["list[Path]"]()
_EXPECTS_CASES: Final = pytest.StashKey[bool]()
_ASKS_FOR_ALL: Final = pytest.StashKey[bool]()
_RUNS: Final = pytest.StashKey[bool]()
_COLLECTED: Final = pytest.StashKey[int]()
_TALLY: Final = pytest.StashKey["Tally"]()
_COMPLAINTS: Final = pytest.StashKey["list[str]"]()
_WORKER_OUTPUT: Final = "conformance_collected"
_WORKER_COMPLAINTS: Final = "conformance_complaints"
CANDIDATES: Final = pytest.StashKey["dict[str, Candidate]"]()
"""Every candidate that was made in a run, by its name."""


class Tally:
    """Adds up what the tests' reports say, those of pytest-xdist workers included."""

    def __init__(self) -> None:
        self.counts = Counts()

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Count what a test has compared."""
        if report.when == "call":
            self.counts.add(report.user_properties)


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the options of the suite."""
    group = parser.getgroup("conformance", "retail conformance")
    group.addoption(
        "--candidate",
        default=DEFAULT_CANDIDATE,
        metavar="SPEC",
        help='what is compared with retail: engine, oracle, bug:NAME, "cmd:./my-engine --flag", '
        "mod:package.module:factory (default: %(default)s)",
    )
    group.addoption(
        "--read-timeout",
        type=positive("seconds"),
        metavar="SECONDS",
        help="within which a cmd: engine must reply, or be started anew (default: 30)",
    )
    group.addoption(
        "--cases",
        action="append",
        default=[],
        metavar="DIR",
        help="run the cases of this folder or file instead of the built-in ones (repeatable)",
    )
    group.addoption(
        "--retail-fixtures",
        metavar="DIR",
        help=f"folder of real cells, for the tests that use them (default: ${FIXTURES_VARIABLE})",
    )
    group.addoption(
        "--deviations",
        metavar="FILE",
        help="how the candidate is known to differ from retail: a file, or the name of an engine that the "
        "suite knows (default: the candidate's own, if it has one)",
    )
    group.addoption(
        "--poses", type=whole_from(0), metavar="N", help="random poses in which to run each scene case"
    )
    group.addoption("--pose-seed", type=int, metavar="N", help="seed of the random poses")
    group.addoption(
        "--trace-writes",
        metavar="TOPICS",
        help="what a failure shows of who wrote what, comma-separated: cp-write, lkp-write, walkable, "
        "sliding, state, cell-transit, bsp (default: cp-write)",
    )


def pytest_configure(config: pytest.Config) -> None:
    """Decide which folders hold cases, and see that a run of the suite visits them."""
    config.addinivalue_line("markers", "conformance: a YAML case, compared with retail")
    config.args[:] = map(_installed, config.args)
    given = [_case_path(text) for text in config.getoption("--cases", [])]
    _check_candidate(config)
    _check_topics(config)
    _check_deviations(config)
    config.stash[_RUNS] = False
    config.stash[_COLLECTED] = 0
    config.stash[_COMPLAINTS] = []
    config.stash[_TALLY] = Tally()
    config.pluginmanager.register(config.stash[_TALLY], "conformance-tally")
    folders = given or [BUILT_IN_CASES]
    named = [path for path in _named_files(config) if not any(map(path.is_relative_to, folders))]
    asks_for_all = bool(given) or _covers(config, BUILT_IN_CASES)
    config.stash[_EXPECTS_CASES] = asks_for_all or bool(named) or _asks_for_part(config)
    if config.stash[_EXPECTS_CASES]:
        # Where the terminal lacks one character pytest would escape a failure whole, line ends included.
        from conformance.console import tolerate_unprintable

        tolerate_unprintable()
    found = _found_cases(config) if asks_for_all else []
    config.stash[_FOLDERS], config.stash[_GIVEN] = (*folders, *named), given
    config.stash[_ASKS_FOR_ALL] = asks_for_all
    config.args[:] = [
        *(str(path) for path in found if not _covers(config, path)),
        *config.args,
        *(str(path) for path in given if not _covers(config, path)),
    ]


def _installed(arg: str) -> str:
    """Return an argument of pytest; one that names the suite where it is not means what is installed."""
    path, *rest = arg.split("::")
    return (
        "::".join((str(installed(Path(path))), *rest)) if path.startswith(Path(__file__).parent.name) else arg
    )


def _case_path(text: str) -> Path:
    path = installed(Path(text)).resolve()
    if not path.exists():
        raise pytest.UsageError(f"--cases {text}: there is no such folder or file")
    if path.is_dir() and not yaml_files(path):
        raise pytest.UsageError(f"--cases {text}: there is no *.yaml file in it")
    return path


def _named_files(config: pytest.Config) -> list[Path]:
    """List the case files that the run asks for one by one, wherever they are."""
    return sorted(path for path in _asked(config) if path.suffix in CASE_SUFFIXES and has_cases(path))


def _asked(config: pytest.Config) -> set[Path]:
    """Return the places that the run asks for: the files of single tests, too."""
    return {Path(arg.partition("::")[0]).resolve() for arg in config.args}


def has_cases(path: Path) -> bool:
    """Tell whether a file is meant to hold cases, whatever is wrong with them: not all YAML is ours."""
    try:
        return bool(_CASE_KEYS.search(path.read_bytes()))
    except OSError:  # pytest says what is wrong with an argument
        return False


def _case_folders(config: pytest.Config) -> list[str]:
    """List the folders that the run asks for in vain: with cases, but no tests."""
    if config.args_source is not config.ArgsSource.ARGS:
        return []
    folders = [arg for arg in config.args if Path(arg).is_dir()]
    return [arg for arg in folders if any(map(has_cases, yaml_files(Path(arg))))]


def _check_candidate(config: pytest.Config) -> None:
    """Refuse an unknown candidate at once; the default is loaded only when a test needs it."""
    spec = config.getoption("--candidate", DEFAULT_CANDIDATE)
    if spec != DEFAULT_CANDIDATE:
        from conformance.candidates.registry import CANDIDATE_ERRORS, check_spec

        try:
            check_spec(spec)
        except CANDIDATE_ERRORS as error:
            raise pytest.UsageError(f"--candidate: {error}") from error


def _check_topics(config: pytest.Config) -> None:
    text = config.getoption("--trace-writes", None)
    if text is not None:
        from conformance.traced import TopicsError, parse_topics

        try:
            parse_topics(text)
        except TopicsError as error:
            raise pytest.UsageError(f"--trace-writes: {error}") from error


def _check_deviations(config: pytest.Config) -> None:
    """Refuse a deviation file with mistakes at once; the default is read only when a case is run."""
    if config.getoption("--deviations", None) is not None:
        from conformance.deviations.known import BadDeviationsError, deviations_of

        try:
            deviations_of(config)
        except BadDeviationsError as error:
            raise pytest.UsageError(f"--deviations: {error}") from error


def _covers(config: pytest.Config, place: Path) -> bool:
    """Tell whether the run is asked to visit a place: it, or a folder above it, is an argument."""
    asked = [Path(arg).resolve() for arg in config.args if "::" not in arg]
    return any(place.resolve().is_relative_to(path) for path in asked)


def _asks_for_part(config: pytest.Config) -> bool:
    """Tell whether the run is asked for some of the suite's own cases: a folder, a file, or one case."""
    return any(path.is_relative_to(BUILT_IN_CASES) for path in _asked(config))


def _found_folder(config: pytest.Config) -> Path:
    from conformance.found import found_cases_dir

    return found_cases_dir(config.rootpath).resolve()


def _found_cases(config: pytest.Config) -> list[Path]:
    """List the cases that earlier random runs have found, which are replayed first."""
    folder = _found_folder(config)
    return sorted(path.resolve() for path in yaml_files(folder)) if folder.is_dir() else []


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    """Collect YAML files, but only those of the case folders, and those that are asked for by name."""
    if file_path.suffix not in CASE_SUFFIXES:
        return None
    # A link counts where it is, and where it leads to.
    places = file_path.resolve(), file_path.parent.resolve() / file_path.name
    folders = (*parent.config.stash[_FOLDERS], _found_folder(parent.config))
    if not any(place.is_relative_to(folder) for place in places for folder in folders):
        return None
    from conformance.items import YamlFile

    return YamlFile.from_parent(parent, path=file_path)


@pytest.hookimpl(tryfirst=True)
def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Let a run enter the folders that it is given, and that of found cases, which is hidden."""
    wanted = config.stash[_GIVEN]
    if collection_path.name.startswith(".") and config.stash[_EXPECTS_CASES]:
        wanted = [*wanted, _found_folder(config)]
    if not wanted:
        return None
    place = collection_path.resolve()
    return False if any(folder.is_relative_to(place) for folder in wanted) else None


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Count the cases, before anything is deselected, and put the found ones first."""
    cases = [item for item in items if item.get_closest_marker("conformance")]
    config.stash[_COLLECTED] = len(cases)
    if cases:
        found = _found_folder(config)
        items.sort(key=lambda item: not item.path.resolve().is_relative_to(found))
        if config.stash[_ASKS_FOR_ALL]:
            from conformance.deviations.known import unknown_cases

            folders = config.stash[_FOLDERS]
            config.stash[_COMPLAINTS] += unknown_cases(config, cases, folders)


@pytest.hookimpl(tryfirst=True)
def pytest_runtestloop(session: pytest.Session) -> None:
    """Note that tests are run: pytest can also list them, or its fixtures, or what it keeps."""
    session.config.stash[_RUNS] = not session.config.option.collectonly


@pytest.hookimpl(trylast=True)
def pytest_sessionfinish(session: pytest.Session, exitstatus: int) -> None:
    """Turn a run of the suite red that has found no case, or that has compared nothing."""
    config = session.config
    _close_candidates(config)
    output: dict[str, Any] | None = getattr(config, "workeroutput", None)
    if output is not None:
        output[_WORKER_OUTPUT] = config.stash[_COLLECTED]
        output[_WORKER_COMPLAINTS] = config.stash[_COMPLAINTS]
    elif exitstatus in {pytest.ExitCode.OK, pytest.ExitCode.NO_TESTS_COLLECTED} and config.stash[_COMPLAINTS]:
        session.exitstatus = pytest.ExitCode.TESTS_FAILED
    elif exitstatus == pytest.ExitCode.OK and _complaint(config):
        session.exitstatus = pytest.ExitCode.NO_TESTS_COLLECTED


def _close_candidates(config: pytest.Config) -> None:
    """Stop the engines that were started, and keep what was wrong with how they stopped."""
    for spec, made in config.stash.get(CANDIDATES, {}).items():
        from conformance.candidates.base import close

        config.stash[_COMPLAINTS] += [f"{spec}: {complaint}" for complaint in close(made)]


def _complaint(config: pytest.Config) -> str:
    """Say why a run without failures is red all the same, if it is: nothing was there, or all was skipped."""
    if not config.stash[_RUNS]:
        return ""
    # Where only what failed is run again, other files are not even looked at.
    expects_cases = config.stash[_EXPECTS_CASES] and not config.getoption("lf", False)
    counts = config.stash[_TALLY].counts
    if expects_cases and not config.stash[_COLLECTED]:
        return "no case was found"
    compared = counts.queries or counts.random or counts.reasons
    return "nothing was compared" if (expects_cases or counts) and not compared else ""


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node: Any, error: object) -> None:
    """Take over the count of a pytest-xdist worker; every worker collects everything."""
    del error
    output = getattr(node, "workeroutput", {})
    stash = node.config.stash
    stash[_COLLECTED] = max(stash[_COLLECTED], output.get(_WORKER_OUTPUT, 0))
    told = stash[_COMPLAINTS]
    told += [text for text in output.get(_WORKER_COMPLAINTS, ()) if text not in told]


def pytest_terminal_summary(terminalreporter: Any, exitstatus: int, config: pytest.Config) -> None:
    """Say what was compared, what was skipped, and how cases are run that were asked for in vain."""
    counts = config.stash[_TALLY].counts
    if counts or config.stash[_EXPECTS_CASES]:
        terminalreporter.section("conformance")
        for line in counts.lines(config.getoption("--candidate", DEFAULT_CANDIDATE)):
            terminalreporter.write_line(line)
        for stopping in config.stash[_COMPLAINTS]:
            terminalreporter.write_line(f"conformance: {stopping}", red=True)
        if complaint := _complaint(config):
            terminalreporter.write_line(f"conformance: {complaint}", red=True)
    elif exitstatus == pytest.ExitCode.NO_TESTS_COLLECTED:
        for folder in _case_folders(config):
            terminalreporter.write_line(
                f"conformance: {folder} holds cases; to run them: --cases {folder}", red=True
            )


@pytest.fixture(scope="session")
def candidate(pytestconfig: pytest.Config) -> Candidate:
    """Return the candidate that ``--candidate`` names."""
    from conformance.items import candidate_of

    return candidate_of(pytestconfig, pytestconfig.getoption("--candidate", DEFAULT_CANDIDATE))


@pytest.fixture(scope="session")
def oracle(pytestconfig: pytest.Config) -> Candidate:
    """Return the candidate that answers for retail."""
    from conformance.items import candidate_of

    return candidate_of(pytestconfig, "oracle")


@pytest.fixture(scope="session")
def fixtures_dir(pytestconfig: pytest.Config) -> Path:
    """Return the folder of real cells, or skip what needs it."""
    text = pytestconfig.getoption("--retail-fixtures", None) or os.environ.get(FIXTURES_VARIABLE)
    if not text:
        pytest.skip("skipped: fixtures absent")
    path = Path(text)
    if not path.is_dir():
        raise pytest.UsageError(f"--retail-fixtures {text}: there is no such folder")
    return path
