#!/bin/sh
# Installs the Debian 12 packages that are missing, of packages.txt and packages-dev.txt; does nothing, quickly, when none is.
#
#     scripts/setup.sh            install what is missing
#     scripts/setup.sh --to-run   only what building and running the program need (packages.txt)
#     scripts/setup.sh --check    only say what is missing
#
# Exit code 0: everything is there; 3: it is not and cannot be put there (another system, no rights, no package server).
# MANYLIGHTS_OS_RELEASE names another file than /etc/os-release (the tests' way to be on another system).
set -eu

cd "$(dirname "$0")"
lists=packages.txt
if [ "${1:-}" != --to-run ]; then lists="$lists packages-dev.txt"; fi
os_release=${MANYLIGHTS_OS_RELEASE:-/etc/os-release}

say() { printf 'setup: %s\n' "$*" >&2; }

packages=$(sed -e 's/#.*//' $lists | tr -s ' \t\n' ' ' | sed -e 's/^ //' -e 's/ $//')

value_of() { sed -n "s/^$1=\"\{0,1\}\([^\"]*\)\"\{0,1\}\$/\1/p" "$os_release" 2>/dev/null || true; }
if [ "$(value_of ID)" != debian ] || [ "$(value_of VERSION_ID)" != 12 ]; then
  name=$(value_of PRETTY_NAME)
  say "made for Debian 12, this is ${name:-an unknown system}; Debian's names of the packages that are needed:"
  printf '%s\n' $packages | sed 's/^/  /' >&2
  say "with these installed:  cmake --preset release && cmake --build --preset release"
  exit 3
fi

# dpkg-query fails when it does not know one of the names; what it prints is right all the same.
installed=$(dpkg-query -W -f='${Package} ${db:Status-Status}\n' $packages 2>/dev/null | sed -n 's/ installed$//p') || true
missing=
for package in $packages; do
  case "
$installed
" in
    *"
$package
"*) ;;
    *) missing="$missing $package" ;;
  esac
done
[ -n "$missing" ] || exit 0

if [ "${1:-}" = --check ]; then
  say "missing:$missing"
  exit 3
fi

if [ "$(id -u)" -eq 0 ]; then
  as_root=
elif command -v sudo >/dev/null 2>&1; then
  as_root=sudo
  [ -t 0 ] || as_root='sudo -n'
else
  say "neither root nor sudo; have these installed:$missing"
  exit 3
fi

say "installing$missing"
apt="$as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -o Acquire::Retries=3 -o DPkg::Lock::Timeout=300"
$apt update </dev/null >&2 || say "apt-get update failed; going on with the lists that are there"
if ! $apt install --yes --no-install-recommends $missing </dev/null >&2; then
  say "could not install:$missing"
  exit 3
fi
