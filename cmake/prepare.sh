# Sourced by demo and check: installs the Debian packages that are missing and builds into build/. Quiet about what is there.
# BULBUS_TARGETS=bulbus: the program alone, and the packages of cmake/packages.txt; default: everything, with packages_tests.txt.
set -euo pipefail
export DEBIAN_FRONTEND=noninteractive
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1  # mpirun refuses root otherwise
export OPENBLAS_NUM_THREADS=1

with_tests=ON
[ -z "${BULBUS_TARGETS:-}" ] || with_tests=OFF

missing_packages() {
  local lists=(cmake/packages.txt)
  [ $with_tests = OFF ] || lists+=(cmake/packages_tests.txt)
  while read -r package; do
    [ -n "$package" ] || continue
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || echo "$package"
  done < <(cat "${lists[@]}")
}

install_packages() {
  local missing
  mapfile -t missing < <(missing_packages)
  [ ${#missing[@]} -eq 0 ] && return
  echo "installing ${#missing[@]} Debian packages ..."
  local log
  log=$(mktemp)
  if ! { apt-get -o DPkg::Lock::Timeout=300 update -qq &&
         apt-get -o DPkg::Lock::Timeout=300 install -y -qq --no-install-recommends "${missing[@]}"; } > "$log" 2>&1; then
    cat "$log" >&2
    exit 1
  fi
}

build() {
  local preset=${BULBUS_PRESET:-release} folder=build
  [ "$preset" = release ] || folder=build-$preset
  is_configured "$folder" || { echo "configuring ..."; quietly cmake --preset "$preset" -DBULBUS_TESTS=$with_tests -DBULBUS_UMFPACK=$with_tests; }
  echo "building (a first build takes several minutes) ..."
  # shellcheck disable=SC2086
  quietly cmake --build --preset "$preset" ${BULBUS_TARGETS:+--target $BULBUS_TARGETS} -- -j"$(nproc)"
}

# A folder that was configured for the program alone has no tests, and no UMFPACK to compare with.
is_configured() {
  [ -f "$1/build.ninja" ] && { [ $with_tests = OFF ] || ! grep -Eq '^BULBUS_(TESTS|UMFPACK):BOOL=OFF' "$1/CMakeCache.txt"; }
}

quietly() {
  local log
  log=$(mktemp)
  "$@" > "$log" 2>&1 || { tail -60 "$log" >&2; exit 1; }
}

install_packages
build
