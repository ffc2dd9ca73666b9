# SPDX-License-Identifier: BSD-3-Clause
"""The secret comes from a file, the environment or a prompt, never from the argument list."""

from __future__ import annotations

import getpass
import os
import sys
from argparse import Namespace
from dataclasses import dataclass, field

from .output import UserError

VARIABLE = "SPECTRAL_WATERMARK_KEY"

ANY_BYTES = "put a secret of any bytes into a file (--key-file)"


@dataclass(frozen=True)
class Secret:
    """A secret, or the file that holds it, or neither."""

    key: str = field(default="", repr=False)
    key_file: str = ""

    def is_given(self) -> bool:
        return bool(self.key or self.key_file)


def secret_of(arguments: Namespace) -> Secret:
    """The environment comes last: an option takes precedence."""
    given = [name for name, value in (("--key-file", arguments.key_file is not None),
                                      ("--ask-key", arguments.ask_key), ("--no-key", arguments.no_key))
             if value]
    if len(given) > 1:
        raise UserError(f"{' and '.join(given)} are given together: only one secret can be used")
    if arguments.no_key:
        return Secret()
    if arguments.key_file == "":  # from an unset shell variable; without a secret, the mark would be public
        raise UserError("--key-file is empty: name the file that holds the secret")
    if arguments.key_file is not None:
        return Secret(key_file=arguments.key_file)
    if arguments.ask_key:
        return Secret(key=_ask(twice=arguments.command == "embed"))
    if VARIABLE in os.environ:
        if not os.environ[VARIABLE]:
            raise UserError(f"{VARIABLE} is set, but empty: unset it, or put the secret into it")
        encoded(os.environ[VARIABLE], VARIABLE)
        return Secret(key=os.environ[VARIABLE])
    return Secret()


def encoded(text: str, what: str, advice: str = ANY_BYTES) -> bytes:
    try:
        return text.encode()
    except UnicodeEncodeError:
        raise UserError(f"{what} is not text in UTF-8: {advice}") from None


def _ask(twice: bool) -> str:
    if not sys.stdin.isatty():
        raise UserError("--ask-key needs a terminal to ask on: use --key-file, or the environment "
                        f"variable {VARIABLE}")
    secret = _typed("Secret: ")
    if not secret:
        raise UserError("no secret was typed")
    if twice and _typed("Once more: ") != secret:
        raise UserError("the two differ: nothing was done")
    return secret


def _typed(prompt: str) -> str:
    try:
        return getpass.getpass(prompt)
    except EOFError:  # Control-D
        return ""
    except UnicodeDecodeError:
        raise UserError(f"the secret is not text in UTF-8: {ANY_BYTES}") from None
