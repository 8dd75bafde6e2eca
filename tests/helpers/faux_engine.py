"""An engine that answers `block_offset` over protocol v1, and is wrong on purpose in one way.

    python faux_engine.py MODE [SEQ]

It uses nothing of the project: what it is told and what it says are plain lines. SEQ is the number of the
message at which it goes wrong.
"""

from __future__ import annotations

import json
import os
import struct
import subprocess
import sys
import time

BLOCK = 192
MODE = sys.argv[1]
AT = int(sys.argv[2]) if len(sys.argv) > 2 else -1
HANDSHAKE = {
    "version": 1,
    "name": "faux 1.0",
    "floats": "hex" if MODE == "hex" else "decimal",
    "ops": ["block_offset"],
    "features": [],
}
"""What a faux engine says about itself, unless its mode changes that."""
CLAIMS = {
    "claims": {"ops": ["block_offset", "calc_friction"]},
    "unknown-op": {"ops": ["block_ofset"]},
    "unknown-feature": {"features": ["two-sphere"]},
    "version": {"version": 2},
    "extra-claim": {"speed": "fast"},
    "no-ops": {"ops": []},
    "bad-claim": {"ops": "all"},
}


def main() -> int:
    """Answer until told to stop."""
    previous: dict[str, object] = {}
    if MODE == "banner":
        say("Loading the world ...")
    if MODE == "noise":
        sys.stderr.write("x" * 200_000 + "\nlast words\n")
    if MODE == "child":
        subprocess.Popen([sys.executable, "-c", "import time; time.sleep(60)"])
    if MODE == "leaves":
        subprocess.Popen([sys.executable, "-c", "import time; time.sleep(20)"], start_new_session=True)
    for line in sys.stdin:
        message = json.loads(line)
        result = answer(message)
        if MODE == "previous" and message.get("op") == "block_offset":
            result, previous = previous or result, result
        if message["seq"] == AT:
            misbehave(message["seq"], result)
        else:
            reply(message["seq"], result)
        if message["cmd"] == "stop":
            return stop()
    if MODE == "outlives":
        time.sleep(60)
    return 0


def answer(message: dict) -> dict:
    """Return the body of the right reply."""
    if message["cmd"] == "start":
        if MODE == "refuses":
            return {"errored": {"context": "no licence"}}
        if MODE == "mute":
            time.sleep(60)
        return {"result": {**HANDSHAKE, **CLAIMS.get(MODE, {})}}
    if message["cmd"] != "run":
        return {"result": {}}
    if message["op"] != "block_offset" and MODE == "trusting":
        raise KeyError(message["op"])
    if message["op"] != "block_offset" and MODE == "eager":
        return {"result": {}}
    if message["op"] != "block_offset":
        return {"skipped": {"reason": f"no {message['op']}"}}
    return {"result": {"v": [number(x) for x in offset(message["inputs"])]}}


def offset(inputs: dict) -> list[float]:
    """Return from_cell's offset to to_cell in metres."""
    one, other = inputs["from_cell"], inputs["to_cell"]
    return [float(BLOCK * ((other >> at & 0xFF) - (one >> at & 0xFF))) for at in (24, 16)] + [0.0]


def number(value: float) -> float | str:
    """Write a float, one ULP off if that is the mode."""
    bits = struct.unpack(">I", struct.pack(">f", value))[0]
    if MODE == "ulp" and value:
        return struct.unpack(">f", struct.pack(">I", bits + 1))[0]
    return f"0x{bits:08x}" if MODE == "hex" else value


def misbehave(seq: int, body: dict) -> None:
    """Do what the mode says instead of replying."""
    whole = json.dumps({"seq": seq, **body})
    lines = {
        "garbage": "segment 0x12 loaded",
        "list": "[1, 2]",
        "nan": whole.replace("0.0", "NaN", 1),
        "late-seq": whole.replace(f'"seq": {seq}', f'"seq": {seq + 1}'),
        "previous-seq": whole.replace(f'"seq": {seq}', f'"seq": {seq - 1}'),
        "text-seq": whole.replace(f'"seq": {seq}', f'"seq": "{seq}"'),
        "no-seq": json.dumps(body),
        "extra": json.dumps({"seq": seq, **body, "elapsed": 3}),
        "two-bodies": json.dumps({"seq": seq, **body, "skipped": {"reason": "no"}}),
        "no-body": json.dumps({"seq": seq}),
        "text-skip": json.dumps({"seq": seq, "skipped": "no"}),
        "field": json.dumps({"seq": seq, "result": {"v": [0, 0, 0], "speed": 1}}),
        "missing": json.dumps({"seq": seq, "result": {}}),
        "twin-keys": whole.replace('"v":', '"v": [0, 0, 0], "v":', 1),
        "short": json.dumps({"seq": seq, "result": {"v": [0, 0]}}),
        "errored": json.dumps({"seq": seq, "errored": {"context": "out of cells"}}),
        "skipped": json.dumps({"seq": seq, "skipped": {"reason": "too far"}}),
        "surrogate": json.dumps({"seq": seq, "errored": {"context": "\ud83d"}}),
        "twice": f"{whole}\n{whole}",
    }
    if MODE == "crash":
        sys.stderr.write("about to fail\nassertion in cell 7\n")
        sys.stderr.flush()
        os._exit(3)
    elif MODE in {"hang", "child"}:
        time.sleep(60)
    elif MODE == "long":
        say("x" * ((1 << 24) + 10))
    elif MODE == "half":
        sys.stdout.write(whole[:-5])
        sys.stdout.flush()
        os._exit(0)
    elif MODE == "endless":
        sys.stdout.write(whole)
        sys.stdout.flush()
        time.sleep(60)
    elif MODE == "latin":
        sys.stdout.buffer.write(b'{"seq": "\xe9"}\n')
        sys.stdout.buffer.flush()
    else:
        say(lines[MODE])


def stop() -> int:
    """End, or not, as the mode says."""
    if MODE == "stays":
        time.sleep(60)
    if MODE == "chatty":
        say("bye")
    return 4 if MODE == "sour" else 0


def reply(seq: int, body: dict) -> None:
    """Write a reply."""
    say(json.dumps({"seq": seq, **body}))


def say(line: str) -> None:
    """Write a line on stdout."""
    sys.stdout.write(line + "\n")
    sys.stdout.flush()


sys.exit(main())
