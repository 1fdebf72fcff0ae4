# Sourced by the scripts beside it: where things are, and how the package is built. Sets `root` and `build`.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# Not build/: rosrun looks into no folder of that name inside a package.
build=${ARDRONE_VSLAM_BUILD:-$root/build_ros}

# Installs what is missing, then builds everything, or what the array `targets` names; further arguments go to cmake.
build_package() {
  "$root/scripts/install_dependencies" ${install_options:-}
  cmake -S "$root" -B "$build" -DCMAKE_BUILD_TYPE=Release "$@"
  cmake --build "$build" -j "$(nproc)" ${targets:+--target "${targets[@]}"}
}

# $1: the script's name.
print_version() {
  echo "$1 (ardrone_vslam) $(sed -n 's:.*<version>\(.*\)</version>.*:\1:p' "$root/package.xml")"
}

# Ends with exit code 2 unless the option has a value. $1: the script's name; then what is left of its arguments.
need_value() {
  [ $# -ge 3 ] && return
  echo "$1: $2 needs a value; see $1 --help" >&2
  exit 2
}

# The same for a number. $1: the script's name, $2: option, $3: its value.
need_number() {
  need_value "$@"
  [[ "$3" =~ ^[0-9]+(\.[0-9]*)?$|^\.[0-9]+$ ]] && return
  echo "$1: $2 '$3': must be a number, for example 1" >&2
  exit 2
}

# $1: what is done, $2: name of its log; the rest: the command. Prints every twentieth step of a build. Of the caller's:
# `script`, its name, and `out`, in whose log/ the logs are.
stage() {
  local what=$1 log=$out/log/$2.log begin=$SECONDS
  shift 2
  echo "$script: $what"
  if ! "$@" 2>&1 | tee "$log" | awk '/^\[[0-9]+\/[0-9]+\]/ { if (++n % 20 == 0) { print "  " $1; fflush() } }'; then
    grep -E 'error|FAILED' -A 5 "$log" | head -n 30 >&2 || true
    tail -n 5 "$log" >&2
    echo "$script: $what: failed; all that it said is in $log" >&2
    exit 1
  fi
  echo "$script:   done in $((SECONDS - begin)) s"
}

# The workstation's build without ROS, in the folder `native`; the arguments: what of it.
build_native() {
  local generator=()
  [ -e "$native/CMakeCache.txt" ] || generator=(-G Ninja)
  stage "the workstation's build" native_configure cmake "${generator[@]}" -S "$root" -B "$native" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_DISABLE_FIND_PACKAGE_catkin=1
  stage "building what renders and flies the flight" native_build cmake --build "$native" --target "$@"
}
