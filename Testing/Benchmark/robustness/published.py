# SPDX-License-Identifier: BSD-3-Clause
"""Bit error rates on the mesh Venus, 64 bits, averages of five trials, as the authors of "A Benchmark
for 3-D Mesh Watermarking" (K. Wang, G. Lavoue, F. Denis, A. Baskurt, 2010) publish them on its results
page: the methods of Cho and others (2007) and of Wang and others (2009), each within the benchmark's
perceptual and its geometric limit of distortion."""

COLUMNS = ("Cho 2007 (perceptual)", "Wang 2009 (perceptual)", "Cho (geometric)", "Wang (geometric)")
MRMS = (0.0080, 0.069, 0.012, 0.018)  # percent of the diagonal
MSDM = (0.19, 0.14, 0.29, 0.09)
SECONDS = (7.6, 439.9, 11.6, 377.6)  # to embed

RATES = {
    ("noise", "0.05"): (0.01, 0.0, 0.0, 0.02),
    ("noise", "0.1"): (0.03, 0.01, 0.01, 0.15),
    ("noise", "0.3"): (0.13, 0.08, 0.10, 0.29),
    ("noise", "0.5"): (0.28, 0.16, 0.24, 0.40),
    ("smoothing", "5"): (0.10, 0.0, 0.06, 0.06),
    ("smoothing", "10"): (0.23, 0.01, 0.16, 0.18),
    ("smoothing", "30"): (0.38, 0.07, 0.34, 0.39),
    ("smoothing", "50"): (0.45, 0.14, 0.42, 0.51),
    ("quantization", "11"): (0.0, 0.0, 0.0, 0.01),
    ("quantization", "10"): (0.04, 0.01, 0.02, 0.17),
    ("quantization", "9"): (0.14, 0.01, 0.06, 0.27),
    ("quantization", "8"): (0.26, 0.05, 0.18, 0.39),
    ("quantization", "7"): (0.46, 0.17, 0.41, 0.53),
    ("midpoint", "1"): (0.04, 0.0, 0.02, 0.0),
    ("sqrt3", "1"): (0.14, 0.0, 0.09, 0.01),
    ("Loop", "1"): (0.16, 0.0, 0.09, 0.01),
}
