# SPDX-License-Identifier: BSD-3-Clause
"""Results in words."""

from __future__ import annotations


def lines_of(request: dict, result: dict) -> list[str]:
    return _WORDS[request["command"]](request, result)


def _embed(_request: dict, result: dict) -> list[str]:
    if result.get("skipped"):
        return [f"{result['output']}: is there already, skipped"]
    cost = (f"moved by {result['distortion_percent']:.3f} % of the diagonal" if "margin" in result
            else f"{result['iterations']} iterations")
    under = "under the secret" if result["secret"] else "for everyone to read"
    return [f"{result['output']}: {result['bits']} bits {under}, {cost}, read back, "
            f"{result['seconds']:.1f} s"]


def _detect(request: dict, result: dict) -> list[str]:
    name = result["file"]
    secret = result["secret"]
    if "p_value" not in result:
        return [f"{name}: {_what_was_read(request, result)}{' (with the secret)' if secret else ''}"]
    verdict = {(True, True): "mine", (True, False): "not mine", (False, True): "found",
               (False, False): "not found"}[(secret, result["found"])]
    return [f"{name}: {verdict}, p-value {result['p_value']:.2g} "
            f"({result['wrong_bits']} of {result['bits']} bits wrong)"]


def _what_was_read(request: dict, result: dict) -> str:
    if request["scheme"] == "paper":
        return f"reads {result['read']}; the paper's bits have no check: give --message for a p-value"
    if not result["valid"]:
        if result["secret"]:
            return "no mark found: what was read fails its own check"
        return (f"no mark found without a secret, of {result['bits']} bits (--bits): one under a secret is found "
                "only with it, by --key-file")
    return f"reads {result['read']}" + (f", text: {result['text']}" if "text" in result else "")


def _attack(_request: dict, result: dict) -> list[str]:
    steps = ", ".join(result["steps"])
    return [f"{result['output']}: {steps}; {result['points_before']:,} points before, "
            f"{result['points']:,} now"]


def _compare(request: dict, result: dict) -> list[str]:
    lines = [f"{result['other']} beside {result['file']}",
             f"  MRMS                  {result['mrms_percent']:.4f} % of the diagonal",
             f"  Hausdorff distance    {result['hausdorff_percent']:.4f} %",
             f"  visible (MSDM2)       {result['msdm2']:.3f}   0: not at all, 1: entirely"]
    if "msdm" in result:
        lines += [f"  visible (MSDM)        {result['msdm']:.3f}",
                  f"  geometric difference  {result['geometric_difference_percent']:.4f} %   point by "
                  "point",
                  f"  curvature difference  {result['curvature_difference_percent']:.4f} %"]
    if "output" in request:
        lines.append(f"  differences at the points: {request['output']}")
    return lines


def _harmonics(_request: dict, result: dict) -> list[str]:
    return [f"{result['output']}: {result['number']} harmonics, eigenvalues up to "
            f"{result['largest_eigenvalue']:.4g}, {result['seconds']:.1f} s"]


def _info(_request: dict, result: dict) -> list[str]:
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


def _report(_request: dict, result: dict) -> list[str]:
    return [f"{result['output']}: the mark is {'found' if result['found'] else 'NOT found'} in "
            f"{result['marked']}, and after {result['survived']} of {result['attacks']} attacks"]


_WORDS = {"embed": _embed, "detect": _detect, "attack": _attack, "compare": _compare,
          "harmonics": _harmonics, "info": _info, "report": _report}
