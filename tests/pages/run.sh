#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs the blocks of a page as a reader would, in an empty folder beside links to the repository's folders. Usage: run.sh PAGE.
# A comment in the line before a block says what the block is:
#   <!-- file: NAME -->       a file: it is written
#   <!-- run -->              a console: what follows '$ ' is run, and the other lines are its output. '...' stands for any lines.
#   <!-- run: status 1 -->    the same, and the last command ends with this exit code
#   <!-- run with: HEADER --> a console that needs a C++ header which not every machine has: it is run where the compiler finds it
#   <!-- run with python: MODULE -->, <!-- run with octave -->  the same where a python3 has the module, or where Octave is there
#   <!-- lines of: FILE -->   an excerpt: each of its lines stands in FILE, in this order; '...' stands for any lines
#   <!-- tested by: PATH -->  another test uses it
#   <!-- not run: REASON -->
# A page with a line <!-- tier: full --> takes longer and is tested by `./dev test full` only.
# Blocks of code without such a comment are an error, so that nothing is shown that was never tried. Numbers below 1e-9 are roundings.
set -euo pipefail
page=$SOURCE/$1
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
mkdir "$here/bin" "$here/work"
ln -s "$PROGRAM" "$here/bin/dalembert"
export PATH=$here/bin:$PATH
cd "$here/work"
for folder in systems generated runtime templates tests; do ln -s "$SOURCE/$folder" "$folder"; done

fail() {
  echo "$1, line $2: $3" >&2
  exit 1
}

# same SHOWN ACTUAL: the lines that are shown stand in ACTUAL one behind the other, with more lines only where '...' stands (or anywhere, if $3).
same() {
  awk -v loose="${3:-}" '
    function plain(line) { gsub(/[0-9.]+e-(09|[1-9][0-9]+)/, "~", line); sub(/[ \t]+$/, "", line); return line }
    NR == FNR { shown[++n] = plain($0); next }
    { actual[++m] = plain($0) }
    END {
      at = 1; skip = loose
      for (i = 1; i <= n; ++i) {
        if (shown[i] ~ /^[ \t]*\.\.\.$/) { skip = 1; continue }
        if (loose && shown[i] == "") continue
        while (skip && at <= m && actual[at] != shown[i]) ++at
        if (at > m || actual[at] != shown[i]) { print "shown:  " shown[i]; print "actual: " (at > m ? "(nothing more)" : actual[at]); exit 1 }
        ++at; skip = loose
      }
      if (!skip && at <= m) { print "not shown: " actual[at]; exit 1 }
    }' "$1" "$2"
}

console() {  # LINE STATUS: the block in $here/block
  local command="" status=0 at=$1 wanted=$2
  : >"$here/shown"
  finish() {
    [ -n "$command" ] || return 0
    status=0
    bash -c "$command" >"$here/actual" 2>&1 || status=$?
    same "$here/shown" "$here/actual" || fail "$page" "$at" "'$command' prints something else"
    : >"$here/shown"
  }
  while IFS= read -r text; do
    if [[ $text == '$ '* ]]; then
      finish
      [ -z "$command" ] || [ "$status" -eq 0 ] || fail "$page" "$at" "'$command' ends with $status"
      command=${text#'$ '}
    else
      [ -n "$command" ] || fail "$page" "$at" "a console begins with a command"
      printf '%s\n' "$text" >>"$here/shown"
    fi
  done <"$here/block"
  finish
  [ "$status" -eq "$wanted" ] || fail "$page" "$at" "'$command' ends with $status, not with $wanted"
}

number=0 inside="" mark="" count=0 begun=0
while IFS= read -r line; do
  number=$((number + 1))
  if [ -n "$inside" ]; then
    if [[ $line != '```' ]]; then
      printf '%s\n' "$line" >>"$here/block"
      continue
    fi
    case $mark in
      'file: '*)
        mkdir -p "$(dirname "${mark#file: }")"
        cp "$here/block" "${mark#file: }"
        ;;
      run) console "$begun" 0 ;;
      'run: status '*) console "$begun" "${mark#run: status }" ;;
      'run with: '*)
        if echo "#include <${mark#run with: }>" | ${CXX:-c++} -E -x c++ - >/dev/null 2>&1; then console "$begun" 0
        else echo "$page, line $begun: not run without ${mark#run with: }"; fi
        ;;
      'run with python: '*)
        for python in python3 /usr/bin/python3; do
          "$python" -c "import ${mark#run with python: }" 2>/dev/null || continue
          ln -sf "$(command -v "$python")" "$here/bin/python3"
          break
        done
        if [ -L "$here/bin/python3" ]; then console "$begun" 0; else echo "$page, line $begun: not run without Python's ${mark#run with python: }"; fi
        ;;
      'run with octave')
        if command -v octave-cli >/dev/null && command -v mkoctfile >/dev/null; then console "$begun" 0
        else echo "$page, line $begun: not run without Octave"; fi
        ;;
      'lines of: '*)
        [ -f "${mark#lines of: }" ] || fail "$page" "$begun" "there is no ${mark#lines of: }"
        same "$here/block" "${mark#lines of: }" loose || fail "$page" "$begun" "not in ${mark#lines of: }"
        ;;
      'tested by: '*) [ -e "$SOURCE/${mark#tested by: }" ] || fail "$page" "$begun" "there is no ${mark#tested by: }" ;;
      'not run: '?*) ;;
      '')
        [[ $inside =~ ^(c|cpp|cmake|console|python|sh|bash|toml)$ ]] || head -1 "$here/block" | grep -q '^\$ ' && fail "$page" "$begun" "nothing says how this block is tried; see tests/pages/run.sh" ;;
      *) fail "$page" "$begun" "'$mark' says nothing; see tests/pages/run.sh" ;;
    esac
    count=$((count + 1))
    inside="" mark=""
  elif [[ $line =~ ^'<!-- '(.*)' -->'$ ]]; then
    mark=${BASH_REMATCH[1]}
  elif [[ $line =~ ^'```'(.*)$ ]]; then
    inside=${BASH_REMATCH[1]:-text}
    begun=$number
    : >"$here/block"
  elif [ -n "$line" ]; then
    mark=""
  fi
done <"$page"
[ -z "$inside" ] || fail "$page" "$begun" "the block does not end"
echo "$1: $count blocks"
