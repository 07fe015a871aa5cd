# SPDX-License-Identifier: GPL-3.0-or-later
# States that no output reads vanished from equations, header, CSV and the plots that name them; inputs and parameters that nothing reads, too.
# tier: full
dalembert 0 derive "$model"
prints '^  dot\(E\) = P$'
prints '^  dot\(clicks\[2\]\) = '
prints_not 'T_far'
dalembert 0 evaluate "$model" --input gust=2
prints '^  spare +7 +m$'
prints '^  gust +2 +N$'
dalembert 0 derive "$model" --scene both
prints '^  dot\(T_far\) = 0$'

dalembert 0 simulate "$model" -o out --no-plot
near "E" "$(last out/unread_N2_near.csv E)" 500 1e-9
near "clicks[2]" "$(last out/unread_N2_near.csv 'clicks[2]')" 20 1e-9
near "gust" "$(last out/unread_N2_near.csv gust)" 3 0
