# SPDX-License-Identifier: BSD-3-Clause
"""HTML pages from Jinja2 templates."""

from __future__ import annotations

from pathlib import Path

from jinja2 import Environment, FileSystemLoader, StrictUndefined

__all__ = ["templates_of"]

TEMPLATES = Path(__file__).resolve().parent / "templates"


def templates_of(*folders: Path) -> Environment:
    """The templates of these folders and of this package, whose page.html.j2 frames every page.

    Values are escaped. A name that a template uses and nobody gave is an error.
    """
    return Environment(loader=FileSystemLoader([*folders, TEMPLATES]), autoescape=True,
                       undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True,
                       keep_trailing_newline=True)
