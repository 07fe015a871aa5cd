# SPDX-License-Identifier: GPL-3.0-or-later
# A gas at 20 K and 1 Pa after a typing slip was simulated without a word.
dalembert 0 simulate "$model" --run typed --no-plot -o .
prints "warning.*volume 'vessel' begins at 20 K; did you mean 20 degC\?"
prints "warning.*volume 'vessel' begins at 1 Pa; did you mean 1 bar\?"
for verb in check generate; do
  dalembert 0 $verb "$model" -o .
  prints "warning.*volume 'vessel' begins at 20 K; did you mean 20 degC\?"
done
dalembert 0 simulate "$model" --run reference --no-plot -o .
prints_not "did you mean"
