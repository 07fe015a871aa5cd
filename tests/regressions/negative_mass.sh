# A mass below zero moves a spring the wrong way: it is refused with its value, whether the model or the command line makes it so.
dalembert 2 simulate "$model" --no-plot
prints "mass of body 'block' is -2 kg at the start, but must not be below zero"
sed 's/"-m"/"m"/' "$model" >positive.toml
dalembert 0 simulate positive.toml --no-plot
dalembert 2 simulate positive.toml --parameter m=-1 --no-plot
prints "mass of body 'block' is -1 kg at the start"
