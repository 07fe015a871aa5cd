# SPDX-License-Identifier: GPL-3.0-or-later
# The same left side twice in an entry that solves an equation ended the program; a key that does not exist took all verdicts with it.
dalembert 2 check "$model" -o pages
prints '^  \(1\) +proven$'
prints '^  \(2\) +proven$'
prints '^  \(3\) +wrong, as expected$'
prints '^  \(4\) +not read: .*latexx'
prints '^  \(5\) +proven$'
grep -q 'not read' pages/book.html || fail "the entry that is not read is not on the page"
grep -q '(5)' pages/book.html || fail "the last entry is not on the page"
