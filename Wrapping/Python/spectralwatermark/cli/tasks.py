# SPDX-License-Identifier: BSD-3-Clause
"""Turns parsed arguments into a task for each mesh.

Everything that can be checked before a mesh is read is checked here, so that an error leaves nothing half done. Tasks
hold plain values only.
"""

from __future__ import annotations

import os
from argparse import Namespace
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

from ..attacks import ATTACKS
from .output import UserError
from .secret import Secret, encoded, secret_of


@dataclass(frozen=True, kw_only=True)
class Task:
    """What a command does to one mesh."""

    command: ClassVar[str]
    draws: ClassVar[bool] = False
    input: str
    threads: int

    def files(self) -> tuple[str, ...]:
        """The files that an error of a filter may be about."""
        return (self.input,)

    def result_without_work(self) -> dict[str, Any] | None:
        return None


@dataclass(frozen=True, kw_only=True)
class Watermark:
    """The mark to embed or to look for: `message` holds its bits, "" when they are derived or unknown."""

    scheme: str
    bits: int
    message: str
    secret: Secret


@dataclass(frozen=True, kw_only=True)
class Embed(Task):
    command = "embed"
    watermark: Watermark
    distortion: float
    output: str
    force: bool
    skip: bool = False

    def result_without_work(self) -> dict[str, Any] | None:
        return {"file": self.input, "output": self.output, "skipped": True} if self.skip else None


@dataclass(frozen=True, kw_only=True)
class Detect(Task):
    command = "detect"
    watermark: Watermark
    read: bool
    rate: float


@dataclass(frozen=True, kw_only=True)
class Attack(Task):
    command = "attack"
    steps: tuple[tuple[str, Any], ...]
    seed: int
    output: str
    force: bool


@dataclass(frozen=True, kw_only=True)
class Compare(Task):
    command = "compare"
    other: str
    output: str | None
    force: bool

    def files(self) -> tuple[str, ...]:
        return (self.input, self.other)


@dataclass(frozen=True, kw_only=True)
class Harmonics(Task):
    command = "harmonics"
    number: int
    output: str
    force: bool


@dataclass(frozen=True, kw_only=True)
class Info(Task):
    command = "info"
    capacity: bool
    distortion: float


@dataclass(frozen=True, kw_only=True)
class Report(Task):
    command = "report"
    draws = True
    marked: str
    watermark: Watermark
    rate: float
    title: str
    output: str
    force: bool

    def files(self) -> tuple[str, ...]:
        return (self.input, self.marked)


def tasks_of(arguments: Namespace) -> list[Task]:
    return _MAKERS[arguments.command](arguments)


def _embed(arguments: Namespace) -> list[Task]:
    mark = _watermark(arguments)
    if not mark.message and not mark.secret.is_given() and mark.scheme == "robust":
        raise UserError("nothing to embed: give a secret (--key-file FILE, --ask-key, or the environment "
                        "variable SPECTRAL_WATERMARK_KEY), or a public message (--text, --message)")
    many = arguments.output_dir is not None
    if not many and len(arguments.paths) != 2:
        raise UserError("embed takes IN and OUT, or files and --output-dir FOLDER; see "
                        "spectral-watermark embed --help")

    def task(path: str, output: str, skip: bool) -> Embed:
        return Embed(input=path, output=output, watermark=mark, distortion=arguments.distortion,
                     force=arguments.force, skip=skip, threads=_threads(arguments))

    if not many:
        path, output = arguments.paths
        return [task(path, _checked(output, path, arguments.force), False)]
    outputs = _outputs_in_folder(arguments.paths, arguments.output_dir)
    return [task(path, output, not arguments.force and os.path.exists(output))
            for path, output in zip(arguments.paths, outputs)]


def _outputs_in_folder(paths: list[str], folder: str) -> list[str]:
    outputs = [str(Path(folder) / Path(path).name) for path in paths]
    for output in outputs:
        if outputs.count(output) > 1:
            raise UserError(f"two of the files would become {output}: mark them in two runs")
    _make_folder(folder)
    for path, output in zip(paths, outputs):
        _check_different(path, output)
    return outputs


def _detect(arguments: Namespace) -> list[Task]:
    mark = _watermark(arguments)
    if arguments.read and mark.message:
        raise UserError("--read and a message are both given: read the bits, or look for a message")
    return [Detect(input=path, watermark=mark, read=arguments.read, rate=arguments.false_positive_rate,
                   threads=_threads(arguments)) for path in arguments.paths]


