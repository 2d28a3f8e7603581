#!/usr/bin/env bash
# installed_package.sh install PACKAGE.deb | check: runs in a new Debian, as root. Proves that the
# package brings all it needs, works by script and in the window, and leaves nothing when removed.
set -euo pipefail
tests=$(dirname "$(realpath "${BASH_SOURCE[0]}")")
apt=(apt-get -y -o Acquire::Check-Valid-Until=false -o Acquire::Retries=3)

install_package() {
  "${apt[@]}" update || echo "Going on with the package lists as they are"
  "${apt[@]}" install --no-install-recommends "$1"
  # the display is not the package's: it comes after it
  "${apt[@]}" install --no-install-recommends xvfb xauth
}

with_display() { timeout 300 xvfb-run -a -s "-screen 0 1600x1400x24" "$@"; }

# window COMMAND…: icons are drawn only where Qt has its plugin for SVG.
window() {
  local log=$tests/window.log
  with_display "$@" --dr --script="$tests/window.py" 2>&1 | tee "$log"
  ! grep -q "Pixmap is a null pixmap" "$log" || { echo "An icon is not drawn" && return 1; }
}

check_package() {
  local files command file
  dpkg --verify brainshift
  mapfile -t files < <(dpkg -L brainshift | grep -i brainshift)
  echo "pvpython, no path set:"
  with_display pvpython "$tests/bend.py"
  echo "ParaView's window, plugin loaded by the plugin manager:"
  BRAINSHIFT_WINDOW=manager window paraview
  echo "ParaView's window, started as by the launcher entry:"
  command=$(sed -n 's/^Exec=//p' /usr/share/applications/brainshift.desktop)
  # shellcheck disable=SC2086 # words of a command
  BRAINSHIFT_WINDOW=launcher window ${command/ %F/}
  "${apt[@]}" purge brainshift >/dev/null
  for file in "${files[@]}"; do
    [[ ! -e $file ]] || { echo "purge leaves $file" && return 1; }
  done
  echo "Removed: nothing is left of ${#files[@]} files and folders"
}

case $1 in
  install) install_package "$2" ;;
  check) check_package ;;
esac
