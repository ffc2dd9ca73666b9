# SPDX-License-Identifier: BSD-3-Clause
"""What can be typed."""

from __future__ import annotations

import argparse
import math
import os
import re
from difflib import get_close_matches
from typing import NoReturn

from .secret import VARIABLE
from .terminal import PROGRAM, UserError, print_text

DESCRIPTION = "Hides a mark in 3D models, and proves later from a copy alone whose it is."

COMMANDS = {
    "embed": "hide a mark in meshes",
    "detect": "read meshes, and say whose they are",
    "attack": "do to a mesh what happens to meshes",
    "compare": "how far two meshes are apart",
    "harmonics": "the mesh's own waves, and its spectrum",
    "info": "what meshes are made of",
    "report": "a page that shows what a mark is worth",
}

OVERVIEW = f"""\
A first time:
  head -c 32 /dev/urandom | base64 > my.key        a secret: keep it
  {PROGRAM} embed model.ply marked.ply --key-file my.key
  {PROGRAM} detect copy.obj --key-file my.key        prints "mine" or "not mine"

What a mark survives:
  {PROGRAM} attack marked.ply attacked.ply --noise 0.3 --simplify 50
  {PROGRAM} detect attacked.ply --key-file my.key
  {PROGRAM} compare model.ply marked.ply             how far the surface moved

Many files:
  {PROGRAM} embed *.ply --output-dir marked --key-file my.key --jobs 2
  {PROGRAM} detect marked/*.ply --key-file my.key --json

Files are PLY, OBJ, STL and VTP, and OFF to read. The secret comes from --key-file, from the environment
variable {VARIABLE}, or from a prompt (--ask-key).
Exit codes: 0 done or found, 1 not found, 2 error (nothing was written)."""

EMBED = f"""\
Hides bits in a mesh that encloses a volume, reads them back from the points as the file will hold
them, and only then writes the file. With a secret and no message, the bits are derived from the secret: there is
nothing else to remember.

  {PROGRAM} embed model.ply marked.ply --key-file my.key
  {PROGRAM} embed model.ply marked.ply --key-file my.key --distortion 0.02
  {PROGRAM} embed model.stl marked.stl --text "(c) ACME"     for everyone to read
  {PROGRAM} embed *.obj --output-dir marked --key-file my.key --jobs 2"""

DETECT = f"""\
Reads a mesh, blind, and says how likely chance would agree as well: the p-value.
With a secret it answers "mine" or "not mine"; with --message or --text whether it carries that one;
with neither (or with --read) it reads what there is, and "found" means that the mark's own check
holds.

  {PROGRAM} detect copy.ply --key-file my.key
  {PROGRAM} detect copy.ply --text "(c) ACME"
  {PROGRAM} detect copy.ply --bits 64                          reads a mark made without a secret
  {PROGRAM} detect *.ply --key-file my.key --json --jobs 2

Exit code 0: found (in every file), 1: not found, 2: error."""

ATTACK = f"""\
Does to a mesh what happens to meshes, in the order in which you write it.

  {PROGRAM} attack marked.ply out.ply --noise 0.3
  {PROGRAM} attack marked.ply out.ply --similarity --simplify 50 --quantize 10
  {PROGRAM} attack marked.ply out.ply --noise 0.3 --seed 7     other noise"""

COMPARE = f"""\
How far two surfaces are apart, whatever their triangles, in percent of the first one's bounding-box
diagonal, and how visible that is (MSDM2: 0 not at all, 1 entirely).

  {PROGRAM} compare model.ply marked.ply
  {PROGRAM} compare model.ply marked.ply --output differences.vtp   to colour it in ParaView"""

HARMONICS = f"""\
The mesh's manifold harmonics: the basis as arrays of a VTP file, or eigenvalues and spectrum as CSV.

  {PROGRAM} harmonics model.ply basis.vtp --number 200
  {PROGRAM} harmonics model.ply spectrum.csv"""

INFO = f"""\
What a mesh is made of, and with --capacity how many bits it can hold.

  {PROGRAM} info model.ply
  {PROGRAM} info model.ply --capacity"""


