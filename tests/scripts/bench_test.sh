#!/bin/sh
# scripts/bench.sh from another directory, in a copy of the tree whose program is the one at hand: a table, then the path of the result.
. "$(dirname "$0")/lib.sh"
tree=$scratch/tree
mkdir -p "$tree/scripts" "$tree/build/release" "$scratch/elsewhere"
cp "$source_dir"/scripts/*.sh "$source_dir"/scripts/packages*.txt "$tree/scripts/"
cp -r "$source_dir/configs" "$tree/configs"
ln -s "$program" "$tree/build/release/manylights"
printf '#!/bin/sh\n' >"$tree/scripts/setup.sh"  # setup has its own test
printf '#!/bin/sh\n' >"$tree/scripts/build.sh"
tree=$(cd "$tree" && pwd -P)

cd "$scratch/elsewhere"
expect 0 "$tree/scripts/bench.sh" --set 'resolution=[160,90]' --set camera.frames=2 --set lights.count=300 \
  --set 'outputs={"heatmaps":[],"images":[]}'
says 'clustered'
says 'ideal'
[ "$(tail -n 1 "$scratch/out")" = "result: $tree/out/quick/result.json" ] || fail "the last line is not the path of the result"
[ -s "$tree/out/quick/result.json" ] || fail "there is no result"
# Again into the same folder: replaced, or gone on with.
expect 0 "$tree/scripts/bench.sh" --set 'resolution=[80,45]' --set camera.frames=2 --set lights.count=100 \
  --set 'outputs={"heatmaps":[],"images":[]}'
says '80x45'
expect 0 "$tree/scripts/bench.sh" --set 'resolution=[80,45]' --set camera.frames=2 --set lights.count=100 \
  --set 'outputs={"heatmaps":[],"images":[]}' --resume
[ -z "$(ls -A "$scratch/elsewhere")" ] || fail "it left files in the working directory"

# What is wrong with the arguments is the program's exit code.
expect 2 "$tree/scripts/bench.sh" --set lights.cuont=3
says 'count'

# A build that fails ends it.
printf '#!/bin/sh\nexit 1\n' >"$tree/scripts/build.sh"
expect 1 "$tree/scripts/bench.sh"
never_says 'result:'
