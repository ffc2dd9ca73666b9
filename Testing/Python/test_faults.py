# SPDX-License-Identifier: BSD-3-Clause
"""What the machine may do to the program: kill it, forbid it to write, leave it no memory."""

import contextlib
import json
import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

from spectralwatermark.io import read_mesh

ROOT = Path(__file__).resolve().parents[2]
PEBBLE = ROOT / "Data" / "pebble.ply"
PROGRAM = os.environ.get("SPECTRALWATERMARK_PROGRAM", str(ROOT / "build/bin/spectral-watermark"))
KILLS = 200 if os.environ.get("SPECTRALWATERMARK_FULL_TESTS") else 20
DONE, ERROR = 0, 2

# For root, permissions are no obstacle, unless this is taken away.
AS_ANYONE = [] if os.geteuid() else ["setpriv", "--bounding-set=-dac_override,-dac_read_search"]


class InFolder(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        shutil.copy(PEBBLE, self.folder / "model.ply")
        (self.folder / "my.key").write_text("a secret for the test\n")

    def command(self, *arguments):
        return [sys.executable, PROGRAM, *map(str, arguments)]

    def run_in_folder(self, *command, **more):
        return subprocess.run(command, cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True,
                              text=True, check=False, **more)

    def files(self):
        return {path.name: path.read_bytes() for path in self.folder.iterdir() if path.is_file()}

    def assert_refused(self, done, *texts):
        self.assertEqual((done.returncode, done.stdout), (ERROR, ""), done)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        for text in texts:
            self.assertIn(text, done.stderr)


class KilledTest(InFolder):
    """The program is killed outright, which it cannot answer: the output's name has the whole file, what it
    had before, or nothing."""

    def kill_again_and_again(self, command, seconds):
        whole = self.folder / "whole.ply"
        done = self.run_in_folder(*command(whole))
        self.assertEqual(done.returncode, DONE, done)
        model, marked = PEBBLE.read_bytes(), whole.read_bytes()
        key = (self.folder / "my.key").read_bytes()
        target = self.folder / "out.ply"
        delays = random.Random(7)
        seen = {"before": 0, "while writing": 0, "after": 0}
        for number in range(KILLS):
            before = b"what was there" if number % 2 else None
            if before:
                target.write_bytes(before)
            with subprocess.Popen(command(target), cwd=self.folder, stdin=subprocess.DEVNULL,
                                  stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                  start_new_session=True) as process:
                self.wait_for_the_moment(process, delays, seconds, at_the_file=number % 4 >= 2)
                with contextlib.suppress(ProcessLookupError):  # it was faster
                    os.killpg(process.pid, signal.SIGKILL)
            after = target.read_bytes() if target.exists() else None
            self.assertIn(after, (before, marked), f"kill {number}")
            self.assertEqual((self.folder / "model.ply").read_bytes(), model)
            self.assertEqual((self.folder / "my.key").read_bytes(), key)
            parts = list(self.folder.glob(".*.partial.ply"))
            seen["after" if after == marked else "while writing" if parts else "before"] += 1
            for path in (*parts, target):
                path.unlink(missing_ok=True)
        print(f"{KILLS} kills of {command(target)[2]}: {seen}", file=sys.stderr)
        self.assertGreater(seen["before"], 0)
        self.assertGreater(seen["while writing"], 0)

    def wait_for_the_moment(self, process, delays, seconds, at_the_file):
        """Any moment of the run; or one as the file is being written."""
        end = time.monotonic() + (60 if at_the_file else delays.uniform(0.0, 1.1 * seconds))
        while time.monotonic() < end and process.poll() is None:
            if at_the_file and list(self.folder.glob(".*.partial.ply")):
                time.sleep(delays.uniform(0.0, 0.02))
                return
            time.sleep(0.001)

    def timed(self, command):
        begin = time.monotonic()
        self.run_in_folder(*command)
        return time.monotonic() - begin

    def test_while_embedding(self):
        def command(target):
            return self.command("embed", "model.ply", target, "--force", "--bits", 16, "--key-file", "my.key")

        self.kill_again_and_again(command, self.timed(command("first.ply")))

    def test_while_writing_much(self):
        def command(target):
            return self.command("attack", "model.ply", target, "--force", "--subdivide", "midpoint",
                                "--subdivide", "midpoint")

        self.kill_again_and_again(command, self.timed(command("first.ply")))


class ForbiddenTest(InFolder):
    def test_a_folder_that_may_not_be_written(self):
        locked = self.folder / "locked"
        locked.mkdir()
        (locked / "old.ply").write_text("old")
        locked.chmod(0o500)
        self.addCleanup(locked.chmod, 0o700)
        for name in ("new.ply", "old.ply"):
            done = self.run_in_folder(*AS_ANYONE, *self.command(
                "attack", "model.ply", f"locked/{name}", "--noise", 1, "--force"))
            self.assert_refused(done, f"locked/{name}", "no permission to write to the folder locked; choose another folder")
        self.assertEqual([path.name for path in locked.iterdir()], ["old.ply"])
        self.assertEqual((locked / "old.ply").read_text(), "old")

    def test_a_file_that_may_not_be_written_stays(self):
        """Renaming could replace it, but whoever locked it did not want that."""
        old = self.folder / "old.ply"
        old.write_text("old")
        old.chmod(0o400)
        done = self.run_in_folder(*AS_ANYONE, *self.command(
            "attack", "model.ply", "old.ply", "--noise", 1, "--force"))
        self.assert_refused(done, "old.ply", "it is read-only")
        self.assertEqual(old.read_text(), "old")

    def test_files_that_may_not_be_read(self):
        for name in ("model.ply", "my.key"):
            path = self.folder / name
            path.chmod(0o000)
            done = self.run_in_folder(*AS_ANYONE, *self.command(
                "embed", "model.ply", "out.ply", "--key-file", "my.key"))
            path.chmod(0o600)
            self.assert_refused(done, name, "cannot be read")
        self.assertNotIn("out.ply", self.files())

    def test_a_folder_that_may_not_be_entered(self):
        locked = self.folder / "locked"
        locked.mkdir()
        locked.chmod(0o600)
        self.addCleanup(locked.chmod, 0o700)
        for done, *arguments in (("read", "info", "locked/a.ply"),
                                 ("read", "compare", "model.ply", "locked/a.ply"),
                                 ("written", "attack", "model.ply", "locked/a.ply", "--noise", 1),
                                 ("written", "embed", "model.ply", "--output-dir", "locked", "--message", 1)):
            said = self.run_in_folder(*AS_ANYONE, *self.command(*arguments))
            self.assert_refused(said, "locked/", f"cannot be {done}: Permission denied")

    def test_without_a_folder_for_temporary_files(self):
        """None is needed: not the system's, nor the user's."""
        (self.folder / "sitecustomize.py").write_text(  # where none is named, Python tries /tmp and others
            "import tempfile\ntempfile._candidate_tempdir_list = lambda: ['/nowhere']\n")
        environment = os.environ | {"HOME": "/nowhere/at/all", "PYTHONPATH": os.pathsep.join(
            [str(self.folder), *filter(None, [os.environ.get("PYTHONPATH")])])}
        commands = [("attack", "model.ply", "small.ply", "--simplify", 85),
                    ("embed", "small.ply", "out.ply", "--key-file", "my.key", "--bits", 16),
                    ("detect", "out.ply", "--key-file", "my.key", "--bits", 16),
                    ("compare", "small.ply", "out.ply"),
                    ("info", "out.ply")]
        if shutil.which("Xvfb"):
            commands.append(("report", "small.ply", "out.ply", "page.html", "--key-file", "my.key", "--bits", 16))
        for arguments in commands:
            done = self.run_in_folder(*self.command(*arguments), env=environment)
            self.assertEqual((done.returncode, done.stderr), (DONE, ""), done)
        self.assertEqual(list(self.folder.glob(".*")), [])


# A disk of 64 KiB that only the command sees; what is left on it is printed.
SMALL_DISK = ["unshare", "-rm", "sh", "-c",
              'mount -t tmpfs -o size=64k none full && "$@"; code=$?; ls -A full; exit $code', "sh"]


class FullDiskTest(InFolder):
    def setUp(self):
        super().setUp()
        (self.folder / "full").mkdir()
        done = self.run_in_folder(*SMALL_DISK, "true")
        if done.returncode:
            self.skipTest(f"a user may not mount a small disk here: {done.stderr.strip()}")

    def assert_full(self, text, *arguments):
        self.assert_refused(self.run_in_folder(*SMALL_DISK, *self.command(*arguments)), text)

    def test_meshes(self):
        for suffix in (".ply", ".obj", ".stl", ".vtp"):
            target = f"full/out{suffix}"
            self.assert_full(f"{target}: not written: VTK did not write all of it; is the disk full?\n",
                             "attack", "model.ply", target, "--noise", 1)

    def test_tables_and_pages(self):
        self.run_in_folder(*self.command("attack", "model.ply", "small.ply", "--simplify", 85))
        commands = [("harmonics", "small.ply", "full/out.csv", "--number", 900)]
        if shutil.which("Xvfb"):
            commands.append(("report", "small.ply", "small.ply", "full/out.html", "--message", "10" * 10))
        for command in commands:
            self.assert_full("cannot be written: No space left on device\n", *command)


class MemoryTest(InFolder):
    def test_too_little_memory_is_said_before_the_work(self):
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30))

        done = self.run_in_folder(*self.command("attack", "model.ply", "out.ply", "--isosurface", 1024),
                                  preexec_fn=limit)
        self.assert_refused(done, "model.ply: --isosurface: ", "1024 steps along the longest side need about ",
                            " of memory, and ", " are free; ")
        self.assertNotIn("out.ply", self.files())

    def test_a_file_larger_than_memory_is_not_read(self):
        for suffix in (".ply", ".obj", ".stl", ".vtp", ".off"):
            with open(self.folder / ("huge" + suffix), "wb") as file:
                file.truncate(1 << 40)  # takes no room on the disk
            done = self.run_in_folder(*self.command("info", "huge" + suffix))
            self.assert_refused(done, f"huge{suffix}: reading it needs at least ", " GB of memory, but only ",
                                " GB are free; close other programs")

    def test_being_killed_is_said(self):
        """As the system does where a process takes memory that is not there; or as a reader that crashes."""
        for number, text in ((signal.SIGKILL, "not done: killed, as the system does when memory runs out; close "
                                              "other programs"),
                             (signal.SIGSEGV, "the process that read it ended with -11; is the file damaged?")):
            with self.started("info", "model.ply", "--capacity") as process:
                os.kill(self.children_of(process, 1)[0], number)
                said, error = process.communicate()
            self.assertEqual((process.returncode, said), (ERROR, ""))
            self.assertEqual(error, f"spectral-watermark: model.ply: {text}\n")

    def test_one_of_several_that_is_killed_does_not_stop_the_rest(self):
        shutil.copy(PEBBLE, self.folder / "second.ply")
        with self.started("info", "model.ply", "second.ply", "--jobs", 2, "--json") as process:
            os.kill(self.children_of(process, 2)[0], signal.SIGKILL)
            said, error = process.communicate()
        self.assertEqual(process.returncode, ERROR)
        results = [json.loads(line) for line in said.splitlines()]
        self.assertEqual([result["file"] for result in results], ["model.ply", "second.ply"])
        killed = [result for result in results if "error" in result]
        self.assertEqual([result["error"] for result in killed], [
            f"{result['file']}: not done: killed, as the system does when memory runs out; close other programs"
            for result in killed])
        self.assertEqual((len(killed), sum("vertices" in result for result in results)), (1, 1))
        self.assertIn("2 files: 1 done, 1 failed", error)

    def started(self, *arguments):
        return subprocess.Popen(self.command(*arguments), cwd=self.folder, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)

    @staticmethod
    def children_of(process, number):
        """As soon as there are that many; each thread has its own."""
        found = []
        while len(found) < number:
            time.sleep(0.01)
            found = [int(pid) for path in Path(f"/proc/{process.pid}/task").glob("*/children")
                     for pid in path.read_text().split()]
        return found


if __name__ == "__main__":
    unittest.main()
