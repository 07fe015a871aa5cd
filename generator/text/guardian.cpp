// SPDX-License-Identifier: GPL-3.0-or-later
#include "text/guardian.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>

#include "text/budgets.hpp"
#include "text/diagnostic.hpp"

namespace dalembert {

namespace {

constexpr std::size_t deep_stack = std::size_t{512} << 20U;  ///< reserved, not taken: what nested expressions need, by far
constexpr long look_every = 100'000'000;                     ///< ns

/// Processor time of this program, without that of those that it started.
double processor_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Stage {
    std::mutex mutex;
    std::string name = "the program";
    double begin = 0;
    double seconds = budget::stage_seconds;
    double bytes = budget::memory_bytes;
};

Stage& stage() {
    static Stage one;
    return one;
}

/// Bytes in use and bytes of address space.
std::pair<double, double> memory_in_use() {
    unsigned long long all = 0, resident = 0;
    if (std::FILE* file = std::fopen("/proc/self/statm", "r")) {
        if (std::fscanf(file, "%llu %llu", &all, &resident) != 2) all = resident = 0;
        std::fclose(file);
    }
    const auto page = static_cast<double>(sysconf(_SC_PAGESIZE));
    return {static_cast<double>(resident) * page, static_cast<double>(all) * page};
}

/// What is left when nearly all of a limit of the shell is used: then an allocation fails next.
double address_space() {
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return 0;
    return 0.9 * static_cast<double>(limit.rlim_cur);
}

/// A sentence when a budget is spent, else nothing.
std::string spent() {
    Stage& now = stage();
    const std::lock_guard lock(now.mutex);
    if (processor_seconds() - now.begin > now.seconds)
        return fmt::format(
            "{} takes more than {:g} s of processor time, its budget; use a smaller model, fewer cells or modes, or definitions instead of "
            "long expressions, or give more with --stage-seconds",
            now.name, now.seconds);
    const auto [resident, all] = memory_in_use();
    if (resident > now.bytes || (address_space() > 0 && all > address_space()))
        return fmt::format(
            "{} takes more than {:.3g} GB of memory, its budget; use a smaller model, fewer cells or modes, or give more with --memory",
            now.name, (resident > now.bytes ? now.bytes : address_space()) / 1e9);
    return {};
}

/// Ends the program here and now, while its work may be anywhere.
[[noreturn]] void end_now(const std::string& sentence, int exit_code) {
    Leftovers::all().clear_for_good();
    if (!sentence.empty()) {
        const std::string line = sentence + "\n";
        [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, line.data(), line.size());
    }
    _exit(exit_code);
}

struct Work {
    const std::function<int()>* work;
    std::atomic<bool> is_done = false;
    int exit_code = 0;
};

void* do_work(void* pointer) {
    Work& work = *static_cast<Work*>(pointer);
    work.exit_code = (*work.work)();
    work.is_done = true;
    kill(getpid(), SIGUSR1);
    return nullptr;
}

/// A thread with a deep stack; where a limit of the shell does not allow one, with less.
bool start(pthread_t& thread, Work& work) {
    for (std::size_t size = deep_stack; size >= (std::size_t{8} << 20U); size /= 4) {
        pthread_attr_t attributes;
        pthread_attr_init(&attributes);
        pthread_attr_setstacksize(&attributes, size);
        const int failed = pthread_create(&thread, &attributes, do_work, &work);
        pthread_attr_destroy(&attributes);
        if (failed == 0) return true;
    }
    return false;
}

}  // namespace

int guarded_program(const std::function<int()>& work) {
    sigset_t watched;
    sigemptyset(&watched);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) sigaddset(&watched, signal);
    pthread_sigmask(SIG_BLOCK, &watched, nullptr);
    Work task{&work};
    pthread_t thread{};
    if (!start(thread, task)) return work();
    const timespec look{0, look_every};
    while (!task.is_done) {
        const int signal = sigtimedwait(&watched, nullptr, &look);
        if (task.is_done) break;
        if (signal == SIGINT || signal == SIGTERM || signal == SIGHUP) end_now("", 128 + signal);
        if (const std::string sentence = spent(); !sentence.empty())
            end_now(fmt::format("dalembert: error[{}]: {}", name_of(Id::too_large), sentence), static_cast<int>(ExitCode::bad_input));
    }
    pthread_join(thread, nullptr);
    return task.exit_code;
}

void enter_stage(const std::string& name) {
    Stage& now = stage();
    const std::lock_guard lock(now.mutex);
    now.name = name;
    now.begin = processor_seconds();
}

void set_stage_budget(double seconds, double bytes) {
    Stage& now = stage();
    const std::lock_guard lock(now.mutex);
    if (seconds > 0) now.seconds = seconds;
    if (bytes > 0) now.bytes = bytes;
}

StageLimits stage_limits() {
    Stage& now = stage();
    const std::lock_guard lock(now.mutex);
    return {now.seconds, now.bytes};
}

Leftovers& Leftovers::all() {
    static Leftovers& one = *new Leftovers;  // never gone: the program may end while others still use it
    return one;
}

void Leftovers::add_folder(const std::string& path) {
    const auto lock = hold();
    folders_.push_back(path);
}

void Leftovers::remove_folder(const std::string& path) {
    const auto lock = hold();
    std::erase(folders_, path);
}

void Leftovers::add_child(pid_t group) {
    const auto lock = hold();
    children_.push_back(group);
}

void Leftovers::remove_child(pid_t group) {
    const auto lock = hold();
    std::erase(children_, group);
}

void Leftovers::clear_for_good() {
    mutex_.lock();
    // A compiler removes its own temporary files when it is asked to end.
    for (const pid_t group : children_) kill(-group, SIGTERM);
    for (int tries = 0; tries < 20 && !children_.empty(); ++tries) {
        std::erase_if(children_, [](pid_t group) { return kill(-group, 0) != 0; });
        if (!children_.empty()) usleep(50'000);
    }
    for (const pid_t group : children_) kill(-group, SIGKILL);
    std::error_code ignored;
    for (const std::string& folder : folders_) std::filesystem::remove_all(folder, ignored);
}

}  // namespace dalembert
