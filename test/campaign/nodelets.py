# SPDX-License-Identifier: BSD-3-Clause
"""A master and what a launch file starts, all of them the campaign's own."""
import os
import signal
import socket
import subprocess
import time
import xmlrpc.client

START_S = 60


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Nodelets:
    """Start it before rospy.init_node of this process: it says where the master is."""

    def __init__(self, folder, *launch, uses_clock=False):
        """folder: of the logs; launch: arguments of roslaunch; uses_clock: time is what /clock says"""
        self.folder, self.port = folder, free_port()
        os.environ.update(ROS_MASTER_URI=f"http://127.0.0.1:{self.port}", ROS_IP="127.0.0.1", ROS_HOME=folder, ROS_LOG_DIR=folder)
        os.environ.pop("ROS_HOSTNAME", None)
        self.processes = {}
        self.launch_arguments = launch
        self.start_master()
        xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"]).setParam("/campaign", "/use_sim_time", uses_clock)
        self.launch()

    def start(self, name, *command):
        with open(os.path.join(self.folder, f"{name}.log"), "ab") as log:
            self.processes[name] = subprocess.Popen(command, stdout=log, stderr=log, start_new_session=True)

    def start_master(self):
        self.start("master", "rosmaster", "--core", "-p", str(self.port))
        end_s = time.monotonic() + START_S
        while True:
            try:
                return xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"]).getPid("/campaign")
            except OSError:
                if time.monotonic() > end_s:
                    raise RuntimeError("rosmaster does not answer") from None
                time.sleep(0.05)

    def launch(self):
        self.start("launch", "roslaunch", "--skip-log-check", *self.launch_arguments)

    def is_alive(self, name):
        return self.processes[name].poll() is None

    def kill(self, name, with_signal=signal.SIGKILL):
        os.killpg(self.processes[name].pid, with_signal)
        self.processes[name].wait()

    def wait_for_end(self, name, seconds=20):
        self.processes[name].wait(seconds)

    def pid_of(self, node):
        _, _, address = xmlrpc.client.ServerProxy(os.environ["ROS_MASTER_URI"]).lookupNode("/campaign", node)
        return xmlrpc.client.ServerProxy(address).getPid("/campaign")[2]

    def end_node(self, node):
        pid = self.pid_of(node)
        os.kill(pid, signal.SIGINT)
        end_s = time.monotonic() + START_S
        while os.path.exists(f"/proc/{pid}") and time.monotonic() < end_s:
            time.sleep(0.05)

    def stop(self):
        for name in reversed(list(self.processes)):
            if self.is_alive(name):
                os.killpg(self.processes[name].pid, signal.SIGINT)
                try:
                    self.processes[name].wait(20)
                except subprocess.TimeoutExpired:
                    self.kill(name)
