# A Debian inside a folder of the cache, for machines that are not the Debian wanted. Inside it
# ./brainshift runs again, now on the right Debian. Sourced by ./brainshift.
# shellcheck shell=bash
: "${checkout:?}" "${cache:?}"

# The mirror this machine installs Debian from. Cloud images name a file that lists mirrors.
debian_mirror() {
  local uri=${BRAINSHIFT_MIRROR:-}
  if [[ -z $uri ]]; then
    # A release with a dash is an update or security archive, not the main one.
    # shellcheck disable=SC2016 # apt-get fills these in
    uri=$(apt-get indextargets --format '$(ORIGIN) $(COMPONENT) $(RELEASE) $(REPO_URI)' \
      'Created-By: Packages' 2>/dev/null |
      awk '$1 == "Debian" && $2 == "main" && $3 !~ /-/ && $4 !~ /^cdrom:/ { print $4; exit }')
  fi
  if [[ $uri == mirror+file:* ]]; then
    uri=$(awk '/^[a-z]+:/ { print $1; exit }' "${uri#mirror+file:}")
  fi
  [[ -n $uri ]] && echo "${uri%/}"
}

# write_apt_settings ROOT RELEASE: the network may have changed since, so this runs at every launch.
write_apt_settings() {
  local root=$1 mirror
  cp --dereference /etc/resolv.conf "$root/etc/resolv.conf" 2>/dev/null || true
  mirror=$(debian_mirror) || return 0
  echo "deb $mirror $2 main" >"$root/etc/apt/sources.list"
  apt-config dump | grep -E '^Acquire::(https?::|Check-|Retries|ForceIPv)' |
    grep -v Auto-Detect >"$root/etc/apt/apt.conf.d/90host" || true
}

# Nothing in a root filesystem may be deleted while something of the host is mounted there.
discard_partial() {
  [[ -e $1 ]] || return 0
  if grep -qF " $1/" /proc/mounts; then
    fail 1 "Something is still mounted below $1; unmount it, then try again"
  fi
  rm -rf --one-file-system "$1"
}

# What mounts in here is undone by the kernel with the last process, also when that is killed.
private_mounts=(unshare --mount --propagation private)
can_unshare() { "${private_mounts[@]}" true 2>/dev/null; }

# bootstrap ROOT RELEASE MIRROR: both releases are signed with keys Debian 12 already knows.
bootstrap() {
  local partial=$1.partial proxy include=() shield=()
  local script=/usr/share/debootstrap/scripts/sid # what every Debian uses; older ones know no forky
  proxy=$(apt-config dump --format '%v%n' Acquire::http::Proxy)
  [[ -z $proxy ]] || export http_proxy=$proxy
  [[ $3 != https:* ]] || include=(--include=ca-certificates)
  # debootstrap mounts /proc; in a namespace of its own nothing stays mounted if it is killed
  if can_unshare; then shield=("${private_mounts[@]}"); fi
  discard_partial "$partial" &&
    "${shield[@]}" debootstrap --variant=minbase "${include[@]}" "$2" "$partial" "$3" "$script" &&
    write_apt_settings "$partial" "$2" &&
    echo force-unsafe-io >"$partial/etc/dpkg/dpkg.cfg.d/unsafe-io" && # no fsync: it can be made anew
    printf '#!/bin/sh\nexit 101\n' >"$partial/usr/sbin/policy-rc.d" && # packages start no services
    chmod +x "$partial/usr/sbin/policy-rc.d" &&
    mv "$partial" "$1"
}

# make_rootfs ROOT NUMBER RELEASE
make_rootfs() {
  local mirror
  ((EUID == 0)) || fail 1 "Making and entering a Debian $2 needs root; or set ParaView_DIR to a ParaView built with Qt 6"
  if [[ -d $1 ]]; then
    write_apt_settings "$1" "$3"
    return
  fi
  prepare_bootstrap
  lock_setup "debian-$2"
  if [[ ! -d $1 ]]; then # else another launch made it while this one waited
    step "debian-$2-bootstrap" "Making a Debian $2 in $1" bootstrap "$1" "$3" "$mirror"
  fi
  unlock
}

