# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash disable=SC2154 # ./tyndall sets the folders
# A newer lavapipe beside the system's own, for machines whose only Vulkan device is an old software one.
# Sourced by ./tyndall.

readonly wanted_mesa=25 # skips branches that no lane takes, has no loop limit, traces rays 1.1x to 1.75x faster

# Succeeds if some graphics card has a Vulkan driver on this system.
has_hardware_driver() {
  local node vendor
  if [[ -e ${device_root:-}/dev/nvidiactl ]]; then
    compgen -G "${device_root:-}/etc/vulkan/icd.d/*nvidia*" >/dev/null && return 0
    compgen -G "${device_root:-}/usr/share/vulkan/icd.d/*nvidia*" >/dev/null && return 0
  fi
  for node in "${device_root:-}"/dev/dri/renderD*; do
    [[ -e $node ]] || continue
    vendor=
    read -r vendor 2>/dev/null <"${device_root:-}/sys/class/drm/${node##*/}/device/vendor" || true
    case $vendor in
      0x10de) ;;                   # Nvidia: its own files, above, decide
      0x1af4 | 0x1414 | 0x15ad) ;; # cards of virtual machines, for which Mesa has no Vulkan driver
      *) return 0 ;;
    esac
  done
  return 1
}

# Succeeds if the system's own software driver is present and older than wanted_mesa.
stock_driver_is_old() {
  local version
  version=$(dpkg-query -W -f='${Version}\n' mesa-vulkan-drivers 2>/dev/null) || return 1
  version=${version#*:} # an epoch
  ((${version%%.*} < wanted_mesa))
}

# Prints an apt source line for <suite>-backports on the mirror that the system itself uses. apt-get
# parses its own configuration here, so both file formats and every place for them are understood.
backports_source() {
  local codename uri release component
  codename=$(sed -n 's/^VERSION_CODENAME="\{0,1\}\([a-z]*\).*/\1/p' /etc/os-release)
  [[ -n $codename ]] || { echo "/etc/os-release names no release" >&2; return 1; }
  # shellcheck disable=SC2016 # these are apt-get's variables
  while IFS='|' read -r uri release component; do
    [[ $component == main ]] || continue
    case $release in "$codename" | stable | oldstable) ;; *) continue ;; esac
    printf 'deb [target=Packages] %s %s-backports main\n' "$uri" "$codename"
    return 0
  done < <(apt-get indextargets --format '$(REPO_URI)|$(RELEASE)|$(COMPONENT)' 'Created-By: Packages')
  echo "apt's sources name no mirror with $codename main" >&2
  return 1
}

# apt-get with its own source list and lists in folder $1; the system's are neither read nor written.
apt_beside_system() {
  local folder=$1
  shift
  apt-get -qq -o "Dir::Etc::SourceList=$folder/sources.list" -o Dir::Etc::SourceParts=/dev/null \
    -o Dir::Etc::Preferences=/dev/null -o Dir::Etc::PreferencesParts=/dev/null \
    -o "Dir::State::Lists=$folder/lists" -o "Dir::Cache=$folder/cache" -o APT::Sandbox::User=root \
    -o Acquire::Languages=none -o Acquire::Retries=1 -o Acquire::http::Timeout=20 -o Acquire::https::Timeout=20 \
    "$@"
}

# Succeeds if all that the driver file $1 is linked with is there: LLVM and libdrm came with the stock package.
finds_its_libraries() {
  local links
  links=$(ldd "$1") || return 1
  [[ $links != *"not found"* ]] || { grep 'not found' <<<"$links" >&2; return 1; }
}

# Downloads the package into folder $1 and leaves libvulkan_lvp.so, lvp_icd.json and version there.
unpack_newer_driver() {
  local work=$1 suite package version api
  mkdir -p "$work/apt/lists/partial" "$work/apt/cache/archives/partial"
  backports_source >"$work/apt/sources.list" || return 1
  read -r _ _ _ suite _ <"$work/apt/sources.list"
  apt_beside_system "$work/apt" update || return 1
  (cd "$work" && apt_beside_system "$work/apt" -t "$suite" download mesa-vulkan-drivers) || return 1
  package=$(compgen -G "$work/mesa-vulkan-drivers_*.deb") || { echo "no package came" >&2; return 1; }
  version=$(dpkg-deb -f "$package" Version) || return 1
  ((${version%%.*} >= wanted_mesa)) || { echo "$suite has only Mesa $version" >&2; return 1; }
  dpkg-deb --fsys-tarfile "$package" | tar -x -C "$work" --transform='s|.*/||' \
    --wildcards '*/libvulkan_lvp.so' '*/lvp_icd*.json' || return 1
  finds_its_libraries "$work/libvulkan_lvp.so" || return 1
  api=$(sed -n 's/.*"api_version": *"\([^"]*\)".*/\1/p' "$work"/lvp_icd*.json)
  rm -rf "$work/apt" "$package" "$work"/lvp_icd*.json
  # The package's own file names the system's folder; this one must name ours, in full.
  printf '{"file_format_version": "1.0.0", "ICD": {"library_path": "%s", "api_version": "%s"}}\n' \
    "$driver_folder/libvulkan_lvp.so" "$api" >"$work/lvp_icd.json"
  printf '%s\n' "$version" >"$work/version"
}

# Succeeds if $driver_folder already holds what would be fetched again: some other package has come or gone.
newer_driver_still_good() {
  [[ -e $driver_folder/lvp_icd.json && $(<"$driver_folder/lvp_icd.json") == *"\"$driver_folder/"* ]] &&
    ! has_hardware_driver && stock_driver_is_old && finds_its_libraries "$driver_folder/libvulkan_lvp.so" 2>/dev/null
}

# Leaves in $driver_folder either a newer driver, or the file "stock" that says why the system's own is used:
# the time in seconds, then the reason. A reason that starts with "failed" is tried again after a day.
settle_driver() {
  local work="$driver_folder.part" log=$setup_folder/driver.log now
  if newer_driver_still_good; then return 0; fi
  printf -v now '%(%s)T' -1
  rm -rf "$work" "$driver_folder"
  mkdir -p "$work"
  if has_hardware_driver; then
    printf '%s a graphics card is there\n' "$now" >"$work/stock"
  elif ! stock_driver_is_old; then
    printf "%s the system's own driver is new enough\n" "$now" >"$work/stock"
  else
    say "Fetching a newer software Vulkan driver (11 MB) into build/mesa; the system's own stays as it is."
    if ! unpack_newer_driver "$work" >"$log" 2>&1; then
      say "No newer software driver could be had ($(head -n 1 "$log")): using the system's own," \
        "which is slower. ./tyndall setup --retry-driver tries again."
      rm -rf "$work"
      mkdir -p "$work"
      printf '%s failed, see %s\n' "$now" "$log" >"$work/stock"
    fi
  fi
  mv "$work" "$driver_folder"
}
