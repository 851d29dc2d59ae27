#!/bin/sh
# scripts/build.sh: when CMake is run, with what, and how many jobs.
. "$(dirname "$0")/lib.sh"
PATH=$scratch/bin:$PATH
unset MANYLIGHTS_WERROR  # CI has it
mkdir -p "$scratch/tree/scripts" "$scratch/elsewhere"
cp "$source_dir/scripts/build.sh" "$scratch/tree/scripts/"
tree=$(cd "$scratch/tree" && pwd -P)
cd "$scratch/elsewhere"
stub cmake 'echo "in $PWD: cmake $*"'
stub nproc 'echo 64'

# A new tree is configured and built, whatever the working directory.
expect 0 "$tree/scripts/build.sh" release manylights
says "in $tree: cmake --preset release"
says "in $tree: cmake --build build/release"
says '--target manylights'
# 64 jobs would need 96 GB: no machine with less gets them.
memory=$(awk '/^MemAvailable:/ {print int($2 / 1500000)}' /proc/meminfo)
if [ "$memory" -lt 64 ]; then never_says '--parallel 64'; fi

# A configured tree is only built.
mkdir -p "$tree/build/release"
touch "$tree/build/release/build.ninja"
echo "CMAKE_HOME_DIRECTORY:INTERNAL=$tree" >"$tree/build/release/CMakeCache.txt"
expect 0 "$tree/scripts/build.sh" release
never_says '--preset'
never_says '--target'

# Settings are given to CMake; a cache from another place is thrown away.
expect 0 "$tree/scripts/build.sh" release -DMANYLIGHTS_BENCHMARKS=OFF manylights
says 'cmake --preset release -DMANYLIGHTS_BENCHMARKS=OFF'
echo "CMAKE_HOME_DIRECTORY:INTERNAL=/another/place" >"$tree/build/release/CMakeCache.txt"
expect 0 "$tree/scripts/build.sh" release
says 'cmake --preset release --fresh'

# In CI warnings are errors, whatever the tree was configured with before.
expect 0 env MANYLIGHTS_WERROR=1 "$tree/scripts/build.sh" release manylights
says " -DMANYLIGHTS_WERROR=ON"

# A failing build fails.
stub cmake 'exit 7'
expect 7 "$tree/scripts/build.sh" release
