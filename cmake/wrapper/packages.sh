# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash disable=SC2154 # ./tyndall sets the folders
# The Debian packages that Tyndall needs, and their installation. Sourced by ./tyndall.
# Debian's libopenvdb-dev does not bring the Boost headers that its own include.

readonly run_packages=(
  g++ cmake ninja-build glslang-tools spirv-tools
  libvulkan-dev libvulkan1 mesa-vulkan-drivers
  libopenvdb-dev libboost-dev libopenexr-dev libtbb-dev libpng-dev libglm-dev
  libtinygltf-dev libtinyobjloader-dev libstb-dev
  nlohmann-json3-dev libcli11-dev libspdlog-dev libfmt-dev
)
readonly test_packages=(vulkan-validationlayers libgtest-dev libgmock-dev openexr)

# Prints those of the packages given that are not installed, in their order.
missing_packages() {
  local installed package
  # dpkg-query fails when it knows nothing of a name; what it prints for the others is right all the same.
  installed=$(dpkg-query -W -f='${Package} ${db:Status-Status}\n' "$@" 2>/dev/null || true)
  for package in "$@"; do
    [[ $'\n'$installed$'\n' == *$'\n'"$package installed"$'\n'* ]] || printf '%s\n' "$package"
  done
}

# Installs what is missing for running (run) or for the tests too (test); ends the program if it cannot.
install_missing_packages() {
  local wanted=("${run_packages[@]}") missing as_root log=$setup_folder/packages.log
  [[ $1 != test ]] || wanted+=("${test_packages[@]}")
  if ! command -v dpkg-query >/dev/null; then
    say "This is no Debian system: make sure of what these packages hold: ${wanted[*]}"
    return
  fi
  mapfile -t missing < <(missing_packages "${wanted[@]}")
  ((${#missing[@]})) || return 0
  if (($(id -u) == 0)); then
    as_root=()
  elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
    as_root=(sudo -n)
  elif command -v sudo >/dev/null && [[ -t 0 && -t 2 ]]; then
    as_root=(sudo)
  else
    say "Tyndall needs Debian packages that are not installed. Run this line once as root, then call ./tyndall again:"
    say "apt-get update && apt-get install -y --no-install-recommends ${missing[*]}"
    exit 1
  fi
  say "Installing ${#missing[@]} Debian packages and what they need: ${missing[*]}"
  if ! install_packages >"$log" 2>&1; then
    tail -n 12 "$log" >&2
    give_up "the packages could not be installed; the whole log is $log. Mend that and call ./tyndall again."
  fi
}

# Uses `as_root` and `missing` of its caller. An update that fails is no reason to stop: old lists may do.
install_packages() {
  local apt=(${as_root[@]+"${as_root[@]}"} env DEBIAN_FRONTEND=noninteractive apt-get -y -o DPkg::Lock::Timeout=300)
  "${apt[@]}" update || true
  "${apt[@]}" install --no-install-recommends "${missing[@]}"
}
