# SPDX-License-Identifier: BSD-3-Clause
"""The program spectral-watermark, as a user or a script calls it."""

import csv
import json
import os
import pty
import resource
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import termios
import time
import unittest
from pathlib import Path

from meshes import NOT_FINITE, quadrilateral_ball

ROOT = Path(__file__).resolve().parents[2]
PEBBLE = ROOT / "Data" / "pebble.ply"
PROGRAM = os.environ.get("SPECTRALWATERMARK_PROGRAM", str(ROOT / "build/bin/spectral-watermark"))
DONE, NOT_FOUND, ERROR = 0, 1, 2


def run(*arguments, secret=None, **more):
    environment = {name: value for name, value in os.environ.items()
                   if name != "SPECTRAL_WATERMARK_KEY"}
    if secret is not None:
        environment["SPECTRAL_WATERMARK_KEY"] = secret
    return subprocess.run([sys.executable, PROGRAM, *map(str, arguments)], env=environment,
                          stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False, **more)


class InFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.addCleanup(os.chdir, Path.cwd())
        os.chdir(self.folder)
        shutil.copy(PEBBLE, "model.ply")
        Path("my.key").write_text("a secret for the test\n")
        Path("other.key").write_text("another one\n")

    def succeed(self, *arguments, **more):
        done = run(*arguments, **more)
        self.assertEqual((done.returncode, done.stderr), (DONE, ""), done)
        return done.stdout

    def fail_with(self, *texts, of=(), **more):
        """One line that says what to do, code 2, and no file that was not there."""
        before = {path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}
        done = run(*of, **more)
        self.assertEqual(done.returncode, ERROR, done)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertEqual(done.stdout, "")
        for text in texts:
            self.assertIn(text, done.stderr)
        after = {path: path.read_bytes() for path in self.folder.rglob("*") if path.is_file()}
        self.assertEqual(before, after)


