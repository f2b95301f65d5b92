// SPDX-FileCopyrightText: 2026 the sigloc authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace sigloc
{
/// CPU time that the calling thread has used [s]: the cost of a method, whatever else the machine
/// does meanwhile.
double threadCpuSeconds();

/// Starts a new measurement of the largest resident set of this process, where the system can.
void resetPeakMemory();

/// The largest resident set since the last reset [MB].
double peakMemoryMb();

/// Memory that this process has allocated and not freed [bytes].
double heapBytes();
}  // namespace sigloc
