# `compile` writes a plant that `simulate` runs like the model; the cache keeps plants, and does no harm when something in it is broken.
export XDG_CACHE_HOME=$PWD/cache
pendulum=$SOURCE/systems/mechanics/pendulum.toml
dalembert 0 compile "$pendulum"
prints 'exports dalembert_plant_table'
[ -s pendulum_full.so ] && [ -s dalembert_plant.h ] || fail "plant or header are missing"
echo '#include "dalembert_plant.h"' >user.c
${CC:-cc} -std=c99 -Wall -Wextra -Wpedantic -Werror -c user.c -o user.o || fail "the header does not compile"
[ ! -e cache ] || fail "compile uses the cache"
same="--until 2 --samples 50 --method rk4 --step 0.01 --no-plot"
mkdir model plant
dalembert 0 simulate "$pendulum" $same -o model
dalembert 0 simulate pendulum_full.so $same -o plant
cut -d, -f1-3 model/pendulum_full.csv >a; cut -d, -f1-3 plant/pendulum_full.csv >b
cmp a b || fail "model and plant differ"

count() { ls cache/dalembert/plants 2>/dev/null | wc -l; }
[ "$(count)" -eq 2 ] || fail "the cache holds $(count) files, expected a plant and its text"
# Another value of a parameter is no other plant; other inputs or models are.
dalembert 0 simulate "$pendulum" --until 2 --no-plot --parameter g=3 -o other
[ "$(count)" -eq 2 ] || fail "a parameter made another plant"
CXX=/nowhere/c++ dalembert 3 simulate "$pendulum" --until 2 --no-plot -o other
prints "the compiler '/nowhere/c\+\+' cannot be started; set CXX"
# What is broken is made anew.
for f in cache/dalembert/plants/*.so; do echo broken >"$f"; done
dalembert 0 simulate "$pendulum" $same -o broken
cmp broken/pendulum_full.csv model/pendulum_full.csv || fail "after a broken cache the run differs"
# --explain tells where a plant came from.
dalembert 0 simulate "$pendulum" $same -o again --explain
prints "plant .* kept before as $XDG_CACHE_HOME/dalembert/plants/"
dalembert 0 simulate pendulum_full.so --until 1 --no-plot -o plant --explain
prints "plant .* loaded from pendulum_full.so"
# A folder that nobody may write to, or none: no cache, no error.
XDG_CACHE_HOME=/proc/nowhere dalembert 0 simulate "$pendulum" --until 2 --no-plot --explain -o other
prints "plant .* compiled, not kept: there is no folder for caches"
dalembert 0 equilibrium "$pendulum" --no-cache --explain
prints "plant .* compiled, not kept$"
# Several at once, and one that is killed.
rm -rf cache
for i in 1 2 3 4; do "$PROGRAM" simulate "$pendulum" $same -o "at_once$i" >/dev/null 2>&1 & done
wait
for i in 1 2 3 4; do cmp "at_once$i/pendulum_full.csv" model/pendulum_full.csv || fail "one of several at once differs"; done
rm -rf cache
timeout -s KILL 0.15 "$PROGRAM" simulate "$pendulum" --until 2 --no-plot -o killed >/dev/null 2>&1
dalembert 0 simulate "$pendulum" $same -o after
cmp after/pendulum_full.csv model/pendulum_full.csv || fail "after one that was killed the run differs"
# The program of runtime/README.md.
sed -n '/^```c$/,/^```$/p' "$SOURCE/runtime/README.md" | sed '1d;$d' >load.c
${CC:-cc} -std=gnu99 -Wall -Wextra -Werror load.c -o load -ldl || fail "the program of runtime/README.md does not compile"
./load ./pendulum_full.so >printed || fail "the program of runtime/README.md fails"
prints '^d/dt dot\(phi\) = '
