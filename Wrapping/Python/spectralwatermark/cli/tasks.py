# SPDX-License-Identifier: BSD-3-Clause
"""From what was typed to what is to be done: a request, of plain values, for each mesh.

What can be known to be wrong before a mesh is read is said here, so that nothing has happened yet.
"""

from __future__ import annotations

import os
from argparse import Namespace
from pathlib import Path

from .secret import encoded, secret_of
from .terminal import UserError


def requests_of(arguments: Namespace) -> list[dict]:
    return _MAKERS[arguments.command](arguments)


def _embed(arguments: Namespace) -> list[dict]:
    common = _common(arguments) | _scheme(arguments) | {
        "message": _message(arguments), "distortion": arguments.distortion} | secret_of(arguments)
    if not common["message"] and not {"key", "key_file"} & set(common) and arguments.scheme == "robust":
        raise UserError("nothing to embed: give a secret (--key-file FILE, --ask-key, or the environment "
                        "variable SPECTRAL_WATERMARK_KEY), or a message for everyone (--text, --message)")
    many = arguments.output_dir is not None
    if not many and len(arguments.paths) != 2:
        raise UserError("embed takes IN and OUT, or files and --output-dir FOLDER; see "
                        "spectral-watermark embed --help")
    if not many:
        return [common | _in_and_out(*arguments.paths, arguments.force)]
    outputs = [str(Path(arguments.output_dir) / Path(path).name) for path in arguments.paths]
    for output in outputs:
        if outputs.count(output) > 1:
            raise UserError(f"two of the files would become {output}: mark them in two runs")
    _make_folder(arguments.output_dir)
    for path, output in zip(arguments.paths, outputs):
        _check_different(path, output)
    return [common | {"input": path, "output": output, "force": arguments.force,
                      "skip": not arguments.force and os.path.exists(output)}
            for path, output in zip(arguments.paths, outputs)]


def _detect(arguments: Namespace) -> list[dict]:
    common = _common(arguments) | _scheme(arguments) | {
        "message": _message(arguments),
        "read": arguments.read, "rate": arguments.false_positive_rate} | secret_of(arguments)
    if arguments.read and common["message"]:
        raise UserError("--read and a message are both given: read what there is, or look for one")
    return [common | {"input": path} for path in arguments.paths]


def _attack(arguments: Namespace) -> list[dict]:
    if not arguments.steps:
        raise UserError("no attack is named: try --noise 0.3; see spectral-watermark attack --help")
    for name, value in arguments.steps:
        if name == "subdivide" and value not in ("midpoint", "loop", "sqrt3"):
            raise UserError(f"--subdivide knows midpoint, loop and sqrt3, not {value!r}")
    return [_common(arguments) | {"steps": arguments.steps, "seed": arguments.seed}
            | _in_and_out(arguments.input, arguments.output, arguments.force)]


def _compare(arguments: Namespace) -> list[dict]:
    request = _common(arguments) | {"input": arguments.reference, "other": arguments.other}
    if arguments.output is not None:
        if Path(arguments.output).suffix.lower() != ".vtp":
            raise UserError(f"{arguments.output}: only .vtp holds what differs at each point")
        _check_different(arguments.reference, arguments.output)
        request |= _in_and_out(arguments.other, arguments.output, arguments.force) | {
            "input": arguments.reference}
    return [request]


def _harmonics(arguments: Namespace) -> list[dict]:
    if Path(arguments.output).suffix.lower() not in (".vtp", ".csv"):
        raise UserError(f"{arguments.output}: write a basis to .vtp, or a spectrum to .csv")
    return [_common(arguments) | {"number": arguments.number}
            | _in_and_out(arguments.input, arguments.output, arguments.force)]


def _info(arguments: Namespace) -> list[dict]:
    return [_common(arguments) | {"input": path, "capacity": arguments.capacity,
                                  "distortion": arguments.distortion} for path in arguments.paths]


def _report(arguments: Namespace) -> list[dict]:
    request = _common(arguments) | _scheme(arguments) | {
        "message": _message(arguments), "read": False, "rate": arguments.false_positive_rate,
        "title": arguments.title, "marked": arguments.marked} | secret_of(arguments)
    if not request["message"] and not {"key", "key_file"} & set(request):
        raise UserError("nothing to look for: give the secret (--key-file FILE), or the message that was "
                        "embedded (--text, --message)")
    if Path(arguments.output).suffix.lower() not in (".html", ".htm"):
        raise UserError(f"{arguments.output}: the report is a page: name it .html")
    _check_different(arguments.input, arguments.output)
    return [request | _in_and_out(arguments.marked, arguments.output, arguments.force)
            | {"input": arguments.input}]


_MAKERS = {"embed": _embed, "detect": _detect, "attack": _attack, "compare": _compare,
           "harmonics": _harmonics, "info": _info, "report": _report}


# --- What they share -----------------------------------------------------------------------------


def _common(arguments: Namespace) -> dict:
    jobs = min(getattr(arguments, "jobs", 1), len(getattr(arguments, "paths", [""])))
    threads = arguments.threads if jobs == 1 else max(1, arguments.threads // jobs)
    return {"command": arguments.command, "threads": threads}


def _scheme(arguments: Namespace) -> dict:
    return {"scheme": arguments.scheme, "bits": arguments.bits or 0}


def _message(arguments: Namespace) -> str:
    """The bits that were given, "" where none were."""
    if arguments.text is not None:
        text = encoded(arguments.text, "the text", "write it in UTF-8, or give its bits (--message)")
        return "".join(f"{byte:08b}" for byte in text)
    return arguments.message or ""


def _in_and_out(path: str, output: str, force: bool) -> dict:
    _check_different(path, output)
    if os.path.exists(output) and not os.path.isdir(output) and not force:
        raise UserError(f"{output}: is there already; name another file, or replace it with --force")
    return {"input": path, "output": output, "force": force}


def _check_different(path: str, output: str) -> None:
    if os.path.exists(path) and os.path.exists(output) and os.path.samefile(path, output):
        raise UserError(f"{output}: would replace what is read; name another file")


def _make_folder(name: str) -> None:
    try:
        Path(name).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UserError(f"{name}: cannot be made: {error.strerror}") from error
