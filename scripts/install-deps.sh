#!/bin/sh
# Installs what building and testing need, and only what is missing. MPI and MUMPS, for bipact-mpi,
# are optional: where they cannot be had the build goes on without them.
#   --dry-run   print what would be done
# FC and PYTHON name other programs than gfortran and python3.
set -u

dry_run=
[ "${1:-}" = --dry-run ] && dry_run=1
fc=${FC:-gfortran}
python=${PYTHON:-python3}

# The compiler knows where libraries are, whichever package or hand put them there.
# Without a compiler they count as missing; installing an installed package does no harm.
has_library() {
  for suffix in a so dylib; do
    case $("$fc" -print-file-name="lib$1.$suffix" 2>/dev/null) in
      /*) return 0 ;;
    esac
  done
  return 1
}

# Sets `missing` to the Debian packages that are needed.
look() {
  missing=
  command -v "$fc" >/dev/null 2>&1 || missing="$missing gfortran"
  command -v make >/dev/null 2>&1 || missing="$missing make"
  has_library lapack || missing="$missing liblapack-dev"
  has_library blas || missing="$missing libblas-dev"
  has_library metis || missing="$missing libmetis-dev"
  has_library hdf5_serial_fortran || has_library hdf5_fortran || missing="$missing libhdf5-dev"
  # An existing .venv of ours shows that Python can make one, and is quicker to ask.
  [ -x .venv/bin/python ] || "$python" -c 'import venv, ensurepip' >/dev/null 2>&1 \
    || missing="$missing python3 python3-venv"
}

# Sets `wanted` to those of the optional program bipact-mpi; NO_MPI=1 leaves it out.
look_further() {
  wanted=
  [ -z "${NO_MPI:-}" ] || return
  command -v mpifort >/dev/null 2>&1 && command -v mpirun >/dev/null 2>&1 \
    || wanted="libopenmpi-dev openmpi-bin"
  has_library dmumps || wanted="$wanted libmumps-dev"
}

cd "$(dirname "$0")/.." || exit 1
look
look_further
if [ -z "$missing$wanted" ]; then
  [ -z "$dry_run" ] || echo "nothing to install"
  exit 0
fi

without_mpi() {
  echo "bipact-mpi (several ranks) is left out, it needs: $wanted"
}

if ! command -v apt-get >/dev/null 2>&1; then
  [ -n "$missing" ] || { without_mpi; exit 0; }
  echo "Missing (Debian package names):$missing"
  echo "bipact needs gfortran, make, LAPACK, BLAS, METIS and HDF5 (Fortran) with their headers,"
  echo "and python3 with venv. Please install them with the package manager of this system, then try again."
  exit 1
fi

if [ -n "$dry_run" ]; then
  [ -z "$missing" ] || echo "would run: apt-get update && apt-get install -y$missing"
  [ -z "$wanted" ] || echo "would run: apt-get update && apt-get install -y $wanted   # optional"
  exit 0
fi

if [ "$(id -u)" = 0 ]; then
  as_root=
elif sudo -n true 2>/dev/null; then
  as_root="sudo -n"
elif [ -z "$missing" ]; then
  without_mpi
  exit 0
else
  echo "Packages are missing and installing them needs root. Please run:"
  echo "  sudo apt-get update && sudo apt-get install -y$missing"
  exit 1
fi

install() {
  # The lock option waits for another installation instead of failing.
  apt="$as_root env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=300"
  $apt update    # may fail for a source that does not matter here
  # shellcheck disable=SC2086
  $apt install -y --no-install-recommends $1
}

log=$(mktemp)
if [ -n "$missing" ]; then
  echo "installing:$missing"
  if ! install "$missing" >"$log" 2>&1; then
    echo "the installation failed, trying once more"
    sleep 5
    install "$missing" >"$log" 2>&1 || { cat "$log"; rm -f "$log"; exit 1; }
  fi
fi
if [ -n "$wanted" ]; then
  echo "installing for bipact-mpi: $wanted"
  install "$wanted" >"$log" 2>&1 || without_mpi
fi
rm -f "$log"

look
if [ -n "$missing" ]; then
  echo "Still missing after the installation:$missing"
  echo "(FC is \"$fc\", python is \"$(command -v "$python")\": are these the ones meant?)"
  exit 1
fi
