#!/bin/sh
# All tests on a bare Debian 12 machine: installs what is missing, builds, runs ctest. Arguments go to ctest, for example
# scripts/test.sh -L cpu   or   scripts/test.sh -R Clustered
set -eu

root=$(cd "$(dirname "$0")/.." && pwd -P)
"$root/scripts/setup.sh"
"$root/scripts/build.sh" release
cd "$root"
exec ctest --preset release --no-tests=error --parallel "$(nproc)" "$@"
