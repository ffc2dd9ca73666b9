#!/usr/bin/env bash
# Watermarks a real scan, attacks it, recognises it again; leaves tables and pictures in
# demo-output/.
#
#   ./demo.sh [MESH] [OPTIONS]    MESH: a PLY, OBJ, STL, VTP or OFF file; default: a bunny of
#                                 34,835 vertices. ./demo.sh --help lists the options.
set -euo pipefail
callers_folder=$PWD
cd "$(dirname "${BASH_SOURCE[0]}")"
project=$PWD
source ./dependencies.sh

log=build/demo-setup.log
mkdir -p build
run_logged() { # what, command...
  local what=$1
  shift
  echo "$what ..."
  if ! "$@" >"$log" 2>&1; then
    tail -n 40 "$log" >&2
    echo "$what failed: the whole output is in $log" >&2
    exit 1
  fi
}

install_missing "${BUILD_PACKAGES[@]}" "${DEMO_PACKAGES[@]}"
configure=(cmake --preset release)
# The tests need more packages and take longer to build than all the rest; a build that has them
# keeps them.
[ -f build/CMakeCache.txt ] || configure+=(-DSPECTRALWATERMARK_BUILD_TESTING=OFF)
run_logged "Configuring" "${configure[@]}"
run_logged "Building (3 to 10 minutes the first time; what it says is in $log)" cmake --build build

export PYTHONPATH="$project/build/lib/python3/dist-packages${PYTHONPATH:+:$PYTHONPATH}"
cd "$callers_folder"
# Debian's VTK draws through X: a virtual screen is enough.
exec xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" /usr/bin/python3 \
  "$project/Examples/Demo/watermark_demo.py" --output "$project/demo-output" "$@"
