# Of frf documents with one entry.
def amplitudes: .h[0] as $h | [range($h.re | length) | ($h.re[.] * $h.re[.] + $h.im[.] * $h.im[.]) | sqrt];
# The paper's objective: the norm of the difference of amplitudes, over the lines from 1 to 5000 Hz in steps of 1 Hz.
def objective($other): [amplitudes, ($other | amplitudes)] | transpose | map((.[0] - .[1]) * (.[0] - .[1])) | add | sqrt;
# The frequency of the largest amplitude from $from to $to.
def peak($from; $to): amplitudes as $a | .frequency_hz as $f | [range($f | length) | select($f[.] >= $from and $f[.] <= $to)]
  | max_by($a[.]) | $f[.];
