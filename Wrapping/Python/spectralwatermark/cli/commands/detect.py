# SPDX-License-Identifier: BSD-3-Clause
"""Reads a mesh's mark and decides whether it is the expected one."""

from __future__ import annotations

from typing import NotRequired, TypedDict

from spectralwatermark import vtkSpectralWatermarkDetect
from spectralwatermark.execution import FilterError
from spectralwatermark.io import read_mesh

from ..tasks import Detect, Watermark
from .filters import FilterRunner, set_watermark


class Result(TypedDict):
    scheme: str
    secret: bool
    bits: int
    read: str
    valid: bool
    seconds: float
    found: NotRequired[bool]
    p_value: NotRequired[float]  # when a message was expected
    wrong_bits: NotRequired[int]
    text: NotRequired[str]


def run(task: Detect, filters: FilterRunner) -> Result:
    mark = task.watermark
    detect = detector(mark, task.rate, task.read)
    detect.SetInputData(read_mesh(task.input))
    seconds = filters.update(detect, "detecting")
    derived = bool(detect.GetUseDerivedMessage())
    valid = bool(detect.GetMessageIsValid())
    read = detect.GetExtractedMessage()
    result: Result = {"scheme": mark.scheme, "secret": mark.secret.is_given(), "bits": len(read), "read": read,
                      "valid": valid, "seconds": round(seconds, 3)}
    if derived or mark.message:
        check_provable(detect)
        result |= {"found": bool(detect.GetDetected()), "p_value": detect.GetPValue(),
                   "wrong_bits": _wrong_bits(detect)}
    elif mark.scheme == "robust":  # messages of the paper's scheme have no check of their own
        result["found"] = valid
    if not derived and valid and (text := _text_of(read)):
        result["text"] = text
    return result


def detector(mark: Watermark, rate: float, read: bool = False) -> vtkSpectralWatermarkDetect:
    """The detector of this mark; with `read`, of whatever bits there are."""
    detect = vtkSpectralWatermarkDetect()
    set_watermark(detect, mark)
    detect.SetExpectedMessage(mark.message)
    detect.SetUseDerivedMessage(mark.secret.is_given() and not mark.message and not read)
    detect.SetFalsePositiveRate(rate)
    return detect


def check_provable(detect: vtkSpectralWatermarkDetect) -> None:
    """Raises FilterError where "not found" would mean nothing, because not even full agreement would be found."""
    if detect.GetSmallestPValue() > detect.GetFalsePositiveRate():
        raise FilterError(f"{len(detect.GetExtractedMessage())} bits cannot prove a mark at a false positive rate of "
                          f"{detect.GetFalsePositiveRate():g}: look for more bits, or give --false-positive-rate "
                          f"(here p = {detect.GetPValue():.2g}, {_wrong_bits(detect)} bits wrong)")


def _wrong_bits(detect: vtkSpectralWatermarkDetect) -> int:
    return round(detect.GetBitErrorRate() * len(detect.GetExtractedMessage()))


def _text_of(bits: str) -> str:
    """The text that the bits spell, "" when they spell none."""
    if len(bits) % 8:
        return ""
    try:
        text = bytes(int(bits[i:i + 8], 2) for i in range(0, len(bits), 8)).decode()
    except UnicodeDecodeError:
        return ""
    return text if text.isprintable() else ""
