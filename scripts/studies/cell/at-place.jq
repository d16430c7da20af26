# The modal table of a place: the robot's own modes, those below 200 Hz, as stiff as the robot is there, its mass the same: the
# frequency grows with the root of the stiffness, psi_R psi_L with the inverse of that root.
($poses[0].evaluated | map({key: .name, value: (.principal_stiffness_n_per_m | min)}) | from_entries) as $weakest
| ($weakest[$place] / $weakest.near | sqrt) as $factor
| .label = $place | .modes |= map(if .frequency_hz < 200 then
    .frequency_hz *= $factor | .psi_r |= map(map(. / ($factor | sqrt))) | .psi_l |= map(map(. / ($factor | sqrt)))
  else . end)
