#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Links between pages lead somewhere, and pages are short: README.md has at most 250 lines, every other page 600.
set -euo pipefail
cd "$SOURCE"
status=0
wrong() {
  echo "$*" >&2
  status=1
}

# anchors PAGE: the anchors of its headings, as GitHub makes them.
anchors() {
  awk '/^```/ { inside = !inside } !inside && /^#+ / { sub(/^#+ /, ""); print }' "$1" | tr 'A-Z' 'a-z' | sed -E 's/`//g; s/\[([^]]*)\]\([^)]*\)/\1/g; s/[^a-z0-9 _-]//g; s/ /-/g'
}

while IFS= read -r page; do
  lines=$(wc -l <"$page")
  most=600
  [ "$page" = README.md ] && most=250
  [ "$lines" -le "$most" ] || wrong "$page has $lines lines; at most $most"
  while IFS= read -r target; do
    case $target in http://* | https://* | mailto:*) continue ;; esac
    file=${target%%#*}
    anchor=""
    [[ $target == *#* ]] && anchor=${target#*#}
    if [ -z "$file" ]; then file=$page; else file=$(dirname "$page")/$file; fi
    [ -e "$file" ] || { wrong "$page links to $target, which is not there"; continue; }
    if [ -n "$anchor" ]; then
      case $file in
        *.md) anchors "$file" | grep -qxF -- "$anchor" || wrong "$page links to $target; $file has no such heading" ;;
        *.html) grep -q "id=\"$anchor\"" "$file" || wrong "$page links to $target; $file has no such id" ;;
      esac
    fi
  done < <(awk '/^```/ { inside = !inside } !inside' "$page" | sed -E 's/`[^`]*`//g' | grep -oE '\]\([^) ]+\)' | sed 's/^](//; s/)$//')
done < <(git ls-files -co --exclude-standard '*.md' 2>/dev/null || find . -name '*.md' -not -path './build*' | sed 's|^./||')
exit $status
