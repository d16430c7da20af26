#!/usr/bin/env bash
# The same bytes whatever the number of threads, and each time: every tool with something to share out. STABLECUT_OTHER_TOOLS names the folder
# of another build's tools, whose bytes have to be the same too: scripts/check --all has those of a build without optimisation there.
. "$SOURCE/apps/testing.sh"

# Nor does it matter how wide a processor's registers are: compilers fuse products and sums where only the widest have that, against their orders too.
for library in "$(dirname "$(command -v fit-modes)")"/../lib/*/lib*.a; do
  objdump -d --no-show-raw-insn "$library" | sed -nE "s|^[^ ]+: +file format.*|read|p; s/.*\b(vfn?m(add|sub)[a-z0-9]*).*/\1/p" |
    sort -u | sed "s|^|$(basename "$library"): |"
done >instructions
check "all rooms' libraries are read" test "$(grep -c ': read$' instructions)" -ge 10
fused=$(sed '/: read$/d' instructions)
check "no fused multiply-add in ${fused:-any library}" test -z "$fused"

table=$data/thesis-table-6-2.json cut=$data/thesis-cut.json robot=(--robot "$data/kr360.json")
chart=(--speed 8000:20000:9 --depth 0:3:9)

# same NAME COMMAND...: the bytes with one thread are those with 2, 3 and 8, and of a second run with 8; and those of the other build.
same() {
  local name=$1 count; shift
  "$@" --threads 1 >one.json || bad "$name: status $?"
  for count in 2 3 8 8; do
    "$@" --threads $count >several.json
    check "$name with $count threads" cmp one.json several.json
  done
  [ -n "${STABLECUT_OTHER_TOOLS:-}" ] || return 0
  "$STABLECUT_OTHER_TOOLS/$1" "${@:2}" --threads 2 >other.json
  check "$name by the other build" cmp one.json other.json
}

jq '.kt_std_n_per_mm2 = 30 | .kr_std_n_per_mm2 = 20' "$cut" >sure.json
jq '.feed_per_tooth_mm = 0.1 | .diameter_mm = 12' "$cut" >fed.json
same "a chart" sdm-lobes "$table" --cut "$cut" "${chart[@]}" --per-mode --modes 14,15
same "a chart by semi-discretization" sdm-lobes "$table" --cut "$cut" --speed 9000:12000:4 --depth 0:2:4 --modes 14,15 --method sdm
same "samples" sdm-lobes "$table" --cut sure.json "${chart[@]}" --samples 8 --limit-only
same "a surface" sdm-lobes "$table" --cut fed.json "${chart[@]}" --surface
jq '.helix_deg = 30 | .pitch_deg = [170, 190]' fed.json >helical.json
same "a helix" sdm-lobes "$table" --cut helical.json --modes 14,15 --speed 9000:12000:4 --depth 0:2:4
same "points" sdm-lobes "$table" --cut "$cut" "${chart[@]}" --points "$data/thesis-table-6-3.csv"
same "simulated cuts" cut-force --table "$table" --speed 9000 --points "$data/thesis-table-6-3.csv" --passes 64 fed.json

fit-modes --synthesize 400:1500:220 --noise-db 50 "$table" >tap.json
same "modes" fit-modes --quiet tap.json
/usr/bin/python3 "$SOURCE/apps/fit-modes/simulate_taps.py" .
same "records of taps" fit-modes --quiet --taps x=x.csv
joint-stiffness --quiet "${robot[@]}" "$data/kr360-loads.csv" >stiffness.json
same "joint stiffness" joint-stiffness --quiet "${robot[@]}" "$data/kr360-loads.csv"
same "poses" best-pose --quiet "${robot[@]}" --height 1200 --x 1000:2000:4 --y 0:1000:4 stiffness.json
same "a path" best-pose --quiet "${robot[@]}" --path "$data/zigzag-path.json" stiffness.json
same "an assembly" rcsa-couple --quiet "$data/liu-assembly.json"
same "a joint" rcsa-couple --quiet --identify "$data/carbide-tap.json" "$data/carbide-in-collet.json"
same "coefficients" cut-force --quiet --identify "$data/slot-forces.csv" "$data/slotting-tool.json"
