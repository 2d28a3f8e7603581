#!/usr/bin/env bash
# commands.sh FOLDER: proves that ./brainshift gives ctest and the lint what was asked for, refuses what
# it does not know, and that .ci/run fails if the tests or the lint do, and says which.
set -euo pipefail
source_folder=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../..")
folder=$1
rm -rf "$folder"
export XDG_CACHE_HOME=$folder/cache
unset CTEST_PARALLEL_LEVEL

# A ParaView and tools that write down how they are called.
export ParaView_DIR=$folder/paraview/lib/cmake/paraview-5.13
mkdir -p "$ParaView_DIR" "$folder/paraview/bin" "$folder"/checkout/{build/{paraview-5.13{,-asan,-clang,-engine},portable-{libcxx,windows}},.ci}
touch "$folder/checkout/build/paraview-5.13/environment.sh"
echo 'set(PACKAGE_VERSION "5.13.2")' >"$ParaView_DIR/paraview-config-version.cmake"
echo 'set(PARAVIEW_QT_MAJOR_VERSION "6")' >"$ParaView_DIR/paraview-config.cmake"
export called=$folder/called
for program in pvpython cmake ctest ninja ccache xvfb-run python3; do
  # shellcheck disable=SC2016 # the program expands it
  printf '#!/bin/sh\necho "%s $CTEST_PARALLEL_LEVEL $*" >>"$called"\n' "$program" >"$folder/paraview/bin/$program"
  chmod +x "$folder/paraview/bin/$program"
done
cp -r "$source_folder/brainshift" "$source_folder/Utilities" "$folder/checkout"
launcher=$folder/checkout/brainshift

# asks WORDS WANTED: ./brainshift WORDS calls a program with WANTED among its arguments.
asks() {
  rm -f "$called" "$folder"/checkout/build/*/configured-with
  # shellcheck disable=SC2086 # words
  "$launcher" $1 >"$folder/said" 2>&1 || { cat "$folder/said" && exit 1; }
  grep -qF -- "$2" "$called" || { echo "$1 does not call: $2" && cat "$called" && exit 1; }
}

# builds WORDS TIMES: how often ./brainshift WORDS builds.
builds() {
  asks "$1" ""
  [[ $(grep -c 'cmake .*--build' "$called") == "$2" ]] || { echo "$1 does not build $2 times" && exit 1; }
}

# refuses WORDS: with status 2, before anything is called.
refuses() {
  local status=0
  rm -f "$called"
  # shellcheck disable=SC2086 # words
  "$launcher" $1 >"$folder/said" 2>&1 || status=$?
  [[ $status == 2 && ! -e $called ]] || { echo "$1 ends with $status" && exit 1; }
}

asks "test" "xvfb-run $(nproc) "
asks "test -j5 -R House" "--output-on-failure -j5 -R House"
asks "test --quick -j1" "--output-on-failure -L ^quick\$ -j1"
asks "test --sanitize" "--output-on-failure -L ^cxx\$"
for words in "Portable -B $folder/checkout/build/portable-windows" "-stdlib=libc++" \
  "build/portable-libcxx --output-on-failure -R Fit" "-DCMAKE_CXX_COMPILER=clang++ -DCMAKE_COMPILE_WARNING_AS_ERROR=ON" \
  "build/paraview-5.13-clang --output-on-failure -L ^cxx\$ -R Fit"; do
  asks "test --portable -R Fit" "$words"
done
asks "fuzz --engine libfuzzer --count 5" "engine.py $folder/checkout/build/paraview-5.13-engine --count 5"
asks "fuzz --engine libfuzzer" "paraview-5.13-engine --target Fuzzers"
refuses "fuzz --engine honggfuzz"
asks "lint" "lint.py $folder/checkout $folder/checkout/build/paraview-5.13"
asks "lint spelling format" "paraview-5.13 spelling format"
builds lint 1
builds "lint house tidy" 1
builds "lint house" 0
refuses "lint tests"
refuses "nothing"

# shows COMMAND HOME: what a Debian of the launcher's own would show of this machine.
shows() (
  checkout=$folder/checkout cache=$folder/cache command=$1 HOME=$2
  # shellcheck source=/dev/null
  source "$source_folder/Utilities/rootfs.sh"
  visible_folders 2>"$folder/said"
)
shows open "$folder/paraview" | grep -qx "$folder/paraview" || { echo "The window shows no home" && exit 1; }
if shows test "$folder/paraview" | grep -x "$folder/paraview"; then echo "Tests see the home" && exit 1; fi
shows open / >/dev/null
grep -q "cannot show your home /" "$folder/said" || { echo "A home that is not shown is not said" && exit 1; }

# .ci/run with a launcher whose tests and lint end as they are told.
cp "$source_folder/.ci/run" "$folder/checkout/.ci"
# shellcheck disable=SC2016 # the launcher expands them
printf '#!/bin/sh\ncase $1 in test) exit $tests ;; lint) echo linted; exit $lint ;; esac\n' >"$launcher"

# server TESTS LINT STATUS LAST: with which status .ci/run ends, and its last line.
server() {
  local status=0
  tests=$1 lint=$2 "$folder/checkout/.ci/run" >"$folder/said" 2>&1 || status=$?
  [[ $status == "$3" && $(tail -n 1 "$folder/said") == "$4" ]] ||
    { echo ".ci/run ends with $status and says: $(cat "$folder/said")" && exit 1; }
  grep -q linted "$folder/said" || { echo ".ci/run does not show the lint" && exit 1; }
}

server 0 0 0 "Tests and lint passed"
server 1 0 1 "Failed: test"
server 0 1 1 "Failed: lint"
server 3 4 1 "Failed: test lint"
