# SPDX-License-Identifier: BSD-3-Clause
"""A million triangles through all that the program does, in the memory of a small machine."""

import json
import os
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("SPECTRALWATERMARK_PROGRAM", str(ROOT / "build/bin/spectral-watermark"))
SCAN = Path(os.environ.get("SPECTRALWATERMARK_MESH_DIR", ROOT.parent / "shared" / "meshes"), "igea.ply")
TRIANGLES = 1_074_744  # of igea, each divided into four
MOST_MEMORY = 12e9


@unittest.skipUnless(os.environ.get("SPECTRALWATERMARK_FULL_TESTS"), "large: run by ./test.sh --full")
@unittest.skipUnless(SCAN.exists(), f"there is no {SCAN}; set SPECTRALWATERMARK_MESH_DIR")
class LargeTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / "my.key").write_text("a secret for the test\n")

    def succeed(self, *arguments, codes=(0,)):
        """What the program prints; its seconds and memory are told."""
        begin = time.monotonic()
        with subprocess.Popen([sys.executable, PROGRAM, *map(str, arguments)], cwd=self.folder, text=True,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE) as process:
            said = process.stdout.read()
            _, status, usage = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
        memory = 1024 * usage.ru_maxrss  # of the process, or of the largest that it waited for
        print(f"{arguments[0]}: {time.monotonic() - begin:.1f} s, {memory / 1e9:.2f} GB", file=sys.stderr)
        self.assertIn(process.returncode, codes, said)
        self.assertLess(memory, MOST_MEMORY)
        return said

    def test_a_million_triangles(self):
        key = ("--key-file", "my.key")
        self.succeed("attack", SCAN, "large.ply", "--subdivide", "midpoint")
        self.assertEqual(json.loads(self.succeed("info", "large.ply", "--json"))["triangles"], TRIANGLES)
        self.succeed("embed", "large.ply", "marked.ply", *key)
        self.succeed("attack", "marked.ply", "copy.ply", "--similarity", "--noise", 0.1, "--simplify", 50)
        self.assertIn("mine", self.succeed("detect", "copy.ply", *key))
        self.assertIn("not mine", self.succeed("detect", "large.ply", *key, codes=(1,)))
        self.succeed("harmonics", "large.ply", "spectrum.csv", "--number", 200)
        self.succeed("embed", "large.ply", "paper.ply", *key, "--scheme", "paper", "--bits", 12)
        paper = json.loads(self.succeed("detect", "paper.ply", *key, "--scheme", "paper", "--bits", 12,
                                        "--json", "--false-positive-rate", 1e-3))
        self.assertIs(paper["found"], True)
        compared = json.loads(self.succeed("compare", "large.ply", "marked.ply", "--json"))
        self.assertGreater(compared["msdm2"], 0.0)


if __name__ == "__main__":
    unittest.main()
