# A capacity, a volume or a gas constant below zero is refused with its value, whether the model or the command line makes it so.
cat >pot.toml <<'MODEL'
[model]
format = 1
name   = "pot"
[parameters]
C = { value = 500, unit = "J/K" }
G = { value = 2, unit = "W/K" }
[states]
T = { unit = "K", start = 350 }
[nodes]
pot  = { temperature = "T", capacity = "C" }
room = { temperature = "293 K" }
[links.loss]
from        = "pot"
to          = "room"
conductance = "G"
[runs.reference]
until = 10
MODEL
cat >bottle.toml <<'MODEL'
[model]
format = 1
name   = "bottle"
[parameters]
V   = { value = 2, unit = "l" }
R   = { value = 287, unit = "J/(kg*K)" }
A   = { value = 1, unit = "mm^2" }
[states]
p = { unit = "bar", start = 8 }
T = { unit = "K", start = 293 }
[media.air]
law           = "ideal_gas"
gas_constant  = "R"
isochoric_heat = "718 J/(kg*K)"
[volumes.bottle]
medium      = "air"
volume      = "V"
pressure    = "p"
temperature = "T"
[reservoirs.room]
medium      = "air"
pressure    = "1 bar"
temperature = "293 K"
[flows.leak]
from = "bottle"
to   = "room"
law  = "pneumatic_orifice"
area = "A"
coefficient = 1
[runs.reference]
until = 1
MODEL
for model in pot bottle; do dalembert 0 simulate $model.toml --no-plot; done
for verb in simulate evaluate equilibrium; do
  dalembert 2 $verb pot.toml --parameter C=-5
  prints "the heat capacity of 'pot' is -5 J/K"
  dalembert 2 $verb pot.toml --parameter G=-2
  prints "conductance"
  dalembert 2 $verb bottle.toml --parameter V=-1l
  prints "is -0.001 m\^3 at the start"
  dalembert 2 $verb bottle.toml --parameter R=-1
  prints "the gas constant of medium 'air' is -1 J"
done
