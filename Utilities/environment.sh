# Where to build: an own ParaView, this Debian, or a Debian inside a folder. Sourced by ./brainshift.
# shellcheck shell=bash
: "${checkout:?}"

# Debian's release that carries a ParaView: "number code-name".
debian_with_paraview() {
  case $1 in
    5.13) echo 13 trixie ;;
    6.1) echo 14 forky ;;
    *) return 1 ;;
  esac
}

# is_usable_paraview CMAKE_FOLDER VERSION: a development install of that version with Qt 6.
is_usable_paraview() {
  grep -qs "^set(PACKAGE_VERSION \"$2" "$1/paraview-config-version.cmake" &&
    grep -qs 'PARAVIEW_QT_MAJOR_VERSION "6"' "$1/paraview-config.cmake"
}

# The CMake folder of the paraview on the PATH, where it has one.
paraview_dir_on_path() {
  local program folder
  program=$(command -v paraview) || return 1
  program=$(realpath "$program")
  for folder in "${program%/bin/*}"/{lib,lib64,lib/*}/cmake/paraview-"$1"; do
    if is_usable_paraview "$folder" "$1"; then
      echo "$folder"
      return
    fi
  done
  return 1
}

# choose_environment VERSION: prints "own", "debian" or "rootfs".
# Debian testing has no VERSION_ID until its release, so code names are compared.
choose_environment() {
  local code_name
  if [[ -n ${ParaView_DIR:-} ]]; then
    is_usable_paraview "$ParaView_DIR" "$1" ||
      fail 1 "ParaView_DIR=$ParaView_DIR is no development install of ParaView $1 with Qt 6"
    echo own
    return
  fi
  code_name=$(sed -n 's/^VERSION_CODENAME=//p' /etc/os-release 2>/dev/null || true)
  if [[ $code_name == "$(debian_with_paraview "$1" | cut -d' ' -f2)" ]]; then
    echo debian
  elif paraview_dir_on_path "$1" >/dev/null; then
    echo own
  else
    echo rootfs
  fi
}

# prepare_own_paraview VERSION: puts the programs of that ParaView first on the PATH.
prepare_own_paraview() {
  local prefix program
  ParaView_DIR=${ParaView_DIR:-$(paraview_dir_on_path "$1")}
  export ParaView_DIR
  prefix=$(realpath "$ParaView_DIR")
  while [[ ! -x $prefix/bin/pvpython ]]; do
    [[ $prefix != / ]] || fail 1 "There is no bin/pvpython above ParaView_DIR=$ParaView_DIR"
    prefix=$(dirname "$prefix")
  done
  PATH=$prefix/bin:$PATH
  for program in cmake ninja ccache; do
    command -v "$program" >/dev/null || fail 1 "Building against $ParaView_DIR needs $program, which is not installed"
  done
}

# apt_install PACKAGE…: tolerates a run that was killed before, and package lists past their date.
apt_install() {
  local apt=(apt-get -y -o Acquire::Check-Valid-Until=false -o Acquire::Retries=3
    -o DPkg::Lock::Timeout=600 -o APT::Keep-Downloaded-Packages=false)
  export DEBIAN_FRONTEND=noninteractive
  { dpkg --configure -a || "${apt[@]}" --fix-broken install; } &&
    { "${apt[@]}" update || echo "Going on with the package lists as they are"; } &&
    "${apt[@]}" install --no-install-recommends "$@" &&
    rm -f /var/cache/apt/archives/partial/*.deb
}

# missing_packages DEBIAN_NUMBER: packages-COMMAND.txt lists what one command needs beside the others,
# packages-portable.txt what test --portable does, and packages-engine.txt what fuzz --engine does.
missing_packages() {
  local lists=("$checkout"/Utilities/packages-{common,"debian-$1"}.txt) wanted
  local own=$checkout/Utilities/packages-${command:-}.txt
  case "${command:-} ${arguments[0]:-}" in
    "test --portable" | "fuzz --engine") own=$checkout/Utilities/packages-${arguments[0]#--}.txt ;;
  esac
  [[ ! -f $own ]] || lists+=("$own")
  mapfile -t wanted < <(sed 's/#.*//' "${lists[@]}" | tr -s '[:space:]' '\n' | grep . | sort -u)
  comm -23 <(printf '%s\n' "${wanted[@]}") <(
    # shellcheck disable=SC2016 # dpkg-query fills these in
    dpkg-query --show --showformat '${db:Status-Abbrev} ${Package}\n' "${wanted[@]}" 2>/dev/null |
      sed -n 's/^ii *//p' | sort -u
  )
}

# ParaView's CMake files name Python modules vtkCommonCore.so, Debian installs them as
# vtkCommonCore.cpython-313-x86_64-linux-gnu.so; find_package(ParaView) fails without these links.
unlinked_python_modules() {
  local module
  find /usr/lib/python3/dist-packages/{vtkmodules,paraview} -name '*.cpython-3*.so' |
    while read -r module; do
      [[ -e ${module%%.cpython-3*}.so ]] || echo "$module"
    done
}

link_python_modules() {
  local module
  for module in "$@"; do
    ln -sf "${module##*/}" "${module%%.cpython-3*}.so" || return
  done
}

is_debian_prepared() {
  [[ -z $(missing_packages "$1") && -z $(unlinked_python_modules) ]]
}

# prepare_debian NUMBER: what is there is asked of dpkg each time, not remembered. Only a launch that
# has to install something waits for others that do.
prepare_debian() {
  local packages modules
  if is_debian_prepared "$1"; then return; fi
  lock_setup "debian-$1"
  mapfile -t packages < <(missing_packages "$1")
  if ((${#packages[@]} > 0)); then
    ((EUID == 0)) || fail 1 "Run this as root, or first: apt-get install ${packages[*]}"
    step "debian-$1-packages" "Installing ${#packages[@]} Debian packages (some minutes)" \
      apt_install "${packages[@]}"
  fi
  mapfile -t modules < <(unlinked_python_modules)
  if ((${#modules[@]} > 0)); then
    ((EUID == 0)) || fail 1 "Run this as root once: ParaView's Python modules need links beside them"
    step "debian-$1-links" "Linking ${#modules[@]} Python modules of ParaView" \
      link_python_modules "${modules[@]}"
  fi
  unlock
}
