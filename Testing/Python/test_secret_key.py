# SPDX-License-Identifier: BSD-3-Clause
"""What a secret key decides, derived a second time: hashlib's BLAKE2b and a ChaCha20 of its own."""

import hashlib
import re
import struct
import unittest
from pathlib import Path

from spectralwatermark import vtkManifoldHarmonics, vtkSpectralWatermarkDetect
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOPLY import vtkPLYReader

ROOT = Path(__file__).resolve().parents[2]
PEBBLE = ROOT / "Data" / "pebble.ply"
PINNED_IN = ROOT / "Testing" / "Core" / "Payload" / "TestSecretKey.cxx"
POSITIONS, KEYSTREAM, MESSAGE, WAVES, DITHERS, CARRIER_KEYSTREAM, CHECK = range(1, 8)
BITS = 12


def rotate(word: int, by: int) -> int:
    return ((word << by) & 0xFFFFFFFF) | (word >> (32 - by))


def quarter_round(state: list[int], a: int, b: int, c: int, d: int) -> None:
    for x, y, z, by in ((a, b, d, 16), (c, d, b, 12), (a, b, d, 8), (c, d, b, 7)):
        state[x] = (state[x] + state[y]) & 0xFFFFFFFF
        state[z] = rotate(state[z] ^ state[x], by)


def chacha20_block(key: bytes, counter: int, nonce: bytes) -> bytes:
    """RFC 8439, 2.3."""
    start = list(struct.unpack("<4I", b"expand 32-byte k") + struct.unpack("<8I", key)
                 + (counter,) + struct.unpack("<3I", nonce))
    state = list(start)
    columns = ((0, 4, 8, 12), (1, 5, 9, 13), (2, 6, 10, 14), (3, 7, 11, 15))
    diagonals = ((0, 5, 10, 15), (1, 6, 11, 12), (2, 7, 8, 13), (3, 4, 9, 14))
    for _ in range(10):
        for indices in columns + diagonals:
            quarter_round(state, *indices)
    return struct.pack("<16I", *((a + b) & 0xFFFFFFFF for a, b in zip(state, start)))


def seed(secret: bytes, purpose: int) -> bytes:
    master = hashlib.blake2b(secret, digest_size=32, key=b"SpectralWatermark v1").digest()
    return hashlib.blake2b(digest_size=32, key=master, salt=struct.pack("<QQ", purpose, 0),
                           person=b"SpecWM_1").digest()


def stream(secret: bytes, purpose: int, size: int) -> bytes:
    blocks = (chacha20_block(seed(secret, purpose), i, b"LibsodiumDRG") for i in range(-(-size // 64)))
    return b"".join(blocks)[:size]


def first_bits(packed: bytes, count: int) -> list[int]:
    return [packed[i // 8] >> (i % 8) & 1 for i in range(count)]


def bits(secret: bytes, purpose: int, count: int) -> list[int]:
    return first_bits(stream(secret, purpose, -(-count // 8)), count)


def uniform(secret: bytes, purpose: int, count: int) -> list[float]:
    """In [0, 1), of 53 bits."""
    return [(word >> 11) * 2.0**-53 for word in struct.unpack(f"<{count}Q", stream(secret, purpose, 8 * count))]


def check(secret: bytes, message: str, count: int) -> list[int]:
    return first_bits(hashlib.blake2b(message.encode(), digest_size=32, key=seed(secret, CHECK)).digest(), count)


class SecretKeyTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        reader = vtkPLYReader()
        reader.SetFileName(str(PEBBLE))
        harmonics = vtkManifoldHarmonics()
        harmonics.SetInputConnection(reader.GetOutputPort())
        harmonics.SetNumberOfHarmonics(20 + 10 * BITS)
        harmonics.Update()
        cls.mesh = harmonics.GetOutput()

    def detector(self, secret):
        detect = vtkSpectralWatermarkDetect()
        detect.SetInputData(self.mesh)
        detect.SetSchemeToPaperSlots()
        detect.SetSecretKey(secret)
        detect.SetNumberOfBits(BITS)
        detect.SetFalsePositiveRate(1.0)
        return detect

    def test_block_of_the_rfc(self):
        block = chacha20_block(bytes(range(32)), 1, bytes.fromhex("000000090000004a00000000"))
        self.assertEqual(block[:8].hex(), "10f1e7e4d13b5915")

    def test_positions_and_keystream(self):
        for secret in ("correct horse battery staple", "schlüssel", "x"):
            detect = self.detector(secret)
            detect.Update()
            table = detect.GetOutputDataObject(1)
            column = {name: vtk_to_numpy(table.GetColumnByName(name))
                      for name in ("Component", "Magnitude", "Average", "Bit")}
            words = struct.unpack(f"<{BITS}Q", stream(secret.encode(), POSITIONS, 8 * BITS))
            self.assertEqual(list(column["Component"]),
                             [20 + 10 * i + 2 + word % 8 for i, word in enumerate(words)])
            inverted = (column["Magnitude"] > column["Average"]) != (column["Bit"] == 1)
            self.assertEqual([int(bit) for bit in inverted],
                             bits(secret.encode(), KEYSTREAM, BITS))

    def test_derived_message(self):
        derived = self.detector("a secret")
        derived.UseDerivedMessageOn()
        derived.Update()
        message = "".join(map(str, bits(b"a secret", MESSAGE, BITS)))
        given = self.detector("a secret")
        given.SetExpectedMessage(message)
        given.Update()
        self.assertEqual(derived.GetBitErrorRate(), given.GetBitErrorRate())
        self.assertEqual(derived.GetLogLikelihoodRatio(), given.GetLogLikelihoodRatio())

    def test_what_the_robust_scheme_derives(self):
        """The numbers that TestSecretKey.cxx pins."""
        pinned = (PINNED_IN.read_text().split("DerivationForTheRobustSchemeIsPinned", 1)[1]).split("\n}", 1)[0]
        secret = b"a secret"
        for name, purpose in (("WaveNumbers", WAVES), ("Dither", DITHERS)):
            numbers = re.search(rf"key\.{name}\(3\),\s*\(std::vector<double>{{ (.*?) }}", pinned)[1]
            self.assertEqual(uniform(secret, purpose, 3), [float(number) for number in numbers.split(",")])
        for call, derived in ((r"CarrierKeystream\(24\)", bits(secret, CARRIER_KEYSTREAM, 24)),
                              (r'Check\("10110", 24\)', check(secret, "10110", 24))):
            self.assertEqual("".join(map(str, derived)),
                             re.search(rf'EXPECT_EQ\(key\.{call}, "([01]+)"', pinned)[1])

    def test_there_is_no_getter(self):
        detect = self.detector("a secret")
        self.assertFalse(hasattr(detect, "GetSecretKey"))
        self.assertEqual(detect.GetHasSecretKey(), 1)
        self.assertNotIn("a secret", str(detect))


if __name__ == "__main__":
    unittest.main()
