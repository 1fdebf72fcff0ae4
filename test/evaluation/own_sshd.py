# SPDX-License-Identifier: BSD-3-Clause
"""Two machines to log in to by real ssh that are this one: sshd on ports of the loopback, with keys and configuration of its own.

Nothing of ~/.ssh or /etc/ssh is read or written."""

import contextlib
import getpass
import os
import shutil
import socket
import subprocess
import time

SSHD = shutil.which("sshd", path=f"{os.environ.get('PATH', '')}:/usr/sbin:/sbin")  # it wants to be called by its whole path
SEPARATION = "/run/sshd"  # that of root changes into it; Debian's unit makes it when it starts

SERVER = """Port {port}
ListenAddress 127.0.0.1
HostKey {folder}/host_key_{name}
AuthorizedKeysFile {folder}/login_key.pub
PidFile none
UsePAM no
StrictModes no
PasswordAuthentication no
KbdInteractiveAuthentication no
PermitRootLogin prohibit-password
PermitUserRC no
"""
CLIENT = """Host {name}
  HostName 127.0.0.1
  Port {port}
  User {user}
  HostKeyAlias {name}
  IdentityFile {folder}/login_key
  IdentitiesOnly yes
  IdentityAgent none
  BatchMode yes
  UserKnownHostsFile {folder}/known_hosts
  GlobalKnownHostsFile none
"""


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def make_key(path):
    subprocess.run(["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-C", "", "-f", path], check=True)


def answers(port):
    with contextlib.suppress(OSError), socket.create_connection(("127.0.0.1", port), timeout=1) as connection:
        return connection.recv(4) == b"SSH-"
    return False


def write(path, text, mode="w"):
    with open(path, mode, encoding="utf-8") as file:
        file.write(text)


class Logins:
    """Runs one sshd for each name until the end of the test. `command` is the ssh that knows them; it reads no other configuration."""

    def __init__(self, test, folder, *names):
        self.folder, self.command = folder, f"ssh -F {folder}/ssh_config"
        make_key(f"{folder}/login_key")
        if os.geteuid() == 0 and not os.path.isdir(SEPARATION):
            os.mkdir(SEPARATION, 0o755)
            test.addCleanup(os.rmdir, SEPARATION)
        for name in names:
            self.start(test, name)

    def add_host(self, name, port):
        write(f"{self.folder}/ssh_config", CLIENT.format(name=name, port=port, user=getpass.getuser(), folder=self.folder), "a")

    def start(self, test, name):
        port = free_port()
        make_key(f"{self.folder}/host_key_{name}")
        with open(f"{self.folder}/host_key_{name}.pub", encoding="utf-8") as file:
            write(f"{self.folder}/known_hosts", f"{name} {file.read()}", "a")
        self.add_host(name, port)
        write(f"{self.folder}/sshd_{name}", SERVER.format(name=name, port=port, folder=self.folder))
        with open(self.log(name), "w", encoding="utf-8") as log:
            server = subprocess.Popen([SSHD, "-D", "-e", "-f", f"{self.folder}/sshd_{name}"], stderr=log, stdin=subprocess.DEVNULL)
        test.addCleanup(server.wait)
        test.addCleanup(server.terminate)
        while not answers(port):
            if server.poll() is not None:
                raise AssertionError(f"sshd ended with code {server.returncode}: {self.said(name)}")
            time.sleep(0.05)

    def log(self, name):
        return f"{self.folder}/sshd_{name}.log"

    def said(self, name):
        with open(self.log(name), encoding="utf-8") as file:
            return file.read()
