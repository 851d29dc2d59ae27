# Sourced by the script tests: SOURCE and PROGRAM from the arguments, a scratch folder that goes away, and what to say on failure.
set -eu
source_dir=$1
program=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
export source_dir program scratch

fail() {
  echo "FAILED: $*" >&2
  if [ -f "$scratch/out" ]; then sed 's/^/  | /' "$scratch/out" >&2; fi
  exit 1
}

# expect CODE COMMAND...: runs it without stdin, all output in $scratch/out, and demands the exit code.
expect() {
  wanted=$1
  shift
  code=0
  "$@" >"$scratch/out" 2>&1 </dev/null || code=$?
  [ "$code" -eq "$wanted" ] || fail "exit code $code, expected $wanted: $*"
}

# says TEXT / never_says TEXT: about the output of the last `expect`.
says() { grep -qF -- "$1" "$scratch/out" || fail "the output lacks: $1"; }
never_says() { if grep -qF -- "$1" "$scratch/out"; then fail "the output has: $1"; fi; }

# stub NAME BODY: a command of that name that comes first in PATH.
stub() {
  mkdir -p "$scratch/bin"
  printf '#!/bin/sh\n%s\n' "$2" >"$scratch/bin/$1"
  chmod +x "$scratch/bin/$1"
}
