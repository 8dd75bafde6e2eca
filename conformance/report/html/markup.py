"""HTML that is safe by construction: text is escaped unless it was made here."""

from __future__ import annotations

import base64
import hashlib
import html
import json
from typing import Any, Final

_VOID: Final = frozenset({"input", "meta"})
"""Elements without an end."""
_HARMLESS_JSON: Final = str.maketrans({"<": "\\u003c", ">": "\\u003e", "&": "\\u0026"})
"""What could end a script element, or begin a comment, written as JSON also reads it."""


class Html(str):
    """Text that is HTML already; any other text is escaped where it is put into an element."""

    __slots__ = ()


def tag(name: str, /, *content: str, **attributes: str | bool) -> Html:
    """Write an element.

    Parameters
    ----------
    name : str
        Of the element.
    content : sequence of str
        `Html` is taken as it is, all else is text.
    attributes : str or bool
        ``True`` stands alone, ``False`` is left out; an underscore at the end of a name is dropped
        (``class_``), others become hyphens.
    """
    parts = [name, *(_attribute(key, value) for key, value in attributes.items() if value is not False)]
    opened = f"<{' '.join(parts)}>"
    return Html(opened) if name in _VOID else Html(f"{opened}{joined(*content)}</{name}>")


def joined(*content: str) -> Html:
    """Put pieces of a page one after the other."""
    return Html("".join(one if isinstance(one, Html) else html.escape(one) for one in content))


def data_script(data: Any, **attributes: str) -> Html:
    """Embed data for scripts to read; nothing in it can end the element.

    Raises
    ------
    ValueError
        For NaN and infinities, which JSON does not have.
    """
    text = json.dumps(data, allow_nan=False, separators=(",", ":")).translate(_HARMLESS_JSON)
    return tag("script", Html(text), type="application/json", **attributes)


def own_script(source: str) -> Html:
    """Embed a script of our own.

    Raises
    ------
    ValueError
        It contains what would end its element too early.
    """
    if "</script" in source.lower() or "<!--" in source:
        raise ValueError("a script with '</script' or '<!--' in it cannot be embedded")
    return tag("script", Html(source))


def script_policy(sources: list[str]) -> Html:
    """Allow the page these scripts, and no other, no network and no frames."""
    hashes = " ".join(f"'sha256-{_sha256(source)}'" for source in sources)
    policy = (
        f"default-src 'none'; script-src {hashes}; style-src 'unsafe-inline'; img-src data: blob:; "
        "base-uri 'none'; form-action 'none'"
    )
    return tag("meta", http_equiv="Content-Security-Policy", content=policy)


def _sha256(source: str) -> str:
    return base64.b64encode(hashlib.sha256(source.encode()).digest()).decode()


def _attribute(key: str, value: str | bool) -> str:
    name = key.rstrip("_").replace("_", "-")
    return name if value is True else f'{name}="{html.escape(str(value))}"'
