# The lines $from to $to (Hz) of a frf document.
.frequency_hz as $f | [range($f | length) | select($f[.] >= $from and $f[.] <= $to)] as $lines
| def part: . as $values | [$lines[] | $values[.]];
  .frequency_hz |= part
  | .h |= map(.re |= part | .im |= part | if .variance then .variance |= part else . end | if .coherence then .coherence |= part else . end)
