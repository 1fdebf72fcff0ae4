# SPDX-License-Identifier: BSD-3-Clause
"""How accurate, consistent and cheap trajectories and runs are; scripts/evaluate is its command."""