REPORT = f"""\
Attacks a marked mesh in many ways, reads every copy and writes one HTML page, with pictures from several
sides, what was changed, and what the mark survives: to send along, or to keep. The secret is not in it.
It draws, and so needs a display, or Debian's xvfb and libgl1-mesa-dri.

  {PROGRAM} report model.ply marked.ply report.html --key-file my.key
  {PROGRAM} report model.ply marked.ply report.html --text "(c) ACME\""""

# How shtab, which makes the completion files, is told that an argument names a file.
FILE = {"bash": "_shtab_compgen_files", "zsh": "_files", "tcsh": "f"}


class _Parser(argparse.ArgumentParser):
    def __init__(self, **more):
        super().__init__(allow_abbrev=False, **more)  # or --key would be --key-file

    def error(self, message: str) -> NoReturn:
        raise UserError(f"{message}; see {self.prog} --help")

    def print_help(self, file=None) -> None:
        print_text(self.format_help().rstrip())


class _InOrder(argparse.Action):
    """Appends (name, value) to one list, in the order in which the options are typed."""

    def __call__(self, parser, namespace, values, option_string=None):
        steps = list(namespace.steps or [])
        steps.append((self.const, values))
        namespace.steps = steps


def parse(arguments: list[str]) -> argparse.Namespace:
    parser = build_parser()
    parsed, rest = parser.parse_known_args(arguments)
    if any(each == "--key" or each.startswith("--key=") for each in rest):
        raise UserError("a secret is not taken from the command line, where others can see it: use "
                        f"--key-file FILE, --ask-key, or the environment variable {VARIABLE}")
    if rest and hasattr(parsed, "paths") and not any(each.startswith("-") for each in rest):
        parsed.paths += rest  # files on both sides of an option
    elif rest:
        known = parsed.parser.format_help().split()
        meant = get_close_matches(rest[0], {word.strip("[],") for word in known if "--" in word}, 1)
        parsed.parser.error(f"{rest[0]} is not known here" +
                            (f": did you mean {meant[0]}?" if meant else ""))
    return parsed


def build_parser() -> argparse.ArgumentParser:
    parser = _Parser(prog=PROGRAM, description=DESCRIPTION, epilog=OVERVIEW,
                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True,
                                     parser_class=_Parser)
    _add_embed(commands)
    _add_detect(commands)
    _add_attack(commands)
    _add_compare(commands)
    _add_harmonics(commands)
    _add_info(commands)
    _add_report(commands)
    return parser


class _Version(argparse.Action):
    def __call__(self, parser, namespace, values, option_string=None):
        from spectralwatermark.version import VERSION

        print_text(f"{PROGRAM} {VERSION}")
        parser.exit()


# --- Commands ------------------------------------------------------------------------------------


def _add_embed(commands) -> None:
    parser = _command(commands, "embed", EMBED,
                      usage=f"{PROGRAM} embed [options] IN OUT\n"
                            f"       {PROGRAM} embed [options] IN... --output-dir FOLDER")
    _add_paths(parser, "IN and OUT, or the files to mark")
    _add_many(parser)
    parser.add_argument("--output-dir", metavar="FOLDER",
                        help="where marked files go, under their own names; those that are there "
                             "already are skipped, so that an interrupted run goes on")
    parser.add_argument("--force", action="store_true", help="replace files that are there already")
    _add_message(parser, "to embed")
    _add_scheme(parser)
    parser.add_argument("--distortion", type=_percent, default=0.07, metavar="PERCENT",
                        help="how far the surface may move, in root mean square, of the diagonal "
                             "(default: %(default)s)")
    _add_secret(parser)
    _add_common(parser)


def _add_detect(commands) -> None:
    parser = _command(commands, "detect", DETECT,
                      usage=f"{PROGRAM} detect [options] FILE...")
    _add_paths(parser, "PLY, OBJ, STL, VTP or OFF")
    _add_many(parser)
    _add_message(parser, "to look for")
    parser.add_argument("--read", action="store_true",
                        help="with a secret: read what there is, instead of looking for the bits "
                             "derived from the secret")
    _add_scheme(parser)
    _add_rate(parser)
    _add_secret(parser)
    _add_common(parser)


