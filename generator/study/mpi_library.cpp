// SPDX-License-Identifier: GPL-3.0-or-later
// The library that is loaded where mpirun has started the program; see messages.hpp.
#define OMPI_SKIP_MPICXX 1  // the functions of C alone
#include <mpi.h>

#include <vector>

#include "study/messages.hpp"

namespace {

std::vector<char> buffer;

void send(int to, int tag, const char* data, std::size_t size) {
    MPI_Send(data, static_cast<int>(size), MPI_CHAR, to, tag, MPI_COMM_WORLD);
}

std::ptrdiff_t receive(int* from, int* tag, const char** data) {
    int is_there = 0, size = 0;
    MPI_Status status;
    if (MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &is_there, &status) != MPI_SUCCESS || is_there == 0) return -1;
    MPI_Get_count(&status, MPI_CHAR, &size);
    buffer.resize(static_cast<std::size_t>(size) + 1);
    if (MPI_Recv(buffer.data(), size, MPI_CHAR, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE) != MPI_SUCCESS)
        return -1;
    *from = status.MPI_SOURCE;
    *tag = status.MPI_TAG;
    *data = buffer.data();
    return size;
}

void end() { MPI_Finalize(); }

}  // namespace

extern "C" DalembertMessages dalembert_messages() {
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);  // a process that is lost does not take the others along, if MPI lets it
    DalembertMessages messages{0, 1, send, receive, end};
    MPI_Comm_rank(MPI_COMM_WORLD, &messages.rank);
    MPI_Comm_size(MPI_COMM_WORLD, &messages.size);
    return messages;
}
