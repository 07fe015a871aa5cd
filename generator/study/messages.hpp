// SPDX-License-Identifier: GPL-3.0-or-later
// Messages between the processes that mpirun starts. What knows MPI is a library of its own, so that the program starts as fast as without.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {

/// Function `dalembert_messages` of the library gives it, and begins MPI.
struct DalembertMessages {
    int rank, size;
    void (*send)(int to, int tag, const char* data, std::size_t size);
    /// Nothing has come: -1. Else the size of a message, which stands in a buffer until the next call.
    std::ptrdiff_t (*receive)(int* from, int* tag, const char** data);
    void (*end)();
};
}
