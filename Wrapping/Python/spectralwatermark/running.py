# SPDX-License-Identifier: BSD-3-Clause
"""The earlier name of spectralwatermark.execution."""

from .execution import *  # noqa: F401,F403
