#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that tests mirror sources: Testing/Core/<room>/Test<Source>.cxx for Filters/Core/<room>/<Source>."""

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

# Sources without a test of their own, and why.
ALLOWED = {
    "Support/Types": "type names and constants",
    "LinearAlgebra/SimdRow": "a type and a macro, tested through FrontalKernels and MultiVector",
}


def main() -> int:
    core, tests = ROOT / "Filters" / "Core", ROOT / "Testing" / "Core"
    sources = {path.relative_to(core).with_suffix("").as_posix()
               for path in core.glob("*/*") if path.suffix in (".h", ".cxx")}
    tested = {path.relative_to(tests).with_suffix("").as_posix().replace("/Test", "/")
              for path in tests.glob("*/Test*.cxx")}
    found = [f"Filters/Core/{source}: there is no Testing/Core/{source.replace('/', '/Test')}.cxx"
             for source in sorted(sources - tested - set(ALLOWED))]
    found += [f"Testing/Core/{test.replace('/', '/Test')}.cxx: there is no Filters/Core/{test}"
              for test in sorted(tested - sources)]
    found += [f"Style/mirror.py: {source} needs no exception"
              for source in sorted(set(ALLOWED) - (sources - tested))]
    print("\n".join(found) or f"{len(tested)} test files mirror {len(sources)} sources")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
