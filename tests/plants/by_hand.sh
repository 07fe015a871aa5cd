# A plant that is written by hand in C is simulated, and one that crashes or hangs is told by name.
library() { ${CC:-cc} -std=c99 -Wall -Wextra -Wpedantic -Werror -fPIC -shared "$@" -I"$SOURCE/runtime" "$SOURCE/tests/plants/pendulum.c" -o "$name" -lm || fail "the plant does not compile"; }

name=pendulum.so library
# From 1 rad it is back after 4 K(sin 1/2) sqrt(l/g), K by the arithmetic-geometric mean.
period=$(awk 'BEGIN { a = 1; b = cos(0.5); for (i = 0; i < 8; ++i) { c = (a + b)/2; b = sqrt(a*b); a = c } printf "%.17g", 2*3.14159265358979323846/a*sqrt(0.5/9.81) }')
dalembert 0 simulate pendulum.so --until "$period" --tolerance 1e-12 --no-plot
near "the angle" "$(last pendulum_by_hand.csv phi)" 1 1e-10
near "its rate" "$(last pendulum_by_hand.csv 'dot(phi)')" 0 1e-9
near "the height" "$(last pendulum_by_hand.csv height)" "$(awk 'BEGIN { print 0.5*(1 - cos(1)) }')" 1e-6
dalembert 0 simulate pendulum.so --until 3 --parameter d=0.5,l=2 --state phi=0.3 --input a=0.2 --method rodas5p --no-plot
prints 'energy error'
dalembert 2 simulate pendulum.so --no-plot
prints 'give the end of the run with --until'
dalembert 2 simulate pendulum.so --until 500ms --no-plot
prints "as a number of seconds, not '500ms'"
dalembert 2 simulate pendulum.so --until 1 --scene lab --no-plot
prints "'--scene' is for models"
dalembert 2 simulate pendulum.so --until 1 --parameter mass=2 --no-plot
prints "plant 'pendulum' has no 'mass'"
dalembert 2 simulate pendulum.so --until 1 --parameter l=long --no-plot
prints "'--parameter l=long' is not of the form NAME=NUMBER"

name=crash.so library -DCRASH
dalembert 2 simulate crash.so --until 2 --no-plot
prints "the plant 'crash.so' crashed in a call"
name=hang.so library -DHANG
dalembert 2 simulate hang.so --until 2 --no-plot --stage-seconds 2
prints "the plant 'hang.so' did not finish a call within 2 s"

echo 'int nothing;' >nothing.c
${CC:-cc} -shared -fPIC nothing.c -o nothing.so
dalembert 2 simulate nothing.so --until 1
prints 'does not export the function dalembert_plant_table'
echo text >text.so
dalembert 2 simulate text.so --until 1
prints "'text.so' is no plant|/text.so' is no plant"
