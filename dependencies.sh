# Sourced by demo.sh and test.sh: installs the Debian packages that are missing, and nothing when
# none is. Root is asked for (through sudo) only then.

BUILD_PACKAGES=(g++ cmake ninja-build libvtk9-dev python3-vtk9 python3-numpy libeigen3-dev
  libspectra-dev libsodium-dev libmetis-dev python3-shtab python3-tqdm)
DEMO_PACKAGES=(glmark2-data xvfb xauth libgl1-mesa-dri python3-jinja2 python3-matplotlib)
TEST_PACKAGES=(libgtest-dev clang-format doxygen)
PARAVIEW_PACKAGES=(paraview paraview-dev libqt5svg5 dpkg-dev xvfb xauth libgl1-mesa-dri)
FULL_TEST_PACKAGES=(chromium mypy clang clang-tidy libomp-dev llvm valgrind)

install_missing() {
  local package missing=()
  for package in "$@"; do
    if [ "$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null)" != installed ]; then
      missing+=("$package")
    fi
  done
  [ ${#missing[@]} -eq 0 ] && return 0

  local root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "These packages are missing, and there is neither root nor sudo to install them:" >&2
      echo "  apt-get install --no-install-recommends ${missing[*]}" >&2
      return 1
    fi
    root=(sudo)
  fi
  echo "Installing packages: ${missing[*]}"
  "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q update </dev/null &&
    "${root[@]}" env DEBIAN_FRONTEND=noninteractive \
      apt-get -q install -y --no-install-recommends "${missing[@]}" </dev/null
}
