#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the published examples and writes README.md beside this file. PROGRAM names the program (build/dalembert).
set -uo pipefail
folder=$(cd "$(dirname "$0")" && pwd)
export SOURCE=${SOURCE:-$folder/../..}
export PROGRAM=${PROGRAM:-$SOURCE/build/dalembert}
{
  cat <<'TEXT'
# Published examples, rebuilt

Examples that others publish or ship, as models in this program's language. Each runs at the default tolerance; its states or event
times are compared with numbers that do not come from this program: the reference of the source, a closed form, or another
formulation integrated by other code (`oracles/`). The tests run each of them and ask for 8 digits at least.

This page is written by `tests/published/table.sh`. Digits: -log10 of the error, relative to values above 1.
TEXT
  for script in "$folder"/*.sh; do
    name=$(basename "$script" .sh)
    [ "$name" = table ] && continue
    printf '\n## %s\n\n' "$(sed -n 's/^title *= *"\(.*\)"/\1/p' "$folder/$name.toml")"
    sed -n '2s/^# //p' "$script"
    printf '\nModel: [%s](%s). Compared by [%s](%s).\n\n| quantity | here | reference | digits |\n|---|---|---|---|\n' "$name.toml" "$name.toml" "$name.sh" "$name.sh"
    bash "$folder/../regressions/run.sh" "published/$name" | grep '^|'
  done
} >"$folder/README.md"
