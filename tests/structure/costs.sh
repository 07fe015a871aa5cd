#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What a change of generator/ costs, in numbers: how many files name one kind of element, and how long things are. Prints, and fails never.
#   tests/structure/costs.sh [KIND]
set -euo pipefail
cd "$(dirname "$0")/../.."
kind=${1:-rod}
sources() { find generator -name '*.cpp' -o -name '*.hpp'; }
pattern="\\b${kind}s?\\b|\\b${kind^}\\b"

printf '%-42s %s\n' "files that name '$kind'" "$(sources | xargs grep -lE "$pattern" | wc -l)"
printf '%-42s %s\n' "lines that name '$kind'" "$(sources | xargs grep -hE "$pattern" | wc -l)"
printf '%-42s %s\n' 'lines' "$(sources | xargs cat | wc -l)"
printf '%-42s %s\n' 'longest file' "$(sources | xargs wc -l | grep -v ' total$' | sort -n | tail -1 | awk '{ print $1 " (" $2 ")" }')"
printf '%-42s %s\n' 'files above 300 lines' "$(sources | xargs wc -l | grep -v ' total$' | awk '$1 > 300' | wc -l)"
printf '%-42s %s\n' 'lines above 140 columns' "$(sources | xargs awk 'length > 140' | wc -l)"
# A function begins with a line that ends in "{" at the depth of a namespace or class, and ends with "}" at the same depth.
printf '%-42s %s\n' 'functions above 60 lines' "$(sources | xargs awk '
  FNR == 1 { inside = 0 }
  !inside && /\) (const |noexcept |override )*\{$/ && !/^ *(if|for|while|switch|else|return|\})/ && match($0, /^(    )?[A-Za-z~]/) { inside = 1; first = FNR; match($0, /^ */); depth = RLENGTH }
  inside && /^ *\}$/ { match($0, /^ */); if (RLENGTH == depth) { inside = 0; if (FNR - first > 60) ++n } }
  END { print n + 0 }')"
