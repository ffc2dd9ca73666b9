# SPDX-License-Identifier: BSD-3-Clause
"""The options, and the help that explains them by example."""

from __future__ import annotations

import argparse
import math
import os
import re
from difflib import get_close_matches
from typing import NoReturn

from ..attacks import ATTACKS, Attack
from .output import PROGRAM, UserError, print_text
from .secret import VARIABLE

DESCRIPTION = "Embeds invisible watermarks in 3D models, and proves from a copy alone whose model it is."

COMMANDS = {
    "embed": "embed a mark in meshes",
    "detect": "read the mark of meshes and tell whose they are",
    "attack": "apply attacks (noise, simplification, remeshing, ...)",
    "compare": "measure how far two meshes are apart",
    "harmonics": "compute manifold harmonics and the spectrum",
    "info": "show mesh statistics",
    "report": "write a page that shows what a mark survives",
}

OVERVIEW = f"""\
Getting started:
  head -c 32 /dev/urandom | base64 > my.key          a secret key: keep it
  {PROGRAM} embed model.ply marked.ply --key-file my.key
  {PROGRAM} detect copy.obj --key-file my.key        prints "mine" or "not mine"

Trying what a mark survives:
  {PROGRAM} attack marked.ply attacked.ply --noise 0.3 --simplify 50
  {PROGRAM} detect attacked.ply --key-file my.key
  {PROGRAM} compare model.ply marked.ply             how far the surface moved

Many files:
  {PROGRAM} embed *.ply --output-dir marked --key-file my.key --jobs 2
  {PROGRAM} detect marked/*.ply --key-file my.key --json

Files: PLY, OBJ, STL and VTP; OFF can be read only. The secret comes from --key-file, from the environment
variable {VARIABLE}, or from a prompt (--ask-key).
Exit codes: 0 done or found, 1 not found, 2 error (nothing was written for that file)."""

EMBED = f"""\
Embeds bits in a mesh that encloses a volume. The mark is read back from the points as the file will hold
them; only then is the file written. With a secret and no message, the bits are derived from the secret, so
the secret is all you need to keep.

  {PROGRAM} embed model.ply marked.ply --key-file my.key
  {PROGRAM} embed model.ply marked.ply --key-file my.key --distortion 0.02
  {PROGRAM} embed model.stl marked.stl --text "(c) ACME"     anyone can read this
  {PROGRAM} embed *.obj --output-dir marked --key-file my.key --jobs 2"""

DETECT = f"""\
Reads the mark from a mesh alone, without the original, and prints the p-value: the probability that a mesh
without this mark agrees as well by chance.

With a secret the answer is "mine" or "not mine". With --message or --text it is whether the mesh carries
that message. With neither, or with --read, the bits are read, and "found" means that they pass the mark's
own check.

  {PROGRAM} detect copy.ply --key-file my.key
  {PROGRAM} detect copy.ply --text "(c) ACME"
  {PROGRAM} detect copy.ply --bits 64                          a mark made without a secret
  {PROGRAM} detect *.ply --key-file my.key --json --jobs 2

Exit codes: 0 found in every file, 1 not found in some file, 2 error."""

ATTACK = f"""\
Applies attacks to a mesh, in the order in which they are given. An attack can be given several times.

  {PROGRAM} attack marked.ply out.ply --noise 0.3
  {PROGRAM} attack marked.ply out.ply --similarity --simplify 50 --quantize 10
  {PROGRAM} attack marked.ply out.ply --noise 0.3 --seed 7     different noise"""

COMPARE = f"""\
Measures the distance between two surfaces, whatever their triangles, in percent of the first one's
bounding-box diagonal, and how visible the difference is (MSDM2: 0 not at all, 1 entirely).

  {PROGRAM} compare model.ply marked.ply
  {PROGRAM} compare model.ply marked.ply --output differences.vtp   to colour it in ParaView"""

HARMONICS = f"""\
Computes the mesh's manifold harmonics, the eigenfunctions of its Laplace operator. Writes the basis as
arrays of a VTP file, or eigenvalues and spectrum as CSV.

  {PROGRAM} harmonics model.ply basis.vtp --number 200
  {PROGRAM} harmonics model.ply spectrum.csv"""

INFO = f"""\
Shows the mesh's statistics and, with --capacity, how many bits it can hold.

  {PROGRAM} info model.ply
  {PROGRAM} info model.ply --capacity"""