ATTACKS = (
    ("similarity", 0, None, "turn, scale and move at random"),
    ("rotate", 1, "DEGREES", "turn about the z axis"),
    ("scale", 1, "FACTOR", "scale"),
    ("translate", 3, ("X", "Y", "Z"), "move"),
    ("stretch", 3, ("X", "Y", "Z"), "scale each axis by its own factor"),
    ("noise", 1, "PERCENT", "uniform noise on each coordinate, in percent of the mean distance to the "
                            "centre"),
    ("noise-along-normals", 1, "S", "the paper's noise"),
    ("smooth", 1, "TIMES", "Laplacian smoothing with factor 0.1"),
    ("low-pass", 1, "M", "keep only the first M manifold harmonics"),
    ("quantize", 1, "BITS", "round coordinates to 2^BITS levels of the bounding box"),
    ("simplify", 1, "PERCENT", "remove that share of the edges"),
    ("subdivide", 1, "SCHEME", "midpoint, loop or sqrt3"),
    ("remesh", 1, "PERCENT", "resample the surface to that share of the vertices"),
    ("isosurface", 1, "STEPS", "resample through a volume of that many steps"),
    ("crop", 1, "PERCENT", "cut off that share of the vertices"),
    ("shuffle", 0, None, "reorder vertices and triangles"),
)


def _add_attack(commands) -> None:
    parser = _command(commands, "attack", ATTACK,
                      usage=f"{PROGRAM} attack [options] IN OUT")
    _add_in_and_out(parser, "OUT")
    for name, values, metavar, text in ATTACKS:
        types = {"subdivide": str, "smooth": _integer, "low-pass": _integer, "quantize": _integer,
                 "isosurface": _integer}
        kwargs = {"metavar": metavar, "type": types.get(name, _finite)} if values else {}
        nargs = None if values == 1 else values
        parser.add_argument(f"--{name}", dest="steps", action=_InOrder, const=name, nargs=nargs,
                            help=text, **kwargs)
    parser.add_argument("--seed", type=_integer, default=0, help="of all that is random (default: 0)")
    _add_common(parser)


def _add_compare(commands) -> None:
    parser = _command(commands, "compare", COMPARE,
                      usage=f"{PROGRAM} compare [options] REFERENCE OTHER")
    parser.add_argument("reference", metavar="REFERENCE").complete = FILE
    parser.add_argument("other", metavar="OTHER").complete = FILE
    parser.add_argument("--output", metavar="FILE.vtp",
                        help="the other mesh with what differs at each point")
    parser.add_argument("--force", action="store_true", help="replace a file that is there already")
    _add_common(parser)


def _add_harmonics(commands) -> None:
    parser = _command(commands, "harmonics", HARMONICS,
                      usage=f"{PROGRAM} harmonics [options] IN OUT.vtp|OUT.csv")
    _add_in_and_out(parser, "OUT.vtp|OUT.csv")
    parser.add_argument("--number", type=_count, default=100, metavar="M",
                        help="how many, the constant one among them (default: %(default)s)")
    _add_common(parser)


def _add_info(commands) -> None:
    parser = _command(commands, "info", INFO,
                      usage=f"{PROGRAM} info [options] FILE...")
    _add_paths(parser, "PLY, OBJ, STL, VTP or OFF")
    _add_many(parser)
    parser.add_argument("--capacity", action="store_true",
                        help="measure how many bits it can hold, up to 1024: the more they are, the longer it "
                             "takes (many minutes where hundreds fit; lower --distortion to see sooner)")
    parser.add_argument("--distortion", type=_percent, default=0.07, metavar="PERCENT",
                        help="for --capacity (default: %(default)s)")
    _add_common(parser)