def _attack(arguments: Namespace) -> list[Task]:
    if not arguments.steps:
        raise UserError("no attack is named: try --noise 0.3; see spectral-watermark attack --help")
    for name, value in arguments.steps:
        words = list(ATTACKS[name].choices)
        if words and value not in words:
            raise UserError(f"--{name} takes {', '.join(words[:-1])} or {words[-1]}, not {value!r}")
    return [Attack(input=arguments.input, steps=tuple(arguments.steps), seed=arguments.seed,
                   output=_checked(arguments.output, arguments.input, arguments.force), force=arguments.force,
                   threads=_threads(arguments))]


def _compare(arguments: Namespace) -> list[Task]:
    if arguments.output is not None:
        if Path(arguments.output).suffix.lower() != ".vtp":
            raise UserError(f"{arguments.output}: only .vtp can hold the differences at the points")
        _check_different(arguments.reference, arguments.output)
        _checked(arguments.output, arguments.other, arguments.force)
    return [Compare(input=arguments.reference, other=arguments.other, output=arguments.output,
                    force=arguments.force, threads=_threads(arguments))]


def _harmonics(arguments: Namespace) -> list[Task]:
    if Path(arguments.output).suffix.lower() not in (".vtp", ".csv"):
        raise UserError(f"{arguments.output}: write a basis to .vtp, or a spectrum to .csv")
    return [Harmonics(input=arguments.input, number=arguments.number,
                      output=_checked(arguments.output, arguments.input, arguments.force), force=arguments.force,
                      threads=_threads(arguments))]


def _info(arguments: Namespace) -> list[Task]:
    return [Info(input=path, capacity=arguments.capacity, distortion=arguments.distortion,
                 threads=_threads(arguments)) for path in arguments.paths]


def _report(arguments: Namespace) -> list[Task]:
    mark = _watermark(arguments)
    if not mark.message and not mark.secret.is_given():
        raise UserError("nothing to look for: give the secret (--key-file FILE), or the message that was "
                        "embedded (--text, --message)")
    if Path(arguments.output).suffix.lower() not in (".html", ".htm"):
        raise UserError(f"{arguments.output}: the report is a web page: name it .html")
    _check_different(arguments.input, arguments.output)
    return [Report(input=arguments.input, marked=arguments.marked, watermark=mark,
                   rate=arguments.false_positive_rate, title=arguments.title,
                   output=_checked(arguments.output, arguments.marked, arguments.force), force=arguments.force,
                   threads=_threads(arguments))]


_MAKERS = {"embed": _embed, "detect": _detect, "attack": _attack, "compare": _compare,
           "harmonics": _harmonics, "info": _info, "report": _report}


# --- Shared by several commands ------------------------------------------------------------------


def _threads(arguments: Namespace) -> int:
    """The threads of one task: tasks that run at the same time share them."""
    jobs = min(getattr(arguments, "jobs", 1), len(getattr(arguments, "paths", [""])))
    return max(1, arguments.threads // jobs)


def _watermark(arguments: Namespace) -> Watermark:
    return Watermark(scheme=arguments.scheme, bits=arguments.bits or 0, message=_message(arguments),
                     secret=secret_of(arguments))


def _message(arguments: Namespace) -> str:
    """The bits that were given, "" when none were."""
    if arguments.text is not None:
        text = encoded(arguments.text, "the text", "write it in UTF-8, or give its bits (--message)")
        return "".join(f"{byte:08b}" for byte in text)
    return arguments.message or ""


def _checked(output: str, path: str, force: bool) -> str:
    """The output's name, after a check that writing it overwrites nothing unasked."""
    _check_different(path, output)
    if os.path.exists(output) and not os.path.isdir(output) and not force:
        raise UserError(f"{output}: already exists; name another file, or overwrite it with --force")
    return output


def _check_different(path: str, output: str) -> None:
    if os.path.exists(path) and os.path.exists(output) and os.path.samefile(path, output):
        raise UserError(f"{output}: would replace the input; name another file")


def _make_folder(name: str) -> None:
    try:
        Path(name).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise UserError(f"{name}: the folder cannot be created: {error.strerror}") from error