REPORT = f"""\
Attacks a marked mesh in many ways, reads every attacked copy, and writes one HTML page: pictures from
several sides, what was changed, and what the mark survives. The page does not contain the secret.
Drawing needs a display, or Debian's xvfb and libgl1-mesa-dri.

  {PROGRAM} report model.ply marked.ply report.html --key-file my.key
  {PROGRAM} report model.ply marked.ply report.html --text "(c) ACME\""""

# Tells shtab, which generates the completion files, that an argument names a file.
FILE = {"bash": "_shtab_compgen_files", "zsh": "_files", "tcsh": "f"}


class _Parser(argparse.ArgumentParser):
    def __init__(self, **more):
        super().__init__(allow_abbrev=False, **more)  # or --key would stand for --key-file

    def error(self, message: str) -> NoReturn:
        raise UserError(f"{message}; see {self.prog} --help")

    def print_help(self, file=None) -> None:
        print_text(self.format_help().rstrip())


class _InOrder(argparse.Action):
    """Appends (name, value) to one list, in the order in which the options are typed."""

    def __call__(self, parser, namespace, values, option_string=None):
        steps = list(namespace.steps or [])
        steps.append((self.const, None if self.nargs == 0 else values))
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
        parsed.parser.error(f"unknown option or argument {rest[0]}" +
                            (f": did you mean {meant[0]}?" if meant else ""))
    return parsed


def build_parser() -> argparse.ArgumentParser:
    parser = _Parser(prog=PROGRAM, description=DESCRIPTION, epilog=OVERVIEW,
                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--version", action=_Version, nargs=0, help="print the version")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", required=True,
                                     parser_class=_Parser)
    for add in (_add_embed, _add_detect, _add_attack, _add_compare, _add_harmonics, _add_info, _add_report):
        add(commands)
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
                        help="write the marked files there, under their own names; files that already exist "
                             "there are skipped, so that an interrupted run can be resumed")
    parser.add_argument("--force", action="store_true", help="overwrite files that already exist")
    _add_message(parser, "to embed")
    _add_scheme(parser)
    parser.add_argument("--distortion", type=_percent, default=0.07, metavar="PERCENT",
                        help="how far the surface may move: the root mean square distance in percent of the "
                             "bounding-box diagonal (default: %(default)s)")
    _add_secret(parser)
    _add_common(parser)


def _add_detect(commands) -> None:
    parser = _command(commands, "detect", DETECT,
                      usage=f"{PROGRAM} detect [options] FILE...")
    _add_paths(parser, "PLY, OBJ, STL, VTP or OFF")
    _add_many(parser)
    _add_message(parser, "to look for")
    parser.add_argument("--read", action="store_true",
                        help="with a secret: read the bits, instead of looking for those derived from the secret")
    _add_scheme(parser)
    _add_rate(parser)
    _add_secret(parser)
    _add_common(parser)


def _add_attack(commands) -> None:
    parser = _command(commands, "attack", ATTACK,
                      usage=f"{PROGRAM} attack [options] IN OUT")
    _add_in_and_out(parser, "OUT")
    for attack in ATTACKS.values():
        parser.add_argument(f"--{attack.name}", dest="steps", action=_InOrder, const=attack.name,
                            help=attack.help, **_value_of(attack))
    parser.add_argument("--seed", type=_integer, default=0, metavar="N", help="the seed of all random attacks "
                        "(default: %(default)s)")
    _add_common(parser)


def _value_of(attack: Attack) -> dict:
    """What argparse is told of the option's value."""
    if not attack.property:
        return {"nargs": 0}
    count = len(attack.metavar) if isinstance(attack.metavar, tuple) else None
    return {"nargs": count, "metavar": attack.metavar, "type": {int: _integer, float: _finite, str: str}[attack.type]}


def _add_compare(commands) -> None:
    parser = _command(commands, "compare", COMPARE,
                      usage=f"{PROGRAM} compare [options] REFERENCE OTHER")
    parser.add_argument("reference", metavar="REFERENCE").complete = FILE
    parser.add_argument("other", metavar="OTHER").complete = FILE
    parser.add_argument("--output", metavar="FILE.vtp",
                        help="write OTHER with the differences at its points")
    parser.add_argument("--force", action="store_true", help="overwrite a file that already exists")
    _add_common(parser)


