#!/usr/bin/env bash
# Loads the plugin that build.sh built into pvbatch and chains its filters (test_plugin.py); pictures and
# states are left in build/paraview/test.
set -euo pipefail
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
build=$project/build/paraview
# -noreset: ParaView opens and closes its first connection before it draws.
exec xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" "$project/Wrapping/ParaView/start.sh" pvbatch \
  "$project/Wrapping/ParaView/test_plugin.py" \
  "$build/lib/paraview-plugins/SpectralWatermark/SpectralWatermark.so" \
  "$project/Data/pebble.ply" "$build/test"
