#!/usr/bin/env bash
# Makes a machine ready: `setup.sh GOAL` with GOAL one of demo, test, lint, bench, docs.
# System packages are installed when root or sudo without a password allows it; otherwise the one
# line to run is printed and the exit code is 1. Everything else lands in .venv. What has not changed
# is not done again.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

goal=${1:-}
case $goal in demo | test | lint | bench | docs) ;; *)
  echo "usage: scripts/setup.sh demo|test|lint|bench|docs" >&2
  exit 2
  ;;
esac
venv=.venv
stamps=$venv/stamps
say() { echo "pbfluids: $*" >&2; }

# ---- the system ---------------------------------------------------------------------------------
# Each need is tested by what it provides, not by the name of a package: any way of installing it
# will do.
compiles() {
  printf '%s\n' "$1" | ${CXX:-c++} -std=c++20 -x c++ ${2:-} - -o /dev/null >/dev/null 2>&1
}
has_header() { compiles "#include <$1>" "-E ${2:-}"; }
has_library() { [[ $(/sbin/ldconfig -p) == *"$1"* ]]; }
has_file() { compgen -G "$1" >/dev/null; }

has_python() {
  python3 -c 'import sys, venv, ensurepip; sys.exit(sys.version_info < (3, 10))' 2>/dev/null
}
has_python_headers() {
  [[ -f $(python3 -c 'import sysconfig; print(sysconfig.get_path("include"))')/Python.h ]]
} 2>/dev/null
has_compiler() { compiles 'int main() { return 0; }' -fopenmp; }
# Mesa's software driver, or a vendor's own driver beside the loader.
has_gl_driver() {
  has_file '/usr/lib*/dri/swrast_dri.so' || has_file '/usr/lib/*/dri/swrast_dri.so' ||
    has_file '/usr/lib/*/libgallium-*.so' || has_library libEGL_nvidia
}

needs() {
  has_python || echo "python3 python3-venv"
  has_python_headers || echo python3-dev
  has_compiler || echo g++
  has_library libEGL.so.1 || echo libegl1
  has_gl_driver || echo "libegl-mesa0 libgl1-mesa-dri"
  case $goal in test | lint | bench)
    has_header Eigen/Core -I/usr/include/eigen3 || echo libeigen3-dev
    has_header doctest/doctest.h || has_header doctest.h -I/usr/include/doctest || echo doctest-dev
    ;;
  esac
  case $goal in
    lint)
      command -v clang-tidy >/dev/null || echo clang-tidy
      has_file '/usr/lib/llvm-*/lib/clang/*/include/omp.h' || echo libomp-dev
      ;;
    bench) has_header benchmark/benchmark.h || echo libbenchmark-dev ;;
  esac
}

install_system_packages() {
  local missing
  missing=$(needs | xargs)
  [[ -z $missing ]] && return
  local install="apt-get install -y --no-install-recommends $missing"
  if ! command -v apt-get >/dev/null; then
    echo "Missing, under Debian's names: $missing" >&2
    exit 1
  elif [[ $(id -u) == 0 ]]; then
    as_root=(env DEBIAN_FRONTEND=noninteractive)
  elif sudo -n true 2>/dev/null; then
    as_root=(sudo env DEBIAN_FRONTEND=noninteractive)
  else
    echo "sudo apt-get update && sudo $install"
    exit 1
  fi
  say "installing $missing"
  "${as_root[@]}" apt-get update -qq
  # shellcheck disable=SC2086
  "${as_root[@]}" $install -qq >/dev/null
  missing=$(needs | xargs)
  if [[ -n $missing ]]; then
    echo "apt-get has installed them, yet these are still not found: $missing" >&2
    exit 1
  fi
}

# ---- .venv --------------------------------------------------------------------------------------
# once NAME INPUTS… -- COMMAND…: runs the command unless the inputs are those of its last success.
once() {
  local name=$1 inputs=() key
  shift
  while [[ $1 != -- ]]; do inputs+=("$1") && shift; done
  shift
  key=$({
    echo "$PWD" "$@" && python3 --version
    find "${inputs[@]}" -type f ! -path '*/__pycache__/*' -print0 | sort -z | xargs -0 sha256sum
  } | sha256sum)
  [[ -f $stamps/$name && $(<"$stamps/$name") == "$key" ]] && return
  "$@"
  echo "$key" >"$stamps/$name"
}

pip() { "$venv/bin/python" -m pip --quiet --disable-pip-version-check "$@"; }

create_venv() {
  "$venv/bin/python" -c 'import pip' 2>/dev/null && [[ -d $stamps ]] && return
  say "creating $venv"
  python3 -m venv --clear "$venv"
  mkdir -p "$stamps"
  pip install --upgrade 'pip>=25.1' # the first that knows dependency groups
}

install_group() {
  say "installing the tools of group '$1'"
  pip install --group "$1"
}

# The build requirements stay in .venv and the objects in build/python: a second build is quick.
install_package() {
  say "building and installing the package"
  pip install --no-build-isolation --config-settings=build-dir=build/python '.[cli,video]'
}

# ---- the goals ----------------------------------------------------------------------------------
install_system_packages
create_venv
package_sources=(CMakeLists.txt pyproject.toml cmake cpp glsl python scenes)
once group-build pyproject.toml -- install_group build
case $goal in
  test) once group-test pyproject.toml -- install_group test ;;
  lint) once group-lint pyproject.toml -- install_group lint ;;
  docs) once group-stubs pyproject.toml -- install_group stubs ;;
esac
once package "${package_sources[@]}" -- install_package
