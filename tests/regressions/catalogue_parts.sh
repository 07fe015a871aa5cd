# SPDX-License-Identifier: GPL-3.0-or-later
# One equation that could not be read took the whole entry with it. What may be a condition of the others still does.
dalembert 2 check "$model" -o pages
prints '^  \(1\) +proven; 2 of 3 equations are read$'
prints '^      not read: +equation 2: '
prints '^  \(2\) +wrong; 2 of 3 equations are read, as expected$'
prints '^  \(3\) +proven; 2 of 3 equations are read$'
for k in 4 5 6 7 8 9; do prints "^  \\($k\\) +not read: "; done
prints '^  \(10\) +proven$'
prints '^4 printed equations: 3 proven, 1 wrong; 3 of them could not be read in full; 6 more could not be read$'
grep -q 'Not read: equation 2: ' pages/book.html || fail "the equation that is not read is not on the page"
