#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# ./tyndall on a toy project with made-up package tools: no network, nothing of the system touched.
# Each case gets a fresh copy; a tool that is called leaves a line in $calls.
set -euo pipefail
this_release=$(awk -F= '/^VERSION_CODENAME=/ { print $2 }' /etc/os-release)
repository=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd -P)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
unset VK_DRIVER_FILES VK_ICD_FILENAMES TYNDALL_STOCK_DRIVER # the tests themselves may run under ./tyndall
failures=0 cases=0

expect() { # what, then a command that must succeed
  local what=$1
  shift
  if ! "$@"; then
    printf 'FAILED in %s: %s\n' "${FUNCNAME[1]}" "$what"
    sed 's/^/  | /' "$scratch/output" "$calls"
    failures=$((failures + 1))
  fi
}
is() { [[ $1 == "$2" ]] || { printf '%s is not %s\n' "$1" "$2"; return 1; }; }
shows() { grep -qF -e "$1" "$scratch/output"; }
shows_not() { ! shows "$1"; }
called() { grep -qF -e "$1" "$calls"; }
called_not() { ! called "$1"; }
count_calls() { grep -cF -e "$1" "$calls" || true; }

tool() { # name; the script comes from standard input
  { printf '#!/bin/bash\necho "%s $*" >>"%s"\n' "$1" "$calls"; cat; } >"$fakes/$1"
  chmod +x "$fakes/$1"
}

# A toy project with the real wrapper. Its program prints its arguments and driver, and returns $TOY_EXIT.
make_checkout() {
  cases=$((cases + 1))
  checkout="$scratch/check out $cases" fakes=$scratch/fakes$cases calls=$scratch/calls$cases
  mkdir -p "$checkout/cmake" "$checkout/src" "$checkout/shaders" "$fakes"
  : >"$calls"
  cp -r "$repository/cmake/wrapper" "$checkout/cmake/"
  cp "$repository/tyndall" "$repository/CMakePresets.json" "$checkout/"
  cat >"$checkout/CMakeLists.txt" <<'TOY'
cmake_minimum_required(VERSION 3.25)
project(Toy LANGUAGES NONE)
add_custom_target(tyndall COMMAND cp "${CMAKE_SOURCE_DIR}/src/toy.sh" "${CMAKE_BINARY_DIR}/tyndall" VERBATIM)
add_custom_target(tyndall_tests COMMAND touch tests_built)
if(TYNDALL_TESTS)
  enable_testing()
  add_test(NAME short COMMAND "${CMAKE_COMMAND}" -E cat tests_built)
  add_test(NAME slow COMMAND false)
  set_tests_properties(slow PROPERTIES LABELS long)
endif()
TOY
  cat >"$checkout/src/toy.sh" <<'TOY'
#!/bin/bash
printf 'argument <%s>\n' "$@"
echo "driver <${VK_DRIVER_FILES:-}>"
exit "${TOY_EXIT:-0}"
TOY
  chmod +x "$checkout/src/toy.sh"
  # Everything is installed, and the driver is new enough, unless a case says otherwise.
  installed_except nothing 25.1.0-1
  tool ninja <<<"exec $(command -v ninja) \"\$@\""
  tool apt-get <<<'exit 1'
  tool id <<<'echo 1000'
  tool sudo <<<'exit 1'
}

installed_except() { # package, version of Mesa's drivers
  tool dpkg-query <<FAKE
if [[ \$2 == -f='\${Version}\\n' ]]; then echo '$2'; exit; fi
for package in "\${@:3}"; do [[ \$package == '$1' ]] || echo "\$package installed"; done
FAKE
}

call() { # the wrapper's arguments; leaves its exit status in $status
  status=0
  PATH=$fakes:$PATH "$checkout/tyndall" "$@" >"$scratch/output" 2>&1 </dev/null || status=$?
}

arguments_and_exit_status_pass_through() {
  make_checkout
  TOY_EXIT=7 call render 'a b.json' '' '*'
  expect "status is the program's" is "$status" 7
  expect "spaces survive" shows 'argument <a b.json>'
  expect "an empty argument survives" shows 'argument <>'
  expect "nothing is expanded" shows 'argument <*>'
}

builds_only_what_changed() {
  make_checkout
  call one
  expect "first call builds" is "$(count_calls "release -j ")" 1
  call two
  expect "second call builds nothing" is "$(count_calls "release -j ")" 1
  expect "and asks for no package" is "$(count_calls dpkg-query)" 2
  touch "$checkout/shaders/new.glsl"
  call three
  expect "a new shader is seen" is "$(count_calls "release -j ")" 2
  rm "$checkout/shaders/new.glsl"
  call four
  expect "a file that has gone is seen" is "$(count_calls "release -j ")" 3
  touch "$checkout/CMakeLists.txt"
  call five
  expect "the build's own files are seen" is "$(count_calls "release -j ")" 4
  rm "$checkout/build/release/tyndall"
  call six
  expect "a program that has gone is built again" is "$(count_calls "release -j ")$status" 50
}

