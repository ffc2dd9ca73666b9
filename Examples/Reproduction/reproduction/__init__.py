# SPDX-License-Identifier: BSD-3-Clause
"""What reproduce_paper.py is made of, one idea a module."""
