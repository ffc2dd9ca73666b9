# SPDX-License-Identifier: BSD-3-Clause
"""The modules of reproduce_paper.py."""
