# SPDX-License-Identifier: GPL-3.0-or-later
# sinc(x) is sin(x)/x, 1 at x = 0 and without slope there; 1 psi is 6894.757293168361 Pa.
dalembert 0 check "$model"
prints 'printed.*motion.*proven|motion.*proven'
prints 'latex.*proven'
dalembert 0 evaluate "$model"
prints 'force += 68\.9475729'
prints 'slope += 0'
dalembert 0 evaluate "$model" --state s=0.5
prints 'force += 45\.84'
prints 'slope += -1\.1885'
dalembert 0 generate "$model" -o out
sed 's/sinc(k\*s)" }$/sinc(s)" }/' "$model" >wrong.toml
dalembert 2 check wrong.toml
prints "error\[unit-mismatch\].*'s' is in 'm'"
