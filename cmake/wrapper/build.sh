# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash disable=SC2154 # ./tyndall sets the folders
# Configures and builds, quiet unless something fails. Sourced by ./tyndall.

readonly kilobytes_per_job=1500000 # what the compiler needs for a file that includes OpenVDB

# Prints how many compilers may run at once: as many as there are cores and as memory has room for.
parallel_jobs() {
  local cores room key value limit
  cores=$(nproc)
  room=$((cores * kilobytes_per_job))
  while read -r key value _; do
    [[ $key != MemAvailable: ]] || room=$value
  done <"${meminfo:-/proc/meminfo}"
  limit=$(cat /sys/fs/cgroup/memory.max 2>/dev/null || true)
  if [[ $limit =~ ^[0-9]+$ ]] && ((limit / 1024 < room)); then room=$((limit / 1024)); fi
  local jobs=$((room / kilobytes_per_job))
  if ((jobs > cores)); then jobs=$cores; fi
  if ((jobs < 1)); then jobs=1; fi
  printf '%s\n' "$jobs"
}

# $1: run or test. Configures if that has not been done, or done otherwise than is wanted now.
configure() {
  local cache=$binary_folder/CMakeCache.txt stamp=$setup_folder/configured log=$setup_folder/configure.log
  local tests=OFF fresh=() done_before=
  [[ ! -e $stamp ]] || done_before=$(<"$stamp")
  # Once the tests are configured they stay so: a render after a test need not configure again.
  [[ $1 != test && $done_before != ON ]] || tests=ON
  if [[ -e $cache ]] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$cache"; then
    fresh=(--fresh) # the checkout has been copied or moved with its build folder
  elif [[ -e $binary_folder/build.ninja && $done_before == "$tests" && ! $root/CMakePresets.json -nt $stamp ]]; then
    return 0
  fi
  rm -f "$stamp"
  if ! (cd "$root" && cmake --preset release ${fresh[@]+"${fresh[@]}"} "-DTYNDALL_TESTS=$tests") >"$log" 2>&1; then
    tail -n 25 "$log" >&2
    give_up "CMake could not configure the build; the whole log is $log."
  fi
  printf '%s\n' "$tests" >"$stamp"
}

# Copies ninja's output to the file $1 and shows how far it is: on a terminal in one line, else at each tenth.
show_progress() {
  local line at total tenth last_tenth=0
  while IFS= read -r line; do
    printf '%s\n' "$line" >&3
    [[ $line =~ ^\[([0-9]+)/([0-9]+)\]\  ]] || continue
    at=${BASH_REMATCH[1]} total=${BASH_REMATCH[2]}
    ((total > 3)) || continue # a small change builds in silence
    if [[ -t 2 ]]; then
      printf '\r\033[KBuilding Tyndall: %s of %s' "$at" "$total" >&2
      ((at < total)) || printf '\r\033[K' >&2
    else
      tenth=$((10 * at / total))
      ((tenth == last_tenth)) || say "Building Tyndall: $at of $total"
      last_tenth=$tenth
    fi
  done 3>"$1"
}

# $1: run or test.
build_program() {
  local targets=(tyndall) log=$setup_folder/build.log
  [[ $1 != test ]] || targets+=(tyndall_tests)
  [[ -x $program ]] || say "Building Tyndall in build/release; the first time takes some minutes."
  configure "$1"
  if ! NINJA_STATUS='[%f/%t] ' ninja -C "$binary_folder" -j "$(parallel_jobs)" "${targets[@]}" 2>&1 |
    show_progress "$log"; then
    [[ ! -t 2 ]] || say ""
    if grep -q '^FAILED:' "$log"; then sed -n '/^FAILED:/,$p' "$log" | head -n 40 >&2; else tail -n 15 "$log" >&2; fi
    give_up "the build failed; the whole log is $log."
  fi
}
