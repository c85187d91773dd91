#!/usr/bin/env bash
# lint.sh [--fix] [TOOL…]: runs every tool, or those named:
#   layers ruff mypy clang-format lines codespell clang-tidy
# Their versions stand in pyproject.toml, group "lint". --fix lets ruff and clang-format write.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
PATH=$PWD/.venv/bin:$PATH

fix=false
[[ ${1:-} == --fix ]] && fix=true && shift

layers() { python scripts/check_layers.py; }

ruff_all() {
  if $fix; then
    ruff format . && ruff check --fix .
  else
    ruff check . && ruff format --check .
  fi
}

mypy_all() { MYPYPATH=python mypy; }

files() { git ls-files -z --cached --others --exclude-standard "$@"; }

clang_format() {
  local mode=(--dry-run -Werror)
  $fix && mode=(-i)
  files '*.hpp' '*.cpp' '*.inl' | xargs -0 clang-format "${mode[@]}"
}

# clang-format leaves comments alone, so that formulas keep their columns.
long_lines() {
  local found
  found=$(files '*.hpp' '*.cpp' '*.inl' '*.vert' '*.frag' '*.glsl' |
    LC_ALL=C.UTF-8 xargs -0 grep -nP '^.{101,}' || true)
  [[ -z $found ]] || { echo "longer than 100 columns:" && echo "$found" && return 1; }
}

spelling() { files | xargs -0 codespell; }

# Ninja knows which files an edit touches: only those are looked at again.
clang_tidy() { cmake --preset tidy >/dev/null && cmake --build --preset tidy -- -k 0; }

(($#)) || set -- layers ruff mypy clang-format lines codespell clang-tidy
for tool in "$@"; do
  echo "lint: $tool"
  case $tool in
    layers) layers ;;
    ruff) ruff_all ;;
    mypy) mypy_all ;;
    clang-format) clang_format ;;
    lines) long_lines ;;
    codespell) spelling ;;
    clang-tidy) clang_tidy ;;
    *) echo "lint.sh: unknown tool '$tool'" >&2 && exit 2 ;;
  esac
done
