"""Recording who writes contact planes, walkables, sliding normals and state during transitions.

The port knows nothing of it and pays nothing for it: only inside `recording` do its classes get a
`__setattr__` that looks before a field changes. A statement of retail that copies a plane is several
assignments here; they are one write, told when the next one begins or the block ends.
"""

from __future__ import annotations

from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from inspect import currentframe
from typing import TYPE_CHECKING, Any, Final

from oracle.collision_info import CollisionInfo
from oracle.enums import TransitionState
from oracle.obj_cell import ObjCell
from oracle.object_info import ObjectInfo
from oracle.plane import Plane
from oracle.polygon import Polygon
from oracle.retail_frames import OUTSIDE, running, statement_of
from oracle.sphere_path import SpherePath
from oracle.transition import Transition
from oracle.vector import Vector3
from oracle.writes import BSP, FIELDS, TOPICS, BspCall, Field, Write, WriteTrace

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterator
    from types import FrameType

    from oracle.writes import Numbers, Value

_HOOK: Final = "__setattr__"
_WATCHED_CLASSES: Final = (CollisionInfo, SpherePath, ObjectInfo, Plane, Vector3)
_PARTS: Final = ("collision_info", "sphere_path", "object_info")
_LETTERS: Final = "trace"


class UnknownTopicError(LookupError):
    """There is no such topic to trace; `topic` is its name."""

    def __init__(self, topic: str) -> None:
        self.topic = topic
        super().__init__(f"unknown topic {topic!r}; there are: {', '.join(TOPICS)}")


@contextmanager
def recording(transition: Transition | None, topics: Collection[str] = TOPICS) -> Iterator[WriteTrace]:
    """Record what is written inside the block.

    Parameters
    ----------
    transition : Transition or None
        The only transition to watch; None for every one that is made inside the block.
    topics : collection of str
        Which of `TOPICS` to record.

    Yields
    ------
    WriteTrace
        Complete when the block has ended, also when an error has ended it.

    Raises
    ------
    UnknownTopicError
        A topic is none of `TOPICS`.
    """
    for topic in topics:
        if topic not in TOPICS:
            raise UnknownTopicError(topic)
    recorder = _Recorder(frozenset(topics))
    with ExitStack() as stack:
        stack.callback(recorder.finish)
        if transition is None:
            _replace(stack, Transition, recorder.adopting)
        else:
            recorder.adopt(transition)
        for owner in _WATCHED_CLASSES:
            _replace(stack, owner, recorder.watching)
        yield recorder.trace


def _replace(stack: ExitStack, owner: type, make: Callable[[Any], Any]) -> None:
    """Give a class a `__setattr__` until the stack is unwound."""
    if _HOOK in vars(owner):
        stack.callback(setattr, owner, _HOOK, vars(owner)[_HOOK])
    else:
        stack.callback(delattr, owner, _HOOK)
    setattr(owner, _HOOK, make(owner.__setattr__))


@dataclass(slots=True)
class _Watched:
    """A transition, its number, the list that its `trace` was, and the BSP calls that it is in."""

    transition: Transition
    number: int
    letters: list[str] | None = None
    calls: list[BspCall] = field(default_factory=list)


@dataclass(frozen=True, slots=True)
class _Place:
    """What an object is to a transition: a part of it, or the value of a part's attribute."""

    value: object
    part: object
    attribute: str | None
    watched: _Watched


@dataclass(frozen=True, slots=True)
class _Pending:
    """A write that is going on."""

    field: Field
    place: _Place
    attribute: str
    before: Any
    caller: str
    call: BspCall | None
    foot: Numbers | None

    def finished(self) -> Write | None:
        """Return the write as it is now; None if nothing has changed.

        That a mover comes to be in its first cell is no transit.
        """
        after = _snapshot(getattr(self.place.part, self.attribute))
        if _unchanged(self.before, after) or (isinstance(after, ObjCell) and self.before is None):
            return None
        values = _value(self.before), _value(after)
        return Write(*self.field, *values, self.caller, self.place.watched.number, self.call, self.foot)


class _Letters(list[str]):
    """A transition's list of letters and digits, which reports them and passes them on."""

    def __init__(self, recorder: _Recorder, watched: _Watched) -> None:
        super().__init__(watched.letters or ())
        self._recorder = recorder
        self._watched = watched

    def append(self, text: str) -> None:
        """Take a letter or a digit."""
        super().append(text)
        if self._watched.letters is not None:
            self._watched.letters.append(text)
        if text.isdigit():
            self._recorder.close_call(self._watched, TransitionState(int(text)))
        else:
            self._recorder.open_call(self._watched, text)


