#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# What README.md shows is what one gets: its files are taken out and used, its outputs and its table are compared.
set -euo pipefail
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
readme=$SOURCE/README.md

# block MARK: the lines of the fenced block behind <!-- MARK -->
block() {
  awk -v mark="<!-- $1 -->" '$0 == mark { armed = 1; next } armed && /^```/ { if (inside) exit; inside = 1; next } inside { print }' "$readme"
}

cd "$here"
block 'file: crane.toml' >crane.toml
block 'file: main.cpp' >main.cpp
block 'run: dalembert check crane.toml' | tail -n +2 >check.expected
block 'run: main' | tail -n +2 >main.expected
block 'file: wheel.toml' >wheel.toml
block 'run: dalembert check wheel.toml' | tail -n +2 >wheel.expected
block 'file: ladder.toml' >ladder.toml
block 'run: dalembert evaluate ladder.toml' | tail -n +2 >ladder.expected
block 'file: page.toml' >page.toml
block 'run: dalembert check page.toml' | tail -n +2 >page.expected
block 'file: lift.toml' >lift.toml
block 'run: dalembert check lift.toml' | tail -n +2 >lift.expected
block 'file: bar.toml' >bar.toml
block 'run: dalembert check bar.toml' | tail -n +2 >bar.expected
block 'file: block.toml' >block.toml
block 'run: dalembert simulate block.toml' | tail -n +2 >block.expected
block 'run: dalembert modal systems/mechanics/drive_train.toml' | tail -n +2 >modal.expected
for file in page.toml page.expected modal.expected ladder.toml ladder.expected wheel.toml wheel.expected block.toml block.expected crane.toml main.cpp check.expected main.expected lift.toml lift.expected bar.toml bar.expected; do [ -s "$file" ] || { echo "README.md has no block for $file"; exit 1; }; done

"$PROGRAM" check crane.toml >check.txt
diff check.expected check.txt
"$PROGRAM" check page.toml >page.txt && { echo "page.toml has a slip that was not seen"; exit 1; }
diff page.expected page.txt
"$PROGRAM" check wheel.toml >wheel.txt
diff wheel.expected wheel.txt
"$PROGRAM" modal "$SOURCE/systems/mechanics/drive_train.toml" >modal.txt
diff modal.expected modal.txt
"$PROGRAM" evaluate ladder.toml >ladder.txt
diff ladder.expected ladder.txt
"$PROGRAM" check lift.toml >lift.txt
diff lift.expected lift.txt
"$PROGRAM" check bar.toml >bar.txt
diff bar.expected bar.txt
"$PROGRAM" generate bar.toml --size N=10000 >/dev/null
[ "$(wc -c <bar_N10000_full.hpp)" -lt 50000 ] || { echo "the header of 10000 cells is large"; exit 1; }
"$PROGRAM" derive lift.toml >lift.derived
grep '^  dot(p) = ' "$readme" | while IFS= read -r line; do grep -qF -- "$line" lift.derived || { echo "not derived: $line"; exit 1; }; done
"$PROGRAM" simulate block.toml --no-plot >block.txt
# Energy errors are roundings.
diff <(sed 's/ = [0-9.e-]*$//' block.expected) <(sed 's/ = [0-9.e-]*$//' block.txt)
grep -q '^2.3544,floor_breaks_forwards,floor_sticks,floor_slides_forwards$' block_exact_events.csv
"$PROGRAM" derive crane.toml >/dev/null
"$PROGRAM" generate crane.toml >/dev/null
g++ -std=c++17 -O2 -Wall -Wextra -Wconversion -I. -I"$SOURCE/runtime" -isystem /usr/include/eigen3 main.cpp -o main
./main >main.txt
diff main.expected main.txt

# The right-hand side that is shown, line by line; "..." stands for what is left out.
awk '/^```cpp/ { inside = 1; shown = 0; next } /^```/ { inside = 0 } inside && /void rhs\(/ { shown = 1 } inside && shown { print }' "$readme" |
  grep -v '^ *\.\.\.$' | while IFS= read -r line; do
  grep -qF -- "$line" crane_real.hpp || { echo "not in the header: $line"; exit 1; }
done

# The table of what effects cost: what does not depend on the machine.
count=0
while IFS='|' read -r _ scene states operations _; do
  scene=$(grep -o '`[^`]*`' <<<"$scene" | tr -d '`')
  "$PROGRAM" generate "$SOURCE/systems/hydraulics/hydraulic_cylinder.toml" --scene "$scene" -o "$here" >generated.txt
  header=$(grep -o '^[^ ]*\.hpp' generated.txt)
  grep -q ", $(tr -d ' ' <<<"$operations") operations" generated.txt || { echo "README.md says $operations of scene $scene:"; cat generated.txt; exit 1; }
  grep -q "state_count = $(tr -d ' ' <<<"$states");" "$header" || { echo "README.md says $states states of scene $scene"; exit 1; }
  count=$((count + 1))
done < <(awk '/^## Only the effects/ { inside = 1; next } /^## / { inside = 0 } inside && /^\| `/' "$readme")
[ "$count" -ge 5 ] || { echo "README.md has no table of effects"; exit 1; }

# The table of systems.
count=0
while IFS='|' read -r _ file _ degrees operations _; do
  name=$(tr -d ' `' <<<"$file")
  model=$(echo "$SOURCE"/systems/*/"$name.toml")
  degrees=$(tr -d ' ' <<<"$degrees")
  operations=$(grep -o '[0-9]*' <<<"$operations" | head -1)
  "$PROGRAM" generate "$model" -o "$here" >generated.txt
  [ "$degrees" = N ] && degrees=3
  grep -q ": $degrees degrees of freedom, $operations operations" generated.txt || { echo "README.md says $degrees, $operations of $name:"; cat generated.txt; exit 1; }
  count=$((count + 1))
done < <(awk '/^## Only the effects/ { inside = 1; next } /^## / { inside = 0 } !inside' "$readme" | grep '^| `[a-z0-9_]*` | .* | [0-9N]* | ')
[ "$count" -eq "$(find "$SOURCE/systems" -name '*.toml' -not -path '*/book/*' | wc -l)" ] || { echo "the table has $count systems"; exit 1; }
echo "README.md tells the truth of $count systems and its example"
