#!/usr/bin/env bash
# scripts/studies/scale-out: a list of charts run one after another, by make, by GNU parallel and as a Slurm job array gives the same
# bytes, and what has failed is run again alone.
. "$SOURCE/apps/testing.sh"
. "$SOURCE/apps/pipeline/slurm_loopback.sh"
command -v make >/dev/null || { echo "skipped: make is not installed"; trap - EXIT; exit 77; }
ssh_pid=
trap '[ -z "$ssh_pid" ] || kill "$ssh_pid"; slurm_stop; finish || exit 1' EXIT
scale=$SOURCE/scripts/studies/scale-out
mkdir plan
cp "$data/thesis-table-6-2.json" plan/one.json
jq '.modes |= map(if .frequency_hz < 200 then .frequency_hz *= 0.8 else . end)' plan/one.json >plan/two.json
printf 'one\tone.json\ntwo\ttwo.json\n' >plan/poses.tsv
printf 'two-teeth\t{"teeth": 2, "diameter_mm": 12, "feed_per_tooth_mm": 0.1, "milling": "up", "radial_immersion": 0.25}\n' >plan/tools.tsv
printf 'soft\t{"kt_n_per_mm2": 500, "kr_n_per_mm2": 150}\nhard\t{"kt_n_per_mm2": 700, "kr_n_per_mm2": 300}\n' >plan/materials.tsv
options=(--limit-only --speed 9000:12000:4 --depth 0:3:2)

# A sdm-lobes that writes down its tasks, and fails at the task that the file "fail" names.
tool=$(command -v sdm-lobes)
mkdir path
printf '#!/bin/sh\nfor last; do :; done\nid=${last#results/}; id=${id%%.json}\necho "$id" >>%q\nif [ "$(cat %q 2>/dev/null)" = "$id" ]; then echo broken >&2; exit 1; fi\nexec %q "$@"\n' \
  "$PWD/ran" "$PWD/fail" "$tool" >path/sdm-lobes
chmod +x path/sdm-lobes
PATH=$PWD/path:$PATH
ran() { sort ran 2>/dev/null | tr '\n' ' '; rm -f ran; }
all='all/two-teeth-hard all/two-teeth-soft one/two-teeth-hard one/two-teeth-soft two/two-teeth-hard two/two-teeth-soft '

# One run, one after another.
"$scale/prepare" plan one-run "${options[@]}"
check "poses, and all of them, times tools times materials" test "$(wc -l <one-run/tasks.tsv)" -eq 6
check "in this order" grep -qx "$(printf '6\tall\ttwo-teeth\thard')" one-run/tasks.tsv
"$scale/run-tasks" one-run <one-run/tasks.tsv
check "one run" test "$(ran)" = "$all"
check "is merged" "$scale/merge" one-run
check "a line each task" test "$(wc -l <one-run/charts.tsv)" -eq 6
grep -P '\tall\t' one-run/charts.tsv | cut -f 5 | jq -s . >of-all.json
sdm-lobes --quiet --threads 1 "${options[@]}" plan/one.json plan/two.json --cut one-run/cuts/two-teeth-hard.json -o by-hand.json
check_jq "the chart of all poses is that of both tables" of-all.json '.[1].limit == $one[0].limit' --slurpfile one by-hand.json
rm -f ran
# The best cut with the least margin stands where speed times limit is largest.
expected=$(jq -r '[.limit[], (.what_to_run.limit_between // [])[] | [.speed_rpm, (.depth_mm // 3)]] | max_by(.[0] * .[1]) | .[0] | round' by-hand.json)
check "the best cut over all poses" grep -qE "^\| hard \| 0(\.5)? \| two-teeth \| $expected \|" one-run/summary.md
awk -F '|' '$2 ~ /hard/ { if (n++ && ($3 <= margin || $7 >= removal)) exit 1; margin = $3 + 0; removal = $7 + 0 } END { exit n < 2 }' one-run/summary.md
check "on the front more margin costs removal" test $? -eq 0

