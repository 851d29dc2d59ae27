#!/bin/sh
# scripts/setup.sh on machines that this one is not: other systems, missing packages, no rights.
. "$(dirname "$0")/lib.sh"
setup=$source_dir/scripts/setup.sh
PATH=$scratch/bin:$PATH
cd /

printf 'ID=debian\nVERSION_ID="12"\nPRETTY_NAME="Debian GNU/Linux 12 (bookworm)"\n' >"$scratch/debian12"
export MANYLIGHTS_OS_RELEASE="$scratch/debian12"

# Every package there: nothing is done, nothing is said, apt-get is not even asked.
stub apt-get 'echo "apt-get $*"; exit 1'
stub dpkg-query 'shift 2; for name in "$@"; do echo "$name installed"; done'
expect 0 "$setup"
[ ! -s "$scratch/out" ] || fail "it says something with nothing to do"

# Two are missing, one of them removed but for its settings: exactly these are installed.
stub dpkg-query 'shift 2; for name in "$@"; do case $name in glslang-tools) ;; libglm-dev) echo "$name config-files" ;; *) echo "$name installed" ;; esac; done; exit 1'
stub id 'echo 0'
stub apt-get 'echo "apt-get $*, $DEBIAN_FRONTEND"; exit 0'
expect 0 "$setup"
says ' update, noninteractive'
grep -q 'install --yes --no-install-recommends glslang-tools libglm-dev, noninteractive' "$scratch/out" || fail "not exactly the two missing packages"
expect 3 "$setup" --check
says 'glslang-tools libglm-dev'
never_says 'apt-get'

# To run the program only its own packages are looked for.
stub dpkg-query 'shift 2; for name in "$@"; do case $name in clang-tidy | libgtest-dev) echo "$name is of no use"; exit 2 ;; cmake) ;; *) echo "$name installed" ;; esac; done; exit 1'
expect 0 "$setup" --to-run
grep -q 'install --yes --no-install-recommends cmake, noninteractive' "$scratch/out" || fail "not exactly the missing package"
stub dpkg-query 'shift 2; for name in "$@"; do case $name in glslang-tools) ;; libglm-dev) echo "$name config-files" ;; *) echo "$name installed" ;; esac; done; exit 1'

# Not root: through sudo, which must not ask for a password where nobody can answer.
stub id 'echo 1000'
stub sudo 'echo "sudo $*"'
expect 0 "$setup"
says 'sudo -n env DEBIAN_FRONTEND=noninteractive apt-get'

# The packages cannot be had.
stub id 'echo 0'
stub apt-get 'case "$*" in *install*) exit 100 ;; esac'
expect 3 "$setup"
says 'could not install: glslang-tools libglm-dev'

# Neither root nor sudo (a PATH of only what the script needs).
mkdir "$scratch/few"
for tool in sh sed tr dirname env cat; do ln -s "$(command -v $tool)" "$scratch/few/$tool"; done
rm "$scratch/bin/sudo"
stub id 'echo 1000'
expect 3 env PATH="$scratch/bin:$scratch/few" "$setup"
says 'neither root nor sudo'
says 'glslang-tools libglm-dev'

# Other systems: the packages are printed, nothing is installed.
for system in 'ID=debian VERSION_ID="11"' 'ID=ubuntu VERSION_ID="12" PRETTY_NAME="Ubuntu 12"' 'ID=fedora'; do
  echo "$system" | sed 's/ \([A-Z]\)/\n\1/g' >"$scratch/other"
  expect 3 env MANYLIGHTS_OS_RELEASE="$scratch/other" "$setup"
  for package in $(sed 's/#.*//' "$source_dir/scripts/packages.txt" "$source_dir/scripts/packages-dev.txt"); do says "  $package"; done
  never_says 'installing'
done
expect 3 env MANYLIGHTS_OS_RELEASE=/nowhere "$setup"
says 'an unknown system'

# bench.sh and test.sh end there too, with the same code, before they build anything.
for script in bench test; do
  expect 3 env MANYLIGHTS_OS_RELEASE=/nowhere "$source_dir/scripts/$script.sh"
  says 'an unknown system'
  if [ $script = bench ]; then never_says clang-tidy; else says clang-tidy; fi
done
