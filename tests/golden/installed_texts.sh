#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The man page is clean and tells every verb; bash and zsh complete verbs, options, their words and files.
set -euo pipefail
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
cd "$here"
fail() {
  echo "$1" >&2
  exit 1
}
for format in man bash zsh; do "$PROGRAM" help --format $format >$format; done
verbs=$("$PROGRAM" --help | sed -n '/^Subcommands:/,/^Examples:/s/^  \([a-z]*\) .*/\1/p')
[ "$(wc -w <<<"$verbs")" -gt 10 ] || fail "the help names too few verbs: $verbs"
for verb in $verbs; do
  grep -qx ".SS $verb" man || fail "the man page lacks $verb"
done
if command -v man >/dev/null && man --help >/dev/null 2>&1; then
  warnings=$(MANROFFSEQ='' MANWIDTH=80 LC_ALL=C.UTF-8 man --warnings -E UTF-8 -l -Tutf8 -Z man 2>&1 >/dev/null)
  [ -z "$warnings" ] || fail "the man page: $warnings"
fi

# completed WORD...: the completions of bash for the last word.
touch model.toml plant.so notes.txt
mkdir folder
completed() {
  bash -c 'source ./bash; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _dalembert; echo "${COMPREPLY[*]}"' bash "$@"
}
# expect ANSWER WORD...
expect() {
  local answer=$1 got
  shift
  got=$(completed "$@")
  [ "$got" = "$answer" ] || fail "bash completes '$*' as '$got', not as '$answer'"
}
expect simulate dalembert simu
expect "$(echo $verbs)" dalembert ''
expect --tolerance dalembert simulate model.toml --tol
expect --memory dalembert derive --mem
expect 'dopri5 dop853' dalembert simulate model.toml --method dop
expect 'text latex json' dalembert derive model.toml --format = ''
expect json dalembert derive model.toml --format = j
expect folder dalembert generate model.toml -o ''
expect 'folder model.toml plant.so' dalembert simulate ''
expect equilibrium dalembert help equi

if command -v zsh >/dev/null; then
  mkdir functions
  mv zsh functions/_dalembert
  zsh -n functions/_dalembert
  cat >complete.zsh <<'TEXT'
zmodload zsh/zpty
zpty shell zsh -f
expect() {
  zpty -w -n shell $'\C-u'"$1"$'\t'
  local text all="" i
  for i in {1..40}; do
    while zpty -rt shell text; do all+=$text; done
    [[ $all == *$2* ]] && return
    sleep 0.1
  done
  print -u2 "zsh does not complete '$1' as '$2': $all"
  exit 1
}
zpty -w shell 'fpath=($PWD/functions $fpath); autoload -U compinit; compinit -u -D; zstyle ":completion:*" list-prompt ""; PS1=READY'
expect 'dalembert simu' 'simulate'
expect 'dalembert simulate model.toml --method dop' 'dop853'
expect 'dalembert simulate model.toml --tol' 'tolerance'
TEXT
  zsh -f complete.zsh
fi
echo "the man page is clean, shells complete"