# same NAME FOLDER: the merged result is that of the one run, byte for byte.
same() { check "$1: the bytes of one run" cmp -s one-run/charts.tsv "$2/charts.tsv"; check "$1: and its summary" cmp -s one-run/summary.md "$2/summary.md"; }
# engine NAME FOLDER COMMAND...: the command with an injected failure, without, and once more.
engine() {
  local name=$1 folder=$2; shift 2
  echo two/two-teeth-hard >fail
  "$@" >.log 2>&1
  check "$name: a failed task is no success" test $? -ne 0
  check "$name: all were tried" test "$(ran)" = "$all"
  check "$name: one has no result, and there is no merged one" test "$("$scale/todo" "$folder" | cut -f 1)" = 4 -a ! -e "$folder/charts.tsv"
  find "$folder/results" -name '*.json' -printf '%P %i %T@\n' | sort >before
  rm fail
  check "$name: again" "$@" >.log 2>&1
  check "$name: the failed task alone is run" test "$(ran)" = 'two/two-teeth-hard '
  check "$name: nothing else is touched" test "$(find "$folder/results" -name '*.json' -printf '%P %i %T@\n' | sort | comm -12 - before | wc -l)" -eq 5
  same "$name" "$folder"
  check "$name: with nothing to do" "$@" >.log 2>&1
  check "$name: nothing is run" test -z "$(ran)"
}
# Two nodes, node1 and node2, by one server on this machine.
ssh_start() {
  [ -x /usr/sbin/sshd ] && [ "$(id -u)" -eq 0 ] || return 1
  mkdir -p /run/sshd && mkdir ssh && chmod 700 ssh || return 1
  ssh-keygen -q -t ed25519 -N '' -f ssh/host && ssh-keygen -q -t ed25519 -N '' -f ssh/user || return 1
  local port=$((20000 + ($$ + 7) % 20000))
  printf '%s\n' "Port $port" 'ListenAddress 127.0.0.1' "HostKey $PWD/ssh/host" "AuthorizedKeysFile $PWD/ssh/user.pub" 'StrictModes no' \
    'PermitRootLogin yes' 'UsePAM no' 'MaxStartups 100' >ssh/sshd_config
  printf '%s\n' 'Host node1 node2' 'HostName 127.0.0.1' "Port $port" "IdentityFile $PWD/ssh/user" 'StrictHostKeyChecking no' \
    'UserKnownHostsFile /dev/null' 'LogLevel ERROR' >ssh/config
  /usr/sbin/sshd -D -f "$PWD/ssh/sshd_config" >/dev/null 2>&1 &
  ssh_pid=$!
  local i
  for ((i = 0; i < 20; ++i)); do ssh -F ssh/config node1 true 2>/dev/null </dev/null && return 0; sleep 0.2; done
  return 1
}
by_make() { make --no-print-directory -C "$scale" OUT="$PWD/$1" PLAN="$PWD/plan" OPTIONS="${options[*]}" TOOLS=/nonexistent "${@:2}"; }
engine make make/scale-out by_make make -j2
if command -v parallel >/dev/null; then
  mkdir -p home
  engine parallel parallel/scale-out env HOME="$PWD/home" make --no-print-directory -C "$scale" OUT="$PWD/parallel" PLAN="$PWD/plan" \
    OPTIONS="${options[*]}" TOOLS=/nonexistent CHUNK=2 parallel
  if ssh_start; then
    PARALLEL_SSH="ssh -F $PWD/ssh/config" engine "parallel over ssh" ssh-parallel/scale-out env HOME="$PWD/home" make --no-print-directory -C "$scale" \
      OUT="$PWD/ssh-parallel" PLAN="$PWD/plan" OPTIONS="${options[*]}" TOOLS=/nonexistent HOSTS=1/node1,1/node2 parallel
  else echo "skipped: no ssh server can be started on 127.0.0.1 (Debian: openssh-server, and root)"; fi
else echo "skipped: GNU parallel is not installed"; fi
if slurm_start >reason; then
  engine Slurm slurm/scale-out by_make slurm CHUNK=2 slurm
else echo "skipped: Slurm: $(cat reason)"; fi

# What does not fit together is refused.
refused 66 '^prepare: .*make/poses.tsv: cannot be read' "$scale/prepare" make plan2
sed -i '1s/^one/all/' plan/poses.tsv
refused 65 '^prepare: .*poses.tsv: all: stands for all poses together' "$scale/prepare" plan other
sed -i '1s/^all/a b/' plan/poses.tsv
refused 65 '^prepare: .*poses.tsv: expected different names' "$scale/prepare" plan other
sed -i '1s/^a b/two/' plan/poses.tsv
refused 65 '^prepare: .*poses.tsv: expected different names' "$scale/prepare" plan other
# What changes costs what came from it: here pose one is renamed, then a table is another, then a material is added, then an option is another.
left() { "$scale/prepare" plan one-run "$@" && "$scale/todo" one-run | cut -f 2,3,4 | tr '\t\n' '/ '; }
sed -i '1s/^two/three/' plan/poses.tsv
check "a new pose" test "$(left "${options[@]}")" = 'three/two-teeth/soft three/two-teeth/hard all/two-teeth/soft all/two-teeth/hard '
"$scale/run-tasks" one-run <one-run/tasks.tsv
cp plan/one.json plan/two.json
check "another table" test "$(left "${options[@]}")" = 'two/two-teeth/soft two/two-teeth/hard all/two-teeth/soft all/two-teeth/hard '
"$scale/run-tasks" one-run <one-run/tasks.tsv
printf 'harder\t{"kt_n_per_mm2": 900, "kr_n_per_mm2": 300}\n' >>plan/materials.tsv
check "a new material" test "$(left "${options[@]}")" = 'three/two-teeth/harder two/two-teeth/harder all/two-teeth/harder '
refused 1 '^merge: 3 tasks without a result: 3 6 9' "$scale/merge" one-run
check "another option" test "$(left --limit-only --speed 9000:12000:5 --depth 0:3:2 | wc -w)" -eq 9