a_failed_build_is_told_and_tried_again() {
  make_checkout
  mv "$checkout/src/toy.sh" "$scratch/kept.sh"
  call one
  expect "fails" is "$status" 1
  expect "shows the error" shows 'toy.sh'
  expect "names the log" shows "$checkout/build/setup/build.log"
  mv "$scratch/kept.sh" "$checkout/src/toy.sh"
  call two
  expect "works once mended" is "$status" 0
  printf 'message(FATAL_ERROR "no such luck")\n' >>"$checkout/CMakeLists.txt"
  call three
  expect "a broken configuration fails" is "$status" 1
}

a_moved_checkout_builds_from_its_new_place() {
  make_checkout
  call one
  cp -a "$checkout" "$scratch/moved"
  rm -r "$checkout"
  checkout=$scratch/moved
  touch "$checkout/src/toy.sh"
  call two
  expect "works" is "$status" 0
}

without_root_the_line_to_run_is_shown() {
  make_checkout
  installed_except libpng-dev 25.1.0-1
  call render
  expect "fails" is "$status" 1
  expect "the line is there, whole" grep -qx \
    'apt-get update && apt-get install -y --no-install-recommends libpng-dev' "$scratch/output"
  expect "nothing was tried" called_not apt-get
  expect "nothing was built" called_not 'ninja -C'
}

root_installs_what_is_missing() {
  make_checkout
  installed_except libpng-dev 25.1.0-1
  tool id <<<'echo 0'
  tool apt-get <<<'exit 0'
  call render
  expect "works" is "$status" 0
  expect "lists are updated" called ' update'
  expect "that package alone is installed" called 'install --no-install-recommends libpng-dev'
  expect "no sudo" called_not sudo
}

sudo_without_password_is_used() {
  make_checkout
  installed_except libpng-dev 25.1.0-1
  tool sudo <<<'[[ $* == "-n true" ]] || { shift; "$@"; }'
  tool apt-get <<<'exit 0'
  call render
  expect "works" is "$status" 0
  expect "sudo installs" called 'sudo -n env DEBIAN_FRONTEND=noninteractive apt-get'
}

a_failed_installation_is_told() {
  make_checkout
  installed_except libpng-dev 25.1.0-1
  tool id <<<'echo 0'
  tool apt-get <<<'echo "E: the mirror sleeps"; exit 100'
  call render
  expect "fails" is "$status" 1
  expect "says why" shows 'the mirror sleeps'
  call render
  expect "the next call tries again" is "$(count_calls 'recommends libpng-dev')" 2
}

the_tests_need_more_packages_and_leave_out_the_long_ones() {
  make_checkout
  installed_except libgtest-dev 25.1.0-1
  call render
  expect "rendering needs no test package" is "$status" 0
  expect "and builds no test" test ! -e "$checkout/build/release/tests_built"
  call test
  expect "testing does" shows 'libgtest-dev'
  installed_except nothing 25.1.0-1
  call test
  expect "the short test passes" is "$status" 0
  expect "the long one is left out" shows_not slow
  call test --all
  expect "--all has the long one, which fails" is "$status" 8
  call test -R no_such_test
  expect "no test at all is a failure" test "$status" -ne 0
}

# apt-get for a mirror whose backports hold Mesa $1. The driver in it is some library that is there anyway.
mirror_with_mesa() {
  local package=$scratch/package$cases library
  library=$(ldd /bin/bash | awk '/libc\.so/ { print $3 }')
  mkdir -p "$package/DEBIAN" "$package/usr/lib/some-arch" "$package/usr/share/vulkan/icd.d"
  cp "$library" "$package/usr/lib/some-arch/libvulkan_lvp.so"
  echo '{"ICD": {"api_version": "1.4.1", "library_path": "/usr/lib/some-arch/libvulkan_lvp.so"}}' \
    >"$package/usr/share/vulkan/icd.d/lvp_icd.json"
  printf 'Package: mesa-vulkan-drivers\nVersion: %s\nArchitecture: all\nMaintainer: A <a@b>\nDescription: toy\n' \
    "$1" >"$package/DEBIAN/control"
  dpkg-deb --root-owner-group -b "$package" "$scratch/package$cases.deb" >/dev/null
  tool apt-get <<FAKE
case "\$*" in
  indextargets*)
    echo "http://mirror.test/debian-security/|$this_release-security|main"
    echo "http://other.test/debian/|$this_release|contrib"
    echo "http://mirror.test/debian/|$this_release|main" ;;
  *' update') for option in "\$@"; do
      [[ \$option != Dir::Etc::SourceList=* ]] || sed 's/^/source: /' "\${option#*=}" >>"$calls"
    done ;;
  *' download mesa-vulkan-drivers') cp "$scratch/package$cases.deb" mesa-vulkan-drivers_1_all.deb ;;
  *) exit 1 ;;
