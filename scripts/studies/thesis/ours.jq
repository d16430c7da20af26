# Our numbers, by the names of paper.tsv.
def missed: [.[0].points[] | select(.agrees | not) | "\(.depth_mm) mm at \(.speed_rpm) rpm"] | join(", ");
{
  modes: ($modes[0].modes | length),
  modes_in_text: ($modes[0].modes | length),
  missed_sdm: ($sdm | missed),
  missed_converged: ($lobes | missed),
  missed_transposed: ($transposed | missed),
  missed_nine: ($nine_modes | missed),
  # Modes with a limit of their own below 20 mm somewhere from 5000 to 20 000 rpm.
  own_limit: ([$per_mode_deep[0].per_mode[] | select(any(.limit[]; .depth_mm != null)) | .mode | tostring] | join(", ")),
  recommended: ([$recommended[0].limit[].depth_mm // infinite] | min)
} | to_entries[] | "\(.key)\t\(.value)"
