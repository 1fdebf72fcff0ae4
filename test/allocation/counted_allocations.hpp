// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>

/// What the whole program has allocated; hence an executable of its own.
extern std::atomic<long> allocations;
/// When `allocations` would become it, std::bad_alloc is thrown.
extern std::atomic<long> failing_allocation;