esac
FAKE
}

# A machine with a graphics card takes its own driver; the cases below are about machines without.
lacks_hardware_driver() { ! (source "$repository/cmake/wrapper/driver.sh" && has_hardware_driver); }

an_old_software_driver_is_stepped_over() {
  lacks_hardware_driver || return 0
  make_checkout
  installed_except nothing 22.3.6-1
  mirror_with_mesa 25.0.7-2~bpo12+1
  call render
  expect "works" is "$status" 0
  expect "its own mirror is asked for backports" called \
    "source: deb [target=Packages] http://mirror.test/debian/ $this_release-backports main"
  expect "the program gets the driver" shows "driver <$checkout/build/mesa/lvp_icd.json>"
  expect "which is named in full" grep -qF "\"$checkout/build/mesa/libvulkan_lvp.so\"" "$checkout/build/mesa/lvp_icd.json"
  expect "with the version it came with" grep -qF '"1.4.1"' "$checkout/build/mesa/lvp_icd.json"
  expect "and is there" test -s "$checkout/build/mesa/libvulkan_lvp.so"
  call render
  expect "it is fetched once" is "$(count_calls download)" 1
  TYNDALL_STOCK_DRIVER=1 call render
  expect "unless the stock driver is wanted" shows 'driver <>'
  VK_DRIVER_FILES=/mine.json call render
  expect "or another one" shows 'driver </mine.json>'
}

a_failed_download_falls_back_for_a_day() {
  lacks_hardware_driver || return 0
  make_checkout
  installed_except nothing 22.3.6-1
  mirror_with_mesa 23.0.0-1
  call render
  expect "the render goes on" is "$status" 0
  expect "with the system's driver" shows 'driver <>'
  expect "says so in one line" is "$(grep -c 'No newer software driver' "$scratch/output")" 1
  call render
  expect "is not tried at each call" is "$(count_calls download)" 1
  sed -i 's/^[0-9]*/1000/' "$checkout/build/mesa/stock"
  call render
  expect "is tried again after a day" is "$(count_calls download)" 2
  call setup --retry-driver
  expect "or when told to" is "$(count_calls download)" 3
}

a_new_driver_or_a_card_is_left_alone() {
  make_checkout
  call render
  expect "nothing is fetched for a new driver" called_not apt-get
  mkdir -p "$scratch/machine/dev/dri" "$scratch/machine/sys/class/drm/renderD128/device"
  touch "$scratch/machine/dev/dri/renderD128"
  echo 0x8086 >"$scratch/machine/sys/class/drm/renderD128/device/vendor"
  has_card() { (device_root=$scratch/machine && source "$repository/cmake/wrapper/driver.sh" && has_hardware_driver); }
  has_no_card() { ! has_card; }
  expect "a card of Intel counts" has_card
  echo 0x1af4 >"$scratch/machine/sys/class/drm/renderD128/device/vendor"
  expect "a virtual one does not" has_no_card
  touch "$scratch/machine/dev/nvidiactl"
  expect "a card of Nvidia without its driver does not" has_no_card
  mkdir -p "$scratch/machine/etc/vulkan/icd.d"
  touch "$scratch/machine/etc/vulkan/icd.d/nvidia_icd.json"
  expect "with it, it does" has_card
}

memory_bounds_the_compilers() {
  jobs_with() { (meminfo=$scratch/meminfo && echo "MemAvailable: $1 kB" >"$meminfo" &&
    source "$repository/cmake/wrapper/build.sh" && nproc() { echo 8; } && parallel_jobs); }
  expect "one at least" is "$(jobs_with 200000)" 1
  expect "two in 3.2 GB" is "$(jobs_with 3200000)" 2
  expect "never more than cores" test "$(jobs_with 900000000)" -le 8
}

arguments_and_exit_status_pass_through
builds_only_what_changed
a_failed_build_is_told_and_tried_again
a_moved_checkout_builds_from_its_new_place
without_root_the_line_to_run_is_shown
root_installs_what_is_missing
sudo_without_password_is_used
a_failed_installation_is_told
the_tests_need_more_packages_and_leave_out_the_long_ones
an_old_software_driver_is_stepped_over
a_failed_download_falls_back_for_a_day
a_new_driver_or_a_card_is_left_alone
memory_bounds_the_compilers
((failures == 0)) || { printf '%s checks failed\n' "$failures"; exit 1; }
echo "the wrapper's cases passed"
