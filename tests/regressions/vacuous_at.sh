# SPDX-License-Identifier: GPL-3.0-or-later
# 0 + 0 = 0 at the point of `at` was "proven".
dalembert 0 check "$model"
prints "nonsense at rest +not checkable"
prints "no force at rest +proven"
prints "stiffness at rest +proven"
