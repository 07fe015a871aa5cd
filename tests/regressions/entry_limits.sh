# SPDX-License-Identifier: GPL-3.0-or-later
# The limits of an entry, which has a process of its own, had no test: the entry ends at them, and all others keep their verdicts.
ends() { # ends SENTENCE OPTION VALUE
  dalembert 1 check "$model" -o pages "$2" "$3"
  prints '^  before +proven$'
  prints "^  long +not checked: it needs more $1"
  prints '^  after +proven$'
  prints '2 proven; 1 more could not be checked'
  grep -q "it needs more $1" pages/book.html || fail "the page does not say it"
}
ends 'than 0\.3 s of processor time' --stage-seconds 0.3
ends 'memory than the limit of 0\.3 GB' --memory 0.3
