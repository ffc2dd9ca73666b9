# SPDX-License-Identifier: BSD-3-Clause
"""What several tests write into files."""

from itertools import product

# Readers take it; the filters refuse it.
NOT_FINITE = """ply
format ascii 1.0
element vertex 3
property float x
property float y
property float z
element face 1
property list uchar int vertex_indices
end_header
nan 0 0
1 0 0
0 1 0
3 0 1 2
"""


def quadrilateral_ball(steps):
    """OBJ of a ball without symmetry: the squares of a cube, none of them flat, each with its own corners."""
    lines = []
    for axis, side, i, j in product(range(3), (-1.0, 1.0), range(steps), range(steps)):
        corners = ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))
        for u, v in corners if side > 0 else corners[::-1]:
            at = [0.0, 0.0, 0.0]
            at[axis], at[axis - 2], at[axis - 1] = side, 2.0 * u / steps - 1.0, 2.0 * v / steps - 1.0
            length = sum(x * x for x in sorted(at, key=abs)) ** 0.5  # the same from every side
            x, y, z = (coordinate / length for coordinate in at)
            height = 1.0 + 0.2 * x * y + 0.15 * z ** 3 + 0.1 * x
            lines.append(f"v {height * x!r} {0.8 * height * y!r} {0.6 * height * z!r}")
        lines.append("f -4 -3 -2 -1")
    return "\n".join(lines) + "\n"
