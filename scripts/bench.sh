#!/bin/sh
# A first result on a bare Debian 12 machine: installs what is missing, builds, runs configs/quick.json, and ends with a table and the
# path of the result. Arguments go to `manylights run`, for example  scripts/bench.sh --set lights.count=16384
# The result of an earlier call is replaced, but for --resume, which goes on with it.
set -eu

root=$(cd "$(dirname "$0")/.." && pwd -P)
"$root/scripts/setup.sh" --to-run
"$root/scripts/build.sh" release manylights
earlier=--force
for argument in "$@"; do
  if [ "$argument" = --resume ] || [ "$argument" = --force ]; then earlier=; fi
done
exec "$root/build/release/manylights" run "$root/configs/quick.json" --out "$root/out/quick" $earlier "$@"
