#!/usr/bin/env bash
# The second step of the action: runs `parity report`, writes the job's summary, says what came of it.
# PARITY_SCENES or PARITY_SUITE, PARITY_BUDGETS, PARITY_BASELINE, PARITY_APPROVALS, PARITY_ARGS, PARITY_FAIL_ON,
# PARITY_REPORT, PARITY_ANNOTATE. The exit code is parity's where it is at least what PARITY_FAIL_ON names, else 0.
set -uo pipefail
fail() { echo "::error title=parity::$*" && exit 64; }

case $PARITY_FAIL_ON in
warning) least=1 ;;
over-budget) least=2 ;;
error) least=3 ;;
*) fail "fail-on: neither warning, over-budget nor error" ;;
esac
case $PARITY_ANNOTATE in true | false) ;; *) fail "annotate: neither true nor false" ;; esac
case $PARITY_REPORT in '' | *$'\n'*) fail "report: not the name of a folder" ;; esac

words=()
add_lines() { # each line that is not blank is one word
  local line
  while IFS= read -r line || [ -n "$line" ]; do
    line=${line%$'\r'}
    [ -z "${line//[[:space:]]/}" ] || words+=("$line")
  done <<<"$1"
}
[ -z "$PARITY_SUITE" ] || words+=("--suite=$PARITY_SUITE")
[ -z "$PARITY_BUDGETS" ] || words+=("--budgets=$PARITY_BUDGETS")
[ -z "$PARITY_BASELINE" ] || words+=("--baseline=$PARITY_BASELINE")
[ -z "$PARITY_APPROVALS" ] || words+=("--approvals=$PARITY_APPROVALS")
[ "$PARITY_ANNOTATE" = false ] || words+=(--annotate=github)
[ "$PARITY_FAIL_ON" != warning ] || words+=(--warn-exit)
add_lines "$PARITY_ARGS"
if [ -n "${PARITY_SCENES//[[:space:]]/}" ]; then
  [ -z "$PARITY_SUITE" ] || fail "give 'scenes' or 'suite', not both"
  words+=(--) # what follows is no option, whatever it is called
  add_lines "$PARITY_SCENES"
elif [ -z "$PARITY_SUITE" ]; then
  fail "give 'scenes' or 'suite'"
fi

said=$(mktemp)
trap 'rm -f "$said" "$said.md"' EXIT
# parity appends the summary to $GITHUB_STEP_SUMMARY itself; the file here tells whether it came to that.
parity report "--output=$PARITY_REPORT" "--summary=$said.md" "${words[@]}" 2>&1 | tee "$said"
code=${PIPESTATUS[0]}

case $code in
0) verdict=pass ;;
1) verdict=warn ;;
2) verdict=fail ;;
*) verdict=error ;;
esac
# Without --warn-exit 0 says nothing of warnings; the report does.
if [ "$code" = 0 ] && grep -q '^  "verdict": "warn"' "$PARITY_REPORT/report.json" 2>/dev/null; then verdict=warn; fi

# Without a summary: what was printed. An indented block holds any text: nothing in it ends the block. GitHub takes 1 MiB.
[ -s "$said.md" ] || {
  echo "## parity: $verdict"
  echo
  grep -v '^::' "$said" | head -c 900000 | sed 's/^/    /'
  echo
} >>"$GITHUB_STEP_SUMMARY"

{
  echo "exit-code=$code"
  echo "verdict=$verdict"
  [ ! -d "$PARITY_REPORT" ] || echo "report=$PARITY_REPORT"
} >>"$GITHUB_OUTPUT"
[ "$code" -lt "$least" ] || exit "$code"
