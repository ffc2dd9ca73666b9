#!/usr/bin/env bash
# Builds the plugin for Debian's ParaView 5.11; leaves it in build/paraview.
#
#   Wrapping/ParaView/build.sh
#
# Debian's python3-paraview and python3-vtk9 cannot be installed together, but CMake's find_package
# (ParaView) and pvbatch want the former's files. They are unpacked beside the build instead: nothing is
# installed or removed for it.
set -euo pipefail
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
if [ $# -gt 0 ]; then
  echo "usage: Wrapping/ParaView/build.sh" >&2
  exit 2
fi
source "$project/dependencies.sh"
install_missing "${BUILD_PACKAGES[@]}" "${PARAVIEW_PACKAGES[@]}"

build=$project/build/paraview
root=$build/root # what an installed python3-paraview would look like
triplet=$(dpkg-architecture -qDEB_HOST_MULTIARCH)
mkdir -p "$build"

if [ ! -f "$root/.complete" ]; then
  rm -rf "$root"
  mkdir -p "$root"
  package=$(mktemp -d)
  (cd "$package" && apt-get -q -o APT::Sandbox::User=root download python3-paraview)
  dpkg -x "$package"/python3-paraview_*.deb "$root"
  rm -r "$package"
  # Paths inside the CMake files are relative to where they lie: they are copied, all else is linked.
  mkdir -p "$root/usr/lib/$triplet/cmake"
  cp -r "/usr/lib/$triplet/cmake/paraview-5.11" "$root/usr/lib/$triplet/cmake/"
  ln -sfn /usr/include "$root/usr/include"
  dpkg -L paraview paraview-dev | while read -r file; do
    if { [ -f "$file" ] || [ -L "$file" ]; } && [ ! -e "$root$file" ] && [[ $file != /usr/include/* ]]; then
      mkdir -p "$(dirname "$root$file")"
      ln -s "$file" "$root$file"
    fi
  done
  touch "$root/.complete"
fi

cmake -G Ninja -S "$project/Wrapping/ParaView" -B "$build" \
  -DParaView_DIR="$root/usr/lib/$triplet/cmake/paraview-5.11" -DPython3_EXECUTABLE=/usr/bin/python3
cmake --build "$build"
echo "The plugin: $(find "$build" -name SpectralWatermark.so)"
