#!/bin/sh
# All tests on a bare Debian 12 machine: installs what is missing, builds, runs ctest: everything on the default device (Mesa's software
# driver where there is no GPU), then the tests of a device (label gpu) on SwiftShader, a second software driver that shares no code with
# it. Arguments go to ctest, for example
#     scripts/test.sh -L cpu   or   scripts/test.sh -R Clustered
# DRIVERS=default or DRIVERS=swiftshader runs on one of the two.
set -eu

root=$(cd "$(dirname "$0")/.." && pwd -P)
swiftshader=/usr/lib/chromium/vk_swiftshader_icd.json # Debian's chromium-common
drivers=${DRIVERS:-default swiftshader}
for driver in $drivers; do
  case $driver in
    default | swiftshader) ;;
    *)
      echo "test.sh: DRIVERS: unknown driver '$driver', known are: default swiftshader" >&2
      exit 2
      ;;
  esac
done

"$root/scripts/setup.sh"
# What bench.sh may have configured without.
"$root/scripts/build.sh" release -DMANYLIGHTS_TESTS=ON -DMANYLIGHTS_BENCHMARKS=ON
cd "$root"
failed=0
for driver in $drivers; do
  case $driver in
    default)
      ctest --preset release --no-tests=error --parallel "$(nproc)" "$@" || failed=1
      ;;
    swiftshader)
      if [ ! -f "$swiftshader" ]; then
        echo "test.sh: SwiftShader is not there ($swiftshader)" >&2
        exit 3
      fi
      echo "== the tests of a device on SwiftShader"
      # What the arguments choose may be no test of a device.
      VK_DRIVER_FILES=$swiftshader ctest --preset release --no-tests=ignore --parallel "$(nproc)" -L gpu "$@" || failed=1
      ;;
  esac
done
exit $failed
