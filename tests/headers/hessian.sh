#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# `generate --hessian`: second derivatives are the slopes of the Jacobians, for every machine that has them; where they cannot be made, the reason is
# told. Needs the program (PROGRAM) and the sources (SOURCE). Arguments: names of models of systems/; all of them if there are none.
set -euo pipefail
: "${PROGRAM:?the program}" "${SOURCE:?the sources}"
. "$SOURCE/tests/machines.sh"
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
failed() { echo "FAILED: $*"; exit 1; }
mapfile -t models < <(machines "$@")
compared=0 linear=0 refused=0 sparse=0
for model in "${models[@]}"; do
  size=()
  [ "$(basename "$model")" != n_pendulum.toml ] || size=(--size N=3)
  rm -rf "$here/c"
  if ! "$PROGRAM" generate "$model" --every-scene "${size[@]}" --hessian --language c -o "$here/c" >"$here/out" 2>&1; then
    grep -Eq 'error\[bad-option\]: --hessian: .* (needs the derivative of the function|has equations of motion of|has many bodies|has rods)' "$here/out" ||
      failed "$(basename "$model"): $(head -3 "$here/out")"
    refused=$((refused + 1))
    continue
  fi
  for header in "$here"/c/*.h; do
    name=$(basename "$header" .h) modes=()
    ! grep -q "^    ${name}_mode_count" "$header" || modes=(-DMODES)
    grep -q " ${name}_state_count = 0," "$header" && continue
    if grep -q "${name}_jacobian_[xu]_column_starts(void)" "$header"; then sparse=$((sparse + 1)); continue; fi
    "${CC:-cc}" -std=c99 -Wall -Wextra -Werror -O1 -DHEADER="\"$header\"" -DNAME="$name" "${modes[@]}" "$SOURCE/tests/headers/hessian.c" -o "$here/compare" -lm ||
      failed "$name does not compile"
    code=0
    "$here/compare" >"$here/out" || code=$?
    case $code in 0) compared=$((compared + 1)) ;; 3) linear=$((linear + 1)) ;; *) failed "$name: $(cat "$here/out")" ;; esac
  done
done
[ "$compared" -gt 0 ] || failed "nothing was compared"
echo "$compared equal, $linear with all second derivatives zero, $sparse not compared (their Jacobians are sparse), $refused refused"
