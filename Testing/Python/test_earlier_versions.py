# SPDX-License-Identifier: BSD-3-Clause
"""What earlier versions marked is read, with the same verdict."""

import unittest
from dataclasses import dataclass
from pathlib import Path

from spectralwatermark import vtkSpectralWatermarkDetect
from spectralwatermark.mesh_io import read_mesh

MARKED = Path(__file__).resolve().parents[1] / "Marked"
SECRET = "the secret of 2026"
ROBUST, PAPER = vtkSpectralWatermarkDetect.Robust, vtkSpectralWatermarkDetect.PaperSlots


@dataclass
class Mark:
    file: str
    scheme: int
    message: str
    secret: str = ""
    derived: bool = False
    narrow: bool = False


MARKS = (
    Mark("0.1/robust-derived.ply", ROBUST,
         "0100110100111011110111000100011100001001101001000001001110010101", SECRET, derived=True),
    Mark("0.1/robust-message.ply", ROBUST, "1100101110101101", SECRET),
    Mark("0.1/robust-open.ply", ROBUST, "0101100011110000"),
    Mark("0.1/paper-derived.ply", PAPER, "01001", SECRET, derived=True),
    Mark("0.1/paper-open.ply", PAPER, "10110"),
    Mark("0.1/paper-narrow.ply", PAPER, "0110", narrow=True),
)


def read(mark, secret):
    detect = vtkSpectralWatermarkDetect()
    detect.SetInputData(read_mesh(MARKED / mark.file))
    detect.SetScheme(mark.scheme)
    if mark.scheme == PAPER:
        detect.SetFalsePositiveRate(0.1)  # what so few bits can prove
    if mark.narrow:
        detect.SetSlotDivisionToInterleavedNarrow()
    detect.SetNumberOfBits(len(mark.message))
    if secret:
        detect.SetSecretKey(secret)
    if mark.derived:
        detect.UseDerivedMessageOn()
    else:
        detect.SetExpectedMessage(mark.message)
    detect.Update()
    return detect


class EarlierVersionsTest(unittest.TestCase):
    def test_every_mark_is_read(self):
        for mark in MARKS:
            with self.subTest(mark.file):
                detect = read(mark, mark.secret)
                self.assertEqual(detect.GetExtractedMessage(), mark.message)
                self.assertEqual(detect.GetBitErrorRate(), 0.0)
                if mark.scheme == ROBUST:
                    self.assertTrue(detect.GetMessageIsValid())
                    self.assertTrue(detect.GetDetected())
                    self.assertLessEqual(detect.GetPValue(), 2.0 ** -(len(mark.message) + 20))

    def test_no_other_secret_reads_it(self):
        for mark in MARKS:
            if mark.secret and mark.scheme == ROBUST:
                with self.subTest(mark.file):
                    detect = read(mark, "another secret")
                    self.assertFalse(detect.GetDetected())
                    self.assertFalse(detect.GetMessageIsValid())

    def test_every_file_is_tested(self):
        self.assertEqual({str(path.relative_to(MARKED)) for path in MARKED.glob("*/*")},
                         {mark.file for mark in MARKS})


if __name__ == "__main__":
    unittest.main()
