#!/bin/sh
# .ci/run reports every step, goes on after a failure, and then fails.
. "$(dirname "$0")/lib.sh"
tree=$scratch/tree
mkdir -p "$tree/scripts" "$tree/.ci"
cp "$source_dir/.ci/run" "$tree/.ci/run"
script() { printf '#!/bin/sh\n%s\n' "$2" >"$tree/scripts/$1.sh" && chmod +x "$tree/scripts/$1.sh"; }
cd /

script setup ''
script test 'echo "100% tests passed, 0 tests failed out of 7"'
script check_static 'echo "static checks passed"'
expect 0 "$tree/.ci/run" tests static
says '==== summary'
grep -q '^tests .*passed .*100% tests passed, 0 tests failed out of 7' "$scratch/out" || fail "no closing line of ctest in the summary"
[ "$(tail -n 1 "$scratch/out")" = 'everything passed' ] || fail "the last line"

script test 'echo "86% tests passed, 1 tests failed out of 7"; exit 8'
expect 1 "$tree/.ci/run" tests static
grep -q '^tests .*FAILED .*1 tests failed out of 7' "$scratch/out" || fail "the failed step is not in the summary"
grep -q '^static .*passed' "$scratch/out" || fail "the step after the failed one was not run"
[ "$(tail -n 1 "$scratch/out")" = FAILED ] || fail "the last line"

# The summary names the tests that failed and what the first assertion of each said: often no more of the output is seen.
script test 'cat <<END
1/3 Test #1: Whole.Passes ..........   Passed    0.01 sec
2/3 Test #2: Some.Kind/of_test  # GetParam() = 3 ....***Failed    0.02 sec
[ RUN      ] Some.Kind/of_test
tests/some_test.cpp:12: Failure
Value of: lost
  Actual: 3
3/3 Test #3: Other.Runs ......***Timeout 600.00 sec
END
exit 8'
expect 1 "$tree/.ci/run" tests
says '  Some.Kind/of_test Failed: some_test.cpp:12 | Value of: lost | Actual: 3'
says '  Other.Runs Timeout'
never_says '  Whole.Passes'

# A fuzzer that finds something fails its step; the other is heard out.
mkdir -p "$tree/build/asan/tests/fuzz"
for name in config gltf; do
  printf '#!/bin/sh\necho "stat::number_of_executed_units: 12"\n' >"$tree/build/asan/tests/fuzz/fuzz_$name"
  chmod +x "$tree/build/asan/tests/fuzz/fuzz_$name"
done
expect 0 "$tree/.ci/run" fuzz
says 'fuzz_gltf: 12 inputs, nothing found'
printf '#!/bin/sh\necho "deadly signal"\nexit 77\n' >"$tree/build/asan/tests/fuzz/fuzz_gltf"
expect 1 "$tree/.ci/run" fuzz
says 'fuzz_config: 12 inputs, nothing found'
says 'fuzz_gltf: FAILED'
says 'deadly signal'

# Without its tools nothing is begun.
script setup 'exit 3'
expect 3 "$tree/.ci/run"
never_says '===='
expect 2 "$tree/.ci/run" everything
