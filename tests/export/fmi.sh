#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Exports to FMI 2.0 and 3.0 in an importer of our own: XML valid under the schemas of the standards; model exchange, co-simulation, events,
# derivatives, saved states, wrong calls against runs of the plant that did not come through FMI.
# Needs the program (PROGRAM), the sources (SOURCE) and the importer (IMPORTER); VERSIONS: 2, 3 or both; KEEP: a folder that keeps the FMUs.
# Arguments: names of models of systems/; all of them if there are none.
set -euo pipefail
: "${PROGRAM:?the program}" "${SOURCE:?the sources}" "${IMPORTER:?the importer}"
. "$SOURCE/tests/machines.sh"
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
mapfile -t models < <(machines "$@")
schemas=$SOURCE/tests/export/schemas
good=0 bad=0
complain() { echo "FAILED: $*"; bad=$((bad + 1)); }
valid() { xmllint --noout --schema "$schemas/$1" "$2" 2>"$here/said" || complain "$what: $(head -1 "$here/said")"; }
has_schema() { command -v xmllint >/dev/null; }
for model in "${models[@]}"; do
  size=()
  [ "$(basename "$model")" != n_pendulum.toml ] || size=(--size N=3)
  for scene in $("$PROGRAM" scenes "$model" --format json | sed -n 's/^ *"scene": "\(.*\)",*$/\1/p'); do
    what="$(basename "$model" .toml) $scene"
    rm -rf "${here:?}"/*
    if ! "$PROGRAM" compile "$model" --scene "$scene" "${size[@]}" -o "$here/plant" >"$here/said" 2>&1; then
      grep -q 'nothing-left' "$here/said" || complain "$what is not compiled"
      continue
    fi
    plant=$(ls "$here"/plant/*.so)
    for version in ${VERSIONS:-2 3}; do
      "$PROGRAM" export "$model" --to fmi$version --scene "$scene" "${size[@]}" -o "$here/fmi$version" >"$here/said" 2>&1 ||
        { complain "$what: $(head -1 "$here/said")"; continue 2; }
      fmu=$(ls "$here"/fmi$version/*.fmu)
      if [ $good -eq 0 ]; then  # once: the same input gives the same bytes, in another time zone, too
        TZ=Asia/Tokyo "$PROGRAM" export "$model" --to fmi$version --scene "$scene" "${size[@]}" -o "$here/again$version" >/dev/null 2>&1
        cmp "$fmu" "$here"/again$version/*.fmu || complain "$what has other bytes the second time"
      fi
      [ -z "${KEEP:-}" ] || { mkdir -p "$KEEP/fmi$version"; cp "$fmu" "$KEEP/fmi$version/"; }
      if has_schema; then
        unzip -q -o "$fmu" modelDescription.xml -d "$here/xml$version"
        valid "schema$version/fmi${version}ModelDescription.xsd" "$here/xml$version/modelDescription.xml"
      fi
    done
    if has_schema && [ "$version" = 3 ]; then
      unzip -q -o "$fmu" sources/buildDescription.xml -d "$here/xml3"
      valid schema3/fmi3BuildDescription.xsd "$here/xml3/sources/buildDescription.xml"
    fi
    read -r until inputs < <("$IMPORTER" "$fmu")
    for tolerance in fine rough; do
      digits=1e-12
      [ $tolerance = fine ] || digits=1e-10
      # Exit code 4: the run ends where the model does.
      "$PROGRAM" simulate "$plant" --until "$until" ${inputs:+--input "$inputs"} --tolerance $digits --samples 50 --no-plot \
        -o "$here/$tolerance" >"$here/said" 2>&1 || true
      csv=$(ls "$here/$tolerance"/*.csv 2>/dev/null | grep -v _events || true)
      [ -z "$csv" ] || mv "$csv" "$here/$tolerance.csv"
      ! ls "$here/$tolerance"/*_events.csv >/dev/null 2>&1 || mv "$here/$tolerance"/*_events.csv "$here/${tolerance}_events.csv"
    done
    for version in ${VERSIONS:-2 3}; do
      if "$IMPORTER" "$here"/fmi$version/*.fmu "$here" "$plant"; then good=$((good + 1)); else bad=$((bad + 1)); fi
    done
  done
done
echo "$good FMUs are good, $bad are not"
[ "$good" -gt 0 ] && [ "$bad" -eq 0 ]
