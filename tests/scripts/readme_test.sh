#!/bin/sh
# Runs the commands of README.md and docs/ that are marked with <!-- run --> before their block, in order, in a copy of the tree's layout: a
# line of the block is one command, and each must succeed. Then checks that links between the documents lead somewhere, and that the README is
# short enough to be read.
. "$(dirname "$0")/lib.sh"
readme=$source_dir/README.md

mkdir -p "$scratch/tree/build/release"
for entry in configs scripts results docs; do ln -s "$source_dir/$entry" "$scratch/tree/$entry"; done
ln -s "$program" "$scratch/tree/build/release/manylights"

awk '/^<!-- run -->$/ {marked = 1; next}
     marked && /^```sh$/ {inside = 1; marked = 0; next}
     /^```$/ {inside = 0}
     inside && NF && !/^#/' "$readme" "$source_dir"/docs/*.md | awk '!seen[$0]++' >"$scratch/commands"
count=$(wc -l <"$scratch/commands")
[ "$count" -ge 5 ] || fail "only $count commands are marked in README.md and docs/"

cd "$scratch/tree"
while IFS= read -r command; do
  echo "$command"
  expect 0 sh -c "$command"
done <"$scratch/commands"
echo "$count commands of README.md and docs/ ran"
words=$(wc -w <"$readme")
[ "$words" -le 1000 ] || fail "README.md has $words words, more than 1000"

# Links to files of the repository lead somewhere, in every document.
cd "$source_dir"
for document in README.md CONTRIBUTING.md docs/*.md results/README.md algorithms/*/README.md examples/*/README.md; do
  folder=$(dirname "$document")
  for target in $(grep -o '](\([^)#]*\)' "$document" | sed 's/^](//' | grep -v '^[a-z]*:' || true); do
    [ -e "$folder/$target" ] || fail "$document: $target does not exist"
  done
done
