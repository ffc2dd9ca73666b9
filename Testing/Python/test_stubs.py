# SPDX-License-Identifier: BSD-3-Clause
"""What editors and type checkers are told of the filters is what the filters have."""

import ast
import inspect
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import spectralwatermark
from spectralwatermark import vtkFiltersSpectralWatermark as module

STUB = Path(spectralwatermark.__file__).with_name("vtkFiltersSpectralWatermark.pyi")


class StubsTest(unittest.TestCase):
    def test_every_class_and_method_is_in_the_stub(self):
        stubs = {node.name: {each.name for each in node.body if isinstance(each, ast.FunctionDef)}
                 for node in ast.parse(STUB.read_text()).body if isinstance(node, ast.ClassDef)}
        classes = {name: cls for name, cls in vars(module).items() if inspect.isclass(cls)}
        self.assertEqual(set(stubs), set(classes))
        for name, cls in classes.items():
            methods = {each for each, value in vars(cls).items()
                       if callable(value) and not inspect.isclass(value) and not each.startswith("__")}
            self.assertGreater(len(methods), 3)
            self.assertEqual(stubs[name] ^ methods, set(), f"{name}: run Wrapping/Python/make_stubs.sh")

    def test_the_package_says_that_it_is_typed(self):
        self.assertTrue(STUB.with_name("py.typed").exists())

    @unittest.skipUnless(shutil.which("mypy"), "mypy is not installed")
    def test_a_type_checker_finds_mistakes(self):
        good = ("from spectralwatermark import vtkSpectralWatermarkEmbed\n"
                "embed = vtkSpectralWatermarkEmbed()\n"
                "embed.SetSecretKeyFile('my.key')\n"
                "share: float = embed.GetDistortion()\n")
        self.assertEqual(self.errors_in(good), [])
        # Names that do not exist go unseen: Debian's VTK, where the filters' base is, has no stubs.
        for mistake in ("embed.SetMaximumDistortion('much')", "embed.SetMessage(10110)"):
            errors = self.errors_in(good + mistake + "\n")
            self.assertEqual([error.split(":")[1] for error in errors], ["5"], errors)

    def errors_in(self, text):
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "program.py").write_text(text)
            done = subprocess.run(
                ["mypy", "--python-executable", "/usr/bin/python3", "--ignore-missing-imports",
                 "--cache-dir", folder, "program.py"], cwd=folder, capture_output=True, text=True,
                env={"PATH": "/usr/bin:/bin", "MYPYPATH": str(STUB.parents[1])}, check=False)
            self.assertNotIn("error: Cannot find", done.stdout)
            return [line for line in done.stdout.splitlines()
                    if line.startswith("program.py:") and ": error:" in line]


if __name__ == "__main__":
    unittest.main()
