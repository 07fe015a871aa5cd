# SPDX-License-Identifier: GPL-3.0-or-later
# Gates on files: each prints what fails and where, and returns 1.

# Memory for data of the board in board.ld, less its stack.
data_bytes=$((4 * 1024 * 1024 - 64 * 1024))

# check_header HEADER: whether it is one, and whether what it returns can fit, before anything is compiled.
check_header() {
  [ -f "$1" ] || { echo "there is no header $1" >&2; exit 2; }
  grep -q '^namespace .*::.* {$' "$1" && grep -q 'void rhs_and_jacobian(' "$1" || { echo "$1 is not a header that dalembert generated" >&2; exit 2; }
  local numbers
  numbers=$(sed -n 's/.*using JacobianX = std::array<Scalar, \([0-9]*\)>.*/\1/p' "$1")
  [ $((${numbers:-0} * 4)) -le $data_bytes ] || { echo "$1: its Jacobian alone takes $((numbers * 4)) bytes in float, the board has $data_bytes for data" >&2; exit 2; }
}

# What generated code may call: functions of float of the C library, and what the compiler takes for copies.
may_call='^(sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|exp|expm1|log|log1p|pow|cbrt|hypot|fmod|floor|ceil|round|trunc|fmin|fmax)f$|^mem(cpy|set|move)$'

# why_not SYMBOL: says why a symbol must not be there, if that is so.
why_not() {
  case $1 in
    __aeabi_d* | __aeabi_*2d | __*df[0-9]) echo "arithmetic in double" ;;
    malloc | calloc | realloc | free | _malloc_r | _sbrk | _Znw* | _Zna* | _Zdl* | _Zda*) echo "heap" ;;
    __cxa_guard* | _ZGV*) echo "a static that is guarded" ;;
    __cxa_* | _ZSt*__throw* | _Unwind_*) echo "an exception" ;;
    sqrtf) echo "a call beside the instruction vsqrt.f32" ;;
  esac
}

# check_object ROW OBJECT: what the generated function calls and defines.
check_object() {
  local kind symbol why bad=0
  while read -r kind symbol; do
    why=$(why_not "$symbol")
    [ -n "$why" ] || [ "$kind" != U ] || [[ $symbol =~ $may_call ]] || why="no function of float that is known here"
    [ -z "$why" ] || { echo "$1 has $symbol: $why" >&2; bad=1; }
  done < <(arm-none-eabi-nm "$2" | awk '{ print $(NF - 1), $NF }')
  return $bad
}

# check_linked ROW PROGRAM: what the functions of the library that it calls bring with them.
check_linked() {
  local symbol why bad=0
  while read -r symbol; do
    why=$(why_not "$symbol")
    [ -z "$why" ] || { echo "$1: $symbol was linked: $why" >&2; bad=1; }
  done < <(arm-none-eabi-nm "$2" | awk '{ print $NF }')
  return $bad
}

# divisions HEADER FUNCTION...: of the table of operations in the header.
divisions() {
  local header=$1 function sum=0 count
  shift
  for function in "$@"; do
    count=$(awk -v name="$function" '/^\/\/ Operations/ { inside = 1 } /^\/\/$/ { inside = 0 } inside && $2 == name { print $5 }' "$header")
    sum=$((sum + ${count:-0}))
  done
  echo $sum
}

# Loops that solve with M divide once a pivot, which the table does not count.
divisions_in_loops() { sed -n 's|^//   and solves with M (\([0-9]*\) x .*by loops.*|\1|p' "$1" | grep . || echo 0; }

# note [divisions]
# A division takes 14 cycles where a product takes one. The compiler must not add any to those of the table (which has the mode with most);
# and the table may have one for each pivot that changes from point to point, as the host finds them, and those of M, bias, forces and
# constraints themselves. known.txt says where that is not so, and why.
check_divisions() {
  local instructions counted modes
  modes=$(sed -n 's/.* mode_count = \([0-9]*\);/\1/p' "$2")
  instructions=$(arm-none-eabi-objdump -d "$3" | grep -c 'vdiv\.f32' || true)
  counted=$(($(divisions "$2" rhs) + $(divisions_in_loops "$2")))
  [ "$instructions" -le $((counted * ${modes:-1})) ] || { echo "$1: rhs has $instructions vdiv.f32, its table of operations $counted divisions" >&2; return 1; }
}
check_pivots() {
  local counted terms known
  counted=$(($(divisions "$2" rhs) + $(divisions_in_loops "$2")))
  terms=$(divisions "$2" mass_matrix bias generalised_force constraint_jacobian)
  known=$(awk -v name="${1%% *}" '$1 == name { print $2 }' "$(dirname "${BASH_SOURCE[0]}")/known.txt")
  if [ -n "$known" ] && [ "$counted" -lt $(($3 + terms + known)) ]; then
    echo "$1: rhs no longer has the $known divisions more that known.txt tells of" >&2
    return 1
  fi
  [ "$counted" -le $(($3 + terms + ${known:-0})) ] && return
  echo "$1: rhs has $counted divisions; $3 pivots change, M, bias, forces and constraints have $terms, and ${known:-0} more are known" >&2
  return 1
}

# own_bytes OBJECT: code and constants of the generated function and of what it calls in its header; the C library not.
own_bytes() { arm-none-eabi-size -A "$1" | awk '/^\.(text|rodata|data|bss)/ { sum += $2 } END { print sum + 0 }'; }
