# SPDX-License-Identifier: BSD-3-Clause
"""Pairs of an estimate's poses with the truth's at the same time."""

from dataclasses import dataclass, replace

import numpy as np

from .faults import InputFault
from .trajectory import NS_PER_S, Trajectory, rotations_of_vectors, vectors_of_rotations


@dataclass(frozen=True)
class Pairs:
    """Estimate and truth, pose by pose."""

    estimate: Trajectory
    truth: Trajectory
    indices: np.ndarray  # of the paired poses in the whole estimate
    unmatched_estimate: int  # poses of the estimate without a truth
    unmatched_truth: int  # the other way round

    def seconds(self, start_ns):
        return (self.estimate.stamps_ns - start_ns) / NS_PER_S


def nearest(stamps_ns, wanted_ns):
    """Index of the stamp that is nearest to each wanted one."""
    after = np.clip(np.searchsorted(stamps_ns, wanted_ns), 1, max(len(stamps_ns) - 1, 1))
    before = after - 1
    after = np.minimum(after, len(stamps_ns) - 1)
    return np.where(wanted_ns - stamps_ns[before] <= stamps_ns[after] - wanted_ns, before, after)


def interpolated(trajectory, wanted_ns):
    """Poses at stamps that the trajectory covers: position linearly, rotation by slerp."""
    after = np.clip(np.searchsorted(trajectory.stamps_ns, wanted_ns), 1, len(trajectory) - 1)
    before = after - 1
    gaps_ns = trajectory.stamps_ns[after] - trajectory.stamps_ns[before]
    share = ((wanted_ns - trajectory.stamps_ns[before]) / gaps_ns)[:, None]
    positions = (1 - share) * trajectory.positions_m[before] + share * trajectory.positions_m[after]
    first = trajectory.rotations[before]
    turns = vectors_of_rotations(np.transpose(first, (0, 2, 1)) @ trajectory.rotations[after])
    return replace(trajectory, stamps_ns=wanted_ns, positions_m=positions, rotations=first @ rotations_of_vectors(share * turns))


def _pair_interpolated(estimate, truth, max_difference_ns):
    """Where both neighbours of the truth are within the difference, or the stamps are equal."""
    stamps = estimate.stamps_ns
    after = np.clip(np.searchsorted(truth.stamps_ns, stamps), 0, len(truth) - 1)
    before = np.maximum(after - 1, 0)
    is_equal = truth.stamps_ns[after] == stamps
    is_between = ((truth.stamps_ns[after] > stamps) & (truth.stamps_ns[before] < stamps)
                  & (truth.stamps_ns[after] - stamps <= max_difference_ns)
                  & (stamps - truth.stamps_ns[before] <= max_difference_ns))
    indices = np.flatnonzero(is_equal | is_between)
    at_stamps = truth.at(np.zeros(0, dtype=int))
    if len(truth) == 1:
        at_stamps = truth.at(after[indices])
    elif len(indices):
        at_stamps = interpolated(truth, stamps[indices])
    used = np.unique(np.concatenate([after[indices], before[indices[~is_equal[indices]]]]))
    return indices, at_stamps, len(truth) - len(used)


def _pair_nearest(estimate, truth, max_difference_ns):
    """One truth for one pose: of several poses that have the same nearest truth, the nearest keeps it."""
    chosen = nearest(truth.stamps_ns, estimate.stamps_ns)
    differences = np.abs(truth.stamps_ns[chosen] - estimate.stamps_ns)
    order = np.lexsort((np.arange(len(chosen)), differences))
    order = order[differences[order] <= max_difference_ns]
    _, first = np.unique(chosen[order], return_index=True)
    indices = np.sort(order[first])
    return indices, truth.at(chosen[indices]), len(truth) - len(indices)


def associate(estimate, truth, max_difference_s, interpolate=False):
    pair = _pair_interpolated if interpolate else _pair_nearest
    indices, at_stamps, unmatched_truth = pair(estimate, truth, round(max_difference_s * NS_PER_S))
    if not len(indices):
        spans = " and ".join(f"{t.file} from {t.stamps_ns[0] / NS_PER_S:.3f} to {t.stamps_ns[-1] / NS_PER_S:.3f} s"
                             for t in (estimate, truth))
        raise InputFault(f"{estimate.file}: no pose has a truth within {max_difference_s:g} s: {spans}. Name the truth of the same "
                         "recording and clock (KITTI files: --times), or raise --max-difference")
    return Pairs(estimate.at(indices), at_stamps, indices, len(estimate) - len(indices), unmatched_truth)
