# SPDX-License-Identifier: GPL-3.0-or-later
# A program that was interrupted left its compiler running, and folders among the temporary files.
mkdir temporary
for signal in TERM HUP; do
  TMPDIR=$here/temporary "$PROGRAM" simulate "$model" --no-cache -o results >printed 2>&1 &
  program=$!
  for _ in $(seq 600); do
    pgrep -f "$here/temporary" >compilers && break
    sleep 0.05
  done
  [ -s compilers ] || fail "no compiler was started"
  kill -$signal $program
  got=0
  wait $program || got=$?
  [ $got -eq $((128 + $(kill -l $signal))) ] || fail "exit code $got"
  for _ in $(seq 20); do
    pgrep -f "$here/temporary" >compilers || break
    sleep 0.05
  done
  [ ! -s compilers ] || fail "still running: $(cat compilers)"
  [ -z "$(ls -A temporary)" ] || fail "left behind: $(ls -A temporary)"
  [ ! -e results ] || fail "results were begun"
done
