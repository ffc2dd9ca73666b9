# SPDX-License-Identifier: BSD-3-Clause
"""Turns results into text."""

from __future__ import annotations

from typing import Any

from .tasks import Detect, Task

Result = dict[str, Any]


def lines_of(task: Task, result: Result) -> list[str]:
    return _LINES[task.command](task, result)


def summary_of(command: str, results: list[Result]) -> str:
    failed = sum("error" in result for result in results)
    counts = {"failed": failed}
    if command == "detect":
        counts = {"found": sum(bool(result.get("found")) for result in results),
                  "not found": sum(result.get("found") is False for result in results)} | counts
    elif command == "embed":
        skipped = sum(bool(result.get("skipped")) for result in results)
        counts = {"marked": len(results) - failed - skipped, "skipped": skipped} | counts
    else:
        counts = {"done": len(results) - failed} | counts
    return f"{len(results)} files: " + ", ".join(
        f"{count} {name}" for name, count in counts.items() if count or name == "failed")


def _embed(_task: Task, result: Result) -> list[str]:
    if result.get("skipped"):
        return [f"{result['output']}: already exists, skipped"]
    cost = (f"moved by {result['distortion_percent']:.3f} % of the diagonal" if "margin" in result
            else f"{result['iterations']} iterations")
    under = "under the secret" if result["secret"] else "for everyone to read"
    return [f"{result['output']}: {result['bits']} bits {under}, {cost}, read back, {result['seconds']:.1f} s"]


def _detect(task: Detect, result: Result) -> list[str]:
    name = result["file"]
    secret = result["secret"]
    if "p_value" not in result:
        return [f"{name}: {_what_was_read(task, result)}{' (with the secret)' if secret else ''}"]
    verdict = {(True, True): "mine", (True, False): "not mine", (False, True): "found",
               (False, False): "not found"}[(secret, result["found"])]
    return [f"{name}: {verdict}, p-value {result['p_value']:.2g} "
            f"({result['wrong_bits']} of {result['bits']} bits wrong)"]


def _what_was_read(task: Detect, result: Result) -> str:
    if task.watermark.scheme == "paper":
        return (f"reads {result['read']}; messages of the paper's scheme have no check of their own: give --message "
                "for a p-value")
    if not result["valid"]:
        if result["secret"]:
            return "no mark found: the bits that were read fail their own check"
        return (f"no mark found without a secret, of {result['bits']} bits (--bits); a mark made with a secret is "
                "found only with that secret (--key-file)")
    return f"reads {result['read']}" + (f", text: {result['text']}" if "text" in result else "")


def _attack(_task: Task, result: Result) -> list[str]:
    return [f"{result['output']}: {', '.join(result['steps'])}; {result['points_before']:,} points before, "
            f"{result['points']:,} now"]


def _compare(task: Task, result: Result) -> list[str]:
    lines = [f"{result['other']} compared with {result['file']}",
             f"  MRMS                  {result['mrms_percent']:.4f} % of the diagonal",
             f"  Hausdorff distance    {result['hausdorff_percent']:.4f} %",
             f"  visible (MSDM2)       {result['msdm2']:.3f}   0: not at all, 1: entirely"]
    if "msdm" in result:
        lines += [f"  visible (MSDM)        {result['msdm']:.3f}",
                  f"  geometric difference  {result['geometric_difference_percent']:.4f} %   point by point",
                  f"  curvature difference  {result['curvature_difference_percent']:.4f} %"]
    if task.output is not None:
        lines.append(f"  differences at the points: {task.output}")
    return lines


def _harmonics(_task: Task, result: Result) -> list[str]:
    return [f"{result['output']}: {result['number']} harmonics, eigenvalues up to "
            f"{result['largest_eigenvalue']:.4g}, {result['seconds']:.1f} s"]


def _info(_task: Task, result: Result) -> list[str]:
    closed = ("closed" if result["open_edges"] == 0
              else f"open: {result['open_edges']:,} edges have one triangle")
    if result["non_manifold_edges"]:
        closed += f", {result['non_manifold_edges']:,} edges have three or more"
    pieces = "one component" if result["components"] == 1 else f"{result['components']:,} components"
    lines = [f"{result['file']}: {result['points']:,} points, {result['polygons']:,} polygons",
             f"  surface   {result['vertices']:,} vertices, {result['triangles']:,} triangles, {pieces}, "
             f"{closed}",
             "  size      " + " x ".join(f"{side:.6g}" for side in result["size"])
             + f", diagonal {result['diagonal']:.6g}",
             f"  area      {result['area']:.6g}"]
    if result["volume"] is not None:
        lines.append(f"  volume    {result['volume']:.6g}")
    if result["arrays"]:
        lines.append("  arrays    " + ", ".join(result["arrays"]))
    if "capacity_bits" in result:
        lines.append(f"  capacity  {result['capacity_bits']} bits at "
                     f"{result['at_distortion_percent']:g} % of the diagonal")
    return lines


def _report(_task: Task, result: Result) -> list[str]:
    return [f"{result['output']}: the mark is {'found' if result['found'] else 'NOT found'} in "
            f"{result['marked']}, and after {result['survived']} of {result['attacks']} attacks"]


_LINES = {"embed": _embed, "detect": _detect, "attack": _attack, "compare": _compare,
          "harmonics": _harmonics, "info": _info, "report": _report}
