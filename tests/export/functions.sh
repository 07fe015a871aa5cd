#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What is exported for CasADi and acados is the plant that `dalembert compile` makes: every function, in every mode. Its files compile without
# a warning, for other types of CasADi, too; with FLAGS (sanitizers) if there are any.
# Needs the program (PROGRAM) and the sources (SOURCE). Arguments: names of models of systems/, or model files; all of systems/ if there are none.
set -euo pipefail
: "${PROGRAM:?the program}" "${SOURCE:?the sources}"
. "$SOURCE/tests/machines.sh"
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
failed() { echo "FAILED: $*"; exit 1; }
read -ra flags <<<"${FLAGS:-}"
warnings=(-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Werror)
"${CXX:-c++}" -std=c++17 -O1 "${flags[@]}" -Wall -Wextra -Wconversion -Wshadow -I "$SOURCE/runtime" -I "$SOURCE/tests" \
  "$SOURCE/tests/export/functions.cpp" -o "$here/functions" -ldl -pthread
mapfile -t models < <(machines "$@")
count=0 with_second=0
for model in "${models[@]}"; do
  size=()
  [ "$(basename "$model")" != n_pendulum.toml ] || size=(--size N=3)
  for scene in $("$PROGRAM" scenes "$model" --format json | sed -n 's/^ *"scene": "\(.*\)",*$/\1/p'); do
    rm -rf "$here/plant" "$here/c"
    "$PROGRAM" compile "$model" --scene "$scene" "${size[@]}" -o "$here/plant" >"$here/said" 2>&1 || {
      grep -q 'nothing-left' "$here/said" || failed "$model $scene is not compiled"
      continue
    }
    plant=$(ls "$here"/plant/*.so)
    name=$(basename "$plant" .so)
    mapfile -t modes < <("$here/functions" --modes "$plant")
    if [ ${#modes[@]} -gt 0 ]; then
      ! "$PROGRAM" export "$model" --to casadi --scene "$scene" "${size[@]}" -o "$here/c" >"$here/said" 2>&1 || failed "$model $scene switches"
      grep -q -e '--mode' "$here/said" || failed "$model $scene: $(cat "$here/said")"
      [ ! -e "$here/c" ] || failed "$model $scene leaves files behind"
    else
      modes=("")
    fi
    for mode in "${modes[@]}"; do
      choice=()
      [ -z "$mode" ] || choice=(--mode "$mode")
      rm -rf "$here/c"
      "$PROGRAM" export "$model" --to acados --scene "$scene" "${choice[@]}" "${size[@]}" -o "$here/c" >"$here/said" 2>&1 ||
        failed "$model $scene $mode: $(cat "$here/said")"
      for compiler in ${COMPILERS:-"${CC:-cc}"}; do
        compile() { "$compiler" -std=c99 -O2 "${warnings[@]}" "$@" || failed "$name $mode with $compiler"; }
        compile "${flags[@]}" -fPIC -shared "$here/c/${name}_acados.c" -o "$here/acados.so" -lm
        compile "${flags[@]}" -fPIC -shared -fvisibility=hidden "$here/c/${name}_casadi.c" -o "$here/casadi.so" -lm
      done
      compile -Dcasadi_int=int -Dcasadi_real=float -DDALEMBERT_PREFIX=other_ -DDALEMBERT_NO_THREADS -c "$here/c/${name}_casadi.c" -o "$here/other.o"
      nm "$here/other.o" | grep ' T jac_other_f$' >/dev/null || failed "$name: a prefix"
      # In the place of what acados has generated, of which there is here only the names.
      of_model=$here/generated/${name}_model
      rm -rf "$here/generated"
      mkdir -p "$of_model"
      for function in impl_dae_fun impl_dae_jac_x_xdot_u_z expl_vde_forw something_else; do echo "int of_$function;" >"$of_model/${name}_$function.c"; done
      PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$here/c python3 -c "import ${name}_acados_model as m; m.use_exported_functions('$here/generated')
assert len(m.PARAMETERS) == len(m.PARAMETER_NAMES) and len(m.START) == len(m.STATES)" || failed "$name: Python"
      "${CC:-cc}" -std=c99 -fPIC -shared "$of_model"/*.c -o "$here/replaced.so" -lm || failed "$name: the files of acados"
      nm -D "$here/replaced.so" >"$here/symbols"
      for symbol in "T ${name}_impl_dae_fun" of_something_else; do grep -q " $symbol\$" "$here/symbols" || failed "$name: $symbol"; done
      ! grep -q ' of_impl' "$here/symbols" || failed "$name: a function of acados is left"
      for library in "$here/c/$name.so" "$here/casadi.so"; do
        unset NO_SLOPES
        grep -q "${name}_output_jacobian_p" "$here/c/$name.h" || export NO_SLOPES=1
        compared=$("$here/functions" "$name" "$plant" "$library" "$here/acados.so" ${mode:+"$mode"} 2>&1) || failed "$name $mode: $compared"
      done
      count=$((count + 1))
      [[ $compared != *second* ]] || with_second=$((with_second + 1))
    done
  done
done
[ "$count" -gt 0 ] || failed "nothing was compared"
[ "$with_second" -gt 0 ] || failed "no second derivatives were compared"
echo "$count exports have the functions of their plants, $with_second of them with second derivatives"
