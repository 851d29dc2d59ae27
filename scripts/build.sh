#!/bin/sh
# Configures (when needed) and builds a CMake preset:  scripts/build.sh PRESET [TARGET...]
# -DNAME=VALUE among the targets goes to CMake.
set -eu

preset=$1
shift
cd "$(dirname "$0")/.."

settings='' targets=''
# CI takes warnings for errors; somebody else's newer compiler may have new ones.
if [ "${MANYLIGHTS_WERROR:-}" = 1 ]; then settings=' -DMANYLIGHTS_WERROR=ON'; fi
for argument in "$@"; do
  case $argument in
    -D*) settings="$settings $argument" ;;
    *) targets="$targets $argument" ;;
  esac
done

# A checkout that was moved has a cache of its old place.
fresh=
cache=build/$preset/CMakeCache.txt
if [ -f "$cache" ] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$(pwd -P)" "$cache"; then fresh=--fresh; fi
if [ ! -f "build/$preset/build.ninja" ] || [ -n "$fresh$settings" ]; then
  cmake --preset "$preset" $fresh $settings
fi

# One job a core, and no more than memory holds: the largest files take a gigabyte and a half.
jobs=$(nproc)
held=$(awk '/^MemAvailable:/ {print int($2 / 1500000)}' /proc/meminfo 2>/dev/null || echo "$jobs")
if [ "$held" -lt 1 ]; then held=1; fi
if [ "$jobs" -gt "$held" ]; then jobs=$held; fi
if [ -n "$targets" ]; then exec cmake --build "build/$preset" --parallel "$jobs" --target $targets; fi
exec cmake --build "build/$preset" --parallel "$jobs"
