# SPDX-License-Identifier: BSD-3-Clause
"""Pieces of HTML: tables, figures, coloured cells. What they mean is page.py's business."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from typing import NamedTuple

STYLE = """
:root { color: #23282d; background: #fff; }
body { font: 17px/1.55 "Source Serif 4", "Source Serif Pro", Charter, "Bitstream Charter",
       Georgia, "DejaVu Serif", serif; margin: 0 auto; max-width: 66rem;
       padding: 2rem 1.25rem 5rem; }
h1, h2, h3, th, nav, figcaption b, .note b { font-family: "Source Sans 3", "Helvetica Neue",
       Arial, "DejaVu Sans", sans-serif; }
h1 { font-size: 2.1rem; line-height: 1.2; margin: 1rem 0 .4rem; }
h2 { font-size: 1.45rem; margin: 3.4rem 0 .8rem; padding-top: .6rem;
     border-top: 2px solid #23282d; }
h3 { font-size: 1.1rem; margin: 2rem 0 .5rem; }
p, ul, ol { max-width: 44rem; }
.lead { font-size: 1.12rem; color: #454d55; }
a { color: #1c5a96; text-decoration-thickness: 1px; text-underline-offset: 2px; }
nav ol { columns: 2; column-gap: 2.5rem; padding-left: 1.3rem; font-size: .95rem; }
nav li { break-inside: avoid; margin-bottom: .2rem; }
.scroll { overflow-x: auto; margin: 1rem 0 .4rem; width: max-content;
          max-width: max(100%, min(90rem, 50vw + 31rem)); }
table { border-collapse: collapse; font-size: .85rem; line-height: 1.35;
        font-family: "Source Sans 3", "Helvetica Neue", Arial, "DejaVu Sans", sans-serif;
        font-variant-numeric: tabular-nums; }
caption { caption-side: top; text-align: left; font-weight: 600; padding-bottom: .4rem; }
th, td { padding: .28rem .55rem; text-align: right; border-bottom: 1px solid #dfe3e7;
         white-space: nowrap; }
th { font-weight: 600; border-bottom: 2px solid #8b959e; vertical-align: bottom; }
th.group { text-align: center; border-bottom: 1px solid #8b959e; }
th:first-child, td:first-child, .text { text-align: left; }
td.wrap { white-space: normal; min-width: 14rem; max-width: 24rem; text-align: left; }
tr.rest td { color: #78828c; }
tr.sum td { font-weight: 600; border-top: 2px solid #8b959e; }
tr.head td { background: #f0f2f4; font-weight: 600; }
.dense { font-size: .78rem; }
.dense th, .dense td { padding: .2rem .38rem; }
.soft { color: #78828c; }
td[style] .soft { color: #54453d; }
.bad { background: #f6c9bd; }
.good { background: #dcedda; }
.files { font-size: .85rem; margin: .2rem 0 1.6rem; }
figure { margin: 2rem 0 2.4rem; }
figure img { max-width: 100%; height: auto; border: 1px solid #dfe3e7; box-sizing: border-box; }
figcaption { font-size: .93rem; line-height: 1.45; margin-top: .5rem; max-width: 44rem; }
.note { background: #f4f1e6; border-left: 4px solid #c9a227; padding: .7rem 1rem; margin: 1.2rem 0;
        max-width: 43rem; }
.glance li { margin-bottom: .45rem; }
code { font-size: .88em; }
@media (max-width: 40rem) { nav ol { columns: 1; } body { font-size: 16px; } }
"""


class Cell(NamedTuple):
    """A table's cell: text as it is, a class and a background."""

    text: str
    kind: str = ""
    background: str = ""
    span: int = 1


def cell_html(cell: Cell | str, tag: str) -> str:
    if not isinstance(cell, Cell):
        cell = Cell(cell)
    attributes = f' class="{cell.kind}"' if cell.kind else ""
    attributes += f' style="background:{cell.background}"' if cell.background else ""
    attributes += f' colspan="{cell.span}"' if cell.span > 1 else ""
    return f"<{tag}{attributes}>{cell.text}</{tag}>"


class Line(NamedTuple):
    """A table's row, with a class."""

    cells: Sequence[Cell | str]
    kind: str = ""


def table(
    headers: Sequence[Sequence[Cell | str]], lines: Iterable[Line | Sequence[Cell | str]],
    files: Sequence[str] = (), caption: str = "", dense: bool = False,
) -> str:
    """Scrolls sideways by itself where the window is too narrow."""
    parts = ['<div class="scroll"><table class="dense">' if dense else
             '<div class="scroll"><table>']
    if caption:
        parts.append(f"<caption>{caption}</caption>")
    parts.append("<thead>")
    for header in headers:
        parts.append("<tr>" + "".join(cell_html(cell, "th") for cell in header) + "</tr>")
    parts.append("</thead><tbody>")
    for line in lines:
        kind, cells = (line.kind, line.cells) if isinstance(line, Line) else ("", line)
        parts.append((f'<tr class="{kind}">' if kind else "<tr>") +
                     "".join(cell_html(cell, "td") for cell in cells) + "</tr>")
    parts.append("</tbody></table></div>")
    return "\n".join(parts) + (file_links(files) if files else "")


def file_links(files: Sequence[str]) -> str:
    links = ", ".join(f'<a href="{name}">{name}</a>' for name in files)
    return f'\n<p class="files">As a file: {links}</p>'


def figure(number: str, file: str, caption: str, files: Sequence[str] = ()) -> str:
    """The caption is HTML; the picture's description for those who cannot see it is its text."""
    plain = "".join(part.split(">", 1)[-1] for part in caption.split("<"))
    links = " Numbers: " + ", ".join(f'<a href="{name}">{name}</a>' for name in files) + "." \
        if files else ""
    return (f'<figure id="figure-{number}"><a href="{file}"><img src="{file}" '
            f'alt="{escape(plain, quote=True)}" loading="lazy"></a>\n'
            f"<figcaption>{caption}{links}</figcaption></figure>")


def heat(share: float) -> str:
    """From white for 0 to brick for 1."""
    share = min(1.0, max(0.0, share))
    pale, deep = (255, 255, 255), (226, 120, 84)
    mixed = [round(a + (b - a) * share) for a, b in zip(pale, deep)]
    return f"rgb({mixed[0]},{mixed[1]},{mixed[2]})"


def percent(value: float, digits: int = 0) -> str:
    return f"{100.0 * value:.{digits}f} %"
