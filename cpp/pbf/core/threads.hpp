#pragma once

namespace pbf {

/// Most threads that a caller may ask for. Far above any machine this runs on, far below what makes
/// libgomp fail to start threads and end the process.
inline constexpr int kMaxThreads = 256;

/// The number of threads to use for a request: 0 means all that OpenMP offers, or as many as the
/// quota of a container allows, unless OMP_NUM_THREADS says how many. Throws InvalidParameter
/// outside [0, kMaxThreads]. In a process forked from one that had already used threads the answer
/// is 1, since libgomp's thread pool does not survive fork() and would wait for ever; results have
/// the same bits either way.
int usable_threads(int requested);

}  // namespace pbf
