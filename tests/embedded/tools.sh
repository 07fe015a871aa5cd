# SPDX-License-Identifier: GPL-3.0-or-later
# The compiler and the board, as measure.sh and the example use them.
board=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/board
target=(-mcpu=cortex-m4 -mthumb -mfpu=fpv4-sp-d16 -mfloat-abi=hard)
flags=(-std=c++17 -fno-exceptions -fno-rtti -ffunction-sections -fdata-sections -fno-math-errno
  -Wall -Wextra -Wpedantic -Wconversion -Wfloat-conversion -Wdouble-promotion -Wshadow -Werror)
# With -std=c99 gcc fuses no products into sums, as it does with -std=gnu99 and in C++.
c_flags=(-std=c99 -ffp-contract=fast -ffunction-sections -fdata-sections -fno-math-errno
  -Wall -Wextra -Wpedantic -Wconversion -Wfloat-conversion -Wdouble-promotion -Wshadow -Werror)
link=(-nostartfiles -Wl,--gc-sections -T "$board/board.ld")

require_tools() {
  local tool
  for tool in arm-none-eabi-g++ qemu-system-arm; do
    command -v "$tool" >/dev/null || { echo "$tool is missing (on Debian: gcc-arm-none-eabi libstdc++-arm-none-eabi-newlib qemu-system-arm; ./dev test embedded installs them)" >&2; exit 3; }
  done
  echo '#include <array>' | arm-none-eabi-g++ -x c++ -fsyntax-only - 2>/dev/null || { echo "arm-none-eabi-g++ has no C++ library (on Debian: libstdc++-arm-none-eabi-newlib)" >&2; exit 3; }
}

compile_c() { arm-none-eabi-gcc "${target[@]}" "${c_flags[@]}" "$@"; }
compile() { arm-none-eabi-g++ "${target[@]}" "${flags[@]}" -I"$board/.." "$@"; }

# See note [instructions] in board.hpp for the shift. What a program writes goes to the standard error of QEMU.
run_board() {
  timeout 120 qemu-system-arm -M mps2-an386 -cpu cortex-m4 -nographic -monitor none -serial none -icount shift=8 \
    -semihosting-config enable=on,target=native -kernel "$1" </dev/null 2>&1
}
