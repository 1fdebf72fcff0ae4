# SPDX-License-Identifier: BSD-3-Clause
"""Trajectories and their rotations."""

from dataclasses import dataclass, replace
from typing import Optional

import numpy as np

NS_PER_S = 1_000_000_000


@dataclass(frozen=True)
class Trajectory:
    """Poses T_map_base, n of them with ascending stamps."""

    file: str
    stamps_ns: np.ndarray  # n, whole numbers: a double has no nanoseconds left at today's epoch
    positions_m: np.ndarray  # n x 3
    rotations: np.ndarray  # n x 3 x 3
    covariances_m2: Optional[np.ndarray] = None  # n x 3 x 3, of the position, where the source has them
    has_time: bool = True  # False: stamps only count the poses, as KITTI files have none
    is_camera: bool = False  # the plane seen from above is x, z (KITTI) and not x, y

    def __len__(self):
        return len(self.stamps_ns)

    def displacement_m(self):
        """Way from the first pose to each."""
        steps = np.linalg.norm(np.diff(self.positions_m, axis=0), axis=1)
        return np.concatenate([[0.0], np.cumsum(steps)])

    def at(self, chosen):
        """The poses that an index array or mask chooses."""
        covariances = None if self.covariances_m2 is None else self.covariances_m2[chosen]
        return replace(self, stamps_ns=self.stamps_ns[chosen], positions_m=self.positions_m[chosen],
                       rotations=self.rotations[chosen], covariances_m2=covariances)


def rotations_of_quaternions(quaternions):
    """n x 4, x y z w of norm 1, to n x 3 x 3."""
    x, y, z, w = np.asarray(quaternions, dtype=float).reshape(-1, 4).T
    rows = [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),
            2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
            2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]
    return np.stack(rows, axis=1).reshape(-1, 3, 3)


def nearest_rotations(matrices):
    """n x 3 x 3, rotations but for rounding."""
    u, _, v_transposed = np.linalg.svd(matrices)
    return u @ v_transposed


def angles_rad(rotations):
    """How far each of n x 3 x 3 turns."""
    cosines = 0.5 * (np.trace(rotations, axis1=1, axis2=2) - 1)
    return np.arccos(np.clip(cosines, -1, 1))


def rotations_of_vectors(vectors):
    """Rotation vectors, n x 3 [rad], to n x 3 x 3 (Rodrigues)."""
    angles = np.linalg.norm(vectors, axis=1)
    axes = vectors / np.maximum(angles, 1e-300)[:, None]
    skew = np.zeros((len(vectors), 3, 3))
    skew[:, 0, 1], skew[:, 0, 2], skew[:, 1, 2] = -axes[:, 2], axes[:, 1], -axes[:, 0]
    skew -= np.transpose(skew, (0, 2, 1))
    sines, cosines = np.sin(angles)[:, None, None], np.cos(angles)[:, None, None]
    return np.eye(3) + sines * skew + (1 - cosines) * (skew @ skew)


def vectors_of_rotations(rotations):
    """n x 3 x 3, none of which turns by 180 degrees, to rotation vectors, n x 3 [rad]."""
    angles = angles_rad(rotations)
    doubled = np.stack([rotations[:, 2, 1] - rotations[:, 1, 2], rotations[:, 0, 2] - rotations[:, 2, 0],
                        rotations[:, 1, 0] - rotations[:, 0, 1]], axis=1)
    sines = np.sin(angles)
    factors = np.where(sines > 1e-9, angles / np.maximum(2 * sines, 1e-300), 0.5)
    return factors[:, None] * doubled
