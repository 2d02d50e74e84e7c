#!/usr/bin/env bash
# Installs the packages of a folder in a bare Debian 12 and uses each of them there: the program with its manual and its
# completion, Python, C without and C++ with the headers of what it is built of. Needs root rights, for debootstrap and
# chroot.
#   tests/package/bare_test.sh FOLDER_OF_PACKAGES SCRATCH
set -euo pipefail
packages="$(readlink -f -- "$1")" scratch="$2"
source="$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/../.."
bare="$scratch/bare"
mirror="$(apt-get indextargets --format '$(REPO_URI)' 'Identifier: Packages' | head -n 1)"

in_bare() { chroot "$bare" env -i PATH=/usr/bin:/usr/sbin:/bin:/sbin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }
step() { printf 'package-test: %s\n' "$1"; }

leave() { if mountpoint -q "$bare/proc"; then umount "$bare/proc"; fi; }
trap leave EXIT
leave
rm -rf -- "$bare"
mkdir -p -- "$scratch"
step "a bare Debian 12"
debootstrap --variant=minbase --include=ca-certificates bookworm "$bare" "$mirror" >"$scratch/debootstrap.log"
mount -t proc proc "$bare/proc"
cp -- "$packages"/*.deb "$bare/root/"
# The documents that a package may leave out by the image's own choice are looked at here.
rm -f -- "$bare/etc/dpkg/dpkg.cfg.d/excludes"

step "install: fanbeam python3-fanbeam"
in_bare bash -c 'cd /root && apt-get install -y --no-install-recommends ./fanbeam_*.deb ./fanbeam-data_*.deb ./libfanbeam-pictures0_*.deb ./python3-fanbeam_*.deb man-db' >"$scratch/install.log" 2>&1
in_bare fanbeam --version
in_bare bash -c 'cd /root && fanbeam render --frames 0 -o pictures >/dev/null && test -s pictures/bscope/00000.png && test -s pictures/cscope/00000.png'
in_bare bash -c 'man -P cat fanbeam-render 2>/dev/null | grep -q frames'
in_bare bash -c 'test -s /usr/share/bash-completion/completions/fanbeam && bash -n /usr/share/bash-completion/completions/fanbeam'
in_bare python3 -c '
import fanbeam, fanbeam.signal
scene = fanbeam.Scene.open("flat-grass")
frame = scene.render(0)
assert frame.bscope.shape == (524, 164) and frame.bscope.max() > 0
print("import fanbeam:", fanbeam.__file__)'

step "install: libfanbeam0 libfanbeam-dev, for C"
in_bare bash -c 'cd /root && apt-get install -y --no-install-recommends ./libfanbeam0_*.deb ./libfanbeam-dev_*.deb gcc libc6-dev pkg-config' >>"$scratch/install.log" 2>&1
cp -- "$source/bindings/c/example.c" "$bare/root/"
in_bare bash -c 'cd /root && gcc -std=c99 example.c $(pkg-config --cflags --libs fanbeam) -o example && ./example /usr/share/fanbeam /usr/share/fanbeam/scenes/flat-grass && test "$(stat -c %s bscope.pgm)" = 85951'

step "what they recommend, for C++"
in_bare bash -c 'cd /root && apt-get install -y --no-install-recommends g++ cmake ninja-build $(dpkg-query -W -f "\${Recommends}" libfanbeam-dev | tr -d ,)' >>"$scratch/install.log" 2>&1
cp -r -- "$source/tests/install/consumer" "$bare/root/"
in_bare bash -c 'cd /root && cmake -G Ninja -S consumer -B built -DCMAKE_BUILD_TYPE=Release >/dev/null && cmake --build built >/dev/null && built/consumer /usr/share/fanbeam flat-grass'

step "remove all of them"
in_bare apt-get purge -y fanbeam fanbeam-data python3-fanbeam libfanbeam0 libfanbeam-pictures0 libfanbeam-dev >>"$scratch/install.log" 2>&1
left="$(find "$bare/usr" "$bare/etc" "$bare/var/lib" -iname '*fanbeam*' -not -path '*/dpkg/*' -not -path '*/apt/*')"
[[ -z $left ]] || { printf 'left behind:\n%s\n' "$left" >&2; exit 1; }
leave
rm -rf -- "$bare"
step "held"
