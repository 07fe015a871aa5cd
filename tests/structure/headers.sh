#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every header of the generator and of the runtime compiles alone: it includes what it needs.
set -euo pipefail
: "${SOURCE:?}" "${CXX:=c++}"
cd "$SOURCE"
alone() {
  [ "$2" = dalembert/sundials.hpp ] && ! [ -e /usr/include/cvode/cvode.h ] && return  # where SUNDIALS is not installed
  local standard=c++20
  [ "$1" = runtime ] && standard=c++17
  printf '#include "%s"\n' "$2" | "$CXX" -std=$standard -fsyntax-only -I "$1" -I runtime -I /usr/include/eigen3 -x c++ - ||
    { echo "$1/$2 does not compile alone" >&2; exit 1; }
}
export -f alone
export CXX
for root in generator runtime; do
  (cd $root && find . -name '*.hpp' | sed 's|^\./||' | sort) | xargs -P "$(nproc)" -I{} bash -c 'alone "$@"' - $root {}
done
echo "every header compiles alone"