class StoryTest(InFolder):
    def test_mine_and_not_mine(self):
        said = self.succeed("embed", "model.ply", "marked.ply", "--key-file", "my.key")
        self.assertRegex(said, r"^marked.ply: 64 bits under the secret, moved by 0\.0\d+ % of the diagonal, read back")
        self.succeed("attack", "marked.ply", "attacked.obj", "--similarity", "--noise", 0.2,
                     "--shuffle", "--simplify", 20)
        said = self.succeed("detect", "attacked.obj", "--key-file", "my.key")
        self.assertRegex(said, r"^attacked.obj: mine, p-value \d\.\de-2\d \(0 of 64 bits wrong\)")
        for path, key in (("attacked.obj", "other.key"), ("model.ply", "my.key")):
            done = run("detect", path, "--key-file", key)
            self.assertEqual(done.returncode, NOT_FOUND)
            self.assertRegex(done.stdout, rf"^{path}: not mine, p-value 0?\.?\d")

    def test_secret_in_the_environment(self):
        self.succeed("embed", "model.ply", "marked.ply", secret="a secret for the test")
        result = json.loads(self.succeed("detect", "marked.ply", "--key-file", "my.key", "--json"))
        self.assertEqual(result["file"], "marked.ply")
        self.assertIs(result["found"], True)
        self.assertIs(result["valid"], True)
        self.assertLess(result["p_value"], 1e-25)
        self.assertEqual(result["wrong_bits"], 0)

    def test_text_for_everyone(self):
        self.succeed("embed", "model.ply", "marked.stl", "--text", "(c) é")
        bits = 8 * len("(c) é".encode())
        self.assertIn("text: (c) é", self.succeed("detect", "marked.stl", "--bits", bits))
        self.assertIn("found, p-value", self.succeed("detect", "marked.stl", "--text", "(c) é"))
        self.assertEqual(run("detect", "marked.stl", "--text", "(c) e!").returncode, NOT_FOUND)
        unmarked = run("detect", "model.ply", "--bits", bits)
        self.assertEqual(unmarked.returncode, NOT_FOUND)
        self.assertIn("no mark found without a secret", unmarked.stdout)

    def test_the_file_does_not_tell_that_it_is_marked(self):
        self.succeed("embed", "model.ply", "marked.vtp", "--key-file", "my.key")
        self.assertEqual(json.loads(self.succeed("info", "marked.vtp", "--json"))["arrays"],
                         json.loads(self.succeed("info", "model.ply", "--json"))["arrays"])

    def test_message_under_a_key_can_be_read(self):
        self.succeed("embed", "model.ply", "marked.vtp", "--key-file", "my.key", "--message", "110010111")
        said = self.succeed("detect", "marked.vtp", "--key-file", "my.key", "--read", "--bits", 9)
        self.assertIn("reads 110010111", said)
        self.assertIn("mine", self.succeed("detect", "marked.vtp", "--key-file", "my.key",
                                           "--message", "110010111"))

    def test_papers_scheme(self):
        self.succeed("embed", "model.ply", "marked.ply", "--scheme", "paper", "--message", "10110")
        said = self.succeed("detect", "marked.ply", "--scheme", "paper")
        self.assertIn("reads 10110", said)
        expected = ("--scheme", "paper", "--message", "10110")
        self.fail_with("cannot prove", "0 bits wrong", of=("detect", "marked.ply", *expected))
        self.assertIn("found, p-value 0.05",
                      self.succeed("detect", "marked.ply", *expected, "--false-positive-rate", 0.1))

    def test_quadrilaterals_in_every_format(self):
        Path("ball.obj").write_text(quadrilateral_ball(8))
        self.assertIn("386 vertices", self.succeed("info", "ball.obj"))
        for end in ("ply", "obj", "stl", "vtp"):
            marked = f"marked.{end}"
            self.succeed("embed", "ball.obj", marked, "--scheme", "paper", "--message", "10110010")
            detected = self.succeed("detect", marked, "--scheme", "paper", "--bits", 8, "--json")
            self.assertEqual(json.loads(detected)["read"], "10110010", end)

    def test_so_few_bits_that_nothing_would_be_found(self):
        """Whatever agrees; without a secret a bit of the paper's agrees by chance in up to 60 % of all cases."""
        for bits, *more in ((20, "--scheme", "paper", "--message", "10" * 10),
                            (1, "--bits", 1, "--key-file", "my.key", "--false-positive-rate", 1e-9)):
            self.fail_with(f"model.ply: {bits} bits cannot prove a mark at a false positive rate of ",
                           "give --false-positive-rate (here p = ", " bits wrong)", of=("detect", "model.ply", *more))

    def test_compare(self):
        self.succeed("attack", "model.ply", "noisy.ply", "--noise", 1)
        self.succeed("compare", "model.ply", "noisy.ply", "--output", "differences.vtp")
        result = json.loads(self.succeed("compare", "model.ply", "noisy.ply", "--json"))
        same = json.loads(self.succeed("compare", "model.ply", "model.ply", "--json"))
        self.assertGreater(result["mrms_percent"], 0.01)
        self.assertGreater(result["hausdorff_percent"], result["mrms_percent"])
        self.assertLess(same["mrms_percent"], 1e-10)
        self.assertTrue(Path("differences.vtp").stat().st_size)
        self.assertIn("GeometricDifference",
                      json.loads(self.succeed("info", "differences.vtp", "--json"))["arrays"])

    def test_harmonics(self):
        self.succeed("harmonics", "model.ply", "basis.vtp", "--number", 20)
        self.succeed("harmonics", "model.ply", "spectrum.csv", "--number", 20)
        arrays = json.loads(self.succeed("info", "basis.vtp", "--json"))["arrays"]
        self.assertIn("ManifoldHarmonics", arrays)
        with open("spectrum.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([row["component"] for row in rows], [str(k + 1) for k in range(20)])
        values = [float(row["eigenvalue"]) for row in rows]
        self.assertEqual(values, sorted(values))
        x, y, z = (float(rows[5][name]) for name in "xyz")
        self.assertAlmostEqual(float(rows[5]["magnitude"]), (x * x + y * y + z * z) ** 0.5)

    def test_info(self):
        result = json.loads(self.succeed("info", "model.ply", "--json"))
        vertices, triangles = result["vertices"], result["triangles"]
        self.assertEqual(vertices - 3 * triangles // 2 + triangles, 2 * result["components"])  # spheres
        self.assertEqual((result["open_edges"], result["non_manifold_edges"]), (0, 0))
        self.assertGreater(result["volume"], 0.0)
        self.assertIn("one component, closed", self.succeed("info", "model.ply"))

    def test_capacity_is_what_can_be_embedded(self):
        little = ("--distortion", 0.001)
        text = self.succeed("info", "model.ply", "--capacity", *little)
        bits = int(text.split("capacity")[1].split()[0])
        self.succeed("embed", "model.ply", "full.ply", "--message", "1" * bits, *little)
        self.fail_with("would move the surface by", of=(
            "embed", "model.ply", "overfull.ply", "--message", "1" * (bits + 60), *little))

    def test_attacks_are_repeatable(self):
        for name, seed in (("a.ply", 3), ("b.ply", 3), ("c.ply", 4)):
            self.succeed("attack", "model.ply", name, "--noise", 0.3, "--seed", seed)
        self.assertEqual(Path("a.ply").read_bytes(), Path("b.ply").read_bytes())
        self.assertNotEqual(Path("a.ply").read_bytes(), Path("c.ply").read_bytes())

    def test_every_attack(self):
        for step in (["--similarity"], ["--rotate", 20], ["--scale", 2], ["--translate", 1, 2, 3],
                     ["--stretch", 1, 1, 1.2], ["--noise", 0.1], ["--noise-along-normals", 0.1],
                     ["--smooth", 3], ["--low-pass", 50], ["--quantize", 9], ["--simplify", 30],
                     ["--subdivide", "sqrt3"], ["--remesh", 80], ["--isosurface", 32], ["--crop", 10],
                     ["--shuffle"]):
            with self.subTest(step[0]):
                self.succeed("attack", "model.ply", "out.ply", "--force", *step)
                self.assertNotEqual(Path("out.ply").read_bytes(), Path("model.ply").read_bytes())


class ManyTest(InFolder):
    def setUp(self):
        super().setUp()
        shutil.copy("model.ply", "second.ply")
        Path("bad.ply").write_bytes(Path("model.ply").read_bytes()[:2000])
        Path("empty.obj").write_text("")

    def embed_all(self, *more):
        return run("embed", "model.ply", "bad.ply", "empty.obj", "second.ply", "--output-dir", "out",
                   "--key-file", "my.key", "--jobs", 2, "--json", *more)

    def test_one_bad_file_does_not_stop_the_rest(self):
        done = self.embed_all()
        self.assertEqual(done.returncode, ERROR)
        results = [json.loads(line) for line in done.stdout.splitlines()]
        self.assertEqual([result["file"] for result in results],
                         ["model.ply", "bad.ply", "empty.obj", "second.ply"])
        self.assertEqual([("error" in result) for result in results], [False, True, True, False])
        self.assertIn("cut off", results[1]["error"])
        self.assertEqual(sorted(path.name for path in Path("out").iterdir()),
                         ["model.ply", "second.ply"])
        self.assertIn("4 files: 2 marked, 2 failed", done.stderr)
        found = run("detect", "out/model.ply", "model.ply", "out/second.ply", "--key-file", "my.key")
        self.assertEqual(found.returncode, NOT_FOUND)
        self.assertEqual([line.split(",")[0] for line in found.stdout.splitlines()],
                         ["out/model.ply: mine", "model.ply: not mine", "out/second.ply: mine"])
        self.assertIn("3 files: 2 found, 1 not found, 0 failed", found.stderr)

    def test_goes_on_where_it_was(self):
        self.embed_all()
        first = Path("out/model.ply").stat().st_mtime_ns
        Path("out/second.ply").unlink()
        again = self.embed_all()
        self.assertIn("1 marked, 1 skipped, 2 failed", again.stderr)
        self.assertEqual(Path("out/model.ply").stat().st_mtime_ns, first)
        self.assertTrue(Path("out/second.ply").exists())
        self.embed_all("--force")
        self.assertNotEqual(Path("out/model.ply").stat().st_mtime_ns, first)

    def test_one_file_is_skipped_too(self):
        Path("out").mkdir()
        Path("out/model.ply").write_text("mine")
        said = run("embed", "model.ply", "--output-dir", "out", "--key-file", "my.key")
        self.assertEqual(said.returncode, DONE)
        self.assertIn("skipped", said.stdout)
        self.assertEqual(Path("out/model.ply").read_text(), "mine")

    def test_jobs_and_threads_change_nothing(self):
        for folder, more in (("one", ("--threads", 1)), ("two", ("--jobs", 2, "--threads", 6))):
            self.succeed_many("embed", "model.ply", "second.ply", "--output-dir", folder,
                              "--key-file", "my.key", *more)
        self.assertEqual(Path("one/model.ply").read_bytes(), Path("two/model.ply").read_bytes())

    def succeed_many(self, *arguments):
        done = run(*arguments)
        self.assertEqual(done.returncode, DONE, done)


class BadInputTest(InFolder):
    def test_files(self):
        Path("words.ply").write_text("these are words\n")
        Path("model.xyz").write_text("1 2 3\n")
        Path("points.ply").write_text("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                                      "property float y\nproperty float z\nend_header\n0 0 0\n")
        key = ("--key-file", "my.key")
        for name, text in (("missing.ply", "file not found"), ("words.ply", "is it a PLY file?"),
                           ("model.xyz", "cannot read .xyz"), ("points.ply", "no polygons")):
            with self.subTest(name):
                self.fail_with(name, text, of=("embed", name, "out.ply", *key))
                self.fail_with(name, text, of=("detect", name, *key))
                self.fail_with(name, text, of=("info", name))
                self.fail_with(name, text, of=("compare", "model.ply", name))

    def test_of_two_files_the_one_at_fault_is_named(self):
        Path("bad.ply").write_text(NOT_FINITE)
        for pair in (("model.ply", "bad.ply"), ("bad.ply", "model.ply")):
            self.fail_with("spectral-watermark: bad.ply: point 0 has a coordinate that is not finite",
                           of=("compare", *pair))
        self.fail_with("spectral-watermark: bad.ply: point 0 has a coordinate that is not finite",
                       of=("info", "bad.ply"))

    def test_a_name_that_is_too_long(self):
        name = "x" * 300 + ".ply"
        os.mkdir("out")
        self.fail_with(f"{name}: cannot be read: File name too long", of=("info", name))
        self.fail_with(f"{name}: cannot be written: File name too long",
                       of=("embed", name, "--output-dir", "out", "--message", "1"))
        self.fail_with(f"{name}: cannot be written: File name too long",
                       of=("attack", "model.ply", name, "--noise", 1))

    def test_outputs(self):
        Path("there.ply").write_text("mine")
        key = ("--key-file", "my.key")
        self.fail_with("there.ply", "--force", of=("embed", "model.ply", "there.ply", *key))
        self.fail_with("would replace", of=("embed", "model.ply", "model.ply", "--force", *key))
        os.link("model.ply", "same.ply")
        self.fail_with("would replace", of=("attack", "model.ply", "same.ply", "--noise", 1, "--force"))
        self.fail_with("the folder no does not exist", of=("embed", "model.ply", "no/out.ply", *key))
        self.fail_with("cannot write .off", of=("embed", "model.ply", "out.off", *key))
        self.fail_with("only .vtp", of=("compare", "model.ply", "there.ply", "--output", "d.ply"))
        self.fail_with("spectrum to .csv", of=("harmonics", "model.ply", "out.ply"))
        self.fail_with("this is a folder", of=("embed", "model.ply", "/tmp", *key))

    def test_secrets_and_messages(self):
        self.fail_with("nothing to embed", of=("embed", "model.ply", "out.ply"))
        self.fail_with("cannot be read", of=("embed", "model.ply", "out.ply", "--key-file", "no.key"))
        Path("empty.key").write_text("")
        self.fail_with("is empty", of=("detect", "model.ply", "--key-file", "empty.key"))
        Path("large.key").write_bytes(b"x" * (1 << 20) + b"yz")
        self.fail_with("over 1 MiB", of=("detect", "model.ply", "--key-file", "large.key"))
        self.fail_with("is set, but empty", of=("detect", "model.ply"), secret="")
        self.fail_with("needs a terminal", of=("detect", "model.ply", "--ask-key"))
        self.fail_with("only one", of=("detect", "model.ply", "--ask-key", "--key-file", "my.key"))
        self.fail_with("write the bits", of=("embed", "model.ply", "out.ply", "--message", "10x"))
        self.fail_with("1024 bits", of=("embed", "model.ply", "out.ply", "--message", "10" * 600))
        self.fail_with("64 bits would move the surface by",
                       of=("embed", "model.ply", "out.ply", "--key-file", "my.key", "--distortion", 1e-4))

    def test_an_empty_name_of_a_key_file_is_not_no_secret(self):
        """As a script passes it whose variable is not set."""
        text = "--key-file is empty: name the file that holds the secret"
        for message in ((), ("--message", "1011")):
            self.fail_with(text, of=("embed", "model.ply", "out.ply", "--key-file", "", *message))
            self.fail_with(text, of=("detect", "model.ply", "--key-file=", *message))

    def test_a_secret_on_the_command_line_is_refused_and_not_repeated(self):
        for given in (("--key", "hunter2"), ("--key=hunter2",)):
            self.fail_with("not taken from the command line", of=("detect", "model.ply", *given))
            self.assertNotIn("hunter2", run("detect", "model.ply", *given).stderr)

    def test_numbers_out_of_all_range(self):
        huge = 99999999999
        for arguments in (("detect", "model.ply", "--bits", huge), ("info", "model.ply", "--threads", huge),
                          ("attack", "model.ply", "out.ply", "--smooth", huge),
                          ("attack", "model.ply", "out.ply", "--noise", 1, "--seed", huge),
                          ("harmonics", "model.ply", "out.csv", "--number", huge)):
            self.fail_with("--help", of=arguments)

    def test_text_and_names_that_are_no_utf8(self):
        self.fail_with("the text is not text in UTF-8: write it in UTF-8, or give its bits (--message)",
                       of=("embed", "model.ply", "out.ply", "--text", "\udcff"))
        self.fail_with("SPECTRAL_WATERMARK_KEY is not text in UTF-8: put a secret of any bytes into a file",
                       of=("embed", "model.ply", "out.ply"), secret="\udcff")
        os.rename("model.ply", "\udcff.ply")
        self.assertEqual(run("info", "\udcff.ply", errors="surrogateescape").returncode, DONE)

    def test_files_on_both_sides_of_an_option(self):
        self.succeed("embed", "model.ply", "--message", "1", "out.ply")

    def test_no_key_forgets_the_environment(self):
        self.succeed("embed", "model.ply", "out.ply", "--message", "1011", "--no-key", secret="a secret")
        self.assertIn("reads 1011", self.succeed("detect", "out.ply", "--bits", 4))

    def test_errors_of_filters_name_the_option(self):
        Path("flat.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n")
        attack = ("attack", "model.ply", "out.ply")
        for texts, *arguments in (
                (["model.ply: --scale: cannot be 0.0; the nearest is"], *attack, "--scale", 0),
                (["model.ply: --noise: cannot be -1.0; the nearest is 0.0"], *attack, "--noise", -1),
                (["model.ply: --noise-along-normals: cannot be -1.0; the nearest is 0.0"],
                 *attack, "--noise-along-normals", -1),
                (["model.ply: --stretch: ", "flattens the mesh; "], *attack, "--stretch", 0, 1, 1),
                (["model.ply: --smooth: cannot be -1; the nearest is 0"], *attack, "--smooth", -1),
                (["model.ply: --low-pass: cannot be 0; the nearest is 1"], *attack, "--low-pass", 0),
                (["model.ply: --quantize: cannot be 0; the nearest is 1"], *attack, "--quantize", 0),
                (["model.ply: --simplify: cannot be 120.0; the nearest is"], *attack, "--simplify", 120),
                (["model.ply: --remesh: cannot be 0.0; the nearest is"], *attack, "--remesh", 0),
                (["model.ply: --isosurface: cannot be 1; the nearest is"], *attack, "--isosurface", 1),
                (["model.ply: --crop: cannot be 100.0; the nearest is"], *attack, "--crop", 100),
                (["beyond what float holds; ", "scale the mesh"], *attack, "--translate", 1e300, 0, 0),
                (["close the holes"], "attack", "flat.obj", "out.ply", "--isosurface", 10),
                (["flat.obj: --scheme: ", "close it"], "detect", "flat.obj"),
                (["model.ply: --distortion: ", "bits would move the surface by"],
                 "embed", "model.ply", "out.ply", "--message", 1, "--distortion", 1e-7)):
            with self.subTest(texts[0]):
                self.fail_with(*texts, of=arguments)
                self.assert_no_property_is_named(run(*arguments).stderr)

    def assert_no_property_is_named(self, text):
        for name in ("MaximumDistortion", "AxisScaleFactors", "IsosurfaceResolution", "OutputPointsPrecision",
                     "PaperSlots", "FirstComponent", "vtk"):
            self.assertNotIn(name, text)

    def test_components_that_could_be_moved_against_each_other(self):
        """The remedy in the property FirstComponent has no option, so the program does not name it."""
        corners = [f"v {3 * k + x} {y} {z}\n" for k in range(30)
                   for x, y, z in ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))]
        faces = [f"f {4 * k + a} {4 * k + b} {4 * k + c}\n" for k in range(30)
                 for a, b, c in ((1, 3, 2), (1, 2, 4), (2, 3, 4), (1, 4, 3))]
        Path("many.obj").write_text("".join(corners + faces))
        arguments = ("embed", "many.obj", "out.ply", "--scheme", "paper", "--message", 1)
        self.fail_with("many.obj: the mesh has 30 components", "against each other; ",
                       "take the largest component alone", of=arguments)
        self.assert_no_property_is_named(run(*arguments).stderr)

    def test_values_that_no_option_takes(self):
        for text, *arguments in (
                ("the text is empty", "embed", "model.ply", "out.ply", "--text", ""),
                ("'x' is not a number above 0", "embed", "model.ply", "out.ply", "--distortion", "x"),
                ("'0' is not a whole number of at least 1, or too large",
                 "harmonics", "model.ply", "out.vtp", "--number", "0"),
                ("'1.5' is not a whole number of at least 1, or too large", "detect", "model.ply", "--bits", "1.5"),
                ("is not a whole number of at least 1, or too large", "detect", "model.ply", "--bits", "9" * 5000),
                ("'nan' is not a finite number", "attack", "model.ply", "out.ply", "--noise", "nan"),
                ("'inf' is not a finite number", "attack", "model.ply", "out.ply", "--stretch", "1", "inf", "1"),
                ("'x' is not a finite number", "attack", "model.ply", "out.ply", "--crop", "x"),
                ("'1.5' is not a whole number", "attack", "model.ply", "out.ply", "--seed", "1.5"),
                ("'2' is not a number above 0 and at most 1", "detect", "model.ply", "--false-positive-rate", "2"),
                ("name it .html", "report", "model.ply", "marked.ply", "page.pdf", "--key-file", "my.key"),
                ("are given together", "detect", "model.ply", "--no-key", "--key-file", "my.key")):
            with self.subTest(text):
                self.fail_with(text, of=arguments)

    def test_options(self):
        self.fail_with("--help", of=())
        self.fail_with("invalid choice", of=("destroy", "model.ply"))
        self.fail_with("IN and OUT", of=("embed", "model.ply", "--message", "1"))
        self.fail_with("no attack", of=("attack", "model.ply", "out.ply"))
        self.fail_with("midpoint, loop or sqrt3",
                       of=("attack", "model.ply", "out.ply", "--subdivide", "catmull"))
        self.fail_with("cannot be 120", of=("attack", "model.ply", "out.ply", "--simplify", 120))
        self.fail_with("not a whole number of at least 1", of=("harmonics", "model.ply", "out.csv", "--number", 0))
        self.fail_with("not a number above 0",
                       of=("embed", "model.ply", "out.ply", "--message", "1", "--distortion", "-1"))
        self.fail_with("two of the files", of=("embed", "model.ply", "./model.ply", "--output-dir", "out",
                                               "--message", "1"))

    def test_what_does_not_go_together(self):
        self.fail_with("--read and a message are both given: read the bits, or look for a message",
                       of=("detect", "model.ply", "--read", "--message", "1", "--key-file", "my.key"))
        self.fail_with("nothing to look for: give the secret (--key-file FILE), or the message that was embedded",
                       of=("report", "model.ply", "model.ply", "page.html"))
        self.fail_with("my.key: the folder cannot be created: File exists",
                       of=("embed", "model.ply", "--output-dir", "my.key", "--message", "1"))

    def test_two_runs_of_the_same_mesh_without_volume(self):
        Path("flat.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n")
        self.fail_with("flat.obj", "volume", of=("embed", "flat.obj", "out.ply", "--message", "1"))

    def test_mistyped_options(self):
        self.fail_with("did you mean --key-file?", "spectral-watermark embed --help",
                       of=("embed", "model.ply", "out.ply", "--keyfile", "my.key"))
        self.fail_with("70 percent of the diagonal would deform the mesh",
                       of=("embed", "model.ply", "out.ply", "--key-file", "my.key", "--distortion", "70"))


class FaultTest(InFolder):
    def run_with(self, spoilt, *arguments):
        """The program, with one of its functions replaced."""
        script = ("import sys\nfrom unittest import mock\n"
                  "from spectralwatermark.cli import main\n"
                  "from spectralwatermark.cli.commands import embed\n"
                  "from spectralwatermark.execution import FilterError\n"
                  f"with mock.patch({spoilt}):\n    sys.exit(main(sys.argv[1:]))\n")
        return subprocess.run([sys.executable, "-c", script, *arguments], stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, check=False)

    def test_a_mark_that_is_not_read_back_is_not_written(self):
        done = self.run_with("'spectralwatermark.cli.commands.embed.vtkSpectralWatermarkEmbed', type('Fails', ("
                             "embed.vtkSpectralWatermarkEmbed,), {'GetConverged': lambda self: 0})",
                             "embed", "model.ply", "out.ply", "--key-file", "my.key")
        self.assertEqual((done.returncode, done.stdout), (ERROR, ""), done)
        self.assertEqual(done.stderr, "spectral-watermark: model.ply: the embedded mark cannot be read back; nothing "
                                      "was written. Try fewer bits or a larger --distortion\n")
        self.assertEqual({path.name for path in self.folder.iterdir()}, {"model.ply", "my.key", "other.key"})

    def test_what_nobody_thought_of_is_an_error_in_one_line(self):
        """In what is done before, in the process that works, and in what it does to one file."""
        for function, file in (("tasks.tasks_of", ""), ("commands.run", ""),
                               ("mesh_info.describe", "model.ply: ")):
            done = self.run_with(f"'spectralwatermark.cli.{function}', side_effect=ValueError('a\\nb')",
                                 "info", "model.ply")
            self.assertEqual((done.returncode, done.stdout), (ERROR, ""), done)
            self.assertEqual(done.stderr, f"spectral-watermark: {file}ValueError: a b; please report this\n")

    def test_an_error_is_put_together_from_its_parts(self):
        """The option that stands for a property depends on the command; a property without one is left out."""
        embed = ("embed", "model.ply", "out.ply", "--key-file", "my.key")
        attack = ("attack", "model.ply", "out.ply", "--noise", "1")
        for said, error, arguments in (
                ("--distortion: too much; raise it", ("MaximumDistortion", "too much", "raise it"), embed),
                ("--distortion: too much", ("MaximumDistortion", "too much", ""), embed),
                ("too much; choose 31", ("FirstComponent", "too much", "choose 31"), embed),
                ("text", (), embed),
                ("--low-pass: too many", ("NumberOfHarmonics", "too many", ""), attack),
                ("--number: too many", ("NumberOfHarmonics", "too many", ""), ("harmonics", "model.ply", "out.csv"))):
            done = self.run_with("'spectralwatermark.cli.commands.filters.update', "
                                 f"side_effect=FilterError(*{('text', *error)})", *arguments)
            self.assertEqual((done.returncode, done.stdout), (ERROR, ""), done)
            self.assertEqual(done.stderr, f"spectral-watermark: model.ply: {said}\n")

    def test_a_full_disk_leaves_no_file(self):
        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))

        self.fail_with("not written", of=("attack", "model.ply", "out.ply", "--noise", 1),
                       preexec_fn=limit)
        self.fail_with("out.csv: cannot be written: File too large",
                       of=("harmonics", "model.ply", "out.csv", "--number", 30), preexec_fn=limit)

    def test_a_full_disk_for_what_is_printed(self):
        text = "spectral-watermark: the output cannot be written: No space left on device\n"
        shutil.copy("model.ply", "second.ply")
        for arguments in (("info", "model.ply"), ("info", "model.ply", "second.ply"),
                          ("info", "model.ply", "second.ply", "--json"), ("--help",), ("--version",),
                          ("embed", "--help")):
            with open("/dev/full", "w") as full:
                done = subprocess.run([sys.executable, PROGRAM, *arguments], stdin=subprocess.DEVNULL, stdout=full,
                                      stderr=subprocess.PIPE, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (ERROR, text))

    def interrupted(self, *arguments, by, when):
        """What the program says when the signal comes as soon as when() holds."""
        with subprocess.Popen([sys.executable, PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True) as process:
            end = time.monotonic() + 60
            while not when(process.pid):
                self.assertIsNone(process.poll())
                self.assertLess(time.monotonic(), end)
                time.sleep(0.01)
            process.send_signal(by)
            _, said = process.communicate(timeout=60)
        self.assertEqual(process.returncode, ERROR, said)
        return said

    @staticmethod
    def has_loaded_vtk(pid):
        """The process that works, a child of the one that was started."""
        for folder in Path("/proc").glob("[0-9]*"):
            try:
                if int((folder / "stat").read_text().rsplit(")", 1)[1].split()[1]) == pid:
                    return "vtkIOPLY" in (folder / "maps").read_text()
            except (OSError, ValueError):  # it ended meanwhile
                pass
        return False

    def test_asked_twice_it_ends_at_once(self):
        """Also in a filter that would not report progress for minutes."""
        with subprocess.Popen([sys.executable, PROGRAM, "info", "model.ply", "--capacity"],
                              stderr=subprocess.PIPE, text=True) as process:
            end = time.monotonic() + 60
            while not self.has_loaded_vtk(process.pid):
                self.assertLess(time.monotonic(), end)
                time.sleep(0.01)
            time.sleep(3)  # in the filter by now
            process.send_signal(signal.SIGINT)
            time.sleep(0.5)
            process.send_signal(signal.SIGINT)
            _, said = process.communicate(timeout=10)
        self.assertEqual(process.returncode, ERROR)
        self.assertIn("stopped", said)

    def test_a_signal_in_the_filter_leaves_no_file(self):
        before = set(self.folder.iterdir())
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
            said = self.interrupted(
                "attack", "model.ply", "out.ply", *("--subdivide", "midpoint") * 4, "--low-pass", 400,
                by=number, when=self.has_loaded_vtk)
            self.assertIn("stopped", said)
            self.assertEqual(set(self.folder.iterdir()), before)

    def test_a_signal_while_writing_leaves_no_part_of_a_file(self):
        """What is begun is written to its end, which is soon."""
        with subprocess.Popen([sys.executable, PROGRAM, "attack", "model.ply", "out.ply",
                               *("--subdivide", "midpoint") * 3], stdout=subprocess.DEVNULL,
                              stderr=subprocess.DEVNULL) as process:
            end = time.monotonic() + 60
            while not list(self.folder.glob(".*.partial.ply")):
                self.assertIsNone(process.poll())
                self.assertLess(time.monotonic(), end)
            process.send_signal(signal.SIGTERM)
        self.assertEqual(process.returncode, DONE)
        self.assertEqual(list(self.folder.glob(".*")), [])
        self.succeed("info", "out.ply")

    def test_many_files_stop_together(self):
        for number in range(6):
            shutil.copy("model.ply", f"{number}.ply")
        said = self.interrupted("embed", *(f"{number}.ply" for number in range(6)), "--output-dir", "out",
                                "--key-file", "my.key", "--jobs", 2, by=signal.SIGINT,
                                when=lambda pid: Path(f"/proc/{pid}/task/{pid}/children").exists()
                                and list(Path("out").glob("*.ply")))
        self.assertIn("stopped", said)
        self.assertNotIn("Traceback", said)
        self.assertEqual(list(Path("out").glob(".*")), [])
        self.assertLess(len(list(Path("out").iterdir())), 6)


class TerminalTest(InFolder):
    def on_a_terminal(self, *arguments, typed=b"", again=b""):
        """What a person sees, and the exit code."""
        pid, terminal = pty.fork()
        if pid == 0:
            os.environ.pop("SPECTRAL_WATERMARK_KEY", None)
            termios.tcsetwinsize(0, (24, 80))
            os.execv(sys.executable, [sys.executable, PROGRAM, *map(str, arguments)])
        seen = b""
        while True:
            ready, _, _ = select.select([terminal], [], [], 60)
            self.assertTrue(ready, seen)
            try:
                part = os.read(terminal, 65536)
            except OSError:  # the other side was closed
                break
            seen += part
            if not part:
                break
            if part.rstrip().endswith(b":") and typed:
                os.write(terminal, typed)
                typed = again or typed
        _, status = os.waitpid(pid, 0)
        return seen.decode(), os.waitstatus_to_exitcode(status)

    def test_progress_and_prompt(self):
        seen, code = self.on_a_terminal("embed", "model.ply", "marked.ply", "--ask-key",
                                        typed=b"a secret for the test\n")
        self.assertEqual(code, DONE, seen)
        self.assertIn("Secret:", seen)
        self.assertIn("Once more:", seen)
        self.assertIn("embedding", seen)
        self.assertIn("left", seen)
        self.assertNotIn("a secret for the test", seen)
        self.assertIn("mine", self.succeed("detect", "marked.ply", "--key-file", "my.key"))


    def test_prompts_that_lead_nowhere(self):
        for typed, text in ((b"\n", "no secret was typed"), (b"one\n", "the two differ: nothing was done"),
                            (b"\4", "no secret was typed"), (b"\3", "spectral-watermark: stopped"),
                            (b"\xff\n", "the secret is not text in UTF-8: put a secret of any bytes into a file")):
            seen, code = self.on_a_terminal("embed", "model.ply", "marked.ply", "--ask-key", typed=typed,
                                            again=b"another\n")
            self.assertEqual(code, ERROR, seen)
            self.assertIn(text, seen)
            self.assertFalse(Path("marked.ply").exists())


class HelpTest(unittest.TestCase):
    def test_every_help_teaches_by_example(self):
        for command in ("embed", "detect", "attack", "compare", "harmonics", "info", "report"):
            done = run(command, "--help")
            self.assertEqual(done.returncode, DONE)
            self.assertIn(f"\n  spectral-watermark {command} ", done.stdout)

    def test_the_programs_own_help_teaches_a_first_time(self):
        done = run("--help")
        self.assertEqual((done.returncode, done.stderr), (DONE, ""))
        for command in ("embed", "detect", "attack", "compare"):
            self.assertIn(f"\n  spectral-watermark {command} ", done.stdout)
        for command in ("harmonics", "info", "report"):
            self.assertRegex(done.stdout, rf"\n +{command}\s+\w")

    def test_version(self):
        self.assertRegex(run("--version").stdout, r"^spectral-watermark \d+\.\d+\.\d+\n$")

    def test_no_secret_in_any_help(self):
        self.assertNotIn("--key ", "".join(run(command, "--help").stdout
                                           for command in ("embed", "detect")))


if __name__ == "__main__":
    unittest.main()
