#!/bin/sh
# check_isa_symbols.sh NM ISA OBJECT…: what is compiled for one instruction set may define global
# symbols in its own namespace only. The linker keeps one of several equal symbols: a function of
# everybody's, compiled for AVX-512 here, would end programs on processors without it. (DW.ref are
# pointers that tables of exceptions use.)
nm=$1
isa=$2
shift 2
symbols=$("$nm" -C "$@" | grep ' [TWVBDu] ') || exit 1
if foreign=$(echo "$symbols" | grep -v -e "pbf::$isa::" -e ' DW\.ref\.'); then
  echo "$foreign"
  exit 1
fi
