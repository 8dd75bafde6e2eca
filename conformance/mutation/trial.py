"""Asking a mutant what the suite asks, until it gives itself away."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import TYPE_CHECKING, Final

from conformance.bug_hunt import first_difference
from conformance.candidates.oracle_candidate import OracleCandidate
from conformance.mutation.planting import Seed
from conformance.mutation.reach import ask
from conformance.mutation.watchdog import OutOfTimeError, Watchdog
from conformance.query import Result

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from conformance.mutation.asking import Question
    from conformance.mutation.mutant import Mutant
    from conformance.mutation.operators import Plan
    from conformance.mutation.reach import Reach
    from conformance.query import Outcome

LEAST_BUDGET: Final = 2.0
"""Processor time that any answer may take, seconds."""
PATIENCE: Final = 30.0
"""How many times as long as retail a mutant may take."""
TIMED_OUT: Final = "no answer in time"


class Verdict(Enum):
    """What became of a mutant."""

    CASE = "noticed by a case"
    POSE = "noticed by a random pose"
    SURVIVED = "not noticed"
    UNREACHED = "never run"


@dataclass(frozen=True, slots=True)
class Finding:
    """A mutant's verdict, and what it rests on.

    Attributes
    ----------
    mutant : Mutant
        The mutant.
    verdict : Verdict
        What became of it.
    by : str
        The question that noticed it.
    output : str
        The first output that differs there.
    asked : int
        How many questions it was asked.
    """

    mutant: Mutant
    verdict: Verdict
    by: str = ""
    output: str = ""
    asked: int = 0

    @property
    def killed(self) -> bool:
        """Whether the suite notices it."""
        return self.verdict in {Verdict.CASE, Verdict.POSE}


class Trial:
    """Retail's answers, which every mutant's are compared with.

    Parameters
    ----------
    questions : sequence of Question
        What is asked.
    reached : Mapping of str to Reach
        What retail's answers need, by the question's name; without an entry it is not asked.
    """

    def __init__(self, questions: Sequence[Question], reached: Mapping[str, Reach]) -> None:
        self._oracle = OracleCandidate()
        self._watchdog = Watchdog()
        self._reached = reached
        # Cases first, so that what they notice does not depend on what is drawn at random; then the quickest.
        answered = [question for question in questions if question.name in reached]
        self._questions = sorted(answered, key=lambda q: (q.pose, reached[q.name].seconds))
        self._by_name = {question.name: question for question in self._questions}
        self._truths: dict[str, tuple[Outcome, str]] = {}

    def judge(self, plan: Plan, hint: str = "") -> Finding:
        """Ask a mutant every question whose answer needs its lines, until an answer differs.

        Parameters
        ----------
        plan : Plan
            The mutant.
        hint : str
            Name of the question to ask first: what noticed it the last time.
        """
        mutant, seed = plan.mutant, Seed(plan)
        lines = {(mutant.file, line) for line in mutant.reach}
        reaching = [q for q in self._questions if not lines.isdisjoint(self._reached[q.name].lines)]
        first = [self._by_name[hint]] if hint in self._by_name else []
        for asked, question in enumerate((*first, *reaching), start=1):
            output = self._differs(seed, question)
            if output:
                verdict = Verdict.POSE if question.pose else Verdict.CASE
                return Finding(mutant, verdict, question.name, output, asked)
        return Finding(mutant, Verdict.SURVIVED if reaching else Verdict.UNREACHED, asked=len(reaching))

    def _differs(self, seed: Seed, question: Question) -> str:
        """Return the first output in which a mutant differs from retail, empty if none."""
        truth, text = self._truth(question)
        budget = LEAST_BUDGET + PATIENCE * self._reached[question.name].seconds
        try:
            with self._watchdog.limit(budget), seed.planted():
                given = ask(self._oracle, question.query)
        except OutOfTimeError:
            return TIMED_OUT
        if isinstance(given, Result) and repr(given.fields) == text:
            return ""
        return first_difference(question.query, truth, given)

    def _truth(self, question: Question) -> tuple[Outcome, str]:
        """Return retail's answer, and the same as text: equal texts are equal answers."""
        if question.name not in self._truths:
            outcome = ask(self._oracle, question.query)
            text = repr(outcome.fields) if isinstance(outcome, Result) else ""
            self._truths[question.name] = outcome, text
        return self._truths[question.name]
