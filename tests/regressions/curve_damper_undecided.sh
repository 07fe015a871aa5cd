# SPDX-License-Identifier: GPL-3.0-or-later
# Of a damper by a curve whose sign the points do not decide nothing was said; of one turned round neither.
dalembert 0 check "$model"
prints "dissipated power not negative, damper stream: not checkable, since the points of curve 'drag' do not tell the sign of the power"
sed 's/drag(v - v_0)/drag(v)/' "$model" >through_zero.toml
dalembert 0 check through_zero.toml
prints_not "not checkable"
sed 's/drag(v - v_0)/-drag(v)/' "$model" >turned.toml
dalembert 2 check turned.toml
prints "damper 'stream' must resist its rate, but it drives where its curve 'drag' is -60 N at v = -1 m/s"
