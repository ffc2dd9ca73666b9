# SPDX-License-Identifier: BSD-3-Clause
"""The earlier name of spectralwatermark.io."""

from .io import *  # noqa: F401,F403
