# The text of a plant is the same in every run, whatever order terms of its inputs have inside: a second run compiles nothing.
export XDG_CACHE_HOME=$PWD/cache
for run in 1 2 3 4 5 6; do
  dalembert 0 simulate "$SOURCE/systems/heat/friction_heat.toml" --scene warm --no-plot -o "$run"
  dalembert 0 simulate "$SOURCE/systems/hydraulics/pumped_storage.toml" --no-plot -o "$run"
  cmp "$run/friction_heat_warm.csv" 1/friction_heat_warm.csv || fail "run $run differs"
done
count=$(ls cache/dalembert/plants/*.so | wc -l)
[ "$count" -eq 2 ] || fail "$count plants were compiled for two models"
