#!/usr/bin/env bash
# Writes docs/images/layers-braunschweig-26.png: ground truth beside the picture. Build first: ./dev build.
set -euo pipefail
cd -- "$(dirname -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")")"
work=build/layers
build/release/bin/fanbeam render --frames 971 --products bscope,layers -q --overwrite -o "$work"

# A layer from LOW to HIGH in false colours, columns doubled as in a pair.
panel() { # LAYER LOW HIGH MAP
  oiiotool "$work/layers/00971.exr" --ch "$1" --chnames Y --subc "$2" --divc "$(($3 - $2))" --clamp:min=0:max=1 \
    --colormap "$4" --resize:filter=box 328x524 -d uint8 -o "$work/$1.png"
}
panel grazing_deg 0 12 viridis
panel nrcs_dB -40 0 viridis
panel elevation_deg -9 0 viridis
panel object_id 0 12 turbo
oiiotool "$work/bscope/00971.png" --ch 0,0,0 --resize:filter=box 328x524 -o "$work/bscope.png"
oiiotool "$work/bscope.png" "$work/grazing_deg.png" "$work/nrcs_dB.png" "$work/elevation_deg.png" "$work/object_id.png" \
  --mosaic:pad=8 5x1 --attrib Software fanbeam -o docs/images/layers-braunschweig-26.png
