# SPDX-License-Identifier: BSD-3-Clause
"""What vslam_onboard answers (common/protocol/vslam_protocol.h), from a file."""
import struct
import zlib

import numpy as np

POSE = struct.Struct("<4sBBHIIIq3d4d6d3d4dIII")


def read_poses(path):
    """A list of (flags, state, stamp_ns, fused pose, observer pose, counters, deviations): poses are x y z and quaternion
    x y z w."""
    data = path.read_bytes()
    assert len(data) % (POSE.size + 4) == 0, f"{len(data)} bytes are no whole records"
    poses = []
    for at in range(0, len(data), POSE.size + 4):
        body = data[at:at + POSE.size]
        assert struct.unpack_from("<I", data, at + POSE.size)[0] == zlib.crc32(body), "a wrong CRC"
        magic, version, kind, size, sequence, flags, state, stamp_ns, *rest = POSE.unpack(body)
        assert (magic, version, kind, size) == (b"VSLM", 1, 2, POSE.size + 4)
        assert sequence == len(poses) + 1
        poses.append((flags, state, stamp_ns, np.array(rest[:7]), np.array(rest[13:20]), rest[20:], np.array(rest[7:13])))
    return poses
