#!/usr/bin/python3
"""Counts the instructions of each stage of prepare(), scalar and fast, and holds fast to fewer than scalar.

    scripts/count_instructions.py PROGRAM      PROGRAM: build/release/benchmarks/benchmark_stage_instructions

Valgrind's callgrind counts: exactly, and the same on every processor with AVX2, which is the best instruction set that it knows.
Prints a line for each stage. Exit code 0: every fast stage takes fewer instructions; 1: one does not; 77: valgrind is missing.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

CLOCK = "std::chrono::_V2::steady_clock::now()"
SKIPPED = 77


def counts_of(program):
    """{stage: {form: instructions}}, in the order of the program."""
    with tempfile.TemporaryDirectory() as folder:
        counts = pathlib.Path(folder) / "counts"
        labels = subprocess.run(
            ["valgrind", "--tool=callgrind", "--quiet", f"--dump-before={CLOCK}", f"--callgrind-out-file={counts}", program],
            check=True, stdout=subprocess.PIPE, text=True).stdout.split("\n")[:-1]
        stages = {}
        for number, label in enumerate(labels):
            # A dump is what came since the one before: that of a span's end holds the span.
            dump = pathlib.Path(f"{counts}.{2 * number + 2}").read_text()
            form, stage = label.split()
            if form != "-":
                stages.setdefault(stage, {})[form] = int(re.search(r"^totals: (\d+)", dump, re.MULTILINE).group(1))
        extra = pathlib.Path(f"{counts}.{2 * len(labels) + 1}")
        if extra.exists():
            sys.exit(f"the clock was read more often than the {len(labels)} spans of {program} do")
        return stages


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    if shutil.which("valgrind") is None:
        print("skipped: valgrind is not installed")
        sys.exit(SKIPPED)
    failed = 0
    print(f"{'stage':<10}{'scalar':>12}{'fast':>12}{'fewer by':>10}")
    for stage, forms in counts_of(sys.argv[1]).items():
        scalar, fast = forms.get("scalar"), forms["fast"]
        if scalar is None:
            print(f"{stage:<10}{'':>12}{fast:>12}")
            continue
        print(f"{stage:<10}{scalar:>12}{fast:>12}{scalar / fast:>10.2f}")
        if fast >= scalar:
            print(f"{stage}: the fast code executes {fast} instructions, scalar code {scalar}", file=sys.stderr)
            failed = 1
    sys.exit(failed)


if __name__ == "__main__":
    main()
