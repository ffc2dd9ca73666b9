# SPDX-License-Identifier: BSD-3-Clause
"""The samples of the README and of the package's page run exactly as they are printed."""

import contextlib
import io
import os
import re
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# The second page continues the sample of the first.
PAGES = ("README.md", "Wrapping/Python/README.md")


class ReadmeTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.addCleanup(os.chdir, Path.cwd())
        (Path(folder.name) / "Data").symlink_to(ROOT / "Data")
        (Path(folder.name) / "my.key").write_text("a secret for the test\n")
        os.chdir(folder.name)

    def test_python_blocks_run_one_after_the_other(self):
        pages = "".join((ROOT / page).read_text() for page in PAGES)
        blocks = re.findall(r"```python\n(.*?)```", pages, re.DOTALL)
        self.assertGreaterEqual(len(blocks), 2)
        names = {}
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            for block in blocks:
                exec(block, names)  # pylint: disable=exec-used
        self.assertIn("\nmine p = 5", printed.getvalue())
        self.assertIn("reads 110010111010 valid", printed.getvalue())
        self.assertIn("reads 10110", printed.getvalue())
        self.assertNotIn("not mine", printed.getvalue())
        self.assertEqual(names["basis"].shape[1], 100)

    def test_every_linked_file_exists(self):
        for page in ROOT.rglob("*.md"):
            if "build" in page.relative_to(ROOT).parts:
                continue
            for target in re.findall(r"\]\(([^)#:]+)\)", page.read_text()):
                self.assertTrue((page.parent / target).exists(), f"{page}: {target}")


if __name__ == "__main__":
    unittest.main()
