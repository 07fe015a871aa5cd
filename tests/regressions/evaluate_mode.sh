# SPDX-License-Identifier: GPL-3.0-or-later
# `evaluate` took the first mode, also where the state is not in it: a moving gate was at rest, and friction held more than it can.
dalembert 0 evaluate "$model" --state "dot(s)=0.5"
prints "mode guides_slides_forwards_and_buffer_open"
prints_not "the state is not in mode"
dalembert 0 evaluate "$model" --input f=400
prints "mode guides_slides_forwards_and_buffer_open"
dalembert 0 evaluate "$model" --state s=5
prints "warning: the state is not in mode 'guides_sticks_and_buffer_open': the guard of event 'buffer_hits' is -1; no other mode accepts it"
dalembert 0 evaluate "$model" --state "dot(s)=0.5" --mode guides_sticks_and_buffer_open
prints "warning: the state is not in mode 'guides_sticks_and_buffer_open': the rate of 'guides' is 0.5 and not 0"
# A run that cannot start wrote a header and a CSV without a motion.
dalembert 4 simulate "$model" --state s=5 --until 1 --no-plot -o out
prints "no mode accepts the start values"
[ -z "$(find out -type f 2>/dev/null)" ] || fail "files of a run that did not start: $(ls out)"
