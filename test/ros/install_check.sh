#!/usr/bin/env bash
# Builds the package as its users may (catkin_make, catkin_make_isolated --install, catkin build), each in a workspace of
# its own, and runs it from the install space alone: rosrun, roslaunch, a bag played through the installed nodelets.
# usage: install_check.sh [catkin_make] [isolated] [catkin_tools]      (default: all three)
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mktemp -d "${TMPDIR:-/tmp}/ardrone_vslam_install.XXXXXX")
trap 'rm -rf "$work"' EXIT
export ROS_HOME="$work/ros_home"
python_options=(-DPYTHON_EXECUTABLE=/usr/bin/python3 -DPython3_EXECUTABLE=/usr/bin/python3)
options=("${python_options[@]}" -DARDRONE_VSLAM_BUILD_TESTS=OFF -DCMAKE_BUILD_TYPE=Release)
if command -v ccache > /dev/null; then options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
jobs=$(nproc)

fail() { echo "install_check: $*" >&2; exit 1; }

new_workspace() {
  mkdir -p "$work/$1/src/ardrone_vslam"
  tar -C "$root" --exclude=./.git --exclude='./build*' -cf - . | tar -C "$work/$1/src/ardrone_vslam" -xf -
  cd "$work/$1"
}

run_quietly() {
  "$@" > "$work/log" 2>&1 || { tail -n 40 "$work/log" >&2; fail "failed: $*"; }
}

# A free port for a master of its own.
free_port() {
  /usr/bin/python3 -c 'import socket; s = socket.socket(); s.bind(("", 0)); print(s.getsockname()[1])'
}

# $1: setup.bash of the space to run from; the package's sources must not be needed any more.
check_runs() {
  (
    set +u; source "$1"; set -u
    port=$(free_port)
    export ROS_MASTER_URI="http://localhost:$port"
    found=$(rospack find ardrone_vslam)
    [ "$found" = "$2" ] || fail "rospack finds $found, not $2"
    rosmsg show ardrone_vslam/Status > /dev/null || fail "rosmsg does not know the messages"
    for program in camera_node tracker_node mapper_node odometry_fusion_node onboard_bridge_node vslam_onboard replay make_bag make_world doctor fake_driver; do
      rosrun ardrone_vslam "$program" --version | grep -q ardrone_vslam || fail "rosrun $program --version"
    done
    for script in evaluate record_run measure_latency; do
      rosrun ardrone_vslam "$script" --help > /dev/null || fail "rosrun $script --help"
      rosrun ardrone_vslam "$script" --version | grep -q 'ardrone_vslam) [0-9]' || fail "rosrun $script --version"
    done
    rosrun ardrone_vslam make_world laps --out "$work/laps.bag" --seconds 4 --force > /dev/null 2>&1 || fail "make_world"
    roslaunch -p "$port" ardrone_vslam replay.launch bag:="$work/laps.bag" quit:=true > "$work/launch.log" 2>&1 &
    launched=$!
    poses=$(timeout 60 /usr/bin/python3 "$work/count_poses.py" 60) || {
      kill -INT "$launched" || true
      tail -n 40 "$work/launch.log" >&2
      fail "no poses from the installed nodelets"
    }
    wait "$launched" || true
    echo "install_check: $(dirname "$1"): $poses poses from a bag"
  )
}

cat > "$work/count_poses.py" <<'PYTHON'
import sys
import time
import rosgraph
import rospy
from geometry_msgs.msg import PoseWithCovarianceStamped
end_s = time.monotonic() + 40
while not rosgraph.is_master_online():
    if time.monotonic() > end_s:
        sys.exit(1)
    time.sleep(0.1)
poses = []
rospy.init_node("count_poses", disable_signals=True)
rospy.Subscriber("/vslam/pose", PoseWithCovarianceStamped, poses.append)
while len(poses) < int(sys.argv[1]) and time.monotonic() < end_s:
    time.sleep(0.1)
print(len(poses))
sys.exit(0 if len(poses) >= int(sys.argv[1]) else 1)
PYTHON

check_catkin_make() {
  echo "== catkin_make"
  new_workspace catkin_make
  run_quietly catkin_make -j"$jobs" "${options[@]}"
  check_runs "$PWD/devel/setup.bash" "$PWD/src/ardrone_vslam"
}

check_isolated() {
  echo "== catkin_make_isolated --install"
  new_workspace isolated
  run_quietly catkin_make_isolated --install -j"$jobs" "${options[@]}"
  rm -rf src devel_isolated build_isolated  # the install space must stand alone
  check_runs "$PWD/install_isolated/setup.bash" "$PWD/install_isolated/share/ardrone_vslam"
}

check_catkin_tools() {
  if ! command -v catkin > /dev/null; then
    echo "== catkin build: skipped, catkin-tools is not installed (apt-get install catkin-tools)"
    return
  fi
  echo "== catkin build"
  new_workspace catkin_tools
  run_quietly catkin init
  run_quietly catkin config --install --cmake-args "${options[@]}"
  run_quietly catkin build -j"$jobs" --no-status --no-notify
  check_runs "$PWD/install/setup.bash" "$PWD/install/share/ardrone_vslam"
}

if [ "$#" -eq 0 ]; then set -- catkin_make isolated catkin_tools; fi
for check in "$@"; do
  declare -F "check_$check" > /dev/null || fail "unknown check '$check'; known are catkin_make, isolated, catkin_tools"
  "check_$check"
done
echo "install_check: all well"
