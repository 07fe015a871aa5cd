#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every kind of project that `dalembert new` writes does what its README.md says: the commands there are run as they stand, with the
# program of the build tree. Usage: projects.sh KIND...: the kinds whose C++ program is built too; else check and simulate are run.
set -euo pipefail
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
mkdir "$here/bin"
ln -s "$PROGRAM" "$here/bin/dalembert"
export PATH=$here/bin:$PATH CMAKE_PREFIX_PATH=${PREFIX:-$BUILD} CMAKE_GENERATOR=Ninja
export CXXFLAGS="-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wfloat-conversion -Werror"
built=" $* "

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

# commands README: the lines of its first block.
commands() { awk '/^```sh/ { inside = 1; next } /^```/ { exit } inside' "$1"; }

# With a name that the programs use for something else, too.
for folder in "$SOURCE"/templates/new/*/; do
  kind=$(basename "$folder")
  [ "$kind" != common ] || continue
  cd "$here"
  name=model
  dalembert new "$name" --kind "$kind" -o "$kind" >new.txt
  cd "$kind/$name"
  while read -r file; do [ -s "$here/$file" ] || fail "$kind: $file is named but not there"; done < <(grep '^  ' "$here/new.txt")
  [ "$(find . -type f | wc -l)" -eq "$(grep -c '^  ' "$here/new.txt")" ] || fail "$kind: files that are not named"
  ! grep -rn '@' . || fail "$kind: a placeholder is left"
  for link in $(grep -oE '\]\([^)]*\)' README.md | tr -d '()]'); do [ -e "$link" ] || fail "$kind: README.md links to $link"; done
  [ "$(commands README.md | wc -l)" -eq 3 ] || fail "$kind: README.md shows other than three commands"
  while IFS= read -r command; do
    [[ $built == *" $kind "* || $command != cmake* ]] || continue
    echo "$kind: $command"
    bash -e -o pipefail -c "$command" >"$here/printed.txt" 2>&1 || { cat "$here/printed.txt"; fail "$kind: $command"; }
  done < <(commands README.md)
  # What README.md says of files, seen where it was said.
  for file in $(grep -oE '`(out|build)/[^`]*\.(csv|svg|hpp)`' README.md | tr -d '`'); do
    [[ $built == *" $kind "* || $file != build/* ]] || continue
    [ -s "$file" ] || fail "$kind: README.md tells of $file"
  done
  [[ $built != *" $kind "* ]] || ctest --test-dir build >"$here/printed.txt" || { cat "$here/printed.txt"; fail "$kind: ctest"; }
done

# What runs on the target computes nothing in double.
if [[ $built == *" controller "* ]]; then
  cd "$here/controller/model"
  "${CXX:-c++}" -std=c++17 -x c++ -fsyntax-only -Wdouble-promotion $CXXFLAGS -I. -Ibuild/model.generated - <<<'#include "controller.hpp"' \
    2>"$here/printed.txt" || { cat "$here/printed.txt"; fail "controller.hpp has warnings"; }
fi

# Without the package, CMake says how to find it.
cd "$here"
dalembert new lost >/dev/null
cd lost
! env -u CMAKE_PREFIX_PATH PATH=/usr/bin:/bin cmake -S . -B build -DCMAKE_FIND_USE_CMAKE_SYSTEM_PATH=OFF >"$here/printed.txt" 2>&1 ||
  fail "CMake found dalembert where there is none"
grep -q 'CMAKE_PREFIX_PATH=FOLDER' "$here/printed.txt" || { cat "$here/printed.txt"; fail "CMake does not say how to find dalembert"; }
echo "projects are as their README.md says"
