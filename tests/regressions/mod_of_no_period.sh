# SPDX-License-Identifier: GPL-3.0-or-later
# A period of zero, and any division by a parameter that is zero in a run, was refused without file, line and key.
dalembert 2 simulate "$model" --run saw
prints "mod_of_no_period.toml:26:17: error\[division-by-zero\]: 'mod\(t, P\)\*\(1 N/s\)' divides by zero, or by a period of zero, with the parameters of this run"
prints '26 \| inputs = '
dalembert 2 simulate "$model" --run slow
prints "mod_of_no_period.toml:30:17: error\[division-by-zero\]: '\(1 N\)\*t/P' divides by zero"
dalembert 2 simulate "$model" --until 1 --input 'f=(1 N)*mod(t/(1 s), 0)'
prints "error\[division-by-zero\]: the period '0' of 'mod\(t/\(1 s\), 0\)' is zero, but must be positive"
dalembert 2 simulate "$model" --until 'mod(4, 0)' --input f=1
prints "--until:1:1: error\[division-by-zero\]"
