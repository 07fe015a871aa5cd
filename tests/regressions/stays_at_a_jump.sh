# SPDX-License-Identifier: GPL-3.0-or-later
# A jump that both sides lead back to: the run took millions of steps there, and ended without a word of the jump.
limit=20 dalembert 4 simulate "$model" --no-plot
prints "too many steps; it stays at a kink or jump where v is zero, because both sides lead back to it"