def _add_report(commands) -> None:
    parser = _command(commands, "report", REPORT,
                      usage=f"{PROGRAM} report [options] ORIGINAL MARKED OUT.html")
    parser.add_argument("input", metavar="ORIGINAL").complete = FILE
    parser.add_argument("marked", metavar="MARKED").complete = FILE
    parser.add_argument("output", metavar="OUT.html").complete = FILE
    parser.add_argument("--force", action="store_true", help="replace a file that is there already")
    parser.add_argument("--title", default="A protected model", help="of the page")
    _add_message(parser, "to look for")
    _add_scheme(parser)
    _add_rate(parser)
    _add_secret(parser)
    _add_common(parser)


# --- What commands share -------------------------------------------------------------------------


def _command(commands, name: str, description: str, **more) -> argparse.ArgumentParser:
    parser = commands.add_parser(name, help=COMMANDS[name], description=description,
                                 formatter_class=argparse.RawDescriptionHelpFormatter, **more)
    parser.set_defaults(parser=parser)  # whose help errors point to
    return parser


def _add_paths(parser, text: str) -> None:
    parser.add_argument("paths", nargs="+", metavar="FILE", help=text).complete = FILE


def _add_in_and_out(parser, out: str) -> None:
    parser.add_argument("input", metavar="IN").complete = FILE
    parser.add_argument("output", metavar=out).complete = FILE
    parser.add_argument("--force", action="store_true", help="replace a file that is there already")


def _add_message(parser, what: str) -> None:
    message = parser.add_mutually_exclusive_group()
    message.add_argument("--message", type=_bits, metavar="BITS", help=f"the bits {what}, such as 10110")
    message.add_argument("--text", type=_text, help=f"the text {what}, 8 bits for each byte of UTF-8")
    message.add_argument("--bits", type=_count, metavar="N",
                         help="how many, where no message says it (default: 64; paper: 5)")


def _add_scheme(parser) -> None:
    parser.add_argument("--scheme", choices=("robust", "paper"), default="robust",
                        help="robust (default), or the paper's slots: any surface, few bits")


def _add_secret(parser) -> None:
    secret = parser.add_argument_group(
        "secret", f"from one of these, or from the environment variable {VARIABLE}")
    secret.add_argument("--key-file", metavar="FILE", help="a file that holds the secret"
                        ).complete = FILE
    secret.add_argument("--ask-key", action="store_true", help="ask for the secret on the terminal")
    secret.add_argument("--no-key", action="store_true",
                        help="no secret, also where the environment has one")


def _add_rate(parser) -> None:
    parser.add_argument("--false-positive-rate", type=_share, default=1e-6, metavar="RATE",
                        help="the largest p-value that counts as found (default: %(default)s)")


def _add_many(parser) -> None:
    parser.add_argument("--jobs", type=_count, default=1, metavar="N",
                        help="how many files at once (default: %(default)s)")


def _add_common(parser) -> None:
    parser.add_argument("--threads", type=_count, default=os.cpu_count(), metavar="N",
                        help="of each file (default: one a core, shared among the jobs)")
    parser.add_argument("--json", action="store_true", help="print one JSON object for each file")


# --- Values --------------------------------------------------------------------------------------


def _bits(text: str) -> str:
    if not text or set(text) - {"0", "1"}:
        raise argparse.ArgumentTypeError("write the bits, such as 10110")
    return text


def _text(text: str) -> str:
    if not text:
        raise argparse.ArgumentTypeError("the text is empty")
    return text


def _count(text: str) -> int:
    if not re.fullmatch("[0-9]{1,10}", text) or not 1 <= int(text) < 2**31:
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number from 1 on, or too large")
    return int(text)


def _integer(text: str) -> int:
    try:
        value = int(text)
    except ValueError:
        value = 2**31
    if not -(2**31) <= value < 2**31 - 1000:  # the steps of an attack count on from the seed
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number, or too large")
    return value


def _finite(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"{text!r} is not a finite number")
    return value


def _positive(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0.0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text!r} is not a number above 0")
    return value


def _percent(text: str) -> float:
    value = _positive(text)
    if value > 5.0:
        raise argparse.ArgumentTypeError(f"{text} percent of the diagonal would deform the mesh; 0.07 is usual")
    return value


def _share(text: str) -> float:
    value = _positive(text)
    if value > 1.0:
        raise argparse.ArgumentTypeError(f"{text!r} is not above 0 and up to 1")
    return value
