#!/usr/bin/env bash
# Writes docs/accuracy-and-cost.md and its plots in docs/images/ from real runs of `fanbeam cost`.
# A quarter of an hour on two cores; leave the machine alone meanwhile. With --quick in one or two, and with
# figures that mean nothing. Build first: ./dev build.
set -euo pipefail

root="$(dirname -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")")"
cd -- "$root"
fanbeam=build/release/bin/fanbeam
work=build/accuracy-and-cost
page=docs/accuracy-and-cost.md

options=()
case "${1-}" in
  '') ;;
  --quick) options=(--quick) ;;
  *)
    echo "Usage: docs/accuracy-and-cost.sh [--quick]" >&2
    exit 2
    ;;
esac
[[ -x $fanbeam ]] || { echo "no $fanbeam: call ./dev build first" >&2; exit 1; }

# Scenes, and the frame to look at where it is not two. The first two need few effects, the third rain and its echo.
scenes=(
  "braunschweig-26"
  "innsbruck-26 --frames 600"
  "rain-94ghz --frames 180"
)

measured=()
for line in "${scenes[@]}"; do
  read -r -a words <<<"$line"
  scene="${words[0]}"
  if ! "$fanbeam" validate "$scene" -q >/dev/null 2>&1; then
    echo "[skipped] $scene: its data are not there" >&2
    continue
  fi
  "$fanbeam" cost "${words[@]}" -o "$work/$scene" "${options[@]}"
  for plot in ladder ladder-cscope effects levels; do
    [[ -f $work/$scene/$plot.svg ]] || continue  # no signal level
    for ending in svg png; do
      install -m 644 -- "$work/$scene/$plot.$ending" "docs/images/cost-$scene-$plot.$ending"
    done
  done
  measured+=("$scene")
done

# A scene's page without its method, one level down, with its plots where they lie now.
section() {
  awk '/^## Method$/ { exit } { print }' "$work/$1/cost.md" |
    sed -E -e 's/^(#+) /#\1 /' -e "s/^## What accuracy costs: /## /" \
      -e "s#^!\[([^]]*)\]\(([a-z-]+)\.svg\)#[![\1](images/cost-$1-\2.png)](images/cost-$1-\2.svg)#"
}

{
  cat <<'TEXT'
# Accuracy and what it costs

Written by `docs/accuracy-and-cost.sh`; every figure was measured by `fanbeam cost`, which does the same for any scene
of yours.

A picture is finished when its cells hold what an endless number of rays would put there. How close a picture comes to
that is its **error**, in grey levels of the display (0 to 255, 0.235 dB each); what it takes is its **time**. Two
questions follow, and each scene below answers both. *How finely to sample?* The plots of error against time show what
a millisecond buys: fanbeam follows the range cells and gives every ray an azimuth of its own (rays), or cuts the scene
into exact vertical slices (slices); the renderer people write first sends rays at equal angles. *Which effects to
simulate?* The plots of effects show what each changes and what it costs: the plan keeps those that show, and leaves
out those that do not.

TEXT
  for scene in "${measured[@]}"; do section "$scene"; done
  awk '/^## Method$/ { found = 1 } found { print }' "$work/${measured[-1]}/cost.md"
} >"$page.new"
mv -- "$page.new" "$page"
echo "$page"
