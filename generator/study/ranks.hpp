// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of a study by all processes that mpirun started: rank 0 writes, and gives runs to whoever is free.
#pragma once

#include <memory>

#include "study/messages.hpp"
#include "study/study.hpp"

namespace dalembert {

class Ranks {
public:
    /// Null where mpirun did not start this program, or alone. Throws Failure (tool-failed) where the program has no MPI.
    static std::unique_ptr<Ranks> if_any();
    /// On rank 0 tells the others to end.
    ~Ranks();

    bool is_writer() const { return messages_.rank == 0; }
    /// Of the writer.
    MakeRuns maker();
    /// Of all others: makes runs until the writer has them all. A study is compiled when the first runs come, since the writer has compiled
    /// it then.
    void work(Study& study);

private:
    explicit Ranks(DalembertMessages messages) : messages_(messages) {}
    DalembertMessages messages_;
    bool is_told_ = false;  ///< that all is done
};

}  // namespace dalembert
