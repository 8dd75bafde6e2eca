"""A gate's checks as JUnit XML, which every build server shows."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final
from xml.etree import ElementTree as ET

from conformance.gate.outcome import Stage, Status

if TYPE_CHECKING:
    from conformance.gate.outcome import Check, GateRun

_NOT_XML: Final = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
"""Characters that XML 1.0 cannot hold; an engine's log may."""
_ELEMENTS: Final = {
    Status.FAILED: "failure",
    Status.BROKEN: "error",
    Status.RECORDED: "skipped",
    Status.SKIPPED: "skipped",
    Status.UNCHANGED: "skipped",
}
"""What JUnit calls it; what has passed has no element."""


def junit_xml(run: GateRun) -> str:
    """Write the checks, a suite for each stage."""
    root = ET.Element("testsuites", name="retail conformance")
    for stage in Stage:
        if checks := run.of(stage):
            root.append(_suite(stage, checks))
    ET.indent(root)
    return '<?xml version="1.0" encoding="utf-8"?>\n' + ET.tostring(root, encoding="unicode") + "\n"


def _suite(stage: Stage, checks: list[Check]) -> ET.Element:
    elements = [_ELEMENTS.get(check.status) for check in checks]
    suite = ET.Element(
        "testsuite",
        name=stage.value,
        tests=str(len(checks)),
        failures=str(elements.count("failure")),
        errors=str(elements.count("error")),
        skipped=str(elements.count("skipped")),
        time=f"{sum(check.seconds for check in checks):.3f}",
    )
    suite.extend(map(_case, checks))
    return suite


def _case(check: Check) -> ET.Element:
    name = {"classname": f"gate.{check.stage.value}", "name": check.name, "time": f"{check.seconds:.3f}"}
    case = ET.Element("testcase", name)
    if check.status in _ELEMENTS:
        message = _NOT_XML.sub("\ufffd", check.message or check.status.value)
        told = ET.SubElement(
            case, _ELEMENTS[check.status], message=message.partition("\n")[0], type=check.status.value
        )
        told.text = message
    return case
