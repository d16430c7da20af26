# Helpers of the command-line tests. Source it: it makes a scratch folder the working directory and ends with a count.
# shellcheck shell=bash
set -uo pipefail

# shellcheck disable=SC2034  # read by the scripts that source this
data=$SOURCE/testdata
scratch=$(mktemp -d)
cd "$scratch" || exit 1
checks=0 failures=0
finish() {
  cd /
  rm -rf "$scratch"
  echo "$((checks - failures)) passed, $failures failed"
  [ "$failures" -eq 0 ] && [ "$checks" -gt 0 ]
}
trap 'finish || exit 1' EXIT

ok() { checks=$((checks + 1)); }
bad() { checks=$((checks + 1)); failures=$((failures + 1)); echo "FAILED: $*"; }

# check NAME COMMAND...: the command succeeds.
check() { local name=$1; shift; if "$@"; then ok; else bad "$name"; fi; }

# check_jq NAME FILE FILTER [JQ OPTION...]: the filter gives true.
check_jq() {
  local name=$1 file=$2 filter=$3; shift 3
  if [ "$(jq "$@" "$filter" "$file" 2>&1)" = true ]; then ok; else bad "$name: $(jq -c "$@" "$filter" "$file" 2>&1 | head -c 300)"; fi
}

# refused STATUS PATTERN COMMAND...: the command ends with that status, writes nothing to standard output and one line to
# standard error that matches the extended regular expression. Its standard input is the caller's.
refused() {
  local status=$1 pattern=$2 got; shift 2
  "$@" >"$scratch/.out" 2>"$scratch/.err"; got=$?
  if [ $got -ne "$status" ]; then bad "$* : status $got, expected $status: $(head -n 1 "$scratch/.err")"
  elif [ -s "$scratch/.out" ]; then bad "$* : wrote to standard output"
  elif [ "$(wc -l <"$scratch/.err")" -ne 1 ]; then bad "$* : $(wc -l <"$scratch/.err") lines on standard error: $(cat "$scratch/.err")"
  elif ! grep -Eq -- "$pattern" "$scratch/.err"; then bad "$* : $(cat "$scratch/.err") does not match $pattern"
  else ok; fi
}

# same_for_every_tool TOOL KIND: what the contract says of every tool.
same_for_every_tool() {
  local tool=$1 kind=$2
  for option in --help --version --print-schema; do
    "$tool" $option >.out 2>.err </dev/null
    check "$tool $option" test $? -eq 0 -a -s .out -a ! -s .err
  done
  check "$tool --help: lines of 80 columns" test "$("$tool" --help | awk 'length > most {most = length} END {print most}')" -le 80
  "$tool" --help | grep -oE -- "^ +-[^ ]+" | grep -oE -- "--[a-z0-9-]+" | sort -u >.options
  sed 's/\\f[BIPR]//g; s/\\-/-/g' "$SOURCE/apps/$tool/$tool.1" >.page
  check "$tool: the manual page has every option" test -z "$(comm -23 .options <(grep -oE -- '--[a-z0-9-]+' .page | sort -u) | tee .missing)" -a -s .options
  check "$tool: and explains no other: $(cat .missing)" test -z "$(grep -A1 '^\.TP' .page | grep -E '^\.BR? "?-' | grep -oE -- '--[a-z0-9-]+' |
    sort -u | comm -13 .options -)"
  check "$tool: the manual page says where the fields of documents are" grep -q '^\.BR stablecut (5)' "$SOURCE/apps/$tool/$tool.1"
  check "$tool: the manual page has examples" grep -q '^\.SH EXAMPLES' .page
  "$tool" --print-schema >.schema
  check_jq "$tool --print-schema is $kind" .schema '.properties.format.const == "stablecut/'"$kind"'/1"'
  refused 64 "^$tool: --print-schema: nonsense: expected one of .*$kind" "$tool" --print-schema nonsense
  refused 64 "^$tool: --nonsense: unknown option" "$tool" --nonsense
  refused 64 "^$tool: --thraeds: unknown option: expected --threads" "$tool" --thraeds 2
  for shell in bash zsh; do "$tool" --print-completion $shell >.completion-$shell; done
  check "$tool: bash completes its options" test "$(bash -c '. ./.completion-bash
    COMP_WORDS=('"$tool"' --no-prov) COMP_CWORD=1; _'"${tool//-/_}"'; echo "${COMPREPLY[*]}"')" = --no-provenance
  check "$tool: bash completes a value behind =" test "$(bash -c '. ./.completion-bash
    COMP_WORDS=('"$tool"' --print-completion = ba) COMP_CWORD=3; _'"${tool//-/_}"'; echo "${COMPREPLY[*]}"')" = bash
  check "$tool: zsh is told of every option" test "$(grep -oE -- "'\*--[a-z0-9-]+" .completion-zsh | cut -c3- | sort -u)" = \
    "$("$tool" --help | grep -oE -- "^ +-[^ ]+" | grep -oE -- "--[a-z0-9-]+" | sort -u)"
  refused 64 "^$tool: --threads: 0: expected" "$tool" --threads 0
  refused 64 "^$tool: .*expected" "$tool" --threads x
  refused 66 "^$tool: missing.json: cannot be read" "$tool" missing.json "${@:3}"
  refused 66 "^$tool: \.: cannot be read" "$tool" . "${@:3}"
}
