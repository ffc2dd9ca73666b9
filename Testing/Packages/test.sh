#!/usr/bin/env bash
# Makes the Debian packages and installs them in a clean Debian 12; there, marks a mesh with the program and
# asks whose it is, imports the Python package, and builds a program against the library. Needs root.
#
#   Testing/Packages/test.sh     after ./test.sh or ./demo.sh has built
set -euo pipefail
project=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
source "$project/dependencies.sh"
install_missing debootstrap dpkg-dev
if [ "$(id -u)" -ne 0 ]; then
  echo "A clean root is made with debootstrap, which needs root: run this as root" >&2
  exit 2
fi

build=$project/build
rm -rf "$build/packages"
(cd "$build" && cpack -G DEB >"$build/cpack.log" 2>&1) || { tail -n 40 "$build/cpack.log" >&2; exit 1; }

# The same mirror and proxy that this machine installs from.
root=$(mktemp -d)
trap 'umount "$root/proc" 2>/dev/null || true; rm -rf --one-file-system "$root"' EXIT
mirror=$(apt-get indextargets --format '$(SITE)' "Created-By: Packages" | head -n 1)
debootstrap --variant=minbase bookworm "$root" "$mirror"
cp -r /etc/apt/sources.list* /etc/apt/apt.conf.d /etc/apt/trusted.gpg.d "$root/etc/apt/"
[ -d /usr/share/keyrings ] && cp -rn /usr/share/keyrings "$root/usr/share/"
cp /etc/resolv.conf "$root/etc/" 2>/dev/null || true
cp /etc/hosts "$root/etc/"
if [ -d /usr/local/share/ca-certificates ] || [ -d /etc/ssl/certs ]; then
  mkdir -p "$root/etc/ssl"
  cp -rL /etc/ssl/certs "$root/etc/ssl/" 2>/dev/null || true
fi
mount -t proc proc "$root/proc"
mkdir "$root/work"
cp "$build"/packages/*.deb "$project/Data/pebble.ply" "$root/work/"
cp -r "$project/Testing/Consumer" "$root/work/"

inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root \
  DEBIAN_FRONTEND=noninteractive ${http_proxy:+http_proxy="$http_proxy"} \
  ${https_proxy:+https_proxy="$https_proxy"} bash -euc "cd /work; $1"; }

echo "== the program alone, with what it depends on"
inside 'apt-get -q update >/dev/null
  apt-get -q install -y --no-install-recommends ./libspectralwatermark0.1_*.deb \
    ./python3-spectralwatermark_*.deb ./spectral-watermark_*.deb >install.log || { tail install.log; exit 1; }
  spectral-watermark --version
  echo a secret >my.key
  spectral-watermark embed pebble.ply marked.ply --key-file my.key
  spectral-watermark detect marked.ply --key-file my.key
  code=0; spectral-watermark detect pebble.ply --key-file my.key || code=$?
  [ $code -eq 1 ]
  test -f /usr/share/man/man1/spectral-watermark.1 -o -f /usr/share/man/man1/spectral-watermark.1.gz
  grep -q spectral-watermark /usr/share/bash-completion/completions/spectral-watermark'
echo "== the Python package"
inside 'python3 -c "import spectralwatermark as s; print(s.vtkManifoldHarmonics().GetNumberOfHarmonics())"'
echo "== a program against the library"
inside 'apt-get -q install -y --no-install-recommends ./libspectralwatermark-dev_*.deb g++ cmake make >install.log \
    || { tail install.log; exit 1; }
  cmake -S Consumer -B consumer -DCMAKE_BUILD_TYPE=Release >cmake.log || { tail cmake.log; exit 1; }
  cmake --build consumer
  "$(find consumer -maxdepth 2 -type f -perm -u+x ! -name "*.*" | head -n 1)"'
echo "the packages work"
