# SPDX-License-Identifier: GPL-3.0-or-later
# A body with a mass on one that turns by a quaternion: under gravity, the program said that its own derivations disagree, because no proof knew
# that the quaternion has the norm one. The centre of mass falls freely: it begins at rest but for (omega x r)/2 = [0, 0.45, -0.3] m/s.
dalembert 0 check "$model"
dalembert 0 simulate "$model" --no-plot
digits "height of the centre of mass" "$(last body_on_a_quaternion_full.csv z_s)" -5.205 10
