// SPDX-License-Identifier: GPL-3.0-or-later
// Ends the program in order: on SIGINT and SIGTERM, and when a stage takes more time or memory than its budget. Programs that were
// started are ended and temporary files removed before; a file of results is whole or not there.
#pragma once

#include <sys/types.h>

#include <functional>
#include <mutex>
#include <string>
#include <vector>

namespace dalembert {

/// Does the work in a thread with a deep stack, and watches meanwhile. Returns its exit code. Called once, by main.
int guarded_program(const std::function<int()>& work);

/// Names the stage that begins, for the sentence that tells where time or memory went; its time is counted anew.
void enter_stage(const std::string& stage);

/// Other budgets of a stage than the usual: seconds of processor time, and bytes; 0 for as before.
void set_stage_budget(double seconds, double bytes);
struct StageLimits {
    double seconds, bytes;
};
/// What a stage may take now.
StageLimits stage_limits();

/// What must be gone when the program ends early. What is held while files are written, or something is made and added to the list,
/// keeps the program from ending in between.
class Leftovers {
public:
    static Leftovers& all();
    std::unique_lock<std::recursive_mutex> hold() { return std::unique_lock(mutex_); }
    void add_folder(const std::string& path);
    void remove_folder(const std::string& path);
    /// A program that leads a process group of its own.
    void add_child(pid_t group);
    void remove_child(pid_t group);
    /// Ends programs, removes folders; the lock is kept for ever, so that nothing new is made.
    void clear_for_good();

private:
    std::recursive_mutex mutex_;
    std::vector<std::string> folders_;
    std::vector<pid_t> children_;
};

}  // namespace dalembert
