# A mass below zero moves a spring the wrong way: it is refused with its value, whether the model or the command line makes it so.
dalembert 2 simulate "$model" --no-plot
prints "mass of body 'block' is -2 kg at the start, but must not be below zero"
sed 's/"-m"/"m"/' "$model" >positive.toml
dalembert 0 simulate positive.toml --no-plot
dalembert 2 simulate positive.toml --parameter m=-1 --no-plot
prints "mass of body 'block' is -1 kg at the start"
# So is an inertia, of a body that turns in the plane or about an axis.
cat >wheel.toml <<'MODEL'
[model]
format = 1
name   = "wheel"
[parameters]
J = { value = 2, unit = "kg*m^2" }
[coordinates]
phi = { unit = "rad", start = 0.1 }
[bodies.wheel]
rotation = "phi"
inertia  = "-J"
[runs.reference]
until = 1
MODEL
dalembert 2 simulate wheel.toml --no-plot
prints "inertia of body 'wheel' is -2 kg\*m\^2 at the start, but must not be below zero"
# Every verb that works with values refuses them, not only those that run.
for verb in evaluate equilibrium modal; do
  dalembert 2 $verb positive.toml --parameter m=-1
  prints "mass of body 'block' is -1 kg at the start"
done
