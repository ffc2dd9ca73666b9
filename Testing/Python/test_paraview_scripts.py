# SPDX-License-Identifier: BSD-3-Clause
"""What ParaView's scripts say before there is a plugin, and to arguments that they do not know."""

import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

PARAVIEW = Path("Wrapping", "ParaView")
ROOT = Path(__file__).resolve().parents[2]


class ParaViewScriptsTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        (self.folder / PARAVIEW).mkdir(parents=True)
        for name in ("build.sh", "start.sh"):
            shutil.copy(ROOT / PARAVIEW / name, self.folder / PARAVIEW)

    def assert_refused(self, text, name, *arguments):
        done = subprocess.run([self.folder / PARAVIEW / name, *arguments], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (2, "", text + "\n"))

    def test_start_without_a_plugin(self):
        self.assert_refused("The plugin is not built yet: run Wrapping/ParaView/build.sh", "start.sh")

    def test_what_is_no_program_and_no_model(self):
        (self.folder / "build/paraview/lib/paraview-plugins").mkdir(parents=True)
        self.assert_refused("usage: Wrapping/ParaView/start.sh [paraview|pvbatch|pvpython] [ARGUMENTS]",
                            "start.sh", "no-such-model.ply")

    def test_build_takes_no_arguments(self):
        self.assert_refused("usage: Wrapping/ParaView/build.sh", "build.sh", "--help")
        self.assertFalse((self.folder / "build").exists())


if __name__ == "__main__":
    unittest.main()
