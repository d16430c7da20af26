# Shared by the plot scripts: options, the gnuplot terminal. Source it, then call plot_options "$@".
# What it sets is read, and what it reads is set, by the scripts that source it.
# shellcheck shell=bash disable=SC2034,SC2154

scripts=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

plot_fail() { echo "$(basename "$0"): $1" >&2; exit "${2:-64}"; }

# Sets inputs (at most $most_inputs, 1 by default) and input (the first), output ("-": standard output), form (svg, png,
# dumb), and extra[NAME] for the options named in $value_options, as in value_options="--fitted", and in $flag_options.
# Prints $usage for --help.
plot_options() {
  output=- form=
  declare -gA extra=()
  declare -ga inputs=()
  while [ $# -gt 0 ]; do
    case "$1" in
      -h|--help) echo "$usage"; exit 0 ;;
      -o|--output) [ $# -ge 2 ] || plot_fail "$1: expected a file"; output=$2; shift 2 ;;
      --terminal) form=dumb; shift ;;
      -) inputs+=(-); shift ;;
      -*)
        if [[ " ${flag_options:-} " == *" $1 "* ]]; then extra[$1]=1; shift; continue; fi
        [[ " $value_options " == *" $1 "* ]] || plot_fail "$1: unknown option (see $(basename "$0") --help)"
        [ $# -ge 2 ] || plot_fail "$1: expected a value"
        extra[$1]=$2; shift 2 ;;
      *) inputs+=("$1"); shift ;;
    esac
  done
  [ ${#inputs[@]} -le "${most_inputs:-1}" ] || plot_fail "expected at most ${most_inputs:-1} input$([ "${most_inputs:-1}" -eq 1 ] || echo s)"
  [ ${#inputs[@]} -gt 0 ] || inputs=(-)
  input=${inputs[0]}
  command -v gnuplot >/dev/null && command -v jq >/dev/null || plot_fail "gnuplot and jq are needed (scripts/setup)" 70
  if [ -z "$form" ]; then
    case "$output" in
      -) if [ -t 1 ]; then form=dumb; else form=svg; fi ;;
      *.svg) form=svg ;;
      *.png) form=png ;;
      *) plot_fail "$output: expected a name that ends in .svg or .png" ;;
    esac
  fi
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
}

# plot_input PATH KIND NAME: checks the document against the schema of its kind and copies it to $work/NAME, without provenance
# and with letters, digits and harmless signs for strings. What is a number in the schema can stand in gnuplot's commands and
# in the shell's arithmetic; a text can stand there in quotes only.
plot_input() {
  local shown=$1
  if [ "$1" = - ]; then shown="<stdin>"; cat >"$work/raw"
  else cat -- "$1" >"$work/raw" 2>/dev/null || plot_fail "$1: cannot be read" 66; fi
  local format
  format=$(jq -r '.format? // "none"' "$work/raw" 2>/dev/null) || plot_fail "$shown: not JSON: expected stablecut/$2/1" 65
  [ "$format" = "stablecut/$2/1" ] || plot_fail "$shown: /format: ${format:-nothing}: expected stablecut/$2/1" 65
  local broken
  broken=$(jq -r --slurpfile schema "$scripts/../schemas/$2.schema.json" -f "$scripts/schema.jq" "$work/raw" | tr -d '\000-\037\177') ||
    plot_fail "$shown: expected one document" 65
  [ -z "$broken" ] || plot_fail "$shown: $broken" 65
  jq -c 'del(.provenance) | walk(if type == "string" then gsub("[^A-Za-z0-9 _.,:/^+*()=%-]"; "?") else . end)' "$work/raw" >"$work/$3"
  rm "$work/raw"
}

# plot_text TEXT: the same of a text from the command line.
plot_text() { printf %s "$1" | LC_ALL=C tr -c 'A-Za-z0-9 _.,:/^+*()=%-' '?'; }

# plot_terminal WIDTH HEIGHT: the set terminal line, for the form.
plot_terminal() {
  case "$form" in
    svg) echo "set terminal svg size $1,$2 font 'DejaVu Sans,14' background 'white'" ;;
    png) echo "set terminal pngcairo size $1,$2 font 'DejaVu Sans,11'" ;;
    dumb)
      local columns=${COLUMNS:-$(tput cols 2>/dev/null || echo 100)}
      local colour=ansi
      { [ -t 1 ] && [ -z "${NO_COLOR:-}" ]; } || colour=mono
      echo "set terminal dumb $colour size $columns,$((columns > 120 ? 40 : 32)) noenhanced" ;;
  esac
}

# plot_run: runs $work/plot.gp and puts the picture where it belongs, whole.
plot_run() {
  (cd "$work" && gnuplot plot.gp) >"$work/picture" 2>"$work/messages" ||
    plot_fail "gnuplot failed: $(grep -v '^ *^\?$' "$work/messages" | tail -n 1)" 70
  if [ "$output" = - ]; then cat "$work/picture"
  else { cp "$work/picture" "$output.part" && mv "$output.part" "$output"; } 2>/dev/null || plot_fail "$output: cannot be created" 73; fi
}
