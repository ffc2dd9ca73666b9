# SPDX-License-Identifier: BSD-3-Clause
"""The progress bar."""

from __future__ import annotations

import sys


class ProgressBar:
    """A bar with the time left while standard error is a terminal, and nothing otherwise."""

    def __init__(self, label: str) -> None:
        self._bar = None
        if not sys.stderr.isatty():
            return
        from tqdm import tqdm

        tqdm.monitor_interval = 0  # no monitoring thread: this process forks
        self._bar = tqdm(total=1.0, file=sys.stderr, leave=False, dynamic_ncols=True, desc=label,
                         bar_format="{desc:<24} {percentage:3.0f}% |{bar}| {remaining} left")

    def __enter__(self) -> ProgressBar:
        return self

    def __exit__(self, *_) -> None:
        if self._bar is not None:
            self._bar.close()

    def show(self, share: float, what: str) -> None:
        if self._bar is None:
            return
        self._bar.set_description_str(what, refresh=False)
        if share < self._bar.n:
            self._bar.reset()
        self._bar.update(share - self._bar.n)

    def clear(self) -> None:
        """Makes room for lines on the terminal, until the next show()."""
        if self._bar is not None:
            self._bar.clear()
