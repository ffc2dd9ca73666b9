#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Prints the manual page, from the parser's help.

Debian 12's argparse-manpage (1.2.2) and help2man do not serve: they fill and justify the examples, which then cannot be
read or copied, and leave the epilog out.
"""

from __future__ import annotations

import argparse
import re

from spectralwatermark.cli.parser import DESCRIPTION, OVERVIEW, build_parser
from spectralwatermark.version import VERSION


def main() -> None:
    parser = build_parser()
    commands = next(action for action in parser._actions
                    if isinstance(action, argparse._SubParsersAction)).choices
    lines = [
        f'.TH SPECTRAL\\-WATERMARK 1 "" "SpectralWatermark {VERSION}" "User commands"',
        ".SH NAME", f"spectral\\-watermark \\- {_escaped(_as_phrase(DESCRIPTION))}",
        ".SH SYNOPSIS", ".nf", *(_escaped(_usage(each)) for each in commands.values()), ".fi",
        ".SH DESCRIPTION", *_paragraphs(OVERVIEW),
    ]
    for name, command in commands.items():
        lines += [f".SH {name.upper()}", ".nf", f"\\fB{_escaped(_usage(command))}\\fR", ".fi", ".PP",
                  *_paragraphs(command.description), *_options(command)]
    lines += [
        ".SH ENVIRONMENT", ".TP", "\\fBSPECTRAL_WATERMARK_KEY\\fR",
        _escaped("The secret, unless --key-file, --ask-key or --no-key is given."),
        ".SH EXIT STATUS", ".TP", "0", "Done, or found in every file.",
        ".TP", "1", "Not found in some file.", ".TP", "2", "An error; nothing was written for that file.",
    ]
    print("\n".join(lines))


def _usage(parser: argparse.ArgumentParser) -> str:
    return re.sub(r"\s+", " ", parser.format_usage().removeprefix("usage: ")).replace(
        " spectral-watermark", "\nspectral-watermark").strip()


def _options(parser: argparse.ArgumentParser) -> list[str]:
    lines = []
    formatter = argparse.HelpFormatter(parser.prog)
    for action in parser._actions:
        if action.option_strings and "--help" not in action.option_strings:
            lines += [".TP", f"\\fB{_escaped(formatter._format_action_invocation(action))}\\fR",
                      _escaped(formatter._expand_help(action))]
    return lines


def _paragraphs(text: str) -> list[str]:
    """Lines that begin with spaces are examples, which keep their line breaks."""
    lines: list[str] = []
    verbatim = False
    for line in text.splitlines():
        if line.startswith(" ") != verbatim:
            verbatim = not verbatim
            lines += [".PP", ".nf", ".RS"] if verbatim else [".RE", ".fi", ".PP"]
        lines.append(_escaped(line.strip()) if line.strip() else ".PP")
    return lines + ([".RE", ".fi"] if verbatim else [])


def _as_phrase(sentence: str) -> str:
    return sentence[0].lower() + sentence[1:].rstrip(".")


def _escaped(text: str) -> str:
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\n".join("\\&" + line if line.startswith((".", "'")) else line for line in text.splitlines())


if __name__ == "__main__":
    main()