class _Recorder:
    """Sees every assignment to a watched class, and makes writes of those that change a watched field.

    Places are found by the identity of the object, which stays unique because a place holds it.
    """

    def __init__(self, topics: frozenset[str]) -> None:
        self.trace = WriteTrace()
        self._fields = {name: watched for name, watched in FIELDS.items() if watched.topic in topics}
        self._calls_asked = BSP in topics
        self._watched: dict[int, _Watched] = {}
        self._places: dict[int, _Place] = {}
        self._pending: dict[tuple[int, str], _Pending] = {}
        self._statement: FrameType | None = None

    def adopting(self, set_attribute: Callable[[Any, str, Any], None]) -> Callable[[Any, str, Any], None]:
        """Make the `__setattr__` that watches a transition as its parts are made."""

        def hook(transition: Transition, name: str, value: Any) -> None:
            number = len(self._watched) + 1
            watched = self._watched.setdefault(id(transition), _Watched(transition, number))
            if name == _LETTERS:
                watched.letters = value
                value = _Letters(self, watched)
            set_attribute(transition, name, value)
            if name in _PARTS:
                self._watch_part(watched, value)

        return hook

    def watching(self, set_attribute: Callable[[Any, str, Any], None]) -> Callable[[Any, str, Any], None]:
        """Make the `__setattr__` that notes what a watched field is before it changes."""

        def hook(target: object, name: str, value: Any) -> None:
            place = self._places.get(id(target))
            if place is None:
                set_attribute(target, name, value)
                return
            frame = currentframe()
            if frame is not None:
                self._begin_write(place, name, frame)
            set_attribute(target, name, value)
            self._follow(place, name, value)

        return hook

    def adopt(self, transition: Transition) -> None:
        """Watch a transition that exists already."""
        watched = self._watched[id(transition)] = _Watched(transition, 1, transition.trace)
        transition.trace = _Letters(self, watched)
        for name in _PARTS:
            self._watch_part(watched, getattr(transition, name))

    def finish(self) -> None:
        """Tell the last write, and give every transition its own list of letters back."""
        self._settle()
        for watched in self._watched.values():
            watched.transition.trace = watched.letters

    def open_call(self, watched: _Watched, letter: str) -> None:
        """Take the opening of a BSP call."""
        self._settle()
        frame = currentframe()
        caller = OUTSIDE if frame is None else running(frame)
        call = BspCall(letter, caller, watched.number)
        watched.calls.append(call)
        if self._calls_asked:
            self.trace.entries.append(call)

    def close_call(self, watched: _Watched, result: TransitionState) -> None:
        """Take the result of the innermost BSP call, unless it began before the recording."""
        self._settle()
        if watched.calls:
            watched.calls.pop().result = result.name

    def _watch_part(self, watched: _Watched, part: Any) -> None:
        self._places[id(part)] = place = _Place(part, part, None, watched)
        for name in self._fields:
            if hasattr(part, name):
                self._follow(place, name, getattr(part, name))

    def _follow(self, place: _Place, name: str, value: Any) -> None:
        """Watch a plane or normal, and a plane's normal, that now belongs to a watched field."""
        attribute = place.attribute or name
        if attribute not in self._fields or not isinstance(value, Plane | Vector3):
            return
        self._places[id(value)] = inner = _Place(value, place.part, attribute, place.watched)
        if isinstance(value, Plane):
            self._follow(inner, "N", value.N)

    def _begin_write(self, place: _Place, name: str, frame: FrameType) -> None:
        attribute = place.attribute or name
        watched_field = self._fields.get(attribute)
        if watched_field is None:
            return
        statement = statement_of(frame)
        if statement is not self._statement:
            self._settle()
            self._statement = statement
        key = id(place.part), attribute
        if key not in self._pending:
            calls = place.watched.calls
            self._pending[key] = _Pending(
                watched_field,
                place,
                attribute,
                _snapshot(getattr(place.part, attribute)),
                running(frame),
                calls[-1] if calls else None,
                _foot(place.watched.transition.sphere_path),
            )

    def _settle(self) -> None:
        """Make writes of what is pending, of that which has changed."""
        writes = [pending.finished() for pending in self._pending.values()]
        self.trace.entries += [write for write in writes if write is not None]
        self._pending.clear()
        self._statement = None


def _foot(path: SpherePath) -> Numbers | None:
    return _floats(path.global_low_point) if path.check_pos.objcell_id else None


def _snapshot(value: Any) -> Any:
    """Return a copy of what may change in place."""
    if isinstance(value, Plane):
        return (*_floats(value.N), _float(value.d))
    return _floats(value) if isinstance(value, Vector3) else value


def _unchanged(before: Any, after: Any) -> bool:
    """Tell whether two values have the same bits; polygons and cells are only the same as themselves."""
    if isinstance(before, tuple) and isinstance(after, tuple):
        return [v.hex() for v in before] == [v.hex() for v in after]
    return before is after or bool(before == after)


def _value(snapshot: Any) -> Value:
    if isinstance(snapshot, Polygon):
        return snapshot.poly_id
    value: Value = snapshot.id if isinstance(snapshot, ObjCell) else snapshot
    return value


def _floats(v: Vector3) -> Numbers:
    return (_float(v.x), _float(v.y), _float(v.z))


def _float(number: Any) -> float:
    """Return a Python float; another number type that the port runs on has it as its `value`."""
    return float(getattr(number, "value", number))
