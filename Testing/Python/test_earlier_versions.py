# SPDX-License-Identifier: BSD-3-Clause
"""What earlier versions marked is read, with the same verdict."""

import hashlib
import unittest
from dataclasses import dataclass
from pathlib import Path

from spectralwatermark import vtkSpectralWatermarkDetect
from spectralwatermark.io import read_mesh

MARKED = Path(__file__).resolve().parents[1] / "Marked"
SECRET = "the secret of 2026"
ROBUST, PAPER = vtkSpectralWatermarkDetect.Robust, vtkSpectralWatermarkDetect.PaperSlots


@dataclass
class Mark:
    file: str
    sha256: str
    scheme: int
    message: str
    p_value: float  # of full agreement: as many fair coins, or what a bit of an unmarked scan agrees by
    secret: str = ""
    derived: bool = False
    narrow: bool = False


MARKS = (
    Mark("0.1/robust-derived.ply", "b6c45bedfd46fbe3391843b6aabece95f94600a1c19318c7cb7ef7f0ff0369b2", ROBUST,
         "0100110100111011110111000100011100001001101001000001001110010101", 2.0**-84, SECRET, derived=True),
    Mark("0.1/robust-message.ply", "c997ee2c4924ffe91fa5e2e90fc21bdcb86928e2a5c190fe08cf626e0aea9b1b", ROBUST,
         "1100101110101101", 2.0**-36, SECRET),
    Mark("0.1/robust-open.ply", "5e837e14e95d84367845df0468a431ce3593787bbe3de90477c171e05bbf2a6e", ROBUST,
         "0101100011110000", 2.0**-36),
    Mark("0.1/paper-derived.ply", "8c48260c05b8ce01c6ebc016c3fff944d860dad1d3e712f3f4fa66f06b3edff5", PAPER,
         "01001", 2.0**-5, SECRET, derived=True),
    Mark("0.1/paper-open.ply", "2a6f2391513c2575d1596dacf20ac578b106b374e98da2d3341235efa5d57328", PAPER,
         "10110", 0.52**3 * 0.6**2),
    Mark("0.1/paper-narrow.ply", "dcb4dd6f032a4fd7b73e5e0ac1250f2e2e45ac097df9e842b38af5eda2647ff7", PAPER,
         "0110", 0.52**2 * 0.57**2, narrow=True),
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
                self.assertEqual(detect.GetMessageIsValid(), mark.scheme == ROBUST)
                self.assertTrue(detect.GetDetected())
                self.assertAlmostEqual(detect.GetPValue() / mark.p_value, 1.0, 9)

    def test_no_other_secret_reads_it(self):
        for mark in MARKS:
            if mark.secret:
                with self.subTest(mark.file):
                    detect = read(mark, "another secret")
                    self.assertFalse(detect.GetDetected())
                    self.assertFalse(detect.GetMessageIsValid())

    def test_every_file_is_as_it_was_written(self):
        for mark in MARKS:
            with self.subTest(mark.file):
                self.assertEqual(hashlib.sha256((MARKED / mark.file).read_bytes()).hexdigest(), mark.sha256)

    def test_every_file_is_tested(self):
        self.assertEqual({str(path.relative_to(MARKED)) for path in MARKED.glob("*/*")},
                         {mark.file for mark in MARKS})


if __name__ == "__main__":
    unittest.main()
