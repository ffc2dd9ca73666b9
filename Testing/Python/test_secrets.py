# SPDX-License-Identifier: BSD-3-Clause
"""Whoever sees what the filters and the program leave behind does not see the secret."""

import base64
import contextlib
import hashlib
import os
import shutil
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from spectralwatermark import vtkSpectralWatermarkDetect, vtkSpectralWatermarkEmbed
from spectralwatermark.io import read_mesh
from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkCommonDataModel import vtkTable
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLTableWriter

ROOT = Path(__file__).resolve().parents[2]
PEBBLE = ROOT / "Data" / "pebble.ply"
PROGRAM = os.environ.get("SPECTRALWATERMARK_PROGRAM", str(ROOT / "build/bin/spectral-watermark"))
SECRET = "Xq7vT2-only-the-owner-knows"


def forms_of(secret):
    """The secret, and what it could be hidden in: encodings, and the master key made from it."""
    plain = secret.encode()
    master = hashlib.blake2b(plain, key=b"SpectralWatermark v1", digest_size=32).digest()
    for raw in (plain, plain[:8], plain[::-1], master):
        yield raw
        yield raw.hex().encode()
        yield base64.b64encode(raw).rstrip(b"=")[:-1]
        yield raw.decode("latin-1").encode("utf-16-le")


def serialized(data):
    """All that a data object holds, as an XML file shows it."""
    writer = vtkXMLTableWriter() if isinstance(data, vtkTable) else vtkXMLPolyDataWriter()
    writer.SetDataModeToAscii()
    writer.SetInputData(data)
    with tempfile.TemporaryDirectory() as folder:
        writer.SetFileName(os.path.join(folder, "data.xml"))
        writer.Write()
        return Path(folder, "data.xml").read_bytes()


@contextlib.contextmanager
def everything_said():
    """What VTK says anywhere meanwhile, and what its logger keeps, of the most that it can tell."""
    window, before = vtkStringOutputWindow(), vtkOutputWindow.GetInstance()
    verbosity = vtkLogger.GetCurrentVerbosityCutoff()
    vtkOutputWindow.SetInstance(window)
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    said = []
    with tempfile.TemporaryDirectory() as folder:
        log = Path(folder, "log")
        vtkLogger.LogToFile(str(log), vtkLogger.TRUNCATE, vtkLogger.VERBOSITY_MAX)
        try:
            yield said
        finally:
            vtkLogger.EndLogToFile(str(log))
            vtkLogger.SetStderrVerbosity(verbosity)
            vtkOutputWindow.SetInstance(before)
            said.append(window.GetOutput() + log.read_text())


class SecretsTest(unittest.TestCase):
    def assert_without_secret(self, data, where):
        data = data.encode() if isinstance(data, str) else data
        for form in forms_of(SECRET):
            self.assertNotIn(form, data, where)

    def test_the_search_finds_what_it_looks_for(self):
        with self.assertRaises(AssertionError):
            self.assert_without_secret("key=" + SECRET, "")
        with self.assertRaises(AssertionError):
            self.assert_without_secret(base64.b64encode(SECRET.encode()), "")

    def test_filters_show_it_nowhere(self):
        mesh = read_mesh(PEBBLE)
        for scheme in (vtkSpectralWatermarkEmbed.Robust, vtkSpectralWatermarkEmbed.PaperSlots):
            with everything_said() as said:
                embed = vtkSpectralWatermarkEmbed()
                embed.SetInputData(mesh)
                detect = vtkSpectralWatermarkDetect()
                detect.SetInputConnection(embed.GetOutputPort())
                detect.UseDerivedMessageOn()
                for each in (embed, detect):
                    each.DebugOn()
                    each.SetScheme(scheme)
                    each.SetNumberOfBits(5)
                    each.SetSecretKey(SECRET)
                detect.Update()
            self.assertEqual(embed.GetConverged(), 1)
            for each in (embed, detect):
                self.assert_without_secret(str(each), "PrintSelf")
                self.assert_without_secret(repr(each), "repr")
                for port in (0, 1):
                    output = each.GetOutputDataObject(port)
                    self.assert_without_secret(serialized(output), "output")
                    self.assert_without_secret(str(output), "output's PrintSelf")
                    self.assert_without_secret(str(output.GetInformation()), "information")
            self.assertIn("vtkSpectralWatermarkDetect", said[0])
            self.assert_without_secret(said[0], "messages")

    def test_errors_do_not_tell_it(self):
        mesh = read_mesh(PEBBLE)
        with everything_said() as said:
            for spoil in (lambda each: each.SetSecretKeyFile("no such file"),
                          lambda each: each.SetNumberOfBits(5000),
                          lambda each: each.SetScheme(7)):
                for kind in (vtkSpectralWatermarkEmbed, vtkSpectralWatermarkDetect):
                    each = kind()
                    each.DebugOn()
                    each.SetInputData(mesh)
                    each.SetSecretKey(SECRET)
                    spoil(each)
                    each.Update()
        self.assertIn("ERR", said[0].upper())
        self.assert_without_secret(said[0], "errors")

    def test_the_program_leaves_it_nowhere(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            shutil.copy(PEBBLE, folder / "model.ply")
            (folder / "my.key").write_text(SECRET)
            seen = b""
            for arguments in (("embed", "model.ply", "marked.vtp"), ("detect", "marked.vtp", "--json"),
                              ("detect", "marked.vtp", "--read"), ("detect", "no-such.ply"),
                              ("embed", "model.ply", "model.ply"), ("embed", "model.ply", "m.ply", "--bits", "9000")):
                seen += self.run_program(folder, *arguments, SPECTRAL_WATERMARK_KEY=SECRET)
                seen += self.run_program(folder, *arguments, "--key-file", "my.key")
            seen += self.run_program(folder, "report", "model.ply", "marked.vtp", "page.html", "--key-file", "my.key")
            for more in ({"SPECTRAL_WATERMARK_KEY": SECRET}, {}):
                seen += self.run_program(folder, "detect", "marked.vtp", "model.ply", "--jobs", "2",
                                         *(() if more else ("--key-file", "my.key")), processes=3, **more)
            self.assertIn(b'"found": true', seen)
            self.assert_without_secret(seen, "what was printed, and the arguments of its processes")
            for path in folder.iterdir():
                if path.name != "my.key":
                    self.assert_without_secret(path.read_bytes(), path.name)

    def run_program(self, folder, *arguments, processes=1, **environment):
        """What it prints, and the arguments of its processes, of which at least `processes` must have been seen."""
        with subprocess.Popen([sys.executable, PROGRAM, *arguments], cwd=folder, env=os.environ | environment,
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT) as program:
            seen = self.arguments_below(program)
            self.assertGreaterEqual(len({process for process, _ in seen}), processes)
            return b"".join(arguments for _, arguments in seen) + program.communicate()[0]

    @staticmethod
    def arguments_below(program):
        """Each process of the program with its arguments, which every user of the machine can see."""
        seen = set()
        while program.poll() is None:
            pids = [program.pid]
            while pids:
                process = Path(f"/proc/{pids.pop()}")
                with contextlib.suppress(OSError):  # it ended meanwhile
                    seen.add((process, (process / "cmdline").read_bytes()))
                    for children in process.glob("task/*/children"):
                        pids += children.read_text().split()
            time.sleep(0.02)
        return seen


if __name__ == "__main__":
    unittest.main()
