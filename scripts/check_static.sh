#!/bin/sh
# The static checks: layout of the sources, clang-tidy, SPIR-V, schemas, architecture.
#
#     scripts/check_static.sh [format|tidy|spirv|schemas|architecture|scripts]...      default: all
#
# Needs build/release (scripts/build.sh release) for spirv and schemas, and build/asan (scripts/build.sh asan manylights) for tidy.
# Exit code 0: nothing found; 1: something found.
set -u

cd "$(dirname "$0")/.." || exit 1
sources() { find harness algorithms scenes shaders benchmarks examples tests -name '*.cpp' -o -name '*.h' | LC_ALL=C sort; }

format() { sources | xargs clang-format --dry-run -Werror; }

# The program's own sources; tests are compiled with clang's warnings by the sanitizer builds.
# shellcheck disable=SC2016  # the inner shell expands it
tidy() {
  if [ ! -f build/asan/compile_commands.json ]; then
    echo "build/asan is not there: scripts/build.sh asan manylights" >&2
    return 1
  fi
  sources | grep '\.cpp$' | grep -v '^tests/' | while read -r source; do
    # What CMake left out, because a package is not there, has no command to be checked with.
    if grep -qF "/$source\"" build/asan/compile_commands.json; then echo "$source"; else echo "left out: $source" >&2; fi
  done | xargs -P "$(nproc)" -n 1 sh -c '
    found=$(clang-tidy --quiet -p build/asan "$1" 2>/dev/null) || { printf "%s\n" "$found"; exit 1; }' tidy
}

spirv() {
  modules=$(find build/release -name '*.spv' | LC_ALL=C sort)
  if [ -z "$modules" ]; then
    echo "no SPIR-V module in build/release" >&2
    return 1
  fi
  bad=0
  for module in $modules; do
    spirv-val --target-env vulkan1.3 --scalar-block-layout "$module" || { echo "  in $module" >&2; bad=1; }
  done
  echo "$(echo "$modules" | wc -l) modules"
  return $bad
}

schemas() { /usr/bin/python3 scripts/check_schemas.py build/release/manylights; }

architecture() { /usr/bin/python3 scripts/check_architecture.py; }

# The shells parse the scripts; shellcheck reads them where it is installed.
scripts() {
  bad=0
  for script in scripts/*.sh tests/scripts/*.sh; do
    sh -n "$script" || bad=1
  done
  bash -n .ci/run || bad=1
  if command -v shellcheck >/dev/null 2>&1; then shellcheck --exclude=SC2086 scripts/*.sh .ci/run || bad=1; fi
  return $bad
}

[ $# -gt 0 ] || set -- format architecture scripts spirv schemas tidy
failed=
for check in "$@"; do
  case $check in
    format|tidy|spirv|schemas|architecture|scripts) ;;
    *) echo "check_static.sh: unknown check '$check'" >&2; exit 2 ;;
  esac
  echo "== $check"
  begin=$(date +%s)
  if "$check"; then outcome=ok; else outcome=FAILED failed="$failed $check"; fi
  echo "== $check: $outcome ($(($(date +%s) - begin)) s)"
done
if [ -n "$failed" ]; then
  echo "static checks failed:$failed"
  exit 1
fi
echo "static checks passed"
