# The Debian package: built in build/package-VERSION, and tried in a Debian that holds nothing else.
# Sourced by ./brainshift.
# shellcheck shell=bash
: "${checkout:?}" "${paraview:?}"

# The package's own build: as users get it, without tests.
package_folder=$checkout/build/package-$paraview

# The one package of the last build: "brainshift_0.1.0-1+pv5.13_amd64.deb".
built_package() { find "$package_folder" -maxdepth 1 -name 'brainshift_*.deb'; }

make_package() {
  [[ -z ${ParaView_DIR:-} ]] || fail 1 "package needs Debian's own ParaView; ParaView_DIR names another"
  build "package-$paraview" -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF -DCMAKE_INSTALL_PREFIX=/usr
  lock "$package_folder.lock" "builds this checkout"
  find "$package_folder" -maxdepth 1 -name 'brainshift_*.deb' -delete
  step "$package_folder-cpack" "Packaging" cpack --config "$package_folder/CPackConfig.cmake" -B "$package_folder"
  unlock
  desktop-file-validate "$checkout/Utilities/Packaging/brainshift.desktop"
  lintian --allow-root --tag-display-limit 0 --fail-on error "$(built_package)" ||
    fail 1 "lintian finds errors in $(built_package)"
  say "Install it on $(debian_name "$paraview") with: apt install $(built_package)"
}

debian_name() { echo "Debian $(debian_with_paraview "$1" | cut -d' ' -f1)"; }

# in_root ROOT COMMAND…: in the root filesystem, where nothing of this machine but /tmp is seen.
in_root() {
  local enter=("$checkout/Utilities/enter-rootfs") root=$1
  shift
  if can_unshare; then enter=("${private_mounts[@]}" "${enter[@]}" --private); fi
  "${enter[@]}" "$root" -- env -i --chdir=/ HOME=/root LANG=C.UTF-8 DEBIAN_FRONTEND=noninteractive \
    PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin "$@"
}

# Installs the package in a new Debian and bends a volume there, by script and in the window. What it
# needs must come by its own dependencies.
check_package() {
  local number release mirror root=$package_folder-root tests=/opt/brainshift-check
  ((EUID == 0)) || fail 1 "package --check makes a Debian of its own, which needs root"
  "$checkout/brainshift" --paraview "$paraview" package
  read -r number release < <(debian_with_paraview "$paraview")
  prepare_bootstrap
  lock "$root.lock" "checks this package"
  discard_partial "$root"
  step "$root-bootstrap" "Making a new Debian $number in $root" bootstrap "$root" "$release" "$mirror"
  mkdir "$root$tests"
  cp "$(built_package)" "$checkout"/Testing/Package/{installed_package.sh,bend.py,window.py} "$root$tests"
  step "$root-install" "Installing the package there (some minutes)" \
    in_root "$root" bash "$tests/installed_package.sh" install "$tests/$(basename "$(built_package)")"
  in_root "$root" bash "$tests/installed_package.sh" check || fail 1 "The installed package does not work"
  discard_partial "$root"
  unlock
}
