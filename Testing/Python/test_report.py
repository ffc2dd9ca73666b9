# SPDX-License-Identifier: BSD-3-Clause
"""The report on a protected model is complete, needs no other file, and tells what the detector says."""

import base64
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path

from meshes import NOT_FINITE

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ.get("SPECTRALWATERMARK_PROGRAM", str(ROOT / "build/bin/spectral-watermark"))
CHROMIUM = shutil.which("chromium")


class Page(HTMLParser):
    """The sources of everything that a browser would load, and the cells of the tables."""

    def __init__(self, text):
        super().__init__()
        self.sources, self.rows, self.in_cell = [], [], False
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.sources += [value for name, value in attrs if name in ("src", "href")]
        if tag == "tr":
            self.rows.append([])
        self.in_cell = tag == "td"

    def handle_endtag(self, tag):
        self.in_cell = False

    def handle_data(self, data):
        if self.in_cell:
            self.rows[-1].append(data)


@unittest.skipUnless(shutil.which("xvfb-run"), "xvfb-run is not installed: nothing to draw on")
class ReportTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = Path(folder.name)
        (cls.folder / "my.key").write_text("a secret for the test\n")
        cls.run_program("attack", ROOT / "Data" / "pebble.ply", "model.ply", "--simplify", 85)
        cls.run_program("embed", "model.ply", "marked.ply", "--key-file", "my.key", "--bits", 16)
        done = cls.run_program("report", "model.ply", "marked.ply", "report.html", "--key-file", "my.key",
                               "--bits", 16, "--title", "A <stone>")
        cls.said = done.stdout
        cls.text = (cls.folder / "report.html").read_text()
        cls.page = Page(cls.text)

    @classmethod
    def run_program(cls, *arguments, check=True, **variables):
        environment = {name: value for name, value in os.environ.items() if name != "DISPLAY"}
        return subprocess.run([sys.executable, PROGRAM, *map(str, arguments)], cwd=cls.folder,
                              env=environment | variables, capture_output=True, text=True, check=check)

    def test_opens_without_any_other_file(self):
        self.assertGreaterEqual(len(self.page.sources), 4)
        for source in self.page.sources:
            self.assertTrue(source.startswith("data:image/png;base64,"), source[:60])
            self.assertEqual(base64.b64decode(source.split(",", 1)[1])[:4], b"\x89PNG")
        self.assertNotIn("http", re.sub("data:[^\"]*", "", self.text))

    def test_tells_what_the_detector_says(self):
        rows = {row[0]: row for row in self.page.rows if len(row) == 5}
        self.assertEqual(rows["the marked model"][2:], ["0 of 16", "1.5e-11", "found"])  # 2^-36
        self.assertEqual(rows["the unmarked original"][4], "not found")
        found = sum(row[4] == "found" for row in rows.values()) - 1
        self.assertIn(f"after {found} of {len(rows) - 2} attacks", self.text)
        self.assertIn(f"after {found} of {len(rows) - 2} attacks", self.said)
        self.assertGreaterEqual(found, 8)

    def test_escapes_and_keeps_the_secret(self):
        self.assertIn("<h1>A &lt;stone&gt;</h1>", self.text)
        self.assertNotIn("a secret for the test", self.text)

    def test_the_file_at_fault_is_named(self):
        (self.folder / "bad.ply").write_text(NOT_FINITE)
        (self.folder / "flat.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        for marked, text in (("bad.ply", "bad.ply: point 0 has a coordinate that is not finite"),
                             ("flat.obj", "model.ply and flat.obj: ")):
            done = self.run_program("report", "model.ply", marked, "other.html", "--key-file", "my.key", check=False)
            self.assertEqual((done.returncode, done.stdout), (2, ""), done)
            self.assertTrue(done.stderr.startswith(f"spectral-watermark: {text}"), done.stderr)
            self.assertFalse((self.folder / "other.html").exists())

    def test_so_few_bits_that_nothing_would_be_found(self):
        done = self.run_program("report", "model.ply", "marked.ply", "other.html", "--scheme", "paper",
                                "--message", "10", check=False)
        self.assertEqual((done.returncode, done.stdout), (2, ""), done)
        self.assertIn("2 bits cannot prove a mark at a false positive rate of 1e-06", done.stderr)
        self.assertFalse((self.folder / "other.html").exists())

    def test_without_a_message_to_look_for(self):
        script = """
from spectralwatermark import vtkSpectralWatermarkDetect
from spectralwatermark.io import read_mesh
from spectralwatermark.report import write_report
from spectralwatermark.execution import FilterError
mesh = read_mesh("model.ply")
try:
    write_report(mesh, mesh, "other.html", vtkSpectralWatermarkDetect)
except FilterError as error:
    print(error)
"""
        done = subprocess.run(["xvfb-run", "-a", sys.executable, "-c", script], cwd=self.folder, capture_output=True,
                              text=True, check=False)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(done.stdout, "the report needs a message to look for: set a secret key and "
                                      "UseDerivedMessage, or ExpectedMessage\n")
        self.assertFalse((self.folder / "other.html").exists())

    def test_nothing_to_draw_on(self):
        tools = self.folder / "tools"
        tools.mkdir()
        broken = tools / "Xvfb"
        for text in ("it needs a display, or a virtual one", "the virtual display (Xvfb) did not start"):
            done = self.run_program("report", "model.ply", "marked.ply", "other.html", "--key-file", "my.key",
                                    "--bits", 16, check=False, PATH=str(tools))
            self.assertEqual((done.returncode, done.stdout), (2, ""), done)
            self.assertIn(text, done.stderr)
            self.assertFalse((self.folder / "other.html").exists())
            broken.write_text("#!/bin/sh\nexit 1\n")
            broken.chmod(0o755)

    def test_a_missing_library_is_named_with_its_package(self):
        for library in ("jinja2", "matplotlib"):
            folder = self.folder / f"without_{library}"
            folder.mkdir()
            (folder / f"{library}.py").write_text(
                f"raise ModuleNotFoundError(\"No module named '{library}'\", name='{library}')\n")
            path = os.pathsep.join(filter(None, [str(folder), os.environ.get("PYTHONPATH")]))
            done = self.run_program("report", "model.ply", "marked.ply", "other.html", "--key-file", "my.key",
                                    "--bits", 16, check=False, PYTHONPATH=path)
            self.assertEqual((done.returncode, done.stdout), (2, ""), done)
            self.assertEqual(done.stderr, f"spectral-watermark: reports need the Python module {library} (Debian: "
                                          f"apt install python3-{library})\n")
            self.assertFalse((self.folder / "other.html").exists())

    @unittest.skipUnless(CHROMIUM, "chromium is not installed")
    def test_a_browser_shows_every_picture(self):
        script = ("<script>addEventListener('load', () => { document.title = [...document.images].every("
                  "i => i.complete && i.naturalWidth > 400) + ' ' + document.images.length; });</script>")
        page = self.folder / "with_script.html"
        page.write_text(self.text.replace("</body>", script + "</body>"))
        done = subprocess.run(
            [CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=5000",
             "--dump-dom", page.as_uri()], capture_output=True, text=True, timeout=120, check=True)
        title = re.search("<title>(.*?)</title>", done.stdout)[1]
        self.assertEqual(title, f"true {len(self.page.sources)}")


if __name__ == "__main__":
    unittest.main()