# What this machine needs before it can make a Debian; sets mirror.
prepare_bootstrap() {
  lock_setup machine
  # a fresh machine does not know yet what its archives hold
  debian_mirror >/dev/null || step mirror "Updating the package lists of this machine" \
    apt-get -o Acquire::Check-Valid-Until=false update
  mirror=$(debian_mirror) ||
    fail 1 "The configuration of apt names no Debian mirror; set BRAINSHIFT_MIRROR to its address"
  if ! command -v debootstrap >/dev/null; then
    step debootstrap "Installing debootstrap" apt_install debootstrap debian-archive-keyring
  fi
  unlock
}

# Folders that would hide a part of the root filesystem if they were shown in it.
is_system_folder() {
  [[ $1 =~ ^/(bin|boot|dev|etc|lib[0-9a-z]*|proc|run|sbin|sys|usr|var)?$ ||
    $1 =~ ^/(dev|etc|proc|sys|usr/(bin|lib|sbin|share))(/|$) ]]
}

# Where git keeps the files of a worktree: its .git is a file that names a folder elsewhere.
git_folder() {
  local folder common
  [[ -f $checkout/.git ]] || return 0
  folder=$(sed -n 's/^gitdir: //p' "$checkout/.git")
  [[ $folder == /* ]] || folder=$checkout/$folder
  common=$(cat "$folder/commondir" 2>/dev/null || echo .)
  [[ $common == /* ]] || common=$folder/$common
  [[ ! -d $common ]] || echo "$(realpath "$common")/"
}

# shown_home: the user's home, where the dialogs of ParaView's window begin and keep settings.
shown_home() {
  [[ $command == open ]] || return 0
  if [[ ! -d ${HOME:-} ]] || is_system_folder "$HOME"; then
    echo "brainshift: the window cannot show your home ${HOME:-}. What is saved under Home there lies in $cache," \
      "which may be deleted at any time" >&2
  else
    echo "$HOME/"
  fi
}

# visible_folders ARGUMENT…: where the arguments that are paths lie, parents first, none twice.
visible_folders() {
  local argument folder previous=//
  {
    printf '%s/\n' "$checkout" "$cache" "$PWD"
    git_folder
    shown_home
    for argument; do
      [[ -e $argument ]] || argument=${argument#-*=} # --output=PATH
      [[ -e $argument || $argument == */* && $argument != *$'\n'* ]] || continue
      folder=$(realpath -m -- "$argument") # a symbolic link is of use only with its target
      while [[ ! -d $folder ]]; do folder=$(dirname "$folder"); done
      echo "$folder/"
    done
  } | LC_ALL=C sort -u | while read -r folder; do
    if [[ $folder != "$previous"* ]] && ! is_system_folder "${folder%/}"; then
      echo "${folder%/}"
      previous=$folder
    fi
  done
}

passed_variables='^(HOME|TERM|COLORTERM|DISPLAY|XAUTHORITY|XDG_CACHE_HOME|CI|https?_proxy|no_proxy)$'
passed_variables+='|^(ASAN|BRAINSHIFT|CMAKE|CTEST|GALLIUM|LIBGL|LP|MESA|QT|UBSAN)_'

# enter_rootfs ROOT COMMAND…: replaces this process.
enter_rootfs() {
  local root=$1 variables names name folders folder=$PWD enter=("$checkout/Utilities/enter-rootfs")
  shift
  mapfile -t folders < <(visible_folders "$@")
  if is_system_folder "$PWD"; then folder=$checkout; fi
  if [[ -n ${DISPLAY:-} && -z ${XAUTHORITY:-} && -f $HOME/.Xauthority ]]; then
    export XAUTHORITY=$HOME/.Xauthority
  fi
  [[ ! -f ${XAUTHORITY:-} ]] || folders+=("$XAUTHORITY")
  variables=(PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8)
  mapfile -t names < <(compgen -e | grep -E "$passed_variables")
  for name in "${names[@]}"; do variables+=("$name=${!name}"); done
  if can_unshare; then enter=("${private_mounts[@]}" "${enter[@]}" --private); fi
  exec "${enter[@]}" "$root" "${folders[@]}" -- env -i --chdir="$folder" "${variables[@]}" "$@"
}
