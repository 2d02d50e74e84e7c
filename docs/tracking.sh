#!/usr/bin/env bash
# Writes the measured parts of docs/tracking.md (between the marks "study" of that page) and its plots in docs/images/
# from real runs of `fanbeam track`. Three minutes on two cores. Build first: ./dev build.
# The scenarios are those of a file in the format of scenes/highway_reader.h, S1 to S4: its path is the argument.
# With --samples before it, a quarter of an hour: the families from samples alone (between the marks "samples").
set -euo pipefail

root="$(dirname -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")")"
cd -- "$root"
fanbeam=${FANBEAM:-build/release/bin/fanbeam}
work=build/tracking-study
page=docs/tracking.md
what=study
if [[ ${1:-} == --samples ]]; then what=samples; shift; fi
scenarios=${1:-../shared/reference/highway-scenarios.json}

[[ -x $fanbeam ]] || { echo "no $fanbeam: call ./dev build first" >&2; exit 1; }
[[ -f $scenarios ]] || { echo "no $scenarios: name the file of scenarios" >&2; exit 1; }

# Puts the study in folder $1 between the marks $2; its plots, images tracking-$3*, stand beside its tables.
insert() {
  sed -E 's#^!\[([^]]*)\]\(([a-z-]+)\.png\)#![\1](images/tracking-'"$3"'\2.png)#' "$work/$1/study.md" >"$work/$1.inc"
  awk -v part="$work/$1.inc" -v mark="$2" '
    $0 == "<!-- " mark ": end -->" { inside = 0 }
    !inside { print }
    $0 == "<!-- " mark ": begin -->" { inside = 1; while ((getline line < part) > 0) print line }
  ' "$page" >"$page.new"
  mv -- "$page.new" "$page"
  echo "$page"
}
copy() { install -m 644 -- "$work/$1.png" "docs/images/tracking-$2.png"; }

if [[ $what == samples ]]; then
  "$fanbeam" track "$scenarios" --study --samples -q -o "$work/families-samples"
  for plot in families-mota families-nees; do copy "families-samples/$plot" "samples-$plot"; done
  insert families-samples samples samples-
  exit
fi
"$fanbeam" track "$scenarios" --study -q -o "$work/study"
"$fanbeam" track "$scenarios" --plots -q -o "$work/two-stage"
"$fanbeam" track "$scenarios" --scenario S2 --waveform triangle --plots -q -o "$work/triangle"
"$fanbeam" track "$scenarios" --scenario S3 --range-only --plots -q -o "$work/range-only"
"$fanbeam" track "$scenarios" --scenario S2 --samples --plots -q -o "$work/samples"
"$fanbeam" track street-76ghz --frames 0:40 --plots -q -o "$work/street"
"$fanbeam" track highway-76ghz --frames 0:60 --plots -q -o "$work/motorway"

copy two-stage/S1/errors s1-errors
copy two-stage/S2/ranges s2-ranges
copy two-stage/S2/errors s2-errors
copy two-stage/S3/ranges s3-ranges
copy two-stage/S4/ranges s4-ranges
copy triangle/S2/ranges s2-triangle-ranges
copy range-only/S3/errors s3-range-only-errors
copy samples/S2/ranges s2-samples-ranges
copy street/plan street-plan
copy motorway/plan motorway-plan
for plot in buffer noise-figure reflections-range reflections-speed missed ghosts families-mota families-nees crossing; do copy "study/$plot" "$plot"; done

insert study study ""
