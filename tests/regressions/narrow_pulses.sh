# SPDX-License-Identifier: GPL-3.0-or-later
# The pulses of a pattern in time were stepped over, without a word, by plants and FMUs, and where a controller set their width: they did
# not know its times. Now all of them pass the 399 events before the end, and agree with the current in closed form.
exact=$(awk 'BEGIN {
  U = 24; R_on = 0.005; G = 1e-6; R = 2; L = 0.02; f = 2000; w = 0.002
  R_in = R_on/(1 + R_on*G)
  r = R + R_in
  up = U/((1 + R_on*G)*r); down = U*G*R_in/r
  i = 0
  for (k = 0; k < 200; ++k) {
    i = up + (i - up)*exp(-r/L*w/f)
    i = down + (i - down)*exp(-r/L*(1 - w)/f)
  }
  printf "%.17g", i
}')
echo "in closed form: $exact A"
events() { # file, at least
  local count
  count=$(($(wc -l <"$1") - 1))
  [ "$count" -ge "$2" ] || fail "$1: $count events, not $2"
}
dalembert 0 simulate "$model" -o model --no-plot
near "current, model/narrow_pulses_full.csv" "$(last model/narrow_pulses_full.csv i)" "$exact" 1e-10
events model/narrow_pulses_full_events.csv 399
dalembert 0 compile "$model" -o plant
dalembert 0 simulate plant/narrow_pulses_full.so --until 0.1 --samples 20 --input w=0.002 -o run --no-plot
near "current, run/narrow_pulses_full.csv" "$(last run/narrow_pulses_full.csv i)" "$exact" 1e-10
events run/narrow_pulses_full_events.csv 399
dalembert 0 simulate "${model%.toml}_sampled.toml" -o sampled --no-plot
near "current, sampled/narrow_pulses_sampled_full.csv" "$(last sampled/narrow_pulses_sampled_full.csv i)" "$exact" 1e-10
events sampled/narrow_pulses_sampled_full_events.csv 399
# Parameters are those of the run.
dalembert 0 simulate plant/narrow_pulses_full.so --until 0.1 --samples 20 --input w=0.002 --parameter f=4000 -o faster --no-plot
events faster/narrow_pulses_full_events.csv 799
