#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The gates can fail: each defect put into a copy of a header is named by its gate; bad input has its message and exit code.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
source "$here/tools.sh"
require_tools
good=$here/../../generated/mechanics/cart_pendulum_lab.hpp
export BUILD=${BUILD:-build}/embedded/defects
mkdir -p "$BUILD"
count=0

# named CODE MESSAGE COMMAND...: exit code and message are as expected.
named() {
  local code=$1 message=$2 got=0
  shift 2
  "$@" >"$BUILD/said.txt" 2>&1 || got=$?
  [ "$got" -eq "$code" ] && grep -qF -- "$message" "$BUILD/said.txt" || { echo "expected $code and '$message', got $got and:"; cat "$BUILD/said.txt"; exit 1; }
  count=$((count + 1))
}

# defect MESSAGE OLD NEW: the first OLD of rhs becomes NEW.
defect() {
  awk -v old="$2" -v new="$3" '/void rhs\(/ { inside = 1 } inside && (at = index($0, old)) { $0 = substr($0, 1, at - 1) new substr($0, at + length(old)); inside = 0; done = 1 } { print } END { exit !done }' "$good" >"$BUILD/defect.hpp"
  named 1 "$1" bash "$here/measure.sh" "$BUILD/defect.hpp" Os
}

both='detail::sin_and_cos<Scalar>(phi, sin_phi, cos_phi);'
defect 'defect -Os: rhs has __aeabi_f2d: arithmetic in double' "$both" 'cos_phi = std::cos(phi); sin_phi = static_cast<Scalar>(std::sin(static_cast<double>(phi)));'
defect 'defect -Os: rhs does not compile for the board' "$both" 'cos_phi = std::cos(phi); sin_phi = 0.5 * std::sin(phi);'
defect 'defect -Os: rhs has _Znwj: heap' "$both" 'cos_phi = std::cos(phi); sin_phi = *static_cast<Scalar*>(::operator new(sizeof(Scalar)));'
defect 'a static that is guarded' "$both" 'sin_phi = std::sin(phi); static const Scalar kept = std::cos(phi); cos_phi = kept;'
defect 'rhs has sqrtf: a call beside the instruction vsqrt.f32' "$both" 'cos_phi = std::cos(phi); sin_phi = phi; Scalar (*volatile root)(Scalar) = ::sqrtf; root(phi);'
defect 'rhs has 2 vdiv.f32, its table of operations 1 divisions' 'c_.k1 * cos_phi' 'c_.k1 / cos_phi'
defect 'the relative error is' "$both" 'sin_phi = std::sin(phi); cos_phi = (std::cos(phi) + Scalar(1000)) - Scalar(1000);'
defect 'the relative error is inf' 'dxdt[3] = phi_ddot' 'static_cast<void>(phi_ddot)'
sed 's|^\(//   rhs  .*\) 1  \( *2  *0\)$|\1 2  \2|; s|/ (c_.k2 - e2 \* e3)|& * (c_.k5 / c_.k5)|' "$good" >"$BUILD/defect.hpp"
named 1 'rhs has 2 divisions; 1 pivots change, M, bias, forces and constraints have 0' bash "$here/measure.sh" "$BUILD/defect.hpp" Os

named 2 'there is no header nowhere.hpp' bash "$here/measure.sh" nowhere.hpp Os
named 2 'is not a header that dalembert generated' bash "$here/measure.sh" "$here/measure.hpp" Os
sed 's/using JacobianX = std::array<Scalar, 16>/using JacobianX = std::array<Scalar, 4000000>/' "$good" >"$BUILD/defect.hpp"
named 2 'its Jacobian alone takes 16000000 bytes in float, the board has 4128768 for data' bash "$here/measure.sh" "$BUILD/defect.hpp" Os
mkdir -p "$BUILD/no_tools"
for tool in bash dirname; do ln -sf "$(command -v $tool)" "$BUILD/no_tools/$tool"; done
named 3 'arm-none-eabi-g++ is missing' env PATH="$BUILD/no_tools" bash "$here/measure.sh" "$good" Os
echo "$count defects and inputs are named"
