# Sourced by the scripts beside it: where things are, and how the package is built. Sets `root` and `build`.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=${ARDRONE_VSLAM_BUILD:-$root/build}

# Installs what is missing, then builds everything; further arguments go to cmake.
build_package() {
  "$root/scripts/install_dependencies" ${install_options:-}
  cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release "$@"
  cmake --build "$build" -j "$(nproc)"
}
