# SPDX-License-Identifier: BSD-3-Clause
"""The best rotation, translation and, if asked for, scale of an estimate (Umeyama 1991)."""

from dataclasses import dataclass, replace

import numpy as np

ALIGNMENTS = ("none", "se3", "sim3")


@dataclass(frozen=True)
class Alignment:
    scale: float
    rotation: np.ndarray
    translation_m: np.ndarray

    def apply(self, trajectory):
        covariances = trajectory.covariances_m2
        if covariances is not None:
            covariances = self.scale**2 * self.rotation @ covariances @ self.rotation.T
        return replace(trajectory, positions_m=self.scale * trajectory.positions_m @ self.rotation.T + self.translation_m,
                       rotations=self.rotation @ trajectory.rotations, covariances_m2=covariances)


NOT_MOVED = Alignment(1.0, np.eye(3), np.zeros(3))


def best_alignment(estimate_m, truth_m, with_scale):
    """n x 3 each, row by row the same place. None when the scale is asked for and the estimate does not move."""
    estimate_mean, truth_mean = estimate_m.mean(axis=0), truth_m.mean(axis=0)
    estimate_centred, truth_centred = estimate_m - estimate_mean, truth_m - truth_mean
    u, singular_values, v_transposed = np.linalg.svd(truth_centred.T @ estimate_centred)
    signs = np.array([1.0, 1.0, np.sign(np.linalg.det(u) * np.linalg.det(v_transposed))])
    rotation = u @ np.diag(signs) @ v_transposed
    scale = 1.0
    if with_scale:
        spread = (estimate_centred**2).sum()
        if spread <= 0 or (singular_values * signs).sum() <= 0:
            return None
        scale = (singular_values * signs).sum() / spread
    return Alignment(scale, rotation, truth_mean - scale * rotation @ estimate_mean)


def alignment_of(pairs, kind):
    """`kind` of ALIGNMENTS; None when it does not exist."""
    if kind == "none":
        return NOT_MOVED
    return best_alignment(pairs.estimate.positions_m, pairs.truth.positions_m, kind == "sim3")
