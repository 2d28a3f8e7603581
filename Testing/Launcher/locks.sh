#!/usr/bin/env bash
# locks.sh FOLDER: proves which launches of ./brainshift wait for each other. Two checkouts never do, and
# nothing waits for a set-up that it does not need; two builds in one folder take turns.
set -euo pipefail
source_folder=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../..")
folder=$1
rm -rf "$folder"
export XDG_CACHE_HOME=$folder/cache
unset DISPLAY

# A ParaView and build tools that do nothing.
export ParaView_DIR=$folder/paraview/lib/cmake/paraview-5.13
mkdir -p "$ParaView_DIR" "$folder/paraview/bin" "$XDG_CACHE_HOME/brainshift"
echo 'set(PACKAGE_VERSION "5.13.2")' >"$ParaView_DIR/paraview-config-version.cmake"
echo 'set(PARAVIEW_QT_MAJOR_VERSION "6")' >"$ParaView_DIR/paraview-config.cmake"
for program in pvpython cmake ninja ccache; do
  printf '#!/bin/sh\nexit 0\n' >"$folder/paraview/bin/$program"
  chmod +x "$folder/paraview/bin/$program"
done
for checkout in one two; do
  mkdir -p "$folder/$checkout/build/paraview-5.13"
  cp -r "$source_folder/brainshift" "$source_folder/Utilities" "$folder/$checkout"
done

# expect SAID WANTED WHAT
expect() {
  [[ $1 == "$2" ]] || { echo "$3: said '$1', expected '$2'" && exit 1; }
}

# says_while_held LOCK COMMAND…: "waits" if the command says that it waits while another holds the
# lock, else its last line. It may end then: the lock is let go once it waits.
says_while_held() {
  local said=$folder/said launch
  exec 8>"$1"
  flock 8
  shift
  "$@" >"$said" 2>&1 8>&- &
  launch=$!
  while kill -0 "$launch" 2>/dev/null && ! says_it_waits "$said"; do sleep 0.1; done
  exec 8>&-
  wait "$launch" || true
  if says_it_waits "$said"; then echo waits; else tail -n 1 "$said"; fi
}

says_it_waits() { grep -q "waiting for another brainshift" "$1"; }

launch=("$folder/one/brainshift" shell -- echo "goes on")
said=$(says_while_held "$folder/two/build/paraview-5.13.lock" "${launch[@]}")
expect "$said" "goes on" "While another checkout builds"
said=$(says_while_held "$XDG_CACHE_HOME/brainshift/debian-13.lock" "${launch[@]}")
expect "$said" "goes on" "While Debian 13 is set up"
said=$(says_while_held "$folder/one/build/paraview-5.13.lock" "${launch[@]}")
expect "$said" waits "While this folder is built"

# set_up MISSING: prepares Debian 13, where the packages MISSING are not installed yet.
set_up() {
  bash -c '
    set -euo pipefail
    checkout=$1 absent=$2 command=shell
    source "$checkout/Utilities/steps.sh"
    source "$checkout/Utilities/environment.sh"
    missing_packages() { echo $absent; }
    unlinked_python_modules() { :; }
    apt_install() { :; }
    prepare_debian 13
    echo "goes on"' bash "$folder/one" "$1"
}
export -f set_up
export folder
said=$(says_while_held "$XDG_CACHE_HOME/brainshift/debian-13.lock" bash -c "set_up ''")
expect "$said" "goes on" "While another launch installs what is here"
said=$(says_while_held "$XDG_CACHE_HOME/brainshift/debian-13.lock" bash -c "set_up cmake")
expect "$said" waits "While another launch installs what is missing here"
((EUID == 0)) || exit 0 # only root may install what is missing
said=$(says_while_held "$XDG_CACHE_HOME/brainshift/debian-14.lock" bash -c "set_up cmake")
expect "$said" "goes on" "While another Debian is set up"
