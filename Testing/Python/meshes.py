# SPDX-License-Identifier: BSD-3-Clause
"""What several tests write into files."""

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