def _add_harmonics(commands) -> None:
    parser = _command(commands, "harmonics", HARMONICS,
                      usage=f"{PROGRAM} harmonics [options] IN OUT.vtp|OUT.csv")
    _add_in_and_out(parser, "OUT.vtp|OUT.csv")
    parser.add_argument("--number", type=_count, default=100, metavar="M",
                        help="how many, including the constant one (default: %(default)s)")
    _add_common(parser)


def _add_info(commands) -> None:
    parser = _command(commands, "info", INFO,
                      usage=f"{PROGRAM} info [options] FILE...")
    _add_paths(parser, "PLY, OBJ, STL, VTP or OFF")
    _add_many(parser)
    parser.add_argument("--capacity", action="store_true",
                        help="measure how many bits the mesh can hold, up to 1024; this takes many minutes "
                             "where hundreds fit, and less with a lower --distortion")
    parser.add_argument("--distortion", type=_percent, default=0.07, metavar="PERCENT",
                        help="how far the surface may move, for --capacity; see embed --help (default: %(default)s)")
    _add_common(parser)


def _add_report(commands) -> None:
    parser = _command(commands, "report", REPORT,
                      usage=f"{PROGRAM} report [options] ORIGINAL MARKED OUT.html")
    parser.add_argument("input", metavar="ORIGINAL").complete = FILE
    parser.add_argument("marked", metavar="MARKED").complete = FILE
    parser.add_argument("output", metavar="OUT.html").complete = FILE
    parser.add_argument("--force", action="store_true", help="overwrite a file that already exists")
    parser.add_argument("--title", default="A protected model", help="the title of the page (default: %(default)s)")
    _add_message(parser, "to look for")
    _add_scheme(parser)
    _add_rate(parser)
    _add_secret(parser)
    _add_common(parser)


# --- Shared by several commands ------------------------------------------------------------------


def _command(commands, name: str, description: str, **more) -> argparse.ArgumentParser:
    parser = commands.add_parser(name, help=COMMANDS[name], description=description,
                                 formatter_class=argparse.RawDescriptionHelpFormatter, **more)
    parser.set_defaults(parser=parser)  # errors point to its help
    return parser


def _add_paths(parser, text: str) -> None:
    parser.add_argument("paths", nargs="+", metavar="FILE", help=text).complete = FILE


def _add_in_and_out(parser, out: str) -> None:
    parser.add_argument("input", metavar="IN").complete = FILE
    parser.add_argument("output", metavar=out).complete = FILE
    parser.add_argument("--force", action="store_true", help="overwrite a file that already exists")


def _add_message(parser, what: str) -> None:
    message = parser.add_mutually_exclusive_group()
    message.add_argument("--message", type=_bits, metavar="BITS", help=f"the bits {what}, such as 10110")
    message.add_argument("--text", type=_text, help=f"the text {what}, 8 bits for each byte of UTF-8")
    message.add_argument("--bits", type=_count, metavar="N",
                         help="how many bits, when no message is given (default: 64; paper: 5)")


def _add_scheme(parser) -> None:
    parser.add_argument("--scheme", choices=("robust", "paper"), default="robust",
                        help="robust (default), or the paper's scheme: any surface, but few bits")


def _add_secret(parser) -> None:
    secret = parser.add_argument_group(
        "secret", f"from one of these, or from the environment variable {VARIABLE}")
    secret.add_argument("--key-file", metavar="FILE", help="a file that holds the secret"
                        ).complete = FILE
    secret.add_argument("--ask-key", action="store_true", help="ask for the secret on the terminal")
    secret.add_argument("--no-key", action="store_true",
                        help="use no secret, even if the environment has one")


def _add_rate(parser) -> None:
    parser.add_argument("--false-positive-rate", type=_share, default=1e-6, metavar="RATE",
                        help="the largest p-value that counts as found (default: %(default)s)")


def _add_many(parser) -> None:
    parser.add_argument("--jobs", type=_count, default=1, metavar="N",
                        help="how many files to process at once (default: %(default)s)")


def _add_common(parser) -> None:
    parser.add_argument("--threads", type=_count, default=os.cpu_count(), metavar="N",
                        help="the number of threads, shared among the jobs (default: one per core)")
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
        raise argparse.ArgumentTypeError(f"{text!r} is not a whole number of at least 1, or too large")
    return int(text)


def _integer(text: str) -> int:
    try:
        value = int(text)
    except ValueError:
        value = 2**31
    if not -(2**31) <= value < 2**31 - 1000:  # each step of an attack adds 1 to the seed
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
        raise argparse.ArgumentTypeError(f"{text!r} is not a number above 0 and at most 1")
    return value
