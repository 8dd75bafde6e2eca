"""An engine that has its answers ready: replies to message N with line N of a file, and knows nothing else.

Run as a program, without the suite: ``python -I -S replaying.py FILE``.
"""

from __future__ import annotations

import sys
from pathlib import Path


def main(path: Path) -> None:
    """Reply until stdin ends, or there are no more lines."""
    replies = sys.stdout.buffer
    with path.open("rb") as ready:
        for _message, reply in zip(sys.stdin.buffer, ready, strict=False):
            replies.write(reply)
            replies.flush()


if __name__ == "__main__":
    main(Path(sys.argv[1]))
