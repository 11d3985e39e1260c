#!/bin/sh
# Makes .venv with the packages of requirements.txt, when it is missing or they changed.
# PYTHON names another interpreter than python3, VENV and REQUIREMENTS another folder and list;
# ADD names a list whose packages join them.
set -u
cd "$(dirname "$0")/.." || exit 1

python=${PYTHON:-python3}
venv=${VENV:-.venv}
list=${REQUIREMENTS:-requirements.txt}
add=${ADD:-}
stamp=$venv/installed-requirements.txt     # copied last: an interrupted attempt leaves none
made() { [ -x "$venv/bin/python" ] && cmp -s "$list" "$stamp"; }
added() { [ -z "$add" ] || cmp -s "$add" "$venv/installed-$add"; }
if made && added; then
  exit 0
fi

if ! "$python" -c 'import sys; sys.exit(sys.version_info < (3, 9))' 2>/dev/null; then
  echo "setup-venv: \"$python\" is missing or older than Python 3.9; set PYTHON to a newer one."
  exit 1
fi
if ! "$python" -c 'import venv, ensurepip' 2>/dev/null; then
  echo "setup-venv: \"$(command -v "$python")\" has no venv or no ensurepip module."
  echo "Run \"make deps\" (on Debian they are in the package python3-venv), or set PYTHON."
  exit 1
fi

install() {
  "$venv/bin/python" -m pip install --quiet --disable-pip-version-check --prefer-binary "$@"
}

fetch() {
  install "$@" && return
  echo "setup-venv: pip failed, trying once more"
  sleep 5
  install "$@" && return
  echo "setup-venv: the packages could not be installed."
  return 1
}

if ! made; then
  echo "making $venv with the packages of $list"
  "$python" -m venv --clear "$venv" || exit 1
  fetch -r "$list" || exit 1
  cp "$list" "$stamp"
fi
if ! added; then
  echo "adding the packages of $add to $venv"
  fetch -r "$list" -r "$add" || exit 1
  cp "$add" "$venv/installed-$add"
fi
