# SPDX-License-Identifier: GPL-3.0-or-later
# sinc(x) is sin(x)/x, 1 at x = 0 and without slope there; 1 psi is 6894.757293168361 Pa.
dalembert 0 check "$model"
prints 'motion.*proven'
dalembert 0 evaluate "$model"
prints 'force +68\.9475729'
prints 'slope +0'
dalembert 0 evaluate "$model" --state s=0.5
prints 'force +45\.84'
prints 'slope +-1\.1885'
dalembert 0 generate "$model" -o out
sed 's/sinc(k\*s)" }$/sinc(s)" }/' "$model" >wrong.toml
dalembert 2 check wrong.toml
prints "error\[unit-mismatch\].*'s' is in 'm'"
cat >printed.toml <<'TEXT'
[catalogue]
format = 1
source = "sinc in print"

[positive]
x = "1"

[entries."(1)"]
latex = '''x \operatorname{sinc}(x) = \sin x'''
[entries."(2)"]
latex = '''\operatorname{sinc}(x) = \cos x'''
expect = "wrong"
TEXT
dalembert 0 check printed.toml
prints '^  \(1\) +proven$'
prints '^  \(2\) +wrong, as expected$'
