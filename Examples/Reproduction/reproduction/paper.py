# SPDX-License-Identifier: BSD-3-Clause
"""The paper's numbers: Tables 1 to 4 and the claims of section 3.3."""

from __future__ import annotations

from typing import NamedTuple


class Row(NamedTuple):
    """A line of one of the paper's tables; differences in percent."""

    iterations: int
    geometric: float
    curvature: float


TITLE = "A Robust Spectral Approach for Blind Watermarking of Manifold Surfaces"
AUTHORS = "Liu, Prabhakaran and Guo, 2008"
VERTICES_IN_A_MINUTE = 20000  # section 3.1: "less than 1 minute"

# By the key of the mode (experiments.MODES), then by model.
TABLES: dict[str, dict[str, Row]] = {
    "normal-aggressive": {
        "BallJoint": Row(2, 0.234169, 0.233259),
        "Buddha": Row(9, 0.747521, 0.742569),
        "Dinosaur": Row(3, 0.843850, 0.841414),
        "Elephant": Row(3, 1.300157, 1.297724),
        "Gargoyle": Row(3, 1.080153, 1.073566),
        "Greek": Row(2, 0.505423, 0.502522),
        "Horse": Row(3, 0.894512, 0.892042),
        "Igea": Row(2, 0.476169, 0.475276),
        "Iphigenia": Row(4, 0.512932, 0.510703),
        "Neptune": Row(3, 0.792230, 0.791762),
        "Shell": Row(4, 1.209168, 1.207613),
        "Teeth": Row(1, 0.252154, 0.251556),
        "Topology": Row(7, 1.482054, 1.460097),
    },
    "normal-nonaggressive": {
        "BallJoint": Row(2, 0.179201, 0.178477),
        "Buddha": Row(3, 0.477365, 0.474270),
        "Dinosaur": Row(3, 0.774479, 0.772246),
        "Elephant": Row(3, 1.298359, 1.295943),
        "Gargoyle": Row(3, 0.928533, 0.922703),
        "Greek": Row(2, 0.481065, 0.478384),
        "Horse": Row(3, 0.867700, 0.865367),
        "Igea": Row(2, 0.454682, 0.453806),
        "Iphigenia": Row(3, 0.476333, 0.474304),
        "Neptune": Row(3, 0.798724, 0.798294),
        "Shell": Row(4, 0.925626, 0.924383),
        "Teeth": Row(2, 0.255855, 0.255231),
        "Topology": Row(2, 1.110981, 1.098596),
    },
    "narrow-aggressive": {
        "BallJoint": Row(7, 0.304506, 0.303407),
        "Buddha": Row(7, 0.743958, 0.739356),
        "Dinosaur": Row(4, 0.776946, 0.774803),
        "Elephant": Row(3, 1.111846, 1.109944),
        "Gargoyle": Row(8, 2.024484, 2.012315),
        "Greek": Row(3, 0.548618, 0.545405),
        "Horse": Row(8, 1.241718, 1.238079),
        "Igea": Row(4, 0.317021, 0.316497),
        "Iphigenia": Row(4, 0.752914, 0.749533),
        "Neptune": Row(3, 0.585220, 0.584601),
        "Shell": Row(4, 1.052538, 1.050436),
        "Teeth": Row(1, 0.293767, 0.293044),
        "Topology": Row(16, 2.466684, 2.415274),
    },
    "narrow-nonaggressive": {
        "BallJoint": Row(6, 0.212013, 0.211199),
        "Buddha": Row(4, 0.532908, 0.529667),
        "Dinosaur": Row(5, 0.765400, 0.763228),
        "Elephant": Row(5, 1.114529, 1.112623),
        "Gargoyle": Row(3, 0.835289, 0.830061),
        "Greek": Row(5, 0.543010, 0.539735),
        "Horse": Row(13, 1.227770, 1.224172),
        "Igea": Row(4, 0.257239, 0.256824),
        "Iphigenia": Row(8, 0.589470, 0.586745),
        "Neptune": Row(6, 0.604990, 0.604353),
        "Shell": Row(3, 0.730253, 0.728965),
        "Teeth": Row(2, 0.311238, 0.310506),
        "Topology": Row(11, 1.707945, 1.671483),
    },
}


class Claim(NamedTuple):
    """The paper states that all bits were read after this attack."""

    text: str
    mode: str
    attack: str  # a key of experiments.ATTACKS
    model: str = ""  # the paper's model, if there is only one


CLAIMS = (
    Claim("immune to rotation (3.3.1)", "normal-aggressive", "rotation"),
    Claim("immune to uniform scaling (3.3.1)", "normal-aggressive", "scaling"),
    Claim("immune to translation (3.3.1)", "normal-aggressive", "translation"),
    Claim("Figure 13: half of the triangles removed, Igea", "normal-aggressive", "simplify-50",
          "igea"),
    Claim("Figure 14: noise of 0.5, Elephant", "normal-aggressive", "noise-0.5", "elephant"),
    Claim("Figure 15: noise of 0.7, Topology", "narrow-aggressive", "noise-0.7", "topology"),
    Claim("Figure 16: smoothing, Igea (the printed formula)", "normal-nonaggressive",
          "smooth-dropped", "igea"),
    Claim("Figure 16: smoothing, Igea (the rest of the geometry kept)", "normal-nonaggressive",
          "smooth-kept", "igea"),
)


def printed(mode: str, model: str) -> Row | None:
    """The paper's line for a model of that name in any resolution."""
    return TABLES[mode].get(model.capitalize())
