#!/usr/bin/env bash
# Starts ParaView with the plugin that build.sh built and with the Python modules that Debian's paraview package
# leaves out; or pvbatch or pvpython with those modules, where a program loads the plugin itself.
#
#   Wrapping/ParaView/start.sh [paraview|pvbatch|pvpython] [ARGUMENTS]
#   Wrapping/ParaView/start.sh model.ply
set -euo pipefail
build=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)/build/paraview
if [ ! -d "$build/lib/paraview-plugins" ]; then
  echo "The plugin is not built yet: run Wrapping/ParaView/build.sh" >&2
  exit 2
fi
export PYTHONPATH="$build/root/usr/lib/python3/dist-packages"
program=${1:-paraview}
shift || true
case $program in
  paraview) PV_PLUGIN_PATH="$build/lib/paraview-plugins" exec paraview "$@" ;;
  pvbatch) exec pvbatch3.11 "$@" ;;
  pvpython) exec "$build/root/usr/bin/pvpython3.11" "$@" ;;
  *)
    if [ -e "$program" ]; then # a model
      PV_PLUGIN_PATH="$build/lib/paraview-plugins" exec paraview "$program" "$@"
    fi
    echo "usage: Wrapping/ParaView/start.sh [paraview|pvbatch|pvpython] [ARGUMENTS]" >&2
    exit 2
    ;;
esac
