#!/bin/sh
# Installs bipact below DESTDIR/PREFIX, or removes it (--remove): programs, manual pages,
# completion for bash, scripts, decks, pages. `make install` and `make uninstall` run this.
# PREFIX is /usr/local unless set; FLAVOUR names another build than release.
set -eu
cd "$(dirname "$0")/.."

prefix=${DESTDIR:-}${PREFIX:-/usr/local}
flavour=${FLAVOUR:-release}
suffix=
[ "$flavour" = release ] || suffix=-$flavour
bin=$prefix/bin
share=$prefix/share/bipact
pages=$prefix/share/doc/bipact
manual=$prefix/share/man/man1
completions=$prefix/share/bash-completion/completions

remove=
if [ "${1:-}" = --remove ]; then
  remove=1
elif [ ! -x "bin/bipact$suffix" ]; then
  echo "install: bin/bipact$suffix is not built: run make" >&2
  exit 1
fi

# put MODE FOLDER FILE...: installs files, or removes those of the same names.
put() {
  mode=$1 folder=$2
  shift 2
  [ -n "$remove" ] || install -d "$folder"
  for file; do
    if [ -n "$remove" ]; then
      rm -f "$folder/${file##*/}"
    else
      install -m "$mode" "$file" "$folder"
    fi
  done
}

# program NAME ONE-LINE SEE-ALSO: a program, if it is built (some need HDF5), and its manual page
# (if it has one), made of its own --help.
program() {
  [ -n "$remove" ] || [ -x "bin/$1$suffix" ] || return 0
  put 755 "$bin" "bin/$1$suffix"
  [ -n "${2:-}" ] || return 0
  [ -n "$remove" ] || "bin/$1$suffix" --help | awk -v name="$1" -v what="$2" -v see="$3" \
    -v version="$(head -n 1 VERSION)" -f scripts/make_man.awk >"$scratch/$1.1"
  put 644 "$manual" "$scratch/$1.1"
}

scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
program bipact 'impact with friction between deformable bodies' 'bipact-fclib(1)'
program bipact-hdf5
program bipact-mpi
program bipact-fclib 'solver of contact problems with friction' 'bipact(1)'

cp scripts/completion.bash "$scratch/bipact"
cp scripts/completion.bash "$scratch/bipact-fclib"
put 644 "$completions" "$scratch/bipact" "$scratch/bipact-fclib"

# Scripts that work on the sources stay with them.
for script in scripts/*.py scripts/setup-venv.sh scripts/setup-gmsh.sh; do
  case ${script##*/} in
    check_style.py | collide*.py | draw_*.py | make_cards.py) continue ;;
  esac
  mode=644
  [ ! -x "$script" ] || mode=755
  put "$mode" "$share/scripts" "$script"
done
put 644 "$share" requirements.txt requirements-gmsh.txt
for folder in input input/*/; do
  put 644 "$share/${folder%/}" "$folder"/*.*
done

put 644 "$pages" README.md CHANGELOG.md LICENSE CITATION.cff
put 644 "$pages/doc" doc/*.md

if [ -n "$remove" ]; then
  rm -rf "$share/.venv" "$share/scripts/__pycache__"
  for folder in "$share" "$pages"; do
    [ ! -d "$folder" ] || find "$folder" -depth -type d -empty -delete
  done
fi
